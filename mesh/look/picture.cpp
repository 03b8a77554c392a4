// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/picture.hpp"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <jpeglib.h>
#include <png.h>

#include "base/error.hpp"

namespace ridgecraft::mesh {
namespace {

/// Copies end where a side has this many pixels: beyond, colours of places far from each other would mix.
constexpr std::uint32_t shortest_side = 4;

constexpr std::uint32_t whole = 256;  // shares of pixels are counted in this

/// A number in [0, size) for any whole number: pictures repeat.
std::uint32_t wrapped(double index, std::uint32_t size) {
  if (index >= 0.0 && index < size) {
    return static_cast<std::uint32_t>(index);
  }
  const double rest = index - std::floor(index / size) * size;
  return std::min(static_cast<std::uint32_t>(std::max(rest, 0.0)), size - 1);
}

/// The three bytes of a pixel, 16 bits apart.
std::uint64_t spread(const std::uint8_t* pixel) {
  return std::uint64_t{pixel[0]} | std::uint64_t{pixel[1]} << 16U | std::uint64_t{pixel[2]} << 32U;
}

// PNG by libpng's simplified interface, JPEG by libjpeg. What jumps out of libjpeg holds no objects of C++.

constexpr int jpeg_quality = 92;

std::optional<Picture> unpack_png(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    return std::nullopt;
  }
  if (!has_sensible_size(image.width, image.height)) {
    png_image_free(&image);
    return std::nullopt;
  }
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&image, &white, pixels.data(), 0, nullptr) == 0) {
    png_image_free(&image);
    return std::nullopt;
  }
  return Picture(image.width, image.height, std::move(pixels));
}

/// libjpeg's errors end here; its warnings (of data that is damaged, but complete) are passed over.
struct JpegFailure {
  jpeg_error_mgr manager;
  std::jmp_buf way_out;
};

[[noreturn]] void leave(j_common_ptr info) {
  std::longjmp(reinterpret_cast<JpegFailure*>(info->err)->way_out, 1);  // NOLINT: manager comes first
}
void say_nothing(j_common_ptr /*info*/) {}

jpeg_error_mgr* prepared(JpegFailure& failure) {
  jpeg_std_error(&failure.manager);
  failure.manager.error_exit = leave;
  failure.manager.output_message = say_nothing;
  return &failure.manager;
}

/// Pictures for presses have four channels, in Adobe's files from full ink at 0.
void add_printed_row(const std::uint8_t* row, std::uint32_t width, bool inverted, std::uint8_t* out) {
  for (std::uint32_t x = 0; x < width; ++x) {
    const auto paper = [&](std::size_t k) { return inverted ? row[4 * x + k] : 255 - row[4 * x + k]; };
    for (std::size_t k = 0; k < 3; ++k) {
      out[3 * x + k] = static_cast<std::uint8_t>(paper(k) * paper(3) / 255);
    }
  }
}

/// The caller owns all that has to be freed. False where it fails.
bool read_jpeg(jpeg_decompress_struct& info, JpegFailure& failure, std::string_view bytes,
               std::vector<std::uint8_t>& pixels, std::vector<std::uint8_t>& row) {
  if (setjmp(failure.way_out) != 0) {  // NOLINT: libjpeg knows no other way
    return false;
  }
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  if (!has_sensible_size(info.image_width, info.image_height)) {
    return false;
  }
  const bool printed = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  info.out_color_space = printed ? JCS_CMYK : JCS_RGB;
  jpeg_start_decompress(&info);
  pixels.resize(std::size_t{3} * info.output_width * info.output_height);
  row.resize(printed ? std::size_t{4} * info.output_width : 0);
  while (info.output_scanline < info.output_height) {
    std::uint8_t* const out = pixels.data() + std::size_t{3} * info.output_width * info.output_scanline;
    JSAMPROW into = printed ? row.data() : out;
    jpeg_read_scanlines(&info, &into, 1);
    if (printed) {
      add_printed_row(row.data(), info.output_width, info.saw_Adobe_marker != 0, out);
    }
  }
  jpeg_finish_decompress(&info);
  return true;
}

std::optional<Picture> unpack_jpeg(std::string_view bytes) {
  JpegFailure failure{};
  jpeg_decompress_struct info{};
  info.err = prepared(failure);
  jpeg_create_decompress(&info);
  std::vector<std::uint8_t> pixels;
  std::vector<std::uint8_t> row;
  const bool read = read_jpeg(info, failure, bytes, pixels, row);
  const std::uint32_t width = info.output_width;
  const std::uint32_t height = info.output_height;
  jpeg_destroy_decompress(&info);
  return read ? std::optional<Picture>(Picture(width, height, std::move(pixels))) : std::nullopt;
}

bool write_jpeg(jpeg_compress_struct& info, JpegFailure& failure, std::span<const std::uint8_t> pixels,
                unsigned char** out, unsigned long* size) {
  if (setjmp(failure.way_out) != 0) {  // NOLINT: see above
    return false;
  }
  jpeg_mem_dest(&info, out, size);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, jpeg_quality, TRUE);
  // All channels in full: borders of colours stay where they are.
  for (int k = 0; k < info.num_components; ++k) {
    info.comp_info[k].h_samp_factor = 1;
    info.comp_info[k].v_samp_factor = 1;
  }
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    // libjpeg takes no const, by an old habit.
    // NOLINTNEXTLINE: see above
    JSAMPROW row =
        const_cast<std::uint8_t*>(pixels.data() + std::size_t{3} * info.image_width * info.next_scanline);
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  return true;
}

}  // namespace

Picture::Picture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> pixels) {
  levels_.push_back({width, height, std::move(pixels)});
  while (std::min(levels_.back().width, levels_.back().height) >= 2 * shortest_side) {
    const Level& fine = levels_.back();
    Level coarse{fine.width / 2, fine.height / 2, {}};
    coarse.pixels.resize(std::size_t{3} * coarse.width * coarse.height);
    for (std::size_t y = 0; y < coarse.height; ++y) {
      const std::uint8_t* const above = fine.pixels.data() + 2 * y * fine.width * 3;
      const std::uint8_t* const below = above + std::size_t{3} * fine.width;
      std::uint8_t* const out = coarse.pixels.data() + y * coarse.width * 3;
      for (std::size_t x = 0; x < coarse.width; ++x) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t at = 6 * x + k;
          out[3 * x + k] =
              static_cast<std::uint8_t>((above[at] + above[at + 3] + below[at] + below[at + 3] + 2) / 4);
        }
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

bool Picture::coarsen() {
  if (levels_.size() > 1) {
    levels_.erase(levels_.begin());
    return true;
  }
  return false;
}

unsigned Picture::level_for(double pixels_per_dot) const {
  unsigned level = 0;
  while (level + 1 < levels_.size() && pixels_per_dot >= 2.0) {
    pixels_per_dot /= 2.0;
    ++level;
  }
  return level;
}

Rgb Picture::at(Vec2 uv, unsigned level) const {
  const Level& in = levels_[level];
  const double x = uv.x * in.width - 0.5;
  const double y = (1.0 - uv.y) * in.height - 0.5;
  // Most places lie within, where no number is negative.
  const bool within = x >= 0.0 && y >= 0.0 && x < in.width && y < in.height;
  const double left = within ? static_cast<double>(static_cast<std::uint32_t>(x)) : std::floor(x);
  const double top = within ? static_cast<double>(static_cast<std::uint32_t>(y)) : std::floor(y);
  const std::size_t x0 = within ? static_cast<std::size_t>(left) : wrapped(left, in.width);
  const std::size_t y0 = within ? static_cast<std::size_t>(top) : wrapped(top, in.height);
  return in.between({x0, x0 + 1 == in.width ? 0 : x0 + 1, y0, y0 + 1 == in.height ? 0 : y0 + 1,
                     static_cast<std::uint32_t>((x - left) * whole),
                     static_cast<std::uint32_t>((y - top) * whole)});
}

void Picture::along(Vec2 from, Vec2 to, unsigned level, std::span<Rgb> colours) const {
  const Level& in = levels_[level];
  const double steps = colours.size() > 1 ? static_cast<double>(colours.size() - 1) : 1.0;
  const Vec2 first{from.x * in.width - 0.5, (1.0 - from.y) * in.height - 0.5};
  const Vec2 step{(to.x - from.x) / steps * in.width, (from.y - to.y) / steps * in.height};
  const Vec2 last = first + steps * step;
  // Where all places lie within, they are counted in 2^-32 of a pixel, and steps may be off by one of these.
  constexpr double fraction = 4294967296.0;
  constexpr double margin = 0.001;
  constexpr std::size_t most = 1U << 20U;
  const auto inside = [](double place, std::uint32_t size) {
    return place >= margin && place < size - 1.0 - margin;
  };
  if (!inside(first.x, in.width) || !inside(last.x, in.width) || !inside(first.y, in.height) ||
      !inside(last.y, in.height) || colours.size() > most) {
    for (std::size_t i = 0; i < colours.size(); ++i) {
      colours[i] = at(from + static_cast<double>(i) / steps * (to - from), level);
    }
    return;
  }
  const auto counted = [](double number) { return static_cast<std::int64_t>(number * fraction); };
  std::int64_t x = counted(first.x);
  std::int64_t y = counted(first.y);
  const std::int64_t over = counted(step.x);
  const std::int64_t down = counted(step.y);
  for (Rgb& colour : colours) {
    const auto x0 = static_cast<std::size_t>(x >> 32U);
    const auto y0 = static_cast<std::size_t>(y >> 32U);
    colour = in.between({x0, x0 + 1, y0, y0 + 1, static_cast<std::uint32_t>(x >> 24U) % whole,
                         static_cast<std::uint32_t>(y >> 24U) % whole});
    x += over;
    y += down;
  }
}

Rgb Picture::Level::between(const Four& at) const {
  const std::uint8_t* const above = pixels.data() + 3 * at.top * width;
  const std::uint8_t* const below = pixels.data() + 3 * at.bottom * width;
  // All channels at a time: mixed along a row each takes 16 bits, mixed across rows 24.
  const auto along = [&](const std::uint8_t* row) {
    return spread(row + 3 * at.left) * (whole - at.right_share) + spread(row + 3 * at.right) * at.right_share;
  };
  const std::uint64_t high = along(above);
  const std::uint64_t low = along(below);
  constexpr std::uint64_t outer = 0xffff0000ffffU;  // red and blue
  const auto across = [&](std::uint64_t up, std::uint64_t down, std::uint64_t rounding) {
    return up * (whole - at.low_share) + down * at.low_share + rounding;
  };
  constexpr std::uint64_t half = std::uint64_t{whole} * whole / 2;
  const std::uint64_t red_blue = across(high & outer, low & outer, half | half << 32U);
  const std::uint64_t green = across(high >> 16U & 0xffffU, low >> 16U & 0xffffU, half);
  return {static_cast<std::uint8_t>(red_blue >> 16U), static_cast<std::uint8_t>(green >> 16U),
          static_cast<std::uint8_t>(red_blue >> 48U)};
}

std::optional<Picture> unpack_picture(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8")      ? unpack_jpeg(bytes)
         : bytes.starts_with("\x89PNG\r\n") ? unpack_png(bytes)
                                            : unpack_other_picture(bytes);
}

std::string pack_jpeg(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> pixels) {
  JpegFailure failure{};
  jpeg_compress_struct info{};
  info.err = prepared(failure);
  jpeg_create_compress(&info);
  info.image_width = width;
  info.image_height = height;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool written = write_jpeg(info, failure, pixels, &bytes, &size);
  jpeg_destroy_compress(&info);
  std::string jpeg = written ? std::string(reinterpret_cast<const char*>(bytes), size) : std::string();
  std::free(bytes);  // NOLINT: libjpeg took it from malloc
  if (!written) {
    throw Error(ErrorKind::internal, "packing a picture failed");
  }
  return jpeg;
}

}  // namespace ridgecraft::mesh
