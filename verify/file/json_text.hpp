// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes become JSON values, or a reason why they can't.
#pragma once

#include <string>
#include <string_view>
#include <utility>

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

}  // namespace ridgecraft::verify
