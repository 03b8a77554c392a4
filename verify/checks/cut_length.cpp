// SPDX-License-Identifier: GPL-3.0-or-later
// The figures cut_mm and fold_mm: the knife goes round each tab instead of along its base, which is folded.
#include "verify/checks/checks.hpp"

namespace ridgecraft::verify {

void measure_cuts(const Case& given, Findings& findings) {
  const File& file = given.file;
  double& cut = findings.figures().cut_mm;
  double& fold = findings.figures().fold_mm;
  for (const Edge& edge : file.edges) {
    const double size = length(file.points[edge.ends[1]] - file.points[edge.ends[0]]);
    if (edge.assignment == Assignment::cut) {
      cut += size;
    } else if (edge.assignment != Assignment::flat) {
      fold += size;
    }
  }
  for (const Tab& tab : file.tabs) {
    const double base = length(tab.polygon[1] - tab.polygon[0]);
    fold += base;
    cut -= base;
    for (std::size_t k = 1; k < tab.polygon.size(); ++k) {
      cut += length(tab.polygon[(k + 1) % tab.polygon.size()] - tab.polygon[k]);
    }
  }
}

}  // namespace ridgecraft::verify
