// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/paint.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/elementary.hpp"
#include "base/parallel.hpp"
#include "export/page/obstacles.hpp"
#include "export/paint/cells.hpp"
#include "export/paint/dot_picture.hpp"
#include "export/paint/face_colours.hpp"

namespace ridgecraft::export_ {
namespace {

/// Of a pale colour, the share that is left of it; the rest is white.
constexpr double pale_fraction = 0.35;
constexpr mesh::Rgb white_ground{255, 255, 255};
/// The relative luminance (WCAG 2) on which black and the light tone are seen equally well: 4.2 : 1.
constexpr double middle_light = 0.16;
/// Thin black strokes take more than the 4.5 : 1 of WCAG 2 for body text; light ones look broader than they
/// are. Where neither stands out by as much, they are black with a halo of the light tone: 17 : 1.
constexpr double black_contrast = 6.0;
constexpr double light_contrast = 4.5;
/// Of the light tone that lines and texts have on dark ground.
constexpr double light_of_tone = 0.84;
/// On both sides of a line its ground is looked at so far away, mm, ...
constexpr double beside_mm = 0.3;
/// ... and at places so far from each other, at most so many.
constexpr double tone_step_mm = 2.0;
constexpr double most_tone_steps = 60.0;

Shade shade_of(Ink ink) {
  Shade shade{};
  for (std::size_t value = 0; value < shade.size(); ++value) {
    const double left = ink == Ink::pale ? pale_fraction : 1.0;
    shade[value] =
        static_cast<std::uint8_t>(std::lround(255.0 - left * (255.0 - static_cast<double>(value))));
  }
  return shade;
}

double light_of(const mesh::Rgb& colour) {
  const auto light = [](std::uint8_t channel) {
    const double shown = channel / 255.0;
    return shown <= 0.04045 ? shown / 12.92 : elementary::pow((shown + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * light(colour[0]) + 0.7152 * light(colour[1]) + 0.0722 * light(colour[2]);
}

/// What lies below a line or a text.
struct Ground {
  bool dark = false;
  bool light = false;

  void add(double luminance) { (luminance < middle_light ? dark : light) = true; }
  /// For texts: ground in the middle counts as both.
  void add_for_text(double luminance) {
    constexpr double flare = 0.05;  // WCAG's share of light that every screen and sheet reflects
    add(luminance);
    const bool black_is_seen = luminance + flare >= black_contrast * flare;
    const bool light_is_seen = light_of_tone + flare >= light_contrast * (luminance + flare);
    if (!black_is_seen && !light_is_seen) {
      dark = light = true;
    }
  }
  [[nodiscard]] Tone tone() const { return dark && !light ? Tone::light : Tone::dark; }
  [[nodiscard]] bool needs_halo() const { return dark && light; }
};

class PiecePainter {
 public:
  PiecePainter(const prepare::Prepared& model, const IdVector<FaceId, FaceColours>& colours,
               const Style& style, const DrawnPictures* before)
      : surface_(model.model.surface),
        look_(*model.look),
        colours_(colours),
        style_(style),
        before_(before),
        shade_(shade_of(style.ink)) {}

  /// Returns the piece's picture, if it has one.
  std::optional<DrawnPictures::OfPiece> paint(std::vector<Cell> cells, PieceDrawing& piece,
                                              const Context& context) {
    cells_ = std::move(cells);
    std::vector<const Cell*> pictures;
    std::map<mesh::Rgb, Fill> ground, fills;
    for (const Cell& cell : cells_) {
      const FaceColours& colours = colours_[cell.face];
      if (colours.needs_picture() || (!colours.flat && cell.kind != CellKind::face)) {
        pictures.push_back(&cell);
      } else if (colours.flat) {
        add(cell.kind == CellKind::face ? fills : ground, *colours.flat, cell.polygon);
      } else {
        for (const FaceColours::Fragment& fragment : colours.fragments) {
          std::vector<Vec2> polygon;
          for (const Vec2 w : fragment.polygon) {
            polygon.push_back((1.0 - w.x - w.y) * cell.at[0] + w.x * cell.at[1] + w.y * cell.at[2]);
          }
          add(fills, fragment.colour, std::move(polygon));
        }
      }
    }
    for (auto& [colour, fill] : ground) {
      piece.group.ground.push_back(std::move(fill));
    }
    for (auto& [colour, fill] : fills) {
      piece.group.fills.push_back(std::move(fill));
    }
    std::optional<DrawnPictures::OfPiece> picture;
    if (!pictures.empty()) {
      picture = picture_from(pictures, context);
      piece.group.images.push_back(picture->image);
    }
    uncover_strips(piece);
    set_tones(piece);
    return picture;
  }

 private:
  [[nodiscard]] DrawnPictures::OfPiece picture_from(const std::vector<const Cell*>& pictures,
                                                    const Context& context) const {
    DrawnPictures::OfPiece picture;
    for (const Cell* const cell : pictures) {
      picture.cells.push_back(*cell);
    }
    const Image* const known = before_ == nullptr ? nullptr : before_->find(picture.cells);
    picture.image = known != nullptr
                        ? *known
                        : picture_of(pictures, {surface_, look_, style_.dots_per_inch, shade_}, context);
    return picture;
  }

  void add(std::map<mesh::Rgb, Fill>& fills, const mesh::Rgb& colour, std::vector<Vec2> polygon) const {
    const mesh::Rgb shown = shaded(shade_, colour);
    if (shown == white_ground) {
      return;  // the paper is
    }
    Fill& fill = fills[shown];
    fill.color = {shown[0], shown[1], shown[2]};
    fill.polygons.push_back(std::move(polygon));
  }

  /// The grey of tabs lies over colours: it begins where the strip ends.
  void uncover_strips(PieceDrawing& piece) const {
    for (Area& area : piece.group.areas) {
      if (area.layer != Layer::tab_fill || area.outline.size() < 3) {
        continue;
      }
      const Vec2 base = area.outline[1] - area.outline[0];
      const double size = length(base);
      const Vec2 middle = 0.5 * (area.outline[0] + area.outline[1]);
      const bool striped = std::any_of(cells_.begin(), cells_.end(), [&](const Cell& cell) {
        return cell.kind == CellKind::tab && colour_in(cell, middle) != white_ground &&
               length(0.5 * (cell.polygon[0] + cell.polygon[1]) - middle) < beside_mm;
      });
      if (striped && size > 0.0) {
        const Vec2 out = perpendicular(base) / size;  // a tab runs against the clock, from its base
        area.outline = clipped(area.outline, middle + bleed_mm * out, -out);
      }
    }
    std::erase_if(piece.group.areas, [](const Area& area) { return area.outline.empty(); });
  }

  /// As it is printed.
  [[nodiscard]] mesh::Rgb colour_in(const Cell& cell, Vec2 p) const {
    const FaceColours& colours = colours_[cell.face];
    const mesh::Rgb colour =
        colours.flat
            ? *colours.flat
            : look_.colour_at(look_.nearest(place_on_surface(surface_, cell, p), surface_.normal(cell.face)),
                              1.0);
    return shaded(shade_, colour);
  }

  [[nodiscard]] double light_at(Vec2 p) const {
    const auto holds = [&](const Cell& cell) {
      if (p.x < cell.box.low.x || p.x > cell.box.high.x || p.y < cell.box.low.y || p.y > cell.box.high.y) {
        return false;
      }
      for (std::size_t i = 0; i < cell.polygon.size(); ++i) {
        const Vec2 a = cell.polygon[i];
        if (cross(cell.polygon[(i + 1) % cell.polygon.size()] - a, p - a) < 0.0) {
          return false;
        }
      }
      return true;
    };
    const auto found = std::find_if(cells_.begin(), cells_.end(), holds);
    return found == cells_.end() ? 1.0 : light_of(colour_in(*found, p));
  }

  void add_ground(Vec2 from, Vec2 to, Ground& ground) const {
    const double size = length(to - from);
    if (!(size > 0.0)) {
      return;
    }
    const Vec2 aside = beside_mm * perpendicular(to - from) / size;
    const double steps = std::clamp(std::ceil(size / tone_step_mm), 1.0, most_tone_steps);
    for (double i = 0.5; i < steps; i += 1.0) {
      const Vec2 p = from + i / steps * (to - from);
      ground.add(light_at(p + aside));
      ground.add(light_at(p - aside));
    }
  }

  void set_tones(PieceDrawing& piece) const {
    std::vector<Line> halos;
    for (Line& line : piece.group.lines) {
      Ground ground;
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        add_ground(line.points[i - 1], line.points[i], ground);
      }
      if (line.closed) {
        add_ground(line.points.back(), line.points.front(), ground);
      }
      line.tone = ground.tone();
      if (ground.needs_halo()) {
        Line halo = line;
        halo.layer = Layer::paint;
        halo.like = line.layer == Layer::mark ? line.like : line.layer;
        halos.push_back(std::move(halo));
      }
    }
    std::vector<Text> text_halos;
    for (Text& text : piece.group.texts) {
      Ground ground;
      const TurnedBox box = box_of(text);
      const Vec2 up = perpendicular(box.along);
      for (const double x : {-1.0, -0.33, 0.33, 1.0}) {
        for (const double y : {-1.0, 0.0, 1.0}) {
          ground.add_for_text(
              light_at(box.centre + x * box.half_width * box.along + y * box.half_height * up));
        }
      }
      text.tone = ground.tone();
      if (ground.needs_halo()) {
        text_halos.push_back(text);
        text_halos.back().layer = Layer::paint;
      }
    }
    piece.group.lines.insert(piece.group.lines.end(), halos.begin(), halos.end());
    piece.group.texts.insert(piece.group.texts.end(), text_halos.begin(), text_halos.end());
  }

  const mesh::Surface& surface_;
  const mesh::Look& look_;
  const IdVector<FaceId, FaceColours>& colours_;
  const Style& style_;
  const DrawnPictures* before_;
  Shade shade_;
  std::vector<Cell> cells_;
};

}  // namespace

std::shared_ptr<const DrawnPictures> paint_pieces(const PaintTask& task,
                                                  std::vector<std::vector<PieceDrawing>>& pages,
                                                  const DrawnPictures* before, const Context& context) {
  const prepare::Prepared& model = task.model;
  const Style& style = task.style;
  if (!model.look || style.ink == Ink::lines) {
    return nullptr;
  }
  if (before != nullptr && !before->fit(model.look, style)) {
    before = nullptr;
  }
  const DrawnPictures::Colours found = before != nullptr
                                           ? before->colours()
                                           : std::make_shared<const IdVector<FaceId, FaceColours>>(
                                                 face_colours(model.model.surface, *model.look, context));
  const IdVector<FaceId, FaceColours>& colours = *found;
  auto drawn = std::make_shared<DrawnPictures>(model.look, found, style);
  for (std::size_t page = 0; page < pages.size(); ++page) {
    // Outlines are read by all, and drawings written by each: cells come first.
    std::vector<std::vector<Cell>> cells(pages[page].size());
    do_in_parallel(cells.size(), context, [&](std::size_t i, const Context& own) {
      own.check();
      const PieceId piece = task.ids[page][i];
      cells[i] = cells_of({model, task.nets, piece, task.contents[piece], task.layout.placements[piece]},
                          pages[page], i);
    });
    std::vector<std::optional<DrawnPictures::OfPiece>> pictures(cells.size());
    do_in_parallel(cells.size(), context, [&](std::size_t i, const Context& own) {
      own.check();
      pictures[i] =
          PiecePainter(model, colours, style, before).paint(std::move(cells[i]), pages[page][i], own);
    });
    for (std::optional<DrawnPictures::OfPiece>& picture : pictures) {
      if (picture) {
        drawn->add(std::move(*picture));
      }
    }
  }
  return drawn;
}

}  // namespace ridgecraft::export_
