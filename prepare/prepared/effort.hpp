// SPDX-License-Identifier: GPL-3.0-or-later
// How long a model takes to build: one formula, for a model before it is unfolded and for its nets. What is
// simplified, how large a model becomes, and what the guide says of time and difficulty all go by it.
#pragma once

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/rolls.hpp"

namespace ridgecraft::prepare {

/// A fold or a seam below this is made with tweezers, mm.
inline constexpr double tweezers_mm = 5.0;

/// What there is to do. Numbers before unfolding are expected ones, so they are no whole numbers.
struct Work {
  double pieces = 0.0;
  double folds = 0.0;        ///< that are drawn
  double joins = 0.0;        ///< edges to glue
  double seam_mm = 0.0;      ///< their length, each once
  double short_edges = 0.0;  ///< folds and joins below tweezers_mm
  double weak_joins = 0.0;   ///< joins whose tab is missing or too small to hold
  double weak_mm = 0.0;      ///< their length

  /// Share of the folds and joins that are short; 0 where there are none.
  [[nodiscard]] double short_share() const {
    return folds + joins > 0.0 ? short_edges / (folds + joins) : 0.0;
  }
  /// Share of the seams that hold badly; 0 where there are none.
  [[nodiscard]] double weak_share() const { return seam_mm > 0.0 ? weak_mm / seam_mm : 0.0; }
};

/// Minutes of somebody who has done it before.
[[nodiscard]] double minutes_of(const Work& work);

/// Of a surface that is still to be unfolded, `mm` being its unit; folds of less than `hidden_fold_angle`,
/// radians, are none, and what bends isn't folded. A straight fold between two panels must be one edge
/// (remesh_panels). O(n).
[[nodiscard]] Work expected_work(const mesh::Surface& surface, const Panels& panels, const Rolls& rolls,
                                 double hidden_fold_angle, double mm = 1.0);

/// What a person takes on.
struct Budget {
  double hours = 4.0;        ///< an evening
  double short_share = 0.1;  ///< of folds and joins that may be short
  double weak_share = 0.08;  ///< of the seams that may hold badly
};

/// What the work that is expected has to keep so that nets keep a budget: shares of a fifth less, since nets
/// have more short folds and weak seams than is expected as often as fewer.
[[nodiscard]] Budget aimed_at(const Budget& budget);

/// By what share work is above a budget, in the sum of all three; 0 where it keeps it.
[[nodiscard]] double excess(const Work& work, const Budget& budget);

}  // namespace ridgecraft::prepare
