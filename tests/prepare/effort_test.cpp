// SPDX-License-Identifier: GPL-3.0-or-later
// How much work a model is, before it is unfolded and afterwards.
#include "prepare/prepared/effort.hpp"

#include <catch2/catch.hpp>

#include "prepare/common_models.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/rolls.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using prepare::Work;

namespace {

constexpr double hidden = 0.05;

Work work_of(const mesh::Surface& surface, double mm = 1.0) {
  return prepare::expected_work(surface, prepare::find_panels(surface), {}, hidden, mm);
}

}  // namespace

TEST_CASE("the work on a cube is that of its squares and edges", "[effort]") {
  const Work work = work_of(test::scaled(test::cube(), 60.0));
  // Twelve edges around six squares of one piece: five are folded.
  CHECK(work.folds + work.joins == 12.0);
  CHECK(work.folds + work.pieces == 6.0);
  CHECK(work.short_edges == 0.0);
  CHECK(work.seam_mm > 0.5 * 60.0 * work.joins);
  CHECK(work.seam_mm < 60.0 * work.joins);
  CHECK(prepare::excess(work, {}) == 0.0);
}

TEST_CASE("a small cube has nothing but short edges, and tabs that don't hold", "[effort]") {
  const Work work = work_of(test::scaled(test::cube(), 3.0));
  CHECK(work.short_share() == 1.0);
  CHECK(work.weak_share() > 0.2);
  CHECK(prepare::excess(work, {}) > 9.0);
  CHECK(prepare::minutes_of(work) > 12.0 * 0.3);
}

TEST_CASE("what is rolled isn't folded", "[effort]") {
  const mesh::Surface can = test::revolve({{0, 0}, {30, 0}, {30, 60}, {0, 60}}, 24);
  const prepare::Panels panels = prepare::find_panels(can);
  const Work folded = work_of(can);
  const Work rolled = prepare::expected_work(
      can, panels, prepare::find_rolls(can, panels, {.which = prepare::Rolled::always}), hidden);
  CHECK(folded.folds - rolled.folds >= 20.0);
  CHECK(rolled.folds + rolled.joins == 48.0);  // the rims
}

TEST_CASE("what is rolled is less work than what is folded, and of the same size", "[effort]") {
  // A vase that is too much work as it is, a pillar of few sides, and one that is better folded.
  for (const auto& surface :
       {test::revolve({{0, 0}, {20, 0}, {35, 30}, {15, 60}, {18, 80}, {30, 100}, {12, 130}, {16, 150}}, 90),
        test::revolve({{0, 0}, {60, 0}, {60, 150}, {0, 150}}, 12),
        test::revolve({{0, 0}, {60, 0}, {60, 150}, {0, 150}}, 6)}) {
    prepare::SimplifyOptions options;
    const auto prepared = [&](prepare::Rolled which) {
      options.rolls.which = which;
      return prepare::prepare(test::model_of(surface), {}, options, test::page, {});
    };
    const prepare::Prepared folded = prepared(prepare::Rolled::never);
    const prepare::Prepared best = prepared(prepare::Rolled::automatic);
    CHECK(best.model.surface.bounds().largest_extent() ==
          Approx(folded.model.surface.bounds().largest_extent()));
    CHECK(best.work.folds <= folded.work.folds);
    CHECK(best.rolls.rolls.empty() == (best.work.folds == folded.work.folds));
  }
}

TEST_CASE("work doesn't depend on the unit of a surface", "[effort]") {
  const mesh::Surface sphere = test::sphere(24, 12);
  const Work mm = work_of(test::scaled(sphere, 50.0));
  const Work other = work_of(sphere, 50.0);
  CHECK(prepare::minutes_of(mm) == Approx(prepare::minutes_of(other)));
  CHECK(mm.short_edges == other.short_edges);
  CHECK(mm.weak_mm == Approx(other.weak_mm));
}

TEST_CASE("more faces of one shape are more work", "[effort]") {
  double before = 0.0;
  for (const int n : {8, 12, 16, 24, 32}) {
    const double now = prepare::minutes_of(work_of(test::scaled(test::sphere(n, n / 2), 75.0)));
    CHECK(now > before);
    before = now;
  }
}

TEST_CASE("a model that is too much work gets the faces that its hours allow", "[effort]") {
  std::size_t before = 0;
  for (const double hours : {3.0, 4.0, 6.0, 8.0}) {
    prepare::SimplifyOptions options;
    options.rolls.which = prepare::Rolled::never;
    options.budget.hours = hours;
    options.most_own_hours = hours;
    const prepare::Prepared p =
        prepare::prepare(test::model_of(test::sphere(96, 48)), {}, options, {{190.0, 277.0}, 5.0}, {});
    CHECK(prepare::minutes_of(p.work) <= 1.05 * 60.0 * hours);
    CHECK(prepare::minutes_of(p.work) > 0.7 * 60.0 * hours);
    CHECK(p.model.surface.face_count() > before);
    before = p.model.surface.face_count();
  }
}

TEST_CASE("a model that can be folded stays as it is up to ten hours", "[effort]") {
  // 480 triangles of 12 mm: some seven hours.
  const mesh::Surface sphere = test::sphere(24, 11);
  prepare::SimplifyOptions folded;
  folded.rolls.which = prepare::Rolled::never;
  const prepare::Prepared kept =
      prepare::prepare(test::model_of(sphere), {}, folded, {{190.0, 277.0}, 5.0}, {});
  CHECK(prepare::minutes_of(kept.work) > 240.0);
  CHECK(kept.model.surface.face_count() == sphere.face_count());
  prepare::SimplifyOptions evening = folded;
  evening.most_own_hours = evening.budget.hours;
  const prepare::Prepared fewer =
      prepare::prepare(test::model_of(sphere), {}, evening, {{190.0, 277.0}, 5.0}, {});
  CHECK(fewer.model.surface.face_count() < sphere.face_count());
}
