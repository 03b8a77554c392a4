// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/hull.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

/// Share of the extent below which a set of points counts as flat ...
constexpr double flat_share = 1e-7;
/// ... or as a line: coordinates scaled to the grid of 1e-12 leave about 1e-9 of a part a thousandth of the
/// ball.
constexpr double line_share = 1e-9;
/// n . (p - at): differences of grid points are exact, each component of n is off by at most 2 eps U V (eps =
/// 2^-52, U and V the greatest coordinates of the two sides), times differences of at most 2, plus three
/// products and two sums: 30 eps U V = 6.7e-15 U V.
constexpr double sign_bound = 1e-14;

/// Facets that may be more than a hull's final ones while it grows.
constexpr std::size_t spare_facets = 1024;

/// After hulls of so many points the room for them is given back: parts are smaller than the whole, and there
/// are gigabytes of other things.
constexpr std::size_t most_kept = 1U << 18U;

double greatest_coordinate(Vec3 v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

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

void Hull::clear() {
  vertices.clear();
  triangles.clear();
  edges.clear();
  triangle_edges.clear();
  edge_triangles.clear();
  flat = false;
}

double Hull::volume(std::span<const Vec3> points) const {
  if (triangles.empty()) {
    return 0.0;
  }
  const Vec3 origin = points[triangles[0][0]];
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    sum += dot(points[a] - origin, cross(points[b] - origin, points[c] - origin));
  }
  return sum / 6.0;
}

HullBuilder::HullBuilder(std::span<const Vec3> points) : all_points_(points) {}

void HullBuilder::take_points(std::span<const std::uint32_t> ids, double lift) {
  ids_.assign(ids.begin(), ids.end());
  points_.resize(ids.size());
  Vec3 middle;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    points_[i] = all_points_[ids[i]];
    middle += points_[i];
  }
  if (lift == 0.0 || ids.empty()) {
    return;
  }
  middle = middle / static_cast<double>(ids.size());
  for (Vec3& p : points_) {
    const Vec3 out = p - middle;
    p = snap_to_grid(p + (lift * (1.0 - 0.25 * dot(out, out))) * out);
  }
}

void HullBuilder::build(std::span<const std::uint32_t> ids, Hull& out, double lift) {
  out.clear();
  take_points(ids, lift);
  next_.assign(ids.size(), no_index);
  slot_.assign(ids.size(), no_index);
  facets_.clear();
  // 2 n facets at the end and hardly more before: doubling would take three times the memory for a while.
  facets_.reserve(2 * ids.size() + spare_facets);
  free_.clear();
  pending_.clear();
  mark_ = 0;
  if (!find_simplex()) {
    build_flat(out);
    return;
  }
  begin_with_simplex();
  while (!pending_.empty()) {
    const std::uint32_t f = pending_.back();
    pending_.pop_back();
    if (facets_[f].alive && facets_[f].outside != no_index) {
      add_top_of(f);
    }
  }
  merge_coplanar();
  emit();
  connect(out);
  if (ids.size() > most_kept) {
    *this = HullBuilder(all_points_);
  }
}

int HullBuilder::side_of(const Facet& f, std::uint32_t p) const {
  const double height = dot(f.n, points_[p] - f.at);
  if (height > f.bound) {
    return 1;
  }
  if (height < -f.bound) {
    return -1;
  }
  return exact_orientation(f.at, points_[f.v[1]], points_[f.v[2]], points_[p]);
}

std::uint32_t HullBuilder::new_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t index = 0;
  if (free_.empty()) {
    index = static_cast<std::uint32_t>(facets_.size());
    facets_.emplace_back();
  } else {
    index = free_.back();
    free_.pop_back();
  }
  Facet& f = facets_[index];
  const Vec3 u = points_[b] - points_[a];
  const Vec3 v = points_[c] - points_[a];
  f.v = {a, b, c};
  f.at = points_[a];
  f.n = cross(u, v);
  f.bound = sign_bound * greatest_coordinate(u) * greatest_coordinate(v);
  f.outside = no_index;
  f.top = no_index;
  f.height = -INFINITY;
  f.alive = true;
  f.mark = 0;
  return index;
}

void HullBuilder::give_point(std::uint32_t facet, std::uint32_t p, double height) {
  Facet& f = facets_[facet];
  if (f.outside == no_index) {
    pending_.push_back(facet);
  }
  next_[p] = f.outside;
  f.outside = p;
  // Equal heights: the smaller number, so that the order of the list doesn't matter.
  if (height > f.height || (height == f.height && p < f.top)) {
    f.height = height;
    f.top = p;
  }
}

/// Two of the points that are farthest along an axis, as far apart as such are; their distance, below 0
/// when there are no points.
double HullBuilder::find_extent() {
  if (points_.empty()) {
    return -1.0;
  }
  std::array<std::uint32_t, 6> extreme{};
  for (std::uint32_t i = 1; i < points_.size(); ++i) {
    const Vec3 p = points_[i];
    extreme[0] = p.x < points_[extreme[0]].x ? i : extreme[0];
    extreme[1] = p.x > points_[extreme[1]].x ? i : extreme[1];
    extreme[2] = p.y < points_[extreme[2]].y ? i : extreme[2];
    extreme[3] = p.y > points_[extreme[3]].y ? i : extreme[3];
    extreme[4] = p.z < points_[extreme[4]].z ? i : extreme[4];
    extreme[5] = p.z > points_[extreme[5]].z ? i : extreme[5];
  }
  double extent = -1.0;
  for (const std::uint32_t i : extreme) {
    for (const std::uint32_t j : extreme) {
      const double d = length(points_[j] - points_[i]);
      if (d > extent) {
        extent = d;
        simplex_[0] = i;
        simplex_[1] = j;
      }
    }
  }
  return extent;
}

/// The first of the points whose distance is greatest and above a limit, or none.
template <class Distance>
std::uint32_t HullBuilder::farthest(double limit, const Distance& distance) const {
  std::uint32_t best = no_index;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const double d = distance(points_[i]);
    if (d > limit) {
      limit = d;
      best = i;
    }
  }
  return best;
}

/// Four points that aren't in a plane, the last one below the first three. False where there are none; the
/// first three, or two, are filled as far as there are such.
bool HullBuilder::find_simplex() {
  simplex_[2] = simplex_[3] = no_index;
  const double extent = find_extent();
  if (!(extent > 0.0)) {
    return false;
  }
  const Vec3 a = points_[simplex_[0]];
  const Vec3 along = (points_[simplex_[1]] - a) / extent;
  simplex_[2] = farthest(line_share * extent, [&](Vec3 p) { return length(cross(along, p - a)); });
  if (simplex_[2] == no_index) {
    return false;
  }
  const Vec3 normal = normalized(cross(along, points_[simplex_[2]] - a));
  simplex_[3] = farthest(flat_share * extent, [&](Vec3 p) { return std::abs(dot(normal, p - a)); });
  if (simplex_[3] == no_index) {
    return false;
  }
  const int side = exact_orientation(a, points_[simplex_[1]], points_[simplex_[2]], points_[simplex_[3]]);
  if (side > 0) {
    std::swap(simplex_[1], simplex_[2]);
  }
  return side != 0;
}

/// The four facets of the simplex, each with points above it.
void HullBuilder::begin_with_simplex() {
  const auto [p, q, r, s] = simplex_;
  const std::uint32_t base = new_facet(p, q, r);
  const std::uint32_t f0 = new_facet(q, p, s);
  const std::uint32_t f1 = new_facet(r, q, s);
  const std::uint32_t f2 = new_facet(p, r, s);
  facets_[base].nb = {f0, f1, f2};
  facets_[f0].nb = {base, f2, f1};
  facets_[f1].nb = {base, f0, f2};
  facets_[f2].nb = {base, f1, f0};
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    for (const std::uint32_t f : {base, f0, f1, f2}) {
      if (side_of(facets_[f], i) > 0) {
        give_point(f, i, dot(facets_[f].n, points_[i] - facets_[f].at));
        break;
      }
    }
  }
}

void HullBuilder::find_horizon(std::uint32_t facet, std::uint32_t p) {
  ++mark_;
  visible_.clear();
  horizon_.clear();
  facets_[facet].mark = mark_;
  visible_.push_back(facet);
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const std::uint32_t f = visible_[i];
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = facets_[f].nb[k];
      if (facets_[g].mark == mark_) {
        continue;
      }
      if (side_of(facets_[g], p) >= 0) {
        facets_[g].mark = mark_;
        visible_.push_back(g);
      }
    }
  }
  for (const std::uint32_t f : visible_) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = facets_[f].nb[k];
      if (facets_[g].mark != mark_) {
        const std::uint32_t from = facets_[f].v[k];
        const auto j =
            static_cast<std::uint32_t>(facets_[g].nb[0] == f && facets_[g].v[1] == from
                                           ? 0
                                           : (facets_[g].nb[1] == f && facets_[g].v[2] == from ? 1 : 2));
        horizon_.push_back({from, facets_[f].v[(k + 1) % 3], g, j});
      }
    }
  }
}

void HullBuilder::add_top_of(std::uint32_t facet) {
  const std::uint32_t p = facets_[facet].top;
  find_horizon(facet, p);
  for (const std::uint32_t f : visible_) {
    facets_[f].alive = false;
  }
  fresh_.clear();
  for (const HorizonEdge& e : horizon_) {
    const std::uint32_t f = new_facet(e.from, e.to, p);
    facets_[f].nb[0] = e.beyond;
    facets_[e.beyond].nb[e.beyond_side] = f;
    slot_[e.from] = f;
    fresh_.push_back(f);
  }
  for (const std::uint32_t f : fresh_) {
    const std::uint32_t after = slot_[facets_[f].v[1]];
    facets_[f].nb[1] = after;
    facets_[after].nb[2] = f;
  }
  for (const std::uint32_t f : visible_) {
    std::uint32_t q = facets_[f].outside;
    while (q != no_index) {
      const std::uint32_t following = next_[q];
      if (q != p) {
        for (const std::uint32_t g : fresh_) {
          const double height = dot(facets_[g].n, points_[q] - facets_[g].at);
          if (height > facets_[g].bound || (height >= -facets_[g].bound && side_of(facets_[g], q) > 0)) {
            give_point(g, q, height);
            break;
          }
        }
      }
      q = following;
    }
    facets_[f].outside = no_index;
  }
  free_.insert(free_.end(), visible_.begin(), visible_.end());
}

// From quickhull's facets to the hull that is given out: flat faces as fans, edges in order, and hulls in a
// plane.

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
  std::vector<std::uint32_t> number(facets_.size(), no_index);
  std::uint32_t faces = 0;
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (facets_[f].alive && count[faces_.find(f)] > 1) {
      std::uint32_t& n = number[faces_.find(f)];
      n = n == no_index ? faces++ : n;
      flats[n].push_back(f);
    }
  }
  for (const auto& members : flats) {
    emit_face(members);
  }
}

void HullBuilder::emit_face(const std::vector<std::uint32_t>& members) {
  // The border of the face is one cycle: its facets form a disc.
  std::uint32_t start = no_index;
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
  std::fill(slot_.begin(), slot_.end(), no_index);
  vertex_order_.clear();
  for (const auto& t : local_triangles_) {
    for (const std::uint32_t v : t) {
      if (slot_[v] == no_index) {
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
  if (simplex_[2] == no_index) {
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
  out.edge_triangles.assign(out.edges.size(), {no_index, no_index});
}

}  // namespace ridgecraft::segment
