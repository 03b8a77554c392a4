// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/fold_trial.hpp"

#include <algorithm>

#include "base/near_boxes.hpp"
#include "unfold/net/tolerance.hpp"

namespace ridgecraft::unfold {
namespace {

/// Samples of the motion of all creases together, and of one crease.
constexpr int samples_together = 24;
constexpr int samples_single = 6;

using Corners = std::array<Vec3, 3>;

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

bool touch(const Box3& a, const Box3& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace

FoldTrial::FoldTrial(const FoldMotion& motion, const Context& context) : motion_(motion), context_(context) {
  pose_together(1.0);
  always_ = meetings();
}

bool FoldTrial::together_works() {
  return meetings_together(0).empty();
}

std::vector<FoldTrial::Pair> FoldTrial::meetings_together(std::size_t most) {
  std::vector<Pair> all;
  for (int sample = 1; sample < samples_together && all.size() <= most; ++sample) {
    pose_together(static_cast<double>(sample) / samples_together);
    const std::vector<Pair> now = meetings();
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

bool FoldTrial::order_works(std::span<const std::uint32_t> order) {
  pose_together(0.0);
  std::vector<Solid> solids;
  for (std::uint32_t f = 0; f < motion_.face_count(); ++f) {
    solids.push_back(solid(f));
  }
  return std::all_of(order.begin(), order.end(), [&](std::uint32_t crease) {
    context_.check();
    return !context_.out_of_time() && crease_works(crease, solids);
  });
}

void FoldTrial::pose_together(double share) {
  context_.check();
  motion_.pose(std::vector<double>(motion_.creases().size(), share), pose_);
}

FoldTrial::Solid FoldTrial::solid(std::uint32_t face) const {
  Solid s;
  s.empty = !without_seam(pose_.corners[face], s.corners);
  if (!s.empty) {
    for (const Vec3 p : s.corners) {
      s.box.add(p);
    }
  }
  return s;
}

/// Whether it matters that these faces meet.
bool FoldTrial::counts(std::uint32_t f, std::uint32_t g) const {
  const std::uint32_t p = motion_.plate(f);
  const std::uint32_t q = motion_.plate(g);
  return p != q && !motion_.hinged(p, q) &&
         !std::binary_search(always_.begin(), always_.end(), Pair(std::minmax(f, g)));
}

/// Pairs of faces that meet in the present pose, ascending.
std::vector<FoldTrial::Pair> FoldTrial::meetings() const {
  std::vector<std::uint32_t> face;
  std::vector<Corners> corners;
  std::vector<Box3> boxes;
  for (std::uint32_t f = 0; f < pose_.corners.size(); ++f) {
    const Solid s = solid(f);
    if (!s.empty) {
      face.push_back(f);
      corners.push_back(s.corners);
      boxes.push_back(s.box);
    }
  }
  std::vector<Pair> found;
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (counts(face[i], face[j]) && meet(corners[i], corners[j])) {
      found.push_back(std::minmax(face[i], face[j]));
    }
  });
  std::sort(found.begin(), found.end());
  return found;
}

/// Folds one crease; `solids` are those of the present pose, before and after. False where what it moves
/// meets something on the way.
bool FoldTrial::crease_works(std::uint32_t crease, std::vector<Solid>& solids) {
  const std::vector<std::uint32_t> moved = motion_.faces_beyond(crease);
  std::vector<std::uint8_t> moves(solids.size(), 0);
  for (const std::uint32_t f : moved) {
    moves[f] = 1;
  }
  for (int sample = 1; sample <= samples_single; ++sample) {
    motion_.fold(crease, static_cast<double>(sample) / samples_single, pose_);
    Box3 around;
    for (const std::uint32_t f : moved) {
      solids[f] = solid(f);
      if (!solids[f].empty) {
        around.add(solids[f].box.low);
        around.add(solids[f].box.high);
      }
    }
    for (std::uint32_t g = 0; g < solids.size(); ++g) {
      if (moves[g] != 0 || solids[g].empty || !touch(around, solids[g].box)) {
        continue;
      }
      for (const std::uint32_t f : moved) {
        if (!solids[f].empty && touch(solids[f].box, solids[g].box) && counts(f, g) &&
            meet(solids[f].corners, solids[g].corners)) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace ridgecraft::unfold
