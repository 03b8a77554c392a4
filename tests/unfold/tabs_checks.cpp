// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs_checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::test {

using mesh::Surface;
using prepare::Panels;
using unfold::Nets;
using unfold::NoTab;
using unfold::Tab;
using unfold::TabOptions;

FoldOrder panels_first(const Surface& s) {
  FoldOrder order = breadth_first(s);
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    order.push_back(e);
  }
  std::stable_partition(order.begin(), order.end(),
                        [&](EdgeId e) { return std::abs(s.fold_angle(e)) < 1e-6; });
  return order;
}

Vec3 glued(const Surface& s, CornerId side, double x, double y) {
  const CornerId twin = s.twin(side);
  const Vec3 from = s.point(s.vertex(twin));
  const Vec3 along = normalized(s.point(s.vertex(mesh::next(twin))) - from);
  const Vec3 inward = cross(s.normal(mesh::face_of(twin)), along);
  return from + x * along + y * inward;
}

namespace {

using Loop = std::vector<Vec2>;

double point_distance(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - (a + t * (b - a)));
}

/// Distance of two convex polygons; minus the depth where they overlap.
double distance(const Loop& a, const Loop& b) {
  const double depth = penetration(a, b);
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

double distance_from_panel(const Surface& s, const Panels& panels, FaceId f, Vec3 p) {
  double best = INFINITY;
  for (const FaceId g : panels.faces[panels.panel[f]]) {
    const auto [a, b, c] = s.vertices(g);
    best = std::fmin(best, distance(p, s.point(a), s.point(b), s.point(c)));
  }
  return best;
}

/// Faces of the target's net that a tab may be glued behind: reached from the panel by folds that bend by 20
/// degrees in all, the least of all ways (brute force).
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

/// The narrowest of the strips that hold a tab, sampled: never below the true one.
double sampled_thickness(const Loop& tab) {
  double least = INFINITY;
  for (int degree = 0; degree < 180; ++degree) {
    const double turn = degree * 0.017453292519943295;
    double low = INFINITY;
    double high = -INFINITY;
    for (const Vec2 p : tab) {
      const double at = dot(p, {std::cos(turn), std::sin(turn)});
      low = std::fmin(low, at);
      high = std::fmax(high, at);
    }
    least = std::fmin(least, high - low);
  }
  return least;
}

/// How far a tab reaches beyond the ends of its base.
double overhang(const Loop& tab) {
  const Vec2 along = (tab[1] - tab[0]) / length(tab[1] - tab[0]);
  double most = 0.0;
  for (const Vec2 p : tab) {
    most = std::fmax(most, std::fmax(-dot(p - tab[0], along), dot(p - tab[1], along)));
  }
  return most;
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
  if (overhang(tab.polygon) > top + 1e-4) {  // no needle
    CHECK(sampled_thickness(tab.polygon) > std::fmin(unfold::usable_height_mm, options.height_mm) - 1e-4);
  }
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
      const Vec2 in_net =
          glued_end + dot(p - end, x) * glued_x + dot(p - end, perpendicular(x)) * perpendicular(glued_x);
      CHECK(std::fmin(distance_from_panel(s, panels, target, q), distance_from_faces(nets, behind, in_net)) <
            0.05);
    }
  }
}

}  // namespace

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

Nets with_tabs(const Surface& s, const Panels& panels, Nets nets, const TabOptions& options) {
  unfold::place_tabs({s, panels, options}, nets, Context());
  return nets;
}

}  // namespace ridgecraft::test
