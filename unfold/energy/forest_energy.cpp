// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/forest_energy.hpp"

#include <algorithm>

#include "base/geometry.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {

ForestEnergy::ForestEnergy(const Forest& forest, std::span<const std::uint32_t> part, const CutFacts& facts,
                           const Room& room, const Weights& weights)
    : forest_(forest),
      patch_(forest.patch()),
      room_(room),
      cut_costs_(patch_, facts, weights),
      shape_(patch_, part, room, weights) {
  renew();
}

void ForestEnergy::renew() {
  folds_ = forest_.folds();
  cut_costs_.set_tree(folds_);
  measure_.assign(forest_.tree_limit(), {});
  shapes_ = 0.0;
  for (const std::uint32_t t : forest_.trees()) {
    measure_[t] = shape_.measure(forest_, folds_, forest_.faces_of(t).front(), nullptr);
    shapes_ += measure_[t].cost;
  }
}

std::optional<double> ForestEnergy::rate(const Move& move, double most) {
  const double cuts = cut_costs_.change(move.closed, move.opened);
  if (cuts > most) {
    cut_costs_.drop();
    return std::nullopt;
  }
  move_ = move;
  const Forest::Carried what = forest_.carried(move);
  change_ = -measure_[what.faces.tree].cost;
  if (what.to != no_index && what.to != what.faces.tree) {
    change_ -= measure_[what.to].cost;
  }
  find_roots(what);
  set_folds(move, true);
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    if (roots_[i] != no_index) {
      measures_[i] = shape_.measure(forest_, folds_, roots_[i], &what);
      change_ += measures_[i].cost;
    }
  }
  set_folds(move, false);
  return cuts + change_;
}

/// A face of each tree that the move makes.
void ForestEnergy::find_roots(const Forest::Carried& what) {
  const std::uint32_t twin = move_.joins() ? no_index : patch_.twin[move_.opened];
  if (move_.splits()) {
    roots_ = {move_.opened / 3, twin / 3};
    return;
  }
  roots_ = {move_.closed / 3, no_index};
  if (!move_.joins() && what.to != what.faces.tree) {
    const bool goes = forest_.in_span(what.faces, move_.opened / 3);
    roots_[1] = (goes ? twin : move_.opened) / 3;
  }
}

void ForestEnergy::set_folds(const Move& move, bool made) {
  if (move.closed != no_index) {
    set_fold(patch_, folds_, move.closed, made);
  }
  if (move.opened != no_index) {
    set_fold(patch_, folds_, move.opened, !made);
  }
}

void ForestEnergy::keep() {
  cut_costs_.keep();
  set_folds(move_, true);
  shapes_ += change_;
  measure_.resize(std::max<std::size_t>(measure_.size(), forest_.tree_limit()));
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    if (roots_[i] != no_index) {
      measure_[forest_.tree_of(roots_[i])] = measures_[i];
    }
  }
}

void ForestEnergy::drop() {
  cut_costs_.drop();
}

bool ForestEnergy::rated_fits() const {
  return measures_[0].surely_fits && (roots_[1] == no_index || measures_[1].surely_fits);
}

std::optional<std::uint32_t> ForestEnergy::one_that_does_not_fit() {
  const auto found = std::find_if(forest_.trees().begin(), forest_.trees().end(), [&](std::uint32_t t) {
    if (measure_[t].surely_fits) {
      return false;
    }
    static_cast<void>(shape_.measure(forest_, folds_, forest_.faces_of(t).front(), nullptr));
    std::vector<Vec2> points;
    for (const std::uint32_t f : forest_.faces_of(t)) {
      points.insert(points.end(), forest_.flat(f).begin(), forest_.flat(f).end());
    }
    return !room_.holds(convex_hull(std::move(points)), shape_.panels());
  });
  return found == forest_.trees().end() ? std::nullopt : std::optional(*found);
}

}  // namespace ridgecraft::unfold
