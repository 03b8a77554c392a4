// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/walk.hpp"

#include <algorithm>

#include "base/elementary.hpp"

namespace ridgecraft::unfold {
namespace {

/// Folds that are tried on one path: finding it takes as long as rating a few.
constexpr int folds_per_path = 8;
/// Share of the trials that begin at a cut without room for a tab, or without a mirror image, if a few draws
/// find one.
constexpr double chosen_share = 0.4;
constexpr int draws = 6;
/// The first of two swaps that are made together may cost so much more, mm, than both: the second may win it
/// back.
constexpr double slack_of_pair = 4.0;

/// One side of each cut that could be a fold.
std::vector<std::uint32_t> cuts_of(const Patch& patch, const Folds& folds) {
  std::vector<std::uint32_t> cuts;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != nothing && side < twin && folds[side] == 0 && patch.frozen[side] == 0) {
      cuts.push_back(side);
    }
  }
  return cuts;
}

}  // namespace

Walk::Walk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed)
    : patch_(net.patch()),
      net_(net),
      energy_(energy),
      cuts_(cuts_of(patch_, net.folds())),
      place_(patch_.twin.size(), nothing),
      random_(seed) {
  for (std::uint32_t i = 0; i < cuts_.size(); ++i) {
    place_[cuts_[i]] = i;
  }
}

bool Walk::step(double heat, std::uint64_t& trials) {
  const std::uint32_t cut = cuts_[draw_cut()];
  // As sides: a step that is taken back may leave the tree hung from another root.
  path_.clear();
  for (const std::uint32_t below : net_.tree().removable_between(cut / 3, patch_.twin[cut] / 3)) {
    path_.push_back(net_.tree().side_above(below));
  }
  const auto length = static_cast<std::uint32_t>(path_.size());
  ++trials;
  for (int i = 0; i < folds_per_path && length > 0; ++i, ++trials) {
    const Swap swap = *swap_of(path_[random_.below(length)], cut);
    const double may_cost = -heat * elementary::log(1.0 - random_.unit());
    const std::optional<Swap> mirrored = mirror_image(swap);
    if (mirrored ? make_both(swap, *mirrored, may_cost) : make_one(swap, may_cost)) {
      return true;
    }
  }
  return false;
}

std::uint32_t Walk::draw_cut() {
  const auto count = static_cast<std::uint32_t>(cuts_.size());
  std::uint32_t at = random_.below(count);
  if (random_.unit() < chosen_share) {
    for (int draw = 0; draw < draws && !lacks_tab(cuts_[at]) && !energy_.cut_costs().is_uneven(cuts_[at]);
         ++draw) {
      at = random_.below(count);
    }
  }
  return at;
}

std::uint32_t Walk::join_of(std::uint32_t side) const {
  return std::min(side, patch_.twin[side]);
}

void Walk::exchange(std::uint32_t cut, std::uint32_t fold) {
  const std::uint32_t at = place_[join_of(cut)];
  place_[join_of(cut)] = nothing;
  cuts_[at] = join_of(fold);
  place_[join_of(fold)] = at;
}

bool Walk::make_one(const Swap& swap, double may_cost) {
  const std::uint32_t fold = net_.tree().side_above(swap.below);
  if (!make(swap, may_cost)) {
    return false;
  }
  exchange(swap.side, fold);
  return true;
}

/// The mirror image of a swap, named as before that is made (its `below` is one of two faces still): where
/// both edges have one that is what they are, but not each other.
std::optional<Swap> Walk::mirror_image(const Swap& swap) const {
  const CutCosts& costs = energy_.cut_costs();
  const std::uint32_t fold = net_.tree().side_above(swap.below);
  const std::uint32_t cut_image = costs.mirror_of(swap.side);
  const std::uint32_t fold_image = costs.mirror_of(fold);
  if (cut_image == nothing || fold_image == nothing || !costs.is_cut(cut_image) || costs.is_cut(fold_image) ||
      patch_.frozen[fold_image] != 0 || join_of(cut_image) == join_of(swap.side) ||
      join_of(fold_image) == join_of(fold)) {
    return std::nullopt;
  }
  return Swap{fold_image, cut_image};
}

/// Of a fold and a cut the swap, if it may be made now.
std::optional<Swap> Walk::swap_of(std::uint32_t fold, std::uint32_t cut) const {
  const RootedNet& tree = net_.tree();
  const std::uint32_t f = fold / 3;
  const std::uint32_t g = patch_.twin[fold] / 3;
  const std::uint32_t below = tree.side_above(f) == fold ? f : g;
  const bool here = tree.in_subtree(below, cut / 3);
  const bool there = tree.in_subtree(below, patch_.twin[cut] / 3);
  return here == there ? std::nullopt : std::optional<Swap>({below, cut});
}

bool Walk::make_both(const Swap& swap, const Swap& image, double may_cost) {
  // Alone it costs what makes the net uneven; that is won back by its image.
  const std::uint32_t fold = net_.tree().side_above(swap.below);
  const double uneven = energy_.cut_costs().mirror_price(swap.side) + energy_.cut_costs().mirror_price(fold);
  const std::optional<double> first = make(swap, uneven + std::max(0.0, may_cost) + slack_of_pair);
  if (!first) {
    return false;
  }
  const std::optional<Swap> second = swap_of(image.below, image.side);
  if (!second || !make(*second, may_cost - *first)) {
    const std::optional<Swap> back = swap_of(join_of(swap.side), join_of(fold));
    unmake(*back);
    return false;
  }
  exchange(swap.side, fold);
  exchange(image.side, image.below);
  return true;
}

}  // namespace ridgecraft::unfold
