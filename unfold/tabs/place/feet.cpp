// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/feet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/boxes.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::unfold {
namespace {

/// A foot and what it stands on are parallel up to this (cosine of 3 degrees).
constexpr double parallel_cosine = 0.9986;

/// Nobody glues a foot with more tabs.
constexpr std::size_t most_sides = 1000;

class Feet {
 public:
  explicit Feet(const mesh::Surface& surface)
      : surface_(surface),
        tree_(
            surface.face_count(), [&](std::uint32_t f) { return surface.bounds(FaceId(f)); },
            [&](std::uint32_t f) { return centre(surface.bounds(FaceId(f))); }) {}

  void add_sides_of(const mesh::Opening& opening, std::vector<FootSide>& sides) const {
    const std::size_t count = opening.sides.size();
    if (count > most_sides) {
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const CornerId side = opening.sides[i];
      const Vec3 start = at(mesh::next(side));  // of the tab's base
      const Vec3 end = at(side);
      if (!mesh::rises_at(surface_, opening, side) ||
          !lies_on_another(0.5 * (start + end), opening.normal, surface_.component(mesh::face_of(side)))) {
        continue;
      }
      const Vec3 along = normalized(end - start);
      const Vec3 inward = cross(opening.normal, along);
      FootSide foot{side, {}};
      for (std::size_t k = 0; k < count; ++k) {
        // The other way round than the faces beside it run.
        const Vec3 q = at(mesh::next(opening.sides[(i + count - k) % count])) - start;
        foot.opening.push_back({dot(q, along), dot(q, inward)});
      }
      sides.push_back(std::move(foot));
    }
  }

 private:
  [[nodiscard]] Vec3 at(CornerId c) const { return surface_.point(surface_.vertex(c)); }

  [[nodiscard]] bool lies_on_another(Vec3 p, Vec3 normal, ComponentId own) const {
    Box3 box;
    box.add(p);
    box = grown(box, mesh::touching_mm);
    bool found = false;
    tree_.search([&](std::uint32_t node) { return !found && meet(box, tree_.box(node)); },
                 [&](std::uint32_t at) {
                   const FaceId f(tree_.order()[at]);
                   const auto [a, b, c] = surface_.vertices(f);
                   found = found ||
                           (surface_.component(f) != own &&
                            std::abs(dot(surface_.normal(f), normal)) >= parallel_cosine &&
                            mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c),
                                                   p) <= mesh::touching_mm * mesh::touching_mm);
                 });
    return found;
  }

  const mesh::Surface& surface_;
  BoxTree<Box3> tree_;
};

}  // namespace

std::vector<FootSide> find_feet(const mesh::Surface& surface, const Context& context) {
  std::vector<FootSide> sides;
  if (surface.component_count() < 2) {
    return sides;
  }
  const std::vector<mesh::Opening> openings = mesh::flat_openings(surface, mesh::touching_mm);
  if (openings.empty()) {
    return sides;
  }
  const Feet feet(surface);
  for (const mesh::Opening& opening : openings) {
    context.check();
    feet.add_sides_of(opening, sides);
  }
  return sides;
}

}  // namespace ridgecraft::unfold
