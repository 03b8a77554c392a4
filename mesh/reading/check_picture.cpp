// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/check_picture.hpp"

#include <cstddef>

namespace ridgecraft::mesh {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::string_view jpeg_signature = "\xff\xd8\xff"sv;

std::size_t big_endian(std::string_view bytes, std::size_t at, std::size_t length) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < length; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

/// Walks over the chunks (length, type, data, checksum) up to IEND.
bool png_is_whole(std::string_view bytes) {
  std::size_t at = png_signature.size();
  bool has_data = false;
  while (bytes.size() - at >= 12) {
    const std::size_t length = big_endian(bytes, at, 4);
    const std::string_view type = bytes.substr(at + 4, 4);
    if (length > bytes.size() - at - 12) {
      return false;
    }
    if (type == "IEND") {
      return has_data;
    }
    has_data = has_data || type == "IDAT";
    at += length + 12;
  }
  return false;
}

/// Walks over the segments up to the start of scan, so that a thumbnail's end mark isn't taken for the
/// picture's.
bool jpeg_is_whole(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (bytes[at] != '\xff') {
      return false;
    }
    if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;  // a fill byte, or a mark without content
      continue;
    }
    at += 2 + big_endian(bytes, at + 2, 2);
    if (marker == 0xda) {
      return bytes.find("\xff\xd9"sv, at) != bytes.npos;
    }
  }
  return false;
}

}  // namespace

std::string picture_fault(std::string_view bytes) {
  if (bytes.empty()) {
    return "is empty";
  }
  const bool png = bytes.starts_with(png_signature);
  if (!png && !bytes.starts_with(jpeg_signature)) {
    return "is no PNG or JPEG picture";
  }
  return (png ? png_is_whole(bytes) : jpeg_is_whole(bytes)) ? "" : "is cut off or damaged";
}

}  // namespace ridgecraft::mesh
