// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/bridges.hpp"

#include <utility>

namespace ridgecraft::segment {
namespace {

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
bool derive_from(Bridge& bridge, std::uint32_t source, double moved, std::span<const Vec3> points,
                 double tolerance, std::span<const Bridge> bridges) {
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
  const Bridge& origin = bridges[derived.from];
  const auto apart = [&](std::uint32_t v, std::uint32_t w) { return length(points[v] - points[w]); };
  derived.crossed = apart(bridge.a, origin.a) + apart(bridge.b, origin.b) >
                    apart(bridge.a, origin.b) + apart(bridge.b, origin.a);
  bridge.high = derived.least > tolerance;
  bridge.length = bridges[source].length + moved;
  bridge.known = derived;
  return true;
}

}  // namespace

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
  if (triangles[0] == none) {
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
        if (e != index && shares_end && derive_from(bridge, e, moved, points, tolerance, bridges)) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace ridgecraft::segment
