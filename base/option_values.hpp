// SPDX-License-Identifier: GPL-3.0-or-later
// Values of options: from the text that was typed to a number that makes sense, or a refusal.
// Functions named ..._or_refuse throw Error(usage).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/message.hpp"

namespace ridgecraft {

/// Throw Error(usage).
[[noreturn]] void refuse(const Message& message);
[[noreturn]] void refuse(const std::string& sentence);

/// Millimetres of "150mm", "15cm", "0.15m", "6in", "6\"", "2ft"; a number alone is mm. Nothing when the text
/// isn't a finite length above zero.
[[nodiscard]] std::optional<double> parse_length_mm(std::string_view text);

/// The factor of "1:50", "2:1", "0.5", "30%"; nothing when it isn't finite and above zero.
[[nodiscard]] std::optional<double> parse_scale(std::string_view text);

/// Millimetres from low to high.
[[nodiscard]] double length_or_refuse(const std::string& option, const std::string& text, double low,
                                      double high);

/// Millimetres in one unit; text that is empty means mm.
[[nodiscard]] double unit_or_refuse(const std::string& option, const std::string& text);

/// A number from low to high.
[[nodiscard]] double number_or_refuse(const std::string& option, const std::string& text, double low,
                                      double high);

/// The share that "5%" means; the percent sign may be left out. The limits are in percent.
[[nodiscard]] double percent_or_refuse(const std::string& option, const std::string& text, double low,
                                       double high);

[[nodiscard]] std::uint64_t whole_number_or_refuse(
    const std::string& option, const std::string& text, std::uint64_t least,
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Which of these words the text is.
[[nodiscard]] std::size_t word_or_refuse(const std::string& option, const std::string& text,
                                         const std::vector<std::string>& words);

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// What the word that was typed stands for; the first choice is the default, where it wasn't given.
template <class Value>
[[nodiscard]] Value choice_or_refuse(const std::string& option, const std::string& text,
                                     const Choices<Value>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) {
    words.push_back(word);
  }
  return choices[text.empty() ? 0 : word_or_refuse(option, text, words)].second;
}

}  // namespace ridgecraft
