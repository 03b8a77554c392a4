// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/trees/changing_net.hpp"

#include <utility>

#include "base/geometry.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {

ChangingNet::ChangingNet(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                         const Folds& folds, const TabOptions& tabs, double tolerance)
    : ChangingNet(surface, panels, patch, patch, folds, tabs, tolerance) {}

ChangingNet::ChangingNet(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                         const Patch& joined, const Folds& folds, const TabOptions& tabs, double tolerance)
    : patch_(patch), joined_(joined), tolerance_(tolerance), net_(joined), after_swap_(net_, tolerance) {
  net_.set_tree(folds);
  if (tabs.wanted) {
    state_.emplace(surface, panels, patch, net_, tabs);
    state_->renew_all();
  }
}

ChangingNet::ChangingNet(const Patch& patch, const Folds& folds, double tolerance)
    : patch_(patch), joined_(patch), tolerance_(tolerance), net_(patch), after_swap_(net_, tolerance) {
  net_.set_tree(folds);
}

void ChangingNet::set_tree(const Folds& folds) {
  net_.set_tree(folds);
  counted_ = true;
  if (state_) {
    state_->renew_all();
  }
}

std::vector<Vec2> ChangingNet::hull() const {
  std::vector<Vec2> points;
  points.reserve(3 * patch_.size());
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    points.insert(points.end(), net_.flat(f).begin(), net_.flat(f).end());
  }
  return convex_hull(std::move(points));
}

bool ChangingNet::is_clean() const {
  return find_overlaps(lay_out(joined_, folds()), tolerance_).empty();
}

std::uint32_t ChangingNet::tabs() {
  count_tabs();
  return state_ ? state_->tabs() : 0;
}

double ChangingNet::held_mm() {
  count_tabs();
  return state_ ? state_->held_mm() : 0.0;
}

void ChangingNet::make(const Swap& swap) {
  folded_ = swap.side;
  const std::uint32_t cut = net_.side_above(swap.below);
  back_ = {net_.swap(swap.below, swap.side), cut};
  counted_ = false;
}

void ChangingNet::make_with_tabs(const Swap& swap) {
  folded_ = swap.side;
  state_->swap(swap.below, swap.side);
  counted_ = true;
}

/// The tabs look at what is near before a swap and after it, so they make it themselves.
void ChangingNet::count_tabs() {
  if (counted_ || !state_) {
    return;
  }
  state_->swap(net_.swap(back_.below, back_.side), folded_);
  counted_ = true;
}

void ChangingNet::keep() {
  count_tabs();
  counted_ = true;
}

void ChangingNet::take_back() {
  if (state_ && counted_) {
    state_->take_back();
  } else {
    static_cast<void>(net_.swap(back_.below, back_.side));
  }
  counted_ = true;
}

}  // namespace ridgecraft::unfold
