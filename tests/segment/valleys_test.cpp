// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/valleys.hpp"

#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "segment/concavity/vertex_graph.hpp"
#include "segmented.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using test::tolerance;

/// The whole of a dumbbell as a part, and two vertices on its two balls.
struct Whole {
  Whole() {
    std::vector<std::uint32_t> all(scaled.facet_count());
    std::iota(all.begin(), all.end(), 0U);
    part.select(all);
    valleys.select();
    for (std::uint32_t v = 0; v < scaled.vertex_count(); ++v) {
      low = scaled.points[v].x > scaled.points[low].x && scaled.points[v].z < 0.0 ? v : low;
      high = scaled.points[v].x > scaled.points[high].x && scaled.points[v].z > 0.0 ? v : high;
    }
  }
  [[nodiscard]] segment::Valley find() { return valleys.find(low, high, tolerance, false); }

  segment::ScaledSurface scaled = segment::scale_surface(test::dumbbell(), {});
  segment::VertexGraph graph = segment::build_vertex_graph(scaled, 0.025);
  segment::PartGraph part{scaled, graph, true};
  segment::Valleys valleys{part};
  std::uint32_t low = 0;
  std::uint32_t high = 0;
};

}  // namespace

TEST_CASE("Valleys that are found during a loan belong to the lender") {
  Whole whole;
  segment::ValleyCache lent;
  segment::Valley known;
  {
    const segment::ValleyLoan loan(whole.valleys, lent);
    const segment::Valley valley = whole.find();
    REQUIRE(valley.steps.size() > 2);
    CHECK(valley.greatest > tolerance);
    REQUIRE(lent.find(whole.low, whole.high, known));
    CHECK(known.length == valley.length);
  }
  // A tampered copy shows which one is taken: the lender's is out of reach, then lent again by another hand.
  segment::Valley marked = known;
  marked.length = 77.0;
  segment::ValleyCache others;
  others.store(whole.low, whole.high, marked);
  CHECK(whole.find().length == known.length);
  segment::ValleyCache empty;
  {
    const segment::ValleyLoan fresh(whole.valleys, empty, &others);
    CHECK(whole.find().length == 77.0);
    {
      segment::ValleyCache inner;
      const segment::ValleyLoan nested(whole.valleys, inner);
      CHECK(whole.find().length == known.length);
      CHECK(inner.find(whole.low, whole.high, known));
    }
    CHECK(whole.find().length == 77.0);
  }
  CHECK_FALSE(empty.find(whole.low, whole.high, known));
  CHECK(whole.find().length < 77.0);
}

TEST_CASE("A deep valley of another part is searched again where a cut may be jumped across") {
  Whole whole;
  const double length_before = whole.find().length;
  // Without the facets of the far half of one ball: the valley survives, and there is a cut loop.
  std::vector<std::uint32_t> rest;
  for (std::uint32_t f = 0; f < whole.scaled.facet_count(); ++f) {
    const auto& [a, b, c] = whole.scaled.corners[f];
    if (whole.scaled.points[a].x + whole.scaled.points[b].x + whole.scaled.points[c].x > -0.3) {
      rest.push_back(f);
    }
  }
  whole.part.select(rest);
  whole.valleys.select();
  REQUIRE(whole.part.has_loops());
  segment::ValleyCache marked;
  segment::Valley known = whole.find();
  CHECK(known.length == Approx(length_before));
  const std::vector<segment::Step> steps(known.steps.begin(), known.steps.end());
  const std::vector<double> concavity(known.concavity.begin(), known.concavity.end());
  known = {.steps = steps, .concavity = concavity, .length = 77.0, .greatest = known.greatest, .part = 0};
  marked.store(whole.low, whole.high, known);
  const segment::ValleyLoan loan(whole.valleys, marked);
  CHECK(whole.find().length == Approx(length_before));
  // From a tolerance on by which it is shallow it is taken; from scratch never.
  marked.store(whole.low, whole.high, known);
  CHECK(whole.valleys.find(whole.low, whole.high, 10.0, false).length == 77.0);
  CHECK(whole.valleys.find(whole.low, whole.high, 10.0, true).length == Approx(length_before));
}

}  // namespace ridgecraft
