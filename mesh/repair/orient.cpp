// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/orient.hpp"

#include <algorithm>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "mesh/repair/pair_faces.hpp"

namespace ridgecraft::mesh {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Do all edges have one use, or two in opposite directions?
bool edges_are_sound(const std::vector<EdgeUse>& uses) {
  bool sound = true;
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    sound = sound && (j - i == 1 || (j - i == 2 && uses[i].forward != uses[i + 1].forward));
  });
  return sound;
}

/// Is each point's set of triangles one fan? Only for sound edges.
bool vertices_are_sound(const TriangleList& list, const std::vector<EdgeUse>& uses) {
  DisjointSets fans(3 * list.triangles.size());
  std::size_t joined = 0;
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    if (j - i == 2) {
      const EdgeUse& a = uses[i];
      const EdgeUse& b = uses[i + 1];
      // The sides run against each other: the first corner of one is the second of the other.
      joined += fans.join(3 * a.triangle + a.side, 3 * b.triangle + (b.side + 1U) % 3) ? 1U : 0U;
      joined += fans.join(3 * a.triangle + (a.side + 1U) % 3, 3 * b.triangle + b.side) ? 1U : 0U;
    }
  });
  std::vector<bool> used(list.points.size(), false);
  std::size_t points = 0;
  for (const Triangle& t : list.triangles) {
    for (const std::uint32_t p : t.points) {
      points += used[p] ? 0U : 1U;
      used[p] = true;
    }
  }
  return 3 * list.triangles.size() - joined == points;
}

/// Told by CGAL what it does; it takes visitors by value.
struct Watcher : pmp::Default_orientation_visitor {
  std::vector<std::uint8_t>* reversed = nullptr;
  void polygon_orientation_reversed(std::size_t i) { (*reversed)[i] ^= 1U; }
};

/// One run of CGAL's orientation. The "points" that CGAL copies are their own numbers, so that a copy tells
/// its origin.
void orient_once(TriangleList& list) {
  std::vector<std::uint32_t> origin(list.points.size());
  for (std::uint32_t i = 0; i < origin.size(); ++i) {
    origin[i] = i;
  }
  std::vector<std::array<std::uint32_t, 3>> polygons;
  polygons.reserve(list.triangles.size());
  for (const Triangle& t : list.triangles) {
    polygons.push_back(t.points);
  }
  std::vector<std::uint8_t> reversed(polygons.size(), 0);
  Watcher watcher;
  watcher.reversed = &reversed;
  pmp::orient_polygon_soup(origin, polygons, CGAL::parameters::visitor(watcher));
  for (std::size_t k = list.points.size(); k < origin.size(); ++k) {
    list.points.push_back(list.points[origin[k]]);
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Triangle& t = list.triangles[i];
    if (reversed[i] != 0) {
      t.turn();
    }
    // CGAL may begin with another corner; ours keep their places beside their texture points.
    for (std::uint32_t& p : t.points) {
      p = *std::find_if(polygons[i].begin(), polygons[i].end(),
                        [&](std::uint32_t q) { return origin[q] == origin[p]; });
    }
  }
}

/// Do the triangles of two uses still meet at the whole edge?
bool still_joined(const TriangleList& list, const EdgeUse& a, const EdgeUse& b) {
  const Triangle& s = list.triangles[a.triangle];
  const Triangle& t = list.triangles[b.triangle];
  return 2 == std::count_if(s.points.begin(), s.points.end(), [&](std::uint32_t p) {
           return std::find(t.points.begin(), t.points.end(), p) != t.points.end();
         });
}

/// Counts what was cut, from the uses before and the list after: edges with too many faces, surfaces that
/// came back to themselves turned around, and points that were divided although no cut ends at them.
void remark_cuts(const TriangleList& before, const TriangleList& after, const std::vector<EdgeUse>& uses,
                 RepairReport& report) {
  DisjointSets surfaces(after.triangles.size());
  std::vector<std::uint32_t> cut;
  std::vector<bool> explained(before.points.size(), false);
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    const EdgeUse& a = uses[i];
    if (j - i > 2) {
      // Told by pair_faces already.
      explained[a.low] = explained[a.high] = true;
    } else if (j - i == 2) {
      surfaces.join(a.triangle, uses[i + 1].triangle);
      if (!still_joined(after, a, uses[i + 1])) {
        cut.push_back(a.triangle);
        explained[a.low] = explained[a.high] = true;
      }
    }
  });
  for (std::uint32_t& t : cut) {
    t = surfaces.find(t);
  }
  std::sort(cut.begin(), cut.end());
  cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
  for (const std::uint32_t t : cut) {
    report.add(RepairKind::cut_open, 1, first_at_polygon(after.triangles[t].origin));
  }
  for (std::size_t i = 0; i < after.triangles.size(); ++i) {
    const Triangle& now = after.triangles[i];
    const Triangle& was = before.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t old = was.points[now.turned == was.turned || k == 0 ? k : 3 - k];
      if (now.points[k] != old && !explained[old]) {
        explained[old] = true;
        report.add(RepairKind::vertices_split, 1, first_at_polygon(now.origin));
      }
    }
  }
}

}  // namespace

bool is_manifold(const TriangleList& list) {
  const std::vector<EdgeUse> uses = edge_uses(list.triangles);
  return edges_are_sound(uses) && vertices_are_sound(list, uses);
}

void make_manifold(TriangleList& list, std::vector<EdgeUse>& uses, RepairReport& report,
                   const Context& context) {
  pair_faces(list, uses, report);
  // One round is enough as far as is known; the others cost nothing where it was.
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    context.check();
    if (edges_are_sound(uses) && vertices_are_sound(list, uses)) {
      return;
    }
    const TriangleList before = list;
    orient_once(list);
    remark_cuts(before, list, uses, report);
    uses = edge_uses(list.triangles);
  }
  throw Error(ErrorKind::internal, "the surface could not be made manifold");
}

}  // namespace ridgecraft::mesh
