// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/details/plain_prism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

namespace ridgecraft::prepare {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Sides that turn more towards each other don't meet anywhere near (cosine of 135 degrees).
constexpr double sharpest = -0.71;
/// The outlines of both halves of a body have this share of the area of the whole one's; else it tapers.
constexpr double straight = 0.6;
/// Sides and turns of an outline that differ by less, as a share of its size or in radians, are equal.
constexpr double alike = 1e-3;
/// Areas that differ by less, as a share, are equal.
constexpr double same_area = 1e-6;

constexpr double never = std::numeric_limits<double>::infinity();

std::vector<Vec2> convex_outline(const std::vector<Vec2>& points) {
  std::vector<Kernel::Point_2> all;
  all.reserve(points.size());
  for (const Vec2 p : points) {
    all.emplace_back(p.x, p.y);
  }
  std::vector<Kernel::Point_2> hull;
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));
  std::vector<Vec2> result;
  result.reserve(hull.size());
  for (const Kernel::Point_2& p : hull) {
    result.push_back({p.x(), p.y()});
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
    find_mirror();
  }

  [[nodiscard]] std::vector<Vec2> outline() const { return outline_of(left_); }

  /// Leaves out short sides, those that add least area first, and then the others until few are left.
  void make_plain(double short_side, std::size_t most_sides) {
    for (;;) {
      const std::vector<Vec2> corners = outline();
      const bool too_many = left_.size() > most_sides;
      double least = never;
      std::vector<std::size_t> best;
      for (std::size_t k = 0; k < left_.size(); ++k) {
        const double size = length(corners[(k + 1) % corners.size()] - corners[k]);
        if (size >= short_side && !too_many) {
          continue;
        }
        const std::size_t other = partner_[left_[k]];
        std::vector<std::size_t> rest;
        std::copy_if(left_.begin(), left_.end(), std::back_inserter(rest),
                     [&](std::size_t s) { return s != left_[k] && s != other; });
        if (rest.size() < 3 || !is_closed(rest)) {
          continue;
        }
        const double each = other == left_[k] ? 1.0 : 2.0;
        const double added = (area_of(outline_of(rest)) - area_of(corners)) / each;
        if (added < least - same_area * area_of(corners)) {
          least = added;
          best = std::move(rest);
        }
      }
      if (best.empty()) {
        return;
      }
      left_ = std::move(best);
    }
  }

 private:
  struct Line {
    Vec2 through;
    Vec2 way;  ///< counterclockwise around what it bounds, of length 1
  };

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

  [[nodiscard]] bool is_closed(const std::vector<std::size_t>& sides) const {
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const Vec2 a = all_[sides[k]].way;
      const Vec2 b = all_[sides[(k + 1) % sides.size()]].way;
      if (cross(a, b) <= 0.0 || dot(a, b) < sharpest) {
        return false;
      }
    }
    return true;
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

  std::vector<Line> all_;
  std::vector<double> lengths_;
  std::vector<std::size_t> left_;
  std::vector<std::size_t> partner_;
};

/// Coordinates across a direction, and back.
struct Across {
  Vec3 along;
  Vec3 right;
  Vec3 up;

  explicit Across(Vec3 direction) : along(direction) {
    const Vec3 size{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    right = normalized(cross(axis, direction));
    up = cross(direction, right);
  }
  [[nodiscard]] Vec2 flat(Vec3 p) const { return {dot(p, right), dot(p, up)}; }
  [[nodiscard]] Vec3 place(Vec2 p, double height) const { return p.x * right + p.y * up + height * along; }
};

std::optional<Prism> prism_along(std::span<const Vec3> points, Vec3 direction, const PrismRules& rules) {
  const Across across(direction);
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
  const std::vector<Vec2> outline = convex_outline(all);
  const double area = outline.size() < 3 ? 0.0 : area_of(outline);
  if (!(area > 0.0) || area_of(convex_outline(lower)) < straight * area ||
      area_of(convex_outline(upper)) < straight * area) {
    return std::nullopt;
  }
  Sides sides(outline);
  sides.make_plain(rules.short_side, rules.most_sides);
  Prism prism;
  for (const Vec2 p : sides.outline()) {
    prism.base.push_back(across.place(p, low));
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

std::optional<Prism> plain_prism(std::span<const Vec3> points, std::span<const Vec3> directions,
                                 const PrismRules& rules) {
  std::optional<Prism> best;
  for (const Vec3 direction : directions) {
    std::optional<Prism> prism = prism_along(points, direction, rules);
    if (prism && (!best || prism->volume() < (1.0 - same_area) * best->volume())) {
      best = std::move(prism);
    }
  }
  return best;
}

}  // namespace ridgecraft::prepare
