// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/better_trees.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/folding/free_folding.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/objective.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {
namespace {

/// What a piece that folds freely may cost more, mm of seam (piece_rules.hpp).
constexpr double worth_of_free_folding_mm = 100.0;

/// One piece and its tree.
class PieceTree {
 public:
  PieceTree(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
            const Folds& folds, const std::vector<std::uint32_t>& faces,
            const IdVector<EdgeId, EdgeId>& mirrored, const Options& options, const Room& room, Random random,
            const Context& context)
      : options_(options),
        room_(room),
        context_(context),
        random_(random),
        piece_(sub_patch(patch, faces)),
        panels_(panel_count(piece_)),
        mirror_(mirror_sides(surface, piece_, mirrored)),
        net_(surface, panels, piece_, sub_folds(patch, folds, faces), options.tabs,
             net_tolerance(piece_.extent)) {
    // The sequence is used from its second number on: nets that people have already come from there.
    static_cast<void>(random_.next());
    fits_ = room_.holds(net_.hull(), panels_);
  }

  Folds improved() {
    PieceCost shape(piece_, one_part, options_.pieces.weights);
    const double bare = options_.tabs.wanted ? options_.pieces.weights.bare : 0.0;
    const auto cost = [&](ChangingNet& net) -> std::optional<double> {
      const std::vector<Vec2> hull = net.hull();
      if (fits_ && !room_.holds(hull, panels_)) {
        return std::nullopt;
      }
      return shape.of(net.folds(), hull) - bare * net.held_mm() +
             options_.pieces.weights.mirror * unevenness(net.folds());
    };
    const double worth =
        options_.pieces.fold_linear ? std::numeric_limits<double>::infinity() : worth_of_free_folding_mm;
    fold_freely(net_, cost, worth, random_.next(), context_);
    return net_.folds();
  }

 private:
  /// Length of the cuts whose mirror image in this piece is none, mm.
  [[nodiscard]] double unevenness(const Folds& folds) const {
    double sum = 0.0;
    for (std::uint32_t side = 0; side < folds.size(); ++side) {
      const bool uneven = mirror_[side] != nothing && folds[side] == 0 && folds[mirror_[side]] != 0;
      sum += uneven ? 0.5 * piece_.length[side] : 0.0;
    }
    return sum;
  }

  const Options& options_;
  const Room& room_;
  const Context& context_;
  Random random_;
  const Patch piece_;
  std::size_t panels_;
  const std::vector<std::uint32_t> mirror_;  ///< per side (mirror_sides)
  ChangingNet net_;
  bool fits_ = false;  ///< the piece, before its tree was changed
};

/// For each piece an earlier one that is its mirror image, faces and folds, or its own number.
std::vector<std::size_t> images_of_pieces(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                                          const std::vector<std::vector<std::uint32_t>>& pieces,
                                          const IdVector<EdgeId, EdgeId>& mirrored) {
  std::vector<std::size_t> image(pieces.size());
  std::iota(image.begin(), image.end(), std::size_t{0});
  if (mirrored.empty()) {
    return image;
  }
  const auto edge_of = [&](std::uint32_t side) {
    return surface.edge(mesh::corner(patch.face[side / 3], side % 3));
  };
  IdVector<EdgeId, std::size_t> folded_in(surface.edge_count(), pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const std::uint32_t f : pieces[i]) {
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (folds[side] != 0) {
          folded_in[edge_of(side)] = i;
        }
      }
    }
  }
  const auto where_image_is = [&](std::size_t i) {
    for (const std::uint32_t f : pieces[i]) {
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (folds[side] != 0 && mirrored[edge_of(side)].valid()) {
          return folded_in[mirrored[edge_of(side)]];
        }
      }
    }
    return i;
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::size_t other = where_image_is(i);
    if (other < i && pieces[other].size() == pieces[i].size() &&
        carried_over(surface, sub_patch(patch, pieces[other]), sub_folds(patch, folds, pieces[other]),
                     sub_patch(patch, pieces[i]), mirrored)) {
      image[i] = other;
    }
  }
  return image;
}

}  // namespace

Folds better_trees(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                   const Folds& folds, const IdVector<EdgeId, EdgeId>& mirrored, const Options& options,
                   const Room& room, const Context& context) {
  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;
  for (std::vector<std::uint32_t>& faces : pieces) {
    std::sort(faces.begin(), faces.end());
  }
  const std::vector<std::size_t> image = images_of_pieces(surface, patch, folds, pieces, mirrored);
  std::vector<Folds> trees(pieces.size());
  const auto improve = [&](std::size_t i, const Context& own) {
    // Parts were unfolded with the streams of the seed itself.
    const Random random = Random::stream(~context.seed, i);
    trees[i] = own.out_of_grace()
                   ? sub_folds(patch, folds, pieces[i])
                   : PieceTree(surface, panels, patch, folds, pieces[i], mirrored, options, room, random, own)
                         .improved();
  };
  do_in_parallel(
      pieces.size(), context,
      [&](std::size_t i, const Context& own) {
        if (image[i] == i) {
          improve(i, own);
        }
      },
      [&](std::size_t done) {
        context.report("unfold", 0.8 + 0.2 * static_cast<double>(done) / static_cast<double>(pieces.size()));
      });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (image[i] == i) {
      continue;
    }
    const Patch own = sub_patch(patch, pieces[i]);
    const std::optional<Folds> tree =
        carried_over(surface, sub_patch(patch, pieces[image[i]]), trees[image[i]], own, mirrored);
    // The image may be off by what the eye doesn't see, but a net may not.
    if (tree && all_fit(own, *tree, room) && find_overlaps(lay_out(own, *tree), net_tolerance(own.extent)).empty()) {
      trees[i] = *tree;
    } else {
      improve(i, context);
    }
  }
  Folds result = folds;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    put_back(patch, pieces[i], trees[i], result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
