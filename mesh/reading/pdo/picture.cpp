// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/pdo/picture.hpp"

#include <new>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

namespace ridgecraft::mesh {
namespace {

constexpr std::uint64_t picture_channels = 3;
/// No deflate stream unpacks to more than this many times its size.
constexpr std::uint64_t largest_picture_expansion = 1032;

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24U & 0xffU), static_cast<char>(value >> 16U & 0xffU),
          static_cast<char>(value >> 8U & 0xffU), static_cast<char>(value & 0xffU)};
}

void add_chunk(std::string& png, std::string_view kind, std::string_view content) {
  png += big_endian(static_cast<std::uint32_t>(content.size()));
  const std::size_t from = png.size();
  png += kind;
  png += content;
  png += big_endian(static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(png.data() + from), png.size() - from)));
}

/// Rows as PNG has them: a zero byte (nothing predicted) in front of each. Empty where the packed bytes are
/// damaged or don't hold just these pixels.
std::string unpacked_rows(const PdoPicture& picture) {
  const std::uint64_t row = picture.width * picture_channels;
  std::string rows((row + 1) * picture.height, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) {
    throw std::bad_alloc();
  }
  // zlib takes no const, by an old habit.
  // NOLINTNEXTLINE: see above
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(picture.packed.data()));
  stream.avail_in = static_cast<uInt>(picture.packed.size());
  int state = Z_OK;
  bool whole = true;
  for (std::uint32_t y = 0; whole && y < picture.height; ++y) {
    stream.next_out = reinterpret_cast<Bytef*>(rows.data() + y * (row + 1) + 1);
    stream.avail_out = static_cast<uInt>(row);
    state = state == Z_OK ? inflate(&stream, Z_NO_FLUSH) : Z_DATA_ERROR;
    whole = (state == Z_OK || state == Z_STREAM_END) && stream.avail_out == 0;
  }
  if (whole && state == Z_OK) {
    // The stream's end has no pixels, but a checksum.
    Bytef more = 0;
    stream.next_out = &more;
    stream.avail_out = 1;
    state = inflate(&stream, Z_FINISH);
    whole = state == Z_STREAM_END && stream.avail_out == 1;
  }
  inflateEnd(&stream);
  return whole ? rows : std::string();
}

std::string packed_again(const std::string& rows) {
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                static_cast<uLong>(rows.size()), Z_BEST_SPEED) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return packed;
}

}  // namespace

PdoPng png_of(const PdoPicture& picture) {
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  if (pixels == 0) {
    return {{}, "is empty"};
  }
  // Rows are counted with the byte in front of them, too.
  if (pixels > largest_pdo_picture / picture_channels ||
      picture.height > largest_pdo_picture / picture_channels) {
    return {{}, fmt::format("is too large: {} x {} pixels", picture.width, picture.height)};
  }
  const std::string rows =
      pixels * picture_channels <= largest_picture_expansion * (picture.packed.size() + 1)
          ? unpacked_rows(picture)
          : std::string();
  if (rows.empty()) {
    return {{}, fmt::format("is damaged, or has other than {} x {} pixels", picture.width, picture.height)};
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  // Eight bits a channel, red, green and blue.
  add_chunk(png, "IHDR",
            big_endian(picture.width) + big_endian(picture.height) + std::string("\x08\x02\0\0\0", 5));
  add_chunk(png, "IDAT", packed_again(rows));
  add_chunk(png, "IEND", {});
  return {png, {}};
}

}  // namespace ridgecraft::mesh
