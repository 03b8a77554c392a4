// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that have a corner close to their longest side go, and nothing else changes.
#include "prepare/simplify/slivers.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/domains/find_domain.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/panels.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;

namespace {

/// A box of 40 x 30 x 20 mm that has a corner on one long edge more, pushed off by some of a millimetre: the
/// two sides beside it and one sliver meet there. `twice`: on the opposite edge, too.
mesh::Model box_with_sliver(double push, double along, bool twice) {
  std::vector<Vec3> points{{0, 0, 0},  {40, 0, 0},  {40, 30, 0},  {0, 30, 0},
                           {0, 0, 20}, {40, 0, 20}, {40, 30, 20}, {0, 30, 20}};
  points.push_back({40 * along, -push, 20 - push});
  std::vector<std::vector<std::uint32_t>> faces{{0, 3, 2},    {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {1, 2, 6, 5},
                                                {3, 0, 4, 7}, {4, 8, 5}, {0, 8, 4}, {0, 1, 8}, {1, 5, 8}};
  if (twice) {
    points.push_back({40 * along, 30 + push, 20 - push});
    for (const auto& face :
         std::vector<std::vector<std::uint32_t>>{{7, 6, 9}, {3, 7, 9}, {3, 9, 2}, {2, 9, 6}}) {
      faces.push_back(face);
    }
  } else {
    faces.push_back({2, 3, 7, 6});
  }
  return test::repaired(test::soup(points, faces));
}

mesh::Model rod(std::uint32_t sides, double radius, double height) {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces(2);
  for (const double z : {0.0, height}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    faces[0].push_back(sides - 1 - i);
    faces[1].push_back(sides + i);
    faces.push_back({i, (i + 1) % sides, sides + (i + 1) % sides, sides + i});
  }
  return test::repaired(test::soup(points, faces));
}

std::size_t slivers(const mesh::Surface& surface) {
  return prepare::count_narrow_faces(surface, prepare::find_panels(surface), prepare::sliver_mm);
}

std::size_t removed(mesh::Model& model) {
  const mesh::LooseFaces all = mesh::take_apart(model);
  prepare::FundamentalDomain domain = prepare::fundamental_domain(model, 1e-6, {});
  const std::size_t count = prepare::remove_slivers(domain, prepare::sliver_mm);
  mesh::put_together(model, prepare::expand(domain, all));
  return count;
}

}  // namespace

TEST_CASE("a sliver between two walls goes and the surface moves by less than its width", "[slivers]") {
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const double push = 0.1 + 0.3 * random.unit();
    const double along = 0.2 + 0.6 * random.unit();
    mesh::Model model = box_with_sliver(push, along, false);
    const mesh::Surface before = model.surface;
    REQUIRE(slivers(before) == 1);
    CHECK(removed(model) == 1);
    CHECK(slivers(model.surface) == 0);
    CHECK(model.surface.face_count() == before.face_count());
    test::check_invariants(model.surface);
    const mesh::SurfaceTree was(before, 0.5);
    const mesh::SurfaceTree is(model.surface, 0.5);
    CHECK(mesh::greatest_distance(is, was, INFINITY, {}) < 1.5 * push);
    CHECK(mesh::greatest_distance(was, is, INFINITY, {}) < 1.5 * push);
  }
}

TEST_CASE("slivers of both sides of a mirror plane go alike", "[slivers]") {
  mesh::Model model = box_with_sliver(0.3, 0.4, true);
  REQUIRE(slivers(model.surface) == 2);
  CHECK(removed(model) == 2);
  CHECK(slivers(model.surface) == 0);
  test::check_invariants(model.surface);
  const prepare::FundamentalDomain domain = prepare::fundamental_domain(model, 1e-9, {});
  CHECK(domain.symmetric());
}

TEST_CASE("the size is chosen as if no edges were turned, and the verdict is of what is left", "[slivers]") {
  // Four boxes with slivers on both long edges, and a fine rod, which is why the model is simplified.
  const mesh::Model box = box_with_sliver(0.5, 0.4, true);
  mesh::Soup row;
  const auto add = [&](const mesh::Surface& surface, Vec3 shift) {
    const auto first = static_cast<std::uint32_t>(row.points.size());
    for (const Vec3& p : surface.points()) {
      row.points.push_back(p + shift);
    }
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      for (const VertexId v : surface.vertices(f)) {
        row.corner_point.push_back(first + v.value());
      }
      row.first_corner.push_back(static_cast<std::uint32_t>(row.corner_point.size()));
    }
  };
  for (int i = 0; i < 4; ++i) {
    add(box.surface, {50.0 * i, 0.0, 0.0});
  }
  add(rod(24, 4.0, 30.0).surface, {20.0, 60.0, 0.0});
  prepare::SizeOptions size;
  size.adapts = true;
  const prepare::PanelRoom page{{190.0, 277.0}, 5.0};
  const prepare::Prepared made = prepare::prepare(test::repaired(row), size, {}, page, {});
  CHECK(made.size_reason == prepare::SizeReason::folds);
  CHECK(made.model.surface.bounds().largest_extent() > 150.0);
  // At the size that is asked for they are turned, and it can be folded.
  size.adapts = false;
  const prepare::Prepared asked = prepare::prepare(test::repaired(row), size, {}, page, {});
  CHECK(asked.simplified.edges_turned == 8);
  CHECK(asked.sliver_fraction == 0.0);
  CHECK(prepare::can_be_folded(asked));
}

TEST_CASE("what is no sliver stays", "[slivers]") {
  mesh::Model wide = box_with_sliver(1.5, 0.5, false);  // 2.1 mm
  CHECK(removed(wide) == 0);
  // The faces beside the sliver's longest side would turn by more than a wall may.
  mesh::Model narrow =
      test::repaired(test::soup({{0, 0, 0}, {40, 0, 0}, {20, 30, 0}, {20, -0.1, -0.6}, {20, 1.5, -20}},
                                {{0, 1, 2}, {0, 3, 1}, {0, 4, 3}, {3, 4, 1}, {0, 2, 4}, {1, 4, 2}}));
  const std::size_t before = slivers(narrow.surface);
  removed(narrow);
  CHECK(slivers(narrow.surface) <= before);
  test::check_invariants(narrow.surface);
}
