// SPDX-License-Identifier: GPL-3.0-or-later
// What JSON can say, as a value. Keeps the JSON library, which is slow to compile, out of headers.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ridgecraft::cli {

class Value {
 public:
  struct Member;
  using List = std::vector<Value>;
  using Object = std::vector<Member>;  ///< in the order in which they are printed

  // An object can only be made or given up where Member is known: after this class.
  /// null
  Value();
  Value(bool value);
  template <std::integral Number>
  requires(!std::same_as<Number, bool>) Value(Number value);
  Value(double value);
  Value(std::string value);
  Value(std::string_view value);
  Value(const char* value);
  Value(List value);
  Value(Object value);
  /// null where there is none.
  template <class T>
  Value(const std::optional<T>& value);

  /// Appends to a list, which null becomes.
  void add(Value value);
  /// Appends a member to an object, which null becomes. A key may be set once.
  void set(std::string key, Value value);

  using Held =
      std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, List, Object>;
  [[nodiscard]] const Held& held() const { return held_; }

 private:
  Held held_;
};

struct Value::Member {
  std::string key;
  Value value;
};

inline Value::Value() = default;
inline Value::Value(bool value) : held_(value) {}
template <std::integral Number>
requires(!std::same_as<Number, bool>) Value::Value(Number value) {
  if constexpr (std::unsigned_integral<Number>) {
    held_ = static_cast<std::uint64_t>(value);
  } else {
    held_ = static_cast<std::int64_t>(value);
  }
}
inline Value::Value(double value) : held_(value) {}
inline Value::Value(std::string value) : held_(std::move(value)) {}
inline Value::Value(std::string_view value) : held_(std::string(value)) {}
inline Value::Value(const char* value) : held_(std::string(value)) {}
inline Value::Value(List value) : held_(std::move(value)) {}
template <class T>
Value::Value(const std::optional<T>& value) : Value(value ? Value(*value) : Value()) {}

/// The texts as a list.
[[nodiscard]] Value list_of(const std::vector<std::string>& texts);

/// Rounded to a thousandth, so that JSON shows no noise.
[[nodiscard]] Value rounded(double value);

/// True for the whole text of one JSON value, of any kind. O(length), but it ends at the first mistake.
[[nodiscard]] bool is_json(std::string_view text);

/// JSON of several lines with an indent of two; bytes that aren't UTF-8 become U+FFFD.
[[nodiscard]] std::string json_text(const Value& value);
/// The same in one line.
[[nodiscard]] std::string json_line(const Value& value);

}  // namespace ridgecraft::cli
