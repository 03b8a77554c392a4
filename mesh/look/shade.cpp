// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/shade.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/rays.hpp"
#include "mesh/look/relief.hpp"

namespace ridgecraft::mesh {
namespace {

/// Light comes from so many directions, half of which lie behind a face: noise of a twentieth.
constexpr int directions = 64;
/// Faces farther off take no light, share of the extent: the shade is that of hollows, not of limbs.
constexpr double reach_share = 0.1;
/// Sides of faces are divided to this share of the extent: 3 mm at the usual size.
constexpr double side_share = 0.02;
/// What no light comes to keeps this share of its colour, so that lines on it are seen.
constexpr double darkest = 0.4;
/// Places lie so far within their face and above it, shares of the way to its middle and of the extent.
constexpr double inwards = 0.1;
constexpr double above_share = 1e-4;
constexpr std::size_t faces_a_task = 256;

using Corners = std::array<Rgb, 3>;

Rgb mean(const Rgb& a, const Rgb& b) {
  Rgb middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = static_cast<std::uint8_t>((a[k] + b[k] + 1) / 2);
  }
  return middle;
}

/// Halves a face across its longest side until that is short enough.
void divide(LookFace face, double longest, std::vector<LookFace>& into) {
  std::size_t k = 0;
  const auto size = [&](std::size_t i) { return length(face.corners[(i + 1) % 3] - face.corners[i]); };
  for (std::size_t i = 1; i < 3; ++i) {
    k = size(i) > size(k) ? i : k;
  }
  if (size(k) <= longest) {
    into.push_back(face);
    return;
  }
  const std::size_t next = (k + 1) % 3;
  LookFace other = face;
  other.corners[k] = face.corners[next] = 0.5 * (face.corners[k] + face.corners[next]);
  (*other.colours)[k] = (*face.colours)[next] = mean((*face.colours)[k], (*face.colours)[next]);
  divide(face, longest, into);
  divide(other, longest, into);
}

class Shade {
 public:
  Shade(const Relief& relief, double extent) : relief_(relief), extent_(extent) {}

  void darken(LookFace& face) const {
    const Vec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 place = face.corners[k] + inwards * (middle - face.corners[k]);
      const double kept =
          darkest + (1.0 - darkest) * light_at(place + above_share * extent_ * face.normal, face.normal);
      for (std::uint8_t& channel : (*face.colours)[k]) {
        channel = static_cast<std::uint8_t>(std::lround(kept * channel));
      }
    }
  }

 private:
  /// The share of the light from around that comes to a place, by the cosine at which it does.
  [[nodiscard]] double light_at(Vec3 place, Vec3 normal) const {
    double all = 0.0;
    double free = 0.0;
    for (int i = 0; i < directions; ++i) {
      const Vec3 way = even_direction(i, directions);
      const double light = dot(way, normal);
      if (light > 0.0) {
        all += light;
        free += relief_.hides(place, reach_share * extent_ * way) ? 0.0 : light;
      }
    }
    return all > 0.0 ? free / all : 1.0;
  }

  const Relief& relief_;
  double extent_;
};

}  // namespace

LookParts white_look(const Surface& surface) {
  LookParts parts;
  parts.paints.emplace_back();
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (surface.normal(f) != Vec3{}) {
      const auto [a, b, c] = surface.vertices(f);
      LookFace face;
      face.corners = {surface.point(a), surface.point(b), surface.point(c)};
      face.normal = surface.normal(f);
      parts.faces.push_back(face);
    }
  }
  return parts;
}

void add_shade(LookParts& parts, const Context& context) {
  ReliefParts shapes;
  Box3 bounds;
  for (const LookFace& face : parts.faces) {
    shapes.faces.push_back(face.corners);
    std::for_each(face.corners.begin(), face.corners.end(), [&](Vec3 p) { bounds.add(p); });
  }
  const double extent = bounds.largest_extent();
  const Relief relief(std::move(shapes));
  std::vector<LookFace> divided;
  for (LookFace& face : parts.faces) {
    const Paint& paint = parts.paints[face.paint];
    if (paint.picture) {
      divided.push_back(face);
      continue;
    }
    face.colours = face.colours.value_or(Corners{paint.colour, paint.colour, paint.colour});
    divide(face, side_share * extent, divided);
  }
  parts.faces = std::move(divided);
  const Shade shade(relief, extent);
  do_in_parallel((parts.faces.size() + faces_a_task - 1) / faces_a_task, context,
                 [&](std::size_t task, const Context& own) {
                   own.check();
                   const std::size_t last = std::min(parts.faces.size(), (task + 1) * faces_a_task);
                   for (std::size_t i = task * faces_a_task; i < last; ++i) {
                     if (!parts.paints[parts.faces[i].paint].picture) {
                       shade.darken(parts.faces[i]);
                     }
                   }
                 });
}

}  // namespace ridgecraft::mesh
