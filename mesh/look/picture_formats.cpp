// SPDX-License-Identifier: GPL-3.0-or-later
// Which format a picture is in, and the formats that are seldom: TGA, BMP and GIF by stb_image, WebP by
// libwebp, TIFF by libtiff. Of moving pictures the first counts.
#include <algorithm>
#include <array>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

#include "mesh/look/picture.hpp"

// NOLINTBEGIN(readability-identifier-naming): the library's own names
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_TGA
#define STBI_NO_FAILURE_STRINGS
#define STBI_NO_STDIO
#define STBI_NO_THREAD_LOCALS
// NOLINTEND(readability-identifier-naming)
#include <stb/stb_image.h>
#ifdef RIDGECRAFT_HAS_WEBP
#include <webp/decode.h>
#endif
#ifdef RIDGECRAFT_HAS_TIFF
#include <tiffio.h>
#endif

namespace ridgecraft::mesh {
namespace {

using namespace std::string_view_literals;

struct PictureStart {
  std::string_view bytes;
  PictureFormat format;
};
constexpr std::array starts{PictureStart{"\x89PNG\r\n\x1a\n"sv, {"PNG", true}},
                            PictureStart{"\xff\xd8\xff"sv, {"JPEG", true}},
                            PictureStart{"GIF8"sv, {"GIF", true}},
                            PictureStart{"BM"sv, {"BMP", true}},
#ifdef RIDGECRAFT_HAS_TIFF
                            PictureStart{"II*\0"sv, {"TIFF", true}},
                            PictureStart{"MM\0*"sv, {"TIFF", true}},
#else
                            PictureStart{"II*\0"sv, {"TIFF", false}},
                            PictureStart{"MM\0*"sv, {"TIFF", false}},
#endif
                            PictureStart{"\xabKTX 20"sv, {"KTX2", false}},
                            PictureStart{"\xabKTX 11"sv, {"KTX", false}},
                            PictureStart{"DDS "sv, {"DDS", false}},
                            PictureStart{"8BPS"sv, {"Photoshop", false}},
                            PictureStart{"v/1\x01"sv, {"OpenEXR", false}},
                            PictureStart{"#?RADIANCE"sv, {"HDR", false}},
                            PictureStart{"sB"sv, {"Basis", false}},
                            PictureStart{"<svg"sv, {"SVG", false}},
                            PictureStart{"%PDF"sv, {"PDF", false}}};
#ifdef RIDGECRAFT_HAS_WEBP
constexpr PictureFormat webp{"WebP", true};
#else
constexpr PictureFormat webp{"WebP", false};
#endif

/// TGA has no mark at its start, but few other bytes make sense as its header.
bool looks_like_tga(std::string_view bytes) {
  constexpr std::size_t header_size = 18;
  if (bytes.size() <= header_size) {
    return false;
  }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const auto is_one_of = [](unsigned value, std::initializer_list<unsigned> known) {
    return std::find(known.begin(), known.end(), value) != known.end();
  };
  return byte(1) <= 1 && is_one_of(byte(2), {1, 2, 3, 9, 10, 11}) &&
         is_one_of(byte(16), {8, 15, 16, 24, 32}) && (byte(12) | byte(13)) != 0 &&
         (byte(14) | byte(15)) != 0 && (byte(1) == 1) == (byte(2) % 8 == 1);
}

/// Rows of red, green, blue and opacity on white paper.
Picture on_white(std::uint32_t width, std::uint32_t height, const std::uint8_t* rgba) {
  const std::size_t count = std::size_t{width} * height;
  // Programs that know no transparency write nothing there.
  bool opaque = true;
  for (std::size_t i = 0; opaque && i < count; ++i) {
    opaque = rgba[4 * i + 3] == 0;
  }
  std::vector<std::uint8_t> pixels(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned alpha = opaque ? 255U : rgba[4 * i + 3];
    for (std::size_t k = 0; k < 3; ++k) {
      pixels[3 * i + k] =
          static_cast<std::uint8_t>((rgba[4 * i + k] * alpha + 255U * (255U - alpha) + 127U) / 255U);
    }
  }
  return Picture(width, height, std::move(pixels));
}

/// None of the formats that stb_image reads packs more pixels into a byte (GIF: 4096 into 12 bits).
constexpr std::uint64_t most_pixels_of_byte = 4096;

using Freed = std::unique_ptr<std::uint8_t, void (*)(void*)>;

std::optional<Picture> unpack_by_stb(std::string_view bytes) {
  if (bytes.size() > INT_MAX) {
    return std::nullopt;
  }
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width <= 0 || height <= 0 ||
      !has_sensible_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height)) ||
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) / most_pixels_of_byte >
          bytes.size()) {
    return std::nullopt;
  }
  const Freed rgba(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  return rgba ? std::optional(on_white(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                       rgba.get()))
              : std::nullopt;
}

#ifdef RIDGECRAFT_HAS_WEBP
std::optional<Picture> unpack_webp(std::string_view bytes) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  int width = 0;
  int height = 0;
  if (WebPGetInfo(data, bytes.size(), &width, &height) == 0 ||
      !has_sensible_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height))) {
    return std::nullopt;
  }
  const Freed rgba(WebPDecodeRGBA(data, bytes.size(), &width, &height), WebPFree);
  return rgba ? std::optional(on_white(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                       rgba.get()))
              : std::nullopt;
}
#endif

#ifdef RIDGECRAFT_HAS_TIFF
/// A file in memory, as libtiff reads it.
struct TiffBytes {
  std::string_view bytes;
  std::uint64_t at = 0;
};

tmsize_t read_tiff(thandle_t handle, void* into, tmsize_t size) {
  auto& file = *static_cast<TiffBytes*>(handle);
  const std::uint64_t left = file.at < file.bytes.size() ? file.bytes.size() - file.at : 0;
  const std::uint64_t taken =
      std::min<std::uint64_t>(left, static_cast<std::uint64_t>(std::max<tmsize_t>(size, 0)));
  if (taken > 0) {
    std::memcpy(into, file.bytes.data() + file.at, taken);
  }
  file.at += taken;
  return static_cast<tmsize_t>(taken);
}
tmsize_t write_tiff(thandle_t /*handle*/, void* /*from*/, tmsize_t /*size*/) {
  return 0;
}
toff_t seek_tiff(thandle_t handle, toff_t to, int whence) {
  auto& file = *static_cast<TiffBytes*>(handle);
  file.at = to + (whence == SEEK_CUR ? file.at : whence == SEEK_END ? file.bytes.size() : 0);
  return file.at;
}
int close_tiff(thandle_t /*handle*/) {
  return 0;
}
toff_t size_of_tiff(thandle_t handle) {
  return static_cast<TiffBytes*>(handle)->bytes.size();
}
int say_nothing_of_tiff(TIFF* /*tiff*/, void* /*user*/, const char* /*module*/, const char* /*format*/,
                        va_list /*values*/) {
  return 1;
}

/// libtiff may take this much at once, 1 GiB: what it unpacks is checked before.
constexpr tmsize_t most_tiff_memory = tmsize_t{1} << 30U;

std::optional<Picture> unpack_tiff(std::string_view bytes) {
  TiffBytes file{bytes};
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), most_tiff_memory);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), say_nothing_of_tiff, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing_of_tiff, nullptr);
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(
      TIFFClientOpenExt("picture", "rm", &file, read_tiff, write_tiff, seek_tiff, close_tiff, size_of_tiff,
                        nullptr, nullptr, options.get()),
      TIFFClose);
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  if (!tiff || TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width) == 0 ||
      TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height) == 0 || !has_sensible_size(width, height)) {
    return std::nullopt;
  }
  std::vector<std::uint32_t> raster(std::size_t{width} * height);
  if (TIFFReadRGBAImageOriented(tiff.get(), width, height, raster.data(), ORIENTATION_TOPLEFT, 1) == 0) {
    return std::nullopt;
  }
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * raster.size());
  for (const std::uint32_t pixel : raster) {
    // Colours come multiplied by their opacity.
    const unsigned white = 255U - TIFFGetA(pixel);
    for (const unsigned channel : {TIFFGetR(pixel), TIFFGetG(pixel), TIFFGetB(pixel)}) {
      pixels.push_back(static_cast<std::uint8_t>(std::min(255U, channel + white)));
    }
  }
  return Picture(width, height, std::move(pixels));
}
#endif

}  // namespace

std::optional<PictureFormat> picture_format(std::string_view bytes) {
  for (const PictureStart& start : starts) {
    if (bytes.starts_with(start.bytes)) {
      return start.format;
    }
  }
  if (bytes.starts_with("RIFF") && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") {
    return webp;
  }
  if (bytes.size() > 12 && bytes.substr(4, 4) == "ftyp") {
    return PictureFormat{bytes.substr(8, 4) == "avif" ? "AVIF" : "HEIF", false};
  }
  return looks_like_tga(bytes) ? std::optional(PictureFormat{"TGA", true}) : std::nullopt;
}

std::optional<Picture> unpack_other_picture(std::string_view bytes) {
  const std::optional<PictureFormat> format = picture_format(bytes);
  if (!format || !format->is_read) {
    return std::nullopt;
  }
#ifdef RIDGECRAFT_HAS_WEBP
  if (format->name == "WebP") {
    return unpack_webp(bytes);
  }
#endif
#ifdef RIDGECRAFT_HAS_TIFF
  if (format->name == "TIFF") {
    return unpack_tiff(bytes);
  }
#endif
  return unpack_by_stb(bytes);
}

}  // namespace ridgecraft::mesh
