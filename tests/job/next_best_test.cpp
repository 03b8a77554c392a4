// SPDX-License-Identifier: GPL-3.0-or-later
// What takes the place of a result that fails its own check.
#include "job/next_best.hpp"

#include <cstddef>
#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "job/from_nets.hpp"
#include "job/job.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using job::Options;
using job::Result;

namespace {

/// Fails so often with an error of this kind; counts its calls.
struct Attempts {
  std::size_t failures = 0;
  ErrorKind kind = ErrorKind::internal;
  std::size_t made = 0;

  Result operator()(const Options& options, const Context& context) {
    if (made++ < failures) {
      throw Error(kind, "attempt " + std::to_string(made));
    }
    Result result;
    result.options = options;
    result.seed = context.seed;
    return result;
  }
};

Result result_of(Attempts& attempts) {
  return job::next_best(
      {}, {}, [&](const Options& options, const Context& context) { return attempts(options, context); });
}

}  // namespace

TEST_CASE("a sound result is the one that was asked for") {
  Attempts attempts;
  const Result result = result_of(attempts);
  CHECK(attempts.made == 1);
  CHECK(result.seed == Context().seed);
  CHECK(result.nets.notes.empty());
}

TEST_CASE("where a result fails its check the next one takes its place, and a note says so") {
  for (std::size_t failures = 1; failures < 5; ++failures) {
    Attempts attempts{failures};
    const Result result = result_of(attempts);
    CHECK(attempts.made == failures + 1);
    CHECK(result.seed == Context().seed + 1);
    CHECK((result.options.bodies == prepare::Bodies::keep) == (failures >= 2));
    CHECK((result.options.pieces.max_panels == 1) == (failures >= 3));
    CHECK(result.options.tabs.wanted == (failures < 4));
    REQUIRE(result.nets.notes.size() == 1);
    CHECK(english(result.nets.notes.front()).find("attempt 1") != std::string::npos);
  }
}

TEST_CASE("where none is sound, or something else is wrong, the first error is thrown") {
  Attempts none{10};
  CHECK_THROWS_WITH(result_of(none), "attempt 1");
  CHECK(none.made == 5);
  Attempts other{10, ErrorKind::no_nets};
  CHECK_THROWS_WITH(result_of(other), "attempt 1");
  CHECK(other.made == 1);
}

TEST_CASE("a glue outline that fails the check is left out, and a note says so") {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  const mesh::Surface cube = test::cube();
  for (const Vec3 by : {Vec3{}, Vec3{0.1, 0.2, 1.02}}) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : cube.points()) {
      points.push_back(p + by);
    }
    for (const FaceId f : ids<FaceId>(cube.face_count())) {
      const auto [a, b, c] = cube.vertices(f);
      faces.push_back(
          {VertexId(first + a.value()), VertexId(first + b.value()), VertexId(first + c.value())});
    }
  }
  mesh::Model model;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    model.polygon.push_back(f);
  }
  model.polygon_count = faces.size();
  model.digest = "0123456789abcdef";
  model.surface = mesh::Surface(std::move(points), std::move(faces));
  job::Options options;
  options.size.adapts = false;
  options.size.largest_extent_mm = 100.0;
  Result made = job::run(std::move(model), options, {});
  REQUIRE(made.drawn.glue_outlines.size() == 1);
  CHECK(made.nets.notes.empty());
  for (Vec2& p : made.drawn.glue_outlines[0].outlines[0]) {
    p += Vec2{20.0, 20.0};
  }
  job::StageClock clock;
  job::finish(made, clock, {});
  CHECK(made.drawn.glue_outlines.empty());
  CHECK(export_::bodies_apart(made.drawn.bodies) == 2);
  REQUIRE(made.nets.notes.size() == 1);
  CHECK(made.nets.notes.front().code == "not_glued");
}
