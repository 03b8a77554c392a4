// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/cairo_page.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"
#include "mesh/look/picture.hpp"

namespace ridgecraft::export_ {
namespace {

void set_color(cairo_t* cairo, Color c) {
  cairo_set_source_rgb(cairo, c.red / 255.0, c.green / 255.0, c.blue / 255.0);
}

void trace(cairo_t* cairo, const std::vector<Vec2>& points, bool closed) {
  for (const Vec2 p : points) {
    cairo_line_to(cairo, p.x, p.y);
  }
  if (closed) {
    cairo_close_path(cairo);
  }
}

void paint(cairo_t* cairo, const Area& area) {
  set_color(cairo, area.color.value_or(fill_of(area.layer)));
  cairo_new_path(cairo);
  trace(cairo, area.outline, true);
  if (area.layer != Layer::picture) {
    cairo_fill(cairo);
    return;
  }
  // Areas of pictures meet without a gap, but viewers that smooth edges show one.
  constexpr double overlap_mm = 0.06;
  cairo_fill_preserve(cairo);
  cairo_set_line_width(cairo, overlap_mm);
  cairo_stroke(cairo);
}

void paint(cairo_t* cairo, const Line& line) {
  const LineStyle style = style_of(line);
  const std::vector<double> dashes = dashes_of(line);
  set_color(cairo, style.color);
  cairo_set_line_width(cairo, style.width);
  cairo_set_dash(cairo, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_set_line_cap(cairo, dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  cairo_new_path(cairo);
  trace(cairo, line.points, line.closed);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0.0);
}

/// A text that the stroke font doesn't cover: only titles can be such. It is set by a font of the system, and
/// made narrower where that font is wider than estimated.
void paint_real_text(cairo_t* cairo, const Text& text) {
  const std::string words = printable_utf8(text.text);
  cairo_save(cairo);
  cairo_translate(cairo, text.centre.x, text.centre.y);
  cairo_rotate(cairo, text.angle);
  cairo_scale(cairo, 1.0, -1.0);  // fonts have y down
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, text.height * font_size_per_height);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, words.c_str(), &extents);
  const double room = text_width(text.text, text.height);
  cairo_translate(cairo, -0.5 * room, 0.0);
  if (extents.x_advance > room && room > 0.0) {
    cairo_scale(cairo, room / extents.x_advance, 1.0);
  }
  cairo_move_to(cairo, 0.0, 0.5 * text.height);
  cairo_show_text(cairo, words.c_str());
  cairo_restore(cairo);
}

void paint(cairo_t* cairo, const Text& text) {
  set_color(cairo, color_of(text));
  if (!stroke_font_covers(text.text)) {
    paint_real_text(cairo, text);
    return;
  }
  cairo_set_line_width(cairo, pen_width(text) + (text.layer == Layer::paint ? 2.0 * halo_mm : 0.0));
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_new_path(cairo);
  for (const auto& stroke : text_strokes(text)) {
    cairo_new_sub_path(cairo);
    trace(cairo, stroke, false);
  }
  cairo_stroke(cairo);
}

/// All at once: polygons that meet leave no gap between them.
void trace_all(cairo_t* cairo, const std::vector<std::vector<Vec2>>& polygons) {
  cairo_new_path(cairo);
  for (const std::vector<Vec2>& polygon : polygons) {
    cairo_new_sub_path(cairo);
    trace(cairo, polygon, true);
  }
}

void paint(cairo_t* cairo, const Fill& fill) {
  set_color(cairo, fill.color);
  trace_all(cairo, fill.polygons);
  cairo_fill_preserve(cairo);
  cairo_set_line_width(cairo, fill_rim_mm);
  cairo_stroke(cairo);
}

void destroy_bytes(void* bytes) {
  delete static_cast<std::shared_ptr<const std::string>*>(bytes);
}

/// A file of vectors takes the packed bytes as they are; a picture of dots needs the pixels.
CairoSurface surface_of(const Image& image, bool packed) {
  // Nobody looks at the dots beside packed bytes, so they are of the smallest kind.
  CairoSurface surface(cairo_image_surface_create(packed ? CAIRO_FORMAT_RGB16_565 : CAIRO_FORMAT_RGB24,
                                                  static_cast<int>(image.width),
                                                  static_cast<int>(image.height)));
  check_cairo(cairo_surface_status(surface.get()));
  if (packed) {
    auto* const held = new std::shared_ptr<const std::string>(image.jpeg);
    check_cairo(cairo_surface_set_mime_data(surface.get(), CAIRO_MIME_TYPE_JPEG,
                                            reinterpret_cast<const unsigned char*>(image.jpeg->data()),
                                            image.jpeg->size(), destroy_bytes, held));
    return surface;
  }
  const std::optional<mesh::Picture> picture = mesh::unpack_picture(*image.jpeg);
  if (!picture) {
    throw Error(ErrorKind::internal, "a picture of a page can't be unpacked again");
  }
  cairo_surface_flush(surface.get());
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (std::size_t y = 0; y < image.height; ++y) {
    const std::uint8_t* from = picture->pixels().data() + 3 * y * image.width;
    for (std::size_t x = 0; x < image.width; ++x, from += 3) {
      const std::uint32_t pixel = std::uint32_t{from[0]} << 16U | std::uint32_t{from[1]} << 8U | from[2];
      std::memcpy(data + y * stride + 4 * x, &pixel, sizeof pixel);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

void paint(cairo_t* cairo, const Image& image) {
  const bool packed = cairo_surface_get_type(cairo_get_target(cairo)) == CAIRO_SURFACE_TYPE_PDF;
  const CairoSurface surface = surface_of(image, packed);
  if (packed) {
    // As long as the file, or Cairo would copy its dots.
    check_cairo(cairo_surface_set_user_data(
        cairo_get_target(cairo), reinterpret_cast<const cairo_user_data_key_t*>(image.jpeg.get()),
        cairo_surface_reference(surface.get()),
        [](void* held) { cairo_surface_destroy(static_cast<cairo_surface_t*>(held)); }));
  }
  cairo_save(cairo);
  trace_all(cairo, image.clip);
  cairo_clip(cairo);
  const Vec2 size = image.place.high - image.place.low;
  cairo_translate(cairo, image.place.low.x, image.place.high.y);
  cairo_scale(cairo, size.x / image.width, -size.y / image.height);  // rows from the top
  cairo_set_source_surface(cairo, surface.get(), 0.0, 0.0);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

template <class Items>
void paint_all(cairo_t* cairo, const Items& items, Layer layer) {
  for (const auto& item : items) {
    if (item.layer == layer) {
      paint(cairo, item);
    }
  }
}

}  // namespace

void check_cairo(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw Error(ErrorKind::internal, std::string("drawing a page failed: ") + cairo_status_to_string(status));
  }
}

void paint_layer(cairo_t* cairo, const Drawing& page, Layer layer, double units_per_mm) {
  cairo_save(cairo);
  cairo_scale(cairo, units_per_mm, -units_per_mm);
  cairo_translate(cairo, 0.0, -page.size.y);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  if (layer == Layer::paint) {
    for (const auto member : {&Group::ground, &Group::fills}) {
      for (const Group& group : page.groups) {
        // Pictures lie between: over what reaches under them, below what is drawn exactly.
        if (member == &Group::fills) {
          std::ranges::for_each(group.images, [&](const Image& image) { paint(cairo, image); });
        }
        std::ranges::for_each(group.*member, [&](const Fill& fill) { paint(cairo, fill); });
      }
    }
  }
  for (const Group& group : page.groups) {
    paint_all(cairo, group.areas, layer);
    paint_all(cairo, group.lines, layer);
    paint_all(cairo, group.texts, layer);
  }
  cairo_restore(cairo);
  check_cairo(cairo_status(cairo));
}

}  // namespace ridgecraft::export_
