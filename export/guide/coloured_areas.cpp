// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/coloured_areas.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/polygon.hpp"
#include "export/guide/hues.hpp"
#include "export/paint/cells.hpp"
#include "export/paint/dot_raster.hpp"
#include "export/paint/face_colours.hpp"
#include "export/view/trapezoids.hpp"

namespace ridgecraft::paper {
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
  ColouredAreas(const prepare::Prepared& model, const Scene& scene, const Camera& camera, const Fit& fit,
                Group& group, const Context& context)
      : surface_(model.model.surface),
        look_(*model.look),
        camera_(camera),
        fit_(fit),
        group_(group),
        context_(context),
        colours_(face_colours(surface_, look_, context)) {
    for (const FaceId face : ids<FaceId>(surface_.face_count())) {
      if (scene.has(face)) {
        faces_of_[scene.region[face]].push_back(face);
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

}  // namespace

void add_coloured_areas(const prepare::Prepared& model, const Scene& scene, const View& view,
                        const Camera& camera, const Fit& fit, Group& group, const Context& context) {
  ColouredAreas areas(model, scene, camera, fit, group, context);
  for (const VisibleArea& area : view.areas) {
    areas.add(area);
  }
  areas.finish();
}

}  // namespace ridgecraft::paper
