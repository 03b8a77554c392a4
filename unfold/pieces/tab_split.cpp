// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tab_split.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

/// A place from which a share s of what stands in the way is cut off is worth s to this power: one cut that
/// frees a tab is better than many that nearly do.
constexpr int sharpness = 3;
/// A cut that can't have a tab itself costs so much of one.
constexpr double narrow_cut = 0.7;
/// What a cut of this length costs more than a short one, in tabs: only to choose among equals.
constexpr double cost_of_length = 1e-4;  // per mm

/// All trees of a forest at once.
struct RootedForest {
  std::vector<std::uint32_t> up;     ///< per face: its side to its parent; nothing at a root
  std::vector<std::uint32_t> depth;  ///< per face

  RootedForest(const Patch& patch, const Folds& folds) : up(patch.size()), depth(patch.size(), no_index) {
    std::vector<std::uint32_t> place(patch.size());
    for (std::uint32_t root = 0; root < patch.size(); ++root) {
      if (depth[root] != no_index) {
        continue;
      }
      const RootedTree tree = rooted_tree(patch, folds, root, place);
      for (std::size_t i = 0; i < tree.order.size(); ++i) {
        up[tree.order[i]] = tree.up[i];
        depth[tree.order[i]] = i == 0 ? 0 : depth[tree.order[tree.parent[i]]] + 1;
      }
    }
  }
};

class Chooser {
 public:
  Chooser(const ForestWithGaps& forest, const Context& context)
      : surface_(forest.surface),
        patch_(forest.patch),
        tab_gaps_(forest.tab_gaps),
        context_(context),
        forest_(patch_, forest.folds),
        sum_(patch_.twin.size(), 0.0) {
    for (const TabGap& gap : forest.gaps) {
      context_.check();
      Gap& own = gaps_.emplace_back();
      for (const TabGap::Place& place : gap.places) {
        add_place(place, own);
      }
      if (own.places.empty()) {
        cut_off(gap, forest.folds, own);
      }
      measure(own);
    }
  }

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> cuts;
    for (;;) {
      context_.check();
      std::uint32_t best = no_index;
      double most = 0.0;
      for (const Worth& worth : worths()) {
        if (worth.tabs > most) {
          most = worth.tabs;
          best = worth.side;
        }
      }
      if (best == no_index) {
        return cuts;
      }
      cuts.push_back(best);
      take_away(best);
    }
  }

 private:
  using Path = std::vector<std::uint32_t>;  ///< folds that may be cut, each by its side of the lower face
  using Place = std::vector<Path>;          ///< to each thing in the way that isn't cut off yet
  struct Worth {
    std::uint32_t side = no_index;
    double tabs = 0.0;
  };
  struct Gap {
    std::vector<Place> places;
    std::vector<Worth> worths;  ///< of cutting each fold, for this gap; ascending by side
  };

  [[nodiscard]] Path path(std::uint32_t f, std::uint32_t g) const {
    Path result;
    while (f != g) {
      std::uint32_t& deeper = forest_.depth[f] >= forest_.depth[g] ? f : g;
      const std::uint32_t side = forest_.up[deeper];
      if (patch_.frozen[side] == 0) {
        result.push_back(side);
      }
      deeper = patch_.twin[side] / 3;
    }
    return result;
  }

  void add_place(const TabGap::Place& place, Gap& gap) const {
    Place paths;
    for (const FaceId f : place.in_the_way) {
      paths.push_back(path(place.face.value(), f.value()));
      if (paths.back().empty()) {
        return;
      }
    }
    if (!paths.empty()) {
      gap.places.push_back(std::move(paths));
    }
  }

  /// Where no place can be freed that was thought of: around the faces of the join, or where these lie inside
  /// flat regions, at the faces of those that are next to them.
  void cut_off(const TabGap& gap, const Folds& folds, Gap& own) const {
    std::set<std::uint32_t> ring;
    for (const TabGap::Place& place : gap.places) {
      ring.insert(place.face.value());
    }
    for (std::set<std::uint32_t> seen; !ring.empty() && own.places.empty();) {
      seen.insert(ring.begin(), ring.end());
      std::set<std::uint32_t> next;
      for (const std::uint32_t f : ring) {
        for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
          if (folds[side] == 0) {
            continue;
          }
          const std::uint32_t twin = patch_.twin[side];
          if (patch_.frozen[side] == 0) {
            own.places.push_back({{forest_.up[f] == side ? side : twin}});
          } else if (seen.count(twin / 3) == 0) {
            next.insert(twin / 3);
          }
        }
      }
      ring = std::move(next);
    }
  }

  static void measure(Gap& gap) {
    std::map<std::uint32_t, double> most;
    for (const Place& place : gap.places) {
      std::map<std::uint32_t, std::uint32_t> count;
      for (const Path& path : place) {
        for (const std::uint32_t side : path) {
          ++count[side];
        }
      }
      for (const auto& [side, n] : count) {
        const double share = static_cast<double>(n) / static_cast<double>(place.size());
        double& worth = most[side];
        worth = std::max(worth, elementary::pow(share, sharpness));
      }
    }
    gap.worths.clear();
    for (const auto& [side, worth] : most) {
      gap.worths.push_back({side, worth});
    }
  }

  /// What cutting each fold is worth, in tabs; ascending by side.
  [[nodiscard]] std::vector<Worth> worths() {
    std::vector<Worth> result;
    for (const Gap& gap : gaps_) {
      for (const Worth& worth : gap.worths) {
        if (sum_[worth.side] == 0.0) {
          result.push_back({worth.side, 0.0});
        }
        sum_[worth.side] += worth.tabs;
      }
    }
    std::sort(result.begin(), result.end(), [](const Worth& x, const Worth& y) { return x.side < y.side; });
    for (auto& [side, worth] : result) {
      const EdgeId edge = surface_.edge(mesh::corner(patch_.face[side / 3], side % 3));
      const double cost = (tab_gaps_.able(edge) ? 0.0 : narrow_cut) + cost_of_length * patch_.length[side];
      worth = std::max(sum_[side] - cost, 0.01 * sum_[side]);
      sum_[side] = 0.0;
    }
    return result;
  }

  void take_away(std::uint32_t cut) {
    for (Gap& gap : gaps_) {
      const auto at =
          std::lower_bound(gap.worths.begin(), gap.worths.end(), cut,
                           [](const Worth& worth, std::uint32_t side) { return worth.side < side; });
      if (at == gap.worths.end() || at->side != cut) {
        continue;
      }
      for (Place& place : gap.places) {
        std::erase_if(
            place, [&](const Path& path) { return std::find(path.begin(), path.end(), cut) != path.end(); });
      }
      if (std::any_of(gap.places.begin(), gap.places.end(), [](const Place& p) { return p.empty(); })) {
        gap = {};
      } else {
        measure(gap);
      }
    }
  }

  const mesh::Surface& surface_;
  const Patch& patch_;
  const TabGaps& tab_gaps_;
  const Context& context_;
  RootedForest forest_;
  std::vector<Gap> gaps_;
  std::vector<double> sum_;  ///< per side: space to work in, 0
};

}  // namespace

std::vector<std::uint32_t> choose_tab_cuts(const ForestWithGaps& forest, const Context& context) {
  return Chooser(forest, context).run();
}

Folds split_for_tabs(const NetProblem& problem, const Folds& folds, const NetsOf& nets_of,
                     const Context& context) {
  const Patch& patch = problem.patch;
  const TabGaps tab_gaps({problem.surface, problem.panels, problem.options.tabs}, patch, folds, context);
  Folds result = folds;
  for (;;) {
    context.check();
    const Nets nets = nets_of(result);
    const std::vector<JoinId> missing = tab_gaps.missing(nets);
    if (missing.empty() || context.out_of_time()) {
      return result;
    }
    const std::vector<TabGap> gaps = tab_gaps.gaps(nets, missing, context);
    const std::vector<std::uint32_t> cuts =
        choose_tab_cuts({problem.surface, patch, result, tab_gaps, gaps}, context);
    if (cuts.empty()) {
      return result;
    }
    for (const std::uint32_t side : cuts) {
      set_fold(patch, result, side, false);
    }
  }
}

}  // namespace ridgecraft::unfold
