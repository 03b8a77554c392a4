// SPDX-License-Identifier: GPL-3.0-or-later
// The manual as data: --help and the man page are two renderings of one text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::cli {

struct ManualEntry {
  std::string term;  ///< "--size LENGTH"
  std::string text;  ///< one or two sentences
};

struct ManualSection {
  std::string title;  ///< "Size"
  std::vector<ManualEntry> entries;
};

struct Manual {
  std::string name;     ///< "ridgecraft" or "ridgecraft segment"
  std::string purpose;  ///< one line
  std::vector<std::string> usage;
  std::vector<ManualEntry> examples;  ///< command, what it does
  std::vector<ManualSection> sections;
};

/// What --help prints, at most 100 columns wide.
[[nodiscard]] std::string help_text(const Manual& manual);

/// A man page (section 1) of the program and its verbs.
[[nodiscard]] std::string man_page(const Manual& program, const std::vector<Manual>& verbs,
                                   std::string_view version);

}  // namespace ridgecraft::cli
