// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/free_folding.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/tabs/trees/tree_improvement.hpp"

namespace ridgecraft::unfold {
namespace {

/// Trees whose folding is tried, times the faces of the piece, and at most: about 0.1 s.
constexpr std::size_t faces_tried = 6000;
constexpr std::size_t most_tried = 80;
/// Larger pieces aren't tried: single creases aren't looked at either (fold_order.hpp).
constexpr std::size_t most_faces = 600;
/// Swaps that are drawn for each tree that is tried: most aren't clean.
constexpr std::size_t draws_per_tree = 12;

/// How a tree folds.
struct Course {
  bool free = false;
  std::vector<FoldTrial::Pair> meetings;  ///< with all creases folded at a time
};
/// Orders are only looked at where no more than `most` pairs meet.
Course course_of(const Patch& piece, const Folds& tree, std::size_t most, const Context& context) {
  const FoldMotion motion(flat_piece(piece, tree));
  FoldTrial trial(motion, context);
  Course course;
  course.meetings = trial.meetings_together(most);
  course.free = course.meetings.empty() || (course.meetings.size() <= most &&
                                            find_order(motion, trial, context).way != FoldWay::with_care);
  return course;
}

class FreeFolding : public TreeGoal {
 public:
  FreeFolding(const Patch& piece, Course course, const std::function<bool(ChangingNet&)>& allowed,
              const Context& context)
      : course_(std::move(course)),
        allowed_(allowed),
        context_(context),
        trees_(std::min(most_tried, faces_tried / piece.size())),
        branch_(piece) {}

  std::optional<Swap> draw(ChangingNet& net, Random& random) override {
    const auto [f, g] = unfold::draw(course_.meetings, random);
    return draw_swap_between(f, g, net.tree(), branch_, random);
  }

  bool accepts(ChangingNet& net) override {
    if (!allowed_(net)) {
      return false;
    }
    --trees_;
    Course changed = course_of(net.patch(), net.folds(), course_.meetings.size(), context_);
    if (changed.meetings.size() > course_.meetings.size()) {
      return false;
    }
    course_ = std::move(changed);
    return true;
  }

  [[nodiscard]] bool done() const override { return course_.free || trees_ == 0; }
  [[nodiscard]] bool free() const { return course_.free; }

 private:
  Course course_;
  const std::function<bool(ChangingNet&)>& allowed_;
  const Context& context_;
  std::size_t trees_;  ///< that may still be tried
  Branch branch_;
};

}  // namespace

bool folds_freely(const Patch& piece, const Folds& tree, const Context& context) {
  const FoldMotion motion(flat_piece(piece, tree));
  FoldTrial trial(motion, context);
  return find_folding(motion, trial, context).way != FoldWay::with_care;
}

bool fold_freely(ChangingNet& net, const std::function<bool(ChangingNet&)>& allowed, std::uint64_t seed,
                 const Context& context) {
  const Patch& piece = net.patch();
  if (piece.size() > most_faces) {
    return false;
  }
  const Folds given = net.folds();
  Course course = course_of(piece, given, std::numeric_limits<std::size_t>::max(), context);
  if (course.free) {
    return false;
  }
  FreeFolding goal(piece, std::move(course), allowed, context);
  const std::size_t draws = draws_per_tree * std::min(most_tried, faces_tried / piece.size());
  if (!improve_tree(net, goal, draws, seed, context)) {
    return false;
  }
  if (!goal.free()) {
    net.set_tree(given);
  }
  return goal.free();
}

}  // namespace ridgecraft::unfold
