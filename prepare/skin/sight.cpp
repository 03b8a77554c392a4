// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/sight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/rays.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr int looks = 64;
/// A look begins so far beside the surface, share of the diagonal.
constexpr double beside = 1e-7;

Box3 box_around(const Screen& screen) {
  Box3 box;
  std::for_each(screen.corners.begin(), screen.corners.end(), [&](Vec3 p) { box.add(p); });
  return box;
}

}  // namespace

Sight::Sight(std::vector<Screen> screens)
    : screens_(std::move(screens)),
      tree_(
          screens_.size(), [&](std::uint32_t i) { return box_around(screens_[i]); },
          [&](std::uint32_t i) {
            const auto& c = screens_[i].corners;
            return (c[0] + c[1] + c[2]) / 3.0;
          }) {
  diagonal_ = tree_.box(0).diagonal();
}

bool Sight::passes(Vec3 from, Vec3 way, std::vector<std::uint32_t>& openings) const {
  bool out = true;
  tree_.search([&](std::uint32_t node) { return out && comes_near(from, way, tree_.box(node)); },
               [&](std::uint32_t place) {
                 const Screen& screen = screens_[tree_.order()[place]];
                 if (out && std::isfinite(meets_at(from, way, screen.corners))) {
                   out = screen.opening != Screen::wall;
                   openings.push_back(screen.opening);
                 }
               });
  return out;
}

std::vector<std::uint32_t> Sight::openings_seen(Vec3 place, Vec3 normal) const {
  std::vector<std::uint32_t> seen;
  const Vec3 from = place + beside * diagonal_ * normalized(normal);
  for (int i = 0; i < looks; ++i) {
    const Vec3 way = even_direction(i, looks);
    if (dot(way, normal) <= 0.0) {
      continue;
    }
    std::vector<std::uint32_t> openings;
    if (passes(from, 2.0 * diagonal_ * way, openings)) {
      std::sort(openings.begin(), openings.end());
      openings.erase(std::unique(openings.begin(), openings.end()), openings.end());
      seen.insert(seen.end(), openings.begin(), openings.end());
    }
  }
  return seen;
}

bool Sight::gets_out(Vec3 place, Vec3 normal) const {
  const Vec3 from = place + beside * diagonal_ * normalized(normal);
  std::vector<std::uint32_t> openings;
  for (int i = 0; i < looks; ++i) {
    const Vec3 way = even_direction(i, looks);
    if (dot(way, normal) > 0.0 && passes(from, 2.0 * diagonal_ * way, openings)) {
      return true;
    }
  }
  return false;
}

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
  if (surface.component_count() < 2) {
    return 0;
  }
  const std::vector<std::vector<FaceId>> faces = components(surface);
  std::vector<bool> seen;
  for (const std::vector<FaceId>& of_component : faces) {
    seen.push_back(of_component.size() > most_faces);
  }
  if (std::find(seen.begin(), seen.end(), false) == seen.end()) {
    return 0;
  }
  const Sight sight = sight_of(surface);
  std::size_t tried = 0;
  for (std::size_t c = 0; c < faces.size(); ++c) {
    for (std::size_t i = 0; i < faces[c].size() && !seen[c]; ++i) {
      context.check();
      seen[c] = tried >= most_places || is_seen(surface, faces[c][i], sight, tried);
    }
  }
  const auto unseen = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), false));
  if (unseen == 0 || unseen == faces.size()) {
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
