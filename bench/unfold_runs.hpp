// SPDX-License-Identifier: GPL-3.0-or-later
// Timed searches for one net, and an independent check of what they call solved.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::bench {

struct Runs {
  int seeds = 3;
  bool check = false;
  double limit = 0.0;  ///< seconds by the wall clock; 0: none
};

/// All runs of one row of the table.
struct Row {
  std::string name;
  std::size_t faces = 0;
  std::size_t solved = 0;
  std::size_t checked = 0;
  std::size_t false_successes = 0;
  std::vector<double> seconds;
  std::vector<double> iterations;
  std::vector<std::size_t> pieces_left;  ///< per run that wasn't solved: the fewest pieces that were found
};

[[nodiscard]] std::vector<FaceId> all_faces(const mesh::Surface& surface);

/// Searches a net of these faces with seeds 1 .. runs.seeds, panels loose, as long as the program does, and
/// adds the runs to the row.
void run(const mesh::Surface& surface, std::span<const FaceId> faces, const Runs& runs, Row& row);

void add(const Row& from, Row& to);

/// The value below which this share of the values lies; 0 when there are none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// Is this a net of the patch? One tree over all faces, each congruent to itself, and no pair of faces deeper
/// in each other than the tolerance: every pair, by exact rational arithmetic. Shares nothing with the search
/// but the patch's twins.
[[nodiscard]] bool is_net(const mesh::Surface& surface, const unfold::Patch& patch,
                          const unfold::Folds& folds, double tolerance);

}  // namespace ridgecraft::bench
