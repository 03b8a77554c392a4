// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts that no benchmark model needs: the fallback split, halves, more ridges than one round cuts off.
#include "segment/cut.hpp"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "mesh/context.hpp"
#include "segment/ridges.hpp"
#include "segment/segment.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Facets;

/// A surface measured as one part, with everything that cutting it needs.
struct Measured {
  Measured(const mesh::Surface& surface, std::span<const std::uint32_t> polygon, double tolerance)
      : scaled(segment::scale_surface(surface, polygon)),
        weights(segment::weigh_edges(scaled)),
        graph(segment::build_vertex_graph(scaled, 0.25 * tolerance)),
        measurer(scaled, graph, tolerance, context),
        cutter(scaled, weights),
        all(scaled.facet_count()) {
    std::iota(all.begin(), all.end(), 0U);
    measurer.measure(all, {}, segment::MeasureMode::split, measurement);
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

}  // namespace ridgecraft
