// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/golden.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <catch2/catch.hpp>

#include "base/version.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft::test {
namespace {

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

/// Line `number` from 1 on, without its end, and no more of it than fits a log.
std::string_view line_of(std::string_view text, std::size_t number) {
  for (std::size_t i = 1; i < number; ++i) {
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return text.substr(0, std::min<std::size_t>(text.find('\n'), 200));
}

}  // namespace

void check_golden(const std::string& name, std::string text) {
  replace_all(text, program_and_version(), "ridgecraft VERSION");
  const std::filesystem::path file = std::filesystem::path(RIDGECRAFT_SOURCE_DIR) / "tests" / "golden" / name;
  if (const char* update = std::getenv("RIDGECRAFT_UPDATE_GOLDEN"); update != nullptr && *update == '1') {
    std::filesystem::create_directories(file.parent_path());
    write_bytes(file, text);
  }
  INFO("compare with " << file << "; RIDGECRAFT_UPDATE_GOLDEN=1 writes it anew");
  const std::string golden = std::filesystem::exists(file) ? read_bytes(file) : "";
  const auto differ = std::mismatch(golden.begin(), golden.end(), text.begin(), text.end());
  const auto line = static_cast<std::size_t>(std::count(golden.begin(), differ.first, '\n')) + 1;
  INFO("line " << line << " was: " << line_of(golden, line));
  INFO("line " << line << " is:  " << line_of(text, line));
  // Not CHECK(a == b): a page's text in the log helps nobody.
  const bool same = golden == text;
  CHECK(same);
}

}  // namespace ridgecraft::test
