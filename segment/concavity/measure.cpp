// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/geometry.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

/// Twice the area of a triangle, above 0 when it runs counterclockwise.
template <class Spot>
double turn(const Spot& a, const Spot& b, const Spot& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A bridge is derived from a neighbour whose other end is at most this share of the tolerance away.
constexpr double derivation_share = 0.5;
/// The bounds grow by this times the distance between the ends.
constexpr double bounds_growth = 2.0;

/// The corner of a triangle that isn't an end of one of its edges.
std::uint32_t apex_of(const std::array<std::uint32_t, 3>& corners, const Bridge& edge) {
  for (const std::uint32_t v : {corners[0], corners[1]}) {
    if (v != edge.a && v != edge.b) {
      return v;
    }
  }
  return corners[2];
}

/// The searched bridge that a known one's bounds come from.
std::uint32_t origin_of(const Bridge& bridge, std::uint32_t index) {
  const auto* derived = std::get_if<Derived>(&bridge.known);
  return derived != nullptr ? derived->from : index;
}

/// Whether the bounds of bridge number `source`, one end of which is `moved` away, decide about a bridge.
bool derive_from(Bridge& bridge, std::uint32_t source, double moved, double tolerance,
                 std::span<const Bridge> bridges) {
  const std::optional<ConcavityBounds> bounds = concavity_bounds(bridges[source]);
  if (!bounds) {
    return false;
  }
  Derived derived;
  derived.least = bounds->least - bounds_growth * moved;
  derived.most = bounds->most + bounds_growth * moved;
  if (!(derived.least > tolerance) && !(derived.most <= tolerance)) {
    return false;
  }
  derived.from = origin_of(bridges[source], source);
  bridge.high = derived.least > tolerance;
  bridge.length = bridges[source].length + moved;
  bridge.known = derived;
  return true;
}

/// Whether a bridge runs from near the second end of another to near its first.
bool runs_crossed(const Bridge& bridge, const Bridge& other, std::span<const Vec3> points) {
  const auto apart = [&](std::uint32_t v, std::uint32_t w) { return length(points[v] - points[w]); };
  return apart(bridge.a, other.a) + apart(bridge.b, other.b) >
         apart(bridge.a, other.b) + apart(bridge.b, other.a);
}

}  // namespace

/// Drops what lies inside the octagon of the points farthest in eight directions: nearly all points of a
/// round shape (Akl and Toussaint 1978).
void Shadow::drop_inner() {
  constexpr std::array<std::array<double, 2>, 8> directions{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<Spot, 8> octagon{};
  for (std::size_t d = 0; d < 8; ++d) {
    octagon[d] = *std::max_element(spots_.begin(), spots_.end(), [&](const Spot& p, const Spot& q) {
      return directions[d][0] * p.x + directions[d][1] * p.y <
             directions[d][0] * q.x + directions[d][1] * q.y;
    });
  }
  std::erase_if(spots_, [&](const Spot& p) {
    for (std::size_t d = 0; d < 8; ++d) {
      const Spot& a = octagon[d];
      const Spot& b = octagon[(d + 1) % 8];
      if (a.id != b.id && turn(a, b, p) <= 0.0) {
        return false;
      }
    }
    return true;
  });
}

void Shadow::cast(std::span<const Vec3> points, std::span<const std::uint32_t> ids, Vec3 right, Vec3 up) {
  spots_.clear();
  corners_.clear();
  if (ids.empty()) {
    return;
  }
  for (const std::uint32_t v : ids) {
    spots_.push_back({dot(points[v], right), dot(points[v], up), v});
  }
  drop_inner();
  std::sort(spots_.begin(), spots_.end(), [](const Spot& p, const Spot& q) {
    return p.x != q.x ? p.x < q.x : (p.y != q.y ? p.y < q.y : p.id < q.id);
  });
  monotone_chain(spots_, turn<Spot>, chain_);
  for (const Spot& spot : chain_) {
    corners_.push_back(spot.id);
  }
}

std::array<std::uint32_t, 2> Shadow::longest(std::span<const Vec3> points) const {
  std::array<std::uint32_t, 2> best{};
  double most = -1.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const std::uint32_t a = corners_[i];
    const std::uint32_t b = corners_[(i + 1) % corners_.size()];
    if (const double size = length(points[b] - points[a]); size > most) {
      most = size;
      best = {std::min(a, b), std::max(a, b)};
    }
  }
  return best;
}

std::optional<ConcavityBounds> concavity_bounds(const Bridge& bridge) {
  if (const auto* searched = std::get_if<Searched>(&bridge.known)) {
    return ConcavityBounds{searched->concavity, searched->concavity};
  }
  if (const auto* derived = std::get_if<Derived>(&bridge.known)) {
    return ConcavityBounds{derived->least, derived->most};
  }
  return std::nullopt;
}

double greatest_concavity(const Bridge& bridge) {
  return concavity_bounds(bridge).value_or(ConcavityBounds{}).most;
}

std::array<double, 2> sub_valleys(const Bridge& bridge, std::span<const Bridge> bridges) {
  if (const auto* searched = std::get_if<Searched>(&bridge.known)) {
    return searched->reach;
  }
  if (const auto* derived = std::get_if<Derived>(&bridge.known)) {
    std::array<double, 2> reach = std::get<Searched>(bridges[derived->from].known).reach;
    if (derived->crossed) {
      std::swap(reach[0], reach[1]);
    }
    return reach;
  }
  return {};
}

bool derive_bridge(std::uint32_t index, const Hull& hull, std::span<const Vec3> points, double tolerance,
                   std::span<Bridge> bridges) {
  Bridge& bridge = bridges[index];
  std::array<std::uint32_t, 2> triangles = hull.edge_triangles[index];
  if (triangles[0] == no_index) {
    return false;  // the hull is flat
  }
  const auto apex = [&](std::uint32_t t) { return apex_of(hull.triangles[t], bridge); };
  if (apex(triangles[1]) < apex(triangles[0])) {
    std::swap(triangles[0], triangles[1]);
  }
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t kept : {bridge.a, bridge.b}) {
      const std::uint32_t moved_end = kept == bridge.a ? bridge.b : bridge.a;
      const double moved = length(points[moved_end] - points[apex(t)]);
      if (moved > derivation_share * tolerance) {
        continue;
      }
      for (const std::uint32_t e : hull.triangle_edges[t]) {
        const bool shares_end = bridges[e].a == kept || bridges[e].b == kept;
        if (e != index && shares_end && derive_from(bridge, e, moved, tolerance, bridges)) {
          auto& derived = std::get<Derived>(bridge.known);
          derived.crossed = runs_crossed(bridge, bridges[derived.from], points);
          return true;
        }
      }
    }
  }
  return false;
}

/// Longest bridges that a test sorts and looks at first: most unions that fail do so there.
constexpr std::size_t first_tested = 256;
/// Three directions at right angles, in which no edge of a box or of another thing along the axes lies: the
/// columns of a rotation by the quaternion (5, 3, 2, 1).
constexpr std::array<Vec3, 3> shadow_frame{Vec3{29.0 / 39.0, 22.0 / 39.0, -14.0 / 39.0},
                                           Vec3{2.0 / 39.0, 19.0 / 39.0, 34.0 / 39.0},
                                           Vec3{26.0 / 39.0, -26.0 / 39.0, 13.0 / 39.0}};
/// Smaller hulls cost too little to look for a quicker answer.
constexpr std::size_t least_in_shadow = 4096;
/// Searches between two questions whether the user wants to stop.
constexpr std::size_t check_interval = 64;

Part part_of(const ScaledSurface& surface, std::span<const std::uint32_t> facets, const Hull& hull,
             double concavity, PartReason reason) {
  Part part;
  part.faces = std::vector<FaceId>(facets.begin(), facets.end());
  part.concavity = concavity;
  part.hull_vertices = std::vector<VertexId>(hull.vertices.begin(), hull.vertices.end());
  part.hull_volume = hull.volume(surface.points) * surface.unit * surface.unit * surface.unit;
  part.reason = reason;
  return part;
}

Measurer::Measurer(const ScaledSurface& surface, const VertexGraph& graph, const MeasureRules& by,
                   const Context& context)
    : surface_(&surface),
      context_(&context),
      tolerance_(by.tolerance),
      rules_(by.rules),
      part_(surface, graph, by.rules.jumps),
      valleys_(part_),
      hulls_(surface.points),
      depth_(surface, context) {}

void Measurer::select(std::span<const std::uint32_t> facets) {
  part_.select(facets);
  valleys_.select();
}

void Measurer::measure(std::span<const std::uint32_t> facets, std::span<const std::uint32_t> hull_points,
                       const MeasureOptions& options, Measurement& out) {
  select(facets);
  if (options.stop_at_first && !options.from_scratch && fails_in_shadow(hull_points)) {
    out.hull.clear();
    out.bridges.clear();
    out.deepest = no_index;
    out.stopped = true;
    return;
  }
  hulls_.build(hull_points.empty() ? part_.vertices() : hull_points, out.hull, flat_face_lift);
  measure_selected(options, out);
}

void Measurer::measure_with_hull(std::span<const std::uint32_t> facets, Hull hull,
                                 const MeasureOptions& options, Measurement& out) {
  select(facets);
  out.hull = std::move(hull);
  measure_selected(options, out);
}

/// Measures the part that the graph shows, when its hull is there.
void Measurer::measure_selected(const MeasureOptions& options, Measurement& out) {
  depth_.select(out.hull);
  out.bridges.assign(out.hull.edges.size(), Bridge{});
  out.concavity = 0.0;
  out.deepest = no_index;
  out.stopped = false;
  const auto& points = surface_->points;
  for (std::size_t i = 0; i < out.bridges.size(); ++i) {
    Bridge& bridge = out.bridges[i];
    bridge.a = out.hull.edges[i][0];
    bridge.b = out.hull.edges[i][1];
    bridge.length = length(points[bridge.b] - points[bridge.a]);
  }
  if (options.stop_at_first) {
    test_selected(options.from_scratch, out);
    return;
  }
  for (std::uint32_t i = 0; i < out.bridges.size(); ++i) {
    if (!join_ends(out.bridges[i])) {
      settle(i, options, out);
    }
  }
}

/// Looks at the first_tested longest bridges, then at the others in order of length, until one is high.
/// Nearly all of those are edges of the surface, which needn't be sorted.
void Measurer::test_selected(bool from_scratch, Measurement& out) {
  const MeasureOptions options{.stop_at_first = true, .from_scratch = from_scratch};
  const auto look_at = [&](std::uint32_t i) {
    settle(i, options, out);
    out.stopped = out.bridges[i].high;
    return out.stopped;
  };
  // Lengths are copied beside the numbers, so that sorting doesn't look them up all over memory.
  ranked_.resize(out.bridges.size());
  for (std::uint32_t i = 0; i < out.bridges.size(); ++i) {
    ranked_[i] = {-out.bridges[i].length, i};
  }
  const auto others = ranked_.begin() + static_cast<std::ptrdiff_t>(std::min(first_tested, ranked_.size()));
  std::partial_sort(ranked_.begin(), others, ranked_.end());
  for (auto at = ranked_.begin(); at != others; ++at) {
    if (!join_ends(out.bridges[at->second]) && look_at(at->second)) {
      return;
    }
  }
  const auto unjoined = std::partition(
      others, ranked_.end(), [&](const auto& ranked) { return join_ends(out.bridges[ranked.second]); });
  std::sort(unjoined, ranked_.end());
  for (auto at = unjoined; at != ranked_.end(); ++at) {
    if (look_at(at->second)) {
      return;
    }
  }
}

/// Looks for a high bridge among the longest sides of a few shadows, which costs a tenth of the hull. Most
/// unions that fail have one there. The cap is that of the hull of the shadows' corners: it lies in the
/// part's hull, so depths under it are no greater, and what fails here fails.
bool Measurer::fails_in_shadow(std::span<const std::uint32_t> hull_points) {
  if (hull_points.size() < least_in_shadow) {
    return false;
  }
  const auto& points = surface_->points;
  auto& [shadow, corners, hull] = outlines_;
  std::array<Bridge, shadow_frame.size()> longest;
  corners.clear();
  for (std::size_t k = 0; k < longest.size(); ++k) {
    shadow.cast(points, hull_points, shadow_frame[k], shadow_frame[(k + 1) % shadow_frame.size()]);
    corners.insert(corners.end(), shadow.corners().begin(), shadow.corners().end());
    const auto [a, b] = shadow.longest(points);
    longest[k].a = a;
    longest[k].b = b;
    longest[k].length = length(points[b] - points[a]);
  }
  std::stable_sort(longest.begin(), longest.end(),
                   [](const Bridge& p, const Bridge& q) { return p.length > q.length; });
  hull.clear();
  for (Bridge& bridge : longest) {
    if (bridge.a == bridge.b || join_ends(bridge)) {
      continue;
    }
    const Valley valley = valleys_.find(bridge.a, bridge.b, tolerance_, false);
    if (valley.steps.empty()) {
      return true;
    }
    if (valley.greatest <= tolerance_) {
      continue;
    }
    if (hull.vertices.empty()) {
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      hulls_.build(corners, hull);
      depth_.select(hull, HullDepth::HullIs::inner);
    }
    if (cap(valley, tolerance_) > tolerance_) {
      return true;
    }
  }
  return false;
}

/// Whether an arc or a jump leads from one end to the other.
bool Measurer::join_ends(Bridge& bridge) const {
  const std::uint32_t arc = part_.find_arc(bridge.a, bridge.b);
  if (arc != no_index) {
    bridge.length = static_cast<double>(part_.arc(arc).length);
  } else if (!part_.jump_exists(bridge.a, bridge.b)) {
    return false;
  }
  bridge.known = Joined{};
  return true;
}

/// Finds out how concave a bridge is whose ends aren't joined.
void Measurer::settle(std::uint32_t index, const MeasureOptions& options, Measurement& out) {
  const bool derives = rules_.derivation && !options.from_scratch;
  if (!derives || !derive_bridge(index, out.hull, surface_->points, tolerance_, out.bridges)) {
    if (searches_++ % check_interval == 0) {
      context_->check();
    }
    search(index, options, out);
  }
  out.concavity = std::max(out.concavity, greatest_concavity(out.bridges[index]));
}

/// Fills capped_; the greatest of it.
double Measurer::cap(const Valley& valley, double above) {
  capped_.assign(valley.concavity.begin(), valley.concavity.end());
  double greatest = 0.0;
  for (std::size_t i = 0; i < capped_.size(); ++i) {
    if (rules_.cap && capped_[i] > above) {
      capped_[i] = std::min(capped_[i], depth_.at(valley.steps[i].vertex, above));
    }
    greatest = std::max(greatest, capped_[i]);
  }
  return greatest;
}

void Measurer::search(std::uint32_t index, const MeasureOptions& options, Measurement& out) {
  Bridge& bridge = out.bridges[index];
  const Valley valley = valleys_.find(bridge.a, bridge.b, tolerance_, options.from_scratch);
  Searched found;
  if (valley.steps.empty()) {
    found.concavity = INFINITY;
  } else {
    // What is reported is exact also where it is lower than the tolerance; only the greatest of a part
    // counts.
    const double above = options.from_scratch ? std::min(tolerance_, out.concavity) : tolerance_;
    found.concavity = valley.greatest > above ? cap(valley, above) : valley.greatest;
    bridge.length = valley.length;
  }
  bridge.high = found.concavity > tolerance_;
  if (bridge.high && !options.stop_at_first && valley.steps.size() > 2) {
    found.reach = valleys_.sub_valleys(valley, capped_, tolerance_);
  }
  if (out.deepest == no_index || found.concavity > greatest_concavity(out.bridges[out.deepest])) {
    out.deepest = index;
  }
  bridge.known = found;
}

}  // namespace ridgecraft::segment
