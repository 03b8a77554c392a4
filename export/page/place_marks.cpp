// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/place_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "base/polygon.hpp"
#include "export/page/clip_to_box.hpp"
#include "export/page/gaps.hpp"
#include "export/page/leader.hpp"
#include "export/page/obstacles.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

/// Heights of letters that are tried, mm.
constexpr std::array<double, 3> letter_heights{2.4, 2.0, 1.6};
/// Of a ring around one letter, and at least so much around longer ones, shares of the height.
constexpr double ring_share = 0.78;
constexpr double around_letters_share = 0.25;
constexpr int ring_corners = 24;
constexpr double ring_clearance_mm = 0.3;  ///< from lines and texts
constexpr double shortest_part_mm = 1.2;   ///< of a frame
constexpr double step_mm = 0.25;           ///< along a frame, from one place that is looked at to the next
/// Between places for rings along a frame, mm, and lengths of leaders to them, from the frame.
constexpr double ring_step_mm = 1.0;
constexpr double shortest_leader_mm = 1.5;
constexpr double longest_leader_mm = 20.0;
constexpr std::array<double, 5> leader_turns_rad{0.0, 0.4, -0.4, 0.8, -0.8};  ///< from straight out

/// Where the strokes of a letter are, around the middle of its text's box.
Box2 strokes_box(std::string_view letter, double height) {
  return box_of(text_strokes(Text{Layer::mark, std::string(letter), {}, height, 0.0, false}));
}

double radius_of(std::string_view letter, double height) {
  return std::max(ring_share * height,
                  0.5 * length(strokes_box(letter, height).size()) + around_letters_share * height);
}

PageMarks ring_of(std::string_view letter, Vec2 middle, double height) {
  PageMarks ring;
  const Box2 box = strokes_box(letter, height);
  ring.texts.push_back(
      {Layer::mark, std::string(letter), middle - 0.5 * (box.low + box.high), height, 0.0, false});
  Line line{Layer::mark, {}, true, Fold::none};
  line.like = Layer::label;
  for (int i = 0; i < ring_corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / ring_corners;
    line.points.push_back(middle +
                          radius_of(letter, height) * Vec2{elementary::cos(angle), elementary::sin(angle)});
  }
  ring.lines.push_back(std::move(line));
  return ring;
}

std::vector<Segment2> segments_of(const Line& line) {
  std::vector<Segment2> segments;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    segments.push_back({line.points[i - 1], line.points[i]});
  }
  if (line.closed) {
    segments.push_back({line.points.back(), line.points.front()});
  }
  return segments;
}

/// What of the line lies outside a circle.
std::vector<Segment2> outside_circle(const Segment2& line, Vec2 middle, double radius) {
  const double size = length(line.b - line.a);
  const Vec2 along = (line.b - line.a) / size;
  const double foot = dot(middle - line.a, along);
  const double away = cross(along, middle - line.a);
  if (std::abs(away) >= radius) {
    return {line};
  }
  const double half = std::sqrt(radius * radius - away * away);
  std::vector<Segment2> parts;
  if (foot - half > shortest_part_mm) {
    parts.push_back({line.a, line.a + std::min(size, foot - half) * along});
  }
  if (size - (foot + half) > shortest_part_mm) {
    parts.push_back({line.a + std::max(0.0, foot + half) * along, line.b});
  }
  return parts;
}

class Marker {
 public:
  Marker(std::vector<PieceDrawing>& pieces, const PageMarks& beside, Vec2 page_size, const Box2& area)
      : pieces_(pieces), area_(area), obstacles_(page_size) {
    for (const PieceDrawing& piece : pieces) {
      closed_.emplace_back();
      for (const Line& line : piece.group.lines) {
        add_line(line);
        if (line.layer == Layer::cut && line.closed) {
          closed_.back().push_back(line.points);
        }
      }
      boxes_.push_back(box_of(closed_.back()));
      add_texts(piece.group.texts);
      tabs_.emplace_back();
      for (const Seam& seam : piece.seams) {
        if (!seam.tab.empty()) {
          tabs_.back().push_back(seam.tab);
        }
      }
    }
    // Pictures are like pieces that no frame may touch.
    for (const Line& line : beside.lines) {
      add_line(line);
      if (line.closed) {
        closed_.push_back({line.points});
        boxes_.push_back(box_of(line.points));
      }
    }
    add_texts(beside.texts);
  }

  void mark(const PicturePlace& picture) {
    own_ = picture.piece;
    // A picture may show more than the printable area.
    const Box2 frame{
        {std::max(picture.window.low.x, area_.low.x), std::max(picture.window.low.y, area_.low.y)},
        {std::min(picture.window.high.x, area_.high.x), std::min(picture.window.high.y, area_.high.y)}};
    std::vector<Segment2> parts = free_parts(frame);
    const std::optional<Ring> ring = place_ring(parts, frame, picture.letter);
    if (ring) {
      std::vector<Segment2> outside;
      for (const Segment2& part : parts) {
        const std::vector<Segment2> rest =
            outside_circle(part, ring->middle, radius_of(picture.letter, ring->height));
        outside.insert(outside.end(), rest.begin(), rest.end());
      }
      parts = std::move(outside);
      PageMarks marks = ring_of(picture.letter, ring->middle, ring->height);
      draw(marks.lines.front());
      add_texts(marks.texts);
      pieces_[own_].group.texts.push_back(std::move(marks.texts.front()));
      if (ring->leader) {
        draw(*ring->leader);
      }
    }
    for (const Segment2& part : parts) {
      draw(part);
    }
  }

 private:
  struct Ring {
    Vec2 middle;
    double height;
    std::optional<Segment2> leader;  ///< from the frame
  };

  void add_line(const Line& line) {
    for (const Segment2& segment : segments_of(line)) {
      obstacles_.add(segment, line.layer == Layer::cut || line.layer == Layer::tab_fold
                                  ? Obstacles::Kind::cut
                                  : Obstacles::Kind::fold);
      lines_.push_back(segment);
    }
  }
  void add_texts(const std::vector<Text>& texts) {
    for (const Text& text : texts) {
      obstacles_.add(text);
      texts_.push_back(text);
    }
  }

  void draw(Line line) {
    add_line(line);
    pieces_[own_].group.lines.push_back(std::move(line));
  }
  void draw(const Segment2& segment) {
    Line line{Layer::mark, {segment.a, segment.b}, false, Fold::none};
    line.like = Layer::label;
    draw(std::move(line));
  }

  [[nodiscard]] bool on_another(Vec2 p) const {
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      if (i != own_ && lies_in(p, boxes_[i]) && inside(closed_[i], p)) {
        return true;
      }
    }
    return false;
  }

  /// Each side of a frame where nothing is in its way, counterclockwise from the lower left corner.
  [[nodiscard]] std::vector<Segment2> free_parts(const Box2& frame) const {
    std::vector<Segment2> near;
    const Box2 around = grown(frame, beside_mm);
    std::ranges::copy_if(lines_, std::back_inserter(near),
                         [&](const Segment2& line) { return clipped(line, around).has_value(); });
    const std::array<Vec2, 4> corners{
        frame.low, {frame.high.x, frame.low.y}, frame.high, {frame.low.x, frame.high.y}};
    std::vector<Segment2> parts;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Segment2 side{corners[i], corners[(i + 1) % corners.size()]};
      for (const Segment2& part : clear_of_lines(side, near)) {
        for (const Segment2& rest : beside_texts(part, texts_)) {
          if (length(rest.b - rest.a) > shortest_part_mm) {
            parts.push_back(rest);
          }
        }
      }
    }
    return parts;
  }

  [[nodiscard]] std::vector<Segment2> clear_of_lines(const Segment2& side,
                                                     const std::vector<Segment2>& near) const {
    const double size = length(side.b - side.a);
    const int steps = static_cast<int>(std::ceil(size / step_mm));
    const auto at = [&](double step) { return side.a + step / steps * (side.b - side.a); };
    const auto clear = [&](int step) {
      const Vec2 p = at(step + 0.5);
      return !on_another(p) &&
             std::ranges::none_of(near, [&](const Segment2& line) { return runs_beside(side, line, p); });
    };
    std::vector<Segment2> parts;
    int from = 0;
    for (int step = 0; step <= steps; ++step) {
      if (step == steps || !clear(step)) {
        if (step > from) {
          parts.push_back({at(from), at(step)});
        }
        from = step + 1;
      }
    }
    return parts;
  }

  /// Whether a line runs along the side near its point p.
  static bool runs_beside(const Segment2& side, const Segment2& line, Vec2 p) {
    const Vec2 d = line.b - line.a;
    const Vec2 along = side.b - side.a;
    if (std::abs(cross(along, d)) > beside_sine * length(along) * length(d)) {
      return false;
    }
    const double size = dot(d, d);
    const double t = size > 0.0 ? std::clamp(dot(p - line.a, d) / size, 0.0, 1.0) : 0.0;
    return length(p - line.a - t * d) < beside_mm;
  }

  [[nodiscard]] std::optional<Ring> place_ring(const std::vector<Segment2>& parts, const Box2& frame,
                                               std::string_view letter) const {
    // What is cut away tells nothing any more when the piece is folded.
    for (const bool on_the_piece : {true, false}) {
      for (const double height : letter_heights) {
        for (const Segment2& part : parts) {
          if (const auto ring = on_part(part, letter, height, on_the_piece)) {
            return ring;
          }
        }
        if (const auto ring = in_frame(frame, letter, height, on_the_piece)) {
          return ring;
        }
      }
      for (const double height : letter_heights) {
        for (const Segment2& part : parts) {
          if (const auto ring = with_leader_from(part, frame, letter, height, on_the_piece)) {
            return ring;
          }
        }
      }
    }
    return std::nullopt;
  }

  /// Nowhere near the frame's sides, but within it.
  [[nodiscard]] std::optional<Ring> in_frame(const Box2& frame, std::string_view letter, double height,
                                             bool on_the_piece) const {
    const double radius = radius_of(letter, height);
    for (double y = frame.low.y + radius; y + radius <= frame.high.y; y += ring_step_mm) {
      for (double x = frame.low.x + radius; x + radius <= frame.high.x; x += ring_step_mm) {
        if (has_room({x, y}, radius, on_the_piece)) {
          return Ring{{x, y}, height, {}};
        }
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Ring> on_part(const Segment2& part, std::string_view letter, double height,
                                            bool on_the_piece) const {
    std::optional<Ring> ring;
    any_place(part, [&](Vec2 p) {
      if (has_room(p, radius_of(letter, height), on_the_piece)) {
        ring = Ring{p, height, {}};
      }
      return ring.has_value();
    });
    return ring;
  }

  [[nodiscard]] std::optional<Ring> with_leader_from(const Segment2& part, const Box2& frame,
                                                     std::string_view letter, double height,
                                                     bool on_the_piece) const {
    const double radius = radius_of(letter, height);
    const Vec2 to_middle = 0.5 * (frame.low + frame.high) - part.a;
    const Vec2 inward = perpendicular(part.b - part.a) / length(part.b - part.a);
    const Vec2 out = dot(inward, to_middle) > 0.0 ? -inward : inward;
    std::optional<Ring> ring;
    any_place(part, [&](Vec2 p) {
      for (const double turn : leader_turns_rad) {
        const Vec2 along = elementary::cos(turn) * out + elementary::sin(turn) * perpendicular(out);
        for (double reach = shortest_leader_mm; reach < longest_leader_mm; reach += ring_step_mm) {
          const Vec2 middle = p + (reach + radius) * along;
          const Segment2 leader{p + off_the_edge_mm * along, p + reach * along};
          if (!obstacles_.is_free(leader, false)) {
            break;
          }
          if (has_room(middle, radius, on_the_piece) && can_lead(leader, out, obstacles_)) {
            ring = Ring{middle, height, leader};
            return true;
          }
        }
      }
      return false;
    });
    return ring;
  }

  /// Calls take(place) for places along a part of a frame, its middle first, until it returns true.
  template <class Take>
  static void any_place(const Segment2& part, Take take) {
    const double size = length(part.b - part.a);
    const Vec2 along = (part.b - part.a) / size;
    const Vec2 middle = 0.5 * (part.a + part.b);
    for (double away = 0.0; away <= 0.5 * size; away += ring_step_mm) {
      if (take(middle + away * along) || (away > 0.0 && take(middle - away * along))) {
        return;
      }
    }
  }

  [[nodiscard]] bool has_room(Vec2 middle, double radius, bool on_the_piece) const {
    const Box2 box{middle - Vec2{radius, radius}, middle + Vec2{radius, radius}};
    // Tabs are hidden when the piece is glued.
    return lies_in(box.low, area_) && lies_in(box.high, area_) &&
           obstacles_.is_free(TurnedBox{middle, {1.0, 0.0}, radius, radius}, 0.0, ring_clearance_mm) &&
           !on_another(middle) && !inside(tabs_[own_], middle) &&
           (!on_the_piece || inside(closed_[own_], middle));
  }

  std::vector<PieceDrawing>& pieces_;
  Box2 area_;
  Obstacles obstacles_;
  std::vector<Segment2> lines_;
  std::vector<Text> texts_;
  std::vector<std::vector<std::vector<Vec2>>> closed_;  ///< of each piece and picture its closed lines
  std::vector<Box2> boxes_;                             ///< around these
  std::vector<std::vector<std::vector<Vec2>>> tabs_;    ///< of each piece
  std::size_t own_ = 0;                                 ///< the piece whose place is marked
};

}  // namespace

std::string picture_letter(std::size_t number) {
  constexpr std::string_view letters = "abcdefghjkmnpqrstuvwxyz";
  std::string name;
  for (std::size_t rest = number + 1; rest > 0; rest = (rest - 1) / letters.size()) {
    name.insert(name.begin(), letters[(rest - 1) % letters.size()]);
  }
  return name;
}

double ring_radius(std::string_view letter) {
  return radius_of(letter, letter_heights.front());
}

PageMarks ringed(std::string_view letter, Vec2 middle) {
  return ring_of(letter, middle, letter_heights.front());
}

void mark_places(std::vector<PieceDrawing>& pieces, std::span<const PicturePlace> pictures,
                 const PageMarks& beside, Vec2 page_size, const Box2& area) {
  if (std::ranges::all_of(pictures, [](const PicturePlace& p) { return p.letter.empty(); })) {
    return;
  }
  Marker marker(pieces, beside, page_size, area);
  for (const PicturePlace& picture : pictures) {
    if (!picture.letter.empty()) {
      marker.mark(picture);
    }
  }
}

}  // namespace ridgecraft::paper
