// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/fewer_pieces.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/patch_nets.hpp"
#include "unfold/pieces/piece_borders.hpp"
#include "unfold/pieces/trees_together.hpp"

namespace ridgecraft::unfold {
namespace {

using Faces = std::vector<std::uint32_t>;

/// The connected sets of faces, each ascending.
std::vector<Faces> bodies_of(const Patch& patch) {
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != nothing) {
      sets.join(side / 3, patch.twin[side] / 3);
    }
  }
  std::vector<Faces> bodies(patch.size());
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    bodies[sets.find(f)].push_back(f);
  }
  std::erase_if(bodies, [](const Faces& faces) { return faces.empty(); });
  return bodies;
}

/// One body and its forest.
class Body {
 public:
  Body(Patch patch, Folds folds, const Room& room)
      : patch_(std::move(patch)), folds_(std::move(folds)), room_(room), least_(least_pieces(patch_, room)) {}

  [[nodiscard]] const Folds& folds() const { return folds_; }

  /// All of it as one part.
  void unfold_as_one(PanelCuts cuts, std::uint64_t seed, const Context& context) {
    if (pieces() > least_) {
      take_if_fewer(
          unfold_patch(patch_, room_, cuts, net_tolerance(patch_.extent), seed, Effort::full, context).folds);
    }
  }

  /// A few of its pieces one fewer; false where none can be saved. `failed`: what was tried in vain, by
  /// faces.
  bool save_a_piece(TreesTogether& trees, std::set<Faces>& failed, const Context& context) {
    if (pieces() <= least_) {
      return false;
    }
    const Layout layout = lay_out(patch_, folds_);
    for (const std::vector<std::uint32_t>& together : unions(layout)) {
      context.check();
      if (context.out_of_time()) {
        return false;
      }
      const PiecesTogether all = pieces_together(patch_, folds_, layout, together);
      if (failed.contains(all.faces)) {
        continue;
      }
      if (const std::optional<Folds> fewer = trees.one_fewer(all)) {
        put_back(patch_, all.faces, *fewer, folds_);
        return true;
      }
      failed.insert(all.faces);
    }
    return false;
  }

 private:
  [[nodiscard]] std::size_t pieces() const { return lay_out(patch_, folds_).faces.size(); }

  void take_if_fewer(Folds folds) {
    if (lay_out(patch_, folds).faces.size() < pieces() && all_fit(patch_, folds, room_)) {
      folds_ = std::move(folds);
    }
  }

  /// Sets of pieces, each beginning with the one that joins another: pairs, threes, all.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> unions(const Layout& layout) const {
    const std::vector<PieceBorder> borders = piece_borders(patch_, layout.piece);
    std::vector<std::vector<std::uint32_t>> sets;
    for (const PieceBorder& border : borders) {
      sets.push_back({border.a, border.b});
    }
    for (const PieceBorder& border : borders) {
      for (const PieceBorder& next : borders) {
        for (const auto& [at, beyond] : {std::pair(next.a, next.b), std::pair(next.b, next.a)}) {
          if ((at == border.a || at == border.b) && beyond != border.a && beyond != border.b) {
            sets.push_back({border.a, border.b, beyond});
          }
        }
      }
    }
    if (layout.faces.size() > 3) {
      std::vector<std::uint32_t>& all = sets.emplace_back();
      for (std::uint32_t p = 0; p < layout.faces.size(); ++p) {
        all.push_back(p);
      }
    }
    return sets;
  }

  Patch patch_;
  Folds folds_;
  const Room& room_;
  std::size_t least_;  ///< pieces that no arrangement can do without
};

}  // namespace

Folds fewer_pieces(const NetProblem& problem, const Folds& folds, const Context& context) {
  const Patch& patch = problem.patch;
  Folds result = folds;
  Random random(context.seed);
  TreesTogether trees(problem, context);
  for (const Faces& faces : bodies_of(patch)) {
    if (context.out_of_time()) {
      break;
    }
    Body body(sub_patch(patch, faces), sub_folds(patch, result, faces), problem.room);
    body.unfold_as_one(problem.options.panel_cuts, random.next(), context);
    std::set<Faces> failed;
    while (body.save_a_piece(trees, failed, context)) {
    }
    put_back(patch, faces, body.folds(), result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
