// SPDX-License-Identifier: GPL-3.0-or-later
// SVG of one page, or of all pages side by side: plain XML in true millimetres, y down, a layer for each
// class of line, presentation attributes only (no CSS, no reuse), since importers understand little more.
// Only texts are turned.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "export/formats/net_frame.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

std::string escaped(std::string_view text) {
  return xml_escaped(printable_utf8(text));
}

std::string color(Color c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

/// Pages of one file lie in rows of at most so many, with so much between them, mm.
constexpr std::size_t pages_in_row = 5;
constexpr double between_pages_mm = 10.0;

/// One page's layers.
class PageWriter {
 public:
  /// Its upper left corner lies at `corner`, y down. `prefix` stands before all ids, `suffix` behind the
  /// names of layers, so that neither comes twice in a file of several pages.
  PageWriter(const Drawing& page, Vec2 corner, std::string prefix, std::string suffix, std::string& out)
      : page_(page), corner_(corner), prefix_(std::move(prefix)), suffix_(std::move(suffix)), out_(out) {}

  void write() {
    for (const Layer layer : layer_order) {
      if (is_optional(layer) && !has_layer(page_, layer)) {
        continue;
      }
      append(out_, "  <g inkscape:groupmode=\"layer\" inkscape:label=\"{}{}\" id=\"{}{}\"{}>\n", title(layer),
             suffix_, prefix_, id(layer), layer_attributes(layer));
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
  }

 private:
  [[nodiscard]] std::string x(Vec2 p) const { return decimals(corner_.x + p.x); }
  [[nodiscard]] std::string y(Vec2 p) const { return decimals(corner_.y + page_.size.y - p.y); }

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
    append(out_, "    <g id=\"{}{}-{}\">\n", prefix_, id(layer), escaped(group.id));
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
           "  <g inkscape:groupmode=\"layer\" inkscape:label=\"Back{}\" id=\"{}back\" display=\"none\"{}>\n",
           suffix_, prefix_, layer_attributes(Layer::label));
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
        append(out_, "    <g id=\"{}bleed-{}\">\n", prefix_, escaped(group.id));
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
    const std::string clip = prefix_ + "clip-" + escaped(group.id);
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

  /// Letters of a font have room on either side, where strokes end with the pen; and a number's strokes may
  /// be too narrow for it.
  static double width_in_font(const Text& text, double em) {
    constexpr double sides = 0.16;
    constexpr double least = 0.45;  // of a figure
    constexpr std::size_t most_figures = 3;
    const std::size_t letters = code_points(text.text).size();
    return std::max(text_width(text.text, text.height) + sides * em,
                    letters <= most_figures ? least * em * static_cast<double>(letters) : 0.0);
  }

  /// Text that is found, copied and read aloud. It is as wide as the page has room for, whichever font a
  /// viewer takes; where the alphabet of strokes doesn't know it, that width is but an estimate.
  void write_text(const Text& text) {
    if (text.text.empty()) {
      return;
    }
    const double em = text.height * font_size_per_height;
    const double width = width_in_font(text, em);
    const Vec2 along{elementary::cos(text.angle), elementary::sin(text.angle)};
    const Vec2 baseline = text.centre - 0.5 * width * along - 0.5 * text.height * perpendicular(along);
    append(out_, "      <text x=\"{}\" y=\"{}\"", x(baseline), y(baseline));
    if (std::abs(text.angle) > 0.0) {
      append(out_, " transform=\"rotate({} {} {})\"", decimals(-text.angle * 180.0 / std::numbers::pi),
             x(baseline), y(baseline));
    }
    append(out_, " font-family=\"sans-serif\" font-size=\"{}\" fill=\"{}\"", decimals(em),
           color(color_of(text)));
    if (width > 0.0 && stroke_font_covers(text.text)) {
      append(out_, " textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\"", decimals(width));
    }
    if (text.layer == Layer::piece_name) {
      out_ += " font-weight=\"bold\"";
    }
    if (text.underlined) {
      out_ += " text-decoration=\"underline\"";
    }
    if (text.layer == Layer::paint) {  // a halo below the words themselves
      append(out_, " stroke=\"{}\" stroke-width=\"{}\" aria-hidden=\"true\"", color(color_of(text)),
             decimals(2.0 * halo_mm));
    } else {
      out_ += " stroke=\"none\"";
    }
    append(out_, ">{}</text>\n", escaped(text.text));
  }

  const Drawing& page_;
  Vec2 corner_;
  std::string prefix_;
  std::string suffix_;
  std::string& out_;
};

/// What stands before the layers, up to the view of Inkscape.
void write_head(Vec2 size, bool pictures, const std::string& title, const Mark& mark, std::string& out) {
  append(out,
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "{2}xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
         "xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\" version=\"1.1\"\n"
         "     width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
         decimals(size.x), decimals(size.y), pictures ? "xmlns:xlink=\"http://www.w3.org/1999/xlink\" " : "");
  append(out, "  <title>{}</title>\n", title);
  append(out, "  <metadata id=\"metadata\">{} {}{}</metadata>\n", escaped(mark.producer),
         escaped(mark_word(mark)), mark.settings.empty() ? "" : " " + escaped(settings_json(mark.settings)));
}

/// The upper left corner of each page, y down.
std::vector<Vec2> corners_of(std::span<const Drawing> pages) {
  std::vector<Vec2> corners;
  Vec2 next;
  double below = 0.0;
  for (const Drawing& page : pages) {
    if (!corners.empty() && corners.size() % pages_in_row == 0) {
      next = {0.0, below};
    }
    corners.push_back(next);
    below = std::max(below, next.y + page.size.y + between_pages_mm);
    next.x += page.size.x + between_pages_mm;
  }
  return corners;
}

}  // namespace

std::string write_svg(const Drawing& page, const Mark& mark) {
  std::string out;
  write_head(page.size, has_layer(page, Layer::paint),
             fmt::format("{} – page {} of {}", escaped(page.title), page.page, page.page_count), mark, out);
  append(out, "  <sodipodi:namedview id=\"view\" inkscape:document-units=\"mm\"/>\n");
  PageWriter(page, {}, "", "", out).write();
  append(out, "</svg>\n");
  return out;
}

std::string write_svg_of_all(std::span<const Drawing> pages, const Mark& mark) {
  RIDGECRAFT_ASSERT(!pages.empty());
  const std::vector<Vec2> corners = corners_of(pages);
  std::string out;
  Vec2 whole;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    whole = {std::max(whole.x, corners[i].x + pages[i].size.x),
             std::max(whole.y, corners[i].y + pages[i].size.y)};
  }
  write_head(whole,
             std::any_of(pages.begin(), pages.end(),
                         [](const Drawing& page) { return has_layer(page, Layer::paint); }),
             fmt::format("{} – {} pages", escaped(pages.front().title), pages.size()), mark, out);
  append(out, "  <sodipodi:namedview id=\"view\" inkscape:document-units=\"mm\">\n");
  for (std::size_t i = 0; i < pages.size(); ++i) {
    append(
        out,
        "    <inkscape:page id=\"sheet-{0}\" inkscape:label=\"Page {0}\" x=\"{1}\" y=\"{2}\" width=\"{3}\" "
        "height=\"{4}\"/>\n",
        i + 1, decimals(corners[i].x), decimals(corners[i].y), decimals(pages[i].size.x),
        decimals(pages[i].size.y));
  }
  append(out, "  </sodipodi:namedview>\n");
  for (std::size_t i = 0; i < pages.size(); ++i) {
    append(out, "  <g inkscape:groupmode=\"layer\" inkscape:label=\"Page {0}\" id=\"page-{0}\">\n", i + 1);
    PageWriter(pages[i], corners[i], fmt::format("page-{}-", i + 1), fmt::format(", page {}", i + 1), out)
        .write();
    append(out, "  </g>\n");
  }
  append(out, "</svg>\n");
  return out;
}

namespace {

/// The simulator joins points that are nearer than three units.
constexpr double units_per_mm = 100.0;
/// As in the FOLD file: a smaller angle is a flat facet.
constexpr double flat_degrees = 1e-6;

struct Look {
  std::string_view color;
  double opacity;
};

Look look_of(bool is_fold, double degrees) {
  if (!is_fold) {
    return {"#000000", 1.0};
  }
  if (std::abs(degrees) < flat_degrees) {
    return {"#ffff00", 1.0};
  }
  return {degrees < 0.0 ? "#ff0000" : "#0000ff", std::abs(degrees) / 180.0};
}

}  // namespace

std::string write_simulator_svg(const prepare::Prepared& model, const unfold::Nets& nets, const Pages& pages,
                                PageId page, const Mark& mark) {
  const mesh::Surface& surface = model.model.surface;
  const NetFrame frame = net_frame(surface, nets, &pages);
  IdVector<PieceId, std::size_t> faces;
  faces.resize(nets.pieces.size());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    ++faces[nets.piece[f]];
  }
  std::string out;
  const Vec2 size = pages.paper.size;
  append(out,
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"\n"
         "     width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\">\n",
         decimals(size.x), decimals(size.y), decimals(units_per_mm * size.x),
         decimals(units_per_mm * size.y));
  append(out, "  <metadata id=\"metadata\">{} preset:origami-simulator {}</metadata>\n",
         xml_escaped(printable_utf8(mark.producer)), xml_escaped(printable_utf8(mark_word(mark))));
  const auto x = [&](Vec2 p) { return decimals(units_per_mm * p.x); };
  const auto y = [&](Vec2 p) { return decimals(units_per_mm * (size.y - p.y)); };
  for (const NetFrame::Edge& edge : frame.edges) {
    const PieceId piece = nets.piece[mesh::face_of(edge.side)];
    if (frame.page[piece] != page || faces[piece] < 2) {
      continue;
    }
    const double degrees = surface.fold_angle(surface.edge(edge.side)) * 180.0 / std::numbers::pi;
    const Look look = look_of(edge.fold, degrees);
    const Vec2 from = frame.points[edge.vertices[0]] - frame.origins[page.value()];
    const Vec2 to = frame.points[edge.vertices[1]] - frame.origins[page.value()];
    append(out,
           "  <path fill=\"none\" stroke=\"{}\" stroke-width=\"10\" opacity=\"1\" stroke-opacity=\"{:.6f}\" "
           "d=\"M{},{} L{},{}\"/>\n",
           look.color, look.opacity, x(from), y(from), x(to), y(to));
  }
  append(out, "</svg>\n");
  return out;
}

}  // namespace ridgecraft::export_
