// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/piece_sets.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ridgecraft::segment {

PieceSets::PieceSets(Measurer& measurer, const PieceTest& test, std::vector<Facets> pieces)
    : measurer_(&measurer),
      test_(test),
      pieces_(std::move(pieces)),
      hulls_(measurer.graph().surface().points) {
  for (const Facets& piece : pieces_) {
    facet_count_ += piece.size();
  }
}

void PieceSets::describe(const Hull& hull, PieceSet& set) const {
  set.feasible = true;
  set.hull_vertices = hull.vertices;
  if (test_.wants_rays) {
    set.rays = cast_rays(hull, measurer_->graph().surface().points);
  }
}

std::uint32_t PieceSets::single(std::uint32_t piece) {
  const auto [at, fresh] = number_.try_emplace({piece}, static_cast<std::uint32_t>(sets_.size()));
  if (fresh) {
    PieceSet& set = sets_.emplace_back();
    set.pieces = {piece};
    const ScaledSurface& s = measurer_->graph().surface();
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t f : pieces_[piece]) {
      vertices.insert(vertices.end(), s.corners[f].begin(), s.corners[f].end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Hull hull;
    hulls_.build(vertices, hull, flat_face_lift);
    describe(hull, set);
  }
  return at->second;
}

std::uint32_t PieceSets::united(std::uint32_t one, std::uint32_t other) {
  const PieceSet& a = sets_[one];
  const PieceSet& b = sets_[other];
  std::vector<std::uint32_t> pieces;
  std::merge(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(), std::back_inserter(pieces));
  const auto [at, fresh] = number_.try_emplace(pieces, static_cast<std::uint32_t>(sets_.size()));
  if (!fresh) {
    return at->second;
  }
  std::vector<std::uint32_t> hull_points;
  if (!test_.from_scratch) {
    std::set_union(a.hull_vertices.begin(), a.hull_vertices.end(), b.hull_vertices.begin(),
                   b.hull_vertices.end(), std::back_inserter(hull_points));
  }
  PieceSet& set = sets_.emplace_back();
  set.pieces = std::move(pieces);
  const Facets together = facets(at->second);
  measured_facets_ += together.size();
  measurer_->measure(together, hull_points, {.stop_at_first = true, .from_scratch = test_.from_scratch},
                     measurement_);
  if (!measurement_.stopped && (test_.pockets == nullptr || !test_.pockets->has_pocket(measurement_.hull))) {
    describe(measurement_.hull, set);
  }
  return at->second;
}

Facets PieceSets::facets(std::uint32_t set) const {
  Facets facets;
  for (const std::uint32_t p : sets_[set].pieces) {
    facets.insert(facets.end(), pieces_[p].begin(), pieces_[p].end());
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

}  // namespace ridgecraft::segment
