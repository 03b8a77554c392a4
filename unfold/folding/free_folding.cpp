// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/free_folding.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "unfold/check.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/search/branch.hpp"
#include "unfold/search/layout.hpp"
#include "unfold/search/tree_search.hpp"

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

class FreeFolding {
 public:
  FreeFolding(const Patch& piece, const Folds& tree, double tolerance, std::uint64_t seed,
              const Context& context)
      : piece_(piece),
        random_(seed),
        context_(context),
        net_(piece, tolerance, random_.next()),
        branch_(piece) {
    net_.set_tree(tree);
  }

  /// True when the tree has come to fold freely.
  bool run(Course course, const std::function<bool(const Folds&)>& allowed) {
    std::size_t trees = std::min(most_tried, faces_tried / piece_.size());
    for (std::size_t draws = draws_per_tree * trees; draws > 0 && trees > 0; --draws) {
      if (context_.out_of_time()) {
        return false;
      }
      if (!swap_between(course.meetings)) {
        continue;
      }
      --trees;
      Course changed = course_of(piece_, net_.folds(), course.meetings.size(), context_);
      if (changed.meetings.size() <= course.meetings.size() && allowed(net_.folds())) {
        course = std::move(changed);
        if (course.free) {
          return true;
        }
      } else {
        net_.swap(moved_, removed_);
      }
    }
    return false;
  }

  [[nodiscard]] const Folds& tree() const { return net_.folds(); }

 private:
  template <class T>
  const T& draw(const std::vector<T>& from) {
    return from[random_.below(static_cast<std::uint32_t>(from.size()))];
  }

  /// Exchanges a fold on the path between two faces that meet, so that they come to each other by another
  /// way.
  bool swap_between(const std::vector<FoldTrial::Pair>& meetings) {
    const auto [f, g] = draw(meetings);
    const std::vector<std::uint32_t> path = net_.removable_between(f, g);
    if (path.empty()) {
      return false;
    }
    const std::uint32_t below = draw(path);
    removed_ = net_.side_above(below);
    branch_.find(net_.folds(), removed_, f);
    if (branch_.places().empty()) {
      return false;
    }
    const std::uint32_t side = draw(branch_.places());
    if (!net_.swap_is_clean(below, side)) {
      return false;
    }
    moved_ = net_.swap(below, side);
    return true;
  }

  const Patch& piece_;
  Random random_;
  const Context& context_;
  TreeSearch net_;
  Branch branch_;
  std::uint32_t removed_ = 0;  ///< by the last swap: a side of the fold ...
  std::uint32_t moved_ = 0;    ///< ... and the face below the new one
};

}  // namespace

bool folds_freely(const Patch& piece, const Folds& tree, const Context& context) {
  const FoldMotion motion(flat_piece(piece, tree));
  FoldTrial trial(motion, context);
  return find_folding(motion, trial, context).way != FoldWay::with_care;
}

Folds fold_freely(const Patch& piece, const Folds& tree, const std::function<bool(const Folds&)>& allowed,
                  double tolerance, std::uint64_t seed, const Context& context) {
  if (piece.size() > most_faces) {
    return tree;
  }
  Course course = course_of(piece, tree, std::numeric_limits<std::size_t>::max(), context);
  if (course.free) {
    return tree;
  }
  FreeFolding search(piece, tree, tolerance, seed, context);
  // As everywhere: the search counts by small steps, only a fresh layout may call a net clean.
  const bool better = search.run(std::move(course), allowed) &&
                      find_overlaps(lay_out(piece, search.tree()), tolerance).empty();
  return better ? search.tree() : tree;
}

}  // namespace ridgecraft::unfold
