// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "base/geometry.hpp"
#include "export/page/lines.hpp"
#include "export/paint/cells.hpp"
#include "export/paint/dot_picture.hpp"
#include "export/paint/face_colours.hpp"
#include "export/sheet/pieces.hpp"
#include "export/view/scene.hpp"
#include "export/view/view.hpp"

namespace ridgecraft::export_ {
namespace {

/// Light enough for dark lines and words, and told apart by those who see red and green alike by their
/// lightness. Neighbours in the list are far apart.
constexpr std::array<Color, 12> hues{{{0x7f, 0xb5, 0xde},
                                      {0xf2, 0xb3, 0x5c},
                                      {0x8f, 0xc9, 0x7c},
                                      {0xe9, 0x8a, 0x7c},
                                      {0xb7, 0x9b, 0xd8},
                                      {0xf3, 0xdc, 0x73},
                                      {0x63, 0xc1, 0xb5},
                                      {0xea, 0xa0, 0xc6},
                                      {0xc6, 0xa9, 0x82},
                                      {0x8b, 0x9c, 0xe0},
                                      {0xc3, 0xd4, 0x68},
                                      {0xa9, 0xb9, 0xbf}}};

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

IdVector<PieceId, Color> piece_hues(const mesh::Surface& surface, const unfold::Nets& nets) {
  const auto neighbours = find_neighbours(surface, nets);
  IdVector<PieceId, std::size_t> hue(nets.pieces.size(), hues.size());
  std::array<std::size_t, hues.size()> used{};
  IdVector<PieceId, Color> colors(nets.pieces.size());
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    std::array<bool, hues.size()> beside{};
    for (const Neighbour& neighbour : neighbours[piece]) {
      if (hue[neighbour.piece] < hues.size()) {
        beside[hue[neighbour.piece]] = true;
      }
    }
    std::size_t best = 0;
    for (std::size_t h = 1; h < hues.size(); ++h) {
      if (std::pair(beside[h], used[h]) < std::pair(beside[best], used[best])) {
        best = h;
      }
    }
    hue[piece] = best;
    ++used[best];
    colors[piece] = hues[best];
  }
  return colors;
}

FaceLight::FaceLight(Vec3 normal, const Camera& camera, double depth) {
  const Vec3 light = normalized(0.75 * camera.toward + 0.6 * camera.up - 0.45 * camera.right);
  const double lit = std::max(0.0, dot(normal, light));
  fraction_ = 1.0 - depth + depth * lit;
  // The brightest faces are a little lighter than the hue.
  lighter_ = 0.35 * depth * lit * lit;
}

Color FaceLight::on(Color hue) const {
  const Color lighter = mixed(hue, {0xff, 0xff, 0xff}, lighter_);
  return {channel(fraction_ * lighter.red), channel(fraction_ * lighter.green),
          channel(fraction_ * lighter.blue)};
}

Color shaded(Color hue, Vec3 normal, const Camera& camera, double depth) {
  return FaceLight(normal, camera, depth).on(hue);
}

Color mixed(Color a, Color b, double fraction) {
  const auto mix = [fraction](std::uint8_t x, std::uint8_t y) {
    return channel((1.0 - fraction) * x + fraction * y);
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

namespace {

/// Of what pictures show, 200 an inch: finer ones can't be told apart at arm's length.
constexpr double dots_per_mm = 200.0 / 25.4;
/// So many dots beyond the border of what is seen are painted, too: what mixes dots finds the same colour
/// there.
constexpr double overhang_dots = 1.5;
constexpr double shade = 0.3;
/// Slighter slivers than this aren't drawn, mm2.
constexpr double smallest_area = 1e-4;

Color color_of(const mesh::Rgb& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

/// A convex counterclockwise polygon's sides.
class Sides {
 public:
  explicit Sides(const std::vector<Vec2>& polygon) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 side = polygon[(k + 1) % polygon.size()] - polygon[k];
      if (const double size = length(side); size > 0.0) {
        sides_.push_back({polygon[k], -perpendicular(side) / size});
      }
    }
  }

  /// How far outside a place lies at least; not positive inside.
  [[nodiscard]] double distance_from(Vec2 p) const {
    double most = -INFINITY;
    for (const auto& [at, out] : sides_) {
      most = std::max(most, dot(p - at, out));
    }
    return most;
  }

 private:
  std::vector<std::pair<Vec2, Vec2>> sides_;  ///< a point, and which way is out
};

/// What two convex counterclockwise polygons have in common.
std::vector<Vec2> common_part(std::vector<Vec2> polygon, const std::vector<Vec2>& other) {
  for (std::size_t k = 0; k < other.size() && polygon.size() > 2; ++k) {
    const Vec2 side = other[(k + 1) % other.size()] - other[k];
    polygon = clipped(polygon, other[k], {side.y, -side.x});
  }
  return polygon;
}

class ColouredAreas {
 public:
  ColouredAreas(const prepare::Prepared& model, const Picture& picture, Group& group, const Context& context)
      : surface_(model.model.surface),
        look_(*model.look),
        camera_(picture.camera),
        fit_(picture.fit),
        group_(group),
        context_(context),
        colours_(face_colours(surface_, look_, context)) {
    for (const FaceId face : ids<FaceId>(surface_.face_count())) {
      if (picture.scene.has(face)) {
        faces_of_[picture.scene.region[face]].push_back(face);
        for (const VertexId v : surface_.vertices(face)) {
          corners_.push_back(camera_(surface_.point(v)));
        }
      }
    }
  }

  /// What was seen of pictures comes below all areas.
  void finish() {
    if (dots_) {
      dots_->fill_up();
      Image image = dots_->image();
      image.clip = std::move(clip_);
      group_.images.push_back(std::move(image));
    }
  }

  void add(const VisibleArea& area) {
    const std::vector<FaceId>& faces = faces_of_.at(area.region);
    const Vec3 normal = surface_.normal(area.face);
    std::optional<mesh::Rgb> one = colours_[faces.front()].flat;
    for (const FaceId face : faces) {
      one = colours_[face].flat == one ? one : std::nullopt;
    }
    for (const std::vector<Vec2>& seen : area.outlines) {
      std::vector<Vec2> outline;
      for (const Vec2 p : seen) {
        outline.push_back(fit_(p));
      }
      if (area.inside) {
        // Paper is white on its back.
        draw(std::move(outline), {255, 255, 255}, -normal);
      } else if (one) {
        draw(std::move(outline), *one, normal);
      } else {
        for (const std::vector<Vec2>& part : trapezoids(outline)) {
          for (const FaceId face : faces) {
            add_face(face, part, normal);
          }
        }
      }
    }
  }

 private:
  void draw(std::vector<Vec2> outline, const mesh::Rgb& colour, Vec3 normal) {
    if (outline.size() > 2 && std::abs(doubled_area(outline)) > smallest_area) {
      group_.areas.push_back(
          {Layer::picture, std::move(outline), shaded(color_of(colour), normal, camera_, shade)});
    }
  }

  /// The face's share of a convex part of what is seen.
  void add_face(FaceId face, const std::vector<Vec2>& part, Vec3 normal) {
    std::array<Vec2, 3> at;
    const auto vertices = surface_.vertices(face);
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = fit_(camera_(surface_.point(vertices[k])));
    }
    const std::vector<Vec2> own = common_part(part, {at.begin(), at.end()});
    if (own.size() < 3) {
      return;
    }
    const FaceColours& colours = colours_[face];
    if (colours.flat) {
      draw(own, *colours.flat, normal);
    } else if (colours.needs_picture()) {
      add_dots(face, at, own, normal);
    } else {
      for (const FaceColours::Fragment& fragment : colours.fragments) {
        std::vector<Vec2> polygon;
        for (const Vec2 w : fragment.polygon) {
          polygon.push_back(at[0] + w.x * (at[1] - at[0]) + w.y * (at[2] - at[0]));
        }
        draw(common_part(own, polygon), fragment.colour, normal);
      }
    }
  }

  /// The dots of a part of a face with a picture.
  void add_dots(FaceId face, const std::array<Vec2, 3>& at, const std::vector<Vec2>& polygon, Vec3 normal) {
    context_.check();
    if (!dots_) {
      Box2 box;
      for (const Vec2 p : corners_) {
        box.add(fit_(p));
      }
      dots_.emplace(box, dots_per_mm);
    }
    Box2 box;
    for (const Vec2 p : polygon) {
      box.add(p);
    }
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = surface_.point(surface_.vertices(face)[k]);
    }
    std::optional<mesh::TriangleColours> colours;
    if (const auto under = look_.face_under(corners, normal)) {
      colours = look_.colours_of(*under, corners, dot_on_surface());
    }
    const Sides sides(polygon);
    const FaceLight light(normal, camera_, shade);
    const double beyond = overhang_dots / dots_per_mm;
    const int right = std::min(dots_->width() - 1, dots_->column(box.high.x + beyond));
    const int high = std::min(dots_->height() - 1, dots_->row(box.high.y + beyond));
    for (int y = std::max(0, dots_->row(box.low.y - beyond)); y <= high; ++y) {
      for (int x = std::max(0, dots_->column(box.low.x - beyond)); x <= right; ++x) {
        const Vec2 p = dots_->middle(x, y);
        const double away = sides.distance_from(p);
        if (away <= 0.0 || (away <= beyond && !dots_->painted(x, y))) {
          const std::array<double, 3> weights = kept_within(weights_at(at, p));
          const mesh::Rgb found = colours ? colours->at(weights) : colour_at(corners, weights, normal);
          const Color colour = light.on(color_of(found));
          dots_->paint(x, y, {colour.red, colour.green, colour.blue});
        }
      }
    }
    clip_.push_back(polygon);
  }

  [[nodiscard]] double dot_on_surface() const { return 1.0 / (dots_per_mm * fit_.scale); }

  [[nodiscard]] mesh::Rgb colour_at(const std::array<Vec3, 3>& corners, const std::array<double, 3>& weights,
                                    Vec3 normal) {
    const Vec3 place = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    const mesh::LookPlace found = look_.nearest(place, normal, hint_);
    hint_ = found.face;
    return look_.colour_at(found, dot_on_surface());
  }

  const mesh::Surface& surface_;
  const mesh::Look& look_;
  const Camera& camera_;
  const Fit& fit_;
  Group& group_;
  const Context& context_;
  IdVector<FaceId, FaceColours> colours_;
  std::map<std::uint32_t, std::vector<FaceId>> faces_of_;  ///< of each region
  std::vector<Vec2> corners_;                              ///< of all faces, as the camera sees them
  std::optional<DotRaster> dots_;
  std::vector<std::vector<Vec2>> clip_;
  std::uint32_t hint_ = 0;
};

/// Smaller things than this aren't drawn, mm on the page.
constexpr double smallest_drawn_mm = 0.04;
/// What is narrower than this is a stroke, mm on the page: a needle, or a face that the eye has edge-on.
constexpr double stroke_mm = 0.4;
constexpr Color white{0xff, 0xff, 0xff};
constexpr Color ink{0x33, 0x33, 0x38};

void add_areas(const Picture& picture, const View& view, const LookOf& look, Group& group) {
  const mesh::Surface& surface = *picture.scene.surface;
  for (const VisibleArea& area : view.areas) {
    const PieceLook& piece = look(picture.nets.piece[area.face]);
    const Vec3 normal = surface.normal(area.face);
    const Color color = area.inside ? shaded(piece.inside, -normal, picture.camera, 0.6 * piece.shade)
                                    : shaded(piece.face, normal, picture.camera, piece.shade);
    for (const std::vector<Vec2>& outline : area.outlines) {
      std::vector<Vec2> points;
      for (const Vec2 p : outline) {
        points.push_back(picture.fit(p));
      }
      if (picture.frame) {
        points = clipped(std::move(points), *picture.frame);
      }
      if (points.size() > 2) {
        group.areas.push_back({Layer::picture, std::move(points), color});
      }
    }
  }
}

/// How wide the widest face of each flat region is seen, mm on the page.
std::vector<double> widths_of_regions(const Scene& scene, const Camera& camera, const Fit& fit) {
  std::vector<double> widths;
  for (const FaceId face : ids<FaceId>(scene.surface->face_count())) {
    if (!scene.has(face)) {
      continue;
    }
    std::array<Vec2, 3> seen;
    for (unsigned k = 0; k < 3; ++k) {
      seen[k] = fit(camera(scene.surface->point(scene.surface->vertices(face)[k])));
    }
    const double longest =
        std::max({length(seen[1] - seen[0]), length(seen[2] - seen[1]), length(seen[0] - seen[2])});
    const double width =
        longest > 0.0 ? std::abs(cross(seen[1] - seen[0], seen[2] - seen[0])) / longest : 0.0;
    const std::uint32_t region = scene.region[face];
    widths.resize(std::max(widths.size(), std::size_t{region} + 1), 0.0);
    widths[region] = std::max(widths[region], width);
  }
  return widths;
}

void add_lines(const Picture& picture, const View& view, const LookOf& look, Group& group) {
  const Scene& scene = picture.scene;
  const unfold::Nets& nets = picture.nets;
  const Fit& fit = picture.fit;
  const mesh::Surface& surface = *scene.surface;
  // Of each line the look of the piece that draws it.
  std::vector<std::pair<const PieceLook*, const VisibleLine*>> lines;
  for (const VisibleLine& line : view.lines) {
    const PieceLook* best = nullptr;
    for (const CornerId side : surface.sides(line.edge)) {
      if (side.valid() && scene.has(mesh::face_of(side))) {
        const PieceLook& own = look(nets.piece[mesh::face_of(side)]);
        best = best == nullptr || own.rank > best->rank ? &own : best;
      }
    }
    lines.emplace_back(best, &line);
  }
  const std::vector<double> widths = widths_of_regions(scene, picture.camera, fit);
  const auto is_stroke = [&](const VisibleLine& line) {
    return std::ranges::all_of(surface.sides(line.edge), [&](CornerId side) {
      return !side.valid() || !scene.has(mesh::face_of(side)) ||
             widths[scene.region[mesh::face_of(side)]] < stroke_mm;
    });
  };
  const auto is_fold = [&](const VisibleLine& line) {
    return !line.outline && nets.use[line.edge] == unfold::EdgeUse::fold;
  };
  std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) {
    return std::pair(a.first->rank, !is_fold(*a.second)) < std::pair(b.first->rank, !is_fold(*b.second));
  });
  for (const auto& [piece, line] : lines) {
    std::optional<Segment2> seen = Segment2{fit(line->a), fit(line->b)};
    if (picture.frame) {
      seen = clipped(*seen, *picture.frame);
    }
    if (seen) {
      Line drawn{Layer::picture, {seen->a, seen->b}};
      drawn.pen = is_fold(*line) || is_stroke(*line) ? piece->fold
                  : line->outline                    ? piece->outline
                                                     : piece->seam;
      group.lines.push_back(std::move(drawn));
    }
  }
}

}  // namespace

PieceLook coloured_look(Color hue) {
  return {hue, mixed(hue, white, 0.72), 0.34, {0.26, ink}, {0.22, ink}, {0.09, mixed(hue, ink, 0.75)}, 1};
}

PieceLook pale_look() {
  constexpr Color paper{0xf4, 0xf3, 0xf0};
  constexpr Color grey{0x95, 0x95, 0x95};
  return {
      paper, {0xe2, 0xe0, 0xdb}, 0.13, {0.16, grey}, {0.12, {0xa8, 0xa8, 0xa8}}, {0.05, {0xc4, 0xc4, 0xc4}},
      0};
}

Scene scene_of(const prepare::Prepared& model, const unfold::Nets& nets, double hidden_fold_angle) {
  const mesh::Surface& surface = model.model.surface;
  Scene scene;
  scene.surface = &surface;
  scene.region.resize(surface.face_count());
  std::map<std::pair<PieceId, PanelId>, std::uint32_t> numbers;
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    scene.region[face] = numbers
                             .try_emplace({nets.piece[face], model.panels.panel[face]},
                                          static_cast<std::uint32_t>(numbers.size()))
                             .first->second;
  }
  scene.drawn.resize(surface.edge_count());
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    scene.drawn[edge] = nets.use[edge] != unfold::EdgeUse::fold ||
                        (std::abs(surface.fold_angle(edge)) >= hidden_fold_angle && !model.rolls.bends(edge));
  }
  return scene;
}

Scene scene_with(const Scene& whole, const unfold::Nets& nets, const IdVector<PieceId, bool>& shown) {
  Scene scene = whole;
  for (const FaceId face : ids<FaceId>(scene.region.size())) {
    if (!shown[nets.piece[face]]) {
      scene.region[face] = Scene::hidden_region;
    }
  }
  return scene;
}

Fit fit_into(const Box2& seen, const Box2& frame) {
  const Vec2 size = seen.size();
  const Vec2 room = frame.size();
  return fit_at_scale(seen, std::min(room.x / std::max(size.x, 1e-9), room.y / std::max(size.y, 1e-9)),
                      frame);
}

Fit fit_at_scale(const Box2& seen, double scale, const Box2& frame) {
  return {scale, 0.5 * (frame.low + frame.high) - scale * 0.5 * (seen.low + seen.high)};
}

void add_picture(const Picture& picture, const LookOf& look, Group& group, const Context& context) {
  const View view = look_at(picture.scene, picture.camera, smallest_drawn_mm / picture.fit.scale, context);
  add_areas(picture, view, look, group);
  add_lines(picture, view, look, group);
}

void add_coloured_picture(const prepare::Prepared& model, const Picture& picture, Group& group,
                          const Context& context) {
  const View view = look_at(picture.scene, picture.camera, smallest_drawn_mm / picture.fit.scale, context);
  ColouredAreas areas(model, picture, group, context);
  for (const VisibleArea& area : view.areas) {
    areas.add(area);
  }
  areas.finish();
  // Where pieces meet isn't seen on a finished model.
  const Pen fold{0.06, {0x55, 0x55, 0x5a}};
  const PieceLook plain{white, white, 0.0, {0.2, ink}, fold, fold, 0};
  add_lines(
      picture, view, [&](PieceId) -> const PieceLook& { return plain; }, group);
}

}  // namespace ridgecraft::export_
