// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes become JSON values, and values become numbers and lists: each step refuses what isn't what it should
// be.
#pragma once

#include <cstdint>
#include <span>
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

/// The member of an object that must be there; `where` names the object in the message.
[[nodiscard]] const Json& member(const Json& object, const char* key, std::string_view where);
/// The same for a member that must be a list, an object or a text.
[[nodiscard]] const Json& list_member(const Json& object, const char* key, std::string_view where);
[[nodiscard]] const std::string& text_member(const Json& object, const char* key, std::string_view where);

/// A place in the file, put into words only when a message needs them: entry `index` of the list `name` of
/// `owner`, or its member `name`.
struct Spot {
  std::string_view owner;
  std::string_view name;
  std::size_t index = std::string_view::npos;

  [[nodiscard]] std::string words() const;
};

/// A whole number (written without point and exponent) within the limits, both included.
[[nodiscard]] std::int64_t whole(const Json& value, std::int64_t low, std::int64_t high, const Spot& spot);
/// An index below count.
[[nodiscard]] Index index_below(const Json& value, std::size_t count, const Spot& spot);
/// A length or angle: finite, not above the limit in size.
[[nodiscard]] double number(const Json& value, double limit, const Spot& spot);
/// A list of just so many lengths.
void lengths(const Json& value, std::span<double> result, const Spot& spot);

/// Texts from the file in messages: printable, quoted, not longer than a line can bear.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace ridgecraft::verify
