// SPDX-License-Identifier: GPL-3.0-or-later
// From quickhull's facets to the hull that is given out: flat faces as fans, edges in order, and hulls in a
// plane.
#include <algorithm>
#include <cmath>

#include "base/convex_hull.hpp"
#include "base/error.hpp"
#include "segment/hull/hull.hpp"
#include "segment/surface/exact_orientation.hpp"

namespace ridgecraft::segment {

void HullBuilder::merge_coplanar() {
  faces_.reset(facets_.size());
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (!facets_[f].alive) {
      continue;
    }
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = facets_[f].nb[k];
      if (g < f) {
        continue;
      }
      const auto& v = facets_[g].v;
      const std::uint32_t a = facets_[f].v[k];
      const std::uint32_t b = facets_[f].v[(k + 1) % 3];
      const std::uint32_t opposite = v[0] != a && v[0] != b ? v[0] : (v[1] != a && v[1] != b ? v[1] : v[2]);
      if (side_of(facets_[f], opposite) == 0) {
        faces_.join(f, g);
      }
    }
  }
}

void HullBuilder::emit() {
  local_triangles_.clear();
  std::vector<std::uint32_t>& count = next_;  // the lists are empty now; the array is free
  count.assign(facets_.size() + 1, 0);
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    count[faces_.find(f)] += facets_[f].alive ? 1U : 0U;
  }
  std::vector<std::vector<std::uint32_t>> flats;
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (!facets_[f].alive) {
      continue;
    }
    if (count[faces_.find(f)] == 1) {
      const auto& v = facets_[f].v;
      local_triangles_.push_back({v[0], v[1], v[2]});
    } else if (faces_.find(f) == f) {
      flats.emplace_back();
    }
  }
  if (flats.empty()) {
    return;
  }
  std::vector<std::uint32_t> number(facets_.size(), none);
  std::uint32_t faces = 0;
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (facets_[f].alive && count[faces_.find(f)] > 1) {
      std::uint32_t& n = number[faces_.find(f)];
      n = n == none ? faces++ : n;
      flats[n].push_back(f);
    }
  }
  for (const auto& members : flats) {
    emit_face(members);
  }
}

void HullBuilder::emit_face(const std::vector<std::uint32_t>& members) {
  // The border of the face is one cycle: its facets form a disc.
  std::uint32_t start = none;
  const std::uint32_t face = faces_.find(members[0]);
  for (const std::uint32_t f : members) {
    for (unsigned k = 0; k < 3; ++k) {
      if (faces_.find(facets_[f].nb[k]) != face) {
        slot_[facets_[f].v[k]] = facets_[f].v[(k + 1) % 3];
        start = facets_[f].v[k];
      }
    }
  }
  cycle_.clear();
  std::uint32_t v = start;
  do {
    cycle_.push_back(v);
    v = slot_[v];
  } while (v != start);
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < cycle_.size(); ++i) {
    const std::uint32_t before = cycle_[(i + cycle_.size() - 1) % cycle_.size()];
    const std::uint32_t after = cycle_[(i + 1) % cycle_.size()];
    if (!exactly_collinear(points_[before], points_[cycle_[i]], points_[after])) {
      corners.push_back(cycle_[i]);
    }
  }
  RIDGECRAFT_ASSERT(corners.size() >= 3);
  const auto smallest = std::min_element(corners.begin(), corners.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return ids_[a] < ids_[b]; });
  std::rotate(corners.begin(), smallest, corners.end());
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    local_triangles_.push_back({corners[0], corners[i], corners[i + 1]});
  }
}

/// Numbers the edges by their ends and ties them to their triangles: a bucket per smaller end, in linear time
/// but for the sorting of the vertices.
void HullBuilder::connect(Hull& out) {
  // slot_ holds the rank of each local point among the hull vertices from here on.
  std::fill(slot_.begin(), slot_.end(), none);
  vertex_order_.clear();
  for (const auto& t : local_triangles_) {
    for (const std::uint32_t v : t) {
      if (slot_[v] == none) {
        slot_[v] = 0;
        vertex_order_.push_back({ids_[v], v});
      }
    }
  }
  std::sort(vertex_order_.begin(), vertex_order_.end());
  for (std::uint32_t rank = 0; rank < vertex_order_.size(); ++rank) {
    out.vertices.push_back(vertex_order_[rank][0]);
    slot_[vertex_order_[rank][1]] = rank;
  }
  bucket_.assign(vertex_order_.size() + 1, 0);
  for (auto& t : local_triangles_) {
    out.triangles.push_back({ids_[t[0]], ids_[t[1]], ids_[t[2]]});
    t = {slot_[t[0]], slot_[t[1]], slot_[t[2]]};
    for (std::size_t k = 0; k < 3; ++k) {
      ++bucket_[std::min(t[k], t[(k + 1) % 3]) + 1];
    }
  }
  for (std::size_t v = 0; v < vertex_order_.size(); ++v) {
    bucket_[v + 1] += bucket_[v];
  }
  sides_.resize(3 * local_triangles_.size());
  next_.assign(bucket_.begin(), bucket_.end() - 1);
  for (std::uint32_t t = 0; t < local_triangles_.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = local_triangles_[t][k];
      const std::uint32_t b = local_triangles_[t][(k + 1) % 3];
      sides_[next_[std::min(a, b)]++] = {std::max(a, b), 3 * t + k};
    }
  }
  out.triangle_edges.resize(local_triangles_.size());
  for (std::size_t v = 0; v < vertex_order_.size(); ++v) {
    const auto first = sides_.begin() + bucket_[v];
    const auto last = sides_.begin() + bucket_[v + 1];
    std::sort(first, last);
    RIDGECRAFT_ASSERT((last - first) % 2 == 0);
    for (auto side = first; side != last; side += 2) {
      const auto& [one, at_one] = side[0];
      const auto& [two, at_two] = side[1];
      RIDGECRAFT_ASSERT(one == two);
      const auto e = static_cast<std::uint32_t>(out.edges.size());
      out.edges.push_back({out.vertices[v], out.vertices[one]});
      out.edge_triangles.push_back({at_one / 3, at_two / 3});
      out.triangle_edges[at_one / 3][at_one % 3] = e;
      out.triangle_edges[at_two / 3][at_two % 3] = e;
    }
  }
}

namespace {

/// A point of a flat set, without the coordinate that is dropped.
struct FlatPoint {
  std::int64_t x;
  std::int64_t y;
  std::uint32_t id;
};

/// Twice the area of a triangle, above 0 when it runs counterclockwise; exact.
Int128 flat_turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}

/// Which coordinate a plane with this normal loses least by dropping: 0, 1 or 2.
int coordinate_to_drop(Vec3 normal) {
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

}  // namespace

void HullBuilder::build_line(Hull& out) const {
  out.vertices.push_back(ids_[simplex_[0]]);
  if (points_[simplex_[0]] != points_[simplex_[1]]) {
    out.vertices.push_back(ids_[simplex_[1]]);
    std::sort(out.vertices.begin(), out.vertices.end());
  }
}

void HullBuilder::build_flat(Hull& out) const {
  out.flat = true;
  if (points_.empty()) {
    return;
  }
  if (simplex_[2] == none) {
    // A point or a line: no bridges, and the two ends as its hull.
    build_line(out);
    return;
  }
  const Vec3 a = points_[simplex_[0]];
  const int drop = coordinate_to_drop(cross(points_[simplex_[1]] - a, points_[simplex_[2]] - a));
  std::vector<FlatPoint> flat(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const GridPoint g = grid_point(points_[i]);
    flat[i] = {drop == 0 ? g.y : g.x, drop == 2 ? g.y : g.z, ids_[i]};
  }
  std::sort(flat.begin(), flat.end(), [](const FlatPoint& p, const FlatPoint& q) {
    return p.x != q.x ? p.x < q.x : (p.y != q.y ? p.y < q.y : p.id < q.id);
  });
  flat.erase(std::unique(flat.begin(), flat.end(),
                         [](const FlatPoint& p, const FlatPoint& q) { return p.x == q.x && p.y == q.y; }),
             flat.end());
  std::vector<FlatPoint> corners;
  monotone_chain(flat, flat_turn, corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    out.vertices.push_back(corners[i].id);
    const std::uint32_t after = corners[(i + 1) % corners.size()].id;
    if (corners.size() > 2) {
      out.edges.push_back({std::min(corners[i].id, after), std::max(corners[i].id, after)});
    }
  }
  std::sort(out.vertices.begin(), out.vertices.end());
  std::sort(out.edges.begin(), out.edges.end());
  out.edge_triangles.assign(out.edges.size(), {none, none});
}

}  // namespace ridgecraft::segment
