// SPDX-License-Identifier: GPL-3.0-or-later
// Files of words, line by line, with comments.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace ridgecraft::cli {

/// The words of a line, between spaces, tabs and commas; what follows a # says nothing.
[[nodiscard]] inline std::vector<std::string_view> words_of_line(std::string_view line) {
  constexpr std::string_view space = " \t\r,";
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t begin = line.find_first_not_of(space); begin != std::string_view::npos;
       begin = line.find_first_not_of(space)) {
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(space)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

/// Calls visit(words, number) for each line that has words; lines are counted from 1.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (const std::vector<std::string_view> words = words_of_line(text.substr(0, end)); !words.empty()) {
      visit(words, number);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace ridgecraft::cli
