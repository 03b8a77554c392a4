// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/join_parts.hpp"

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Facets;

/// A post with a groove, far within the tolerance, above its lowest third.
mesh::Surface post() {
  return test::revolve({{0, 0}, {0.5, 0}, {0.5, 1}, {0.45, 1.05}, {0.5, 1.1}, {0.5, 2}, {0.5, 3}, {0, 3}},
                       24);
}

/// The post in three parts from below, the lowest one bordered by the groove.
struct ThreeParts {
  ThreeParts() {
    const auto height = [&](std::uint32_t f) {
      const auto& [a, b, c] = scaled.corners[f];
      return (scaled.points[a].z + scaled.points[b].z + scaled.points[c].z) / 3.0;
    };
    // From the middle of the post at 1.5 the groove is 0.45 down, the next border 0.5 up.
    const double unit = 1.0 / scaled.unit;
    parts.resize(3);
    for (std::uint32_t f = 0; f < scaled.facet_count(); ++f) {
      const double z = height(f);
      parts[z < -0.45 * unit ? 0 : z < 0.5 * unit ? 1 : 2].facets.push_back(f);
    }
    for (segment::MeasuredPart& part : parts) {
      part.depth = 1;
      segment::Measurement measurement;
      measurer.measure(part.facets, {}, {}, measurement);
      part.hull = measurement.hull;
      part.concavity = measurement.concavity;
    }
  }

  Context context;
  segment::ScaledSurface scaled = segment::scale_surface(post(), {});
  segment::EdgeWeights weights = segment::weigh_edges(scaled);
  segment::VertexGraph graph = segment::build_vertex_graph(scaled, 0.025);
  segment::Measurer measurer{scaled, graph, 0.1, context};
  segment::ValleyCache valleys;
  segment::JoiningTools tools{&measurer, &weights, nullptr, &valleys};
  std::vector<segment::MeasuredPart> parts;
};

}  // namespace

TEST_CASE("Parts that joined one that joined another leave nothing behind") {
  // The two upper ones come first, since the border between them is convex; then the lowest takes them in.
  ThreeParts post;
  REQUIRE(std::all_of(post.parts.begin(), post.parts.end(),
                      [](const auto& part) { return !part.facets.empty() && part.concavity <= 0.1; }));
  const std::vector<segment::PartTask> joined = segment::join_parts(post.parts, post.tools);
  REQUIRE(joined.size() == 1);
  CHECK(joined[0].facets.size() == post.scaled.facet_count());
  CHECK(joined[0].reason == segment::PartReason::merged);

  const segment::Rejoined rejoined = segment::rejoin_divided(post.parts, post.tools);
  CHECK(rejoined.kept.empty());
  REQUIRE(rejoined.changed.size() == 1);
  CHECK(rejoined.changed[0].facets.size() == post.scaled.facet_count());
}

TEST_CASE("Only parts that were divided join others after the last measurement") {
  ThreeParts post;
  for (segment::MeasuredPart& part : post.parts) {
    part.depth = 0;
  }
  const segment::Rejoined rejoined = segment::rejoin_divided(post.parts, post.tools);
  CHECK(rejoined.changed.empty());
  CHECK(rejoined.kept.size() == 3);
  for (const segment::PartTask& task : segment::leave_parts(post.parts)) {
    CHECK(task.hull.has_value());
    CHECK(task.depth == 0);
  }
}

}  // namespace ridgecraft
