// SPDX-License-Identifier: GPL-3.0-or-later
// The other readings of the paper, kept for research.
#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/error.hpp"
#include "segment/segment.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using segment::Reading;

segment::Segmentation read_as(const mesh::Surface& surface, Reading reading) {
  segment::Options options;
  options.reading = reading;
  return segment::segment(surface, {}, options, Context{});
}

}  // namespace

TEST_CASE("Literally, what a cut leaves open is concave; with jumps it is not") {
  // A ball with spikes: cutting a spike off leaves a ring, at which the literal reading peels on.
  const mesh::Surface surface = test::spiked_sphere(6, 0.02, 80, 40);
  const auto literal = read_as(surface, Reading::literal);
  const auto a = read_as(surface, Reading::a);
  const auto b = read_as(surface, Reading::b);
  CHECK(b.parts.size() == 7);
  CHECK(a.parts.size() >= b.parts.size());
  CHECK(literal.parts.size() > a.parts.size());
  for (const auto* s : {&literal, &a, &b}) {
    CHECK(s->part.size() == surface.face_count());
    CHECK(s->max_concavity() <= 0.1);
  }
}

TEST_CASE("A cup is whole only where depth is the way out of the hull") {
  const mesh::Surface cup = test::turned({{0, 0}, {1, 0}, {1, 2}, {0.9, 2}, {0.9, 0.1}, {0, 0.1}});
  CHECK(read_as(cup, Reading::b).parts.size() == 1);
  CHECK(read_as(cup, Reading::a).parts.size() > 3);
}

TEST_CASE("The other readings go with nothing that builds on the default one") {
  segment::Options options;
  options.reading = Reading::a;
  options.effort = 2;
  CHECK_THROWS_AS(segment::segment(test::cube(), {}, options, Context{}), Error);
  options.effort = 1;
  options.pockets = true;
  CHECK_THROWS_AS(segment::segment(test::cube(), {}, options, Context{}), Error);
  options.pockets = false;
  CHECK(segment::segment(test::cube(), {}, options, Context{}).parts.size() == 1);
}

}  // namespace ridgecraft
