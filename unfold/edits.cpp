// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/edits.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/id.hpp"
#include "base/random.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {
namespace {

// Finished nets of which some edges are used otherwise now become nets again.

constexpr std::array<unsigned, 3> corner_numbers{0, 1, 2};

/// Whether a piece has the faces and folds of one that was there before.
bool is_as_before(const mesh::Surface& surface, const Nets& before, const Nets& nets, const Piece& piece) {
  const Piece& old = before.pieces[before.piece[piece.faces.front()]];
  return old.faces == piece.faces && std::all_of(piece.faces.begin(), piece.faces.end(), [&](FaceId f) {
           return std::all_of(corner_numbers.begin(), corner_numbers.end(), [&](unsigned k) {
             const EdgeId e = surface.edge(mesh::corner(f, k));
             return before.use[e] == nets.use[e];
           });
         });
}

/// The reason of the pieces that a piece has its faces of: that of most, but none where one of them stood for
/// its part.
PieceReason reason_before(const Nets& before, const Piece& piece) {
  std::map<PieceReason, std::size_t> reasons;
  for (const FaceId f : piece.faces) {
    ++reasons[before.pieces[before.piece[f]].reason];
  }
  return reasons.contains(PieceReason::part)
             ? PieceReason::part
             : std::max_element(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
                 return a.second < b.second;
               })->first;
}

/// The pieces that `changed.use` says, in their order, each face where `changed.flat` has it, without joins,
/// tabs, kinds of equal pieces and notes. Pieces that were there `before` are folded as they were.
/// O(n log n) but for the order in which new pieces are folded.
Nets nets_of_uses(const UnfoldProblem& problem, const Nets& before, const Nets& changed,
                  const Context& context) {
  const mesh::Surface& surface = problem.surface;
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  Folds folds(surface.corner_count(), 0);
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    folds[c.value()] = changed.use[surface.edge(c)] == EdgeUse::fold ? 1 : 0;
  }
  Nets nets = nets_of_folds(surface, problem.part, make_patch(surface, problem.panels, faces), folds);
  nets.flat = changed.flat;
  nets.broken_constraints = count_broken(problem.options.constraints, nets);
  count_holes(surface, nets);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    Piece& piece = nets.pieces[p];
    piece.reason = reason_before(before, piece);
    piece.folding = is_as_before(surface, before, nets, piece)
                        ? before.pieces[before.piece[piece.faces.front()]].folding
                        : find_fold_order(surface, nets, p, context);
  }
  return nets;
}

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
EdgeConstraints slits_of(const mesh::Surface& surface, const EdgeConstraints& constraints, const Nets& nets) {
  EdgeConstraints slits(surface.edge_count(), EdgeConstraint::none);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    const bool asked = !constraints.empty() && constraints[e] == EdgeConstraint::cut;
    if (nets.use[e] == EdgeUse::cut &&
        (asked || nets.piece[mesh::face_of(c)] == nets.piece[mesh::face_of(d)])) {
      slits[e] = EdgeConstraint::cut;
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

ChangedNets cut_fold(const UnfoldProblem& problem, const Nets& nets, EdgeId edge, const Context& context) {
  const std::vector<FaceId> beside = faces_at(problem.surface, edge);
  if (nets.use[edge] != EdgeUse::fold) {
    return Refusal{nets.use[edge] == EdgeUse::border ? Message("nothing_to_cut") : Message("cut_already"),
                   beside};
  }
  if (problem.panels.panel[beside[0]] == problem.panels.panel[beside[1]]) {
    return Refusal{Message("inside_flat_region"), beside};
  }
  Nets changed = nets;
  changed.use[edge] = EdgeUse::cut;
  DisjointSets halves(problem.surface.face_count());
  for (const EdgeId e : ids<EdgeId>(problem.surface.edge_count())) {
    if (changed.use[e] == EdgeUse::fold) {
      const auto [c, d] = problem.surface.sides(e);
      halves.join(mesh::face_of(c).value(), mesh::face_of(d).value());
    }
  }
  if (halves.find(beside[0].value()) == halves.find(beside[1].value())) {
    return Refusal{Message("cut_parts_nothing"), beside};
  }
  std::array<std::vector<FaceId>, 2> half;
  for (const FaceId f : nets.pieces[nets.piece[beside[0]]].faces) {
    half[halves.find(f.value()) == halves.find(beside[0].value()) ? 0 : 1].push_back(f);
  }
  const auto& smaller = half[area_of(problem.surface, half[0]) < area_of(problem.surface, half[1]) ? 0 : 1];
  Nets cut = nets_of_uses(problem, nets, changed, context);
  cut.pieces[cut.piece[smaller.front()]].reason = PieceReason::request;
  return cut;
}

ChangedNets join_cut(const UnfoldProblem& problem, const Nets& nets, EdgeId edge, const Context& context) {
  const std::vector<FaceId> beside = faces_at(problem.surface, edge);
  if (nets.use[edge] != EdgeUse::cut) {
    return Refusal{nets.use[edge] == EdgeUse::border ? Message("nothing_to_join") : Message("fold_already"),
                   beside};
  }
  auto [stays, moves] = problem.surface.sides(edge);
  const auto piece_at = [&](CornerId side) -> const Piece& {
    return nets.pieces[nets.piece[mesh::face_of(side)]];
  };
  if (&piece_at(stays) == &piece_at(moves)) {
    return Refusal{Message("closes_loop", {{"a", piece_at(stays).name}}), beside};
  }
  if (area_of(problem.surface, piece_at(stays).faces) < area_of(problem.surface, piece_at(moves).faces)) {
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
  const std::vector<MessageValue> names{{"a", piece_at(stays).name}, {"b", piece_at(moves).name}};
  if (std::vector<FaceId> on_each_other = overlapping(changed, both); !on_each_other.empty()) {
    return Refusal{Message("would_overlap", names), std::move(on_each_other)};
  }
  if (!fit_the_sheet(problem.panels, problem.options, changed, both)) {
    return Refusal{Message("larger_than_paper", names), beside};
  }
  changed.use[edge] = EdgeUse::fold;
  close_flat_cuts(problem.surface, problem.panels,
                  slits_of(problem.surface, problem.options.constraints, nets), changed);
  Nets joined = nets_of_uses(problem, nets, changed, context);
  const Piece& made = joined.pieces[joined.piece[beside[0]]];
  if (problem.options.pieces.fold_linear && made.folding.way != FoldWay::together) {
    return Refusal{Message("wouldnt_fold_together", names), beside};
  }
  return joined;
}

namespace {

/// One piece as a surface of its own.
struct Alone {
  prepare::PartOf from;
  prepare::Panels panels;
  IdVector<FaceId, PartId> part;
  Options options;
};

Alone alone(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
            const Piece& piece) {
  Alone one{prepare::part_of(surface, piece.faces), {}, {}, options};
  one.panels = prepare::panels_of(panels, one.from.face);
  one.part = IdVector<FaceId, PartId>(one.from.face.size(), PartId(0));
  // Tabs follow when all pieces are there.
  one.options.tabs.wanted = false;
  one.options.twins = {};
  one.options.labels = {};
  // What was joined by hand may have more than the rules allow to a search.
  if (std::size_t& most = one.options.pieces.max_panels; most > 0) {
    std::set<PanelId> own;
    for (const FaceId f : piece.faces) {
      own.insert(panels.panel[f]);
    }
    most = std::max(most, own.size());
  }
  one.options.constraints = EdgeConstraints(one.from.edge.size(), EdgeConstraint::none);
  for (const EdgeId e : ids<EdgeId>(options.constraints.empty() ? 0 : one.from.edge.size())) {
    one.options.constraints[e] = options.constraints[one.from.edge[e]];
  }
  return one;
}

/// Whether the two fold the same edges.
bool is_same(const Alone& one, const Nets& before, const Nets& found) {
  const auto edges = ids<EdgeId>(found.use.size());
  return std::all_of(edges.begin(), edges.end(), [&](EdgeId e) {
    return (found.use[e] == EdgeUse::fold) == (before.use[one.from.edge[e]] == EdgeUse::fold);
  });
}

/// The folds between flat regions, all of which could be cuts.
std::vector<EdgeId> folds_of(const Alone& one, const Nets& before) {
  std::vector<EdgeId> folds;
  for (const EdgeId e : ids<EdgeId>(one.from.edge.size())) {
    const auto [c, d] = one.from.surface.sides(e);
    if (d.valid() && before.use[one.from.edge[e]] == EdgeUse::fold &&
        one.panels.panel[mesh::face_of(c)] != one.panels.panel[mesh::face_of(d)] &&
        one.options.constraints[e] == EdgeConstraint::none) {
      folds.push_back(e);
    }
  }
  return folds;
}

/// Another net of the piece; none where none was found.
std::optional<Nets> another_net(Alone one, const Nets& before, const Context& context) {
  constexpr std::size_t most_tries = 8;
  std::vector<EdgeId> folds = folds_of(one, before);
  const EdgeConstraints asked = one.options.constraints;
  Random random(context.seed);
  for (std::size_t tries = 0; tries < most_tries; ++tries) {
    Nets found = unfold(one.from.surface, one.panels, one.part, one.options, context);
    if (found.pieces.size() == 1 && !is_same(one, before, found)) {
      return found;
    }
    if (folds.empty()) {
      return std::nullopt;
    }
    // One fold after the other, each alone, is not to be one.
    std::swap(folds[random.below(static_cast<std::uint32_t>(folds.size()))], folds.back());
    one.options.constraints = asked;
    one.options.constraints[folds.back()] = EdgeConstraint::cut;
    folds.pop_back();
  }
  return std::nullopt;
}

}  // namespace

ChangedNets retry_pieces(const UnfoldProblem& problem, const Nets& nets, std::span<const PieceId> pieces,
                         const Context& context) {
  Nets changed = nets;
  for (const PieceId p : pieces) {
    const Piece& piece = nets.pieces[p];
    const Alone one = alone(problem.surface, problem.panels, problem.options, piece);
    const std::optional<Nets> found = another_net(one, nets, context);
    if (!found) {
      return Refusal{Message("no_other_net", {{"a", piece.name}}), piece.faces};
    }
    for (const EdgeId e : ids<EdgeId>(one.from.edge.size())) {
      if (found->use[e] != EdgeUse::border) {
        changed.use[one.from.edge[e]] = found->use[e];
      }
    }
    for (const FaceId f : ids<FaceId>(one.from.face.size())) {
      changed.flat[one.from.face[f]] = found->flat[f];
    }
  }
  return nets_of_uses(problem, nets, changed, context);
}

}  // namespace ridgecraft::unfold
