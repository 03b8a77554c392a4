// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/ragged_pieces.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "unfold/energy/bands.hpp"
#include "unfold/energy/piece_cost.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

using Faces = std::vector<std::uint32_t>;

/// So many folds of a piece are measured: those where outline, seam and number of pieces alone save most.
constexpr std::size_t most_measured = 8;

/// A piece, and what it costs.
struct Costed {
  Faces faces;  ///< ascending
  double cost = 0.0;
};

class RaggedPieces {
 public:
  RaggedPieces(const Patch& patch, std::span<const PartId> part, Folds folds, const Weights& weights,
               const Context& context)
      : patch_(patch),
        part_(part),
        folds_(std::move(folds)),
        weights_(weights),
        context_(context),
        bands_(weights.bands > 0.0 ? find_bands(patch) : Bands()),
        place_(patch.size(), nothing) {}

  Folds run() {
    std::vector<Costed> open;
    for (Faces& faces : lay_out(patch_, folds_).faces) {
      open.push_back(costed(std::move(faces)));
    }
    while (!open.empty()) {
      context_.check();
      const Costed piece = std::move(open.back());
      open.pop_back();
      if (auto halves = cut(piece)) {
        open.push_back(std::move((*halves)[0]));
        open.push_back(std::move((*halves)[1]));
      }
    }
    return std::move(folds_);
  }

 private:
  [[nodiscard]] Costed costed(Faces faces) const {
    std::sort(faces.begin(), faces.end());
    std::set<PartId> parts;
    for (const std::uint32_t f : faces) {
      parts.insert(part_[f]);
    }
    const double cost =
        cost_of_piece(sub_patch(patch_, faces), sub_folds(patch_, folds_, faces), parts.size(), weights_);
    return {std::move(faces), cost};
  }

  [[nodiscard]] bool is_rung(std::uint32_t side) const {
    return !bands_.empty() && bands_.band[side] != nothing;
  }

  /// Where the outline in front of and behind a fold would cost so much less, by its place in the tree.
  [[nodiscard]] std::vector<std::pair<double, std::size_t>> promising(const RootedTree& tree) const {
    std::vector<double> outline(tree.order.size(), 0.0);  // of the face with all that hangs on it
    for (std::size_t i = 0; i < outline.size(); ++i) {
      for (std::uint32_t side = 3 * tree.order[i]; side < 3 * tree.order[i] + 3; ++side) {
        outline[i] += folds_[side] == 0 ? patch_.length[side] : 0.0;
      }
    }
    for (std::size_t i = outline.size(); i-- > 1;) {
      outline[tree.parent[i]] += outline[i];
    }
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t i = 1; i < outline.size(); ++i) {
      const double fold = patch_.length[tree.up[i]];
      const double saved = outline_cost(outline[0], weights_) - outline_cost(outline[i] + fold, weights_) -
                           outline_cost(outline[0] - outline[i] + fold, weights_) -
                           seam_price(patch_, tree.up[i], weights_);
      if (patch_.frozen[tree.up[i]] == 0 && !is_rung(tree.up[i]) && saved > 0.0) {
        found.emplace_back(-saved, i);
      }
    }
    const std::size_t measured = std::min(most_measured, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(measured), found.end());
    found.resize(measured);
    return found;
  }

  /// Both halves, if the piece is cut.
  std::optional<std::array<Costed, 2>> cut(const Costed& piece) {
    const RootedTree tree = rooted_tree(patch_, folds_, piece.faces.front(), place_);
    std::optional<std::array<Costed, 2>> best;
    std::uint32_t best_side = nothing;
    double least = piece.cost;
    for (const auto& [saved, at] : promising(tree)) {
      const std::uint32_t side = tree.up[at];
      set_fold(patch_, folds_, side, false);
      std::array<Costed, 2> halves{half(side), half(patch_.twin[side])};
      set_fold(patch_, folds_, side, true);
      if (const double cost = halves[0].cost + halves[1].cost; cost < least) {
        least = cost;
        best = std::move(halves);
        best_side = side;
      }
    }
    if (best) {
      set_fold(patch_, folds_, best_side, false);
    }
    return best;
  }

  /// What hangs together with the face of this side.
  Costed half(std::uint32_t side) { return costed(rooted_tree(patch_, folds_, side / 3, place_).order); }

  const Patch& patch_;
  std::span<const PartId> part_;
  Folds folds_;
  const Weights& weights_;
  const Context& context_;
  Bands bands_;
  std::vector<std::uint32_t> place_;  ///< space to work in
};

}  // namespace

Folds with_ragged_pieces_cut(const Patch& patch, std::span<const PartId> part, const Folds& folds,
                             const Weights& weights, const Context& context) {
  return RaggedPieces(patch, part, folds, weights, context).run();
}

}  // namespace ridgecraft::unfold
