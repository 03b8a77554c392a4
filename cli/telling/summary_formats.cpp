// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft formats tells.
#include <fmt/format.h>

#include "cli/files/formats.hpp"
#include "cli/telling/summary.hpp"

namespace ridgecraft::cli {
namespace {

std::string lines_of(const std::vector<FormatRow>& rows) {
  std::string text;
  for (const FormatRow& row : rows) {
    text += fmt::format("  {:<6} {}\n", row.suffix, row.what);
  }
  return text;
}

Value rows_of(const std::vector<FormatRow>& rows) {
  Value list(Value::List{});
  for (const FormatRow& row : rows) {
    list.add(Value::Object{{"suffix", row.suffix}, {"what", row.what}});
  }
  return list;
}

}  // namespace

std::string formats_text() {
  return "read:\n" + lines_of(read_formats()) + "written:\n" + lines_of(written_formats());
}

std::string formats_json() {
  return json_text(
             Value::Object{{"read", rows_of(read_formats())}, {"written", rows_of(written_formats())}}) +
         "\n";
}

}  // namespace ridgecraft::cli
