// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/zip_archive.hpp"

#include <algorithm>
#include <new>
#include <optional>

#include <fmt/format.h>
#include <zlib.h>

#include "base/encodings.hpp"
#include "base/text.hpp"

namespace ridgecraft::mesh {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view file_mark = "PK\x03\x04"sv;
constexpr std::string_view entry_mark = "PK\x01\x02"sv;
constexpr std::string_view end_mark = "PK\x05\x06"sv;
constexpr std::string_view end64_mark = "PK\x06\x06"sv;
constexpr std::string_view locator64_mark = "PK\x06\x07"sv;
constexpr std::size_t file_header_size = 30;
constexpr std::size_t entry_size = 46;
constexpr std::size_t end_size = 22;
constexpr std::size_t locator64_size = 20;
constexpr std::size_t end64_size = 56;
constexpr std::size_t longest_comment = 65535;
constexpr std::uint16_t encrypted = 1;
constexpr std::uint16_t stored = 0;
constexpr std::uint16_t deflated = 8;
/// Deflate makes at most so many bytes of one.
constexpr std::uint64_t largest_expansion = 1032;
/// All that is unpacked together, 1 GiB: packed zeros would fill any memory.
constexpr std::uint64_t most_unpacked = std::uint64_t{1} << 30U;

/// Little-endian; the caller has looked that the bytes are there.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  return little_endian(bytes.substr(at, size));
}

std::string plain_name(std::string_view name) {
  std::string plain(name.substr(std::min(name.find_first_not_of("/\\"), name.size())));
  for (char& c : plain) {
    c = c == '\\' ? '/' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return plain;
}

/// 64-bit sizes stand in an extra field, in a fixed order, those alone whose place says "all ones".
void read_large_sizes(std::string_view extra, std::initializer_list<std::uint64_t*> values) {
  constexpr std::uint64_t kind64 = 1;
  constexpr std::uint64_t elsewhere = 0xffffffffU;
  while (extra.size() >= 4) {
    const std::uint64_t kind = number_at(extra, 0, 2);
    const std::uint64_t size = number_at(extra, 2, 2);
    extra.remove_prefix(4);
    if (size > extra.size()) {
      return;
    }
    std::string_view field = extra.substr(0, size);
    extra.remove_prefix(size);
    if (kind != kind64) {
      continue;
    }
    for (std::uint64_t* const value : values) {
      if (*value == elsewhere && field.size() >= 8) {
        *value = number_at(field, 0, 8);
        field.remove_prefix(8);
      }
    }
  }
}

/// The bytes of a deflate stream; nothing where it is damaged or has another size.
std::optional<std::string> inflated(std::string_view packed, std::uint64_t size) {
  std::string bytes(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) {
    throw std::bad_alloc();
  }
  // zlib counts in 32 bits and, by an old habit, takes no const.
  constexpr std::uint64_t most = 1U << 30U;
  int state = Z_OK;
  std::uint64_t in = 0;
  std::uint64_t out = 0;
  while (state == Z_OK) {
    const auto in_now = static_cast<uInt>(std::min<std::uint64_t>(most, packed.size() - in));
    const auto out_now = static_cast<uInt>(std::min<std::uint64_t>(most, size - out));
    // NOLINTNEXTLINE: see above
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data() + in));
    stream.avail_in = in_now;
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + out);
    stream.avail_out = out_now;
    state = inflate(&stream, Z_NO_FLUSH);
    in += in_now - stream.avail_in;
    out += out_now - stream.avail_out;
    if (state == Z_OK && in_now == stream.avail_in && out_now == stream.avail_out) {
      break;
    }
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END && out == size ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace

bool is_zip(std::string_view bytes) {
  return bytes.starts_with(file_mark) || bytes.starts_with(end_mark);
}

void ZipArchive::refuse_damaged(std::string_view what) const {
  source_.refuse(ErrorKind::unreadable_input, fmt::format("is cut off or damaged: {}", what));
}

ZipArchive::ZipArchive(const Source& source) : source_(source) {
  read_directory(find_directory());
}

ZipArchive::Directory ZipArchive::find_directory() const {
  const std::string_view bytes = source_.bytes;
  const std::size_t least = bytes.size() - std::min(bytes.size(), end_size + longest_comment);
  const std::size_t end = bytes.rfind(end_mark);
  if (end == bytes.npos || end < least || bytes.size() - end < end_size) {
    refuse_damaged("the ZIP archive that it should be has no directory at its end");
  }
  Directory directory{number_at(bytes, end + 16, 4), number_at(bytes, end + 12, 4)};
  const bool large = directory.at == 0xffffffffU || directory.size == 0xffffffffU ||
                     number_at(bytes, end + 10, 2) == 0xffffU;
  if (large && end >= locator64_size && bytes.substr(end - locator64_size, 4) == locator64_mark) {
    const std::uint64_t end64 = number_at(bytes, end - locator64_size + 8, 8);
    if (end64 <= bytes.size() && bytes.size() - end64 >= end64_size && bytes.substr(end64, 4) == end64_mark) {
      directory = {number_at(bytes, end64 + 48, 8), number_at(bytes, end64 + 40, 8)};
    }
  }
  if (directory.at > bytes.size() || directory.size > bytes.size() - directory.at) {
    refuse_damaged("the directory of its ZIP archive lies beyond its end");
  }
  return directory;
}

void ZipArchive::read_directory(Directory directory) {
  std::string_view rest = source_.bytes.substr(directory.at, directory.size);
  while (rest.size() >= entry_size && rest.starts_with(entry_mark)) {
    Entry entry{.flags = static_cast<std::uint16_t>(number_at(rest, 8, 2)),
                .method = static_cast<std::uint16_t>(number_at(rest, 10, 2)),
                .checksum = static_cast<std::uint32_t>(number_at(rest, 16, 4)),
                .packed = number_at(rest, 20, 4),
                .size = number_at(rest, 24, 4),
                .header = number_at(rest, 42, 4)};
    const std::size_t name = number_at(rest, 28, 2);
    const std::size_t extra = number_at(rest, 30, 2);
    const std::size_t comment = number_at(rest, 32, 2);
    if (rest.size() - entry_size < name + extra + comment) {
      refuse_damaged("the directory of its ZIP archive ends too early");
    }
    read_large_sizes(rest.substr(entry_size + name, extra), {&entry.size, &entry.packed, &entry.header});
    entries_.emplace(plain_name(rest.substr(entry_size, name)), entry);
    rest.remove_prefix(entry_size + name + extra + comment);
  }
  if (!rest.empty()) {
    refuse_damaged("the directory of its ZIP archive can't be read");
  }
}

bool ZipArchive::has(std::string_view name) const {
  return entries_.contains(plain_name(name));
}

std::string ZipArchive::first_ending_with(std::string_view ending) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const auto& entry) { return entry.first.ends_with(ending); });
  return found == entries_.end() ? std::string() : found->first;
}

std::string_view ZipArchive::packed_bytes(const std::string& name, const Entry& entry) const {
  const std::string_view bytes = source_.bytes;
  if (entry.header > bytes.size() || bytes.size() - entry.header < file_header_size ||
      bytes.substr(entry.header, 4) != file_mark) {
    refuse_damaged(fmt::format("its part {} isn't where the directory says", in_quotes(name)));
  }
  const std::uint64_t start = entry.header + file_header_size + number_at(bytes, entry.header + 26, 2) +
                              number_at(bytes, entry.header + 28, 2);
  if (start > bytes.size() || entry.packed > bytes.size() - start) {
    refuse_damaged(fmt::format("its part {} ends after the file", in_quotes(name)));
  }
  return bytes.substr(start, entry.packed);
}

std::string ZipArchive::read(std::string_view name, std::uint64_t most) {
  const auto found = entries_.find(plain_name(name));
  if (found == entries_.end()) {
    source_.refuse(ErrorKind::unreadable_input, fmt::format("has no part {}", in_quotes(name)));
  }
  const Entry& entry = found->second;
  const std::string_view packed = packed_bytes(found->first, entry);
  if ((entry.flags & encrypted) != 0 || (entry.method != stored && entry.method != deflated)) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("can't be unpacked: its part {} is {}", in_quotes(name),
                               (entry.flags & encrypted) != 0 ? "encrypted" : "packed in an unknown way"));
  }
  if (entry.size > most || unpacked_ + entry.size > most_unpacked) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is too large: its part {} has {} bytes", in_quotes(name), entry.size));
  }
  std::optional<std::string> bytes;
  if (entry.method == stored && entry.size == packed.size()) {
    bytes = std::string(packed);
  } else if (entry.method == deflated && entry.size <= largest_expansion * (packed.size() + 1)) {
    bytes = inflated(packed, entry.size);
  }
  if (!bytes || crc32_z(0, reinterpret_cast<const Bytef*>(bytes->data()), bytes->size()) != entry.checksum) {
    refuse_damaged(fmt::format("its part {} can't be unpacked", in_quotes(name)));
  }
  unpacked_ += entry.size;
  return std::move(*bytes);
}

}  // namespace ridgecraft::mesh
