// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that overlap are moved until none do, by their true outlines: what a grid loses at every contact is
// room for a page less.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "export/packing/packing_task.hpp"

namespace ridgecraft::paper {

/// Convex polygons that cover the same ground in fewer polygons: those that share a side are united where
/// that is convex (Hertel and Mehlhorn 1983). O(n²) in the polygons of one shape.
[[nodiscard]] std::vector<std::vector<Vec2>> merged_convex(std::vector<std::vector<Vec2>> polygons);

/// Where a shape lies: the lower left corner of its box, in one of its turns.
struct ExactPlace {
  std::uint32_t page = 0;
  std::uint32_t turn = 0;
  Vec2 at;
};

/// Guided local search over penetration depths (Egeblad, Nielsen and Odgaard 2007; Umetani et al. 2009;
/// Gardeyn and Wauters 2025): a shape that overlaps others goes where it overlaps least, pairs that stay in
/// each other's way weigh more and more. Two convex polygons overlap where the second's place lies in their
/// Minkowski difference, as deep as it is from its nearest side.
class ExactSeparation {
 public:
  /// `turns` of each shape, at least one each. The gap is kept, and a little more at corners.
  ExactSeparation(const PackingTask& task, const std::vector<std::vector<Turn>>& turns, Random& random,
                  const Context& context);

  /// Moves the shapes on `pages` pages of this area, on which each fits in all its turns, until none overlap;
  /// whether it succeeded within that much work (sides of differences looked at). Weights are kept from one
  /// call to the next.
  [[nodiscard]] bool run(std::vector<ExactPlace>& places, std::uint32_t pages, Vec2 area,
                         std::uint64_t most_work);
  /// All pairs weigh alike again.
  void forget();

  [[nodiscard]] Vec2 size(std::uint32_t shape, std::uint32_t turn) const { return turned_[shape][turn].size; }
  /// Of the turned shape's box before it is moved: Packed::shift is at - low.
  [[nodiscard]] Vec2 low(std::uint32_t shape, std::uint32_t turn) const { return turned_[shape][turn].low; }
  [[nodiscard]] std::size_t turn_count(std::uint32_t shape) const { return turned_[shape].size(); }
  [[nodiscard]] std::uint64_t work() const { return work_; }
  /// Depths of all overlaps at the end of the last run, mm.
  [[nodiscard]] double left() const { return left_; }

 private:
  struct Turned {
    Vec2 low;
    Vec2 size;
    std::vector<std::vector<Vec2>> convex;  ///< the box's lower left corner is the origin
  };
  /// Of two convex polygons: the places of the second's origin, seen from the first's, where they overlap.
  struct Difference {
    Box2 box;
    std::uint32_t first = 0;  ///< of its sides
    std::uint32_t end = 0;
  };
  struct Side {
    Vec2 normal;
    double reach = 0.0;  ///< inside where dot(normal, place) < reach
  };
  struct Differences {
    std::vector<Difference> of_pairs;
    std::vector<Side> sides;
  };
  /// What a shape's box takes of which page.
  struct Taken {
    Box2 box;
    std::uint32_t page = 0;
  };
  /// Of keys that differ in few bits (Steele, Lea and Flood 2014).
  struct Mixed {
    std::size_t operator()(std::uint64_t key) const {
      key = (key ^ (key >> 30U)) * 0xbf58476d1ce4e5b9U;
      key = (key ^ (key >> 27U)) * 0x94d049bb133111ebU;
      return static_cast<std::size_t>(key ^ (key >> 31U));
    }
  };
  struct Candidate {
    ExactPlace place;
    double cost = 0.0;
  };

  [[nodiscard]] const Differences& differences(std::uint32_t a, std::uint32_t turn_a, std::uint32_t b,
                                               std::uint32_t turn_b);
  [[nodiscard]] double depth(const Differences& of, Vec2 place, double limit);
  [[nodiscard]] Taken taken_by(std::uint32_t shape, const ExactPlace& place) const {
    return {{place.at, place.at + turned_[shape][place.turn].size}, place.page};
  }
  [[nodiscard]] bool apart(const Box2& a, const Box2& b) const {
    return a.high.x + gap_ <= b.low.x || b.high.x + gap_ <= a.low.x || a.high.y + gap_ <= b.low.y ||
           b.high.y + gap_ <= a.low.y;
  }
  [[nodiscard]] double overlap(std::uint32_t a, const ExactPlace& at, std::uint32_t b,
                               const ExactPlace& other, double limit);
  [[nodiscard]] double cost(std::uint32_t shape, const ExactPlace& place,
                            const std::vector<ExactPlace>& places, double limit);
  [[nodiscard]] ExactPlace inside(std::uint32_t shape, ExactPlace place) const;
  [[nodiscard]] ExactPlace random_place(std::uint32_t shape, std::uint32_t pages);
  void descend(std::uint32_t shape, const std::vector<ExactPlace>& places, double first_step,
               double last_step, Candidate& candidate);
  bool relocate(std::uint32_t shape, std::vector<ExactPlace>& places, std::uint32_t pages);
  void raise_weights(const std::vector<ExactPlace>& places);

  std::size_t count_;
  double gap_;
  Random& random_;
  const Context& context_;
  Vec2 area_;
  std::uint64_t work_ = 0;
  double left_ = 0.0;
  std::vector<std::vector<Turned>> turned_;
  std::vector<std::uint32_t> kind_;  ///< shapes with equal outlines and turns share their differences
  std::vector<double> scale_;        ///< root of each shape's area
  std::vector<double> weight_;       ///< of each pair
  std::vector<Taken> taken_;         ///< by each shape where it is now
  std::unordered_map<std::uint64_t, Differences, Mixed> differences_;
  std::size_t sides_kept_ = 0;
};

}  // namespace ridgecraft::paper
