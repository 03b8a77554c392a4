// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/turned_pieces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/carried_trees.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/pieces/turn_powers.hpp"
#include "unfold/pieces/unit_images.hpp"

namespace ridgecraft::unfold {
namespace {

/// Of the length of all edges so much has to be turned onto edges, at least.
constexpr double least_share_turned = 0.5;
/// What half a turn takes elsewhere is a pair.
constexpr unsigned least_order_turned = 3;
/// Steps, and trials in each; the largest pieces come first.
constexpr int most_steps = 6;
constexpr std::size_t most_trials = 32;
/// What is left of a piece goes on as one if it is more than this share of it.
constexpr double goes_on = 0.5;
using TurnedFaces = std::vector<std::uint32_t>;

class Turning {
 public:
  Turning(const NetProblem& problem, const IdVector<EdgeId, EdgeId>& mirrored,
          const prepare::PartialRotation& turn, const Context& context)
      : problem_(problem),
        surface_(problem.surface),
        patch_(problem.patch),
        mirrored_(mirrored),
        turned_(turn.edge),
        weights_(problem.weights()),
        room_(problem.room),
        context_(context),
        unit_(units_of(patch_)),
        faces_of_unit_(patch_.size()),
        turns_(powers_of(turn, surface_, patch_, unit_)) {
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      faces_of_unit_[unit_[f]].push_back(f);
    }
  }

  Folds run(const Folds& folds) {
    Folds best = folds;
    double least = cost_of(best);
    for (int step = 0; step < most_steps && !context_.out_of_time(); ++step) {
      const Folds before = best;
      const Layout layout = lay_out(patch_, before);
      std::vector<std::uint32_t> pieces = by_area(layout);
      std::size_t trials = 0;
      for (const TurnPower& turn : turns_) {
        for (const std::uint32_t piece : pieces) {
          if (trials == most_trials || context_.out_of_time()) {
            break;
          }
          const std::optional<Folds> trial = carried_around(turn, before, layout, piece, trials);
          const double cost = trial ? cost_of(*trial) : least;
          if (cost < least - same_cost_mm) {
            least = cost;
            best = *trial;
          }
        }
      }
      if (best == before) {
        break;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] std::vector<std::uint32_t> by_area(const Layout& layout) const {
    std::vector<double> area;
    std::vector<std::uint32_t> pieces;
    for (std::uint32_t p = 0; p < layout.faces.size(); ++p) {
      area.push_back(area_of(patch_, layout.faces[p]));
      pieces.push_back(p);
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return area[a] > area[b]; });
    return pieces;
  }

  /// Per face the number of the turns that take the piece there, `nothing` elsewhere; nothing at all where
  /// faces of the piece have no image, or it meets its own images.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> copies_of(const TurnPower& turn,
                                                                    const TurnedFaces& piece) const {
    std::vector<std::uint32_t> copy(patch_.size(), nothing);
    for (const std::uint32_t f : piece) {
      std::uint32_t u = unit_[f];
      if (copy[u] == 0) {
        continue;  // another face of a unit that is done
      }
      const std::uint32_t own = u;
      for (std::uint32_t k = 0; k < turn.order; ++k) {
        if (u == nothing || copy[u] != nothing || faces_of_unit_[u].size() != faces_of_unit_[own].size()) {
          return std::nullopt;
        }
        copy[u] = k;
        u = turn.unit[u];
      }
      if (u != own) {
        return std::nullopt;
      }
    }
    std::vector<std::uint32_t> of_face(patch_.size(), nothing);
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      of_face[f] = copy[unit_[f]];
    }
    return of_face;
  }

  /// Sets of faces of a new division; which of them are copies of the piece, by their number.
  struct Division {
    std::vector<TurnedFaces> sets;
    std::vector<std::uint32_t> copy;  ///< per set: by how many turns, or nothing
  };

  /// The copies, and what is left of all pieces. Nothing where a copy would fall apart.
  [[nodiscard]] std::optional<Division> divided(const TurnPower& turn, const Layout& layout,
                                                const std::vector<std::uint32_t>& copy) const {
    const auto label = [&](std::uint32_t f) {
      return copy[f] != nothing ? copy[f] : turn.order + layout.piece[f];
    };
    DisjointSets joined(patch_.size());
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != nothing && label(side / 3) == label(twin / 3)) {
        static_cast<void>(joined.join(side / 3, twin / 3));
      }
    }
    std::vector<std::uint32_t> copies_found(turn.order, nothing);
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      if (copy[f] != nothing) {
        std::uint32_t& found = copies_found[copy[f]];
        if (found != nothing && found != joined.find(f)) {
          return std::nullopt;
        }
        found = joined.find(f);
      }
    }
    if (!join_scraps(layout, copy, joined)) {
      return std::nullopt;
    }
    Division result;
    std::vector<std::uint32_t> place(patch_.size(), nothing);
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      std::uint32_t& at = place[joined.find(f)];
      if (at == nothing) {
        at = static_cast<std::uint32_t>(result.sets.size());
        result.sets.emplace_back();
        result.copy.push_back(copy[f]);
      }
      result.sets[at].push_back(f);
    }
    return result;
  }

  /// What is too little of its piece to go on as one joins the set that it has most of its outline in common
  /// with and that is no copy. False where there is none.
  [[nodiscard]] bool join_scraps(const Layout& layout, const std::vector<std::uint32_t>& copy,
                                 DisjointSets& joined) const {
    std::map<std::uint32_t, double> area;  // of each set that is no copy
    for (std::uint32_t f = 0; f < patch_.size(); ++f) {
      if (copy[f] == nothing) {
        area[joined.find(f)] += area_of(patch_.shape[f]);
      }
    }
    std::map<std::uint32_t, std::map<std::uint32_t, double>> border;  // of each scrap with each such set
    for (const auto& [set, of_set] : area) {
      if (of_set < goes_on * area_of(patch_, layout.faces[layout.piece[set]])) {
        border[set];
      }
    }
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin == nothing || copy[side / 3] != nothing || copy[twin / 3] != nothing) {
        continue;
      }
      const auto scrap = border.find(joined.find(side / 3));
      if (scrap != border.end() && joined.find(twin / 3) != scrap->first) {
        scrap->second[joined.find(twin / 3)] += patch_.length[side];
      }
    }
    for (const auto& [scrap, neighbours] : border) {
      const auto longest = std::max_element(neighbours.begin(), neighbours.end(),
                                            [](const auto& a, const auto& b) { return a.second < b.second; });
      if (longest == neighbours.end()) {
        return false;
      }
      static_cast<void>(joined.join(scrap, longest->first));
    }
    return true;
  }

  std::optional<Folds> carried_around(const TurnPower& turn, const Folds& folds, const Layout& layout,
                                      std::uint32_t piece, std::size_t& trials) {
    TurnedFaces faces = layout.faces[piece];
    std::sort(faces.begin(), faces.end());
    const std::optional<std::vector<std::uint32_t>> copy = copies_of(turn, faces);
    if (!copy) {
      return std::nullopt;
    }
    ++trials;
    const std::optional<Division> division = divided(turn, layout, *copy);
    if (!division || division->sets.size() > layout.faces.size() + 1) {
      return std::nullopt;
    }
    CarriedTrees trees(problem_, folds, layout, context_);
    Folds result(folds.size(), 0);
    put_back(patch_, faces, sub_folds(patch_, folds, faces), result);
    for (std::size_t i = 0; i < division->sets.size(); ++i) {
      const TurnedFaces& set = division->sets[i];
      const std::uint32_t k = division->copy[i];
      if (k == 0) {
        continue;
      }
      std::optional<Folds> tree =
          k == nothing ? trees.tree_of(set) : trees.image_of(faces, set, result, repeated(turn.from, k));
      if (!tree) {
        return std::nullopt;
      }
      put_back(patch_, set, *tree, result);
    }
    return all_fit(patch_, result, room_) || !all_fit(patch_, folds, room_) ? std::optional(std::move(result))
                                                                            : std::nullopt;
  }

  [[nodiscard]] double cost_of(const Folds& folds) const {
    const std::array images{&turned_, &mirrored_};
    return cost_of_forest(surface_, patch_, folds, images, weights_);
  }

  const NetProblem problem_;
  const mesh::Surface& surface_;
  const Patch& patch_;
  const IdVector<EdgeId, EdgeId>& mirrored_;
  const IdVector<EdgeId, EdgeId>& turned_;
  const Weights& weights_;
  const Room& room_;
  const Context& context_;
  const std::vector<std::uint32_t> unit_;
  std::vector<TurnedFaces> faces_of_unit_;
  const std::vector<TurnPower> turns_;
};

}  // namespace

std::optional<prepare::PartialRotation> turn_of(const mesh::Surface& surface, const Weights& weights) {
  if (weights.mirror <= 0.0 || surface.face_count() > most_faces_of_images) {
    return std::nullopt;
  }
  return prepare::widest_rotation(surface, seen_as_image, least_share_turned, least_order_turned);
}

Folds turned_pieces(const NetProblem& problem, const Folds& folds, const prepare::PartialRotation& turn,
                    const IdVector<EdgeId, EdgeId>& mirrored, const Context& context) {
  return Turning(problem, mirrored, turn, context).run(folds);
}

}  // namespace ridgecraft::unfold
