// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/polygon.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "support/shapes.hpp"
#include "unfold/net/outline.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/shape/clearance.hpp"
#include "unfold/tabs/shape/shapes.hpp"
#include "unfold/tree_nets.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using mesh::Surface;
using prepare::Panels;
using unfold::Nets;
using unfold::NoTab;
using unfold::Tab;
using unfold::TabOptions;

namespace {

using Loop = std::vector<Vec2>;

/// Faces in one plane, grown over flat edges.
Panels flat_panels(const Surface& s) {
  Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(s.face_count());
  for (const FaceId root : ids<FaceId>(s.face_count())) {
    if (panels.panel[root].valid()) {
      continue;
    }
    const PanelId id = panels.faces.push_back({root});
    panels.panel[root] = id;
    for (std::size_t i = 0; i < panels.faces[id].size(); ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(panels.faces[id][i], k);
        const FaceId g = s.neighbor(c);
        if (g.valid() && !panels.panel[g].valid() && std::abs(s.fold_angle(s.edge(c))) < 1e-6) {
          panels.panel[g] = id;
          panels.faces[id].push_back(g);
        }
      }
    }
  }
  return panels;
}

/// Flat edges become folds before all others, so panels stay whole.
test::FoldOrder panels_first(const Surface& s) {
  test::FoldOrder order = test::breadth_first(s);
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    order.push_back(e);
  }
  std::stable_partition(order.begin(), order.end(),
                        [&](EdgeId e) { return std::abs(s.fold_angle(e)) < 1e-6; });
  return order;
}

double point_distance(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - (a + t * (b - a)));
}

/// Distance of two convex polygons; minus the depth where they overlap.
double distance(const Loop& a, const Loop& b) {
  const double depth = test::penetration(a, b);
  if (depth >= 0.0) {
    return -depth;
  }
  double best = INFINITY;
  for (const auto& [p, q] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    for (const Vec2 corner : *p) {
      for (std::size_t i = 0; i < q->size(); ++i) {
        best = std::fmin(best, point_distance(corner, (*q)[i], (*q)[(i + 1) % q->size()]));
      }
    }
  }
  return best;
}

/// Distance of a point in space from a triangle.
double distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = normalized(cross(b - a, c - a));
  const Vec3 q = p - dot(p - a, n) * n;
  bool inside = true;
  double best = INFINITY;
  for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    inside = inside && dot(cross(v - u, q - u), n) >= 0.0;
    const double t = std::clamp(dot(p - u, v - u) / dot(v - u, v - u), 0.0, 1.0);
    best = std::fmin(best, length(p - (u + t * (v - u))));
  }
  return inside ? std::abs(dot(p - a, n)) : best;
}

/// Where a point of the tab, x along its base and y away from it, comes to lie on the model.
Vec3 glued(const Surface& s, CornerId side, double x, double y) {
  const CornerId twin = s.twin(side);
  const Vec3 from = s.point(s.vertex(twin));
  const Vec3 along = normalized(s.point(s.vertex(mesh::next(twin))) - from);
  const Vec3 inward = cross(s.normal(mesh::face_of(twin)), along);
  return from + x * along + y * inward;
}

double distance_from_panel(const Surface& s, const Panels& panels, FaceId f, Vec3 p) {
  double best = INFINITY;
  for (const FaceId g : panels.faces[panels.panel[f]]) {
    const auto [a, b, c] = s.vertices(g);
    best = std::fmin(best, distance(p, s.point(a), s.point(b), s.point(c)));
  }
  return best;
}

/// Faces of the target's net that a tab may be glued behind: reached from the panel by folds that bend by 20 degrees
/// in all, the least of all ways (brute force).
std::vector<FaceId> faces_behind(const Surface& s, const Panels& panels, const Nets& nets, FaceId target) {
  std::map<FaceId, double> bend;
  for (const FaceId f : panels.faces[panels.panel[target]]) {
    bend[f] = 0.0;
  }
  for (bool again = true; again;) {
    again = false;
    for (const CornerId c : ids<CornerId>(s.corner_count())) {
      const auto at = bend.find(mesh::face_of(c));
      if (at == bend.end() || s.is_border(s.edge(c)) || nets.use[s.edge(c)] != unfold::EdgeUse::fold) {
        continue;
      }
      const double beyond = at->second + std::abs(s.fold_angle(s.edge(c)));
      const FaceId g = s.neighbor(c);
      if (beyond <= 0.34906586 && (!bend.contains(g) || beyond < bend[g] - 1e-12)) {
        bend[g] = beyond;
        again = true;
      }
    }
  }
  std::vector<FaceId> faces;
  for (const auto& [f, angle] : bend) {
    faces.push_back(f);
  }
  return faces;
}

/// In the plane of the net; 0 inside.
double distance_from_faces(const Nets& nets, const std::vector<FaceId>& faces, Vec2 p) {
  double best = INFINITY;
  for (const FaceId f : faces) {
    double beyond = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      const Vec2 a = nets.flat[f][k];
      const Vec2 along = nets.flat[f][(k + 1) % 3] - a;
      beyond = std::fmax(beyond, -cross(along, p - a) / length(along));
    }
    best = std::fmin(best, beyond);
  }
  return best;
}

/// The part of a tab at least `height` above its base.
Loop upper_part(const Loop& tab, double height) {
  const Vec2 up = perpendicular(tab[1] - tab[0]) / length(tab[1] - tab[0]);
  Loop result;
  for (std::size_t i = 0; i < tab.size(); ++i) {
    const Vec2 a = tab[i];
    const Vec2 b = tab[(i + 1) % tab.size()];
    const double ya = dot(a - tab[0], up) - height;
    const double yb = dot(b - tab[0], up) - height;
    if (ya >= 0.0) {
      result.push_back(a);
    }
    if ((ya < 0.0) != (yb < 0.0)) {
      result.push_back(a + ya / (ya - yb) * (b - a));
    }
  }
  return result;
}

bool have_near_corners(const Loop& a, const Loop& b) {
  return std::any_of(a.begin(), a.end(), [&](Vec2 p) {
    return std::any_of(b.begin(), b.end(), [&](Vec2 q) { return length(p - q) < 1e-6; });
  });
}

/// Clearance of a tab from something of its piece: the contract's depth everywhere, and the distance asked
/// for except near a common corner.
void check_clear(const Loop& tab, const Loop& other, bool other_is_tab, const TabOptions& options) {
  const double gap = distance(tab, other);
  if (gap >= options.clearance_mm - 1e-6) {
    return;
  }
  INFO("gap " << gap);
  CHECK(gap > -1e-6);
  CHECK(have_near_corners(tab, other));
  const Loop a = upper_part(tab, unfold::corner_zone_mm);
  const Loop b = other_is_tab ? upper_part(other, unfold::corner_zone_mm) : other;
  CHECK(distance(a, b) >= options.clearance_mm - 1e-6);
}

void check_shape(const Surface& s, const Nets& nets, const Tab& tab, const TabOptions& options) {
  const auto& flat = nets.flat[mesh::face_of(tab.side)];
  const Vec2 end = flat[mesh::next(tab.side).value() % 3];
  const Vec2 start = flat[tab.side.value() % 3];
  const double size = length(start - end);
  const Vec2 x = (start - end) / size;
  const double t0 = dot(tab.polygon[0] - end, x);
  const double t1 = dot(tab.polygon[1] - end, x);
  CHECK(std::abs(dot(tab.polygon[0] - end, perpendicular(x))) < 1e-6);
  CHECK(std::abs(dot(tab.polygon[1] - end, perpendicular(x))) < 1e-6);
  CHECK(t0 >= -1e-6);
  CHECK(t1 <= size + 1e-6);
  CHECK(t1 - t0 >= 0.5 * size - 1e-6);
  double top = 0.0;
  const std::size_t n = tab.polygon.size();
  CHECK(n >= 4);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = tab.polygon[i];
    const Vec2 b = tab.polygon[(i + 1) % n];
    const Vec2 c = tab.polygon[(i + 2) % n];
    CHECK(length(b - a) > 1e-7);
    CHECK(cross(b - a, c - b) > -1e-9);  // convex and counterclockwise, hence simple
    top = std::fmax(top, dot(a - end, perpendicular(x)));
  }
  CHECK(top >= options.smallest_height_mm - 1e-6);
  CHECK(top <= options.height_mm + 1e-6);
  CHECK(std::abs(size - s.length(s.edge(tab.side))) < 1e-6 * size);
}

void check_inside_target(const Surface& s, const Panels& panels, const Nets& nets, const Tab& tab) {
  const Vec2 end = nets.flat[mesh::face_of(tab.side)][mesh::next(tab.side).value() % 3];
  const Vec2 start = nets.flat[mesh::face_of(tab.side)][tab.side.value() % 3];
  const Vec2 x = (start - end) / length(start - end);
  const FaceId target = s.neighbor(tab.side);
  const CornerId twin = s.twin(tab.side);
  const Vec2 glued_end = nets.flat[target][twin.value() % 3];
  const Vec2 glued_x = (nets.flat[target][mesh::next(twin).value() % 3] - glued_end) / length(start - end);
  const std::vector<FaceId> behind = faces_behind(s, panels, nets, target);
  for (std::size_t i = 0; i < tab.polygon.size(); ++i) {
    for (int k = 0; k < 8; ++k) {
      const Vec2 p = tab.polygon[i] + k / 8.0 * (tab.polygon[(i + 1) % tab.polygon.size()] - tab.polygon[i]);
      const Vec3 q = glued(s, tab.side, dot(p - end, x), dot(p - end, perpendicular(x)));
      const Vec2 in_net = glued_end + dot(p - end, x) * glued_x +
                          dot(p - end, perpendicular(x)) * perpendicular(glued_x);
      CHECK(std::fmin(distance_from_panel(s, panels, target, q), distance_from_faces(nets, behind, in_net)) < 0.05);
    }
  }
}

/// Everything that the contract and unfold/tabs/place/place_tabs.hpp promise, by brute force.
void check_tabs(const Surface& s, const Panels& panels, const Nets& nets, const TabOptions& options) {
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    const unfold::Join& join = nets.joins[j];
    CHECK(join.tab.valid() == (join.no_tab == NoTab::has_tab));
    if (join.tab.valid()) {
      CHECK(nets.tabs[join.tab].join == j);
      CHECK(s.edge(nets.tabs[join.tab].side) == join.edge);
    }
  }
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    const Tab& tab = nets.tabs[t];
    INFO("tab " << t.value() << " of face " << mesh::face_of(tab.side).value());
    check_shape(s, nets, tab, options);
    check_inside_target(s, panels, nets, tab);
    const PieceId piece = nets.piece[mesh::face_of(tab.side)];
    for (const FaceId f : nets.pieces[piece].faces) {
      const Loop face(nets.flat[f].begin(), nets.flat[f].end());
      if (f == mesh::face_of(tab.side)) {
        CHECK(distance(tab.polygon, face) > -1e-6);
      } else {
        INFO("face " << f.value());
        check_clear(tab.polygon, face, false, options);
      }
    }
    for (const TabId u : ids<TabId>(t.value())) {
      if (nets.piece[mesh::face_of(nets.tabs[u].side)] == piece) {
        INFO("tab " << u.value());
        check_clear(tab.polygon, nets.tabs[u].polygon, true, options);
      }
    }
  }
}

Nets with_tabs(const Surface& s, const Panels& panels, Nets nets, const TabOptions& options = {}) {
  unfold::place_tabs(s, panels, options, nets, Context());
  return nets;
}

double usable_share(const Surface& s, const Nets& nets) {
  return static_cast<double>(unfold::tabs_usable(s, nets, {})) / static_cast<double>(nets.joins.size());
}

}  // namespace

TEST_CASE("a cube's net gets a tab as asked on every cut", "[tabs]") {
  const Surface cube = test::scaled(test::cube(), 40.0);
  const Panels panels = flat_panels(cube);
  const test::FoldOrder order = panels_first(cube);
  Nets nets = test::lay_out(cube, order);
  REQUIRE_FALSE(test::faces_overlap(nets));
  REQUIRE(nets.joins.size() == 7);
  nets = with_tabs(cube, panels, nets);
  CHECK(nets.tabs.size() == 7);
  check_tabs(cube, panels, nets, {});
  std::size_t as_asked = 0;
  for (const Tab& tab : nets.tabs) {
    const double area = 0.5 * doubled_area(tab.polygon);
    as_asked += std::abs(area - 175.0) < 1e-6 ? 1U : 0U;
  }
  CHECK(as_asked == 7);
}

TEST_CASE("tabs on nets of convex hulls keep all promises", "[tabs]") {
  std::size_t clean = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const double size = seed % 3 == 0 ? 15.0 : seed % 3 == 1 ? 40.0 : 75.0;
    const Surface hull = test::scaled(test::random_hull(10 + 2 * static_cast<int>(seed), seed), size);
    Nets nets = test::lay_out(hull, test::steepest_edge(hull, seed));
    if (test::faces_overlap(nets)) {
      continue;
    }
    ++clean;
    const Panels panels = flat_panels(hull);
    nets = with_tabs(hull, panels, nets);
    INFO("seed " << seed);
    check_tabs(hull, panels, nets, {});
    CHECK(usable_share(hull, nets) > (size > 50.0 ? 0.7 : 0.0));
  }
  CHECK(clean >= 16);
}

TEST_CASE("random trees with several pieces keep all promises", "[tabs]") {
  // Faces of different pieces lie on each other in the plane, and needn't be kept apart.
  const Surface ball = test::scaled(test::sphere(14, 8), 60.0);
  const Panels panels = flat_panels(ball);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const test::FoldOrder order = test::shuffled(ball, seed);
    std::vector<EdgeId> cuts(order.end() - 90, order.end());
    const Nets nets = test::lay_out(ball, order, cuts);
    if (test::faces_overlap(nets)) {
      continue;
    }
    CHECK(nets.pieces.size() > 1);
    check_tabs(ball, panels, with_tabs(ball, panels, nets), {});
  }
}

TEST_CASE("open shapes get no tab at their borders", "[tabs]") {
  const Surface tube = test::scaled(test::revolve({{1, 0}, {1, 1}}, 12), 30.0);
  const Panels panels = flat_panels(tube);
  const Nets nets = with_tabs(tube, panels, test::lay_out(tube, test::breadth_first(tube)));
  CHECK(nets.joins.size() == 1);
  CHECK(nets.tabs.size() == 1);
  check_tabs(tube, panels, nets, {});
}

TEST_CASE("a tab stays within the angles of the face behind which it is glued", "[tabs]") {
  // A flat pyramid with a square base: its sides are triangles with small angles at the base.
  const double height = GENERATE(4.0, 10.0, 40.0);
  std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {60, 40, 0}, {0, 40, 0}, {20, 15, height}};
  const auto v = [](int i) { return VertexId(i); };
  const Surface pyramid(points, {{v(0), v(2), v(1)},
                                 {v(0), v(3), v(2)},
                                 {v(0), v(1), v(4)},
                                 {v(1), v(2), v(4)},
                                 {v(2), v(3), v(4)},
                                 {v(3), v(0), v(4)}});
  const Panels panels = flat_panels(pyramid);
  CHECK(panels.count() == 5);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Nets nets = test::lay_out(pyramid, test::shuffled(pyramid, seed));
    if (!test::faces_overlap(nets)) {
      const Nets done = with_tabs(pyramid, panels, nets);
      check_tabs(pyramid, panels, done, {});
      CHECK(done.tabs.size() >= done.joins.size() - 1);
    }
  }
}

TEST_CASE("long thin triangles", "[tabs]") {
  // A needle: a pyramid 120 mm high over a triangle of 6 mm.
  const std::vector<Vec3> points{{0, 0, 0}, {6, 0, 0}, {2, 5, 0}, {3, 2, 120}};
  const auto v = [](int i) { return VertexId(i); };
  const Surface needle(points,
                       {{v(0), v(2), v(1)}, {v(0), v(1), v(3)}, {v(1), v(2), v(3)}, {v(2), v(0), v(3)}});
  const Panels panels = flat_panels(needle);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Nets nets = test::lay_out(needle, test::shuffled(needle, seed));
    if (!test::faces_overlap(nets)) {
      check_tabs(needle, panels, with_tabs(needle, panels, nets), {});
    }
  }
}

TEST_CASE("nothing is glued behind a face without area", "[tabs]") {
  // A tetrahedron with a sliver between two of its faces.
  const double height = GENERATE(0.0, 1e-9, 1e-6);
  const std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {30, 50, 0}, {30, 20, 45}, {30, -height, 0}};
  const auto v = [](int i) { return VertexId(i); };
  const Surface shape(points, {{v(0), v(2), v(1)},
                               {v(1), v(2), v(3)},
                               {v(2), v(0), v(3)},
                               {v(0), v(4), v(3)},
                               {v(4), v(1), v(3)},
                               {v(0), v(1), v(4)}});
  // Every face its own panel, so the sliver stands alone.
  Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(shape.face_count());
  for (const FaceId f : ids<FaceId>(shape.face_count())) {
    panels.panel[f] = panels.faces.push_back({f});
  }
  std::size_t cut_around_sliver = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Nets nets = with_tabs(shape, panels, test::lay_out(shape, test::shuffled(shape, seed)));
    for (const Tab& tab : nets.tabs) {
      CHECK(shape.neighbor(tab.side) != FaceId(5));
    }
    for (unsigned k = 0; k < 3; ++k) {
      const bool is_fold = nets.use[shape.edge(mesh::corner(FaceId(5), k))] == unfold::EdgeUse::fold;
      cut_around_sliver += is_fold ? 0U : 1U;
    }
  }
  CHECK(cut_around_sliver >= 12);
}

TEST_CASE("panels that are cut between pieces are folded nowhere else", "[tabs]") {
  const std::filesystem::path file =
      std::string(RIDGECRAFT_SHARED_DIR) + "/models/unfold/frame_genus5_240.off";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: " << file << " is missing");
    return;
  }
  const Surface frame = [&] {
    const Surface read = mesh::read(file, {}, Context()).surface;
    const Vec3 size = read.bounds().size();
    return test::scaled(read, 150.0 / std::max({size.x, size.y, size.z}));
  }();
  unfold::Options options;
  options.sheet = unfold::Sheet{190.0, 277.0};
  const Nets nets =
      unfold::unfold(frame, prepare::find_panels(frame),
                     IdVector<FaceId, PartId>(frame.face_count(), PartId(0)), options, Context());
  for (const EdgeId e : ids<EdgeId>(frame.edge_count())) {
    const auto [a, b] = frame.sides(e);
    if (nets.use[e] == unfold::EdgeUse::fold) {
      CHECK(nets.piece[mesh::face_of(a)] == nets.piece[mesh::face_of(b)]);
    }
  }
  check_tabs(frame, prepare::find_panels(frame), nets, {});
}

TEST_CASE("what is left without a tab says why", "[tabs]") {
  SECTION("tabs switched off") {
    const Surface cube = test::scaled(test::cube(), 40.0);
    TabOptions off;
    off.wanted = false;
    const Nets nets = with_tabs(cube, flat_panels(cube), test::lay_out(cube, test::breadth_first(cube)), off);
    CHECK(nets.tabs.empty());
    for (const unfold::Join& join : nets.joins) {
      CHECK(join.no_tab == NoTab::not_wanted);
    }
  }
  SECTION("edges of 0.9 mm") {
    const Surface cube = test::scaled(test::cube(), 0.9);
    const Nets nets = with_tabs(cube, flat_panels(cube), test::lay_out(cube, test::breadth_first(cube)));
    for (const unfold::Join& join : nets.joins) {
      CHECK((join.tab.valid() || join.no_tab != NoTab::has_tab));
      if (cube.length(join.edge) < 1.0) {
        CHECK(join.no_tab == NoTab::edge_too_short);
      }
    }
  }
  SECTION("a ridge 60 mm long between strips of 1 mm") {
    const std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {60, 1, 0}, {0, 1, 0}, {30, 0.5, 0.3}};
    const auto v = [](int i) { return VertexId(i); };
    const Surface lens(points, {{v(0), v(2), v(1)},
                                {v(0), v(3), v(2)},
                                {v(0), v(1), v(4)},
                                {v(1), v(2), v(4)},
                                {v(2), v(3), v(4)},
                                {v(3), v(0), v(4)}});
    const Nets nets = with_tabs(lens, flat_panels(lens), test::lay_out(lens, test::shuffled(lens, 3)));
    for (const unfold::Join& join : nets.joins) {
      if (lens.length(join.edge) > 20.0) {
        CHECK(join.no_tab == NoTab::target_too_small);
      }
    }
  }
  SECTION("a flat slit") {
    const Surface grid = test::scaled(test::flat_grid(3), 30.0);
    const Nets nets = with_tabs(grid, flat_panels(grid), test::lay_out(grid, test::shuffled(grid, 2)));
    for (const unfold::Join& join : nets.joins) {
      CHECK(join.no_tab == NoTab::no_room);
    }
  }
}

TEST_CASE("the smaller face gives the tab, the larger receives it", "[tabs]") {
  // A tall box without a lid: its bottom is smaller than its walls.
  const Surface box = [] {
    const Surface cube = test::cube();
    std::vector<Vec3> points(cube.points().begin(), cube.points().end());
    for (Vec3& p : points) {
      p = {30.0 * p.x, 30.0 * p.y, 70.0 * p.z};
    }
    std::vector<std::array<VertexId, 3>> faces;
    for (const FaceId f : ids<FaceId>(cube.face_count())) {
      if (cube.normal(f).z < 0.5) {
        faces.push_back(cube.vertices(f));
      }
    }
    // Vertices of the lid are still those of the walls.
    return Surface(points, faces);
  }();
  const Panels panels = flat_panels(box);
  CHECK(panels.count() == 5);
  const Nets nets = with_tabs(box, panels, test::lay_out(box, panels_first(box)));
  check_tabs(box, panels, nets, {});
  CHECK(nets.tabs.size() == nets.joins.size());
  for (const Tab& tab : nets.tabs) {
    const bool bottom_gives = box.normal(mesh::face_of(tab.side)).z < -0.5;
    const bool bottom_receives = box.normal(box.neighbor(tab.side)).z < -0.5;
    CHECK((bottom_gives || !bottom_receives));
  }
}

TEST_CASE("turning a piece in its plane turns its tabs", "[tabs]") {
  const Surface hull = test::scaled(test::random_hull(40, 7), 50.0);
  const Panels panels = flat_panels(hull);
  Nets nets = test::lay_out(hull, test::steepest_edge(hull, 7));
  REQUIRE_FALSE(test::faces_overlap(nets));
  const Nets before = with_tabs(hull, panels, nets);
  for (const double angle : {0.3, 1.7, 4.0}) {
    Nets turned = nets;
    const auto turn = [&](Vec2 p) {
      return Vec2{std::cos(angle) * p.x - std::sin(angle) * p.y + 100.0,
                  std::sin(angle) * p.x + std::cos(angle) * p.y - 20.0};
    };
    for (auto& corners : turned.flat) {
      for (Vec2& p : corners) {
        p = turn(p);
      }
    }
    const Nets after = with_tabs(hull, panels, turned);
    REQUIRE(after.tabs.size() == before.tabs.size());
    for (const TabId t : ids<TabId>(before.tabs.size())) {
      REQUIRE(after.tabs[t].side == before.tabs[t].side);
      REQUIRE(after.tabs[t].polygon.size() == before.tabs[t].polygon.size());
      for (std::size_t i = 0; i < before.tabs[t].polygon.size(); ++i) {
        // Where two ways to trim a tab leave nearly as much, rounding decides between them.
        CHECK(length(after.tabs[t].polygon[i] - turn(before.tabs[t].polygon[i])) < 0.3);
      }
    }
  }
}

TEST_CASE("other sizes of tabs are kept to", "[tabs]") {
  const Surface hull = test::scaled(test::random_hull(30, 3), 60.0);
  const Panels panels = flat_panels(hull);
  Nets nets = test::lay_out(hull, test::steepest_edge(hull, 3));
  REQUIRE_FALSE(test::faces_overlap(nets));
  TabOptions options;
  options.height_mm = GENERATE(2.0, 3.0, 8.0);
  options.angle = GENERATE(0.6, 1.0);
  options.clearance_mm = GENERATE(0.0, 0.5);
  const Nets done = with_tabs(hull, panels, nets, options);
  CHECK(done.tabs.size() > done.joins.size() / 2);
  check_tabs(hull, panels, done, options);
}
