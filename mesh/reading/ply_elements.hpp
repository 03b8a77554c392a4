// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a PLY file (Greg Turk, "The PLY Polygon File Format", 1994): which follow, what their
// properties mean, and their values.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
[[nodiscard]] constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_integer(PlyType type) {
  return type < PlyType::float32;
}

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType length_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string_view name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string_view> pictures;  ///< of "comment TextureFile NAME" lines, as MeshLab writes them
  std::string_view body;                   ///< the bytes after the header
};

/// Throws Error(unreadable_input). The counts are what the header says; nothing is known of whether they are
/// true.
[[nodiscard]] PlyHeader read_ply_header(const Source& source);

// What the properties of a PLY element mean to us, by the names that programs give them.

enum class PlyKind { vertex, face, edge };

enum class PlyRole {
  skipped,
  // Of a point.
  x,
  y,
  z,
  u,
  v,
  // Of a point or a face.
  red,
  green,
  blue,
  // Of a face.
  indices,
  texture_list,
  texture_number,
  // Of an edge: the numbers of two points.
  first_end,
  second_end,
};

using PlyRoles = std::vector<PlyRole>;

/// The role of each property of the element. Of two properties of one meaning the first has it; what isn't
/// known, or names points by numbers that aren't integers where an edge does, is skipped.
[[nodiscard]] PlyRoles ply_roles(const PlyElement& element, PlyKind kind);

[[nodiscard]] inline bool has(const PlyRoles& roles, PlyRole role) {
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

// The body of a PLY file as a row of numbers, whichever way they are written.

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
