// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions that are larger than the page: cut straight, seldom, and into cells that fit.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/panels/page_cuts.hpp"
#include "prepare/prepare.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::PanelRoom;
using prepare::Prepared;

namespace {

/// A4 with borders of 10 mm and tabs of 5 mm.
constexpr PanelRoom a4_page{{190.0, 277.0}, 5.0};
constexpr Vec2 room{180.0, 267.0};

Prepared prepared(const mesh::Surface& surface, double size_mm) {
  prepare::SimplifyOptions keep;
  keep.mode = prepare::Simplification::keep;
  prepare::SizeOptions size;
  size.largest_extent_mm = size_mm;
  return prepare::prepare(test::repaired(test::soup_of(surface)), size, keep, a4_page, {});
}

/// The corners of a panel in its plane.
std::vector<Vec2> corners(const Prepared& p, PanelId id) {
  const mesh::Surface& s = p.model.surface;
  const Vec3 normal = s.normal(p.panels.faces[id][0]);
  const Vec3 x = normalized(cross(normal, std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 y = cross(normal, x);
  std::vector<Vec2> points;
  for (const FaceId f : p.panels.faces[id]) {
    for (const VertexId v : s.vertices(f)) {
      points.push_back({dot(s.point(v), x), dot(s.point(v), y)});
    }
  }
  return points;
}

double area(const Prepared& p, PanelId id) {
  double sum = 0.0;
  for (const FaceId f : p.panels.faces[id]) {
    sum += p.model.surface.area(f);
  }
  return sum;
}

/// Faces of each panel hang together, every face is in one, and each fits.
void check_cells(const Prepared& p) {
  test::check_invariants(p.model.surface);
  std::size_t faces = 0;
  for (const PanelId id : ids<PanelId>(p.panels.count())) {
    faces += p.panels.faces[id].size();
    CHECK(std::is_sorted(p.panels.faces[id].begin(), p.panels.faces[id].end()));
    CHECK(prepare::fits_page(corners(p, id), {a4_page.sheet.width, a4_page.sheet.height}));
    for (const FaceId f : p.panels.faces[id]) {
      CHECK(p.panels.panel[f] == id);
    }
  }
  CHECK(faces == p.model.surface.face_count());
}

/// An L of three unit squares, `depth` thick.
mesh::Surface ell(double depth) {
  std::vector<Vec3> points;
  const std::vector<Vec2> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const double z : {0.0, depth}) {
    for (const Vec2 p : outline) {
      points.push_back({p.x, p.y, z});
    }
  }
  std::vector<std::array<VertexId, 3>> faces;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  for (const auto& [a, b, c] :
       std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    add(a, c, b);
    add(a + 6, b + 6, c + 6);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    add(i, j, j + 6);
    add(i, j + 6, i + 6);
  }
  return {std::move(points), std::move(faces)};
}

mesh::Surface turned(const mesh::Surface& surface, double angle) {
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    const double x = std::cos(angle) * p.x - std::sin(angle) * p.y;
    const double y = std::sin(angle) * p.x + std::cos(angle) * p.y;
    points.push_back({x, std::cos(0.7) * y - std::sin(0.7) * p.z, std::sin(0.7) * y + std::cos(0.7) * p.z});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(surface.vertices(f));
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("what fits the page when turned", "[divide_panels]") {
  const std::vector<Vec2> right{{0, 0}, {4, 0}, {0, 3}};
  CHECK(prepare::fits_page(right, {4, 3}));
  CHECK(prepare::fits_page(right, {3, 4}));
  CHECK(prepare::fits_page(right, {5, 2.4}));
  CHECK_FALSE(prepare::fits_page(right, {4, 2.3}));
  CHECK_FALSE(prepare::fits_page(right, {3.9, 2.9}));
  const std::vector<Vec2> needle{{0, 0}, {300, 0}, {299, 2}};
  CHECK(prepare::fits_page(needle, {190, 270}));
  CHECK_FALSE(prepare::fits_page({{0, 0}, {331, 0}, {330, 2}}, {190, 270}));
}

TEST_CASE("a panel that fits the page stays whole", "[divide_panels]") {
  for (const double size : {150.0, 185.0, 190.0}) {
    const Prepared p = prepared(test::cube(), size);
    CHECK(p.panels.count() == 6);
    CHECK(p.divided_panels == 0);
    CHECK(p.model.surface.face_count() == 12);
  }
}

TEST_CASE("squares larger than the page become equal rectangles, as few as fit", "[divide_panels]") {
  // Side of the cube, cells along the two sides of a square.
  const std::vector<std::array<double, 3>> cases{{191, 1, 2}, {200, 1, 2}, {260, 1, 2},
                                                 {267, 1, 2}, {270, 2, 2}, {300, 2, 2},
                                                 {360, 2, 2}, {500, 2, 3}, {900, 4, 5}};
  for (const auto& [side, across, along] : cases) {
    const Prepared p = prepared(test::cube(), side);
    INFO("cube of " << side << " mm");
    check_cells(p);
    CHECK(p.divided_panels == 6);
    CHECK(p.panels.count() == static_cast<std::size_t>(6.0 * across * along));
    CHECK(test::volume(p.model.surface) == Approx(side * side * side));
    // Lines have vertices where they end or cross, and nowhere else.
    const mesh::Surface& s = p.model.surface;
    std::size_t cuts = 0;
    for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
      const auto [c, d] = s.sides(e);
      const FaceId f = mesh::face_of(c);
      const FaceId g = mesh::face_of(d);
      cuts += p.panels.panel[f] != p.panels.panel[g] && dot(s.normal(f), s.normal(g)) > 0.9 ? 1U : 0U;
    }
    CHECK(cuts == static_cast<std::size_t>(6.0 * (across * (along - 1) + along * (across - 1))));
    for (const PanelId id : ids<PanelId>(p.panels.count())) {
      CHECK(prepare::fits_page(corners(p, id), room));
      CHECK(area(p, id) == Approx(side * side / (across * along)));
    }
  }
}

TEST_CASE("cells don't depend on how the model lies", "[divide_panels]") {
  for (const double depth : {0.1, 0.6}) {
    const mesh::Surface shape = ell(depth);
    prepare::SimplifyOptions keep;
    keep.mode = prepare::Simplification::keep;
    prepare::SizeOptions size;
    size.mm_per_unit = 160.0;
    std::vector<std::vector<double>> areas;
    for (const double angle : {0.0, 0.4, 2.0}) {
      const Prepared p =
          prepare::prepare(test::repaired(test::soup_of(turned(shape, angle))), size, keep, a4_page, {});
      check_cells(p);
      std::vector<double>& own = areas.emplace_back();
      for (const PanelId id : ids<PanelId>(p.panels.count())) {
        own.push_back(area(p, id));
      }
      std::sort(own.begin(), own.end());
    }
    for (const std::vector<double>& own : areas) {
      REQUIRE(own.size() == areas[0].size());
      for (std::size_t i = 0; i < own.size(); ++i) {
        CHECK(own[i] == Approx(areas[0][i]).epsilon(1e-4));
      }
    }
  }
}

TEST_CASE("an L is cut at its concave corner, where the arms are as wide as the page", "[divide_panels]") {
  prepare::SimplifyOptions keep;
  keep.mode = prepare::Simplification::keep;
  prepare::SizeOptions size;
  size.mm_per_unit = 130.0;
  // 260 by 260 with arms 130 wide: 130 by 260 and 130 by 130 are two pieces.
  const Prepared p = prepare::prepare(test::repaired(test::soup_of(ell(0.1))), size, keep, a4_page, {});
  check_cells(p);
  CHECK(p.divided_panels == 2);
  CHECK(p.panels.count() == 6 + 2 * 2);
}

TEST_CASE("fans, needles and discs are cut into cells that fit and are no slivers", "[divide_panels]") {
  for (const double size : {400.0, 700.0}) {
    for (const int n : {3, 5, 8, 40}) {
      const Prepared p = prepared(test::revolve({{0, 0}, {1, 0}, {1, 0.2}, {0, 0.2}}, n), size);
      INFO(n << " corners, " << size << " mm");
      check_cells(p);
      CHECK(p.divided_panels >= 2);
      double whole = 0.0;
      double least = INFINITY;
      for (const PanelId id : ids<PanelId>(p.panels.count())) {
        whole += area(p, id);
        least = std::min(least, area(p, id));
      }
      CHECK(least > 12.0 * 10.0);
      // A page is filled by a third in the mean, the walls apart.
      CHECK(static_cast<double>(p.panels.count()) - 3.0 * n < 3.0 * whole / (room.x * room.y) + 2.0);
    }
  }
}

TEST_CASE("a page without room for tabs still gets cells", "[divide_panels]") {
  prepare::SimplifyOptions keep;
  keep.mode = prepare::Simplification::keep;
  prepare::SizeOptions size;
  size.largest_extent_mm = 30.0;
  const Prepared p =
      prepare::prepare(test::repaired(test::soup_of(test::cube())), size, keep, {{12.0, 20.0}, 5.0}, {});
  test::check_invariants(p.model.surface);
  for (const PanelId id : ids<PanelId>(p.panels.count())) {
    CHECK(prepare::fits_page(corners(p, id), {12.0, 20.0}));
  }
}

TEST_CASE("two large faces back to back are divided, too", "[divide_panels]") {
  const VertexId a{0}, b{1}, c{2};
  const mesh::Surface both({{0, 0, 0}, {3, 0, 0}, {1, 2, 0}}, {{a, b, c}, {a, c, b}});
  for (const double size : {450.0, 600.0, 1500.0}) {
    const Prepared p = prepared(both, size);
    INFO(size << " mm");
    check_cells(p);
    CHECK(p.divided_panels == 2);
    double area_of_all = 0.0;
    for (const PanelId id : ids<PanelId>(p.panels.count())) {
      area_of_all += area(p, id);
    }
    CHECK(area_of_all == Approx(2.0 * size * size / 3.0));
  }
}

TEST_CASE("the same cells come out each time", "[divide_panels]") {
  const auto once = [] { return prepared(test::revolve({{0, 0}, {1, 0}, {0.5, 1}, {0, 1}}, 7), 600.0); };
  const Prepared a = once();
  const Prepared b = once();
  CHECK(a.panels.panel.items() == b.panels.panel.items());
  CHECK(std::equal(a.model.surface.points().begin(), a.model.surface.points().end(),
                   b.model.surface.points().begin(), b.model.surface.points().end()));
}
