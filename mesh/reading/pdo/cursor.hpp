// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through the bytes of a PDO file: numbers, counts and strings, each held against what is left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// How a file writes its strings.
struct PdoStrings {
  bool wide = false;            ///< two bytes a character (UTF-16), else one
  std::size_t length_size = 1;  ///< bytes that one unit of a string's length stands for
  std::uint32_t shift = 0;      ///< was added to each character
};

class PdoCursor {
 public:
  explicit PdoCursor(const Source& source) : source_(source) {}

  PdoStrings strings;

  /// Bytes read so far.
  [[nodiscard]] std::size_t at() const { return at_; }

  /// What messages call the place from here on, such as "object 2".
  void enter(std::string place) { place_ = std::move(place); }

  [[nodiscard]] std::uint8_t byte();
  [[nodiscard]] std::uint32_t whole();
  /// The same with a sign.
  [[nodiscard]] std::int32_t number();
  [[nodiscard]] double real();        ///< of eight bytes
  [[nodiscard]] double short_real();  ///< of four bytes
  void skip(std::size_t size) { (void)bytes(size); }
  [[nodiscard]] std::string_view bytes(std::size_t size);
  /// A number of things that take so many bytes each, or more: refused where they can't be there.
  [[nodiscard]] std::size_t count(std::size_t least_size, std::string_view things);
  void skip_string() { (void)raw_string(); }
  /// Printable UTF-8; empty for what can't be told without a table of a country's letters.
  [[nodiscard]] std::string string();

  [[noreturn]] void refuse(std::string_view reason, ErrorKind kind = ErrorKind::unreadable_input) const;

 private:
  [[nodiscard]] std::string_view raw_string();
  [[nodiscard]] std::uint64_t little_endian(std::size_t size);

  const Source& source_;
  std::size_t at_ = 0;
  std::string place_ = "its header";
};

}  // namespace ridgecraft::mesh
