// SPDX-License-Identifier: GPL-3.0-or-later
// What else may be asked for: labels that make cuts cheap, other readings of the paper.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/error.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/segment.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;

namespace {

/// Two balls on a long rod.
mesh::Surface dumbbell() {
  std::vector<Vec2> outline;
  const auto arc = [&](double from, double to, double middle) {
    for (int i = 0; i <= 12; ++i) {
      const double t = from + (to - from) * i / 12.0;
      outline.push_back({i == 0 && from < -1.5 ? 0.0
                         : i == 12 && to > 1.5 ? 0.0
                                               : std::cos(t),
                         middle + std::sin(t)});
    }
  };
  const double rod = 0.25;
  const double end = std::acos(rod);
  arc(-1.5707963267948966, end, -4.0);
  for (int i = 1; i < 24; ++i) {
    outline.push_back({rod, -4.0 + std::sin(end) + (8.0 - 2.0 * std::sin(end)) * i / 24.0});
  }
  arc(-end, 1.5707963267948966, 4.0);
  return test::revolve(outline, 24);
}

double height(const mesh::Surface& surface, FaceId f) {
  const auto [a, b, c] = surface.vertices(f);
  return (surface.point(a).z + surface.point(b).z + surface.point(c).z) / 3.0;
}

}  // namespace

TEST_CASE("edges where labels meet are as cheap to cut as hollows", "[labels]") {
  const mesh::Surface ball = test::sphere(24, 12);
  std::vector<std::uint32_t> label;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    label.push_back(height(ball, f) < 0.0 ? 7 : 4);
  }
  const segment::ScaledSurface scaled = segment::scale_surface(ball, {});
  const segment::EdgeWeights weights = segment::weigh_edges(scaled, {}, label);
  std::size_t borders = 0;
  for (const EdgeId e : ids<EdgeId>(ball.edge_count())) {
    const auto [c, d] = ball.sides(e);
    const bool border = label[mesh::face_of(c).value()] != label[mesh::face_of(d).value()];
    borders += border ? 1U : 0U;
    CHECK(weights.smoothness(c.value()) == (border ? 0.3 : 1.0));
    CHECK(weights.smoothness(d.value()) == weights.smoothness(c.value()));
    CHECK(weights.capacity(d.value()) == weights.capacity(c.value()));
  }
  CHECK(borders == 24);
  // Of the circles around the ball the equator is the longest, and the cheapest beside its neighbours.
  const auto price_of_circle = [&](double z) {
    std::int64_t sum = 0;
    for (const EdgeId e : ids<EdgeId>(ball.edge_count())) {
      const CornerId c = ball.sides(e)[0];
      const bool on_it = std::abs(ball.point(ball.vertex(c)).z - z) < 1e-9 &&
                         std::abs(ball.point(ball.vertex(mesh::next(c))).z - z) < 1e-9;
      sum += on_it ? weights.capacity(c.value()) : 0;
    }
    return sum;
  };
  const double next_circle = std::sin(std::numbers::pi / 12.0);
  CHECK(price_of_circle(0.0) > 0);
  CHECK(2 * price_of_circle(0.0) < price_of_circle(next_circle));
  CHECK(2 * price_of_circle(0.0) < price_of_circle(-next_circle));
}

TEST_CASE("labels make no more parts", "[labels]") {
  const mesh::Surface surface = dumbbell();
  const std::size_t plain = segment::segment(surface, {}, {}, {}).parts.size();
  REQUIRE(plain >= 2);
  for (const double border : {-2.0, -0.5, 1.0, 2.5}) {
    std::vector<std::uint32_t> label;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      label.push_back(height(surface, f) < border ? 0 : 1);
    }
    CHECK(segment::segment(surface, {}, {}, {}, label).parts.size() <= plain);
  }
}

TEST_CASE("labels alone cut nothing", "[labels]") {
  const mesh::Surface ball = test::sphere(24, 12);
  std::vector<std::uint32_t> label;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    label.push_back(f.value() % 3);
  }
  CHECK(segment::segment(ball, {}, {}, {}, label).parts.size() == 1);
}

namespace ridgecraft {
namespace {

// The other readings of the paper, kept for research.

using segment::Reading;

segment::Segmentation read_as(const mesh::Surface& surface, Reading reading) {
  segment::Options options;
  options.reading = reading;
  return segment::segment(surface, {}, options, Context{});
}

}  // namespace

TEST_CASE("Literally, what a cut leaves open is concave, but with jumps it is not") {
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
