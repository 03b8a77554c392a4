// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of all formats are given, how they refuse it, and how they count what they ignore.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/context.hpp"
#include "base/error.hpp"
#include "mesh/model/soup.hpp"

namespace ridgecraft::mesh {

/// A texture coordinate beyond this many repetitions of the picture is taken for a mistake.
inline constexpr double largest_texture_coordinate = 1e4;
/// More corners of faces than this are refused (2^31): indices of corners are 32 bits wide.
inline constexpr std::uint64_t largest_corner_count = std::uint64_t{1} << 31U;

/// A file in memory.
struct Source {
  std::string_view bytes;
  std::string file;              ///< its name as messages print it
  std::filesystem::path folder;  ///< where its material files are looked for; empty for nowhere
  const Context& context;
  std::filesystem::path importer = {};  ///< as ReadOptions::importer

  /// Number of the line that a place in the bytes is on, from 1. Linear: for messages only.
  [[nodiscard]] std::size_t line(const char* place) const;
  /// Throws with "FILE REASON".
  [[noreturn]] void refuse(ErrorKind kind, std::string_view reason) const;
  /// Throws with "FILE, byte N: REASON", for binary files.
  [[noreturn]] void refuse_byte(ErrorKind kind, const char* place, std::string_view reason) const;
  /// Throws with "FILE, line N: REASON".
  [[noreturn]] void refuse_line(ErrorKind kind, const char* place, std::string_view reason) const;
};

/// Counts what a reader ignores and remembers where it was first, so that the line is worked out once only.
struct Tally {
  std::size_t count = 0;
  const char* first = nullptr;

  void add(const char* place) {
    if (count++ == 0) {
      first = place;
    }
  }
  void report(RepairKind kind, const Source& source, RepairReport& report) const;
};

/// Throws where a soup has more corners than can be numbered.
void check_corner_count(const Source& source, const Soup& soup);

/// Zero bytes and DOS end marks after a text belong to no mesh: the text without them; they are remarked on.
[[nodiscard]] std::string_view without_trailing_zeros(std::string_view text, RepairReport& remarks);

}  // namespace ridgecraft::mesh
