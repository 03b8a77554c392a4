// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/coloured_areas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "base/polygon.hpp"
#include "export/guide/hues.hpp"
#include "export/paint/cells.hpp"
#include "export/paint/face_colours.hpp"
#include "export/view/trapezoids.hpp"

namespace ridgecraft::paper {
namespace {

/// Squares of a picture on a face, mm on the page: finer ones can't be told apart at arm's length.
constexpr double square_mm = 0.4;
/// Squares reach so far under those that are drawn after them, since viewers that smooth edges show a line
/// where areas only meet, mm.
constexpr double under_mm = 0.3;
/// Neighbours whose channels differ by no more are drawn as one.
constexpr int same_channel = 6;
constexpr double shade = 0.3;
/// Slighter slivers than this aren't drawn, mm2.
constexpr double smallest_area = 1e-4;

Color color_of(const mesh::Rgb& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

bool alike(const mesh::Rgb& a, const mesh::Rgb& b) {
  return std::abs(a[0] - b[0]) <= same_channel && std::abs(a[1] - b[1]) <= same_channel &&
         std::abs(a[2] - b[2]) <= same_channel;
}

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
      }
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
      add_squares(face, at, own, normal);
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

  void add_squares(FaceId face, const std::array<Vec2, 3>& at, const std::vector<Vec2>& polygon,
                   Vec3 normal) {
    context_.check();
    Box2 box;
    for (const Vec2 p : polygon) {
      box.add(p);
    }
    for (double low = square_mm * std::floor(box.low.y / square_mm); low < box.high.y; low += square_mm) {
      const std::vector<Vec2> strip =
          clipped(clipped(polygon, {0.0, low}, {0.0, -1.0}), {0.0, low + square_mm + under_mm}, {0.0, 1.0});
      if (strip.size() > 2) {
        add_row(face, at, strip, low + 0.5 * square_mm, normal);
      }
    }
  }

  /// Squares whose middles lie at this height.
  void add_row(FaceId face, const std::array<Vec2, 3>& at, const std::vector<Vec2>& strip, double middle,
               Vec3 normal) {
    Box2 reach;
    for (const Vec2 p : strip) {
      reach.add(p);
    }
    std::optional<mesh::Rgb> colour;
    double from = reach.low.x;
    const auto draw_run = [&](double to) {
      if (colour) {
        draw(clipped(clipped(strip, {from, 0.0}, {-1.0, 0.0}), {to, 0.0}, {1.0, 0.0}), *colour, normal);
      }
    };
    for (double left = square_mm * std::floor(from / square_mm); left < reach.high.x; left += square_mm) {
      const mesh::Rgb next = colour_at(face, at, {left + 0.5 * square_mm, middle}, normal);
      if (!colour || !alike(*colour, next)) {
        draw_run(left + under_mm);
        colour = next;
        from = left;
      }
    }
    draw_run(reach.high.x);
  }

  /// Of the face's place that is seen here; of the nearest one where the middle of a square lies beside it.
  [[nodiscard]] mesh::Rgb colour_at(FaceId face, const std::array<Vec2, 3>& at, Vec2 p, Vec3 normal) {
    std::array<double, 3> weights = weights_at(at, p);
    double sum = 0.0;
    for (double& weight : weights) {
      weight = std::max(weight, 0.0);
      sum += weight;
    }
    const auto vertices = surface_.vertices(face);
    Vec3 place;
    for (std::size_t k = 0; k < 3; ++k) {
      place += weights[k] / sum * surface_.point(vertices[k]);
    }
    const mesh::LookPlace found = look_.nearest(place, normal, hint_);
    hint_ = found.face;
    return look_.colour_at(found, square_mm / fit_.scale);
  }

  const mesh::Surface& surface_;
  const mesh::Look& look_;
  const Camera& camera_;
  const Fit& fit_;
  Group& group_;
  const Context& context_;
  IdVector<FaceId, FaceColours> colours_;
  std::map<std::uint32_t, std::vector<FaceId>> faces_of_;  ///< of each region
  std::uint32_t hint_ = 0;
};

}  // namespace

void add_coloured_areas(const prepare::Prepared& model, const Scene& scene, const View& view,
                        const Camera& camera, const Fit& fit, Group& group, const Context& context) {
  ColouredAreas areas(model, scene, camera, fit, group, context);
  for (const VisibleArea& area : view.areas) {
    areas.add(area);
  }
}

}  // namespace ridgecraft::paper
