// SPDX-License-Identifier: GPL-3.0-or-later
// The output of bench_tabs: two tables on standard output, one for nets in one piece and one for pieces that
// were split, and the same rows as JSON.
#pragma once

#include <string>
#include <vector>

#include "bench/tab_figures.hpp"

namespace ridgecraft::bench {

struct TabRow {
  std::string name;   ///< number of faces, or the model
  std::string rule;   ///< "strict", "weak"
  std::string phase;  ///< "off", "on", "split"
  TabFigures figures;
  std::vector<double> seconds;
};

/// The head of the table in which rows of this phase stand.
void print_head(const std::string& phase);
void print(const TabRow& row);

/// Throws Error(cant_write).
void write_json(const std::string& path, const std::vector<TabRow>& rows);

}  // namespace ridgecraft::bench
