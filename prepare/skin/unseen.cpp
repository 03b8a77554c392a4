// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/unseen.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/skin/sight.hpp"

namespace ridgecraft::prepare {
namespace {

/// What has more faces is a large part of the model, and would take long to look from.
constexpr std::size_t most_faces = 1000;
/// A face's sides are divided so that places are about this far from each other, share of the diagonal ...
constexpr double between_places = 0.02;
/// ... but into no fewer parts and no more.
constexpr int fewest_parts = 2;
constexpr int most_parts = 8;
/// Looks from so many places take three seconds. What wasn't found to be hidden by then stays.
constexpr std::size_t most_places = 20'000;

Sight sight_of(const mesh::Surface& surface) {
  std::vector<Screen> walls;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    walls.push_back({{surface.point(a), surface.point(b), surface.point(c)}});
  }
  return Sight(std::move(walls));
}

/// Can one look out from a face, on either side? Counts the places that were tried.
bool is_seen(const mesh::Surface& surface, FaceId f, const Sight& sight, std::size_t& tried) {
  const Vec3 normal = surface.normal(f);
  if (normal == Vec3{}) {
    return false;
  }
  const auto [i, j, k] = surface.vertices(f);
  const Vec3 a = surface.point(i);
  const Vec3 u = surface.point(j) - a;
  const Vec3 v = surface.point(k) - a;
  const double longest = std::max({length(u), length(v), length(v - u)});
  const double wanted = std::ceil(longest / (between_places * surface.bounds().diagonal()));
  const int parts = static_cast<int>(std::clamp<double>(wanted, fewest_parts, most_parts));
  // The middles of the small triangles that result, of either kind.
  for (int row = 0; row < parts; ++row) {
    for (int column = 0; row + column < parts; ++column) {
      for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
        if (third > 0.5 && row + column + 2 > parts) {
          continue;
        }
        const Vec3 place = a + ((row + third) * u + (column + third) * v) / parts;
        ++tried;
        if (sight.gets_out(place, normal) || sight.gets_out(place, -1.0 * normal)) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

std::size_t leave_out_unseen(mesh::Model& model, const Context& context) {
  const mesh::Surface& surface = model.surface;
  const std::size_t components = surface.component_count();
  if (components < 2) {
    return 0;
  }
  std::vector<std::vector<FaceId>> faces(components);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces[surface.component(f).value()].push_back(f);
  }
  std::vector<bool> seen;
  for (const std::vector<FaceId>& of_component : faces) {
    seen.push_back(of_component.size() > most_faces);
  }
  if (std::find(seen.begin(), seen.end(), false) == seen.end()) {
    return 0;
  }
  const Sight sight = sight_of(surface);
  std::size_t tried = 0;
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t i = 0; i < faces[c].size() && !seen[c]; ++i) {
      context.check();
      seen[c] = tried >= most_places || is_seen(surface, faces[c][i], sight, tried);
    }
  }
  const auto unseen = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), false));
  if (unseen == 0 || unseen == components) {
    return 0;
  }
  std::vector<bool> kept;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    kept.push_back(seen[surface.component(f).value()]);
  }
  mesh::keep_faces(model, kept);
  return unseen;
}

}  // namespace ridgecraft::prepare
