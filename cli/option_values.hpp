// SPDX-License-Identifier: GPL-3.0-or-later
// Values of options: from the text that was typed to a number that makes sense, or a refusal in one sentence.
#pragma once

#include <cstdint>
#include <string>

namespace ridgecraft::cli {

/// Throws Error(usage).
[[noreturn]] void refuse(const std::string& sentence);

/// Refuses an argument that wasn't given: `what` to do, and whose --help tells more.
void require(const std::string& value, const std::string& what, const std::string& verb);

/// Millimetres; above zero unless zero is allowed.
[[nodiscard]] double length_or_refuse(const std::string& option, const std::string& text,
                                      bool zero_allowed = false);

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

/// --concavity; the default where it wasn't given.
[[nodiscard]] double concavity_or_refuse(const std::string& text);

}  // namespace ridgecraft::cli
