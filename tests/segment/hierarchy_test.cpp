// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy of parts: every number of parts, every tolerance.
#include "segment/hierarchy.hpp"

#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "mesh/mesh.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

void check_partition(const segment::Segmentation& s, std::size_t faces) {
  REQUIRE(s.part.size() == faces);
  std::size_t counted = 0;
  FaceId last;
  for (const PartId p : ids<PartId>(s.parts.size())) {
    REQUIRE(!s.parts[p].faces.empty());
    REQUIRE((!last.valid() || last < s.parts[p].faces.front()));
    last = s.parts[p].faces.front();
    counted += s.parts[p].faces.size();
    for (const FaceId f : s.parts[p].faces) {
      REQUIRE(s.part[f] == p);
    }
  }
  REQUIRE(counted == faces);
}

mesh::Surface table() {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      cells.push_back({x, y, 3});
    }
  }
  for (int z = 0; z < 3; ++z) {
    for (const auto& [x, y] : std::vector<std::array<int, 2>>{{0, 0}, {4, 0}, {0, 4}, {4, 4}}) {
      cells.push_back({x, y, z});
    }
  }
  return test::voxels(cells, 4);
}

}  // namespace

TEST_CASE("Who asks for more parts is never offered fewer") {
  const mesh::Model whale = mesh::read(std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/whale.obj",
                                       {.collapse_flat_faces = false}, {});
  std::size_t before = 0;
  for (const std::size_t count : {1U, 9U, 10U, 12U, 40U}) {
    const auto h = segment::find_hierarchy(whale.surface, whale.polygon.items(), count, Context{});
    CHECK(h.leaves >= before);
    before = h.leaves;
  }
}

TEST_CASE("Every number of parts between components and leaves is there, and each is nested in the next") {
  for (const mesh::Surface& surface :
       {test::dumbbell(), test::torus(1.0, 0.3, 16, 40), test::spiked_sphere(6, 0.02, 80, 40)}) {
    const auto h = segment::find_hierarchy(surface, {}, 4, Context{});
    REQUIRE(h.fewest() == 1);
    REQUIRE(h.leaves >= 3);
    REQUIRE(h.nodes.size() == h.leaves + h.joinings.size());
    CHECK(std::is_sorted(h.joinings.begin(), h.joinings.end(),
                         [](const auto& a, const auto& b) { return a.concavity < b.concavity; }));
    for (std::size_t i = 0; i < h.joinings.size(); ++i) {
      const auto& joining = h.joinings[i];
      REQUIRE(joining.first < joining.second);
      REQUIRE(joining.second < h.leaves + i);
      CHECK(joining.concavity >= h.nodes[h.leaves + i].concavity);
      std::vector<FaceId> both = h.nodes[joining.first].faces;
      both.insert(both.end(), h.nodes[joining.second].faces.begin(), h.nodes[joining.second].faces.end());
      std::sort(both.begin(), both.end());
      CHECK(both == h.nodes[h.leaves + i].faces);
    }
    for (std::size_t n = h.fewest(); n <= h.leaves; ++n) {
      const auto s = h.parts(n);
      REQUIRE(s.parts.size() == n);
      check_partition(s, surface.face_count());
      if (n < h.leaves) {
        CHECK(s.max_concavity() <= h.joinings[h.leaves - n - 1].concavity);
      }
    }
  }
}

TEST_CASE("The parts that people name come out when their number is given") {
  const auto balls = segment::find_hierarchy(test::dumbbell(), {}, 3, Context{});
  const auto legs = segment::find_hierarchy(table(), {}, 5, Context{});
  CHECK(balls.parts(3).max_concavity() < 0.1);
  CHECK(legs.parts(5).max_concavity() < 0.1);
  CHECK(legs.parts(4).max_concavity() > 0.1);
}

TEST_CASE("A vessel's rim isn't deep in the hierarchy either") {
  const auto cup = segment::find_hierarchy(test::uneven_cup(), {}, 2, Context{});
  CHECK(cup.parts(1).max_concavity() <= 0.1);
  CHECK(cup.joinings.back().concavity <= 0.1);
}

TEST_CASE("Components are never joined, and a single face is a hierarchy, too") {
  const mesh::Surface pair = test::voxels({{0, 0, 0}, {3, 0, 0}}, 2);
  const auto two = segment::find_hierarchy(pair, {}, 1, Context{});
  CHECK(two.fewest() == 2);
  CHECK(two.parts(2).parts.size() == 2);
  const mesh::Surface face({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{VertexId(0), VertexId(1), VertexId(2)}});
  const auto one = segment::find_hierarchy(face, {}, 1, Context{});
  CHECK(one.leaves == 1);
  CHECK(one.joinings.empty());
  CHECK(segment::find_hierarchy(mesh::Surface{}, {}, 1, Context{}).leaves == 0);
}

}  // namespace ridgecraft
