// SPDX-License-Identifier: GPL-3.0-or-later
// The files in a ZIP archive (PKWARE's APPNOTE), stored or deflated, also with 64-bit sizes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// True for bytes that begin as archives do.
[[nodiscard]] bool is_zip(std::string_view bytes);

class ZipArchive {
 public:
  /// Reads the directory. The source must outlive it. Throws Error(unreadable_input) where it is cut off.
  explicit ZipArchive(const Source& source);

  /// Names as packages know them: without a slash at the start, letters of either case alike.
  [[nodiscard]] bool has(std::string_view name) const;
  /// The first file, in alphabetical order, whose name ends so; empty where there is none.
  [[nodiscard]] std::string first_ending_with(std::string_view ending) const;
  /// The bytes of a file, unpacked and held against their checksum. Refuses one that isn't there, that is
  /// damaged, or that has more than `most` bytes.
  [[nodiscard]] std::string read(std::string_view name, std::uint64_t most);
  /// Bytes unpacked so far.
  [[nodiscard]] std::uint64_t unpacked() const { return unpacked_; }

 private:
  struct Entry {
    std::uint16_t flags = 0;
    std::uint16_t method = 0;
    std::uint32_t checksum = 0;
    std::uint64_t packed = 0;
    std::uint64_t size = 0;
    std::uint64_t header = 0;  ///< where its own header is
  };
  /// Where the directory begins, and how many bytes it has.
  struct Directory {
    std::uint64_t at = 0;
    std::uint64_t size = 0;
  };

  [[nodiscard]] Directory find_directory() const;
  void read_directory(Directory directory);
  [[nodiscard]] std::string_view packed_bytes(const std::string& name, const Entry& entry) const;
  [[noreturn]] void refuse_damaged(std::string_view what) const;

  const Source& source_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::uint64_t unpacked_ = 0;
};

}  // namespace ridgecraft::mesh
