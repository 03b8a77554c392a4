// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/paper_behind.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::unfold {
namespace {

constexpr int places = 9;
constexpr int enough_places = (places + 1) / 2;
/// Faces that one look passes, at most: fans of needles have more, and nothing hangs on those.
constexpr int most_faces = 64;

/// How far, at most `far`, one gets from a point of a side straight into its face and over folds.
double reach(const mesh::Surface& surface, const Nets& nets, CornerId side, double share, double far) {
  const auto corner = [&](CornerId c) { return nets.flat[mesh::face_of(c)][c.value() % 3]; };
  const Vec2 from = corner(side);
  const Vec2 along = corner(mesh::next(side)) - from;
  const Vec2 start = from + share * along;
  const Vec2 inward = perpendicular(along) / length(along);
  CornerId entered = side;
  double gone = 0.0;
  for (int passed = 0; passed < most_faces; ++passed) {
    double leaves_at = HUGE_VAL;
    CornerId leaves;
    for (const CornerId c : {mesh::next(entered), mesh::previous(entered)}) {
      const Vec2 a = corner(c);
      const Vec2 d = corner(mesh::next(c)) - a;
      const double steep = cross(d, inward);
      if (steep < 0.0) {  // the ray goes out there
        const double at = cross(d, a - start) / steep;
        if (at < leaves_at) {
          leaves_at = at;
          leaves = c;
        }
      }
    }
    gone = std::max(gone, leaves_at);
    if (gone >= far) {
      return far;
    }
    if (!leaves.valid() || !surface.twin(leaves).valid() || nets.use[surface.edge(leaves)] != EdgeUse::fold) {
      return gone;
    }
    entered = surface.twin(leaves);
  }
  return gone;
}

}  // namespace

bool enough_paper_behind(const mesh::Surface& surface, const Nets& nets, CornerId side) {
  int enough = 0;
  for (int i = 0; i < places; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / places;
    enough += reach(surface, nets, side, share, least_paper_mm) >= least_paper_mm ? 1 : 0;
  }
  return enough >= enough_places;
}

}  // namespace ridgecraft::unfold
