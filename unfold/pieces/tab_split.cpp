// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/tab_split.hpp"

#include <limits>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/pieces/tab_cuts.hpp"
#include "unfold/pieces/tab_unite.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

/// Ways to split that are tried: the first by the order of worth, the others with blurred orders.
constexpr std::size_t attempts = 4;
constexpr double blur_of_order = 0.5;

/// Cuts until no tab is missing, or none of those that are can be had by cutting.
TabSplit cut_for_tabs(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                      const TabGaps& tab_gaps, const NetsOf& nets_of, double blur, Random& random,
                      const Context& context) {
  TabSplit result{folds, 0};
  for (;;) {
    context.check();
    const Nets nets = nets_of(result.folds);
    const std::vector<JoinId> missing = tab_gaps.missing(nets);
    result.missing = missing.size();
    if (missing.empty() || context.out_of_time()) {
      return result;
    }
    const std::vector<TabGap> gaps = tab_gaps.gaps(nets, missing, context);
    const std::vector<std::uint32_t> cuts =
        choose_tab_cuts(surface, patch, result.folds, tab_gaps, gaps, blur, random, context);
    if (cuts.empty()) {
      return result;
    }
    for (const std::uint32_t side : cuts) {
      set_fold(patch, result.folds, side, false);
    }
  }
}

}  // namespace

TabSplit split_for_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                        const Folds& folds, const Room& room, const TabOptions& options,
                        const NetsOf& nets_of, double tolerance, std::uint64_t seed, const Context& context) {
  const TabGaps tab_gaps(surface, panels, patch, folds, options, context);
  const Layout before = lay_out(patch, folds);
  TabUnions rules{surface, panels, patch, room, options, tab_gaps, nets_of, before.piece, tolerance, false};
  // What there is no time to try is worse than anything.
  std::vector<TabSplit> tried(attempts, {folds, std::numeric_limits<std::size_t>::max()});
  do_in_parallel(attempts, context, [&](std::size_t i, const Context& own) {
    if (i > 0 && own.out_of_time()) {
      return;
    }
    Random random = Random::stream(seed, i);
    const double blur = i == 0 ? 0.0 : blur_of_order;
    const TabSplit cut = cut_for_tabs(surface, patch, folds, tab_gaps, nets_of, blur, random, own);
    tried[i] = unite_with_tabs(rules, cut.folds, cut.missing, random.next(), own);
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < attempts; ++i) {
    const bool fewer = tried[i].missing < tried[best].missing;
    if (fewer || (tried[i].missing == tried[best].missing &&
                  cost_of(patch, tried[i].folds) < cost_of(patch, tried[best].folds))) {
      best = i;
    }
  }
  rules.search = true;
  return unite_with_tabs(rules, tried[best].folds, tried[best].missing, seed, context);
}

}  // namespace ridgecraft::unfold
