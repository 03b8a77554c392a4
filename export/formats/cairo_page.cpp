// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/cairo_page.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/utf8.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
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
  set_color(cairo, fill_of(area.layer));
  cairo_new_path(cairo);
  trace(cairo, area.outline, true);
  cairo_fill(cairo);
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
  cairo_set_line_width(cairo, pen_width(text));
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_new_path(cairo);
  for (const auto& stroke : text_strokes(text)) {
    cairo_new_sub_path(cairo);
    trace(cairo, stroke, false);
  }
  cairo_stroke(cairo);
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
  for (const Group& group : page.groups) {
    paint_all(cairo, group.areas, layer);
    paint_all(cairo, group.lines, layer);
    paint_all(cairo, group.texts, layer);
  }
  cairo_restore(cairo);
  check_cairo(cairo_status(cairo));
}

bool has_layer(const Drawing& page, Layer layer) {
  const auto is_of = [layer](const auto& item) { return item.layer == layer; };
  return std::ranges::any_of(page.groups, [&](const Group& group) {
    return std::ranges::any_of(group.areas, is_of) || std::ranges::any_of(group.lines, is_of) ||
           std::ranges::any_of(group.texts, is_of);
  });
}

}  // namespace ridgecraft::paper
