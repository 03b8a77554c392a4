// SPDX-License-Identifier: GPL-3.0-or-later
// PNG by libpng's simplified interface, JPEG by libjpeg. What jumps out of libjpeg holds no objects of C++.
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <jpeglib.h>
#include <png.h>

#include "base/error.hpp"
#include "mesh/look/picture.hpp"

namespace ridgecraft::mesh {
namespace {

constexpr int jpeg_quality = 92;

bool has_sensible_size(std::uint64_t width, std::uint64_t height) {
  return width > 0 && height > 0 && width <= most_picture_pixels && height <= most_picture_pixels / width;
}

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

std::optional<Picture> unpack_picture(std::string_view bytes) {
  return bytes.starts_with("\xff\xd8") ? unpack_jpeg(bytes) : unpack_png(bytes);
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
