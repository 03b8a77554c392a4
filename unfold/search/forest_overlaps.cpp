// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/forest_overlaps.hpp"

#include <algorithm>
#include <bit>

namespace ridgecraft::unfold {
Overlaps::Overlaps(const Forest& forest, double tolerance)
    : forest_(forest),
      tolerance_(tolerance),
      meets_(forest.face_count()),
      bad_at_(forest.face_count(), nothing),
      moved_(forest.face_count()),
      moved_in_(forest.face_count(), 0) {}

/// Circles of what moves, carried along, against those of what lies in the plane that it comes to
/// (Gottschalk, Lin, Manocha 1996, with circles for boxes since they needn't be turned).
class Overlaps::Descent {
 public:
  Descent(Overlaps& overlaps, const Forest::Carried& what, std::uint32_t limit)
      : s_(overlaps),
        forest_(overlaps.forest_),
        from_(what.faces.tree),
        to_(what.to),
        own_(forest_.circles_of(from_)),
        other_(forest_.circles_of(to_)),
        motion_(what.motion),
        first_(what.faces.first),
        last_(std::min(what.faces.first + what.faces.count, forest_.size_of(from_))),
        wrapped_(what.faces.first + what.faces.count - last_),
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

  /// Everything below a node of the other tree moves itself, so nothing there can be met.
  [[nodiscard]] bool all_moved(std::uint32_t node) const {
    if (from_ != to_) {
      return false;
    }
    const std::uint32_t leaf = other_.first_leaf();
    const auto shift = static_cast<std::uint32_t>(std::bit_width(leaf) - std::bit_width(node));
    const std::uint32_t low = ((node << shift) - leaf) * size;
    const std::uint32_t high = std::min(low + (size << shift), forest_.size_of(to_));
    return (low >= first_ && high <= last_) || high <= wrapped_;
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
    own_.cover(head, tail, [this](std::uint32_t node) { meet(node, motion_(own_[node].centre), 1); });
    descend(~0U);
  }

  void part_of_block(std::uint32_t block, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t bits = CircleTree::bits_within(block, first, last);
    Circle all;
    for (std::uint32_t position = first; position < last; ++position) {
      all = around(all, own_.circle(position));
    }
    // Stands for the block's node, with a circle of its own.
    part_radius_ = all.radius;
    meet_as(own_.first_leaf() + block, motion_(all.centre), part_radius_, 1);
    descend(bits);
    part_radius_ = -1.0;
  }

  void meet(std::uint32_t a, Vec2 centre, std::uint32_t b) { meet_as(a, centre, own_[a].radius, b); }

  void meet_as(std::uint32_t a, Vec2 centre, double radius, std::uint32_t b) {
    const Circle& other = other_[b];
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
      const double radius = part_radius_ < 0.0 ? own_[at.a].radius : part_radius_;
      const bool a_ends = at.a >= own_.first_leaf();
      const bool b_ends = at.b >= other_.first_leaf();
      if (a_ends && b_ends) {
        blocks(at.a - own_.first_leaf(), bits, at.b - other_.first_leaf());
      } else if (b_ends || (!a_ends && radius > other_[at.b].radius)) {
        meet(2 * at.a, motion_(own_[2 * at.a].centre), at.b);
        meet(2 * at.a + 1, motion_(own_[2 * at.a + 1].centre), at.b);
      } else {
        meet_as(at.a, at.centre, radius, 2 * at.b);
        meet_as(at.a, at.centre, radius, 2 * at.b + 1);
      }
    }
    meetings.clear();
  }

  void blocks(std::uint32_t a, std::uint32_t bits, std::uint32_t b) {
    const std::uint32_t stays =
        from_ == to_ ? ~(CircleTree::bits_within(b, first_, last_) | CircleTree::bits_within(b, 0, wrapped_))
                     : ~0U;
    const Circle& around_b = other_[other_.first_leaf() + b];
    const auto& mine = forest_.faces_of(from_);
    const auto& theirs = forest_.faces_of(to_);
    for (std::uint32_t i = a * size; i < std::min(a * size + size, forest_.size_of(from_)); ++i) {
      if (((bits >> (i - a * size)) & 1U) == 0) {
        continue;
      }
      Circle circle = own_.circle(i);
      circle.centre = motion_(circle.centre);
      if (apart(circle, around_b)) {
        continue;
      }
      for (std::uint32_t met = other_.meeting(b, circle) & stays; met != 0; met &= met - 1) {
        test(mine[i], theirs[b * size + static_cast<std::uint32_t>(std::countr_zero(met))]);
        if (count_ == limit_) {
          return;
        }
      }
    }
  }

  void test(std::uint32_t f, std::uint32_t g) {
    if (s_.moved_in_[f] != s_.question_) {
      s_.moved_in_[f] = s_.question_;
      s_.moved_[f] = moved(forest_.edged_flat(f), motion_);
    }
    if (overlap(s_.moved_[f], forest_.edged_flat(g), s_.tolerance_)) {
      ++count_;
      s_.found_.emplace_back(f, g);
    }
  }

  Overlaps& s_;
  const Forest& forest_;
  const std::uint32_t from_, to_;
  const CircleTree& own_;
  const CircleTree& other_;
  const Rigid motion_;
  const std::uint32_t first_, last_, wrapped_;  ///< positions first .. last-1 and 0 .. wrapped-1 move
  const std::uint32_t limit_;
  std::uint32_t count_ = 0;
  double part_radius_ = -1.0;
};

std::uint32_t Overlaps::count_new(const Move& move, std::uint32_t limit) {
  found_.clear();
  if (move.splits()) {
    return 0;
  }
  ++question_;
  return Descent(*this, forest_.carried(move), limit).run();
}

void Overlaps::find_all() {
  for (auto& list : meets_) {
    list.clear();
  }
  bad_.clear();
  std::fill(bad_at_.begin(), bad_at_.end(), nothing);
  total_ = 0;
  for (std::uint32_t f = 0; f < forest_.face_count(); ++f) {
    forest_.visit_near(forest_.tree_of(f), forest_.circle(f).centre, forest_.circle(f).radius,
                       [&](std::uint32_t g) {
                         if (g > f && overlap(forest_.edged_flat(f), forest_.edged_flat(g), tolerance_)) {
                           add(f, g);
                         }
                       });
  }
}

void Overlaps::add(std::uint32_t f, std::uint32_t g) {
  for (const auto& [a, b] : {std::pair(f, g), std::pair(g, f)}) {
    if (meets_[a].empty()) {
      bad_at_[a] = static_cast<std::uint32_t>(bad_.size());
      bad_.push_back(a);
    }
    meets_[a].push_back(b);
  }
  ++total_;
}

void Overlaps::mark_clean(std::uint32_t f) {
  bad_[bad_at_[f]] = bad_.back();
  bad_at_[bad_.back()] = bad_at_[f];
  bad_.pop_back();
  bad_at_[f] = nothing;
}

void Overlaps::remove_pair_of(std::uint32_t f, std::uint32_t g) {
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
void Overlaps::visit_across(const Forest::Span& moved, Use use) const {
  const auto visit = [&](std::uint32_t f) {
    for (const std::uint32_t g : meets_[f]) {
      if (!forest_.in_span(moved, g)) {
        use(f, g);
      }
    }
  };
  if (bad_.size() < moved.count) {
    for (const std::uint32_t f : bad_) {
      if (forest_.in_span(moved, f)) {
        visit(f);
      }
    }
    return;
  }
  for (std::uint32_t i = 0; i < moved.count; ++i) {
    visit(forest_.face_in(moved, i));
  }
}

std::int64_t Overlaps::added(const Move& move, std::int64_t limit) {
  std::int64_t old = 0;
  if (total_ > 0 && !move.joins()) {
    visit_across(forest_.carried(move).faces, [&](std::uint32_t, std::uint32_t) { ++old; });
  }
  if (limit + old <= 0) {
    return limit;
  }
  return static_cast<std::int64_t>(count_new(move, static_cast<std::uint32_t>(limit + old))) - old;
}

void Overlaps::make(const Move& move) {
  count_new(move, nothing);
  dropped_.clear();
  if (!move.joins()) {
    visit_across(forest_.carried(move).faces,
                 [&](std::uint32_t f, std::uint32_t g) { dropped_.emplace_back(f, g); });
  }
  for (const auto& [f, g] : dropped_) {
    remove_pair_of(f, g);
    remove_pair_of(g, f);
    --total_;
  }
  for (const auto& [f, g] : found_) {
    add(f, g);
  }
}

}  // namespace ridgecraft::unfold
