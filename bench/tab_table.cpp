// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/tab_table.hpp"

#include <cstdio>
#include <fstream>

#include "base/error.hpp"

namespace ridgecraft::bench {
namespace {

void print_split_row(const TabRow& row) {
  const TabFigures& r = row.figures;
  std::printf(
      "%-7s %-6s %-6s %6.0f %7.0f %7.2f %5.0f %7.1f %8.2f%% %5.0f %8.1f%% %8.1f%% %8.1f%% %6.0f %9.3f "
      "%8.3f\n",
      row.name.c_str(), row.rule.c_str(), row.phase.c_str(), r.models, r.pieces_in_all, r.pieces - 1.0,
      r.most_more, r.cuts, 100.0 * r.of_wide, r.left, 100.0 * r.of_able, 100.0 * r.usable_long,
      100.0 * r.usable, r.collisions, quantile(row.seconds, 0.5), quantile(row.seconds, 0.9));
}

void print_whole_row(const TabRow& row) {
  const TabFigures& r = row.figures;
  std::printf(
      "%-7s %-6s %-6s %6.0f %7.2f %7.1f %7.1f%% %7.1f%% %7.2f%% %8.1f%% %8.1f%% %6.1f%% %6.0f %9.3f %8.3f\n",
      row.name.c_str(), row.rule.c_str(), row.phase.c_str(), r.models, r.pieces, r.cuts, 100.0 * r.usable,
      100.0 * r.any, 100.0 * r.of_wide, 100.0 * r.of_bound, 100.0 * r.usable_long, 100.0 * r.of_long_bound,
      r.collisions, quantile(row.seconds, 0.5), quantile(row.seconds, 0.9));
}

}  // namespace

void print_head(const std::string& phase) {
  if (phase == "split") {
    std::printf("%-7s %-6s %-6s %6s %7s %7s %5s %7s %9s %5s %9s %9s %9s %6s %9s %8s\n", "faces", "rule",
                "phase", "models", "pieces", "more", "most", "cuts", "of wide", "left", "of able", "over 8mm",
                "usable", "colls", "median s", "90 % s");
    return;
  }
  std::printf("%-7s %-6s %-6s %6s %7s %7s %8s %8s %8s %9s %9s %7s %6s %9s %8s\n", "faces", "rule", "phase",
              "models", "pieces", "cuts", "usable", "any tab", "of wide", "of bound", "over 8mm", "of bnd",
              "colls", "median s", "90 % s");
}

void print(const TabRow& row) {
  if (row.phase == "split") {
    print_split_row(row);
  } else {
    print_whole_row(row);
  }
  std::fflush(stdout);
}

void write_json(const std::string& path, const std::vector<TabRow>& rows) {
  std::ofstream out(path);
  out << "[";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TabRow& row = rows[i];
    out << (i > 0 ? ",\n" : "\n") << R"({"name": ")" << row.name << R"(", "rule": ")" << row.rule
        << R"(", "phase": ")" << row.phase << '"';
    for (const auto& [name, value] : tab_figures()) {
      out << ", \"" << name << "\": " << row.figures.*value;
    }
    out << R"(, "median_s": )" << quantile(row.seconds, 0.5) << R"(, "p90_s": )" << quantile(row.seconds, 0.9)
        << "}";
  }
  out << "\n]\n";
  if (!out.flush()) {
    throw Error(ErrorKind::cant_write, "can't write " + path);
  }
}

}  // namespace ridgecraft::bench
