// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tab_split.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "unfold/search/forest.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// A cut by one of its sides.
using Cut = std::uint32_t;

class Splitter {
 public:
  Splitter(const NetProblem& problem, const Folds& folds, const NetsOf& nets_of, const Context& context)
      : surface_(problem.surface),
        patch_(problem.patch),
        options_(problem.options.tabs),
        nets_of_(nets_of),
        context_(context),
        forest_(patch_),
        tabs_(surface_, problem.panels, patch_, forest_, options_) {
    forest_.set_folds(folds);
    tabs_.renew_all();
  }

  Folds run() {
    while (make_room()) {
    }
    return forest_.folds();
  }

 private:
  /// One round: whether anything was cut.
  bool make_room() {
    bool any = false;
    for (const Cut cut : without_tab()) {
      context_.check();
      if (context_.out_of_time()) {
        return false;
      }
      // One that has a tab here was given it by an earlier cut, or place_tabs knows why it can't have it.
      any = (!tabs_.has_tab(cut) && make_room_at(cut)) || any;
    }
    return any;
  }

  /// Joins of the nets that have no usable tab and aren't too narrow for one.
  [[nodiscard]] std::vector<Cut> without_tab() const {
    const Nets nets = nets_of_(forest_.folds());
    std::vector<Cut> cuts;
    for (const Join& join : nets.joins) {
      if (!join.too_narrow && !(join.tab.valid() && is_usable(surface_, nets, join.tab, options_))) {
        cuts.push_back(tabs_.join_of(surface_.sides(join.edge)[0].value()));
      }
    }
    return cuts;
  }

  /// Cuts folds near a cut until it has a tab; none where that doesn't come to one.
  bool make_room_at(Cut cut) {
    std::vector<Move> made;
    while (!tabs_.has_tab(cut)) {
      const std::optional<std::uint32_t> fold = best_fold_at(cut);
      if (!fold) {
        for (; !made.empty(); made.pop_back()) {
          tabs_.make(made.back().inverse());
        }
        return false;
      }
      made.push_back({*fold, no_index});
      tabs_.make(made.back());
    }
    return true;
  }

  /// The fold that gives a cut a tab and leaves the fewest others without one; where none does, the one that
  /// takes most away from what lies near the cut; nothing where none takes anything away.
  std::optional<std::uint32_t> best_fold_at(Cut cut) {
    std::set<std::uint32_t> folds;
    for (const std::uint32_t side : {cut, patch_.twin[cut]}) {
      for (const std::uint32_t face : tabs_.faces_near(side)) {
        const std::vector<std::uint32_t>& way = forest_.folds_between(side / 3, face);
        folds.insert(way.begin(), way.end());
      }
    }
    using Worth = std::tuple<bool, std::int64_t, double>;
    Worth best{false, -near(cut), 0.0};
    std::optional<std::uint32_t> chosen;
    for (const std::uint32_t fold : folds) {
      tabs_.make({fold, no_index});
      const bool has_tab = tabs_.has_tab(cut);
      const Worth worth{has_tab, has_tab ? std::int64_t{tabs_.tabs()} : -near(cut), -patch_.length[fold]};
      tabs_.take_back();
      const bool takes_something = has_tab || std::get<1>(worth) > -near(cut);
      if (takes_something && worth > best) {
        best = worth;
        chosen = fold;
      }
    }
    return chosen;
  }

  /// How many faces lie near the side of a cut that has fewer.
  [[nodiscard]] std::int64_t near(Cut cut) const {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (const std::uint32_t side : {cut, patch_.twin[cut]}) {
      if (!tabs_.candidates()[side].empty()) {
        least = std::min(least, static_cast<std::int64_t>(tabs_.faces_near(side).size()));
      }
    }
    return least;
  }

  const mesh::Surface& surface_;
  const Patch& patch_;
  const TabOptions& options_;
  const NetsOf& nets_of_;
  const Context& context_;
  Forest forest_;
  TabState tabs_;
};

}  // namespace

Folds split_for_tabs(const NetProblem& problem, const Folds& folds, const NetsOf& nets_of,
                     const Context& context) {
  return Splitter(problem, folds, nets_of, context).run();
}

}  // namespace ridgecraft::unfold
