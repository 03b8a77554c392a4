// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/overlap_pairs.hpp"

#include <algorithm>
#include <bit>
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

SwapOverlaps::SwapOverlaps(const RootedNet& net, double tolerance)
    : net_(net), tolerance_(tolerance), moved_(net.size()), moved_in_(net.size(), 0) {}

/// The question what a swap would meet, asked of the circle tree twice at once: circles of the side that
/// moves, carried along, against those of the side that stays (Gottschalk, Lin, Manocha 1996, with circles
/// for boxes since they needn't be turned).
class SwapOverlaps::Descent {
 public:
  Descent(SwapOverlaps& overlaps, const Rigid& motion, const RootedNet::Span& moved, std::uint32_t limit)
      : s_(overlaps),
        net_(overlaps.net_),
        tree_(net_.circles()),
        motion_(motion),
        first_(moved.first),
        last_(std::min(moved.first + moved.count, net_.size())),
        wrapped_(moved.first + moved.count - last_),
        leaf_(tree_.first_leaf()),
        height_(static_cast<std::uint32_t>(std::bit_width(leaf_))),
        limit_(limit) {}

  /// The number of pairs, or the limit when it is reached.
  std::uint32_t run() {
    interval(first_, last_);
    interval(0, wrapped_);
    s_.meetings_.clear();
    return count_;
  }

 private:
  static constexpr std::uint32_t size = CircleTree::block_size;

  /// Everything below the node moves, so nothing there can be met.
  [[nodiscard]] bool all_moved(std::uint32_t node) const {
    const std::uint32_t shift = height_ - static_cast<std::uint32_t>(std::bit_width(node));
    const std::uint32_t low = ((node << shift) - leaf_) * size;
    const std::uint32_t high = std::min(low + (size << shift), net_.size());
    return (low >= first_ && high <= last_) || high <= wrapped_;
  }

  [[nodiscard]] Circle carried(std::uint32_t node) const {
    return {motion_(tree_[node].centre), tree_[node].radius};
  }

  /// What the faces at positions first .. last-1 meet: whole blocks through the tree, the rest block by
  /// block.
  void interval(std::uint32_t first, std::uint32_t last) {
    if (first >= last || count_ == limit_) {
      return;
    }
    const std::uint32_t head = (first + size - 1) / size;
    const std::uint32_t tail = last / size;
    if (head > tail) {
      part_of_block(first / size, first, last);
      return;
    }
    if (first % size != 0) {
      part_of_block(first / size, first, head * size);
    }
    if (last % size != 0 && count_ < limit_) {
      part_of_block(tail, tail * size, last);
    }
    tree_.cover(head, tail, [this](std::uint32_t node) { meet(node, motion_(tree_[node].centre), 1); });
    descend(~0U);
  }

  void part_of_block(std::uint32_t block, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t bits = CircleTree::bits_within(block, first, last);
    Circle all;
    for (std::uint32_t position = first; position < last; ++position) {
      all = around(all, tree_.circle(position));
    }
    // Stands for the block's node, with a circle of its own.
    part_radius_ = all.radius;
    meet_as(leaf_ + block, motion_(all.centre), part_radius_, 1);
    descend(bits);
    part_radius_ = -1.0;
  }

  void meet(std::uint32_t a, Vec2 centre, std::uint32_t b) { meet_as(a, centre, tree_[a].radius, b); }

  void meet_as(std::uint32_t a, Vec2 centre, double radius, std::uint32_t b) {
    const Circle& other = tree_[b];
    if (radius >= 0.0 && other.radius >= 0.0 && !apart({centre, radius}, other) && !all_moved(b)) {
      s_.meetings_.push_back({a, b, centre});
    }
  }

  /// Works off the meetings. `bits`: which faces of a block that moves count.
  void descend(std::uint32_t bits) {
    auto& meetings = s_.meetings_;
    while (!meetings.empty() && count_ < limit_) {
      const Meeting at = meetings.back();
      meetings.pop_back();
      const double radius = part_radius_ < 0.0 ? tree_[at.a].radius : part_radius_;
      if (at.a >= leaf_ && at.b >= leaf_) {
        blocks(at.a - leaf_, bits, at.b - leaf_);
      } else if (at.b >= leaf_ || (at.a < leaf_ && radius > tree_[at.b].radius)) {
        meet(2 * at.a, motion_(tree_[2 * at.a].centre), at.b);
        meet(2 * at.a + 1, motion_(tree_[2 * at.a + 1].centre), at.b);
      } else {
        meet_as(at.a, at.centre, radius, 2 * at.b);
        meet_as(at.a, at.centre, radius, 2 * at.b + 1);
      }
    }
    meetings.clear();
  }

  void blocks(std::uint32_t a, std::uint32_t bits, std::uint32_t b) {
    const std::uint32_t stays =
        ~(CircleTree::bits_within(b, first_, last_) | CircleTree::bits_within(b, 0, wrapped_));
    const Circle& around_b = tree_[leaf_ + b];
    for (std::uint32_t i = a * size; i < std::min(a * size + size, net_.size()); ++i) {
      if (((bits >> (i - a * size)) & 1U) == 0) {
        continue;
      }
      Circle circle = tree_.circle(i);
      circle.centre = motion_(circle.centre);
      if (apart(circle, around_b)) {
        continue;
      }
      for (std::uint32_t met = tree_.meeting(b, circle) & stays; met != 0; met &= met - 1) {
        test(net_.face_at(i), net_.face_at(b * size + static_cast<std::uint32_t>(std::countr_zero(met))));
        if (count_ == limit_) {
          return;
        }
      }
    }
  }

  void test(std::uint32_t f, std::uint32_t g) {
    if (s_.moved_in_[f] != s_.question_) {
      s_.moved_in_[f] = s_.question_;
      s_.moved_[f] = moved(net_.edged_flat(f), motion_);
    }
    if (overlap(s_.moved_[f], net_.edged_flat(g), s_.tolerance_)) {
      ++count_;
      s_.found_.emplace_back(f, g);
    }
  }

  SwapOverlaps& s_;
  const RootedNet& net_;
  const CircleTree& tree_;
  const Rigid motion_;
  const std::uint32_t first_, last_, wrapped_;  ///< positions first .. last-1 and 0 .. wrapped-1 move
  const std::uint32_t leaf_, height_, limit_;
  std::uint32_t count_ = 0;
  double part_radius_ = -1.0;
};

std::uint32_t SwapOverlaps::count(std::uint32_t below, std::uint32_t side, std::uint32_t limit) {
  ++question_;
  found_.clear();
  return Descent(*this, net_.motion(below, side), net_.moved_span(below), limit).run();
}

}  // namespace ridgecraft::unfold
