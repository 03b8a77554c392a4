// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ridgecraft::segment {
namespace {

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

}  // namespace

Measurer::Measurer(const ScaledSurface& surface, const VertexGraph& graph, double tolerance,
                   const Context& context, const Rules& rules, std::optional<double> opening_scale)
    : surface_(&surface),
      context_(&context),
      tolerance_(tolerance),
      rules_(rules),
      part_(surface, graph, rules.jumps),
      valleys_(part_),
      hulls_(surface.points),
      depth_(surface, tolerance, opening_scale.value_or(tolerance), context) {}

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
    out.deepest = none;
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
  out.deepest = none;
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
    if (cap(valley) > tolerance_) {
      return true;
    }
  }
  return false;
}

/// Whether an arc or a jump leads from one end to the other.
bool Measurer::join_ends(Bridge& bridge) const {
  const std::uint32_t arc = part_.find_arc(bridge.a, bridge.b);
  if (arc != none) {
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
double Measurer::cap(const Valley& valley) {
  capped_.assign(valley.concavity.begin(), valley.concavity.end());
  double greatest = 0.0;
  for (std::size_t i = 0; i < capped_.size(); ++i) {
    if (rules_.cap && capped_[i] > tolerance_) {
      capped_[i] = std::min(capped_[i], depth_.at(valley.steps[i].vertex));
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
    found.concavity = valley.greatest > tolerance_ ? cap(valley) : valley.greatest;
    bridge.length = valley.length;
  }
  bridge.high = found.concavity > tolerance_;
  if (bridge.high && !options.stop_at_first && valley.steps.size() > 2) {
    found.reach = valleys_.sub_valleys(valley, capped_, tolerance_);
  }
  if (out.deepest == none || found.concavity > greatest_concavity(out.bridges[out.deepest])) {
    out.deepest = index;
  }
  bridge.known = found;
}

}  // namespace ridgecraft::segment
