// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/elementary.hpp"

namespace ridgecraft::export_ {

Camera look_from(const Stance& stance, double azimuth, double elevation) {
  const Vec3 side = cross(stance.up, stance.front);
  const Vec3 level = elementary::cos(azimuth) * stance.front + elementary::sin(azimuth) * side;
  Camera camera;
  camera.toward = elementary::cos(elevation) * level + elementary::sin(elevation) * stance.up;
  camera.right = elementary::cos(azimuth) * side - elementary::sin(azimuth) * stance.front;
  camera.up = cross(camera.toward, camera.right);
  return camera;
}

namespace {

/// What a model stands on lies within this share of its height from the lowest point.
constexpr double ground_fraction = 0.01;
/// Feet are what lies within this share of its height.
constexpr double feet_fraction = 0.04;
/// Faces are level when their normal is up or down but for this (as a cosine).
constexpr double level_cosine = 0.98;
/// Flat ground tells more than feet: what lies has some, too.
constexpr double flat_weight = 2.0;
/// What doesn't stand lies or swims: along the longer one of two axes whose extents differ by this share.
constexpr double longer_fraction = 0.75;
/// Standing shares that differ by less tell nothing.
constexpr double better = 0.15;
/// Modellers put the origin at the foot of what they make, in its middle: within this share of its height ...
constexpr double foot_fraction = 0.1;
/// ... and no nearer to its sides than this share of its extents.
constexpr double middle_fraction = 0.25;
/// Corners are mirrored where an image lies this near to one, as a share of the extent; so many are looked
/// at.
constexpr double same_corner = 1e-4;
constexpr std::size_t most_mirrored = 2000;
/// Sides are alike where this share of the corners is mirrored, and unlike below the other one.
constexpr double sides_alike = 0.98;
constexpr double sides_unlike = 0.5;
/// Against what is usual for the format it takes so much more.
constexpr double much_better = 0.6;

double coordinate(Vec3 p, mesh::Axis axis) {
  return axis == mesh::Axis::x ? p.x : axis == mesh::Axis::y ? p.y : p.z;
}

/// How well a model stands, were this axis up: the area of its flat ground, less that of a flat top (walls
/// have another one across from them, ground mostly hasn't), and the box round all that is near the ground
/// (feet), both as shares of its footprint.
double standing_fraction(const mesh::Surface& surface, mesh::Axis axis) {
  const Box3& box = surface.bounds();
  const double bottom = coordinate(box.low, axis);
  const double height = coordinate(box.size(), axis);
  const double near = ground_fraction * height;
  Box3 feet;
  for (const Vec3 p : surface.points()) {
    if (coordinate(p, axis) <= bottom + feet_fraction * height) {
      feet.add(p);
    }
  }
  double ground = 0.0;
  double top = 0.0;
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    const auto vertices = surface.vertices(face);
    const double up = coordinate(surface.normal(face), axis);
    if (up < -level_cosine && std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) {
          return coordinate(surface.point(v), axis) <= bottom + near;
        })) {
      ground += surface.area(face);
    } else if (up > level_cosine && std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) {
                 return coordinate(surface.point(v), axis) >= bottom + height - near;
               })) {
      top += surface.area(face);
    }
  }
  const auto level = [axis](Vec3 size) {
    return axis == mesh::Axis::x   ? size.y * size.z
           : axis == mesh::Axis::y ? size.x * size.z
                                   : size.x * size.y;
  };
  const double footprint = level(box.size());
  return footprint > 0.0 ? (flat_weight * std::max(0.0, ground - top) + level(feet.size())) / footprint : 0.0;
}

/// Whether the model's origin lies at its foot, were this axis up.
bool stands_at_origin(const mesh::Surface& surface, mesh::Axis axis) {
  const Box3& box = surface.bounds();
  return std::ranges::all_of(std::array{mesh::Axis::x, mesh::Axis::y, mesh::Axis::z}, [&](mesh::Axis a) {
    const double size = coordinate(box.size(), a);
    const double origin = size > 0.0 ? -coordinate(box.low, a) / size : 0.5;
    return a == axis ? std::abs(origin) <= foot_fraction
                     : origin >= middle_fraction && origin <= 1.0 - middle_fraction;
  });
}

/// Of some corners the share whose mirror images across the middle of the box along an axis are corners, too.
double mirrored_fraction(const mesh::Surface& surface, mesh::Axis axis) {
  const Box3& box = surface.bounds();
  const double near = same_corner * box.largest_extent();
  if (near <= 0.0) {
    return 0.0;
  }
  const double middle = coordinate(box.low, axis) + coordinate(box.high, axis);
  const auto cell = [&](Vec3 p) {
    const Vec3 q = (p - box.low) / near;
    return std::array{std::llround(q.x), std::llround(q.y), std::llround(q.z)};
  };
  std::vector<std::array<long long, 3>> corners;
  for (const Vec3 p : surface.points()) {
    corners.push_back(cell(p));
  }
  std::sort(corners.begin(), corners.end());
  const auto is_near_corner = [&](const std::array<long long, 3>& at) {
    for (long long x = at[0] - 1; x <= at[0] + 1; ++x) {
      for (long long y = at[1] - 1; y <= at[1] + 1; ++y) {
        const auto found = std::lower_bound(corners.begin(), corners.end(), std::array{x, y, at[2] - 1});
        if (found != corners.end() && (*found)[0] == x && (*found)[1] == y && (*found)[2] <= at[2] + 1) {
          return true;
        }
      }
    }
    return false;
  };
  const std::size_t step = std::max<std::size_t>(1, surface.vertex_count() / most_mirrored);
  std::size_t tried = 0;
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < surface.vertex_count(); i += step) {
    Vec3 p = surface.points()[i];
    double& along = axis == mesh::Axis::x ? p.x : axis == mesh::Axis::y ? p.y : p.z;
    along = middle - along;
    ++tried;
    mirrored += is_near_corner(cell(p)) ? 1U : 0U;
  }
  return tried > 0 ? static_cast<double>(mirrored) / static_cast<double>(tried) : 0.0;
}

/// What has a left and a right side, which are mirror images, and nothing else that is mirrored: its sides
/// aren't its top and its bottom. But those of a plate may be.
bool is_left_and_right(const mesh::Surface& surface, mesh::Axis axis) {
  const Vec3 size = surface.bounds().size();
  const double other = axis == mesh::Axis::y ? std::min(size.x, size.z) : std::min(size.x, size.y);
  if (coordinate(size, axis) < longer_fraction * other) {
    return false;
  }
  for (const mesh::Axis a : {mesh::Axis::x, mesh::Axis::y, mesh::Axis::z}) {
    const double fraction = mirrored_fraction(surface, a);
    if (a == axis ? fraction < sides_alike : fraction > sides_unlike) {
      return false;
    }
  }
  return true;
}

mesh::Axis usual_up(mesh::FileFormat format) {
  switch (format) {
    case mesh::FileFormat::stl_ascii:
    case mesh::FileFormat::stl_binary:
    case mesh::FileFormat::ply_ascii:
    case mesh::FileFormat::ply_binary:
    case mesh::FileFormat::off:
    case mesh::FileFormat::threemf:
      return mesh::Axis::z;
    default:
      return mesh::Axis::y;
  }
}

}  // namespace

mesh::Axis up_axis_of(const mesh::Model& model) {
  if (model.frame.up) {
    return *model.frame.up;
  }
  const mesh::Axis usual = usual_up(model.format);
  const mesh::Axis other = usual == mesh::Axis::y ? mesh::Axis::z : mesh::Axis::y;
  const double on_usual = standing_fraction(model.surface, usual);
  const double on_other = standing_fraction(model.surface, other);
  if (on_other > on_usual + much_better) {
    return other;
  }
  if (on_usual > on_other + better) {
    return usual;
  }
  for (const mesh::Axis axis : {usual, other}) {
    if (is_left_and_right(model.surface, axis)) {
      return axis == usual ? other : usual;
    }
  }
  for (const mesh::Axis axis : {usual, other}) {
    if (stands_at_origin(model.surface, axis)) {
      return axis;
    }
  }
  const Vec3 size = model.surface.bounds().size();
  if (std::min(size.y, size.z) < longer_fraction * std::max(size.y, size.z)) {
    return size.y < size.z ? mesh::Axis::y : mesh::Axis::z;
  }
  return usual;
}

Stance stance_of(const mesh::Model& model) {
  return stance_of(up_axis_of(model));
}

Stance stance_of(mesh::Axis up) {
  switch (up) {
    case mesh::Axis::x:
      return {{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    case mesh::Axis::z:
      return {{0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}};
    case mesh::Axis::y:
      break;
  }
  return {{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
}

Vec3 standing_size(const mesh::Surface& surface, const Stance& stance) {
  Box3 box;
  const Vec3 side = cross(stance.up, stance.front);
  for (const Vec3 p : surface.points()) {
    box.add({dot(side, p), dot(stance.front, p), dot(stance.up, p)});
  }
  return box.size();
}

}  // namespace ridgecraft::export_
