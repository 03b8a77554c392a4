// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/even_pieces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/carried_trees.hpp"
#include "unfold/pieces/mirror_units.hpp"

namespace ridgecraft::unfold {
namespace {

using Faces = std::vector<std::uint32_t>;

class Evening {
 public:
  Evening(const NetProblem& problem, const Folds& folds, const MirrorImages& images,
          const IdVector<EdgeId, EdgeId>& turned, const Context& context)
      : problem_(problem),
        patch_(problem.patch),
        folds_(folds),
        images_(images),
        turned_(turned),
        units_(problem.surface, problem.patch, images),
        layout_(lay_out(problem.patch, folds)),
        trees_(problem, folds_, layout_, context) {
    crosses_ = units_.crossing(patch_, folds_, layout_.piece);
  }

  Folds run() {
    Folds best = folds_;
    double least = cost_of(folds_);
    for (const bool above : {true, false}) {
      const std::optional<Folds> even = evened(above);
      if (even) {
        const double cost = cost_of(*even);
        if (cost < least - same_cost_mm) {
          least = cost;
          best = *even;
        }
      }
    }
    return best;
  }

 private:
  /// The pieces to be, those that are mirror images of others last, with what each is.
  [[nodiscard]] std::vector<std::pair<MirrorLabel, Faces>> pieces_of(bool above) const {
    std::vector<std::pair<MirrorLabel, Faces>> pieces =
        connected_labels(patch_, units_.carried_over(layout_.piece, crosses_, above));
    std::stable_partition(pieces.begin(), pieces.end(),
                          [](const auto& piece) { return !piece.first.is_image; });
    return pieces;
  }

  /// The forest of these pieces; nothing where there are too many, or one has no net.
  std::optional<Folds> evened(bool above) {
    const std::vector<std::pair<MirrorLabel, Faces>> pieces = pieces_of(above);
    if (pieces.size() > layout_.faces.size()) {
      return std::nullopt;
    }
    Folds result(folds_.size(), 0);
    std::map<std::uint32_t, Faces> original;
    for (const auto& [label, faces] : pieces) {
      const std::optional<Folds> tree = label.is_image && original.count(label.of) != 0
                                            ? trees_.image_of(original[label.of], faces, result, images_.edge)
                                            : trees_.tree_of(faces);
      if (!tree) {
        return std::nullopt;
      }
      put_back(patch_, faces, *tree, result);
      if (!label.is_image) {
        original[label.of] = faces;
      }
    }
    return all_fit(patch_, result, problem_.room) || !all_fit(patch_, folds_, problem_.room)
               ? std::optional(std::move(result))
               : std::nullopt;
  }

  [[nodiscard]] double cost_of(const Folds& folds) const {
    const std::array images{&images_.edge, &turned_};
    return cost_of_forest(problem_.surface, patch_, folds, images, problem_.weights());
  }

  const NetProblem problem_;
  const Patch& patch_;
  const Folds& folds_;
  const MirrorImages& images_;
  const IdVector<EdgeId, EdgeId>& turned_;
  const MirrorUnits units_;
  const Layout layout_;
  CarriedTrees trees_;
  std::vector<std::uint8_t> crosses_;  ///< per piece of the forest that was given: does it lie on both sides?
};

}  // namespace

Folds even_pieces(const NetProblem& problem, const Folds& folds, const MirrorImages& images,
                  const IdVector<EdgeId, EdgeId>& turned, const Context& context) {
  if (images.edge.empty() || context.out_of_time()) {
    return folds;
  }
  return Evening(problem, folds, images, turned, context).run();
}

}  // namespace ridgecraft::unfold
