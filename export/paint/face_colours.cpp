// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/face_colours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/geometry.hpp"
#include "base/parallel.hpp"
#include "export/paint/cells.hpp"

namespace ridgecraft::export_ {
namespace {

/// Original faces no farther from a face's plane lie in it, mm.
constexpr double in_plane_mm = 0.03;
/// ... if their normals differ by less than 8 degrees.
constexpr double same_normal = 0.99;
/// The areas of what lies in a face may differ from its own by this share.
constexpr double same_area = 0.004;
constexpr double sample_step_mm = 1.0;
constexpr double most_samples_a_side = 40.0;
/// Channels of samples that are one colour differ by no more.
constexpr int same_channel = 6;
constexpr std::size_t faces_a_task = 64;

bool alike(const mesh::Rgb& a, const mesh::Rgb& b) {
  return std::abs(a[0] - b[0]) <= same_channel && std::abs(a[1] - b[1]) <= same_channel &&
         std::abs(a[2] - b[2]) <= same_channel;
}

class FaceReader {
 public:
  FaceReader(const mesh::Surface& surface, const mesh::Look& look, FaceId f)
      : look_(look), normal_(surface.normal(f)) {
    const auto vertices = surface.vertices(f);
    for (std::size_t k = 0; k < 3; ++k) {
      corners_[k] = surface.point(vertices[k]);
    }
    u_ = corners_[1] - corners_[0];
    v_ = corners_[2] - corners_[0];
  }

  [[nodiscard]] FaceColours read() const {
    FaceColours colours;
    if (normal_ == Vec3{}) {
      colours.flat = look_.flat_colour(look_.nearest(corners_[0], normal_).face);
      colours.flat = colours.flat.value_or(mesh::Rgb{255, 255, 255});
      return colours;
    }
    if (auto covered = covering()) {
      const bool one = std::all_of(covered->begin(), covered->end(),
                                   [&](const auto& part) { return part.colour == covered->front().colour; });
      if (one) {
        colours.flat = covered->front().colour;
      } else {
        colours.fragments = std::move(*covered);
      }
      return colours;
    }
    colours.flat = sampled();
    return colours;
  }

 private:
  /// Weights of the second and third corner at a point's foot in the plane.
  [[nodiscard]] Vec2 weights_of(Vec3 p) const {
    const Vec3 d = p - corners_[0];
    const Vec3 doubled = cross(u_, v_);
    const double squared = dot(doubled, doubled);
    return {dot(cross(d, v_), doubled) / squared, dot(cross(u_, d), doubled) / squared};
  }

  /// The original faces of one colour that lie in the face; nothing where they don't cover it just once, or
  /// there is a picture on them.
  [[nodiscard]] std::optional<std::vector<FaceColours::Fragment>> covering() const {
    Box3 box;
    for (const Vec3 p : corners_) {
      box.add(p - Vec3{in_plane_mm, in_plane_mm, in_plane_mm});
      box.add(p + Vec3{in_plane_mm, in_plane_mm, in_plane_mm});
    }
    std::vector<std::uint32_t> found;
    look_.near_box(box, [&](std::uint32_t g) { found.push_back(g); });
    std::sort(found.begin(), found.end());
    std::vector<FaceColours::Fragment> fragments;
    double area = 0.0;
    for (const std::uint32_t g : found) {
      const mesh::LookFace& face = look_.faces()[g];
      if (dot(face.normal, normal_) < same_normal) {
        continue;
      }
      std::vector<Vec2> polygon;
      for (const Vec3 p : face.corners) {
        polygon.push_back(weights_of(p));
      }
      for (const auto& [at, out] :
           {std::pair{Vec2{0, 0}, Vec2{-1, 0}}, {Vec2{0, 0}, Vec2{0, -1}}, {Vec2{1, 0}, Vec2{1, 1}}}) {
        polygon = clipped(polygon, at, out);
      }
      const double doubled = polygon.empty() ? 0.0 : doubled_area(polygon);
      if (!(doubled > 1e-9) || !in_plane(face, polygon)) {
        continue;
      }
      if (!look_.flat_colour(g)) {
        return std::nullopt;
      }
      area += doubled;
      fragments.push_back({std::move(polygon), *look_.flat_colour(g)});
    }
    return std::abs(area - 1.0) < same_area ? std::optional(std::move(fragments)) : std::nullopt;
  }

  /// Whether the part of an original face that lies over the polygon lies in the plane.
  [[nodiscard]] bool in_plane(const mesh::LookFace& face, const std::vector<Vec2>& polygon) const {
    return std::all_of(polygon.begin(), polygon.end(), [&](Vec2 w) {
      const Vec3 p = corners_[0] + w.x * u_ + w.y * v_;
      return std::abs(dot(face.corners[0] - p, face.normal)) <= in_plane_mm * same_normal;
    });
  }

  [[nodiscard]] std::optional<mesh::Rgb> sampled() const {
    const double longest = std::max({length(u_), length(v_), length(u_ - v_)});
    const auto steps =
        static_cast<int>(std::clamp(std::ceil(longest / sample_step_mm), 2.0, most_samples_a_side));
    std::optional<mesh::Rgb> first;
    std::uint32_t hint = 0;
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; i + j < steps; ++j) {
        const double second = (i + 1.0 / 3.0) / steps;
        const double third = (j + 1.0 / 3.0) / steps;
        const mesh::LookPlace place = look_.nearest(corners_[0] + second * u_ + third * v_, normal_, hint);
        hint = place.face;
        const std::optional<mesh::Rgb>& colour = look_.flat_colour(place.face);
        if (!colour || (first && !alike(*first, *colour))) {
          return std::nullopt;
        }
        first = first ? first : colour;
      }
    }
    return first;
  }

  const mesh::Look& look_;
  Vec3 normal_;
  std::array<Vec3, 3> corners_;
  Vec3 u_, v_;
};

}  // namespace

IdVector<FaceId, FaceColours> face_colours(const mesh::Surface& surface, const mesh::Look& look,
                                           const Context& context) {
  IdVector<FaceId, FaceColours> colours(surface.face_count());
  const std::size_t tasks = (surface.face_count() + faces_a_task - 1) / faces_a_task;
  do_in_parallel(tasks, context, [&](std::size_t task, const Context& own) {
    own.check();
    const std::size_t last = std::min(surface.face_count(), (task + 1) * faces_a_task);
    for (std::size_t i = task * faces_a_task; i < last; ++i) {
      colours[FaceId(i)] = FaceReader(surface, look, FaceId(i)).read();
    }
  });
  return colours;
}

}  // namespace ridgecraft::export_
