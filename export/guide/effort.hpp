// SPDX-License-Identifier: GPL-3.0-or-later
// How long it takes to build a model and how hard it is. docs/design/building-guide.md has the formula.
#pragma once

#include <cstddef>
#include <string>

#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// How long a model takes to build, how hard it is, and the figures that tell.
struct Effort {
  double seam_mm = 0.0;  ///< of all joins, each once
  std::size_t joins = 0;
  std::size_t folds = 0;         ///< edges that are folded along a line
  double median_join_mm = 0.0;   ///< length of the joins: half are shorter
  double smallest_tab_mm = 0.0;  ///< length of the shortest edge with a tab; 0 where there is none
  double minutes = 0.0;          ///< of somebody who has done it before
  int difficulty = 1;            ///< 1 to 5
};

/// O(edges log edges).
[[nodiscard]] Effort effort_of(const prepare::Prepared& model, const unfold::Nets& nets,
                               double hidden_fold_angle);

/// "about 40 minutes", "about 3.5 hours", "about 12 hours".
[[nodiscard]] std::string duration_words(double minutes);
/// "very easy", "easy", "moderate", "hard", "very hard".
[[nodiscard]] std::string difficulty_words(int difficulty);

/// "120 to 160 g/m²": what paper suits a model of this largest extent, mm, and of joins of this length.
[[nodiscard]] std::string paper_weight(double extent_mm, double median_join_mm);

}  // namespace ridgecraft::export_
