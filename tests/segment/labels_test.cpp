// SPDX-License-Identifier: GPL-3.0-or-later
// Borders that the artist drew are cheap places for cuts.
#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "segment/segment.hpp"
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

TEST_CASE("a cut is made where labels meet rather than beside it", "[labels]") {
  const mesh::Surface surface = dumbbell();
  const segment::Segmentation plain = segment::segment(surface, {}, {}, {});
  REQUIRE(plain.parts.size() >= 2);
  for (const int ring : {6, 9, 14, 18}) {
    const double border =
        -4.0 + std::sin(std::acos(0.25)) + (8.0 - 2.0 * std::sin(std::acos(0.25))) * ring / 24.0;
    std::vector<std::uint32_t> label;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      label.push_back(height(surface, f) < border ? 0 : 1);
    }
    const segment::Segmentation found = segment::segment(surface, {}, {}, {}, label);
    // No more parts because of it; and a border of parts runs along the whole border of the labels.
    CHECK(found.parts.size() <= plain.parts.size());
    std::size_t along = 0;
    std::size_t cut = 0;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const auto [c, d] = surface.sides(e);
      const FaceId f = mesh::face_of(c);
      const FaceId g = mesh::face_of(d);
      if (label[f.value()] != label[g.value()]) {
        ++along;
        cut += found.part[f] != found.part[g] ? 1U : 0U;
      }
    }
    CHECK(along == 24);
    CHECK(cut == along);
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
