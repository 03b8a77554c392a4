// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/valleys.hpp"

#include <algorithm>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/concavity/separators.hpp"
#include "segment/concavity/valley_concavity.hpp"

namespace ridgecraft::segment {
namespace {

/// Equal for equal parts; two different ones of a run agree with a probability of 2^-64.
std::uint64_t signature_of(std::span<const std::uint32_t> facets) {
  std::uint64_t sum = 0;
  for (const std::uint32_t f : facets) {
    sum += Random(f).next();
  }
  return sum;
}

}  // namespace

Valleys::Valleys(const PartGraph& part) : part_(&part), search_(part) {}

void Valleys::select() {
  signature_ = signature_of(part_->facets());
}

/// Whether all its arcs and jumps exist on this part.
bool Valleys::survives(const Valley& valley) const {
  for (std::size_t i = 1; i < valley.steps.size(); ++i) {
    const std::uint32_t from = valley.steps[i - 1].vertex;
    const Step& step = valley.steps[i];
    if (step.arc == jump_arc ? !part_->jump_exists(from, step.vertex) : !part_->arc_exists(from, step.arc)) {
      return false;
    }
  }
  return true;
}

/// Fills chain_.
void Valleys::project(std::span<const Step> steps) {
  points_.clear();
  for (const Step& s : steps) {
    points_.push_back(part_->surface().points[s.vertex]);
  }
  project_valley(points_, chain_);
}

Valley Valleys::find(std::uint32_t from, std::uint32_t to, double tolerance, bool from_scratch) {
  Valley valley;
  if (found_->find(from, to, valley) || (others_ != nullptr && others_->find(from, to, valley))) {
    // A search on the same part would find the same valley again. From other parts only what is surely still
    // shortest is taken: where there are cut loops, a jump may be shorter than a deep valley.
    if (valley.part == signature_ ||
        (!from_scratch && !(valley.greatest > tolerance && part_->has_loops()) && survives(valley))) {
      return valley;
    }
  }
  valley = {};
  valley.length = search_.find(from, to, steps_);
  if (steps_.empty()) {
    return valley;
  }
  project(steps_);
  chain_concavity(chain_, concavity_);
  valley.steps = steps_;
  valley.concavity = concavity_;
  valley.greatest = *std::max_element(concavity_.begin(), concavity_.end());
  valley.part = signature_;
  found_->store(from, to, valley);
  return valley;
}

std::array<double, 2> Valleys::sub_valleys(const Valley& valley, std::span<const double> capped,
                                           double tolerance) {
  project(valley.steps);
  const Separators separators = find_separators(chain_, capped, valley.concavity, tolerance);
  double along = 0.0;
  double to_first = 0.0;
  double to_last = 0.0;
  for (std::size_t i = 1; i < valley.steps.size(); ++i) {
    const Step& step = valley.steps[i];
    along += step.arc == jump_arc ? length(points_[i] - points_[i - 1])
                                  : static_cast<double>(part_->arc(step.arc).length);
    to_first = i == separators.first ? along : to_first;
    to_last = i == separators.last ? along : to_last;
  }
  return {to_first, along - to_last};
}

}  // namespace ridgecraft::segment
