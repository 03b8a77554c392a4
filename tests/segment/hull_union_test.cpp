// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/hull_union.hpp"

#include <map>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/surface/exact_orientation.hpp"

namespace ridgecraft {
namespace {

using segment::RaySpan;

/// A cloud of points for each group, as hulls that hold their union's.
struct Clouds {
  explicit Clouds(std::size_t groups) : ids(groups) {
    Random random(6);
    for (auto& group : ids) {
      const Vec3 middle{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
      for (int i = 0; i < 20; ++i) {
        const Vec3 p{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
        group.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(segment::snap_to_grid(middle + 0.5 * p));
      }
    }
  }
  [[nodiscard]] std::vector<RaySpan> rays(std::size_t group) const {
    segment::HullBuilder builder(points);
    segment::Hull hull;
    builder.build(ids[group], hull);
    return segment::cast_rays(hull, points);
  }

  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> ids;
};

/// Length of the union of some groups' stretches, ray by ray.
double length_of(const std::vector<std::vector<RaySpan>>& groups) {
  std::map<std::uint32_t, std::vector<RaySpan>> by_ray;
  for (const auto& group : groups) {
    for (const RaySpan& span : group) {
      by_ray[span.ray].push_back(span);
    }
  }
  double sum = 0.0;
  for (auto& [ray, spans] : by_ray) {
    sum += segment::union_length(spans);
  }
  return sum;
}

}  // namespace

TEST_CASE("Hulls that are joined one by one cover what all of them cover") {
  Clouds clouds(6);
  std::vector<std::vector<RaySpan>> rays;
  segment::HullUnion hulls;
  hulls.start(true);
  for (std::uint32_t g = 0; g < clouds.ids.size(); ++g) {
    rays.push_back(clouds.rays(g));
    hulls.add(g, rays.back());
  }
  CHECK(hulls.length() == Approx(length_of(rays)).epsilon(1e-12));
  for (std::uint32_t h = 1; h < clouds.ids.size(); ++h) {
    auto& into = clouds.ids[0];
    into.insert(into.end(), clouds.ids[h].begin(), clouds.ids[h].end());
    const std::vector<RaySpan> united = clouds.rays(0);
    const double before = hulls.length();
    const double added = hulls.added_length(0, h, united);
    CHECK(added >= 0.0);
    hulls.unite(0, h, united);
    rays[0] = united;
    rays[h].clear();
    CHECK(hulls.length() == Approx(before + added).epsilon(1e-12));
    CHECK(hulls.length() == Approx(length_of(rays)).epsilon(1e-12));
  }
}

TEST_CASE("Without rays a union of hulls is nothing") {
  segment::HullUnion hulls;
  hulls.start(false);
  hulls.add(0, {});
  hulls.unite(0, 1, {});
  CHECK(hulls.length() == 0.0);
  CHECK(hulls.added_length(0, 1, {}) == 0.0);
}

}  // namespace ridgecraft
