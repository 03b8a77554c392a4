// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/reasons.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/parallel.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/free_folding.hpp"
#include "unfold/search/least_forest.hpp"

namespace ridgecraft::unfold {
namespace {

/// What a proof may take: flat regions of a block, pairs of faces.
constexpr std::size_t most_proven_panels = 30;
constexpr std::uint64_t proof_pairs = 500'000;

/// The pieces of a forest, and what stops two of them from being one.
class Pieces {
 public:
  Pieces(const NetProblem& problem, const Folds& folds, const Nets& nets)
      : problem_(problem),
        patch_(problem.patch),
        folds_(folds),
        nets_(nets),
        layout_(lay_out(patch_, folds)) {
    for (const auto& faces : layout_.faces) {
      panels_.push_back(panels_of(patch_, folds, faces));
    }
  }

  /// Why nothing else of a piece's part hangs together with it.
  [[nodiscard]] PieceReason reason_apart(const Piece& piece) const {
    return cut_on_request(piece) ? PieceReason::request : PieceReason::component;
  }

  /// What stops a piece from being one with a neighbour.
  [[nodiscard]] PieceReason reason_of(const Piece& piece, const Context& context) const {
    std::map<PieceReason, double> along;  // mm of cuts, by what stops a join there
    for (const std::uint32_t cut : cuts_of(piece)) {
      context.check();
      const std::optional<PieceReason> reason = obstacle(cut, context);
      if (!reason) {
        return reason_of_choice(context);
      }
      along[*reason] += patch_.length[cut];
    }
    if (along.empty()) {
      return reason_apart(piece);
    }
    return std::max_element(along.begin(), along.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

 private:
  /// Whether a cut that is asked for parts it from another piece.
  [[nodiscard]] bool cut_on_request(const Piece& piece) const {
    return std::any_of(piece.faces.begin(), piece.faces.end(), [&](FaceId f) {
      for (unsigned k = 0; k < 3; ++k) {
        const FaceId g = problem_.surface.neighbor(mesh::corner(f, k));
        if (g.valid() && nets_.piece[g] != nets_.piece[f] && is_cut_on_request(mesh::corner(f, k))) {
          return true;
        }
      }
      return false;
    });
  }

  [[nodiscard]] bool is_cut_on_request(CornerId side) const {
    const EdgeConstraints& constraints = problem_.options.constraints;
    return !constraints.empty() && constraints[problem_.surface.edge(side)] == EdgeConstraint::cut;
  }

  /// Its cuts to other pieces.
  [[nodiscard]] std::vector<std::uint32_t> cuts_of(const Piece& piece) const {
    std::vector<std::uint32_t> cuts;
    for (const FaceId f : piece.faces) {
      for (std::uint32_t side = 3 * f.value(); side < 3 * f.value() + 3; ++side) {
        const std::uint32_t twin = patch_.twin[side];
        if (twin != no_index && nets_.piece[FaceId(twin / 3)] != nets_.piece[f]) {
          cuts.push_back(side);
        }
      }
    }
    return cuts;
  }

  /// Why two pieces are that nothing stops from being one.
  [[nodiscard]] PieceReason reason_of_choice(const Context& context) const {
    return context.out_of_time()                  ? PieceReason::time
           : problem_.options.tabs.on_all_edges() ? PieceReason::tabs
                                                  : PieceReason::shape;
  }

  /// What stops the two pieces at a cut from being one that is folded there, if anything.
  [[nodiscard]] std::optional<PieceReason> obstacle(std::uint32_t cut, const Context& context) const {
    const std::uint32_t twin = patch_.twin[cut];
    const std::uint32_t stays = layout_.piece[cut / 3];
    const std::uint32_t moves = layout_.piece[twin / 3];
    if (is_cut_on_request(mesh::corner(FaceId(cut / 3), cut % 3))) {
      return PieceReason::request;
    }
    const std::size_t panels = panels_[stays] + panels_[moves] - within_panel(patch_, cut);
    if (problem_.room.max_panels > 0 && panels > problem_.room.max_panels) {
      return PieceReason::faces;
    }
    const std::vector<Triangle> both = laid_together(cut);
    if (!find_overlaps(both, problem_.tolerance()).empty()) {
      return PieceReason::overlap;
    }
    std::vector<Vec2> corners;
    for (const Triangle& t : both) {
      corners.insert(corners.end(), t.begin(), t.end());
    }
    if (!problem_.room.holds(convex_hull(std::move(corners)), panels)) {
      return PieceReason::page;
    }
    if (problem_.options.pieces.fold_linear && !fold_together(cut, context)) {
      return PieceReason::folding;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Triangle> laid_together(std::uint32_t cut) const {
    const std::uint32_t twin = patch_.twin[cut];
    const Triangle& a = layout_.flat[cut / 3];
    const Triangle& b = layout_.flat[twin / 3];
    const Rigid motion = lay_across(a[cut % 3], a[(cut + 1) % 3], b[twin % 3], b[(twin + 1) % 3]);
    std::vector<Triangle> both;
    for (const std::uint32_t f : layout_.faces[layout_.piece[cut / 3]]) {
      both.push_back(layout_.flat[f]);
    }
    for (const std::uint32_t f : layout_.faces[layout_.piece[twin / 3]]) {
      const Triangle& t = layout_.flat[f];
      both.push_back({motion(t[0]), motion(t[1]), motion(t[2])});
    }
    return both;
  }

  [[nodiscard]] bool fold_together(std::uint32_t cut, const Context& context) const {
    std::vector<std::uint32_t> faces = layout_.faces[layout_.piece[cut / 3]];
    const auto& more = layout_.faces[layout_.piece[patch_.twin[cut] / 3]];
    faces.insert(faces.end(), more.begin(), more.end());
    std::sort(faces.begin(), faces.end());
    Folds joined = folds_;
    set_fold(patch_, joined, cut, true);
    return folds_together(sub_patch(patch_, faces), sub_folds(patch_, joined, faces), context);
  }

  const NetProblem& problem_;
  const Patch& patch_;
  const Folds& folds_;
  const Nets& nets_;
  Layout layout_;
  std::vector<std::size_t> panels_;  ///< per piece of the layout
};

/// Of the pieces of a part's connected set that are there because of overlap as many as it is proven to need.
void find_proofs(const NetProblem& problem, Nets& nets, const Context& context) {
  const Patch& patch = problem.patch;
  DisjointSets sets = connected_faces(patch, problem.part);
  std::map<std::uint32_t, std::vector<PieceId>> overlapping;  // by what hangs together
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const Piece& piece = nets.pieces[p];
    if (piece.reason == PieceReason::overlap && piece.parts.size() == 1) {
      overlapping[sets.find(piece.faces.front().value())].push_back(p);
    }
  }
  for (const auto& [set, pieces] : overlapping) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < patch.size(); ++f) {
      if (sets.find(f) == set) {
        faces.push_back(f);
      }
    }
    const std::size_t least =
        least_trees(sub_patch(patch, faces), {problem.tolerance(), most_proven_panels, proof_pairs}, context);
    for (std::size_t i = 0; i + 1 < least && i < pieces.size(); ++i) {
      nets.pieces[pieces[i]].reason = PieceReason::no_net;
    }
  }
}

}  // namespace

void find_reasons(const NetProblem& problem, const Folds& folds, Nets& nets, const Context& context) {
  const Pieces pieces(problem, folds, nets);
  DisjointSets bodies = connected_faces(problem.patch);
  std::vector<PieceId> others;
  std::set<PartId> parts;
  std::set<std::pair<PartId, std::uint32_t>> parts_of_bodies;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    Piece& piece = nets.pieces[p];
    const bool first_of_part = parts.insert(piece.main_part).second;
    const std::uint32_t body = bodies.find(piece.faces.front().value());
    if (!parts_of_bodies.emplace(piece.main_part, body).second) {
      others.push_back(p);
    } else if (!first_of_part) {
      piece.reason = pieces.reason_apart(piece);
    }
  }
  do_in_parallel(others.size(), context, [&](std::size_t i, const Context& own) {
    nets.pieces[others[i]].reason = pieces.reason_of(nets.pieces[others[i]], own);
  });
  find_proofs(problem, nets, context);
}

}  // namespace ridgecraft::unfold
