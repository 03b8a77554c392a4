// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/summary.hpp"

#include <utility>

#include "base/sentence.hpp"

namespace ridgecraft::cli {

std::vector<std::string> repair_lines(const mesh::RepairReport& report, bool united) {
  std::vector<std::string> lines;
  for (const mesh::Repair& repair : report.entries()) {
    std::string line = mesh::sentence(repair.kind, repair.count);
    if (united && repair.kind == mesh::RepairKind::self_intersections) {
      line = counted(repair.count, "face") + " ran through others: uniting the bodies has mended that";
    }
    if (!repair.detail.empty()) {
      line += " (" + repair.detail + ")";
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string error_json(ExitCode code, const std::string& sentence) {
  return json_text(Value::Object{
             {"error", Value::Object{{"code", static_cast<int>(code)}, {"message", sentence}}}}) +
         "\n";
}

}  // namespace ridgecraft::cli
