// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/cover_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "export/view/coarse_view.hpp"
#include "mesh/look/look.hpp"

namespace ridgecraft::paper {
namespace {

constexpr std::size_t cover_pixels = 96;
/// Another side than the file's front has so many times as much to be seen.
constexpr double clearly_more = 1.1;
/// Faces that are seen from their edge (cosine) show no place.
constexpr double least_cosine = 1e-6;

double difference(const mesh::Rgb& a, const mesh::Rgb& b) {
  int most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    most = std::max(most, std::abs(static_cast<int>(a[k]) - static_cast<int>(b[k])));
  }
  return most;
}

/// How much the colours of neighbouring dots differ, times the length along which they do.
double detail_seen(const GuideModel& guide, const Camera& camera) {
  const CoarseView view = look_coarsely(guide.scene, camera, cover_pixels);
  const mesh::Surface& surface = guide.surface();
  const mesh::Look& look = *guide.model->look;
  std::vector<std::optional<mesh::Rgb>> colours(view.face.size());
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < view.face.size(); ++i) {
    const FaceId face = view.face[i];
    if (!face.valid()) {
      continue;
    }
    const Vec3 normal = surface.normal(face);
    const double slope = dot(camera.toward, normal);
    if (slope < least_cosine) {
      continue;  // its inside, which is white
    }
    const Vec2 p = view.centre(i);
    const Vec3 before = p.x * camera.right + p.y * camera.up;
    const Vec3 corner = surface.point(surface.vertices(face)[0]);
    const Vec3 place = before + dot(corner - before, normal) / slope * camera.toward;
    const mesh::LookPlace found = look.nearest(place, normal, hint);
    hint = found.face;
    colours[i] = look.colour_at(found, view.pixel);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const bool last_in_row = i % view.columns + 1 == view.columns;
    if (!last_in_row && colours[i] && colours[i + 1]) {
      sum += difference(*colours[i], *colours[i + 1]);
    }
    if (i + view.columns < colours.size() && colours[i] && colours[i + view.columns]) {
      sum += difference(*colours[i], *colours[i + view.columns]);
    }
  }
  return sum * view.pixel;
}

}  // namespace

Stance turned_to_cover(const GuideModel& guide) {
  Stance best = guide.stance;
  if (!guide.in_colour) {
    return best;
  }
  const Viewpoint& cover = guide_sides().front();
  double most = 0.0;
  Stance turned = guide.stance;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double detail = detail_seen(guide, look_from(turned, cover.azimuth, cover.elevation));
    if (quarter == 0) {
      most = clearly_more * detail;
    } else if (detail > most) {
      most = detail;
      best = turned;
    }
    turned.front = cross(turned.up, turned.front);
  }
  return best;
}

}  // namespace ridgecraft::paper
