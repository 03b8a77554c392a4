// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/obstacles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double cell_mm = 6.0;  ///< about the size of a number with its surroundings
/// Blank that a text keeps before and behind it, as a share of its height; two of them are wider than the
/// blanks between the digits of either number.
constexpr double blank_fraction = 0.22;
/// Words keep so many times as much away.
constexpr double blanks_beside_words = 2.5;
/// Half the distance of texts above each other, mm.
constexpr double half_line_gap = 0.2;
/// Lines run along each other over more than this length.
constexpr double beside_length_mm = 1.0;

std::array<Vec2, 4> corners(const TurnedBox& box) {
  const Vec2 u = box.half_width * box.along;
  const Vec2 v = box.half_height * perpendicular(box.along);
  return {box.centre - u - v, box.centre + u - v, box.centre + u + v, box.centre - u + v};
}

/// Whether the boxes are apart along an axis of the first.
bool apart(const TurnedBox& a, const TurnedBox& b, Vec2 axis, double half) {
  const double reach = b.half_width * std::abs(dot(axis, b.along)) +
                       b.half_height * std::abs(dot(axis, perpendicular(b.along)));
  return std::abs(dot(axis, b.centre - a.centre)) >= half + reach;
}

}  // namespace

Box2 TurnedBox::bounds() const {
  Box2 box;
  for (const Vec2 corner : corners(*this)) {
    box.add(corner);
  }
  return box;
}

TurnedBox box_of(const Text& text) {
  const Vec2 along{elementary::cos(text.angle), elementary::sin(text.angle)};
  const double drop = text.underlined ? underline_drop * text.height : 0.0;
  return {text.centre - 0.5 * drop * perpendicular(along), along, 0.5 * text_width(text.text, text.height),
          0.5 * (text.height + drop)};
}

double spacing_height(const Text& text) {
  return (text.layer == Layer::piece_name ? blanks_beside_words : 1.0) * text.height;
}

TurnedBox with_spacing(TurnedBox box, double height) {
  box.half_width += blank_fraction * height;
  box.half_height += half_line_gap;
  return box;
}

bool overlap(const TurnedBox& a, const TurnedBox& b) {
  return !apart(a, b, a.along, a.half_width) && !apart(a, b, perpendicular(a.along), a.half_height) &&
         !apart(b, a, b.along, b.half_width) && !apart(b, a, perpendicular(b.along), b.half_height);
}

bool meets(const Segment2& segment, const TurnedBox& box) {
  const Vec2 up = perpendicular(box.along);
  const Vec2 a{dot(segment.a - box.centre, box.along), dot(segment.a - box.centre, up)};
  const Vec2 b{dot(segment.b - box.centre, box.along), dot(segment.b - box.centre, up)};
  // Separating axes: the box's two, and the segment's normal.
  if (std::min(a.x, b.x) > box.half_width || std::max(a.x, b.x) < -box.half_width ||
      std::min(a.y, b.y) > box.half_height || std::max(a.y, b.y) < -box.half_height) {
    return false;
  }
  const Vec2 d = b - a;
  return std::abs(cross(d, a)) <= box.half_width * std::abs(d.y) + box.half_height * std::abs(d.x);
}

Obstacles::Obstacles(Vec2 page_size)
    : size_(page_size),
      columns_(static_cast<std::uint32_t>(std::ceil(page_size.x / cell_mm)) + 1),
      rows_(static_cast<std::uint32_t>(std::ceil(page_size.y / cell_mm)) + 1),
      cells_(std::size_t{columns_} * rows_) {}

template <class Visit>
bool Obstacles::any_cell(const Box2& bounds, Visit visit) const {
  const auto index = [](double at, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(at / cell_mm), 0.0, count - 1.0));
  };
  const std::uint32_t last_column = index(bounds.high.x, columns_);
  const std::uint32_t last_row = index(bounds.high.y, rows_);
  for (std::uint32_t row = index(bounds.low.y, rows_); row <= last_row; ++row) {
    for (std::uint32_t column = index(bounds.low.x, columns_); column <= last_column; ++column) {
      if (visit(row * columns_ + column)) {
        return true;
      }
    }
  }
  return false;
}

std::vector<std::uint32_t> Obstacles::cells_of(const Box2& bounds) const {
  std::vector<std::uint32_t> cells;
  any_cell(bounds, [&](std::uint32_t cell) {
    cells.push_back(cell);
    return false;
  });
  return cells;
}

void Obstacles::add(const Segment2& line, Kind kind) {
  // Long lines in short pieces, so that a slanting one doesn't fill its whole bounding box of cells.
  const int pieces = std::max(1, static_cast<int>(std::ceil(length(line.b - line.a) / (2.0 * cell_mm))));
  for (int i = 0; i < pieces; ++i) {
    const Segment2 piece{line.a + (line.b - line.a) * (static_cast<double>(i) / pieces),
                         line.a + (line.b - line.a) * ((i + 1.0) / pieces)};
    Box2 bounds;
    bounds.add(piece.a);
    bounds.add(piece.b);
    const auto number = static_cast<std::uint32_t>(lines_.size());
    lines_.push_back({piece, kind});
    for (const std::uint32_t cell : cells_of(bounds)) {
      cells_[cell].lines.push_back(number);
    }
  }
}

std::uint32_t Obstacles::add(const Text& text) {
  const auto number = static_cast<std::uint32_t>(boxes_.size());
  boxes_.emplace_back();
  replace(number, text);
  return number;
}

void Obstacles::replace(std::uint32_t number, const Text& text) {
  const TurnedBox box = box_of(text);
  boxes_[number] = {box, with_spacing(box, spacing_height(text))};
  for (const std::uint32_t cell : cells_of(boxes_[number].room.bounds())) {
    std::vector<std::uint32_t>& here = cells_[cell].boxes;
    if (std::ranges::find(here, number) == here.end()) {
      here.push_back(number);
    }
  }
}

bool Obstacles::is_free(const TurnedBox& text, double height, double clearance, double more,
                        std::uint32_t but) const {
  const TurnedBox box = text.grown(clearance + more);
  const Box2 bounds = box.bounds();
  if (bounds.low.x < 0.0 || bounds.low.y < 0.0 || bounds.high.x > size_.x || bounds.high.y > size_.y) {
    return false;
  }
  const bool on_line = any_cell(bounds, [&](std::uint32_t cell) {
    return std::ranges::any_of(cells_[cell].lines,
                               [&](std::uint32_t i) { return meets(lines_[i].line, box); });
  });
  if (on_line) {
    return false;
  }
  const TurnedBox room = with_spacing(text, height).grown(more);
  return !any_cell(room.bounds(), [&](std::uint32_t cell) {
    return std::ranges::any_of(cells_[cell].boxes,
                               [&](std::uint32_t i) { return i != but && overlap(boxes_[i].room, room); });
  });
}

bool Obstacles::is_free(const Segment2& line, bool folds_too) const {
  Box2 bounds;
  bounds.add(line.a);
  bounds.add(line.b);
  return !any_cell(bounds, [&](std::uint32_t cell) {
    return std::ranges::any_of(cells_[cell].lines,
                               [&](std::uint32_t i) {
                                 return (folds_too || lines_[i].kind == Kind::cut) &&
                                        cross_each_other(lines_[i].line, line);
                               }) ||
           std::ranges::any_of(cells_[cell].boxes,
                               [&](std::uint32_t i) { return meets(line, boxes_[i].box); });
  });
}

double Obstacles::distance_to_lines(Vec2 p, double most) const {
  Box2 bounds;
  bounds.add(p - Vec2{most, most});
  bounds.add(p + Vec2{most, most});
  double nearest = most;
  any_cell(bounds, [&](std::uint32_t cell) {
    for (const std::uint32_t i : cells_[cell].lines) {
      const Segment2& line = lines_[i].line;
      const Vec2 d = line.b - line.a;
      const double size = dot(d, d);
      const double t = size > 0.0 ? std::clamp(dot(p - line.a, d) / size, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, length(p - line.a - t * d));
    }
    return false;
  });
  return nearest;
}

bool Obstacles::runs_along_another(const Segment2& line) const {
  const double size = length(line.b - line.a);
  if (!(size > beside_length_mm)) {
    return false;
  }
  const Vec2 along = (line.b - line.a) / size;
  Box2 bounds;
  for (const Vec2 end : {line.a, line.b}) {
    bounds.add(end - Vec2{beside_mm, beside_mm});
    bounds.add(end + Vec2{beside_mm, beside_mm});
  }
  const auto beside = [&](const Segment2& other) {
    const Vec2 d = other.b - other.a;
    const double t0 = dot(along, other.a - line.a);
    const double t1 = dot(along, other.b - line.a);
    const double from = std::max(0.0, std::min(t0, t1));
    const double to = std::min(size, std::max(t0, t1));
    if (to - from < beside_length_mm || std::abs(cross(along, d)) > beside_sine * length(d)) {
      return false;
    }
    const auto away = [&](double t) {
      return cross(along, other.a - line.a) + (t - t0) / (t1 - t0) * cross(along, d);
    };
    return std::min(std::abs(away(from)), std::abs(away(to))) < beside_mm || away(from) * away(to) < 0.0;
  };
  return any_cell(bounds, [&](std::uint32_t cell) {
    return std::ranges::any_of(cells_[cell].lines, [&](std::uint32_t i) { return beside(lines_[i].line); });
  });
}

}  // namespace ridgecraft::export_
