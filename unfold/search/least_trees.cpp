// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/least_trees.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "unfold/patch/sub_patch.hpp"
#include "unfold/search/edged_triangle.hpp"
#include "unfold/search/least_forest.hpp"
#include "unfold/search/plates.hpp"

namespace ridgecraft::unfold {
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
    std::uint32_t from = nothing;
    std::size_t next = 0;  ///< of its edges
  };

  void enter(std::uint32_t panel, std::uint32_t from) {
    number_[panel] = low_[panel] = ++last_;
    open_.push_back(panel);
    steps_.push_back({panel, from, 0});
  }

  void visit(std::uint32_t root) {
    enter(root, nothing);
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
      if (from != nothing) {
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
