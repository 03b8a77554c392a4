// SPDX-License-Identifier: GPL-3.0-or-later
// Values of options: from the text that was typed to a number that makes sense, or a refusal in one sentence.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ridgecraft::cli {

/// Throws Error(usage).
[[noreturn]] void refuse(const std::string& sentence);

/// Refuses an argument that wasn't given: `what` to do, and whose --help tells more.
void require(const std::string& value, const std::string& what, const std::string& verb);

/// Millimetres; above zero unless zero is allowed.
[[nodiscard]] double length_or_refuse(const std::string& option, const std::string& text,
                                      bool zero_allowed = false);

/// Millimetres in one unit; text that is empty means mm.
[[nodiscard]] double unit_or_refuse(const std::string& option, const std::string& text);

/// A number from low to high.
[[nodiscard]] double number_or_refuse(const std::string& option, const std::string& text, double low,
                                      double high);

/// The share that "5%" means; the percent sign may be left out. The limits are in percent.
[[nodiscard]] double percent_or_refuse(const std::string& option, const std::string& text, double low,
                                       double high);

/// Refuses a length in mm that was read already and is out of range; the sentence shows it as typed.
void require_range(const std::string& option, const std::string& text, double value, double low, double high,
                   const std::string& range);

[[nodiscard]] std::uint64_t whole_number_or_refuse(const std::string& option, const std::string& text,
                                                   std::uint64_t least);

/// Refuses a word that is none of those an option takes.
[[noreturn]] void refuse_choice(const std::string& option, const std::vector<std::string>& words,
                                const std::string& text);

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// What the word that was typed stands for; the first choice is the default, where it wasn't given.
template <class Value>
[[nodiscard]] Value choice_or_refuse(const std::string& option, const std::string& text,
                                     const Choices<Value>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) {
    if (text == word) {
      return value;
    }
    words.push_back(word);
  }
  if (!text.empty()) {
    refuse_choice(option, words, text);
  }
  return choices.front().second;
}

/// --concavity; the default where it wasn't given.
[[nodiscard]] double concavity_or_refuse(const std::string& text);

}  // namespace ridgecraft::cli
