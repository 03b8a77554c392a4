// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/overlap_pairs.hpp"

#include <algorithm>
#include <utility>

namespace ridgecraft::unfold {

OverlapPairs::OverlapPairs(RootedNet& net, double tolerance)
    : net_(net),
      tolerance_(tolerance),
      after_swap_(net, tolerance),
      meets_(net.size()),
      bad_at_(net.size(), nothing) {}

void OverlapPairs::find_all() {
  for (auto& list : meets_) {
    list.clear();
  }
  bad_.clear();
  std::fill(bad_at_.begin(), bad_at_.end(), nothing);
  total_ = 0;
  for (std::uint32_t position = 0; position < net_.size(); ++position) {
    const std::uint32_t f = net_.face_at(position);
    net_.visit_near(net_.circle(f).centre, net_.circle(f).radius, [&](std::uint32_t g) {
      if (net_.position(g) > position && overlap(net_.edged_flat(f), net_.edged_flat(g), tolerance_)) {
        add(f, g);
      }
    });
  }
}

void OverlapPairs::add(std::uint32_t f, std::uint32_t g) {
  for (const auto& [a, b] : {std::pair(f, g), std::pair(g, f)}) {
    if (meets_[a].empty()) {
      bad_at_[a] = static_cast<std::uint32_t>(bad_.size());
      bad_.push_back(a);
    }
    meets_[a].push_back(b);
  }
  ++total_;
}

void OverlapPairs::mark_clean(std::uint32_t f) {
  bad_[bad_at_[f]] = bad_.back();
  bad_at_[bad_.back()] = bad_at_[f];
  bad_.pop_back();
  bad_at_[f] = nothing;
}

void OverlapPairs::remove_pair_of(std::uint32_t f, std::uint32_t g) {
  auto& list = meets_[f];
  *std::find(list.begin(), list.end(), g) = list.back();
  list.pop_back();
  if (list.empty()) {
    mark_clean(f);
  }
}

/// Calls use(f, g) for each overlapping pair of a face f in the span and a face g outside it. O(smaller of
/// the span and the overlapping faces, and their pairs).
template <class Use>
void OverlapPairs::visit_across(const RootedNet::Span& moved, Use use) const {
  const auto visit = [&](std::uint32_t f) {
    for (const std::uint32_t g : meets_[f]) {
      if (!net_.in_span(moved, g)) {
        use(f, g);
      }
    }
  };
  if (bad_.size() < moved.count) {
    for (const std::uint32_t f : bad_) {
      if (net_.in_span(moved, f)) {
        visit(f);
      }
    }
    return;
  }
  for (std::uint32_t i = 0; i < moved.count; ++i) {
    visit(net_.face_in(moved, i));
  }
}

std::uint32_t OverlapPairs::across(std::uint32_t below) const {
  std::uint32_t count = 0;
  visit_across(net_.moved_span(below), [&](std::uint32_t, std::uint32_t) { ++count; });
  return count;
}

std::int64_t OverlapPairs::added(std::uint32_t below, std::uint32_t side, std::int64_t limit) {
  const std::int64_t old = total_ > 0 ? across(below) : 0;
  if (limit + old <= 0) {
    return limit;
  }
  return static_cast<std::int64_t>(after_swap_.count(below, side, static_cast<std::uint32_t>(limit + old))) -
         old;
}

std::uint32_t OverlapPairs::swap(std::uint32_t below, std::uint32_t side) {
  after_swap_.count(below, side, nothing);
  return swap(below, side, after_swap_.found());
}

std::uint32_t OverlapPairs::swap(std::uint32_t below, std::uint32_t side, const FacePairs& made) {
  drop_across(below);
  const std::uint32_t moved = net_.swap(below, side);
  for (const auto& [f, g] : made) {
    add(f, g);
  }
  return moved;
}

void OverlapPairs::drop_across(std::uint32_t below) {
  dropped_.clear();
  visit_across(net_.moved_span(below),
               [&](std::uint32_t f, std::uint32_t g) { dropped_.emplace_back(f, g); });
  for (const auto& [f, g] : dropped_) {
    remove_pair_of(f, g);
    remove_pair_of(g, f);
    --total_;
  }
}

}  // namespace ridgecraft::unfold
