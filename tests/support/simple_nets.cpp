// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/simple_nets.hpp"

#include <algorithm>
#include <deque>

namespace ridgecraft::test {
namespace {

using mesh::corner;
using mesh::face_of;
using mesh::next;
using mesh::Surface;
using unfold::EdgeUse;
using unfold::Nets;

/// Nearer than this (mm) two copies of a corner are one: rounding along a chain of folds.
constexpr double same_place = 1e-7;

Vec2 flat(const Nets& nets, CornerId c) {
  return nets.flat[face_of(c)][c.value() % 3];
}

/// The third corner of a face with corners p, q already in the plane, to the left of p q.
Vec2 third_corner(const Surface& surface, CornerId side, Vec2 p, Vec2 q) {
  const Vec3 a = surface.point(surface.vertex(side));
  const Vec3 along = surface.point(surface.vertex(next(side))) - a;
  const Vec3 to = surface.point(surface.vertex(mesh::previous(side))) - a;
  const double base = length(along);
  const double x = dot(to, along) / base;
  const double y = length(cross(along, to)) / base;
  const Vec2 unit = (q - p) / length(q - p);
  return p + x * unit + y * perpendicular(unit);
}

void place(const Surface& surface, Nets& nets, CornerId side, Vec2 p, Vec2 q) {
  auto& at = nets.flat[face_of(side)];
  at[side.value() % 3] = p;
  at[next(side).value() % 3] = q;
  at[mesh::previous(side).value() % 3] = third_corner(surface, side, p, q);
}

std::string piece_name(std::size_t number) {
  std::string name;
  for (std::size_t n = number + 1; n > 0; n = (n - 1) / 26) {
    name.insert(name.begin(), static_cast<char>('A' + (n - 1) % 26));
  }
  return name;
}

void grow(const Surface& surface, Nets& nets, FaceId root) {
  const PieceId piece = nets.pieces.push_back({piece_name(nets.pieces.size()), {}, {}});
  const CornerId first = corner(root, 0);
  place(surface, nets, first, {0.0, 0.0}, {surface.length(surface.edge(first)), 0.0});
  nets.piece[root] = piece;
  std::deque<FaceId> queue{root};
  while (!queue.empty()) {
    const FaceId f = queue.front();
    queue.pop_front();
    nets.pieces[piece].faces.push_back(f);
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = corner(f, k);
      const CornerId twin = surface.twin(side);
      if (!twin.valid() || nets.piece[face_of(twin)].valid() ||
          nets.use[surface.edge(side)] == EdgeUse::cut) {
        continue;
      }
      place(surface, nets, twin, flat(nets, next(side)), flat(nets, side));
      nets.use[surface.edge(side)] = EdgeUse::fold;
      nets.piece[face_of(twin)] = piece;
      queue.push_back(face_of(twin));
    }
  }
}

/// Folds beyond those of a tree close circles: round a flat vertex inside, or round a hole.
void count_holes(const Surface& surface, Nets& nets) {
  IdVector<PieceId, std::uint32_t> folds(nets.pieces.size());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    folds[nets.piece[face_of(surface.sides(e)[0])]] += nets.use[e] == EdgeUse::fold ? 1U : 0U;
  }
  IdVector<PieceId, std::uint32_t> inside(nets.pieces.size());
  for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
    const auto corners = surface.corners_at(v);
    if (std::all_of(corners.begin(), corners.end(), [&](CornerId c) {
          return nets.use[surface.edge(c)] == EdgeUse::fold &&
                 nets.use[surface.edge(mesh::previous(c))] == EdgeUse::fold;
        })) {
      ++inside[nets.piece[face_of(corners.front())]];
    }
  }
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const auto tree = static_cast<std::uint32_t>(nets.pieces[p].faces.size()) - 1;
    nets.pieces[p].holes = folds[p] - tree - inside[p];
  }
}

}  // namespace

Nets simple_nets(const Surface& surface, std::span<const EdgeId> cuts, const IdVector<FaceId, PartId>& part) {
  Nets nets;
  nets.use.resize(surface.edge_count(), EdgeUse::border);
  nets.piece.resize(surface.face_count());
  nets.flat.resize(surface.face_count());
  for (const EdgeId e : cuts) {
    nets.use[e] = EdgeUse::cut;
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (!nets.piece[f].valid()) {
      grow(surface, nets, f);
    }
  }
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (!d.valid()) {
      nets.use[e] = EdgeUse::border;
    } else if (nets.use[e] == EdgeUse::border) {
      // Not crossed: a cut, unless both copies of the edge lie at one place (round a flat vertex).
      const bool together = nets.piece[face_of(c)] == nets.piece[face_of(d)] &&
                            length(flat(nets, c) - flat(nets, next(d))) < same_place &&
                            length(flat(nets, next(c)) - flat(nets, d)) < same_place;
      nets.use[e] = together ? EdgeUse::fold : EdgeUse::cut;
    }
    if (nets.use[e] == EdgeUse::cut) {
      nets.joins.push_back({e, static_cast<std::uint32_t>(nets.joins.size() + 1), {}});
    }
  }
  for (unfold::Piece& piece : nets.pieces) {
    std::sort(piece.faces.begin(), piece.faces.end());
    for (const FaceId f : piece.faces) {
      piece.parts.push_back(part.empty() ? PartId(0) : part[f]);
    }
    std::sort(piece.parts.begin(), piece.parts.end());
    piece.parts.erase(std::unique(piece.parts.begin(), piece.parts.end()), piece.parts.end());
  }
  count_holes(surface, nets);
  return nets;
}

}  // namespace ridgecraft::test
