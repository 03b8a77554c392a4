// SPDX-License-Identifier: GPL-3.0-or-later
// The figures cut_mm and fold_mm: the knife goes round each tab instead of along its base, which is folded;
// and how much of the folds is so flat that pages have no line for it.
#include <cmath>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/relations/model_fold.hpp"

namespace ridgecraft::verify {

namespace {

/// Far enough to have a line: what stands on a face rises from it.
constexpr double foot_angle_deg = -90.0;

/// How far the base of a tab is folded when its seam is closed, degrees; 0 where the file doesn't tell.
double angle_at_base(const Case& given, const Tab& tab) {
  if (tab.foot) {
    return foot_angle_deg;
  }
  const Index side = model_side_of(given.file, given.relations, tab.edge);
  return side != none && given.file.model.twin[side] != none
             ? model_fold(given.file, given.relations, side).angle_deg
             : 0.0;
}

}  // namespace

void measure_cuts(const Case& given, Findings& findings) {
  const File& file = given.file;
  double& cut = findings.figures().cut_mm;
  double& fold = findings.figures().fold_mm;
  double& unlined = findings.figures().unlined_fold_mm;
  const double hidden_deg = file.settings.number("hide_folds_deg").value_or(default_hidden_deg);
  for (const Edge& edge : file.edges) {
    const double size = length(file.points[edge.ends[1]] - file.points[edge.ends[0]]);
    if (edge.assignment == Assignment::cut) {
      cut += size;
    } else if (edge.assignment != Assignment::flat) {
      fold += size;
      unlined += std::abs(edge.angle_deg) < hidden_deg ? size : 0.0;
    }
  }
  for (const Tab& tab : file.tabs) {
    const double base = length(tab.polygon[1] - tab.polygon[0]);
    fold += base;
    unlined += std::abs(angle_at_base(given, tab)) < hidden_deg ? base : 0.0;
    cut -= base;
    cut += tab.slit ? length((*tab.slit)[1] - (*tab.slit)[0]) : 0.0;
    for (std::size_t k = 1; k < tab.polygon.size(); ++k) {
      cut += length(tab.polygon[(k + 1) % tab.polygon.size()] - tab.polygon[k]);
    }
  }
}

}  // namespace ridgecraft::verify
