// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/fold_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/disjoint_sets.hpp"

namespace ridgecraft::unfold {
namespace {

/// Folds of less don't move anything that one could see, radians.
constexpr double flat_fold = 2e-6;

/// A turn of space, then a shift.
struct Motion {
  std::array<Vec3, 3> rows{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  Vec3 shift;

  [[nodiscard]] Vec3 turn(Vec3 p) const { return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)}; }
  [[nodiscard]] Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
};

/// First b, then a.
Motion operator*(const Motion& a, const Motion& b) {
  Motion c;
  for (std::size_t i = 0; i < 3; ++i) {
    c.rows[i] = a.rows[i].x * b.rows[0] + a.rows[i].y * b.rows[1] + a.rows[i].z * b.rows[2];
  }
  c.shift = a(b.shift);
  return c;
}

/// Turns about a line in the plane z = 0 (O. Rodrigues).
Motion turn_about(Vec2 start, Vec2 direction, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Vec2 d = direction;
  Motion turn;
  turn.rows = {Vec3{c + d.x * d.x * (1.0 - c), d.x * d.y * (1.0 - c), d.y * s},
               Vec3{d.x * d.y * (1.0 - c), c + d.y * d.y * (1.0 - c), -d.x * s}, Vec3{-d.y * s, d.x * s, c}};
  const Vec3 p{start.x, start.y, 0.0};
  turn.shift = p - turn.turn(p);
  return turn;
}

/// Edges between two plates.
using Links = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<CornerId>>;
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

/// Half way along a longest path: nothing is far from there.
std::uint32_t middle_plate(const Neighbours& neighbours) {
  const std::uint32_t end = reach_from(0, neighbours).order.back();
  const Reach reach = reach_from(end, neighbours);
  std::vector<std::uint32_t> path{reach.order.back()};
  while (path.back() != end) {
    path.push_back(reach.before[path.back()]);
  }
  return path[path.size() / 2];
}

}  // namespace

FoldMotion::FoldMotion(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  const std::vector<FaceId>& faces = nets.pieces[piece].faces;
  const auto size = static_cast<std::uint32_t>(faces.size());
  const auto local = [&](FaceId f) {
    return static_cast<std::uint32_t>(std::lower_bound(faces.begin(), faces.end(), f) - faces.begin());
  };
  const auto folded_here = [&](CornerId c) { return nets.use[surface.edge(c)] == EdgeUse::fold; };
  DisjointSets sets(size);
  for (std::uint32_t f = 0; f < size; ++f) {
    flat_.push_back(nets.flat[faces[f]]);
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = mesh::corner(faces[f], k);
      if (folded_here(side) && std::abs(surface.fold_angle(surface.edge(side))) < flat_fold) {
        sets.join(f, local(surface.neighbor(side)));
      }
    }
  }
  // Numbered by their first faces.
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> number(size, none);
  std::uint32_t plates = 0;
  for (std::uint32_t f = 0; f < size; ++f) {
    std::uint32_t& of_set = number[sets.find(f)];
    of_set = of_set == none ? plates++ : of_set;
    plate_.push_back(of_set);
  }
  Links links;
  for (std::uint32_t f = 0; f < size; ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = mesh::corner(faces[f], k);
      if (folded_here(side)) {
        const std::uint32_t other = plate_[local(surface.neighbor(side))];
        if (plate_[f] != other) {
          links[{plate_[f], other}].push_back(side);
        }
      }
    }
  }
  Neighbours neighbours(plates);
  for (const auto& [pair, sides] : links) {
    neighbours[pair.first].push_back(pair.second);
  }
  const Reach reach = reach_from(middle_plate(neighbours), neighbours);
  inner_of_ = reach.before;
  std::vector<std::uint32_t> crease_of(plates, none);  // the one that moves the plate
  for (std::size_t i = 1; i < reach.order.size(); ++i) {
    const std::uint32_t outer = reach.order[i];
    const std::uint32_t inner = reach.before[outer];
    crease_of[outer] = static_cast<std::uint32_t>(creases_.size());
    const std::uint32_t depth = crease_of[inner] == none ? 1 : creases_[crease_of[inner]].depth + 1;
    creases_.push_back({inner, outer, depth, links[{inner, outer}]});
    const CornerId side = creases_.back().sides.front();
    const auto& corners = nets.flat[mesh::face_of(side)];
    const Vec2 start = corners[side.value() % 3];
    const Vec2 along = corners[mesh::next(side).value() % 3] - start;
    hinges_.push_back({start, along / length(along), -surface.fold_angle(surface.edge(side))});
  }
  for (const auto& [pair, sides] : links) {
    const auto [p, q] = pair;
    if (p < q && !hinged(p, q)) {
      const std::uint32_t later =
          std::max(crease_of[p] == none ? 0 : crease_of[p], crease_of[q] == none ? 0 : crease_of[q]);
      creases_[later].sides.insert(creases_[later].sides.end(), sides.begin(), sides.end());
    }
  }
}

void FoldMotion::pose(std::span<const double> share, std::vector<std::array<Vec3, 3>>& corners) const {
  std::vector<Motion> motion(inner_of_.size());
  for (std::size_t i = 0; i < creases_.size(); ++i) {
    motion[creases_[i].outer] = motion[creases_[i].inner] * turn_about(hinges_[i].start, hinges_[i].direction,
                                                                       share[i] * hinges_[i].angle);
  }
  corners.resize(flat_.size());
  for (std::size_t f = 0; f < flat_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[f][k] = motion[plate_[f]]({flat_[f][k].x, flat_[f][k].y, 0.0});
    }
  }
}

}  // namespace ridgecraft::unfold
