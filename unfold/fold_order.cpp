// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/fold_order.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/near_boxes.hpp"
#include "unfold/fold_motion.hpp"
#include "unfold/tolerance.hpp"

namespace ridgecraft::unfold {
namespace {

/// Samples of the motion of all creases together, and of one crease.
constexpr int samples_together = 24;
constexpr int samples_single = 6;
/// Creases times faces that single creases are tried for: about a second.
constexpr std::size_t most_single = 120'000;

using Corners = std::array<Vec3, 3>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The triangle less a seam of fold_give_mm along its sides; false where nothing is left.
bool without_seam(const Corners& t, Corners& rest) {
  const double a = length(t[2] - t[1]);
  const double b = length(t[0] - t[2]);
  const double c = length(t[1] - t[0]);
  const double around = a + b + c;
  const double inradius = length(cross(t[1] - t[0], t[2] - t[0])) / around;
  if (!(inradius > fold_give_mm)) {
    return false;
  }
  const Vec3 centre = (a * t[0] + b * t[1] + c * t[2]) / around;
  const double scale = (inradius - fold_give_mm) / inradius;
  for (std::size_t k = 0; k < 3; ++k) {
    rest[k] = centre + scale * (t[k] - centre);
  }
  return true;
}

/// Whether all of f lies beside all of g, seen along this axis.
bool apart_along(Vec3 axis, const Corners& f, const Corners& g) {
  double f_low = dot(axis, f[0]), f_high = f_low;
  double g_low = dot(axis, g[0]), g_high = g_low;
  for (std::size_t k = 1; k < 3; ++k) {
    f_low = std::min(f_low, dot(axis, f[k]));
    f_high = std::max(f_high, dot(axis, f[k]));
    g_low = std::min(g_low, dot(axis, g[k]));
    g_high = std::max(g_high, dot(axis, g[k]));
  }
  return f_high < g_low || g_high < f_low;
}

/// Two triangles meet where none of these axes separates them: normals, products of two sides, and for
/// triangles in one plane the sides' normals in it. Floating point does: the seam is a million times wider
/// than its errors.
bool meet(const Corners& f, const Corners& g) {
  std::array<Vec3, 3> f_side, g_side;
  for (std::size_t k = 0; k < 3; ++k) {
    f_side[k] = f[(k + 1) % 3] - f[k];
    g_side[k] = g[(k + 1) % 3] - g[k];
  }
  const Vec3 f_normal = cross(f_side[0], f_side[1]);
  const Vec3 g_normal = cross(g_side[0], g_side[1]);
  if (apart_along(f_normal, f, g) || apart_along(g_normal, f, g)) {
    return false;
  }
  for (const Vec3 u : f_side) {
    if (apart_along(cross(f_normal, u), f, g)) {
      return false;
    }
    for (const Vec3 v : g_side) {
      if (apart_along(cross(u, v), f, g)) {
        return false;
      }
    }
  }
  return std::none_of(g_side.begin(), g_side.end(),
                      [&](Vec3 v) { return apart_along(cross(g_normal, v), f, g); });
}

/// Which faces of a piece run through each other while it is folded.
class Trial {
 public:
  Trial(const FoldMotion& motion, const Context& context) : motion_(motion), context_(context) {
    share_.assign(motion.creases().size(), 1.0);
    always_ = meetings();
  }

  [[nodiscard]] bool together_works() {
    for (int sample = 1; sample < samples_together; ++sample) {
      std::fill(share_.begin(), share_.end(), static_cast<double>(sample) / samples_together);
      if (collides()) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool order_works(const std::vector<std::uint32_t>& order) {
    std::fill(share_.begin(), share_.end(), 0.0);
    for (const std::uint32_t crease : order) {
      for (int sample = 1; sample <= samples_single; ++sample) {
        share_[crease] = static_cast<double>(sample) / samples_single;
        if (collides()) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  /// Pairs of faces that meet in the present pose, ascending.
  std::vector<Pair> meetings() {
    context_.check();
    motion_.pose(share_, corners_);
    std::vector<std::uint32_t> face;
    std::vector<Corners> solid;
    std::vector<Box3> boxes;
    for (std::uint32_t f = 0; f < corners_.size(); ++f) {
      Corners rest;
      if (without_seam(corners_[f], rest)) {
        face.push_back(f);
        solid.push_back(rest);
        Box3& box = boxes.emplace_back();
        for (const Vec3 p : rest) {
          box.add(p);
        }
      }
    }
    std::vector<Pair> found;
    mesh::NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
      const std::uint32_t p = motion_.plate(face[i]);
      const std::uint32_t q = motion_.plate(face[j]);
      if (p != q && !motion_.hinged(p, q) && meet(solid[i], solid[j])) {
        found.push_back(std::minmax(face[i], face[j]));
      }
    });
    std::sort(found.begin(), found.end());
    return found;
  }

  bool collides() {
    const std::vector<Pair> now = meetings();
    return !std::includes(always_.begin(), always_.end(), now.begin(), now.end());
  }

  const FoldMotion& motion_;
  const Context& context_;
  std::vector<double> share_;
  std::vector<Corners> corners_;
  std::vector<Pair> always_;  ///< faces that meet in the folded piece
};

}  // namespace

FoldOrder find_fold_order(const mesh::Surface& surface, const Nets& nets, PieceId piece,
                          const Context& context) {
  const FoldMotion motion(surface, nets, piece);
  const auto& creases = motion.creases();
  FoldOrder result;
  if (creases.empty()) {
    return result;
  }
  Trial trial(motion, context);
  if (trial.together_works()) {
    std::vector<CornerId>& all = result.steps.emplace_back();
    for (const FoldMotion::Crease& crease : creases) {
      all.insert(all.end(), crease.sides.begin(), crease.sides.end());
    }
    return result;
  }
  std::vector<std::uint32_t> outwards(creases.size());
  std::iota(outwards.begin(), outwards.end(), 0U);
  std::stable_sort(outwards.begin(), outwards.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return creases[a].depth < creases[b].depth; });
  const std::vector<std::uint32_t> inwards(outwards.rbegin(), outwards.rend());
  const bool affordable = creases.size() * motion.face_count() <= most_single && !context.out_of_time();
  const std::vector<std::uint32_t>* order = &inwards;
  result.way = FoldWay::with_care;
  if (affordable && trial.order_works(inwards)) {
    result.way = FoldWay::leaves_first;
  } else if (affordable && trial.order_works(outwards)) {
    result.way = FoldWay::middle_first;
    order = &outwards;
  }
  for (const std::uint32_t crease : *order) {
    result.steps.push_back(creases[crease].sides);
  }
  return result;
}

}  // namespace ridgecraft::unfold
