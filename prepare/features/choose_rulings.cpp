// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/choose_rulings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr double one_degree = std::numbers::pi / 180.0;
/// Larger folds are edges of something, whose lines stay: a prism of 11 sides has 33 degrees. ...
constexpr double soft = 31.0 * one_degree;
/// ... Between faces that nobody can cut, narrower than this share of the short edge, edges may be larger: a
/// post of eight sides becomes one of four.
constexpr double soft_between_narrow = 46.0 * one_degree;
constexpr double very_narrow = 0.5;
/// ... unless they are this near, as a share of the short edge, to where the faces beside them would meet
/// without them: something uneven, no edge.
constexpr double uneven = 0.05;
/// What a face takes the place of is off it by this share of its width at most: a circle keeps six sides
/// (each is off by (1 - cos 30)/(2 sin 30)); ...
constexpr double widest_arc = 0.135;
/// ... and by this share where it is narrow all the same: a rounded corner becomes a bevel.
constexpr double narrow_arc = 0.21;
/// ... and by this share where the strip is rolled, so that it still is: 12 sides bend by 30 degrees.
constexpr double rolled_arc = 0.066;
/// Lines nearer to each other than this share of the short edge needn't all be tried.
constexpr double close = 0.1;
/// The surface moves by this share of what it may at most, since more is done to it afterwards, ...
constexpr double movable = 0.5;
/// ... of something round of this share of its thickness, ...
constexpr double of_thickness = 0.12;
/// ... and moving by this share costs as much as a face as narrow as a fold is short.
constexpr double unseen = 0.25;
/// What a face costs besides where it is too narrow.
constexpr double too_narrow = 2.0;
/// Faces of this many short edges stay as they are, be it that one beside them is narrow.
constexpr double wide_enough = 1.5;
/// Faces of this many short edges needn't become wider.
constexpr double wide = 4.0;
/// What a division of a round strip into unequal shares costs besides, as a share; ...
constexpr double unequal = 0.15;
/// ... and one that has no mirror plane where the strip has some.
constexpr double lopsided = 1.0;
/// Widths and moves that differ by less, as a share of the short edge, are equal.
constexpr double ruled_alike = 1e-3;

/// Costs that differ by this share are equal.
constexpr double same_cost = 1e-6;

constexpr double never = std::numeric_limits<double>::infinity();

class RulingChooser {
 public:
  RulingChooser(const mesh::Surface& surface, const RuledStrip& strip, const RulingRules& rules)
      : surface_(surface),
        strip_(strip),
        rules_(rules),
        count_(strip.lines.size()),
        most_mm_(std::min(movable * rules.largest_mm, of_thickness * thickness())) {}

  ChosenRulings run() {
    ChosenRulings result;
    result.narrowest = never;
    for (std::size_t i = 0; i < strip_.regions.size(); ++i) {
      result.narrowest = std::min(result.narrowest, width(i, i + 1));
    }
    if (result.narrowest >= rules_.short_edge_mm) {
      return result;
    }
    const std::vector<std::size_t> edges = edge_lines();
    std::vector<bool> kept(count_, false);
    const auto keep = [&](const std::vector<std::size_t>& lines) {
      for (const std::size_t i : lines) {
        kept[i % count_] = true;
      }
    };
    if (edges.empty()) {
      const std::size_t begin = farthest_line();
      keep(is_regular() ? around(begin) : along(begin, begin + count_));
    }
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (k + 1 < edges.size() || strip_.round) {
        keep(along(edges[k], k + 1 < edges.size() ? edges[k + 1] : edges[0] + count_));
      }
    }
    for (std::size_t i = 0; i < count_; ++i) {
      if (!kept[i]) {
        result.gone.push_back(i);
      }
    }
    return result;
  }

 private:
  [[nodiscard]] Vec3 at(std::size_t line, std::size_t point) const {
    return surface_.point(VertexId(strip_.lines[line % count_].points[point]));
  }
  [[nodiscard]] std::size_t points() const { return strip_.lines.front().points.size(); }

  /// Of what a round strip goes around where it is thickest: that of a circle is its diameter.
  [[nodiscard]] double thickness() const {
    if (!strip_.round) {
      return never;
    }
    double most = 0.0;
    for (std::size_t t = 0; t < points(); ++t) {
      Vec3 doubled;
      double around = 0.0;
      for (std::size_t i = 0; i < count_; ++i) {
        doubled += cross(at(i, t) - at(0, t), at(i + 1, t) - at(0, t));
        around += length(at(i + 1, t) - at(i, t));
      }
      most = around > 0.0 ? std::max(most, 2.0 * length(doubled) / around) : most;  // 0 at a tip
    }
    return most;
  }

  /// Of a face between two lines: its longest side across; of one that is rolled its shortest, as each rim
  /// has teeth.
  [[nodiscard]] double width(std::size_t i, std::size_t j) const {
    double widest = 0.0;
    double narrowest = never;
    for (std::size_t t = 0; t < points(); ++t) {
      const double side = length(at(j, t) - at(i, t));
      widest = std::max(widest, side);
      narrowest = side > 0.0 ? std::min(narrowest, side) : narrowest;  // but for tips
    }
    return rules_.rolled ? std::min(widest, narrowest) : widest;
  }

  [[nodiscard]] bool is_flat(std::size_t i, std::size_t j) const {
    const std::size_t tiers = strip_.tiers();
    for (std::size_t t = 0; t < tiers; ++t) {
      const std::size_t u = (t + 1) % points();
      const std::array<Vec3, 4> p{at(i, t), at(j, t), at(j, u), at(i, u)};
      const Vec3 across = cross(p[2] - p[0], p[3] - p[1]);
      const double size = length(across);
      // The corners of a quadrilateral are equally far from the plane along both of its diagonals, but for a
      // half.
      if (size > 0.0 && std::abs(dot(p[1] - p[0], across)) > 2.0 * rules_.flat_mm * size) {
        return false;
      }
    }
    return true;
  }

  /// How far the surface moves where the lines between two go.
  struct Moved {
    double mm = 0.0;
    double arc = 0.0;  ///< as a share of the side there
  };
  [[nodiscard]] Moved moved(std::size_t i, std::size_t j) const {
    Moved most;
    for (std::size_t l = i + 1; l < j; ++l) {
      for (std::size_t t = 0; t < points(); ++t) {
        const Vec3 way = at(j, t) - at(i, t);
        const double squared = dot(way, way);
        const Vec3 from = at(l, t) - at(i, t);
        const double share = squared > 0.0 ? std::clamp(dot(from, way) / squared, 0.0, 1.0) : 0.0;
        const double mm = length(from - share * way);
        most.mm = std::max(most.mm, mm);
        most.arc = squared > 0.0 ? std::max(most.arc, mm / std::sqrt(squared)) : most.arc;
      }
    }
    return most;
  }

  /// Of one face from line i to line j.
  [[nodiscard]] double cost(std::size_t i, std::size_t j) const {
    const double wide_mm = width(i, j);
    const bool narrow = wide_mm < rules_.short_edge_mm;
    const Moved off = moved(i, j);
    const bool is_round =
        rules_.rolled ? off.arc <= rolled_arc : off.mm <= (narrow ? narrow_arc : widest_arc) * wide_mm;
    if (j > i + 1 && (off.mm > most_mm_ || !is_round || !is_flat(i, j))) {
      return never;
    }
    const double move = off.mm / (unseen * rules_.largest_mm);
    const double share = rules_.short_edge_mm / std::max(wide_mm, ruled_alike * rules_.short_edge_mm);
    return move * move + share * share + (narrow ? too_narrow : 0.0);
  }

  [[nodiscard]] double fold(std::size_t line) const { return strip_.lines[line % count_].fold; }

  /// Lines that stay in any case: where something has an edge, beside a face that is wide enough as it is,
  /// and the ends of what isn't round.
  [[nodiscard]] std::vector<std::size_t> edge_lines() const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < count_; ++i) {
      const bool end = !strip_.round && (i == 0 || i + 1 == count_);
      if (end || is_wide(i + count_ - 1) || is_wide(i) ||
          (fold(i) > softness(i) &&
           moved(i + count_ - 1, i + count_ + 1).mm > uneven * rules_.short_edge_mm)) {
        result.push_back(i);
      }
    }
    return result;
  }
  /// The largest fold at which a line isn't an edge.
  [[nodiscard]] double softness(std::size_t line) const {
    const double beside = std::max(width(line + count_ - 1, line + count_), width(line, line + 1));
    return beside < very_narrow * rules_.short_edge_mm ? soft_between_narrow : soft;
  }
  /// The face after a line.
  [[nodiscard]] bool is_wide(std::size_t line) const {
    return width(line, line + 1) >= wide_enough * rules_.short_edge_mm;
  }

  /// The lines from one that stays to the next one, counted from either of them.
  struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;  ///< how many lines on the other one is
    bool backwards = false;

    [[nodiscard]] std::size_t line(std::size_t i) const { return backwards ? first + last - i : first + i; }
  };
  [[nodiscard]] double width(const Stretch& stretch, std::size_t i, std::size_t j) const {
    return width(stretch.line(i), stretch.line(j));
  }
  [[nodiscard]] double cost(const Stretch& stretch, std::size_t i, std::size_t j) const {
    return cost(std::min(stretch.line(i), stretch.line(j)), std::max(stretch.line(i), stretch.line(j)));
  }

  /// Rounding doesn't count, or mirror images would be divided otherwise.
  [[nodiscard]] static bool is_less(double cost, double other) {
    return cost < never && (other == never || cost < other - same_cost * other);
  }

  struct Best {
    std::vector<double> cost;       ///< of the faces before each line
    std::vector<std::size_t> from;  ///< where the last of these begins
  };
  [[nodiscard]] Best best_to(const Stretch& stretch, std::size_t last) const {
    Best best;
    best.cost.assign(last + 1, never);
    best.from.assign(last + 1, 0);
    best.cost[0] = 0.0;
    const std::vector<std::size_t> stops = lines_apart(stretch, last);
    for (const std::size_t i : stops) {
      for (auto at = std::upper_bound(stops.begin(), stops.end(), i); at != stops.end(); ++at) {
        const std::size_t j = *at;
        // A face needn't become wider than this.
        if (j > i + 1 && width(stretch, i, j - 1) > wide * rules_.short_edge_mm) {
          break;
        }
        const double sum = best.cost[i] + cost(stretch, i, j);
        if (is_less(sum, best.cost[j])) {
          best.cost[j] = sum;
          best.from[j] = i;
        }
      }
    }
    return best;
  }

  /// Those of which others that are close needn't be tried, with both ends.
  [[nodiscard]] std::vector<std::size_t> lines_apart(const Stretch& stretch, std::size_t last) const {
    std::vector<std::size_t> result{0};
    for (std::size_t i = 1; i < last; ++i) {
      if (width(stretch, result.back(), i) >= close * rules_.short_edge_mm) {
        result.push_back(i);
      }
    }
    if (last > 0) {
      result.push_back(last);
    }
    return result;
  }

  /// All lines where no face between those that were tried is good enough.
  [[nodiscard]] static std::vector<std::size_t> lines_to(const Best& best, std::size_t last) {
    std::vector<std::size_t> result{last};
    if (best.cost[last] == never) {
      result.resize(last + 1);
      std::iota(result.begin(), result.end(), std::size_t{0});
      return result;
    }
    while (last > 0) {
      last = best.from[last];
      result.push_back(last);
    }
    std::reverse(result.begin(), result.end());
    return result;
  }

  /// Which lines stay from one that stays to the next one.
  [[nodiscard]] std::vector<std::size_t> along(std::size_t first, std::size_t end) const {
    Stretch stretch{first, end - first, false};
    std::vector<std::size_t> stays;
    if (const double lean = leaning(stretch); lean != 0.0) {
      stretch.backwards = lean < 0.0;  // so that a mirror image is divided as the mirror image
      stays = lines_to(best_to(stretch, stretch.last), stretch.last);
    } else {
      stays = along_mirrored(stretch);
    }
    for (std::size_t& i : stays) {
      i = stretch.line(i);
    }
    return stays;
  }

  /// Of one that is its own mirror image: half of it, and a face across the middle or a line there.
  [[nodiscard]] std::vector<std::size_t> along_mirrored(const Stretch& stretch) const {
    const Best best = best_to(stretch, (stretch.last + 1) / 2);
    double least = never;
    std::size_t half = stretch.last / 2;
    for (std::size_t i = 0; 2 * i <= stretch.last; ++i) {
      const double middle = 2 * i < stretch.last ? cost(stretch, i, stretch.last - i) : 0.0;
      if (is_less(2.0 * best.cost[i] + middle, least)) {
        least = 2.0 * best.cost[i] + middle;
        half = i;
      }
    }
    std::vector<std::size_t> stays = lines_to(best, half);
    for (std::size_t k = stays.size(); k-- > 0;) {
      stays.push_back(stretch.last - stays[k]);
    }
    return stays;
  }

  /// 0 where a stretch is its own mirror image; below 0 where its mirror image is above.
  [[nodiscard]] double leaning(const Stretch& stretch) const {
    const double near = ruled_alike * rules_.short_edge_mm;
    for (std::size_t i = 0, k = stretch.last - 1; i < k; ++i, --k) {
      const double wider = width(stretch, i, i + 1) - width(stretch, k, k + 1);
      const double sharper = i == 0 ? 0.0 : fold(stretch.line(i)) - fold(stretch.line(k + 1));
      if (std::abs(wider) > near || std::abs(sharper) > ruled_alike) {
        return std::abs(wider) > near ? wider : sharper;
      }
    }
    return 0.0;
  }

  /// Whether a round strip has faces of one width all around.
  [[nodiscard]] bool is_regular() const {
    const double first = width(0, 1);
    for (std::size_t i = 1; i < count_; ++i) {
      if (std::abs(width(i, i + 1) - first) > ruled_alike * rules_.short_edge_mm) {
        return false;
      }
    }
    return true;
  }

  /// Of a regular strip: shares as equal as can be. They begin where the model reaches farthest, so that
  /// coaxial and parallel ones are cut alike and mirror planes stay.
  [[nodiscard]] std::vector<std::size_t> around(std::size_t begin) const {
    std::vector<std::size_t> best;
    double least = never;
    for (std::size_t shares = count_; shares >= 3; --shares) {
      std::vector<std::size_t> stays;
      double sum = 0.0;
      for (std::size_t k = 0; k < shares; ++k) {
        stays.push_back(begin + share_end(k, shares));
        sum += cost(begin + share_end(k, shares), begin + share_end(k + 1, shares));
      }
      sum *= 1.0 + (count_ % shares == 0 ? 0.0 : unequal) + (loses_mirrors(shares) ? lopsided : 0.0);
      if (is_less(sum, least)) {
        least = sum;
        best = std::move(stays);
      }
      if (sum == never && least < never) {
        break;
      }
    }
    if (best.empty()) {
      for (std::size_t i = 0; i < count_; ++i) {
        best.push_back(i);
      }
    }
    return best;
  }

  /// Planes through the first line, and through the one opposite to it.
  [[nodiscard]] bool loses_mirrors(std::size_t shares) const {
    if (count_ % 2 == 0 && shares % 2 == 1) {
      return true;
    }
    for (std::size_t k = 1; k < shares; ++k) {
      if (share_end(k, shares) + share_end(shares - k, shares) != count_) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::size_t share_end(std::size_t k, std::size_t shares) const {
    return (2 * k * count_ + shares) / (2 * shares);
  }

  /// Along the model's longest extent, the first one of those that are as far.
  [[nodiscard]] std::size_t farthest_line() const {
    const Vec3 size = surface_.bounds().size();
    const double near = ruled_alike * rules_.short_edge_mm;
    std::array<std::size_t, 3> axes{0, 1, 2};
    const std::array<double, 3> extent{size.x, size.y, size.z};
    std::stable_sort(axes.begin(), axes.end(),
                     [&](std::size_t a, std::size_t b) { return extent[a] > extent[b] + near; });
    std::size_t best = 0;
    for (std::size_t i = 1; i < count_; ++i) {
      const Vec3 p = at(i, 0);
      const Vec3 q = at(best, 0);
      const std::array<double, 3> ahead{p.x - q.x, p.y - q.y, p.z - q.z};
      for (const std::size_t axis : axes) {
        if (std::abs(ahead[axis]) > near) {
          best = ahead[axis] > 0.0 ? i : best;
          break;
        }
      }
    }
    return best;
  }

  const mesh::Surface& surface_;
  const RuledStrip& strip_;
  const RulingRules& rules_;
  std::size_t count_;
  double most_mm_;  ///< how far the surface may move
};

}  // namespace

ChosenRulings choose_rulings(const mesh::Surface& surface, const RuledStrip& strip,
                             const RulingRules& rules) {
  return RulingChooser(surface, strip, rules).run();
}

}  // namespace ridgecraft::prepare
