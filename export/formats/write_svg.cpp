// SPDX-License-Identifier: GPL-3.0-or-later
// SVG of one page: plain XML in true millimetres, y down, a layer for each class of line, presentation
// attributes only (no CSS, no transforms, no reuse), since cutters' importers understand little more.
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/base64.hpp"
#include "base/elementary.hpp"
#include "base/utf8.hpp"
#include "base/xml_text.hpp"
#include "export/formats/layer_order.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::paper {
namespace {

std::string escaped(std::string_view text) {
  return xml_escaped(printable_utf8(text));
}

std::string color(Color c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

class SvgWriter {
 public:
  SvgWriter(const Drawing& page, const Mark& mark) : page_(page), mark_(mark) {}

  std::string write() {
    head();
    for (const Layer layer : layer_order) {
      if (is_optional(layer) && !has_layer(page_, layer)) {
        continue;
      }
      append(out_, "  <g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" id=\"{}\"{}>\n", title(layer),
             id(layer), layer_attributes(layer));
      if (layer == Layer::paint) {
        write_grounds();
      }
      for (const Group& group : page_.groups) {
        write_group(group, layer);
      }
      append(out_, "  </g>\n");
    }
    if (!page_.back.empty()) {
      write_back();
    }
    append(out_, "</svg>\n");
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string x(Vec2 p) const { return decimals(p.x); }
  [[nodiscard]] std::string y(Vec2 p) const { return decimals(page_.size.y - p.y); }

  void head() {
    const std::string width = decimals(page_.size.x);
    const std::string height = decimals(page_.size.y);
    append(out_,
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "{2}xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
           "xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\" version=\"1.1\"\n"
           "     width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
           width, height,
           has_layer(page_, Layer::paint) ? "xmlns:xlink=\"http://www.w3.org/1999/xlink\" " : "");
    append(out_, "  <title>{} – page {} of {}</title>\n", escaped(page_.title), page_.page, page_.page_count);
    append(out_, "  <metadata id=\"metadata\">{} {}{}</metadata>\n", escaped(mark_.producer),
           escaped(mark_word(mark_)),
           mark_.settings.empty() ? "" : " " + escaped(settings_json(mark_.settings)));
    append(out_, "  <sodipodi:namedview id=\"view\" inkscape:document-units=\"mm\"/>\n");
  }

  static std::string layer_attributes(Layer layer) {
    if (layer == Layer::tab_fill) {
      return fmt::format(" fill=\"{}\" stroke=\"none\"", color(fill_of(layer)));
    }
    return " fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"";
  }

  void write_group(const Group& group, Layer layer) {
    if (!has_layer(group, layer)) {
      return;
    }
    append(out_, "    <g id=\"{}-{}\">\n", id(layer), escaped(group.id));
    if (layer == Layer::paint) {
      for (const Image& image : group.images) {
        write_image(image, group);
      }
      for (const Fill& fill : group.fills) {
        write_fill(fill);
      }
    }
    for (const Area& area : group.areas) {
      if (area.layer == layer) {
        append(out_, "      <path fill=\"{}\" stroke=\"none\" d=\"{}\"/>\n", color(fill_of(layer)),
               path(area.outline, true));
      }
    }
    for (const Line& line : group.lines) {
      if (line.layer == layer) {
        write_line(line);
      }
    }
    for (const Text& text : group.texts) {
      if (text.layer == layer) {
        write_text(text);
      }
    }
    append(out_, "    </g>\n");
  }

  /// The other side of the sheet as it is seen there, in a layer that is hidden: it is printed by itself.
  void write_back() {
    append(out_,
           "  <g inkscape:groupmode=\"layer\" inkscape:label=\"Back\" id=\"back\" display=\"none\"{}>\n",
           layer_attributes(Layer::label));
    for (const Group& group : page_.back) {
      for (const Layer layer : layer_order) {
        write_group(group, layer);
      }
    }
    append(out_, "  </g>\n");
  }

  /// What reaches under the colours of other pieces lies below them all.
  void write_grounds() {
    for (const Group& group : page_.groups) {
      if (!group.ground.empty()) {
        append(out_, "    <g id=\"bleed-{}\">\n", escaped(group.id));
        for (const Fill& fill : group.ground) {
          write_fill(fill);
        }
        append(out_, "    </g>\n");
      }
    }
  }

  [[nodiscard]] std::string path(const std::vector<std::vector<Vec2>>& polygons) const {
    std::string d;
    for (const std::vector<Vec2>& polygon : polygons) {
      d += (d.empty() ? "" : " ") + path(polygon, true);
    }
    return d;
  }

  void write_fill(const Fill& fill) {
    append(out_, "      <path fill=\"{0}\" stroke=\"{0}\" stroke-width=\"{1}\" d=\"{2}\"/>\n",
           color(fill.color), decimals(fill_rim_mm), path(fill.polygons));
  }

  void write_image(const Image& image, const Group& group) {
    const std::string clip = "clip-" + escaped(group.id);
    append(out_, "      <clipPath id=\"{}\"><path d=\"{}\"/></clipPath>\n", clip, path(image.clip));
    append(out_,
           "      <image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
           "clip-path=\"url(#{})\" xlink:href=\"data:image/jpeg;base64,{}\"/>\n",
           x(image.place.low), y(image.place.high), decimals(image.place.high.x - image.place.low.x),
           decimals(image.place.high.y - image.place.low.y), clip, base64(*image.jpeg));
  }

  [[nodiscard]] std::string path(const std::vector<Vec2>& points, bool closed) const {
    std::string d;
    for (std::size_t i = 0; i < points.size(); ++i) {
      d += (i == 0 ? "M" : " ") + x(points[i]) + "," + y(points[i]);
      if (i == 0 && points.size() > 1) {
        d += " L";
      }
    }
    return closed ? d + " Z" : d;
  }

  void write_line(const Line& line) {
    const LineStyle style = style_of(line);
    append(out_, "      <path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"", color(style.color),
           decimals(style.width));
    if (const std::vector<double> dashes = dashes_of(line); !dashes.empty()) {
      append(out_, " stroke-linecap=\"butt\" stroke-dasharray=\"");
      for (std::size_t i = 0; i < dashes.size(); ++i) {
        append(out_, "{}{}", i == 0 ? "" : " ", decimals(dashes[i]));
      }
      append(out_, "\"");
    }
    append(out_, " d=\"{}\"/>\n", path(line.points, line.closed));
  }

  void write_text(const Text& text) {
    if (!stroke_font_covers(text.text)) {
      write_real_text(text);
      return;
    }
    std::string d;
    for (const auto& stroke : text_strokes(text)) {
      d += (d.empty() ? "" : " ") + path(stroke, false);
    }
    if (d.empty()) {
      return;
    }
    if (text.layer == Layer::paint) {
      append(out_, "      <path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" d=\"{}\"/>\n",
             color(color_of(text)), decimals(pen_width(text) + 2.0 * halo_mm), d);
      return;
    }
    // The words stay in the file for people who search it and for programs that read it aloud.
    append(out_, "      <path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" aria-label=\"{}\" d=\"{}\"/>\n",
           color(color_of(text)), decimals(pen_width(text)), escaped(text.text), d);
  }

  void write_real_text(const Text& text) {
    const Vec2 down{elementary::sin(text.angle), -elementary::cos(text.angle)};
    // From the left end of its estimated box: only titles can be such texts.
    const double half = 0.5 * text_width(text.text, text.height);
    const Vec2 baseline = text.centre + 0.5 * text.height * down + half * perpendicular(-down);
    append(out_, "      <text x=\"{}\" y=\"{}\"", x(baseline), y(baseline));
    if (std::abs(text.angle) > 0.0) {
      append(out_, " transform=\"rotate({} {} {})\"", decimals(-text.angle * 180.0 / 3.14159265358979323846),
             x(baseline), y(baseline));
    }
    append(out_,
           " font-family=\"sans-serif\" font-size=\"{}\" fill=\"{}\" "
           "stroke=\"none\">{}</text>\n",
           decimals(text.height * font_size_per_height), color(color_of(text)), escaped(text.text));
  }

  const Drawing& page_;
  const Mark& mark_;
  std::string out_;
};

}  // namespace

std::string write_svg(const Drawing& page, const Mark& mark) {
  return SvgWriter(page, mark).write();
}

}  // namespace ridgecraft::paper
