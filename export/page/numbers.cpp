// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/elementary.hpp"
#include "export/page/obstacles.hpp"

namespace ridgecraft::export_ {
namespace {

/// Places along an edge, shares of its length from its middle: there first, then to both sides in turn.
constexpr std::array<double, 7> along_fractions{0.0, 0.12, -0.12, 0.25, -0.25, 0.37, -0.37};
/// How far inside of its edge a number still stands by it, mm, beyond the least distance.
constexpr std::array<double, 3> near_offsets{0.0, 0.5, 1.1};
constexpr double first_offset = 1.8;    ///< where numbers further inside begin, mm: beyond the near ones
constexpr double offset_step = 0.7;     ///< mm: half the height of a small number, so none is stepped over
constexpr double deepest_offset = 9.0;  ///< a number further inside than this needs a leader, mm
/// From the edge to the number's centre, mm: where the piece itself lies between them a long line crosses
/// many folds.
constexpr double longest_leader_inside = 16.0;
constexpr double longest_leader_outside = 26.0;
constexpr double shortest_leader = 2.2;  ///< mm, likewise: the line must be seen beside the number
constexpr double leader_step = 1.3;      ///< mm, from one length that is tried to the next
constexpr std::size_t leader_turns = 9;  ///< directions that a leader may take
constexpr double leader_turn = 0.21;     ///< between neighbouring ones, radians: 48 degrees to both sides
constexpr double leader_gap = 0.35;      ///< between a leader's end and its number's box, mm
/// Where a leader may begin, shares of the edge's length from its middle.
constexpr std::array<double, 3> leader_fractions{0.0, 0.3, -0.3};
/// Numbers keep this share of their height from lines, and at least so many mm: closer, a pen's line runs
/// into them.
constexpr double clearance_fraction = 0.17;
constexpr double least_clearance = 0.32;
/// More from the edge itself, mm: scissors follow it.
constexpr double edge_clearance = 0.12;
/// Heights of letters that are tried, the largest first.
constexpr int height_steps = 4;

double clearance_of(double height) {
  return std::max(least_clearance, clearance_fraction * height);
}

std::vector<double> heights_between(double largest, double smallest) {
  std::vector<double> heights;
  for (int i = 0; i < height_steps; ++i) {
    heights.push_back(largest + (smallest - largest) * i / (height_steps - 1));
  }
  return heights;
}

Text number_text(const Seam& seam, double height, double angle) {
  Text text{Layer::label, std::to_string(seam.number), {}, height, angle, false};
  text.underlined = ambiguous_upside_down(text.text);
  return text;
}

bool lies_inside(const TurnedBox& box, const std::vector<Vec2>& convex) {
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

double tab_height(const Seam& seam, Vec2 middle, Vec2 inward) {
  double height = 0.0;
  for (const Vec2 p : seam.tab) {
    height = std::max(height, -dot(p - middle, inward));
  }
  return height;
}

/// From the edge to the nearest point of the text's box.
Segment2 leader_to(const TurnedBox& text, Vec2 edge, Vec2 out) {
  const TurnedBox box = text.grown(leader_gap);
  const Vec2 up = perpendicular(box.along);
  const Vec2 from_centre = edge - box.centre;
  return {edge + off_the_edge_mm * out,
          box.centre + std::clamp(dot(from_centre, box.along), -box.half_width, box.half_width) * box.along +
              std::clamp(dot(from_centre, up), -box.half_height, box.half_height) * up};
}

}  // namespace

/// The direction along an edge, and the angle of a text along it that is upright as far as possible.
struct NumberPlacer::Frame {
  explicit Frame(const Segment2& edge)
      : size(length(edge.b - edge.a)),
        middle(0.5 * (edge.a + edge.b)),
        along(size > 0.0 ? (edge.b - edge.a) / size : Vec2{1.0, 0.0}),
        inward(perpendicular(along)),
        angle(upright(elementary::atan2(along.y, along.x))) {}

  [[nodiscard]] Vec2 out(Side side) const { return side == Side::inside ? inward : -inward; }

  double size;
  Vec2 middle;
  Vec2 along;
  Vec2 inward;
  double angle;
};

bool ambiguous_upside_down(std::string_view number) {
  // Asked for every place that a number might have, so without a string of its own.
  constexpr std::string_view turned = "01xxxx9x86";
  const auto other = [&](char digit) {
    return digit >= '0' && digit <= '9' ? turned[static_cast<std::size_t>(digit - '0')] : 'x';
  };
  bool same = true;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const char digit = other(number[number.size() - 1 - i]);
    if (digit == 'x' || (i == 0 && digit == '0')) {
      return false;
    }
    same = same && digit == number[i];
  }
  return !same;
}

NumberPlacer::NumberPlacer(Vec2 page_size, const Box2& area, const Style& style)
    : obstacles_(page_size),
      area_(area),
      heights_(heights_between(style.label_height, style.smallest_label_height)) {}

void NumberPlacer::add_lines(const PieceDrawing& piece) {
  for (const Line& line : piece.group.lines) {
    const bool fold =
        line.layer == Layer::mountain || line.layer == Layer::valley || line.layer == Layer::glue;
    const auto kind = fold ? Obstacles::Kind::fold : Obstacles::Kind::cut;
    for (const Segment2& segment : segments_of(line)) {
      obstacles_.add(segment, kind);
    }
  }
}

bool NumberPlacer::place_on_tab(PieceDrawing& piece, const Seam& seam) {
  const Frame frame({seam.tab[0], seam.tab[1]});
  Vec2 centre{};
  for (const Vec2 p : seam.tab) {
    centre += p / static_cast<double>(seam.tab.size());
  }
  for (const double height : heights_) {
    for (const double fraction : along_fractions) {
      Text text = number_text(seam, height, frame.angle);
      text.centre = centre + fraction * frame.size * frame.along;
      const TurnedBox box = box_of(text);
      text.centre += text.centre - box.centre;  // the box, underline included, stands in the middle
      const TurnedBox centred = box_of(text);
      if (lies_inside(centred.grown(clearance_of(height)), seam.tab) && put(piece, text, centred)) {
        placed_.push_back({&piece, &seam, piece.group.texts.size() - 1, last_text_, true});
        return true;
      }
    }
  }
  return false;
}

bool NumberPlacer::place(const Wanted& wanted, NumberPlace where) {
  return std::ranges::any_of(wanted.seams, [&](const Seam* seam) {
    return place_at({wanted.piece, seam}, where);
  });
}

bool NumberPlacer::place_at(const EdgeOfPiece& at, NumberPlace where) {
  switch (where) {
    case NumberPlace::at_edge:
      return place_near(at, Side::inside);
    case NumberPlace::further_inside:
      return place_further_inside(at);
    case NumberPlace::beside_piece:
      return place_near(at, Side::outside);
    case NumberPlace::leader_inside:
      return place_with_leader(at, Side::inside);
    case NumberPlace::leader_outside:
      return place_with_leader(at, Side::outside);
  }
  return false;
}

bool NumberPlacer::place_near(const EdgeOfPiece& at, Side side) {
  for (const double height : heights_) {
    for (const double offset : near_offsets) {
      if (place_along(at, height, offset, false, side)) {
        return true;
      }
    }
  }
  return std::ranges::any_of(heights_,
                             [&](double height) { return place_along(at, height, 0.0, true, side); });
}

bool NumberPlacer::place_further_inside(const EdgeOfPiece& at) {
  for (const double height : heights_) {
    for (double offset = first_offset; offset < deepest_offset; offset += offset_step) {
      if (place_along(at, height, offset, false, Side::inside) ||
          place_along(at, height, offset, true, Side::inside)) {
        return true;
      }
    }
  }
  return false;
}

bool NumberPlacer::place_with_leader(const EdgeOfPiece& at, Side side) {
  const Frame frame(at.seam->edge);
  const std::vector<Vec2>& tab = at.seam->tab;
  // Outside the piece the line ends at the edge, or at the far side of the tab that stands on it.
  const bool from_tab = side == Side::outside && !tab.empty();
  const Vec2 start = from_tab ? 0.5 * (tab[2] + tab.back()) : frame.middle;
  const double size = from_tab ? length(tab.back() - tab[2]) : frame.size;
  for (const double height : {heights_[1], heights_.back()}) {
    for (const double turned : {0.0, 0.5 * std::numbers::pi}) {
      const Text text = number_text(*at.seam, height, upright(frame.angle + turned));
      for (const double fraction : leader_fractions) {
        if (lead_from(at, text, start + fraction * size * frame.along, frame, side)) {
          return true;
        }
      }
    }
  }
  return false;
}

void NumberPlacer::name_partners() {
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

std::optional<Text> NumberPlacer::with_partner(const Text& plain, const Placed& placed) const {
  Text text = plain;
  text.text = placed.seam->partner + ":" + plain.text;
  text.underlined = false;  // the name comes first: which end that is tells which side is up
  const double growth = box_of(text).half_width - box_of(plain).half_width;
  const Vec2 baseline{elementary::cos(plain.angle), elementary::sin(plain.angle)};
  const Frame frame(placed.seam->edge);
  for (const double fraction : {0.0, 0.5, -0.5, 1.0, -1.0}) {
    text.centre = plain.centre + fraction * growth * baseline;
    const TurnedBox box = box_of(text);
    const double reach = box.half_width * std::abs(dot(frame.along, box.along)) +
                         box.half_height * std::abs(dot(frame.along, perpendicular(box.along)));
    const bool at_its_edge =
        placed.on_tab ? lies_inside(box.grown(clearance_of(text.height)), placed.seam->tab)
                      : std::abs(dot(box.centre - frame.middle, frame.along)) + reach <= 0.5 * frame.size;
    if (at_its_edge && lies_within(box.bounds(), area_) &&
        obstacles_.is_free(box, text.height, clearance_of(text.height), 0.0, placed.obstacle)) {
      return text;
    }
  }
  return std::nullopt;
}

/// `box`: the text's.
bool NumberPlacer::put(PieceDrawing& piece, const Text& text, const TurnedBox& box) {
  if (!lies_within(box.bounds(), area_) || !obstacles_.is_free(box, text.height, clearance_of(text.height))) {
    return false;
  }
  last_text_ = obstacles_.add(text);
  piece.group.texts.push_back(text);
  return true;
}

bool NumberPlacer::place_along(const EdgeOfPiece& at, double height, double offset, bool across, Side side) {
  const Frame frame(at.seam->edge);
  Text text =
      number_text(*at.seam, height, across ? upright(frame.angle + 0.5 * std::numbers::pi) : frame.angle);
  const TurnedBox at_origin = box_of(text);
  const double half = across ? at_origin.half_width : at_origin.half_height;
  const double half_along = across ? at_origin.half_height : at_origin.half_width;
  const double room = std::max(0.0, 0.5 * frame.size - half_along);
  // Outside the piece, that is beyond the tab.
  const double lift = side == Side::outside ? tab_height(*at.seam, frame.middle, frame.inward) : 0.0;
  const Vec2 out = frame.out(side);
  TurnedBox box = at_origin;
  double last = -1.0;
  for (const double fraction : along_fractions) {
    const double shift = std::clamp(fraction * frame.size, -room, room);
    if (shift == last) {
      continue;
    }
    last = shift;
    const Vec2 foot = frame.middle + shift * frame.along + lift * out;
    const Vec2 centre = foot + (half + clearance_of(height) + edge_clearance + offset) * out;
    text.centre = centre - at_origin.centre;
    box.centre = text.centre + at_origin.centre;
    if (obstacles_.is_free(Segment2{foot + off_the_edge_mm * out, centre}, true) &&
        put(*at.piece, text, box)) {
      placed_.push_back({at.piece, at.seam, at.piece->group.texts.size() - 1, last_text_, false});
      return true;
    }
  }
  return false;
}

/// `text` wherever around a point of its edge there is room for it.
bool NumberPlacer::lead_from(const EdgeOfPiece& at, Text text, Vec2 start, const Frame& frame, Side side) {
  const Vec2 out = frame.out(side);
  const double longest = side == Side::inside ? longest_leader_inside : longest_leader_outside;
  text.centre = {};
  TurnedBox box = box_of(text);
  const Vec2 box_from_text = box.centre;
  std::array<bool, leader_turns> blocked{};
  for (double reach = shortest_leader; reach < longest; reach += leader_step) {
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
      if (!blocked[i] && put_with_leader(at, text, box, leader, out)) {
        return true;
      }
    }
  }
  return false;
}

bool NumberPlacer::put_with_leader(const EdgeOfPiece& at, const Text& text, const TurnedBox& box,
                                   const Segment2& leader, Vec2 out) {
  if (!can_lead(leader, out, obstacles_) || !put(*at.piece, text, box)) {
    return false;
  }
  draw_leader(leader, *at.piece, obstacles_);
  return true;
}

namespace {

using Rim = std::vector<std::size_t>;

/// The place of an edge's mate in the rim, where both close like a zip, looking one way round.
std::optional<std::size_t> mate_ahead(const PieceDrawing& piece, const Rim& rim, std::size_t at, bool back) {
  const std::size_t size = rim.size();
  const auto place = [&](std::size_t steps) { return (at + (back ? size - steps : steps)) % size; };
  const auto seam = [&](std::size_t steps) -> const Seam& { return piece.seams[rim[place(steps)]]; };
  // Edges follow each other clockwise with their faces on their left: each begins where the next one ends.
  const auto follows = [&](std::size_t steps) {
    const Seam& first = back ? seam(steps) : seam(steps - 1);
    const Seam& second = back ? seam(steps - 1) : seam(steps);
    return length(first.edge.a - second.edge.b) <= same_corner_mm;
  };
  std::vector<JoinId> open;  // joins whose second edge is still to come
  for (std::size_t steps = 1; steps < size && follows(steps); ++steps) {
    const JoinId join = seam(steps).join;
    if (!open.empty() && open.back() == join) {
      open.pop_back();
    } else if (open.empty() && join == piece.seams[rim[at]].join) {
      return place(steps);
    } else {
      open.push_back(join);
    }
  }
  return std::nullopt;
}

bool has_number(const PieceDrawing& piece, const Rim& rim, std::size_t place) {
  return piece.seams[rim[place % rim.size()]].at == NumberAt::edge;
}

}  // namespace

bool closes_by_itself(const PieceDrawing& piece, const std::vector<std::size_t>& rim, std::size_t at) {
  return mate_ahead(piece, rim, at, false) || mate_ahead(piece, rim, at, true);
}

void leave_out_closing(PieceDrawing& piece) {
  for (const Rim& rim : piece.rims) {
    std::vector<std::size_t> closing;
    for (std::size_t at = 0; at < rim.size(); ++at) {
      if (piece.seams[rim[at]].at != NumberAt::list) {
        continue;
      }
      for (const bool back : {false, true}) {
        const auto mate = mate_ahead(piece, rim, at, back);
        if (!mate) {
          continue;
        }
        if (has_number(piece, rim, *mate)) {
          closing.push_back(rim[at]);
        }
      }
    }
    for (const std::size_t seam : closing) {
      piece.seams[seam].at = NumberAt::closing;
    }
  }
}

}  // namespace ridgecraft::export_
