// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures unpacked to pixels, and packed again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::mesh {

/// Red, green, blue as screens have them (sRGB).
using Rgb = std::array<std::uint8_t, 3>;

/// Larger pictures aren't unpacked: they would take more than 400 MB.
inline constexpr std::uint64_t most_picture_pixels = 100'000'000;

[[nodiscard]] constexpr bool has_sensible_size(std::uint64_t width, std::uint64_t height) {
  return width > 0 && height > 0 && width <= most_picture_pixels && height <= most_picture_pixels / width;
}

/// The format of a picture file.
struct PictureFormat {
  std::string_view name;  ///< "PNG", "WebP" and so on
  bool is_read = false;   ///< by unpack_picture
};

/// By the first bytes of a file; nothing for what is no picture.
[[nodiscard]] std::optional<PictureFormat> picture_format(std::string_view bytes);

/// A picture, and coarser copies of it for places where many of its pixels fall on one dot of a printer.
class Picture {
 public:
  /// Rows from the top, three bytes a pixel. At least one pixel. O(pixels).
  Picture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> pixels);

  [[nodiscard]] std::uint32_t width() const { return levels_[0].width; }
  [[nodiscard]] std::uint32_t height() const { return levels_[0].height; }
  [[nodiscard]] std::span<const std::uint8_t> pixels() const { return levels_[0].pixels; }

  /// Half as wide and high from now on; false where it is too small for that.
  bool coarsen();

  /// The colour at a place: u runs right and v up over the picture once from 0 to 1, and it repeats beyond.
  /// `level`: in a copy whose pixels are 2^level times as large; 0 for the picture itself. Between the
  /// middles of pixels colours are mixed.
  [[nodiscard]] Rgb at(Vec2 uv, unsigned level) const;
  /// The colours at places spread evenly from one to another, both among them unless it is one: those of
  /// at(), but for a thousandth of a pixel. Quicker than one by one.
  void along(Vec2 from, Vec2 to, unsigned level, std::span<Rgb> colours) const;
  /// The coarsest level that shows every dot, where so many pixels lie next to each other on one.
  [[nodiscard]] unsigned level_for(double pixels_per_dot) const;

 private:
  /// Pixels in two columns and two rows, and the shares of 256ths that the right and the lower ones have.
  struct Four {
    std::size_t left, right, top, bottom;
    std::uint32_t right_share, low_share;
  };
  struct Level {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] Rgb between(const Four& at) const;
  };
  std::vector<Level> levels_;
};

/// Unpacks a file of a picture_format() that is read; what is transparent is blended with white paper.
/// Nothing where the bytes are damaged, or the picture has more than most_picture_pixels.
[[nodiscard]] std::optional<Picture> unpack_picture(std::string_view bytes);

/// The same for formats other than PNG and JPEG.
[[nodiscard]] std::optional<Picture> unpack_other_picture(std::string_view bytes);

/// A JPEG file of rows from the top, three bytes a pixel, in good quality. Same pixels, same bytes. Throws
/// Error(internal) where a side is longer than 65,500 pixels.
[[nodiscard]] std::string pack_jpeg(std::uint32_t width, std::uint32_t height,
                                    std::span<const std::uint8_t> pixels);

}  // namespace ridgecraft::mesh
