// SPDX-License-Identifier: GPL-3.0-or-later
// Searching on from a vertex finds what a search of its own finds.
#include "segment/concavity/valley_search.hpp"

#include <numeric>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/concavity/vertex_graph.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {

TEST_CASE("searching on from a vertex finds the way and the length that a fresh search finds") {
  // A torus and a flat grid have many ways of one length; half a sphere has a cut loop to jump across.
  const mesh::Surface grid = test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 12);
  for (const mesh::Surface& surface : {test::torus(1.0, 0.3, 16, 40), grid, test::sphere(40, 20)}) {
    const segment::ScaledSurface scaled = segment::scale_surface(surface, {});
    const segment::VertexGraph graph = segment::build_vertex_graph(scaled, 0.025);
    for (const bool jumps : {false, true}) {
      segment::PartGraph part(scaled, graph, jumps);
      std::vector<std::uint32_t> facets(jumps ? scaled.facet_count() / 2 : scaled.facet_count());
      std::iota(facets.begin(), facets.end(), 0U);
      part.select(facets);
      const auto vertices = part.vertices();
      Random random(7);
      segment::ValleySearch kept(part);
      std::vector<segment::Step> path;
      std::vector<segment::Step> fresh_path;
      for (int source = 0; source < 12; ++source) {
        const std::uint32_t from = vertices[random.below(static_cast<std::uint32_t>(vertices.size()))];
        for (int goal = 0; goal < 20; ++goal) {
          const std::uint32_t to = vertices[random.below(static_cast<std::uint32_t>(vertices.size()))];
          segment::ValleySearch fresh(part);
          const double length = kept.find(from, to, path);
          CAPTURE(source, goal, from, to, jumps);
          REQUIRE(length == fresh.find(from, to, fresh_path));
          bool jumped = false;
          bool same = path.size() == fresh_path.size();
          for (std::size_t i = 0; same && i < path.size(); ++i) {
            same = path[i].vertex == fresh_path[i].vertex;
          }
          for (const auto& steps : {path, fresh_path}) {
            for (const segment::Step& step : steps) {
              jumped = jumped || step.arc == segment::jump_arc;
            }
          }
          // Of jumps of one length, the one that was found first.
          CHECK((same || jumped));
        }
      }
    }
  }
}

}  // namespace ridgecraft
