// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/turned_branches.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/pieces/turn_powers.hpp"
#include "unfold/pieces/unit_images.hpp"

namespace ridgecraft::unfold {
namespace {

constexpr int most_branch_steps = 8;
/// Trials of a piece in a step; the largest branches come first. Those whose images are like them count, too.
constexpr std::size_t most_branch_trials = 32;

/// What falls off a piece where one fold is cut.
struct Offshoot {
  std::uint32_t side = 0;  ///< of one of its faces: the fold that it hangs by
  std::uint32_t piece = 0;
  std::vector<std::uint32_t> faces;  ///< ascending
};

/// An image of a branch that can get its net.
struct Copy {
  std::vector<std::uint32_t> faces;  ///< ascending
  std::uint32_t side = 0;            ///< the image of the fold that the branch hangs by
  Folds tree;                        ///< of the sub-patch of the faces
};

class BranchTurning {
 public:
  BranchTurning(const mesh::Surface& surface, const Patch& patch, const prepare::PartialRotation& turn,
                const IdVector<EdgeId, EdgeId>& mirrored, const Weights& weights, const Room& room,
                double tolerance, const Context& context)
      : surface_(surface),
        patch_(patch),
        turned_(turn.edge),
        mirrored_(mirrored),
        weights_(weights),
        room_(room),
        tolerance_(tolerance),
        context_(context),
        unit_(units_of(patch)),
        faces_of_unit_(patch.size()),
        side_of_(surface.edge_count(), nothing),
        powers_(powers_of(turn, surface, patch, unit_)),
        stamp_(patch.size(), 0) {
    for (std::uint32_t f = 0; f < patch.size(); ++f) {
      faces_of_unit_[unit_[f]].push_back(f);
    }
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      if (patch.twin[side] != nothing) {
        side_of_[surface.edge(mesh::corner(patch.face[side / 3], side % 3))] = side;
      }
    }
    for (const TurnPower& power : powers_) {
      std::vector<IdVector<EdgeId, EdgeId>>& of_power = from_.emplace_back();
      for (unsigned k = 0; k < power.order; ++k) {
        of_power.push_back(repeated(power.from, k));
      }
    }
  }

  Folds run(const Folds& folds) {
    best_ = folds;
    least_ = cost_of(best_);
    for (int step = 0; step < most_branch_steps && !context_.out_of_time(); ++step) {
      const Folds before = best_;
      const Layout layout = lay_out(patch_, before);
      for (std::uint32_t piece = 0; piece < layout.faces.size(); ++piece) {
        try_branches_of(before, layout, piece);
      }
      if (best_ == before) {
        break;
      }
    }
    return best_;
  }

 private:
  void try_branches_of(const Folds& before, const Layout& layout, std::uint32_t piece) {
    std::size_t trials = 0;
    std::set<std::pair<std::size_t, std::uint32_t>>
        even;  // powers, and sides whose branches are alike by them
    for (const std::uint32_t side : places_of(before, layout.faces[piece])) {
      for (std::size_t p = 0; p < powers_.size(); ++p) {
        if (trials == most_branch_trials || context_.out_of_time()) {
          return;
        }
        if (even.contains({p, side}) || !may_have_images(powers_[p], layout, side)) {
          continue;
        }
        context_.check();
        const Offshoot branch{side, piece, faces_behind(before, side)};
        const std::vector<Copy> copies = copies_of(p, before, layout, branch);
        if (copies.empty()) {
          continue;
        }
        ++trials;
        const std::optional<Folds> trial = hung_alike(copies, before, layout, branch);
        if (trial && *trial == before) {
          for (const Copy& copy : copies) {
            even.emplace(p, copy.side);
          }
        } else if (const double cost = trial ? cost_of(*trial) : least_; cost < least_ - same_cost_mm) {
          least_ = cost;
          best_ = *trial;
        }
      }
    }
  }

  /// Of each fold of a piece that may be cut the side on which less of it lies: where most lies first.
  [[nodiscard]] std::vector<std::uint32_t> places_of(const Folds& folds,
                                                     const std::vector<std::uint32_t>& piece) const {
    std::map<std::uint32_t, std::uint32_t> to_root;  // per face the side towards the root
    std::map<std::uint32_t, std::uint32_t> size;
    struct Place {
      std::uint32_t size, side;
    };
    std::vector<Place> places;
    for (const std::uint32_t f : piece) {
      const auto own = to_root.find(f);
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (folds[side] != 0 && (own == to_root.end() || side != own->second)) {
          to_root[patch_.twin[side] / 3] = patch_.twin[side];
        }
      }
      size[f] = 1;
    }
    for (std::size_t i = piece.size(); i-- > 1;) {
      const std::uint32_t side = to_root.at(piece[i]);
      const std::uint32_t below = size[piece[i]];
      size[patch_.twin[side] / 3] += below;
      const auto above = static_cast<std::uint32_t>(piece.size()) - below;
      if (patch_.frozen[side] == 0) {
        places.push_back(below <= above ? Place{below, side} : Place{above, patch_.twin[side]});
      }
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.size > b.size; });
    std::vector<std::uint32_t> sides;
    for (const Place& place : places) {
      sides.push_back(place.side);
    }
    return sides;
  }

  /// Whether some image of the face at this side lies in its piece, elsewhere.
  [[nodiscard]] bool may_have_images(const TurnPower& turn, const Layout& layout, std::uint32_t side) const {
    const std::uint32_t own = unit_[side / 3];
    std::uint32_t image = own;
    for (unsigned k = 1; k < turn.order && image != nothing; ++k) {
      image = turn.unit[image];
      if (image != nothing && image != own && layout.piece[image] == layout.piece[own]) {
        return true;
      }
    }
    return false;
  }

  /// What hangs together with the face of this side when its fold is cut.
  [[nodiscard]] std::vector<std::uint32_t> faces_behind(const Folds& folds, std::uint32_t cut) const {
    std::vector<std::uint32_t> faces{cut / 3};
    std::vector<std::uint32_t> sides{cut};  // of each face, where one came from
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::uint32_t side = 3 * faces[i]; side < 3 * faces[i] + 3; ++side) {
        if (folds[side] != 0 && side != sides[i]) {
          faces.push_back(patch_.twin[side] / 3);
          sides.push_back(patch_.twin[side]);
        }
      }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
  }

  /// Images of a branch within its piece that meet neither it nor each other, with its net.
  [[nodiscard]] std::vector<Copy> copies_of(std::size_t power, const Folds& folds, const Layout& layout,
                                            const Offshoot& branch) {
    const TurnPower& turn = powers_[power];
    std::vector<std::uint32_t> images;
    for (const std::uint32_t f : branch.faces) {
      if (unit_[f] == f) {
        images.push_back(f);
      }
    }
    ++taken_;
    for (const std::uint32_t u : images) {
      stamp_[u] = taken_;
    }
    std::vector<Copy> copies;
    std::optional<Patch> own;
    Folds tree;
    for (unsigned k = 1; k < turn.order; ++k) {
      for (std::uint32_t& image : images) {
        image = image == nothing ? nothing : turn.unit[image];
      }
      const bool is_free = std::all_of(images.begin(), images.end(), [&](std::uint32_t u) {
        return u != nothing && layout.piece[u] == branch.piece && stamp_[u] != taken_;
      });
      if (!is_free) {
        continue;
      }
      if (!own) {
        own = sub_patch(patch_, branch.faces);
        tree = sub_folds(patch_, folds, branch.faces);
      }
      if (std::optional<Copy> copy = copy_at(power, k, branch, *own, tree, images)) {
        for (const std::uint32_t u : images) {
          stamp_[u] = taken_;
        }
        copies.push_back(std::move(*copy));
      }
    }
    return copies;
  }

  [[nodiscard]] std::optional<Copy> copy_at(std::size_t power, unsigned k, const Offshoot& branch,
                                            const Patch& own, const Folds& tree,
                                            const std::vector<std::uint32_t>& units) const {
    const TurnPower& turn = powers_[power];
    Copy copy;
    for (const std::uint32_t u : units) {
      copy.faces.insert(copy.faces.end(), faces_of_unit_[u].begin(), faces_of_unit_[u].end());
    }
    std::sort(copy.faces.begin(), copy.faces.end());
    const bool is_one_to_one = std::adjacent_find(copy.faces.begin(), copy.faces.end()) == copy.faces.end();
    EdgeId edge = surface_.edge(mesh::corner(patch_.face[branch.side / 3], branch.side % 3));
    for (unsigned i = 0; i < k && edge.valid(); ++i) {
      edge = turn.edge[edge];
    }
    if (!is_one_to_one || !edge.valid() || side_of_[edge] == nothing) {
      return std::nullopt;
    }
    copy.side = side_of_[edge];
    if (!std::binary_search(copy.faces.begin(), copy.faces.end(), copy.side / 3)) {
      copy.side = patch_.twin[copy.side];
    }
    const std::uint32_t within = copy.side / 3;
    const std::uint32_t beyond = patch_.twin[copy.side] / 3;
    if (!std::binary_search(copy.faces.begin(), copy.faces.end(), within) ||
        std::binary_search(copy.faces.begin(), copy.faces.end(), beyond)) {
      return std::nullopt;
    }
    std::optional<Folds> carried =
        carried_over(surface_, own, tree, sub_patch(patch_, copy.faces), from_[power][k]);
    if (!carried) {
      return std::nullopt;
    }
    copy.tree = std::move(*carried);
    return copy;
  }

  void set_fold(Folds& folds, std::uint32_t side, bool is_fold) const {
    folds[side] = folds[patch_.twin[side]] = is_fold ? 1 : 0;
  }

  /// The pieces with these images of a branch like it, `before` where they are; nothing where that isn't one
  /// clean net.
  [[nodiscard]] std::optional<Folds> hung_alike(const std::vector<Copy>& copies, const Folds& before,
                                                const Layout& layout, const Offshoot& branch) const {
    Folds result = before;
    for (const Copy& copy : copies) {
      for (const std::uint32_t f : copy.faces) {
        for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
          if (result[side] != 0) {
            set_fold(result, side, false);
          }
        }
      }
    }
    for (const Copy& copy : copies) {
      put_back(patch_, copy.faces, copy.tree, result);
      if (layout.piece[patch_.twin[copy.side] / 3] != branch.piece) {
        return std::nullopt;
      }
      set_fold(result, copy.side, true);
    }
    std::vector<std::uint32_t> faces = layout.faces[branch.piece];
    std::sort(faces.begin(), faces.end());
    if (result == before) {
      return result;
    }
    if (!make_whole(faces, before, result)) {
      return std::nullopt;
    }
    const Patch piece = sub_patch(patch_, faces);
    const Folds tree = sub_folds(patch_, result, faces);
    const bool fits = all_fit(piece, tree, room_) || !all_fit(piece, sub_folds(patch_, before, faces), room_);
    return fits && find_overlaps(lay_out(piece, tree), tolerance_).empty() ? std::optional(std::move(result))
                                                                           : std::nullopt;
  }

  /// Folds what has come loose where it was folded before. False where that isn't enough, or there are rings.
  [[nodiscard]] bool make_whole(const std::vector<std::uint32_t>& faces, const Folds& before,
                                Folds& result) const {
    DisjointSets joined(patch_.size());
    std::size_t joins = 0;
    const auto each_side = [&](const auto& visit) {
      for (const std::uint32_t f : faces) {
        for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
          if (patch_.twin[side] != nothing && side < patch_.twin[side]) {
            visit(side);
          }
        }
      }
    };
    bool is_forest = true;
    each_side([&](std::uint32_t side) {
      if (result[side] != 0) {
        const bool is_new = joined.join(side / 3, patch_.twin[side] / 3);
        is_forest = is_forest && is_new;
        joins += is_new ? 1 : 0;
      }
    });
    each_side([&](std::uint32_t side) {
      if (before[side] != 0 && result[side] == 0 && joined.join(side / 3, patch_.twin[side] / 3)) {
        set_fold(result, side, true);
        ++joins;
      }
    });
    return is_forest && joins + 1 == faces.size();
  }

  [[nodiscard]] double cost_of(const Folds& folds) const {
    const std::array images{&turned_, &mirrored_};
    return cost_of_forest(surface_, patch_, folds, images, weights_);
  }

  const mesh::Surface& surface_;
  const Patch& patch_;
  const IdVector<EdgeId, EdgeId>& turned_;
  const IdVector<EdgeId, EdgeId>& mirrored_;
  const Weights& weights_;
  const Room& room_;
  double tolerance_;
  const Context& context_;
  const std::vector<std::uint32_t> unit_;
  std::vector<std::vector<std::uint32_t>> faces_of_unit_;
  IdVector<EdgeId, std::uint32_t> side_of_;  ///< one side of each edge within the patch
  const std::vector<TurnPower> powers_;
  std::vector<std::vector<IdVector<EdgeId, EdgeId>>> from_;  ///< per power and times: as TurnPower::from
  std::vector<std::uint32_t> stamp_;                         ///< per unit: taken by the branch of this number
  std::uint32_t taken_ = 0;
  Folds best_;
  double least_ = 0.0;
};

}  // namespace

Folds turned_branches(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                      const prepare::PartialRotation& turn, const IdVector<EdgeId, EdgeId>& mirrored,
                      const Weights& weights, const Room& room, double tolerance, const Context& context) {
  return BranchTurning(surface, patch, turn, mirrored, weights, room, tolerance, context).run(folds);
}

}  // namespace ridgecraft::unfold
