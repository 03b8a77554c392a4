// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/changed_folds.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "unfold/net/area_of_faces.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/nets_of_uses.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/lay_across.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/pieces/closing.hpp"

namespace ridgecraft::unfold {
namespace {

std::vector<FaceId> faces_at(const mesh::Surface& surface, EdgeId edge) {
  const auto [c, d] = surface.sides(edge);
  std::vector<FaceId> faces{mesh::face_of(c)};
  if (d.valid()) {
    faces.push_back(mesh::face_of(d));
  }
  return faces;
}

/// The motion of the plane that lays the second side on the first, end to start.
Rigid onto(const Nets& nets, CornerId stays, CornerId moves) {
  const auto at = [&](CornerId c) { return nets.flat[mesh::face_of(c)][c.value() % 3]; };
  return lay_across(at(stays), at(mesh::next(stays)), at(moves), at(mesh::next(moves)));
}

/// Edges that stay cut, should they come to lie within one piece: those that were to be cut, and those that
/// are cut within a piece already, as the paper gapes there.
EdgeWishes slits_of(const mesh::Surface& surface, const EdgeWishes& wishes, const Nets& nets) {
  EdgeWishes slits(surface.edge_count(), EdgeWish::none);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    const bool asked = !wishes.empty() && wishes[e] == EdgeWish::cut;
    if (nets.use[e] == EdgeUse::cut &&
        (asked || nets.piece[mesh::face_of(c)] == nets.piece[mesh::face_of(d)])) {
      slits[e] = EdgeWish::cut;
    }
  }
  return slits;
}

/// Faces that lie on others in this net.
std::vector<FaceId> overlapping(const Nets& nets, const std::vector<FaceId>& faces) {
  std::vector<Triangle> triangles;
  for (const FaceId f : faces) {
    triangles.push_back(nets.flat[f]);
  }
  std::set<FaceId> found;
  for (const OverlapFound& overlap : find_overlaps(triangles, overlap_tolerance_mm)) {
    found.insert(faces[overlap.first]);
    found.insert(faces[overlap.second]);
  }
  return {found.begin(), found.end()};
}

/// Whether the sheet holds these faces as one piece. No strip is kept free for tabs: those that it doesn't
/// hold are left out. How many faces a piece may have is a rule for searches: whoever joins two knows what
/// they are.
bool fit_the_sheet(const prepare::Panels& panels, const Options& options, const Nets& nets,
                   const std::vector<FaceId>& faces) {
  std::vector<Vec2> corners;
  std::set<PanelId> regions;
  for (const FaceId f : faces) {
    corners.insert(corners.end(), nets.flat[f].begin(), nets.flat[f].end());
    regions.insert(panels.panel[f]);
  }
  return Room{options.sheet}.holds(convex_hull(std::move(corners)), regions.size());
}

}  // namespace

ChangedNets cut_fold(const mesh::Surface& surface, const prepare::Panels& panels,
                     const IdVector<FaceId, PartId>& part, const Options& options, const Nets& nets,
                     EdgeId edge, const Context& context) {
  const std::vector<FaceId> beside = faces_at(surface, edge);
  if (nets.use[edge] != EdgeUse::fold) {
    return Refusal{nets.use[edge] == EdgeUse::border
                       ? "the model ends at this edge, so there is nothing to cut"
                       : "this edge is cut already",
                   beside};
  }
  if (panels.panel[beside[0]] == panels.panel[beside[1]]) {
    return Refusal{"this edge lies inside a flat region, which stays whole", beside};
  }
  Nets changed = nets;
  changed.use[edge] = EdgeUse::cut;
  DisjointSets halves(surface.face_count());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (changed.use[e] == EdgeUse::fold) {
      const auto [c, d] = surface.sides(e);
      halves.join(mesh::face_of(c).value(), mesh::face_of(d).value());
    }
  }
  if (halves.find(beside[0].value()) == halves.find(beside[1].value())) {
    return Refusal{"the paper holds together around this edge, so a cut here parts nothing", beside};
  }
  std::array<std::vector<FaceId>, 2> half;
  for (const FaceId f : nets.pieces[nets.piece[beside[0]]].faces) {
    half[halves.find(f.value()) == halves.find(beside[0].value()) ? 0 : 1].push_back(f);
  }
  const auto& smaller = half[area_of(surface, half[0]) < area_of(surface, half[1]) ? 0 : 1];
  Causes causes = causes_in(nets);
  for (const FaceId f : smaller) {
    causes[f.value()] = {PieceReason::request, smaller.front().value()};
  }
  return nets_of_uses(surface, panels, part, options.wishes, nets, changed, causes, context);
}

ChangedNets join_cut(const mesh::Surface& surface, const prepare::Panels& panels,
                     const IdVector<FaceId, PartId>& part, const Options& options, const Nets& nets,
                     EdgeId edge, const Context& context) {
  const std::vector<FaceId> beside = faces_at(surface, edge);
  if (nets.use[edge] != EdgeUse::cut) {
    return Refusal{nets.use[edge] == EdgeUse::border
                       ? "the model ends at this edge, so there is nothing to join"
                       : "this edge is a fold already",
                   beside};
  }
  auto [stays, moves] = surface.sides(edge);
  const auto piece_at = [&](CornerId side) -> const Piece& {
    return nets.pieces[nets.piece[mesh::face_of(side)]];
  };
  if (&piece_at(stays) == &piece_at(moves)) {
    return Refusal{"both sides of this edge belong to piece " + piece_at(stays).name +
                       ", and as a fold it would close a loop that doesn't lie flat",
                   beside};
  }
  if (area_of(surface, piece_at(stays).faces) < area_of(surface, piece_at(moves).faces)) {
    std::swap(stays, moves);
  }
  Nets changed = nets;
  const Rigid motion = onto(nets, stays, moves);
  const PieceId larger = nets.piece[mesh::face_of(stays)];
  std::vector<FaceId> both = piece_at(stays).faces;
  for (const FaceId f : piece_at(moves).faces) {
    for (Vec2& corner : changed.flat[f]) {
      corner = motion(corner);
    }
    changed.piece[f] = larger;
    both.push_back(f);
  }
  const std::string names = "pieces " + piece_at(stays).name + " and " + piece_at(moves).name;
  if (std::vector<FaceId> on_each_other = overlapping(changed, both); !on_each_other.empty()) {
    return Refusal{"joined here " + names + " would overlap", std::move(on_each_other)};
  }
  if (!fit_the_sheet(panels, options, changed, both)) {
    return Refusal{names + " stay apart: joined they would be larger than the paper", beside};
  }
  changed.use[edge] = EdgeUse::fold;
  close_flat_cuts(surface, panels, slits_of(surface, options.wishes, nets), changed);
  Nets joined = nets_of_uses(surface, panels, part, options.wishes, nets, changed, causes_in(nets), context);
  const Piece& made = joined.pieces[joined.piece[beside[0]]];
  if (options.pieces.fold_linear && made.folding.way != FoldWay::together) {
    return Refusal{names + " stay apart: joined they wouldn't fold with all creases together", beside};
  }
  return joined;
}

}  // namespace ridgecraft::unfold
