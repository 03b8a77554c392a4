// SPDX-License-Identifier: GPL-3.0-or-later
// Content in files of text: JSON, XML, bytes as letters; and a short name for many bytes.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/vector.hpp"

namespace ridgecraft {

// Bytes as letters, for files inside text.

/// RFC 4648, with padding. O(n).
[[nodiscard]] std::string base64(std::string_view bytes);

/// The number that up to eight bytes make, the lowest first, on any machine.
[[nodiscard]] constexpr std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  return value;
}

// Text inside XML documents (SVG, URDF).

/// The text with &, <, > and double quotes as entities, fit for content and attributes. The bytes are
/// otherwise taken as they are: valid UTF-8 without control characters is the caller's duty
/// (base/text.hpp). O(n).
[[nodiscard]] std::string xml_escaped(std::string_view text);

// A short name for many bytes.

/// 16 hexadecimal digits that stand for these bytes: a 64-bit hash, the same on every machine. Not
/// cryptographic.
[[nodiscard]] std::string digest(std::string_view bytes);

// Writes JSON a person can read: one key a line, long lists wrapped. Made for large arrays of numbers, which
// a document tree in memory would make ten times as slow.

/// Text in quotes, with what JSON wants escaped; bytes that aren't UTF-8 become U+FFFD.
[[nodiscard]] std::string json_string(std::string_view text);

/// Appends values to one text. The caller opens, closes and separates; item() sets the commas.
class JsonText {
 public:
  /// Shortest text that reads back as the same double. Zero has no sign. `value` is finite.
  void number(double value);
  template <std::integral Int>
  void number(Int value) {
    text_ += std::to_string(value);
  }
  void string(std::string_view value) { text_ += json_string(value); }
  void raw(std::string_view value) { text_ += value; }
  void point(Vec2 p);
  void point(Vec3 p);

  /// Begins a key of an object: a line of its own, behind a comma except after `{`.
  void key(std::string_view name);
  /// "name": [ item, item, ... ] with `write(i)` for each of `count` items.
  template <class Write>
  void list(std::string_view name, std::size_t count, Write write) {
    key(name);
    text_ += '[';
    std::size_t line = text_.size();
    for (std::size_t i = 0; i < count; ++i) {
      text_ += i == 0 ? "" : ",";
      // A list of one line stays on the line of its key.
      if (text_.size() - line > line_length) {
        text_ += '\n';
        line = text_.size();
      }
      write(i);
    }
    text_ += ']';
  }

  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  static constexpr std::size_t line_length = 100;
  std::string text_;
};

}  // namespace ridgecraft
