// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the inks that stand for what a packaging machine does.
#pragma once

#include <string>

namespace ridgecraft::export_ {

/// Letter case matters to the programs that drive cutters.
struct SpotNames {
  std::string cut = "CutContour";
  std::string perforation = "PerfCutContour";
  std::string crease = "Crease";
  std::string glue = "Glue";
};

}  // namespace ridgecraft::export_
