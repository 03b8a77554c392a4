// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/text_placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "base/elementary.hpp"
#include "export/page/glue_spots.hpp"
#include "export/page/leader.hpp"
#include "export/page/name_placement.hpp"
#include "export/page/obstacles.hpp"
#include "export/page/upright.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

/// A number on the piece that still needs a place.
struct Wanted {
  PieceDrawing* piece = nullptr;
  Seam* seam = nullptr;
  bool on_tab = false;  ///< its number stands on the tab already
};

/// The direction along an edge, and the angle of a text along it that is upright as far as possible.
struct Frame {
  explicit Frame(const Segment2& edge)
      : size(length(edge.b - edge.a)),
        middle(0.5 * (edge.a + edge.b)),
        along(size > 0.0 ? (edge.b - edge.a) / size : Vec2{1.0, 0.0}),
        inward(perpendicular(along)),
        angle(upright(elementary::atan2(along.y, along.x))) {}

  double size;
  Vec2 middle;
  Vec2 along;
  Vec2 inward;
  double angle;
};

/// Places along an edge, shares of its length from its middle: there first, then to both sides in turn.
constexpr std::array<double, 7> along_shares{0.0, 0.12, -0.12, 0.25, -0.25, 0.37, -0.37};
/// How far inside of its edge a number still stands by it, mm, beyond the least distance.
constexpr std::array<double, 3> near_offsets{0.0, 0.5, 1.1};
constexpr double first_offset = 1.8;     ///< where numbers further inside begin, mm: beyond the near ones
constexpr double offset_step = 0.7;      ///< mm: half the height of a small number, so none is stepped over
constexpr double deepest_offset = 9.0;   ///< a number further inside than this needs a leader, mm
constexpr double longest_leader = 16.0;  ///< mm, from the edge to the number's centre
constexpr double shortest_leader = 2.2;  ///< mm, likewise: the line must be seen beside the number
constexpr double leader_step = 1.3;      ///< mm, from one length that is tried to the next
constexpr std::size_t leader_turns = 7;  ///< directions that a leader may take
constexpr double leader_turn = 0.3;      ///< between neighbouring ones, radians: 52 degrees to both sides
constexpr double leader_gap = 0.35;      ///< between a leader's end and its number's box, mm
/// Numbers keep this share of their height from lines, and at least so many mm: closer, a pen's line runs
/// into them.
constexpr double clearance_share = 0.17;
constexpr double least_clearance = 0.32;
/// More from the edge itself, mm: scissors follow it.
constexpr double edge_clearance = 0.12;
/// Heights of letters that are tried, the largest first.
constexpr int height_steps = 4;

class NumberPlacer {
 public:
  NumberPlacer(Vec2 page_size, const Box2& area, const Style& style)
      : obstacles_(page_size),
        area_(area),
        heights_(steps(style.label_height, style.smallest_label_height)) {}

  Obstacles& obstacles() { return obstacles_; }

  bool place_on_tab(PieceDrawing& piece, const Seam& seam) {
    const Frame frame({seam.tab[0], seam.tab[1]});
    Vec2 centre{};
    for (const Vec2 p : seam.tab) {
      centre += p / static_cast<double>(seam.tab.size());
    }
    for (const double height : heights_) {
      for (const double share : along_shares) {
        Text text = number(seam, height, frame.angle);
        text.centre = centre + share * frame.size * frame.along;
        const TurnedBox box = box_of(text);
        text.centre += text.centre - box.centre;  // the box, underline included, stands in the middle
        const TurnedBox centred = box_of(text);
        if (inside(centred.grown(clearance(height)), seam.tab) && put(piece, text, centred)) {
          placed_.push_back({&piece, &seam, piece.group.texts.size() - 1, last_text_, true});
          return true;
        }
      }
    }
    return false;
  }

  /// Along the edge, close to it; `side` is 1 for inside the piece, -1 for beside it.
  bool place_near(const Wanted& wanted, double side = 1.0) {
    for (const double height : heights_) {
      for (const double offset : near_offsets) {
        if (place_along(wanted, height, offset, false, side)) {
          return true;
        }
      }
    }
    return std::ranges::any_of(heights_,
                               [&](double height) { return place_along(wanted, height, 0.0, true, side); });
  }

  /// Along the edge, further inside the same panel.
  bool place_inside(const Wanted& wanted) {
    for (const double height : heights_) {
      for (double offset = first_offset; offset < deepest_offset; offset += offset_step) {
        if (place_along(wanted, height, offset, false, 1.0) ||
            place_along(wanted, height, offset, true, 1.0)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Anywhere around, with a line to the edge's middle; `side` is 1 for inside the piece, -1 for beside it.
  bool place_with_leader(const Wanted& wanted, double side) {
    const Frame frame(wanted.seam->edge);
    const Vec2 out = side * frame.inward;
    const std::vector<Vec2>& tab = wanted.seam->tab;
    // Beside the piece the line ends at the edge, or at the far side of the tab that stands on it.
    const Vec2 start = side < 0.0 && !tab.empty() ? 0.5 * (tab[2] + tab.back()) : frame.middle;
    for (const double height : {heights_[1], heights_.back()}) {
      Text text = number(*wanted.seam, height, frame.angle);
      TurnedBox box = box_of(text);
      const Vec2 box_from_text = box.centre;
      std::array<bool, leader_turns> blocked{};
      for (double reach = shortest_leader; reach < longest_leader; reach += leader_step) {
        for (std::size_t i = 0; i < leader_turns; ++i) {
          if (blocked[i]) {
            continue;
          }
          // Straight ahead first, then to both sides in turn.
          const double turn = (i % 2 == 0 ? 1.0 : -1.0) * static_cast<double>((i + 1) / 2) * leader_turn;
          text.centre = start + reach * (elementary::cos(turn) * out + elementary::sin(turn) * frame.along);
          box.centre = text.centre + box_from_text;
          const Segment2 leader = leader_to(box, start, out);
          blocked[i] = !obstacles_.is_free(leader, false);  // a longer one would be, too
          if (!blocked[i] && put_with_leader(wanted, text, box, leader, out)) {
            return true;
          }
        }
      }
    }
    return false;
  }

  static double clearance(double height) { return std::max(least_clearance, clearance_share * height); }

  /// `box`: the text's.
  bool put(PieceDrawing& piece, const Text& text, const TurnedBox& box) {
    if (!on_area(box) || !obstacles_.is_free(box, text.height, clearance(text.height))) {
      return false;
    }
    last_text_ = obstacles_.add(text);
    piece.group.texts.push_back(text);
    return true;
  }

  /// Numbers tell on which piece the other edge is ("B:12"), where there is room for it.
  void name_partners() {
    for (const Placed& placed : placed_) {
      Text& text = placed.piece->group.texts[placed.text];
      if (placed.seam->partner.empty()) {
        continue;
      }
      if (const auto longer = with_partner(text, placed)) {
        obstacles_.replace(placed.obstacle, *longer);
        text = *longer;
      }
    }
  }

 private:
  /// A number that stands by its edge or on its tab.
  struct Placed {
    PieceDrawing* piece = nullptr;
    const Seam* seam = nullptr;
    std::size_t text = 0;  ///< of the piece's texts
    std::uint32_t obstacle = 0;
    bool on_tab = false;
  };

  [[nodiscard]] std::optional<Text> with_partner(const Text& plain, const Placed& placed) const {
    Text text = plain;
    text.text = placed.seam->partner + ":" + plain.text;
    text.underlined = false;  // the name comes first: which end that is tells which side is up
    const double growth = box_of(text).half_width - box_of(plain).half_width;
    const Vec2 baseline{elementary::cos(plain.angle), elementary::sin(plain.angle)};
    const Frame frame(placed.seam->edge);
    for (const double share : {0.0, 0.5, -0.5, 1.0, -1.0}) {
      text.centre = plain.centre + share * growth * baseline;
      const TurnedBox box = box_of(text);
      const double reach = box.half_width * std::abs(dot(frame.along, box.along)) +
                           box.half_height * std::abs(dot(frame.along, perpendicular(box.along)));
      const bool at_its_edge =
          placed.on_tab ? inside(box.grown(clearance(text.height)), placed.seam->tab)
                        : std::abs(dot(box.centre - frame.middle, frame.along)) + reach <= 0.5 * frame.size;
      if (at_its_edge && on_area(box) &&
          obstacles_.is_free(box, text.height, clearance(text.height), 0.0, placed.obstacle)) {
        return text;
      }
    }
    return std::nullopt;
  }

  static std::vector<double> steps(double largest, double smallest) {
    std::vector<double> heights;
    for (int i = 0; i < height_steps; ++i) {
      heights.push_back(largest + (smallest - largest) * i / (height_steps - 1));
    }
    return heights;
  }

  static Text number(const Seam& seam, double height, double angle) {
    Text text{Layer::label, std::to_string(seam.number), {}, height, angle, false};
    text.underlined = ambiguous_upside_down(text.text);
    return text;
  }

  [[nodiscard]] bool on_area(const TurnedBox& box) const {
    const Box2 bounds = box.bounds();
    return bounds.low.x >= area_.low.x && bounds.low.y >= area_.low.y && bounds.high.x <= area_.high.x &&
           bounds.high.y <= area_.high.y;
  }

  static bool inside(const TurnedBox& box, const std::vector<Vec2>& convex) {
    for (std::size_t i = 0; i < convex.size(); ++i) {
      const Vec2 a = convex[i];
      const Vec2 side = convex[(i + 1) % convex.size()] - a;
      const double size = length(side);
      if (!(size > 0.0)) {
        continue;
      }
      const Vec2 in = perpendicular(side) / size;
      const double reach = box.half_width * std::abs(dot(in, box.along)) +
                           box.half_height * std::abs(dot(in, perpendicular(box.along)));
      if (dot(box.centre - a, in) < reach) {
        return false;
      }
    }
    return true;
  }

  bool place_along(const Wanted& wanted, double height, double offset, bool across, double side) {
    const Frame frame(wanted.seam->edge);
    Text text =
        number(*wanted.seam, height, across ? upright(frame.angle + 0.5 * std::numbers::pi) : frame.angle);
    const TurnedBox at_origin = box_of(text);
    const double half = across ? at_origin.half_width : at_origin.half_height;
    const double half_along = across ? at_origin.half_height : at_origin.half_width;
    const double room = std::max(0.0, 0.5 * frame.size - half_along);
    // Beside the piece, that is beyond the tab.
    const double lift = side < 0.0 ? tab_height(*wanted.seam, frame) : 0.0;
    const Vec2 out = side * frame.inward;
    TurnedBox box = at_origin;
    double last = -1.0;
    for (const double share : along_shares) {
      const double shift = std::clamp(share * frame.size, -room, room);
      if (shift == last) {
        continue;
      }
      last = shift;
      const Vec2 foot = frame.middle + shift * frame.along + lift * out;
      const Vec2 centre = foot + (half + clearance(height) + edge_clearance + offset) * out;
      text.centre = centre - at_origin.centre;
      box.centre = text.centre + at_origin.centre;
      if (obstacles_.is_free(Segment2{foot + off_the_edge_mm * out, centre}, true) &&
          put(*wanted.piece, text, box)) {
        placed_.push_back(
            {wanted.piece, wanted.seam, wanted.piece->group.texts.size() - 1, last_text_, false});
        return true;
      }
    }
    return false;
  }

  static double tab_height(const Seam& seam, const Frame& frame) {
    double height = 0.0;
    for (const Vec2 p : seam.tab) {
      height = std::max(height, -dot(p - frame.middle, frame.inward));
    }
    return height;
  }

  /// From the edge to the nearest point of the text's box.
  static Segment2 leader_to(const TurnedBox& text, Vec2 edge, Vec2 out) {
    const TurnedBox box = text.grown(leader_gap);
    const Vec2 up = perpendicular(box.along);
    const Vec2 from_centre = edge - box.centre;
    return {edge + off_the_edge_mm * out,
            box.centre +
                std::clamp(dot(from_centre, box.along), -box.half_width, box.half_width) * box.along +
                std::clamp(dot(from_centre, up), -box.half_height, box.half_height) * up};
  }

  bool put_with_leader(const Wanted& wanted, const Text& text, const TurnedBox& box, const Segment2& leader,
                       Vec2 out) {
    if (!can_lead(leader, out, obstacles_) || !put(*wanted.piece, text, box)) {
      return false;
    }
    draw_leader(leader, *wanted.piece, obstacles_);
    return true;
  }

  Obstacles obstacles_;
  Box2 area_;
  std::vector<double> heights_;
  std::vector<Placed> placed_;
  std::uint32_t last_text_ = 0;  ///< number of the obstacle that was added last
};

void add_lines(Obstacles& obstacles, const PieceDrawing& piece) {
  for (const Line& line : piece.group.lines) {
    const bool fold =
        line.layer == Layer::mountain || line.layer == Layer::valley || line.layer == Layer::glue;
    const auto kind = fold ? Obstacles::Kind::fold : Obstacles::Kind::cut;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      obstacles.add({line.points[i - 1], line.points[i]}, kind);
    }
    if (line.closed) {
      obstacles.add({line.points.back(), line.points.front()}, kind);
    }
  }
}

/// Those without a place after each attempt.
template <class Place>
std::vector<Wanted> without_place(const std::vector<Wanted>& all, Place place) {
  std::vector<Wanted> rest;
  std::ranges::copy_if(all, std::back_inserter(rest), [&](const Wanted& wanted) { return !place(wanted); });
  return rest;
}

}  // namespace

bool ambiguous_upside_down(std::string_view number) {
  constexpr std::string_view turned = "01xxxx9x86";
  std::string other;
  for (const char digit : number) {
    other.insert(other.begin(),
                 digit >= '0' && digit <= '9' ? turned[static_cast<std::size_t>(digit - '0')] : 'x');
  }
  return other != number && !other.empty() && other.front() != '0' && other.find('x') == std::string::npos;
}

void place_texts(std::vector<PieceDrawing>& pieces, Vec2 page_size, const Box2& area, const Style& style,
                 DrawReport& report, const Context& context) {
  const auto in_time = [&context] { return !context.out_of_grace(); };
  NumberPlacer placer(page_size, area, style);
  for (const PieceDrawing& piece : pieces) {
    add_lines(placer.obstacles(), piece);
  }
  for (PieceDrawing& piece : pieces) {
    place_spot_names(piece, area, placer.obstacles());
  }
  const bool outside = style.numbers == Numbers::tabs || style.numbers == Numbers::outside;
  std::vector<Wanted> wanted;
  for (PieceDrawing& piece : pieces) {
    for (Seam& seam : piece.seams) {
      const bool on_tab =
          !seam.tab.empty() && style.numbers != Numbers::outside && placer.place_on_tab(piece, seam);
      wanted.push_back({&piece, &seam, on_tab});
    }
  }
  // Short edges have the least choice.
  std::ranges::stable_sort(wanted, {},
                           [](const Wanted& w) { return length(w.seam->edge.b - w.seam->edge.a); });
  if (style.numbers == Numbers::tabs) {
    std::erase_if(wanted, [](const Wanted& w) { return w.on_tab; });
  }
  if (outside) {
    wanted = without_place(wanted, [&](const Wanted& w) { return placer.place_near(w, -1.0); });
    wanted = without_place(wanted,
                           [&](const Wanted& w) { return in_time() && placer.place_with_leader(w, -1.0); });
  }
  wanted = without_place(wanted, [&](const Wanted& w) { return placer.place_near(w); });
  for (PieceDrawing& piece : pieces) {
    if (!place_name(piece, placer.obstacles(), area, !in_time())) {
      ++report.names_left_out;
    }
  }
  wanted = without_place(wanted, [&](const Wanted& w) { return in_time() && placer.place_inside(w); });
  std::erase_if(wanted, [](const Wanted& w) { return w.on_tab; });
  wanted =
      without_place(wanted, [&](const Wanted& w) { return in_time() && placer.place_with_leader(w, 1.0); });
  if (!outside) {
    const std::size_t before = wanted.size();
    wanted = without_place(wanted,
                           [&](const Wanted& w) { return in_time() && placer.place_with_leader(w, -1.0); });
    report.labels_outside += before - wanted.size();
  }
  placer.name_partners();
  for (PieceDrawing& piece : pieces) {
    std::ranges::for_each(piece.seams, [](Seam& seam) { seam.numbered = true; });
  }
  for (const Wanted& w : wanted) {
    w.seam->numbered = false;
  }
}

}  // namespace ridgecraft::paper
