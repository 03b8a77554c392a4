// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/bodies/fit_prism.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "base/geometry.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr std::size_t cells = 48;

struct Window {
  PlaneFrame frame;
  Vec2 low;
  Vec2 cell;
};

/// One row of cells more all around, which nothing covers.
class Grid {
 public:
  Grid() : covered_(side * side, false) {}

  void cover(std::array<Vec2, 3> p) {
    const double doubled = cross(p[1] - p[0], p[2] - p[0]);
    if (doubled < 0.0) {
      std::swap(p[1], p[2]);
    }
    const auto [left, right] = range(p[0].x, p[1].x, p[2].x);
    const auto [bottom, top] = range(p[0].y, p[1].y, p[2].y);
    for (std::size_t y = bottom; y < top; ++y) {
      for (std::size_t x = left; x < right; ++x) {
        const Vec2 q{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          inside = inside && cross(p[(k + 1) % 3] - p[k], q - p[k]) >= 0.0;
        }
        if (inside) {
          covered_[(y + 1) * side + x + 1] = true;
        }
      }
    }
  }

  /// Cells that are covered, or that no way leads to from outside.
  [[nodiscard]] std::size_t count() const {
    std::vector<bool> outside(covered_.size(), false);
    std::vector<std::size_t> next{0};
    outside[0] = true;
    std::size_t reached = 0;
    while (!next.empty()) {
      const std::size_t at = next.back();
      next.pop_back();
      ++reached;
      const std::size_t x = at % side;
      const std::size_t y = at / side;
      const auto go = [&](bool possible, std::size_t to) {
        if (possible && !covered_[to] && !outside[to]) {
          outside[to] = true;
          next.push_back(to);
        }
      };
      go(x > 0, at - 1);
      go(x + 1 < side, at + 1);
      go(y > 0, at - side);
      go(y + 1 < side, at + side);
    }
    return covered_.size() - reached;
  }

 private:
  static constexpr std::size_t side = cells + 2;

  static std::pair<std::size_t, std::size_t> range(double a, double b, double c) {
    const auto inside = [](double x) {
      return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(cells)));
    };
    return {inside(std::floor(std::min({a, b, c}))), inside(std::ceil(std::max({a, b, c})))};
  }

  std::vector<bool> covered_;
};

std::size_t cells_covered(const mesh::Surface& surface, const Window& window) {
  Grid grid;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    std::array<Vec2, 3> corners;
    for (unsigned k = 0; k < 3; ++k) {
      const Vec2 p = window.frame.flat(surface.point(surface.vertices(f)[k])) - window.low;
      corners[k] = {p.x / window.cell.x, p.y / window.cell.y};
    }
    grid.cover(corners);
  }
  return grid.count();
}

}  // namespace

double silhouette_fraction(const mesh::Surface& body, const mesh::Surface& larger, Vec3 direction) {
  const PlaneFrame frame({}, direction);
  Vec2 low{INFINITY, INFINITY};
  Vec2 high{-INFINITY, -INFINITY};
  for (const Vec3 p : larger.points()) {
    const Vec2 flat = frame.flat(p);
    low = {std::min(low.x, flat.x), std::min(low.y, flat.y)};
    high = {std::max(high.x, flat.x), std::max(high.y, flat.y)};
  }
  const Window window{frame, low, (1.0 / static_cast<double>(cells)) * (high - low)};
  if (!(window.cell.x > 0.0 && window.cell.y > 0.0)) {
    return 0.0;
  }
  const std::size_t all = cells_covered(larger, window);
  return all == 0 ? 0.0 : static_cast<double>(cells_covered(body, window)) / static_cast<double>(all);
}

namespace {

/// Sides that turn more towards each other don't meet anywhere near (cosine of 135 degrees).
constexpr double sharpest = -0.71;
/// The outlines of both halves of a body have this share of the area of the whole one's; else it tapers.
constexpr double straight = 0.6;
/// Sides and turns of an outline that differ by less, as a share of its size or in radians, are equal.
constexpr double alike = 1e-3;
/// Corners that are off by less, as a share of an outline's size, are so by rounding.
constexpr double rounding = 1e-5;
/// Areas that differ by less, as a share, are equal.
constexpr double same_area = 1e-6;

constexpr double never = std::numeric_limits<double>::infinity();

/// The hull of points, without corners that are none but for rounding: those that are nearer to the one
/// before, or to the line between those beside them, than `near`.
std::vector<Vec2> convex_outline(std::vector<Vec2> points, double near) {
  std::vector<Vec2> apart;
  for (const Vec2 p : convex_hull(std::move(points))) {
    if (apart.empty() || length(p - apart.back()) > near) {
      apart.push_back(p);
    }
  }
  while (apart.size() > 1 && length(apart.back() - apart.front()) <= near) {
    apart.pop_back();
  }
  std::vector<Vec2> result;
  const auto is_corner = [&](Vec2 before, Vec2 p, Vec2 after) {
    const Vec2 way = after - before;
    return std::abs(cross(way, p - before)) > near * length(way);
  };
  for (std::size_t i = 0; i < apart.size(); ++i) {
    const Vec2 before = result.empty() ? apart.back() : result.back();
    if (is_corner(before, apart[i], apart[(i + 1) % apart.size()])) {
      result.push_back(apart[i]);
    }
  }
  return result;
}

double area_of(const std::vector<Vec2>& outline) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    doubled += cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  return 0.5 * doubled;
}

/// A convex outline by the straight lines that its sides lie on, of which some go.
class Sides {
 public:
  explicit Sides(const std::vector<Vec2>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i];
      const Vec2 b = outline[(i + 1) % outline.size()];
      const double size = length(b - a);
      if (size > 0.0) {
        all_.push_back({a, (1.0 / size) * (b - a)});
        lengths_.push_back(size);
      }
    }
    for (std::size_t i = 0; i < all_.size(); ++i) {
      left_.push_back(i);
    }
    area_ = area_of(outline);
    find_mirror();
  }

  [[nodiscard]] std::vector<Vec2> outline() const { return outline_of(left_); }

  /// Leaves out short sides, those that add least area first, and then the others until few are left. Each
  /// step looks at every side.
  void make_block_proxies(double short_side, std::size_t most_sides) {
    for (;;) {
      const bool too_many = left_.size() > most_sides;
      double least = never;
      std::size_t best = 0;
      for (std::size_t k = 0; k < left_.size(); ++k) {
        if (side_length(k) >= short_side && !too_many) {
          continue;
        }
        const double added = added_without(k);
        if (added < least - same_area * area_) {
          least = added;
          best = k;
        }
      }
      if (least == never) {
        return;
      }
      const std::size_t side = left_[best];
      const std::size_t other = partner_[side];
      std::erase_if(left_, [&](std::size_t s) { return s == side || s == other; });
    }
  }

 private:
  struct Line {
    Vec2 through;
    Vec2 way;  ///< counterclockwise around what it bounds, of length 1
  };

  [[nodiscard]] std::size_t count() const { return left_.size(); }
  /// Of those that are left, counted on from one and around.
  [[nodiscard]] const Line& line(std::size_t k) const { return all_[left_[k % count()]]; }
  [[nodiscard]] double side_length(std::size_t k) const {
    return length(meeting(line(k), line(k + 1)) - meeting(line(k + count() - 1), line(k)));
  }

  /// The area that sides `first` to `last` cut off where those beside them would meet; never where they
  /// don't.
  [[nodiscard]] double cut_off(std::size_t first, std::size_t last) const {
    const Line& before = line(first + count() - 1);
    const Line& after = line(last + 1);
    if (cross(before.way, after.way) <= 0.0 || dot(before.way, after.way) < sharpest) {
      return never;
    }
    std::vector<Vec2> corners{meeting(before, after)};
    for (std::size_t k = last + 1; k-- > first;) {
      corners.push_back(meeting(line(k), line(k + 1)));
    }
    corners.push_back(meeting(before, line(first)));
    return area_of(corners);
  }

  /// For each of the sides that go, with one its mirror image.
  [[nodiscard]] double added_without(std::size_t k) const {
    const auto at = std::lower_bound(left_.begin(), left_.end(), partner_[left_[k]]);
    const auto other = static_cast<std::size_t>(at - left_.begin());
    const std::size_t gone = other == k ? 1 : 2;
    if (count() < 3 + gone) {
      return never;
    }
    if ((k + 1) % count() == other) {
      return 0.5 * cut_off(k, k + 1);
    }
    if ((other + 1) % count() == k) {
      return 0.5 * cut_off(k + count() - 1, k + count());
    }
    return cut_off(k + count(), k + count());
  }

  /// Where two sides that follow each other meet.
  [[nodiscard]] static Vec2 meeting(const Line& a, const Line& b) {
    const double t = cross(b.through - a.through, b.way) / cross(a.way, b.way);
    return a.through + t * a.way;
  }

  /// Corner k is where side k begins.
  [[nodiscard]] std::vector<Vec2> outline_of(const std::vector<std::size_t>& sides) const {
    std::vector<Vec2> result;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      result.push_back(meeting(all_[sides[(k + sides.size() - 1) % sides.size()]], all_[sides[k]]));
    }
    return result;
  }

  /// Each side's mirror image about the first axis that there is; itself where there is none.
  void find_mirror() {
    const std::size_t count = all_.size();
    const double near = alike * *std::max_element(lengths_.begin(), lengths_.end());
    const auto turn = [&](std::size_t i) {
      const Vec2 a = all_[i % count].way;
      const Vec2 b = all_[(i + 1) % count].way;
      return cross(a, b);
    };
    for (std::size_t sum = 0; sum < count; ++sum) {
      bool mirrored = true;
      for (std::size_t i = 0; i < count && mirrored; ++i) {
        const std::size_t other = (sum + count - i) % count;
        mirrored = std::abs(lengths_[i] - lengths_[other]) <= near &&
                   std::abs(turn(i) - turn(other + count - 1)) <= alike;
      }
      if (mirrored) {
        for (std::size_t i = 0; i < count; ++i) {
          partner_.push_back((sum + count - i) % count);
        }
        return;
      }
    }
    partner_ = left_;
  }

  double area_ = 0.0;
  std::vector<Line> all_;
  std::vector<double> lengths_;
  std::vector<std::size_t> left_;
  std::vector<std::size_t> partner_;
};

std::optional<Prism> prism_along(std::span<const Vec3> points, Vec3 direction, const PrismRules& rules) {
  const PlaneFrame across({}, direction);
  double low = never;
  double high = -never;
  for (const Vec3 p : points) {
    low = std::min(low, dot(p, direction));
    high = std::max(high, dot(p, direction));
  }
  if (!(high - low >= rules.shallow)) {
    return std::nullopt;
  }
  const double middle = 0.5 * (low + high);
  const double hair = alike * (high - low);
  std::vector<Vec2> all;
  std::vector<Vec2> lower;
  std::vector<Vec2> upper;
  for (const Vec3 p : points) {
    const Vec2 flat = across.flat(p);
    const double height = dot(p, direction) - middle;
    all.push_back(flat);
    if (height <= hair) {
      lower.push_back(flat);
    }
    if (height >= -hair) {
      upper.push_back(flat);
    }
  }
  Box2 box;
  for (const Vec2 p : all) {
    box.add(p);
  }
  const double near = rounding * length(box.size());
  const std::vector<Vec2> outline = convex_outline(std::move(all), near);
  const double area = outline.size() < 3 ? 0.0 : area_of(outline);
  if (!(area > 0.0) || area_of(convex_outline(std::move(lower), near)) < straight * area ||
      area_of(convex_outline(std::move(upper), near)) < straight * area) {
    return std::nullopt;
  }
  Sides sides(outline);
  sides.make_block_proxies(rules.short_side, rules.most_sides);
  Prism prism;
  for (const Vec2 p : sides.outline()) {
    prism.base.push_back(across.place(p) + low * direction);
  }
  prism.along = (high - low) * direction;
  return prism;
}

}  // namespace

double Prism::volume() const {
  Vec3 doubled;
  for (std::size_t i = 1; i + 1 < base.size(); ++i) {
    doubled += cross(base[i] - base[0], base[i + 1] - base[0]);
  }
  return 0.5 * dot(doubled, along);
}

std::optional<Prism> fit_prism(std::span<const Vec3> points, std::span<const Vec3> directions,
                               const PrismRules& rules) {
  std::optional<Prism> best;
  for (const Vec3 direction : directions) {
    std::optional<Prism> prism = prism_along(points, direction, rules);
    if (prism && std::isfinite(prism->volume()) &&
        (!best || prism->volume() < (1.0 - same_area) * best->volume())) {
      best = std::move(prism);
    }
  }
  return best;
}

}  // namespace ridgecraft::prepare
