// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/closing.hpp"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {
namespace {

bool within_one_piece(const mesh::Surface& surface, const Nets& nets, EdgeId e) {
  const auto [c, d] = surface.sides(e);
  return d.valid() && nets.piece[mesh::face_of(c)] == nets.piece[mesh::face_of(d)];
}

Vec2 corner_of(const Nets& nets, CornerId c) {
  return nets.flat[mesh::face_of(c)][c.value() % 3];
}

/// Smallest height of the faces at a vertex, mm.
double least_height(const mesh::Surface& surface, VertexId v) {
  double least = INFINITY;
  for (const CornerId corner : surface.corners_at(v)) {
    double longest = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      longest = std::max(longest, surface.length(surface.edge(mesh::corner(mesh::face_of(corner), k))));
    }
    least = std::min(least, 2.0 * surface.area(mesh::face_of(corner)) / longest);
  }
  return least;
}

bool copies_coincide(const mesh::Surface& surface, const Nets& nets, EdgeId e) {
  const auto [c, d] = surface.sides(e);
  const double apart = std::max(length(corner_of(nets, c) - corner_of(nets, mesh::next(d))),
                                length(corner_of(nets, mesh::next(c)) - corner_of(nets, d)));
  if (apart > closing_tolerance_mm) {
    return false;
  }
  // A corner moved by so little turns a needle by apart / height, and what lies far beyond it by that angle.
  const double height =
      std::min(least_height(surface, surface.vertex(c)), least_height(surface, surface.vertex(d)));
  return apart * surface.bounds().diagonal() <= closing_lever_mm * height;
}

/// Every edge at v but e is a fold: then closing e makes the paper whole around v.
bool last_cut_at(const mesh::Surface& surface, const Nets& nets, VertexId v, EdgeId e) {
  const auto corners = surface.corners_at(v);
  return std::all_of(corners.begin(), corners.end(), [&](CornerId c) {
    const EdgeId out = surface.edge(c);
    const EdgeId in = surface.edge(mesh::previous(c));
    return (out == e || nets.use[out] == EdgeUse::fold) && (in == e || nets.use[in] == EdgeUse::fold);
  });
}

}  // namespace

void close_flat_cuts(const mesh::Surface& surface, const prepare::Panels& panels,
                     const EdgeConstraints& constraints, Nets& nets) {
  std::vector<EdgeId> candidates;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const bool asked_for = !constraints.empty() && constraints[e] == EdgeConstraint::cut;
    if (nets.use[e] == EdgeUse::cut && !asked_for && within_one_piece(surface, nets, e) &&
        copies_coincide(surface, nets, e)) {
      candidates.push_back(e);
    }
  }
  const auto closes = [&](EdgeId e) {
    const auto [c, d] = surface.sides(e);
    return panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)] ||
           last_cut_at(surface, nets, surface.vertex(c), e) ||
           last_cut_at(surface, nets, surface.vertex(d), e);
  };
  for (bool again = true; again;) {
    again = false;
    std::erase_if(candidates, [&](EdgeId e) {
      if (!closes(e)) {
        return false;
      }
      nets.use[e] = EdgeUse::fold;
      again = true;
      return true;
    });
  }
}

void count_holes(const mesh::Surface& surface, Nets& nets) {
  // Corners that folds hold together are one vertex of the paper.
  DisjointSets vertices(surface.corner_count());
  std::vector<std::int64_t> euler(nets.pieces.size(), 0);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    const PieceId piece = nets.piece[mesh::face_of(c)];
    if (nets.use[e] == EdgeUse::fold) {
      vertices.join(c.value(), mesh::next(d).value());
      vertices.join(mesh::next(c).value(), d.value());
      --euler[piece.value()];
    } else {
      --euler[piece.value()];
      if (d.valid()) {
        --euler[nets.piece[mesh::face_of(d)].value()];
      }
    }
  }
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    const FaceId f = mesh::face_of(c);
    std::int64_t& number = euler[nets.piece[f].value()];
    number += vertices.find(c.value()) == c.value() ? 1 : 0;
    number += c.value() % 3 == 0 ? 1 : 0;
  }
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    nets.pieces[p].holes = static_cast<std::uint32_t>(1 - euler[p.value()]);
  }
}

}  // namespace ridgecraft::unfold
