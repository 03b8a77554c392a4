// SPDX-License-Identifier: GPL-3.0-or-later
// PNG of one page: Cairo paints it, then the chunks are added that say how large a pixel is and who made it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <zlib.h>

#include "base/text.hpp"
#include "export/formats/cairo_page.hpp"
#include "export/formats/write.hpp"
#include "export/style/line_style.hpp"

namespace ridgecraft::export_ {
namespace {

/// The checksum of PNG (PNG specification, annex D) is that of zlib.
std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 32; shift > 0; shift -= 8) {
    bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(value >> (shift - 8))));
  }
  return bytes;
}

std::string chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(checksum(body));
}

std::string text_chunk(std::string_view key, std::string_view value) {
  std::string data(key);
  data.push_back('\0');
  return chunk("tEXt", data + std::string(value));
}

/// Text in UTF-8, not compressed, no language.
std::string international_chunk(std::string_view key, std::string_view value) {
  std::string data(key);
  data.append(5, '\0');  // end of key, compression flag and method, empty language and translated key
  return chunk("iTXt", data + std::string(value));
}

cairo_status_t append_to_png(void* out, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

/// A picture of more pixels takes 400 MB, and Cairo's sides end at 32767.
constexpr double most_pixels = 1e8;
constexpr double longest_side = 32000.0;

/// Large sheets get coarser pictures rather than none.
double affordable_dots_per_mm(Vec2 size_mm, double wanted) {
  return std::min({wanted, longest_side / std::max(size_mm.x, size_mm.y),
                   std::sqrt(most_pixels / (size_mm.x * size_mm.y))});
}

}  // namespace

std::string write_png(const Drawing& page, const Mark& mark, double dots_per_inch) {
  const double dots_per_mm = affordable_dots_per_mm(page.size, dots_per_inch / 25.4);
  const CairoSurface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(page.size.x * dots_per_mm)),
                                 static_cast<int>(std::lround(page.size.y * dots_per_mm))));
  check_cairo(cairo_surface_status(surface.get()));
  const CairoContext cairo(cairo_create(surface.get()));
  cairo_set_source_rgb(cairo.get(), 1.0, 1.0, 1.0);
  cairo_paint(cairo.get());
  for (const Layer layer : layer_order) {
    paint_layer(cairo.get(), page, layer, dots_per_mm);
  }
  std::string bytes;
  check_cairo(cairo_surface_write_to_png_stream(surface.get(), append_to_png, &bytes));
  const std::string per_metre = big_endian(static_cast<std::uint32_t>(std::lround(1000.0 * dots_per_mm)));
  constexpr std::size_t after_header = 8 + 25;  // signature, IHDR
  bytes.insert(after_header, chunk("pHYs", per_metre + per_metre + '\x01') +
                                 text_chunk("Software", mark.producer) +
                                 international_chunk("Title", printable_utf8(page.title)) +
                                 text_chunk("Source", mark_word(mark)));
  return bytes;
}

}  // namespace ridgecraft::export_
