// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/fold_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {
namespace {

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

}  // namespace

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

/// They meet where none of these axes separates them: normals, products of two sides, and for triangles in
/// one plane the sides' normals in it.
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

namespace {

/// Edges between two plates.
using Links = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>;
using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// Plates in breadth-first order from one of them, with the plate before each.
struct Reach {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> before;
};
Reach reach_from(std::uint32_t start, const Neighbours& neighbours) {
  Reach reach;
  reach.before.resize(neighbours.size());
  std::vector<bool> seen(neighbours.size(), false);
  reach.order.push_back(start);
  reach.before[start] = start;
  seen[start] = true;
  for (std::size_t i = 0; i < reach.order.size(); ++i) {
    const std::uint32_t plate = reach.order[i];
    for (const std::uint32_t next : neighbours[plate]) {
      if (!seen[next]) {
        seen[next] = true;
        reach.before[next] = plate;
        reach.order.push_back(next);
      }
    }
  }
  return reach;
}

/// Half way along a path to the plate that takes most creases from the first one reached: in a tree, which is
/// what plates make but for closed flat places, nothing is farther from there than need be.
std::uint32_t middle_plate(const Neighbours& neighbours) {
  const std::uint32_t end = reach_from(0, neighbours).order.back();
  const Reach reach = reach_from(end, neighbours);
  std::vector<std::uint32_t> path{reach.order.back()};
  while (path.back() != end) {
    path.push_back(reach.before[path.back()]);
  }
  return path[path.size() / 2];
}

/// The plate of each face, numbered by their first faces.
std::vector<std::uint32_t> plates_of(const FlatPiece& piece) {
  const auto size = static_cast<std::uint32_t>(piece.flat.size());
  DisjointSets sets(size);
  for (std::uint32_t side = 0; side < piece.across.size(); ++side) {
    if (piece.across[side] != no_index && std::abs(piece.angle[side]) < flat_fold) {
      sets.join(side / 3, piece.across[side]);
    }
  }
  std::vector<std::uint32_t> number(size, no_index);
  std::vector<std::uint32_t> plate;
  std::uint32_t plates = 0;
  for (std::uint32_t f = 0; f < size; ++f) {
    std::uint32_t& of_set = number[sets.find(f)];
    of_set = of_set == no_index ? plates++ : of_set;
    plate.push_back(of_set);
  }
  return plate;
}

}  // namespace

FlatPiece flat_piece(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  const std::vector<FaceId>& faces = nets.pieces[piece].faces;
  FlatPiece flat;
  for (const FaceId f : faces) {
    flat.flat.push_back(nets.flat[f]);
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = mesh::corner(f, k);
      const EdgeId e = surface.edge(side);
      std::uint32_t across = no_index;
      if (nets.use[e] == EdgeUse::fold) {
        const auto at = std::lower_bound(faces.begin(), faces.end(), surface.neighbor(side));
        across = static_cast<std::uint32_t>(at - faces.begin());
      }
      flat.across.push_back(across);
      flat.angle.push_back(surface.fold_angle(e));
    }
  }
  return flat;
}

FlatPiece flat_piece(const Patch& patch, const Folds& tree) {
  FlatPiece flat;
  flat.flat = lay_out(patch, tree).flat;
  flat.angle = patch.fold_angle;
  flat.across.assign(tree.size(), no_index);
  for (std::size_t side = 0; side < tree.size(); ++side) {
    if (tree[side] != 0) {
      flat.across[side] = patch.twin[side] / 3;
    }
  }
  return flat;
}

FoldMotion::FoldMotion(const FlatPiece& piece) : flat_(piece.flat), plate_(plates_of(piece)) {
  for (std::uint32_t f = 0; f < plate_.size(); ++f) {
    faces_.resize(std::max<std::size_t>(faces_.size(), plate_[f] + 1));
    faces_[plate_[f]].push_back(f);
  }
  Links links;
  for (std::uint32_t side = 0; side < piece.across.size(); ++side) {
    if (piece.across[side] != no_index && plate_[side / 3] != plate_[piece.across[side]]) {
      links[{plate_[side / 3], plate_[piece.across[side]]}].push_back(side);
    }
  }
  Neighbours neighbours(faces_.size());
  for (const auto& [pair, sides] : links) {
    neighbours[pair.first].push_back(pair.second);
  }
  const Reach reach = reach_from(middle_plate(neighbours), neighbours);
  inner_of_ = reach.before;
  hung_.resize(faces_.size());
  std::vector<std::uint32_t> crease_of(faces_.size(), no_index);  // the one that moves the plate
  for (std::size_t i = 1; i < reach.order.size(); ++i) {
    const std::uint32_t outer = reach.order[i];
    const std::uint32_t inner = reach.before[outer];
    crease_of[outer] = static_cast<std::uint32_t>(creases_.size());
    hung_[inner].push_back(crease_of[outer]);
    const std::uint32_t depth = crease_of[inner] == no_index ? 1 : creases_[crease_of[inner]].depth + 1;
    creases_.push_back({inner, outer, depth, links[{inner, outer}]});
    const std::uint32_t side = creases_.back().sides.front();
    const Triangle& corners = flat_[side / 3];
    const Vec2 start = corners[side % 3];
    const Vec2 along = corners[(side % 3 + 1) % 3] - start;
    hinges_.push_back({start, along / length(along), -piece.angle[side]});
  }
  for (const auto& [pair, sides] : links) {
    const auto [p, q] = pair;
    if (p < q && !hinged(p, q)) {
      const std::uint32_t later =
          std::max(crease_of[p] == no_index ? 0 : crease_of[p], crease_of[q] == no_index ? 0 : crease_of[q]);
      creases_[later].sides.insert(creases_[later].sides.end(), sides.begin(), sides.end());
    }
  }
  number_plates();
}

/// Creases come after those that they hang on, so sizes are summed backwards and places are dealt forwards.
void FoldMotion::number_plates() {
  below_.assign(faces_.size(), 1);
  place_.assign(faces_.size(), 0);
  for (auto crease = creases_.rbegin(); crease != creases_.rend(); ++crease) {
    below_[crease->inner] += below_[crease->outer];
  }
  std::vector<std::uint32_t> dealt(faces_.size(), 1);  // places from the plate's own on
  for (const Crease& crease : creases_) {
    place_[crease.outer] = place_[crease.inner] + dealt[crease.inner];
    dealt[crease.inner] += below_[crease.outer];
  }
}

std::pair<Vec3, Vec3> FoldMotion::line_of(std::uint32_t crease, const Pose& pose) const {
  const Hinge& hinge = hinges_[crease];
  const Motion& inner = pose.motion[creases_[crease].inner];
  return {inner({hinge.start.x, hinge.start.y, 0.0}),
          inner.turn({hinge.direction.x, hinge.direction.y, 0.0})};
}

Motion FoldMotion::beyond(std::uint32_t crease, double share, const Pose& pose) const {
  const Hinge& hinge = hinges_[crease];
  const Motion& inner = pose.motion[creases_[crease].inner];
  const double angle = (share - pose.share[crease]) * hinge.angle;
  return inner * turn_about(hinge.start, hinge.direction, angle) * inner.inverse();
}

void FoldMotion::place(std::uint32_t crease, Pose& pose) const {
  const Crease& c = creases_[crease];
  const Hinge& hinge = hinges_[crease];
  const Motion motion =
      pose.motion[c.inner] * turn_about(hinge.start, hinge.direction, pose.share[crease] * hinge.angle);
  pose.motion[c.outer] = motion;
  for (const std::uint32_t f : faces_[c.outer]) {
    for (std::size_t k = 0; k < 3; ++k) {
      pose.corners[f][k] = motion({flat_[f][k].x, flat_[f][k].y, 0.0});
    }
  }
}

void FoldMotion::pose(std::vector<double> share, Pose& pose) const {
  pose.share = std::move(share);
  pose.motion.assign(faces_.size(), {});
  pose.corners.resize(flat_.size());
  for (std::size_t f = 0; f < flat_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      pose.corners[f][k] = {flat_[f][k].x, flat_[f][k].y, 0.0};
    }
  }
  for (std::uint32_t i = 0; i < creases_.size(); ++i) {
    place(i, pose);
  }
}

std::vector<std::uint32_t> FoldMotion::creases_from(std::uint32_t crease) const {
  std::vector<std::uint32_t> found{crease};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& next = hung_[creases_[found[i]].outer];
    found.insert(found.end(), next.begin(), next.end());
  }
  return found;
}

std::vector<std::uint32_t> FoldMotion::faces_beyond(std::uint32_t crease) const {
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t c : creases_from(crease)) {
    const auto& more = faces_[creases_[c].outer];
    faces.insert(faces.end(), more.begin(), more.end());
  }
  return faces;
}

void FoldMotion::fold(std::uint32_t crease, double share, Pose& pose) const {
  pose.share[crease] = share;
  for (const std::uint32_t c : creases_from(crease)) {
    place(c, pose);
  }
}

}  // namespace ridgecraft::unfold
