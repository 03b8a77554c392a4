// SPDX-License-Identifier: GPL-3.0-or-later
// A page for browsers: the front end of web/ with one result in it, as two documents of JSON, packed.
// docs/design/viewer.md describes both.
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <zlib.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {

/// The page of web/ as one text, made by web/bundle.sh when the program is built: HTML with `@MARK@`,
/// `@SETTINGS@`, `@PRODUCER@`, `@TITLE@`, `@FOLD@` and `@SHEETS@` once each, in this order, where
/// write_html() puts what belongs there.
extern const std::string_view page_template;

namespace {

std::string hex(Color color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

/// Places of areas: finer than any screen or printer shows.
std::string hundredths(double value) {
  return decimals(std::round(value * 100.0) / 100.0);
}
/// Places of texts.
std::string tenths(double value) {
  return decimals(std::round(value * 10.0) / 10.0);
}

/// What the page draws of a drawing. Cuts, folds and tabs it has from the nets.
class SheetsWriter {
 public:
  std::string write(std::span<const Drawing> pages) {
    json_.raw("{");
    json_.list("pages", pages.size(), [&](std::size_t i) {
      json_.raw("\n{\"size\":");
      numbers({pages[i].size});
      json_.raw(",\"groups\":[");
      const char* separator = "\n";
      for (const Group& group : pages[i].groups) {
        json_.raw(std::exchange(separator, ",\n"));
        write_group(group);
      }
      json_.raw("]}");
    });
    json_.raw("\n}\n");
    return std::move(json_).take();
  }

 private:
  static bool is_written(Layer layer) {
    return layer == Layer::label || layer == Layer::mark || layer == Layer::piece_name ||
           layer == Layer::shadow || layer == Layer::glue;
  }

  /// [x,y,x,y,...]
  void numbers(const std::vector<Vec2>& points) {
    json_.raw("[");
    for (std::size_t i = 0; i < points.size(); ++i) {
      json_.raw((i == 0 ? "" : ",") + hundredths(points[i].x) + "," + hundredths(points[i].y));
    }
    json_.raw("]");
  }

  void polygons(const std::vector<std::vector<Vec2>>& list) {
    json_.raw("[");
    for (std::size_t i = 0; i < list.size(); ++i) {
      json_.raw(i == 0 ? "" : ",");
      numbers(list[i]);
    }
    json_.raw("]");
  }

  template <class Items, class Wanted, class Write>
  void members(std::string_view name, const Items& items, Wanted wanted, Write write) {
    bool begun = false;
    for (const auto& item : items) {
      if (wanted(item)) {
        json_.raw(begun ? ",[" : fmt::format(",\n\"{}\":[[", name));
        begun = true;
        write(item);
        json_.raw("]");
      }
    }
    json_.raw(begun ? "]" : "");
  }

  void write_group(const Group& group) {
    json_.raw("{\"id\":");
    json_.string(group.id);
    const auto all = [](const auto&) { return true; };
    const auto written = [](const auto& item) { return is_written(item.layer); };
    members("texts", group.texts, written, [&](const Text& text) { write_text(text); });
    members("lines", group.lines, written, [&](const Line& line) { write_line(line); });
    members("areas", group.areas, written, [&](const Area& area) { write_area(area); });
    members("ground", group.ground, all, [&](const Fill& fill) { write_fill(fill); });
    members("images", group.images, all, [&](const Image& image) { write_image(image); });
    members("fills", group.fills, all, [&](const Fill& fill) { write_fill(fill); });
    json_.raw("}");
  }

  /// Colour, outline.
  void write_area(const Area& area) {
    json_.string(hex(area.color.value_or(fill_of(area.layer))));
    json_.raw(",");
    numbers(area.outline);
  }

  /// Layer, text, x and y of its middle, height, angle in degrees; then flags and width, where a text is long
  /// or has flags.
  void write_text(const Text& text) {
    constexpr double degrees = 180.0 / 3.14159265358979323846;
    constexpr std::size_t short_text = 4;
    json_.number(text.layer == Layer::label ? 0 : text.layer == Layer::piece_name ? 1 : 2);
    json_.raw(",");
    json_.string(text.text);
    for (const double value : {text.centre.x, text.centre.y, text.height}) {
      json_.raw("," + tenths(value));
    }
    json_.raw("," + decimals(std::round(text.angle * degrees)));
    const int flags = (text.underlined ? 1 : 0) + (text.tone == Tone::light ? 2 : 0);
    if (flags != 0 || text.text.size() > short_text) {
      json_.raw(fmt::format(",{},{}", flags, tenths(text_width(text.text, text.height))));
    }
  }

  /// Colour, width, dashes, points.
  void write_line(const Line& line) {
    const LineStyle style = style_of(line);
    json_.string(hex(style.color));
    json_.raw("," + hundredths(style.width) + ",[");
    const char* separator = "";
    for (const double dash : dashes_of(line)) {
      json_.raw(std::exchange(separator, ",") + hundredths(dash));
    }
    json_.raw("],");
    std::vector<Vec2> points = line.points;
    if (line.closed && !points.empty()) {
      points.push_back(points.front());
    }
    numbers(points);
  }

  void write_fill(const Fill& fill) {
    json_.string(hex(fill.color));
    json_.raw(",");
    polygons(fill.polygons);
  }

  void write_image(const Image& image) {
    numbers({image.place.low, image.place.high});
    json_.raw(",\"" + base64(*image.jpeg) + "\",");
    polygons(image.clip);
  }

  JsonText json_;
};

/// As web/packed.js reads it.
std::string packed(std::string_view text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string bytes(size, '\0');
  const int outcome =
      compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
                static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
  RIDGECRAFT_ASSERT(outcome == Z_OK);
  bytes.resize(size);
  return base64(bytes);
}

}  // namespace

std::string write_sheets(std::span<const Drawing> pages) {
  return SheetsWriter().write(pages);
}

std::string write_html(std::string_view fold, std::span<const Drawing> pages, const Mark& mark) {
  const std::array<std::pair<std::string_view, std::string>, 6> places{{
      {"@MARK@", xml_escaped(printable_utf8(mark_word(mark)))},
      {"@SETTINGS@", mark.settings.empty() ? "" : xml_escaped(settings_json(mark.settings))},
      {"@PRODUCER@", xml_escaped(printable_utf8(mark.producer))},
      {"@TITLE@", xml_escaped(printable_utf8(mark.title))},
      {"@FOLD@", packed(fold)},
      {"@SHEETS@", packed(write_sheets(pages))},
  }};
  std::string html;
  std::string_view rest = page_template;
  for (const auto& [place, text] : places) {
    const auto at = rest.find(place);
    RIDGECRAFT_ASSERT(at != std::string_view::npos);
    html += rest.substr(0, at);
    html += text;
    rest.remove_prefix(at + place.size());
  }
  html += rest;
  return html;
}

}  // namespace ridgecraft::export_
