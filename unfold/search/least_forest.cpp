// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/least_forest.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/circle_tree.hpp"
#include "unfold/search/plates.hpp"

namespace ridgecraft::unfold {
namespace {

/// Steps between two looks at the clock.
constexpr std::uint64_t steps_per_look = 256;

class ForestSearch {
 public:
  ForestSearch(const Patch& patch, const LeastForestSearch& options, const Context& context)
      : patch_(patch),
        options_(options),
        context_(context),
        plates_(plates_of(patch)),
        arcs_(arcs_between(patch, plates_)) {}

  LeastForest run() {
    LeastForest result;
    for (; result.at_least <= options_.most_pieces; ++result.at_least) {
      allowed_ = result.at_least;
      begin();
      const bool found = descend();
      if (found) {
        result.folds = folds();
      }
      if (found || stopped_) {
        break;
      }
    }
    result.finished = !stopped_;
    result.work = work_;
    return result;
  }

 private:
  /// What one fold changed, to be taken back.
  struct Joined {
    std::uint32_t stays = 0, moves = 0;  ///< trees
    std::size_t size = 0;                ///< of the one that stays, before
  };

  /// Every panel by itself, every edge open.
  void begin() {
    const std::size_t n = plates_.size();
    tree_of_.resize(n);
    members_.assign(n, {});
    at_.assign(n, Rigid{});
    for (std::uint32_t p = 0; p < n; ++p) {
      tree_of_[p] = p;
      members_[p] = {p};
    }
    trees_ = n;
    for (Arc& arc : arcs_) {
      arc.open = true;
      arc.fold = false;
    }
    closed_.clear();
    for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
      if (meet({arcs_[i].a}, {arcs_[i].b}, arcs_[i].across)) {
        close(i);
      }
    }
  }

  void close(std::uint32_t arc) {
    arcs_[arc].open = false;
    closed_.push_back(arc);
  }

  /// True when a forest of few enough trees was found; false when there is none below here, or the work is
  /// spent.
  bool descend() {
    if (trees_ <= allowed_) {
      return true;
    }
    if (spent() || !can_connect()) {
      return false;
    }
    const std::uint32_t arc = next_arc();
    const std::size_t mark = closed_.size();
    close(arc);
    arcs_[arc].fold = true;
    const Joined joined = join(arc);
    if (descend()) {
      return true;
    }
    arcs_[arc].fold = false;
    part(joined);
    reopen(mark);
    close(arc);
    const bool found = descend();
    if (!found) {
      reopen(mark);
    }
    return found;
  }

  bool spent() {
    if (++steps_ % steps_per_look == 0) {
      context_.check();
      stopped_ = stopped_ || context_.out_of_time();
    }
    stopped_ = stopped_ || work_ >= options_.work;
    return stopped_;
  }

  void reopen(std::size_t mark) {
    while (closed_.size() > mark) {
      arcs_[closed_.back()].open = true;
      closed_.pop_back();
    }
  }

  /// Whether all open edges as folds would leave few enough trees.
  [[nodiscard]] bool can_connect() const {
    DisjointSets sets(plates_.size());
    std::size_t left = trees_;
    for (const Arc& arc : arcs_) {
      if (arc.open && sets.join(tree_of_[arc.a], tree_of_[arc.b])) {
        --left;
      }
    }
    return left <= allowed_;
  }

  /// An edge of the tree with the fewest open ones: where it must have one, little is left to choose. Among
  /// these the largest, which is met soonest.
  [[nodiscard]] std::uint32_t next_arc() const {
    std::vector<std::uint32_t> open(plates_.size(), 0);
    for (const Arc& arc : arcs_) {
      if (arc.open) {
        ++open[tree_of_[arc.a]];
        ++open[tree_of_[arc.b]];
      }
    }
    std::uint32_t best = no_index;
    std::pair<std::uint32_t, std::size_t> least{no_index, 0};
    for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
      if (!arcs_[i].open) {
        continue;
      }
      for (const std::uint32_t tree : {tree_of_[arcs_[i].a], tree_of_[arcs_[i].b]}) {
        const std::pair<std::uint32_t, std::size_t> key{open[tree], plates_.size() - members_[tree].size()};
        if (best == no_index || key < least) {
          best = i;
          least = key;
        }
      }
    }
    return best;
  }

  /// The trees at a fold become one, and what can't be folded any more is closed.
  Joined join(std::uint32_t fold) {
    const Arc& arc = arcs_[fold];
    std::uint32_t stays = tree_of_[arc.a];
    std::uint32_t moves = tree_of_[arc.b];
    Rigid motion = at_[arc.a] * arc.across * at_[arc.b].inverse();
    if (members_[stays].size() < members_[moves].size()) {
      std::swap(stays, moves);
      motion = motion.inverse();
    }
    const Joined joined{stays, moves, members_[stays].size()};
    const std::vector<std::uint32_t> before = members_[stays];
    for (const std::uint32_t p : members_[moves]) {
      at_[p] = motion * at_[p];
      tree_of_[p] = stays;
      members_[stays].push_back(p);
    }
    --trees_;
    for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
      if (!arcs_[i].open) {
        continue;
      }
      const std::uint32_t a = tree_of_[arcs_[i].a];
      const std::uint32_t b = tree_of_[arcs_[i].b];
      if (a == b) {
        close(i);
      } else if (a == stays || b == stays) {
        // The half at which the edge doesn't lie is new to the tree beyond it.
        const std::uint32_t own = a == stays ? arcs_[i].a : arcs_[i].b;
        const bool of_moved = std::find(before.begin(), before.end(), own) == before.end();
        const std::vector<std::uint32_t>& others = of_moved ? before : members_[moves];
        const Rigid between = at_[arcs_[i].a] * arcs_[i].across * at_[arcs_[i].b].inverse();
        if (a == stays ? meet(others, members_[b], between) : meet(members_[a], others, between)) {
          close(i);
        }
      }
    }
    return joined;
  }

  void part(const Joined& joined) {
    members_[joined.stays].resize(joined.size);
    // Frames needn't be what they were: only how panels of one tree lie to each other counts.
    for (const std::uint32_t p : members_[joined.moves]) {
      tree_of_[p] = joined.moves;
    }
    ++trees_;
  }

  /// Whether any face of one set overlaps one of the other, which lies in a frame moved by `motion`.
  bool meet(const std::vector<std::uint32_t>& first, const std::vector<std::uint32_t>& second,
            const Rigid& motion) {
    for (const std::uint32_t q : second) {
      const Rigid there = motion * at_[q];
      for (const std::uint32_t p : first) {
        if (plates_meet(plates_[p], plates_[q], at_[p].inverse() * there)) {
          return true;
        }
      }
    }
    return false;
  }

  bool plates_meet(const Plate& p, const Plate& q, const Rigid& motion) {
    for (std::size_t j = 0; j < q.faces.size(); ++j) {
      const Circle circle{motion(q.circle[j].centre), q.circle[j].radius};
      work_ += p.faces.size();
      for (std::size_t i = 0; i < p.faces.size(); ++i) {
        if (!apart(circle, p.circle[i]) && overlap(p.flat[i], moved(q.flat[j], motion), options_.tolerance)) {
          return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] Folds folds() const {
    Folds folds = folds_of_plates(patch_, plates_);
    for (const Arc& arc : arcs_) {
      if (arc.fold) {
        set_fold(patch_, folds, arc.side, true);
      }
    }
    return folds;
  }

  const Patch& patch_;
  const LeastForestSearch& options_;
  const Context& context_;
  std::vector<Plate> plates_;
  std::vector<Arc> arcs_;

  std::size_t allowed_ = 1;
  std::vector<std::uint32_t> tree_of_;               ///< of each panel: a panel that it is named by
  std::vector<std::vector<std::uint32_t>> members_;  ///< panels of each tree
  std::vector<Rigid> at_;                            ///< of each panel in its tree's frame
  std::size_t trees_ = 0;
  std::vector<std::uint32_t> closed_;  ///< edges in the order in which they were
  std::uint64_t work_ = 0;
  std::uint64_t steps_ = 0;
  bool stopped_ = false;
};

}  // namespace

LeastForest least_forest(const Patch& patch, const LeastForestSearch& options, const Context& context) {
  return ForestSearch(patch, options, context).run();
}

namespace {

/// Whether two panels overlap when the edge between them is a fold.
bool meet_over(const Arc& arc, const std::vector<Plate>& plates, double tolerance) {
  const Plate& p = plates[arc.a];
  const Plate& q = plates[arc.b];
  for (std::size_t j = 0; j < q.faces.size(); ++j) {
    const Circle circle{arc.across(q.circle[j].centre), q.circle[j].radius};
    for (std::size_t i = 0; i < p.faces.size(); ++i) {
      if (!apart(circle, p.circle[i]) && overlap(p.flat[i], moved(q.flat[j], arc.across), tolerance)) {
        return true;
      }
    }
  }
  return false;
}

/// Panels as a graph of edges that may be folds.
struct PanelGraph {
  struct Edge {
    std::uint32_t to = 0;
    std::uint32_t arc = 0;
  };
  std::vector<std::vector<Edge>> edges;  ///< of each panel
};

PanelGraph graph_of(const std::vector<Plate>& plates, const std::vector<Arc>& arcs, double tolerance) {
  PanelGraph graph;
  graph.edges.resize(plates.size());
  for (std::uint32_t i = 0; i < arcs.size(); ++i) {
    if (!meet_over(arcs[i], plates, tolerance)) {
      graph.edges[arcs[i].a].push_back({arcs[i].b, i});
      graph.edges[arcs[i].b].push_back({arcs[i].a, i});
    }
  }
  return graph;
}

/// Blocks of a graph: sets of panels that no single panel parts (J. Hopcroft, R. Tarjan, 1973).
class Blocks {
 public:
  explicit Blocks(const PanelGraph& graph)
      : graph_(graph), number_(graph.edges.size(), 0), low_(graph.edges.size(), 0) {
    for (std::uint32_t p = 0; p < graph.edges.size(); ++p) {
      if (number_[p] == 0) {
        ++components_;
        visit(p);
      }
    }
  }

  [[nodiscard]] std::size_t components() const { return components_; }
  /// Panels of each, ascending.
  [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& blocks() const { return blocks_; }

 private:
  struct Step {
    std::uint32_t panel = 0;
    std::uint32_t from = no_index;
    std::size_t next = 0;  ///< of its edges
  };

  void enter(std::uint32_t panel, std::uint32_t from) {
    number_[panel] = low_[panel] = ++last_;
    open_.push_back(panel);
    steps_.push_back({panel, from, 0});
  }

  void visit(std::uint32_t root) {
    enter(root, no_index);
    while (!steps_.empty()) {
      Step& step = steps_.back();
      const std::uint32_t panel = step.panel;
      if (step.next < graph_.edges[panel].size()) {
        const std::uint32_t to = graph_.edges[panel][step.next++].to;
        if (number_[to] == 0) {
          enter(to, panel);
        } else {
          low_[panel] = std::min(low_[panel], number_[to]);
        }
        continue;
      }
      const std::uint32_t from = step.from;
      steps_.pop_back();
      if (from != no_index) {
        low_[from] = std::min(low_[from], low_[panel]);
        if (low_[panel] >= number_[from]) {
          close(panel, from);
        }
      }
    }
    open_.clear();
  }

  /// What was entered since `panel` is a block together with the panel before it.
  void close(std::uint32_t panel, std::uint32_t before) {
    std::vector<std::uint32_t>& block = blocks_.emplace_back(1, before);
    while (block.back() != panel) {
      block.push_back(open_.back());
      open_.pop_back();
    }
    std::sort(block.begin(), block.end());
  }

  const PanelGraph& graph_;
  std::vector<std::uint32_t> number_;  ///< of each panel in the order of entering, from 1
  std::vector<std::uint32_t> low_;     ///< the least that can be reached from what is below
  std::vector<std::uint32_t> open_;
  std::vector<Step> steps_;
  std::uint32_t last_ = 0;
  std::size_t components_ = 0;
  std::vector<std::vector<std::uint32_t>> blocks_;
};

}  // namespace

std::size_t least_trees(const Patch& patch, const LeastTreesSearch& options, const Context& context) {
  const std::vector<Plate> plates = plates_of(patch);
  const PanelGraph graph = graph_of(plates, arcs_between(patch, plates), options.tolerance);
  const Blocks parted(graph);
  std::size_t trees = parted.components();
  std::uint64_t work = options.work;
  for (const std::vector<std::uint32_t>& block : parted.blocks()) {
    // Two panels are one net, whatever joins them.
    if (block.size() < 3 || block.size() > options.most_panels) {
      continue;
    }
    std::vector<std::uint32_t> faces;
    for (const std::uint32_t p : block) {
      faces.insert(faces.end(), plates[p].faces.begin(), plates[p].faces.end());
    }
    std::sort(faces.begin(), faces.end());
    const LeastForest least =
        least_forest(sub_patch(patch, faces), {options.tolerance, block.size() - 1, work}, context);
    trees += least.at_least - 1;
    work -= std::min(work, least.work);
  }
  return trees;
}

}  // namespace ridgecraft::unfold
