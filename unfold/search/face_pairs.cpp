// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/face_pairs.hpp"

#include <algorithm>
#include <bit>

namespace ridgecraft::unfold {

void FacePairSet::clear() {
  for (auto& list : meets_) {
    list.clear();
  }
  bad_.clear();
  std::fill(bad_at_.begin(), bad_at_.end(), no_index);
  total_ = 0;
}

void FacePairSet::add(std::uint32_t f, std::uint32_t g) {
  for (const auto& [a, b] : {std::pair(f, g), std::pair(g, f)}) {
    if (meets_[a].empty()) {
      bad_at_[a] = static_cast<std::uint32_t>(bad_.size());
      bad_.push_back(a);
    }
    meets_[a].push_back(b);
  }
  ++total_;
}

void FacePairSet::remove(std::uint32_t f, std::uint32_t g) {
  remove_from_list(f, g);
  remove_from_list(g, f);
  --total_;
}

void FacePairSet::remove_from_list(std::uint32_t f, std::uint32_t g) {
  auto& list = meets_[f];
  *std::find(list.begin(), list.end(), g) = list.back();
  list.pop_back();
  if (list.empty()) {
    bad_[bad_at_[f]] = bad_.back();
    bad_at_[bad_.back()] = bad_at_[f];
    bad_.pop_back();
    bad_at_[f] = no_index;
  }
}

CarriedOverlaps::CarriedOverlaps(std::span<const EdgedTriangle> flat, double tolerance)
    : flat_(flat), tolerance_(tolerance), moved_(flat.size()), moved_in_(flat.size(), 0) {}

/// Circles of what moves, carried along, against those of what lies in the plane that it comes to
/// (Gottschalk, Lin, Manocha 1996, with circles for boxes since they needn't be turned).
class CarriedOverlaps::Descent {
 public:
  Descent(CarriedOverlaps& overlaps, const Carrying& what, std::uint32_t limit)
      : s_(overlaps),
        from_(what.from),
        onto_(what.onto),
        own_(*what.from.circles),
        other_(*what.onto.circles),
        same_(what.from.circles == what.onto.circles),
        motion_(what.motion),
        first_(what.first),
        last_(std::min(what.first + what.count, static_cast<std::uint32_t>(what.from.order.size()))),
        wrapped_(what.first + what.count - last_),
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
    if (!same_) {
      return false;
    }
    const std::uint32_t leaf = other_.first_leaf();
    const auto shift = static_cast<std::uint32_t>(std::bit_width(leaf) - std::bit_width(node));
    const std::uint32_t low = ((node << shift) - leaf) * size;
    const std::uint32_t high =
        std::min(low + (size << shift), static_cast<std::uint32_t>(onto_.order.size()));
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
        same_ ? ~(CircleTree::bits_within(b, first_, last_) | CircleTree::bits_within(b, 0, wrapped_)) : ~0U;
    const Circle& around_b = other_[other_.first_leaf() + b];
    for (std::uint32_t i = a * size;
         i < std::min(a * size + size, static_cast<std::uint32_t>(from_.order.size())); ++i) {
      if (((bits >> (i - a * size)) & 1U) == 0) {
        continue;
      }
      Circle circle = own_.circle(i);
      circle.centre = motion_(circle.centre);
      if (apart(circle, around_b)) {
        continue;
      }
      for (std::uint32_t met = other_.meeting(b, circle) & stays; met != 0; met &= met - 1) {
        test(from_.order[i], onto_.order[b * size + static_cast<std::uint32_t>(std::countr_zero(met))]);
        if (count_ == limit_) {
          return;
        }
      }
    }
  }

  void test(std::uint32_t f, std::uint32_t g) {
    if (s_.moved_in_[f] != s_.question_) {
      s_.moved_in_[f] = s_.question_;
      s_.moved_[f] = moved(s_.flat_[f], motion_);
    }
    if (overlap(s_.moved_[f], s_.flat_[g], s_.tolerance_)) {
      ++count_;
      s_.found_.emplace_back(f, g);
    }
  }

  CarriedOverlaps& s_;
  const LaidFaces from_, onto_;
  const CircleTree& own_;
  const CircleTree& other_;
  const bool same_;
  const Rigid motion_;
  const std::uint32_t first_, last_, wrapped_;  ///< positions first .. last-1 and 0 .. wrapped-1 move
  const std::uint32_t limit_;
  std::uint32_t count_ = 0;
  double part_radius_ = -1.0;
};

std::uint32_t CarriedOverlaps::count(const Carrying& what, std::uint32_t limit) {
  ++question_;
  found_.clear();
  return Descent(*this, what, limit).run();
}

}  // namespace ridgecraft::unfold
