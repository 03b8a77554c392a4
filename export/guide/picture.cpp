// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/polygon.hpp"
#include "export/guide/coloured_areas.hpp"
#include "export/guide/hues.hpp"
#include "export/page/clip_to_box.hpp"
#include "export/view/view.hpp"

namespace ridgecraft::paper {
namespace {

/// Smaller things than this aren't drawn, mm on the page.
constexpr double smallest_drawn_mm = 0.04;
/// What is narrower than this is a stroke, mm on the page: a needle, or a face that the eye has edge-on.
constexpr double stroke_mm = 0.4;
constexpr Color white{0xff, 0xff, 0xff};
constexpr Color ink{0x33, 0x33, 0x38};

std::vector<Vec2> clipped_polygon(std::vector<Vec2> polygon, const Box2& box) {
  polygon = part_where(polygon, [&](Vec2 p) { return p.x - box.low.x; });
  polygon = part_where(polygon, [&](Vec2 p) { return box.high.x - p.x; });
  polygon = part_where(polygon, [&](Vec2 p) { return p.y - box.low.y; });
  return part_where(polygon, [&](Vec2 p) { return box.high.y - p.y; });
}

void add_areas(const Scene& scene, const unfold::Nets& nets, const View& view, const Camera& camera,
               const Fit& fit, const std::optional<Box2>& frame, const LookOf& look, Group& group) {
  const mesh::Surface& surface = *scene.surface;
  for (const VisibleArea& area : view.areas) {
    const PieceLook& piece = look(nets.piece[area.face]);
    const Vec3 normal = surface.normal(area.face);
    const Color color = area.inside ? shaded(piece.inside, -normal, camera, 0.6 * piece.shade)
                                    : shaded(piece.face, normal, camera, piece.shade);
    for (const std::vector<Vec2>& outline : area.outlines) {
      std::vector<Vec2> points;
      for (const Vec2 p : outline) {
        points.push_back(fit(p));
      }
      if (frame) {
        points = clipped_polygon(std::move(points), *frame);
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

void add_lines(const Scene& scene, const unfold::Nets& nets, const View& view, const Camera& camera,
               const Fit& fit, const std::optional<Box2>& frame, const LookOf& look, Group& group) {
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
  const std::vector<double> widths = widths_of_regions(scene, camera, fit);
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
    if (frame) {
      seen = clipped(*seen, *frame);
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
    scene.drawn[edge] =
        nets.use[edge] != unfold::EdgeUse::fold || std::abs(surface.fold_angle(edge)) >= hidden_fold_angle;
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

void add_picture(const Scene& scene, const unfold::Nets& nets, const Camera& camera, const Fit& fit,
                 const std::optional<Box2>& frame, const LookOf& look, Group& group) {
  const View view = look_at(scene, camera, smallest_drawn_mm / fit.scale);
  add_areas(scene, nets, view, camera, fit, frame, look, group);
  add_lines(scene, nets, view, camera, fit, frame, look, group);
}

void add_coloured_picture(const prepare::Prepared& model, const Scene& scene, const unfold::Nets& nets,
                          const Camera& camera, const Fit& fit, Group& group, const Context& context) {
  const View view = look_at(scene, camera, smallest_drawn_mm / fit.scale);
  add_coloured_areas(model, scene, view, camera, fit, group, context);
  // Where pieces meet isn't seen on a finished model.
  const Pen fold{0.06, {0x55, 0x55, 0x5a}};
  const PieceLook plain{white, white, 0.0, {0.2, ink}, fold, fold, 0};
  add_lines(
      scene, nets, view, camera, fit, std::nullopt, [&](PieceId) -> const PieceLook& { return plain; },
      group);
}

}  // namespace ridgecraft::paper
