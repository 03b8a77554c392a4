// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror planes are found wherever a surface lies, and maps say what lies on what.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "base/random.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "prepare/symmetry/twins.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"
#include "support/symmetric_shapes.hpp"

using namespace ridgecraft;
using prepare::find_mirrors;
using prepare::Mirror;

namespace {

/// Some turn and shift without a meaning, and a scale.
Vec3 moved(Vec3 p) {
  Motion m = turn_about({0.3, -0.2}, {0.6, 0.8}, 0.7);
  m.rows = {m.rows[2], m.rows[0], m.rows[1]};
  return 37.0 * m(p) + Vec3{5, -90, 12};
}

/// The same with its far side of x pushed in a little.
mesh::Surface no_plane(double depth) {
  return test::mapped(test::one_plane(), [&](Vec3 p) {
    return Vec3{p.x > 0.8 ? p.x - depth : p.x, p.y, p.z};
  });
}

void check_maps(const mesh::Surface& s, const Mirror& m, double tolerance) {
  REQUIRE(m.maps.whole);
  for (const VertexId v : ids<VertexId>(s.vertex_count())) {
    const VertexId w = m.maps.vertex[v];
    REQUIRE(w.valid());
    CHECK(m.maps.vertex[w] == v);
    CHECK(length(s.point(w) - m.plane.image(s.point(v))) <= tolerance);
  }
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    std::set<VertexId> images;
    std::set<VertexId> partners;
    for (const VertexId v : s.vertices(f)) {
      images.insert(m.maps.vertex[v]);
    }
    for (const VertexId v : s.vertices(m.maps.face[f])) {
      partners.insert(v);
    }
    CHECK(images == partners);
  }
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    const EdgeId partner = m.maps.edge[e];
    REQUIRE(partner.valid());
    CHECK(m.maps.edge[partner] == e);
    CHECK(s.length(partner) == Approx(s.length(e)).margin(2.0 * tolerance));
  }
}

}  // namespace

TEST_CASE("a body with one mirror plane has that one, however it is turned, scaled and numbered",
          "[symmetry]") {
  const mesh::Surface plain = test::one_plane();
  const std::vector<Mirror> found = find_mirrors(plain);
  REQUIRE(found.size() == 1);
  CHECK(found[0].exact);
  CHECK(found[0].plane.normal == Vec3{1, 0, 0});
  check_maps(plain, found[0], 1e-9);
  const mesh::Surface other = test::mapped(test::shuffled(plain, 7), moved);
  const std::vector<Mirror> again = find_mirrors(other);
  REQUIRE(again.size() == 1);
  CHECK(again[0].exact);
  const Vec3 at = moved({0, 0, 0});
  const Vec3 normal = normalized(moved({1, 0, 0}) - at);
  CHECK(std::abs(dot(normal, again[0].plane.normal)) == Approx(1.0).margin(1e-9));
  CHECK(again[0].plane.height(at) == Approx(0.0).margin(1e-6));
  check_maps(other, again[0], 1e-6);
}

TEST_CASE("a dent on one side is no mirror plane, a shallow one is told", "[symmetry]") {
  CHECK(find_mirrors(no_plane(0.1)).empty());
  const std::vector<Mirror> found = find_mirrors(no_plane(0.005));
  REQUIRE(found.size() == 1);
  CHECK_FALSE(found[0].exact);
  CHECK(found[0].deviation > 0.001);
  CHECK(found[0].deviation < 0.0055);
  // Vertices that lie on themselves nearly are connected as before.
  check_maps(no_plane(0.005), found[0], 0.006);
}

TEST_CASE("a missing face on one side is seen although all corners have partners", "[symmetry]") {
  const mesh::Surface whole = test::one_plane(12);
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(whole.face_count())) {
    const auto [a, b, c] = whole.vertices(f);
    const double side = whole.point(a).x + whole.point(b).x + whole.point(c).x;
    if (faces.size() != f.value() || side < 2.0) {
      faces.push_back(f);
    }
  }
  REQUIRE(faces.size() == whole.face_count() - 1);
  const prepare::PartOf open = prepare::part_of(whole, faces);
  CHECK(open.surface.vertex_count() == whole.vertex_count());
  CHECK(find_mirrors(open.surface).empty());
}

TEST_CASE("boxes, cubes and turned bodies have all their planes", "[symmetry]") {
  CHECK(find_mirrors(test::cube()).size() == 9);
  const mesh::Surface box = test::mapped(test::cube(), [](Vec3 p) { return Vec3{p.x, 2 * p.y, 3 * p.z}; });
  CHECK(find_mirrors(box).size() == 3);
  CHECK(find_mirrors(test::mapped(test::cube(), moved)).size() == 9);
  CHECK(find_mirrors(test::tetrahedron()).size() == 6);
  const std::vector<Vec2> cone{{0, -1}, {1, -1}, {0, 2}};
  CHECK(find_mirrors(test::revolve(cone, 7)).size() == 7);
  CHECK(find_mirrors(test::mapped(test::revolve(cone, 12), moved)).size() == 12);
  CHECK(find_mirrors(test::revolve(cone, 7), 2).size() == 2);
  for (const Mirror& m : find_mirrors(test::mapped(test::cube(), moved))) {
    CHECK(m.exact);
  }
}

TEST_CASE("a plate isn't mirrored at its own plane, nor a mirrored helix at any", "[symmetry]") {
  std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
  const mesh::Surface sheet(
      points, {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(2), VertexId(3)}});
  const std::vector<Mirror> found = find_mirrors(sheet);
  CHECK(found.size() == 2);
  for (const Mirror& m : found) {
    CHECK(m.plane.normal.z == 0.0);
  }
  const mesh::Surface twisted = test::mapped(test::voxels({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, 3), [](Vec3 p) {
    const double a = 0.4 * p.z;
    const Vec2 q{p.x - 0.5, 1.5 * (p.y - 0.5)};
    return Vec3{std::cos(a) * q.x - std::sin(a) * q.y, std::sin(a) * q.x + std::cos(a) * q.y, p.z};
  });
  CHECK(find_mirrors(twisted).empty());
}

TEST_CASE("edges between flat regions find their partners however the regions are triangulated",
          "[symmetry]") {
  mesh::Model model = test::repaired(test::soup_of(test::mapped(
      test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 2, 0}}, 3), moved)));
  prepare::remesh_panels(model, {});
  const mesh::Surface& s = model.surface;
  const prepare::Panels panels = prepare::find_panels(s);
  const std::vector<Mirror> found = find_mirrors(s);
  REQUIRE(found.size() == 1);
  CHECK(found[0].exact);
  const IdVector<EdgeId, EdgeId> partner = prepare::mirror_edges(s, found[0].plane);
  std::size_t own = 0;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    const auto [c, d] = s.sides(e);
    if (panels.panel[mesh::face_of(c)] != panels.panel[mesh::face_of(d)]) {
      REQUIRE(partner[e].valid());
      CHECK(partner[partner[e]] == e);
      CHECK(partner[e] == found[0].maps.edge[e]);
      CHECK(s.fold_angle(partner[e]) == Approx(s.fold_angle(e)).margin(1e-6));
      own += partner[e] == e ? 1U : 0U;
    }
  }
  CHECK(own > 0);
}

TEST_CASE("vertices at one place are told apart by their faces", "[symmetry]") {
  // Two bodies of one plane each that touch in corners on the common plane: their vertices there aren't one.
  const mesh::Surface upper = test::mapped(test::cube(), [](Vec3 p) {
    return Vec3{p.x - 0.5, p.y, p.z + p.y};
  });
  const mesh::Surface lower = test::mapped(test::cube(), [](Vec3 p) {
    return Vec3{p.x - 0.5, p.y, p.z + p.y - 1.0};
  });
  const mesh::Surface both = test::together({upper, lower});
  const std::vector<Mirror> found = find_mirrors(both);
  REQUIRE_FALSE(found.empty());
  const auto across = std::find_if(found.begin(), found.end(), [](const Mirror& m) {
    return m.plane.normal == Vec3{1, 0, 0};
  });
  REQUIRE(across != found.end());
  for (const FaceId f : ids<FaceId>(both.face_count())) {
    if (across->maps.face[f].valid()) {
      CHECK(both.component(across->maps.face[f]) == both.component(f));
    }
  }
}

TEST_CASE("edges that can't be told apart are paired all the same, each with one", "[symmetry]") {
  // Boxes in stacks: edges of equal boxes lie upon each other, and their normals look the same ways.
  const auto stack = [](double x) {
    const auto box = [&](double z) {
      return test::mapped(test::cube(), [&](Vec3 p) { return Vec3{p.x + x, p.y, p.z + z}; });
    };
    return test::together({box(0.0), box(1.0), box(2.0), box(1.0)});
  };
  const mesh::Surface both = test::shuffled(test::together({stack(1.0), stack(-2.0)}), 2);
  const IdVector<EdgeId, EdgeId> partner = prepare::mirror_edges(both, {{1, 0, 0}, 0.0});
  const prepare::Panels panels = prepare::find_panels(both);
  for (const EdgeId e : ids<EdgeId>(both.edge_count())) {
    const auto [c, d] = both.sides(e);
    if (panels.panel[mesh::face_of(c)] != panels.panel[mesh::face_of(d)]) {
      REQUIRE(partner[e].valid());
      CHECK(partner[partner[e]] == e);
    }
  }
}

TEST_CASE("a scan that is symmetric only nearly has its plane and pairs of edges where they are near",
          "[symmetry]") {
  Random random(3);
  const mesh::Surface scan = test::mapped(test::one_plane(40), [&](Vec3 p) {
    const auto noise = [&] { return 0.004 * (random.unit() - 0.5); };
    return p + Vec3{noise(), noise(), noise()};
  });
  const mesh::Surface turned = test::mapped(test::shuffled(scan, 5), moved);
  const std::vector<Mirror> found = find_mirrors(turned);
  REQUIRE(found.size() == 1);
  CHECK_FALSE(found[0].exact);
  const Vec3 normal = normalized(moved({1, 0, 0}) - moved({0, 0, 0}));
  CHECK(std::abs(dot(normal, found[0].plane.normal)) > 0.99999);
  CHECK(found[0].maps.whole);
}

TEST_CASE("who needs one plane gets an exact one first, then the others until one is of use", "[symmetry]") {
  const mesh::Surface cube = test::mapped(test::cube(), moved);
  int offered = 0;
  prepare::for_mirrors(cube, 16, {}, [&](const Mirror& mirror) {
    CHECK(mirror.exact);
    return ++offered == 1;
  });
  CHECK(offered == 1);
  offered = 0;
  prepare::for_mirrors(cube, 16, {}, [&](const Mirror&) {
    ++offered;
    return false;
  });
  CHECK(offered == 9);
  // Of two planes that are near ones both, the nearer one is first.
  const mesh::Surface box = test::mapped(test::voxels({{0, 0, 0}}, 6), [](Vec3 p) {
    const bool corner = p == Vec3{1.0, 1.0, 0.0};
    return Vec3{4.0 * p.x + (corner ? 0.006 : 0.0), 2.0 * p.y, p.z + (corner ? 0.002 : 0.0)};
  });
  std::vector<double> deviations;
  prepare::for_mirrors(box, 3, {.near = 0.003}, [&](const Mirror& mirror) {
    CHECK_FALSE(mirror.exact);
    deviations.push_back(mirror.deviation);
    return false;
  });
  CHECK(deviations.size() == 3);
  CHECK(std::is_sorted(deviations.begin(), deviations.end()));
}

TEST_CASE("how far a fine scan is off its mirror image is what a search among all faces says", "[symmetry]") {
  Random random(7);
  const mesh::Surface scan = test::mapped(test::sphere(300, 150), [&](Vec3 p) {
    const auto noise = [&] { return 0.002 * (random.unit() - 0.5); };
    const double bump = 1.0 + 0.1 * p.y + 0.3 * p.x * p.x * p.z;
    return bump * p + Vec3{noise(), noise(), noise()};
  });
  const std::vector<Mirror> found = find_mirrors(scan);
  REQUIRE_FALSE(found.empty());
  const mesh::SurfaceTree tree(scan, INFINITY);
  double farthest = 0.0;
  for (const Vec3 p : scan.points()) {
    farthest = std::max(farthest, tree.distance(found[0].plane.image(p), 0.0));
  }
  CHECK(found[0].deviation == Approx(farthest));
}

TEST_CASE("a single corner that sticks out on one side of a fine surface is seen", "[symmetry]") {
  const auto lump = [](bool badge) {
    const mesh::Surface round = test::sphere(330, 170);
    std::vector<Vec3> points;
    for (const Vec3 p : round.points()) {
      points.push_back((1.0 + 0.1 * p.y + 0.3 * p.x * p.x * p.z + 0.2 * p.y * p.z) * p);
    }
    // No corner that a comparison in places looks at.
    points[28001] = (badge ? 1.2 : 1.0) * points[28001];
    std::vector<std::array<VertexId, 3>> faces;
    for (const FaceId f : ids<FaceId>(round.face_count())) {
      faces.push_back(round.vertices(f));
    }
    return mesh::Surface(std::move(points), std::move(faces));
  };
  for (const bool badge : {false, true}) {
    CAPTURE(badge);
    int offered = 0;
    prepare::for_mirrors(lump(badge), 3, {}, [&](const Mirror& mirror) {
      offered += std::abs(mirror.plane.normal.x) > 0.9 ? 1 : 0;
      return true;
    });
    CHECK(offered == (badge ? 0 : 1));
  }
}

TEST_CASE("some faces become a surface that knows where it came from", "[symmetry]") {
  const mesh::Surface two = test::together({test::cube(), test::mapped(test::cube(), [](Vec3 p) {
                                              return p + Vec3{3, 0, 0};
                                            })});
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(two.face_count())) {
    if (two.component(f) == ComponentId(1)) {
      faces.push_back(f);
    }
  }
  const prepare::PartOf part = prepare::part_of(two, faces);
  test::check_invariants(part.surface);
  CHECK(part.surface.face_count() == 12);
  CHECK(part.surface.vertex_count() == 8);
  for (const VertexId v : ids<VertexId>(part.surface.vertex_count())) {
    CHECK(part.surface.point(v) == two.point(part.vertex[v]));
  }
  for (const EdgeId e : ids<EdgeId>(part.surface.edge_count())) {
    CHECK(part.surface.length(e) == two.length(part.edge[e]));
  }
}

// Equal bodies are found wherever they lie, and nothing else is.

using prepare::Twin;

namespace {

Vec3 turned(Vec3 p, double angle, Vec3 shift) {
  Motion m = turn_about({0.1, 0.4}, {0.6, 0.8}, angle);
  m.rows = {m.rows[1], m.rows[2], m.rows[0]};
  return m(p) + shift;
}

/// No symmetry at all.
mesh::Surface odd() {
  return test::mapped(test::sphere(10, 7), [](Vec3 p) {
    return Vec3{p.x * (1.0 + 0.3 * p.z + 0.2 * p.y), 1.7 * p.y + 0.3 * p.x * p.z, p.z + 0.2 * p.y * p.y};
  });
}

mesh::Surface wheel() {
  return test::revolve({{0, 0}, {1, 0}, {1.2, 0.2}, {1, 0.4}, {0, 0.4}}, 16);
}

mesh::Surface placed(const mesh::Surface& s, double angle, Vec3 shift) {
  return test::mapped(s, [&](Vec3 p) { return turned(p, angle, shift); });
}

mesh::Surface mirrored(const mesh::Surface& s) {
  std::vector<std::array<VertexId, 3>> faces;
  std::vector<Vec3> points;
  for (const Vec3 p : s.points()) {
    points.push_back({-p.x, p.y, p.z});
  }
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    faces.push_back({a, c, b});
  }
  return {points, faces};
}

std::vector<std::vector<Twin>> twins(const mesh::Surface& s) {
  return prepare::find_twins(s, prepare::components(s), {});
}

void check(const mesh::Surface& s, const Twin& t, double tolerance) {
  for (const auto& [v, w] : t.vertices) {
    CHECK(length(t.motion(s.point(v)) - s.point(w)) <= tolerance);
  }
  for (const auto& [e, g] : t.edges) {
    CHECK(s.length(e) == Approx(s.length(g)).margin(2.0 * tolerance));
    CHECK(s.fold_angle(e) == Approx(s.fold_angle(g)).margin(0.01));
  }
  for (const auto& [f, g] : t.faces) {
    CHECK(s.area(f) == Approx(s.area(g)).margin(1e-3));
  }
}

}  // namespace

TEST_CASE("wheels and odd bodies find their twins, mirrored ones too, however they lie", "[symmetry]") {
  const mesh::Surface all = test::shuffled(
      test::together({odd(), placed(wheel(), 0.3, {5, 0, 0}), placed(odd(), 1.1, {0, 9, 3}),
                      placed(wheel(), 2.0, {0, 0, 8}), placed(mirrored(odd()), 0.4, {-7, 0, 0}),
                      placed(wheel(), 2.9, {9, 9, 9}), placed(test::cube(), 0.2, {20, 0, 0})}),
      11);
  const std::vector<std::vector<Twin>> found = twins(all);
  REQUIRE(found.size() == 2);
  std::size_t mirrors = 0;
  for (const std::vector<Twin>& group : found) {
    REQUIRE(group.size() == 3);
    CHECK(group[0].deviation == 0.0);
    for (const Twin& t : group) {
      CHECK(t.deviation < 1e-9);
      CHECK(t.whole);
      mirrors += t.motion.mirrors ? 1U : 0U;
      check(all, t, 1e-9);
    }
  }
  // One of the odd bodies against the two others, whichever comes first.
  CHECK(mirrors >= 1);
  CHECK(mirrors <= 2);
}

TEST_CASE("bodies that differ in size or shape are no twins", "[symmetry]") {
  const mesh::Surface dented = test::mapped(wheel(), [](Vec3 p) {
    return p.x > 1.1 ? p - Vec3{0.1, 0, 0} : p;
  });
  CHECK(twins(test::together({wheel(), placed(test::scaled(wheel(), 1.01), 0.5, {5, 0, 0})})).empty());
  CHECK(twins(test::together({wheel(), placed(dented, 0.5, {5, 0, 0})})).empty());
  CHECK(twins(test::together({wheel(), placed(odd(), 0.5, {5, 0, 0})})).empty());
}

TEST_CASE("parts of one component may be twins", "[symmetry]") {
  // The two halves of a sphere.
  const mesh::Surface s = test::sphere(12, 8);
  std::vector<std::vector<FaceId>> halves(2);
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    halves[s.point(a).z + s.point(b).z + s.point(c).z > 0.0 ? 0 : 1].push_back(f);
  }
  const std::vector<std::vector<Twin>> found = prepare::find_twins(s, halves, {});
  REQUIRE(found.size() == 1);
  CHECK(found[0].size() == 2);
  check(s, found[0][1], 1e-9);
}
