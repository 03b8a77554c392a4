// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts that no benchmark model needs: the fallback split, halves, more ridges than one round cuts off.
#include "segment/cutting/cut.hpp"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"
#include "segment/cutting/division.hpp"
#include "segment/cutting/regions.hpp"
#include "segment/segment.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Facets;

/// A surface measured as one part, with everything that cutting it needs.
struct Measured {
  Measured(const mesh::Surface& surface, std::span<const std::uint32_t> polygon, double tolerance,
           std::size_t coarse_from = segment::coarse_from_open)
      : scaled(segment::scale_surface(surface, polygon)),
        weights(segment::weigh_edges(scaled)),
        graph(segment::build_vertex_graph(scaled, 0.25 * tolerance)),
        measurer(scaled, graph, {tolerance}, context),
        cutter(scaled, weights, coarse_from),
        all(scaled.facet_count()) {
    std::iota(all.begin(), all.end(), 0U);
    measurer.measure(all, {}, {}, measurement);
  }

  Context context;
  segment::ScaledSurface scaled;
  segment::EdgeWeights weights;
  segment::VertexGraph graph;
  segment::Measurer measurer;
  segment::Cutter cutter;
  Facets all;
  segment::Measurement measurement;
};

/// How the parts of a surface are divided, before any are joined.
segment::Division divided(const mesh::Surface& surface, double tolerance) {
  Measured m(surface, {}, tolerance);
  segment::PartWorkers workers(m.scaled, m.graph, m.weights, {tolerance}, m.context);
  std::vector<segment::PartTask> tasks;
  for (Facets& component : m.cutter.components(m.all)) {
    tasks.push_back({std::move(component)});
  }
  segment::ValleyCache valleys;
  return segment::divide_all(workers, std::move(tasks), {}, valleys, [](double) {});
}

/// Children are a partition, each connected, in order.
void check_children(Measured& m, const std::vector<Facets>& children) {
  std::vector<int> seen(m.all.size(), 0);
  std::uint32_t previous = 0;
  for (const Facets& child : children) {
    REQUIRE(!child.empty());
    CHECK(std::is_sorted(child.begin(), child.end()));
    CHECK(child.front() >= previous);
    previous = child.front();
    for (const std::uint32_t f : child) {
      ++seen[f];
    }
    CHECK(m.cutter.components(child).size() == 1);
  }
  CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(m.all.size()));
}

/// What the borders between the children cost, as the cuts count it.
double border_cost(const Measured& m, const std::vector<Facets>& children) {
  std::vector<std::size_t> child_of(m.all.size());
  for (std::size_t c = 0; c < children.size(); ++c) {
    for (const std::uint32_t f : children[c]) {
      child_of[f] = c;
    }
  }
  double sum = 0.0;
  for (std::uint32_t f = 0; f < m.all.size(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = m.scaled.neighbors[f][k];
      if (g != no_index && child_of[f] < child_of[g]) {
        sum += static_cast<double>(m.weights.capacity(3 * f + k));
      }
    }
  }
  return sum;
}

const std::vector<std::array<int, 3>> u_cells{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}};

}  // namespace

TEST_CASE("The fallback split divides a part between the ends of its deepest bridge") {
  Measured m(test::voxels(u_cells, 4), {}, 0.1);
  REQUIRE(m.measurement.concavity > 0.1);
  const auto children = m.cutter.split(m.measurer, m.measurement, false);
  CHECK(children.size() >= 2);
  check_children(m, children);
}

TEST_CASE("Halves have about half of the facets each") {
  Measured m(test::voxels(u_cells, 4), {}, 0.1);
  const auto children = m.cutter.split(m.measurer, m.measurement, true);
  check_children(m, children);
  for (const Facets& child : children) {
    CHECK(child.size() <= (m.all.size() + 1) / 2);
  }
}

TEST_CASE("A split keeps polygons whole, and can't divide a single one") {
  const mesh::Surface u = test::voxels(u_cells, 2);
  std::vector<std::uint32_t> pairs;
  for (std::uint32_t f = 0; f < u.face_count(); ++f) {
    pairs.push_back(f / 2);
  }
  Measured m(u, pairs, 0.1);
  for (const bool halves : {false, true}) {
    const auto children = m.cutter.split(m.measurer, m.measurement, halves);
    CHECK(children.size() >= 2);
    check_children(m, children);
    for (const Facets& child : children) {
      CHECK(child.size() % 2 == 0);
    }
  }
  const std::vector<std::uint32_t> one(u.face_count(), 0);
  Measured whole(u, one, 0.1);
  CHECK(whole.cutter.split(whole.measurer, whole.measurement, false).size() == 1);
  CHECK(whole.cutter.cut(whole.measurer, whole.measurement).size() == 1);
}

TEST_CASE("Without a deepest bridge every facet goes alone") {
  Measured m(test::tetrahedron(), {}, 0.1);
  const auto children = m.cutter.split(m.measurer, m.measurement, false);
  CHECK(children.size() == 4);
}

TEST_CASE("A round cuts off at most 64 ridges of the many of a rough surface") {
  Random random(3);
  const mesh::Surface hedgehog = test::star_shaped([&](Vec3) { return 1.0 + random.unit(); }, 80, 40);
  Measured m(hedgehog, {}, 0.02);
  const auto ridges = segment::find_ridges(m.measurement, m.scaled.points);
  REQUIRE(ridges.size() > segment::most_ridges);
  const auto children = m.cutter.cut(m.measurer, m.measurement);
  CHECK(children.size() >= 2);
  check_children(m, children);
  const auto s = segment::segment(hedgehog, {}, {0.02}, Context{});
  CHECK(s.max_concavity() <= 0.02);
}

TEST_CASE("Cuts among clusters give the pieces that cuts among facets give") {
  // Clusters are for 50 000 facets and more; here they serve cuts of 4 000 to 14 000, which the whole flow
  // does, too.
  constexpr std::size_t never = 1000000000;
  const std::vector<mesh::Surface> shapes{test::spiked_sphere(6, 0.02, 120, 60),
                                          test::torus(1.0, 0.3, 48, 120), test::dumbbell(),
                                          test::mapped(test::sphere(100, 50), [](Vec3 p) {
                                            // A peanut: thick ends, a waist.
                                            const double r = 0.2 + 0.8 * p.z * p.z;
                                            return Vec3{r * p.x, r * p.y, 2.0 * p.z};
                                          })};
  for (const mesh::Surface& shape : shapes) {
    Measured fine(shape, {}, 0.1, never);
    Measured coarse(shape, {}, 0.1, 200);
    REQUIRE(fine.measurement.concavity > 0.1);
    const auto by_facets = fine.cutter.cut(fine.measurer, fine.measurement);
    const auto by_clusters = coarse.cutter.cut(coarse.measurer, coarse.measurement);
    check_children(coarse, by_clusters);
    CHECK(by_facets.size() >= 2);
    CHECK(by_clusters.size() == by_facets.size());
    // Never better than the minimum for one cut; a little dearer at most for all of a round.
    CHECK(border_cost(coarse, by_clusters) <= 1.05 * border_cost(fine, by_facets));
  }
}

TEST_CASE("Trays are peeled until the limit of depth, and end within the tolerance all the same") {
  // A round floor in a wide, low border: each cut takes a sliver of the border. Steps, height and inner
  // radius were looked for until the limit of 60 cuts was reached.
  struct Tray {
    int steps;
    double height;
    double inner;
  };
  std::size_t halvings = 0;
  for (const Tray& t : {Tray{64, 0.19, 0.9}, Tray{100, 0.18, 0.85}, Tray{200, 0.19, 0.9},
                        Tray{200, 0.18, 0.92}, Tray{130, 0.18, 0.85}}) {
    const mesh::Surface tray = test::revolve(
        {{0, 0}, {1, 0}, {1, t.height}, {t.inner, t.height}, {t.inner, 0.06}, {0, 0.06}}, t.steps);
    const auto s = segment::segment(tray, {}, {0.1}, Context{});
    CHECK(s.max_concavity() <= 0.1);
    CHECK(s.parts.size() < 20);
    const segment::Division division = divided(tray, 0.1);
    CHECK(division.depth > 30);
    halvings += division.halvings;
  }
  CHECK(halvings > 0);
}

TEST_CASE("Where no cut makes two pieces a whole run falls back to the nearer end") {
  // Noise of twenty times the tolerance: somewhere a few facets are one ridge and too concave.
  Random random(2);
  std::size_t splits = 0;
  for (int round = 0; round < 4; ++round) {
    const mesh::Surface rough = test::star_shaped([&](Vec3) { return 1.0 + 0.02 * random.unit(); }, 100, 50);
    CHECK(segment::segment(rough, {}, {0.001}, Context{}).max_concavity() <= 0.001);
    splits += divided(rough, 0.001).splits;
  }
  CHECK(splits > 0);
}

}  // namespace ridgecraft
