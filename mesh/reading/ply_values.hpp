// SPDX-License-Identifier: GPL-3.0-or-later
// The body of a PLY file as a row of numbers, whichever way they are written.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "base/text_between.hpp"
#include "mesh/reading/ply_header.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {

/// Reads value after value. Each call refuses a file that ends or can't be read there.
class PlyValues {
 public:
  PlyValues(const Source& source, PlyEncoding encoding, std::string_view body)
      : source_(source),
        encoding_(encoding),
        text_(body),
        at_(body.data()),
        end_(body.data() + body.size()) {}

  /// Which element the next values are of, for messages.
  void begin_row(const PlyElement& element, std::int64_t number) {
    element_ = &element;
    number_ = number;
  }

  [[nodiscard]] double number(PlyType type);
  [[nodiscard]] std::int64_t integer(PlyType type);
  /// Length of a list; not more than the bytes that are left can hold.
  [[nodiscard]] std::int64_t list_length(const PlyProperty& property);
  void skip(PlyType type);
  void skip(const PlyProperty& property);

  /// True where the bytes that are left are too few for this many elements.
  [[nodiscard]] bool too_few_for(const PlyElement& element) const;
  [[nodiscard]] std::string_view rest() const {
    return encoding_ == PlyEncoding::ascii ? text_.rest() : text_between(at_, end_);
  }
  /// Refuses the file because of the current element.
  [[noreturn]] void refuse(ErrorKind kind, std::string_view reason) const;

 private:
  /// Takes the bytes of a value as an unsigned number.
  [[nodiscard]] std::uint64_t take(PlyType type);
  [[nodiscard]] std::int64_t take_integer(PlyType type);
  [[noreturn]] void refuse_end() const;
  [[noreturn]] void refuse_word() const;

  const Source& source_;
  PlyEncoding encoding_;
  TextScanner text_;  // of ASCII files
  const char* at_;    // of binary files
  const char* end_;
  const PlyElement* element_ = nullptr;
  std::int64_t number_ = 0;
};

}  // namespace ridgecraft::mesh
