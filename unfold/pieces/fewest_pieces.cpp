// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/fewest_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/search/circle_tree.hpp"
#include "unfold/search/heated_search.hpp"
#include "unfold/search/least_forest.hpp"

namespace ridgecraft::unfold {
namespace {

class Merger {
 public:
  Merger(const Patch& patch, const Folds& folds, const Room& room, double tolerance, std::uint64_t budget)
      : patch_(patch), folds_(folds), room_(room), tolerance_(tolerance), budget_(budget) {
    Layout layout = lay_out(patch, folds);
    for (const auto& faces : layout.faces) {
      hulls_.push_back(hull_of(layout, faces));
      panels_.push_back(panels_of(patch, folds, faces));
    }
    flat_ = std::move(layout.flat);
    piece_ = std::move(layout.piece);
    faces_ = std::move(layout.faces);
    circles_.reserve(flat_.size());
    for (const Triangle& t : flat_) {
      circles_.push_back(smallest_circle(t[0], t[1], t[2]));
    }
  }

  void run(const Context& context, Random* random) {
    std::vector<std::uint32_t> cuts;
    std::vector<double> weight(patch_.twin.size(), 0.0);
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != nothing && side < twin && piece_[side / 3] != piece_[twin / 3]) {
        cuts.push_back(side);
        weight[side] = patch_.length[side] * (random != nullptr ? 0.3 + random->unit() : 1.0);
      }
    }
    std::stable_sort(cuts.begin(), cuts.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (patch_.frozen[a] != patch_.frozen[b]) {
        return patch_.frozen[a] > patch_.frozen[b];
      }
      return weight[a] > weight[b];
    });
    for (bool again = true; again && budget_ > 0;) {
      again = false;
      for (const std::uint32_t side : cuts) {
        context.check();
        if (piece_[side / 3] != piece_[patch_.twin[side] / 3] && join(side)) {
          again = true;
        }
      }
    }
  }

  [[nodiscard]] Folds& folds() { return folds_; }

 private:
  bool join(std::uint32_t side) {
    if (faces_[piece_[side / 3]].size() < faces_[piece_[patch_.twin[side] / 3]].size()) {
      side = patch_.twin[side];
    }
    const std::uint32_t stays = piece_[side / 3];
    const std::uint32_t moves = piece_[patch_.twin[side] / 3];
    const Rigid motion = frame(side / 3) * patch_.across[side] * frame(patch_.twin[side] / 3).inverse();
    std::vector<Vec2> points = hulls_[stays];
    for (const Vec2 p : hulls_[moves]) {
      points.push_back(motion(p));
    }
    const std::size_t panels = panels_[stays] + panels_[moves] - within_panel(patch_, side);
    std::vector<Vec2> hull = convex_hull(std::move(points));
    if (!room_.holds(hull, panels) || collides(stays, moves, motion)) {
      return false;
    }
    for (const std::uint32_t f : faces_[moves]) {
      piece_[f] = stays;
      for (Vec2& p : flat_[f]) {
        p = motion(p);
      }
      circles_[f].centre = motion(circles_[f].centre);
      faces_[stays].push_back(f);
    }
    faces_[moves].clear();
    hulls_[stays] = std::move(hull);
    panels_[stays] = panels;
    set_fold(patch_, folds_, side, true);
    return true;
  }

  /// Where a face's own frame lies now.
  [[nodiscard]] Rigid frame(std::uint32_t f) const {
    const Triangle& own = patch_.shape[f];
    unsigned k = 0;
    for (unsigned j = 1; j < 3; ++j) {
      k = patch_.length[3 * f + j] > patch_.length[3 * f + k] ? j : k;
    }
    const Vec2 from = own[(k + 1) % 3] - own[k];
    const Vec2 to = flat_[f][(k + 1) % 3] - flat_[f][k];
    const double size = length(from) * length(to);
    Rigid r;
    if (size > 0.0) {
      r = {dot(from, to) / size, cross(from, to) / size, {}};
      r = r * Rigid{};
    }
    r.shift = flat_[f][k] - r.turn(own[k]);
    return r;
  }

  bool collides(std::uint32_t stays, std::uint32_t moves, const Rigid& motion) {
    for (const std::uint32_t f : faces_[moves]) {
      const Circle circle{motion(circles_[f].centre), circles_[f].radius};
      const Triangle moved{motion(flat_[f][0]), motion(flat_[f][1]), motion(flat_[f][2])};
      for (const std::uint32_t g : faces_[stays]) {
        if (!apart(circle, circles_[g]) && overlap(moved, flat_[g], tolerance_)) {
          return true;
        }
      }
      const std::uint64_t tested = faces_[stays].size();
      if (budget_ <= tested) {
        budget_ = 0;
        return true;
      }
      budget_ -= tested;
    }
    return false;
  }

  const Patch& patch_;
  Folds folds_;
  const Room& room_;
  double tolerance_;
  std::uint64_t budget_;
  std::vector<Triangle> flat_;
  std::vector<Circle> circles_;
  std::vector<std::uint32_t> piece_;
  std::vector<std::vector<std::uint32_t>> faces_;
  std::vector<std::vector<Vec2>> hulls_;
  std::vector<std::size_t> panels_;
};

}  // namespace

Folds merge_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                   std::uint64_t pair_budget, const Context& context, Random* random) {
  Merger merger(patch, folds, room, tolerance, pair_budget);
  merger.run(context, random);
  return std::move(merger.folds());
}

namespace {

/// Two faces that overlap, as places in the tree.
struct Conflict {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t top = 0;  ///< where their paths to the root meet
};

/// A tree with what lies below each of its folds, named by the place of the lower face.
class Tree {
 public:
  Tree(const Patch& patch, const Folds& folds, std::uint32_t root, std::vector<std::uint32_t>& place)
      : tree_(rooted_tree(patch, folds, root, place)), below_(size(), 1), head_(size(), 0) {
    for (std::uint32_t i = size(); i-- > 1;) {
      below_[tree_.parent[i]] += below_[i];
    }
    std::vector<std::uint32_t> heavy(size(), 0);  // the child with most faces below it
    for (std::uint32_t i = size(); i-- > 1;) {
      std::uint32_t& child = heavy[tree_.parent[i]];
      child = child == 0 || below_[i] > below_[child] ? i : child;
    }
    for (std::uint32_t i = 1; i < size(); ++i) {
      head_[i] = heavy[tree_.parent[i]] == i ? head_[tree_.parent[i]] : i;
    }
  }

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(tree_.order.size()); }
  [[nodiscard]] std::uint32_t up(std::uint32_t i) const { return tree_.up[i]; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t i) const { return tree_.parent[i]; }
  /// Faces on the smaller side of the fold at i.
  [[nodiscard]] std::uint32_t smaller(std::uint32_t i) const {
    return std::min(below_[i], size() - below_[i]);
  }
  /// Where the ways of two places to the root meet. O(log n): each chain of heavy children is one step.
  [[nodiscard]] std::uint32_t meet(std::uint32_t a, std::uint32_t b) const {
    while (head_[a] != head_[b]) {
      // Places grow from parents to children: the later head can't be above the other place.
      std::uint32_t& later = head_[a] > head_[b] ? a : b;
      later = tree_.parent[head_[later]];
    }
    return std::min(a, b);
  }

 private:
  RootedTree tree_;
  std::vector<std::uint32_t> below_;
  std::vector<std::uint32_t> head_;  ///< the top of the chain that a place is on
};

/// A connected part of a tree, with the conflicts inside it.
struct OpenPart {
  std::vector<std::uint32_t> places;  ///< ascending, so parents come first
  std::vector<Conflict> conflicts;
};

/// Cuts one tree until no conflict is left. What is cut on one side of a cut doesn't depend on the other, so
/// each side goes on by itself.
class TreeCutter {
 public:
  TreeCutter(const Patch& patch, const Tree& tree, Folds& result)
      : patch_(patch), tree_(tree), result_(result), hits_(tree.size(), 0), inside_(tree.size(), 0) {}

  void run(std::vector<Conflict> conflicts) {
    OpenPart whole;
    whole.places.resize(tree_.size());
    std::iota(whole.places.begin(), whole.places.end(), 0U);
    whole.conflicts = std::move(conflicts);
    std::vector<OpenPart> open;
    open.push_back(std::move(whole));
    while (!open.empty()) {
      OpenPart branch = std::move(open.back());
      open.pop_back();
      if (!branch.conflicts.empty()) {
        count_hits(branch);
        const std::uint32_t best = best_cut(branch);
        set_fold(patch_, result_, tree_.up(best), false);
        open.push_back(taken_off(branch, best));
        open.push_back(std::move(branch));
      }
    }
  }

 private:
  /// How many conflicts' paths run over the fold at each place. O(size of the branch).
  void count_hits(const OpenPart& branch) {
    for (const std::uint32_t i : branch.places) {
      hits_[i] = 0;
    }
    for (const Conflict& c : branch.conflicts) {
      ++hits_[c.a];
      ++hits_[c.b];
      hits_[c.top] -= 2;
    }
    for (std::size_t k = branch.places.size(); k-- > 1;) {
      hits_[tree_.parent(branch.places[k])] += hits_[branch.places[k]];
    }
  }

  /// Whether a is the better place to cut: sides of panels come last, then the most hits count, then the most
  /// faces on the smaller side.
  [[nodiscard]] bool better(std::uint32_t a, std::uint32_t b) const {
    const auto key = [&](std::uint32_t i) {
      const bool whole = patch_.frozen[tree_.up(i)] == 0 && hits_[i] > 0;
      return std::tuple(whole, hits_[i], tree_.smaller(i));
    };
    return key(a) != key(b) ? key(a) > key(b) : a < b;
  }

  [[nodiscard]] std::uint32_t best_cut(const OpenPart& branch) const {
    std::uint32_t best = branch.places[1];
    for (std::size_t k = 2; k < branch.places.size(); ++k) {
      best = better(branch.places[k], best) ? branch.places[k] : best;
    }
    return best;
  }

  /// Takes what lies below a cut off a branch. Conflicts across the cut are none any more.
  OpenPart taken_off(OpenPart& branch, std::uint32_t cut) {
    inside_[branch.places.front()] = 0;
    for (std::size_t k = 1; k < branch.places.size(); ++k) {
      const std::uint32_t i = branch.places[k];
      inside_[i] = i == cut || inside_[tree_.parent(i)] != 0 ? 1 : 0;
    }
    OpenPart below;
    std::copy_if(branch.places.begin(), branch.places.end(), std::back_inserter(below.places),
                 [&](std::uint32_t i) { return inside_[i] != 0; });
    std::copy_if(branch.conflicts.begin(), branch.conflicts.end(), std::back_inserter(below.conflicts),
                 [&](const Conflict& c) { return inside_[c.a] != 0 && inside_[c.b] != 0; });
    std::erase_if(branch.places, [&](std::uint32_t i) { return inside_[i] != 0; });
    std::erase_if(branch.conflicts,
                  [&](const Conflict& c) { return inside_[c.a] != 0 || inside_[c.b] != 0; });
    return below;
  }

  const Patch& patch_;
  const Tree& tree_;
  Folds& result_;
  std::vector<std::uint32_t> hits_;  ///< unsigned, but only sums of them count
  std::vector<std::uint8_t> inside_;
};

}  // namespace

Folds split_overlaps(const Patch& patch, const Folds& folds, double tolerance) {
  Folds result = folds;
  const Layout layout = lay_out(patch, folds);
  std::vector<std::vector<OverlapFound>> pairs(layout.faces.size());
  for (const OverlapFound& pair : find_overlaps(layout, tolerance)) {
    pairs[layout.piece[pair.first]].push_back(pair);
  }
  std::vector<std::uint32_t> place(patch.size(), nothing);
  for (std::size_t piece = 0; piece < pairs.size(); ++piece) {
    if (pairs[piece].empty()) {
      continue;
    }
    const Tree tree(patch, folds, layout.faces[piece].front(), place);
    std::vector<Conflict> conflicts;
    conflicts.reserve(pairs[piece].size());
    for (const OverlapFound& pair : pairs[piece]) {
      const std::uint32_t a = place[pair.first];
      const std::uint32_t b = place[pair.second];
      conflicts.push_back({a, b, tree.meet(a, b)});
    }
    TreeCutter(patch, tree, result).run(std::move(conflicts));
  }
  return result;
}

namespace {

/// Pairs of faces that one merge pass may compare: about 0.1 s.
constexpr std::uint64_t merge_pairs = 4'000'000;
/// Pairs that a proof may compare: about 0.5 s. Parts of 26 faces take a thousandth of it, the solid of 36
/// that has no net four times as much.
constexpr std::uint64_t proof_pairs = 10'000'000;
/// Patches of more panels have too many forests.
constexpr std::size_t most_proven_panels = 64;
/// Each number of linked trees gets this part of the trials that a single net is worth.
constexpr std::uint64_t shares_of_linked = 3;

class FewestSearch {
 public:
  FewestSearch(const Patch& patch, double tolerance, std::uint64_t seed, const Context& context)
      : patch_(patch), tolerance_(tolerance), random_(seed), context_(context) {}

  FewestPieces run(const NetFound& failed) {
    cut(failed.folds);
    prove();
    if (finished_ || context_.out_of_time()) {
      return std::move(result_);
    }
    Folds best = failed.folds;
    if (result_.proven_least == 1 && search_one(best)) {
      return std::move(result_);
    }
    search_linked(best);
    return std::move(result_);
  }

 private:
  void keep(Folds folds) {
    result_.pieces = cost_of(patch_, folds).pieces;
    result_.folds = std::move(folds);
  }

  void cut(const Folds& tree) {
    keep(merge_pieces(patch_, split_overlaps(patch_, tree, tolerance_), Room{}, tolerance_, merge_pairs,
                      context_));
  }

  void prove() {
    if (context_.out_of_time()) {
      return;
    }
    // The patch as a whole is left to the second proof, which may find the nets, too.
    const std::size_t panels = panel_count(patch_);
    const std::size_t most_of_block = std::min(most_proven_panels, panels - 1);
    result_.proven_least = least_trees(patch_, {tolerance_, most_of_block, proof_pairs}, context_);
    finished_ = result_.proven_least >= result_.pieces;
    if (finished_ || panels > most_proven_panels) {
      return;
    }
    LeastForest least = least_forest(patch_, {tolerance_, result_.pieces - 1, proof_pairs}, context_);
    result_.proven_least = std::max(result_.proven_least, least.at_least);
    finished_ = least.finished;
    if (!least.folds.empty() && is_clean(least.folds)) {
      keep(std::move(least.folds));
    }
  }

  [[nodiscard]] bool is_clean(const Folds& folds) const {
    return find_overlaps(lay_out(patch_, folds), tolerance_).empty();
  }

  /// One tree with patience. `best`: where it begins, then the best tree that it found.
  bool search_one(Folds& best) {
    const HeatedSearch options{tolerance_, heated_trials(patch_.size())};
    HeatedFound found = heated_search(patch_, best, options, random_.next(), context_);
    best = std::move(found.folds);
    if (found.overlaps > 0) {
      const std::size_t before = result_.pieces;
      FewestPieces cuts = result_;
      cut(best);
      if (result_.pieces >= before) {
        result_ = std::move(cuts);
      }
      return false;
    }
    keep(std::move(best));
    return true;
  }

  /// Fewer trees than the cuts left. More are found sooner, so the number is halved in: each that is found is
  /// the most from then on.
  void search_linked(const Folds& best) {
    const std::vector<std::uint32_t> places = places_to_part(best);
    const std::uint64_t trials = heated_trials(patch_.size()) / shares_of_linked;
    const std::size_t most_trees = std::min(places.size(), most_links) + 1;
    std::size_t least = std::max<std::size_t>(2, result_.proven_least);
    for (std::size_t most = std::min(result_.pieces, most_trees + 1);
         least < most && !context_.out_of_time();) {
      const std::size_t trees = least + (most - least) / 2;
      const std::vector<std::uint32_t> links(places.begin(),
                                             places.begin() + static_cast<std::ptrdiff_t>(trees - 1));
      const Patch linked = linked_patch(patch_, links);
      HeatedFound found = heated_search(linked, best, {tolerance_, trials}, random_.next(), context_);
      for (const std::uint32_t side : links) {
        set_fold(patch_, found.folds, side, false);
      }
      if (found.overlaps == 0 && is_clean(found.folds)) {
        keep(std::move(found.folds));
        most = trees;
      } else {
        least = trees + 1;
      }
    }
  }

  /// Folds of a tree that part it where it overlaps, those that leave the most balanced trees first.
  [[nodiscard]] std::vector<std::uint32_t> places_to_part(const Folds& tree) const {
    const Folds parted = split_overlaps(patch_, tree, tolerance_);
    std::vector<std::uint32_t> place(patch_.size(), nothing);
    const RootedTree rooted = rooted_tree(patch_, tree, 0, place);
    std::vector<std::uint32_t> below(patch_.size(), 1);
    for (std::uint32_t i = patch_.size(); i-- > 1;) {
      below[rooted.parent[i]] += below[i];
    }
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 1; i < patch_.size(); ++i) {
      if (parted[rooted.up[i]] == 0 && patch_.frozen[rooted.up[i]] == 0) {
        places.push_back(i);
      }
    }
    const auto smaller = [&](std::uint32_t i) { return std::min(below[i], patch_.size() - below[i]); };
    std::stable_sort(places.begin(), places.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return smaller(i) > smaller(j); });
    for (std::uint32_t& i : places) {
      i = rooted.up[i];
    }
    return places;
  }

  const Patch& patch_;
  double tolerance_;
  Random random_;
  const Context& context_;
  FewestPieces result_;
  bool finished_ = false;  ///< the proof leaves nothing to search for
};

}  // namespace

FewestPieces fewest_pieces(const Patch& patch, const NetFound& failed, double tolerance, std::uint64_t seed,
                           const Context& context) {
  return FewestSearch(patch, tolerance, seed, context).run(failed);
}

}  // namespace ridgecraft::unfold
