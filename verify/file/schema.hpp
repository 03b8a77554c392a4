// SPDX-License-Identifier: GPL-3.0-or-later
// The form of a file: bytes become JSON values, and one table says which keys there are, and what type, range
// and size their values have.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verify/file/file.hpp"

namespace ridgecraft::verify {

using Json = nlohmann::json;

/// Strict JSON in UTF-8, without a byte order mark, without a key twice in one object, no deeper than
/// max_json_depth. Throws NotInForm with the line and column of what is wrong.
[[nodiscard]] Json parse_json(std::string_view bytes);

template <typename... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) {
  throw NotInForm{fmt::format(text, std::forward<Args>(args)...)};
}

/// Texts from the file in messages: printable, quoted, not longer than a line can bear.
[[nodiscard]] std::string quote(std::string_view text);

/// Checks every key, type, length and index range of sections 1 to 3 of the contract, so that a reader needs
/// no checks of its own. Throws NotInForm with the first fault. Returns what is no fault of the form, but one
/// in files of this program: keys of our namespace that are unknown (the first 20) or missing. O(size).
[[nodiscard]] std::vector<std::string> check_form(const Json& file);

}  // namespace ridgecraft::verify
