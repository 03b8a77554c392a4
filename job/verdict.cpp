// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/verdict.hpp"

#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::job {

bool larger_size_is_sure(const prepare::CleanupReport& cleanup, const prepare::SkinReport& skin) {
  return cleanup.left_out.count() == 0 && cleanup.proxies.count == 0 && cleanup.thin_walls.walls == 0 &&
         skin.gaps_closed == 0;
}

std::string verdict(const prepare::Prepared& prepared, const prepare::SimplifyOptions& simplify,
                    bool larger_is_sure) {
  if (prepare::can_be_folded(prepared)) {
    return {};
  }
  std::vector<std::string> reasons;
  if (prepared.simplified.still_too_fine) {
    reasons.push_back(fmt::format("{:.0f} % of the folds are shorter than {:g} mm",
                                  100.0 * prepared.simplified.tiny_edges_after, simplify.tiny_edge_mm));
  }
  if (prepare::has_many_slivers(prepared)) {
    reasons.push_back(fmt::format("{:.0f} % of the faces are narrower than {:g} mm",
                                  100.0 * prepared.sliver_fraction, prepare::sliver_mm));
  }
  const std::string size =
      prepared.smallest_size_mm
          ? fmt::format("at {:.0f} mm it {}", *prepared.smallest_size_mm, larger_is_sure ? "can" : "may")
          : "no larger size that was tried helps";
  return fmt::format("can't be built at {:.4g} mm: {}; {}", prepared.model.surface.bounds().largest_extent(),
                     listed(reasons, "and"), size);
}

}  // namespace ridgecraft::job
