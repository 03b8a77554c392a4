// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "segment/concavity/valley_concavity.hpp"
#include "segment/cutting/separators.hpp"

namespace ridgecraft::segment {
namespace {

/// A bridge is derived from a neighbour whose other end is at most this share of the tolerance away (3.6).
constexpr double derivation_share = 0.5;
/// The interval grows by this times the distance between the ends.
constexpr double interval_growth = 2.0;
/// Longest bridges that a test sorts and looks at first: most unions that fail do so there.
constexpr std::size_t first_tested = 256;
/// Three directions at right angles, in which no edge of a box or of another thing along the axes lies: the
/// columns of a rotation by the quaternion (5, 3, 2, 1).
constexpr std::array<Vec3, 3> shadow_frame{Vec3{29.0 / 39.0, 22.0 / 39.0, -14.0 / 39.0},
                                           Vec3{2.0 / 39.0, 19.0 / 39.0, 34.0 / 39.0},
                                           Vec3{26.0 / 39.0, -26.0 / 39.0, 13.0 / 39.0}};
/// Smaller hulls cost too little to look for a quicker answer.
constexpr std::size_t least_in_shadow = 4096;
/// Bridges between two questions whether the user wants to stop.
constexpr std::size_t check_interval = 64;

/// Equal for equal parts; two different ones of a run agree with a probability of 2^-64.
std::uint64_t signature_of(std::span<const std::uint32_t> facets) {
  std::uint64_t sum = 0;
  for (const std::uint32_t f : facets) {
    sum += Random(f).next();
  }
  return sum;
}

}  // namespace

Measurer::Measurer(const ScaledSurface& surface, const VertexGraph& graph, double tolerance,
                   const Context& context, const Rules& rules, std::optional<double> opening_scale)
    : surface_(&surface),
      context_(&context),
      tolerance_(tolerance),
      rules_(rules),
      part_(surface, graph, rules.jumps),
      search_(part_),
      hulls_(surface.points),
      depth_(surface, tolerance, opening_scale.value_or(tolerance), context) {}

void Measurer::measure(std::span<const std::uint32_t> facets, std::span<const std::uint32_t> hull_points,
                       MeasureMode mode, Measurement& out) {
  part_.select(facets);
  signature_ = signature_of(facets);
  if (mode == MeasureMode::test && fails_in_shadow(hull_points)) {
    out.hull.clear();
    out.bridges.clear();
    out.deepest = none;
    out.stopped = true;
    return;
  }
  hulls_.build(hull_points.empty() ? part_.vertices() : hull_points, out.hull, flat_face_lift);
  measure_selected(mode, out);
}

void Measurer::measure_with_hull(std::span<const std::uint32_t> facets, Hull hull, MeasureMode mode,
                                 Measurement& out) {
  part_.select(facets);
  signature_ = signature_of(facets);
  out.hull = std::move(hull);
  measure_selected(mode, out);
}

/// Measures the part that the graph shows, when its hull is there.
void Measurer::measure_selected(MeasureMode mode, Measurement& out) {
  depth_.select(out.hull);
  out.bridges.assign(out.hull.edges.size(), Bridge{});
  out.concavity = 0.0;
  out.deepest = none;
  out.stopped = false;
  order_.resize(out.bridges.size());
  std::iota(order_.begin(), order_.end(), 0U);
  const auto& points = surface_->points;
  for (std::size_t i = 0; i < out.bridges.size(); ++i) {
    out.bridges[i].a = out.hull.edges[i][0];
    out.bridges[i].b = out.hull.edges[i][1];
    out.bridges[i].length = length(points[out.bridges[i].b] - points[out.bridges[i].a]);
  }
  const bool test = mode == MeasureMode::test || mode == MeasureMode::test_scratch;
  const bool scratch = mode == MeasureMode::scratch || mode == MeasureMode::test_scratch;
  std::size_t searched = 0;
  for (std::size_t n = 0; n < order_.size(); ++n) {
    if (test && (n == 0 || n == first_tested)) {
      sort_longest_first(n, out.bridges);
    }
    const std::uint32_t i = order_[n];
    Bridge& bridge = out.bridges[i];
    if (bridge.state != Bridge::State::open) {
      continue;  // known to be zero
    }
    if (is_zero(bridge)) {
      bridge.state = Bridge::State::low;
      bridge.zero = true;
      continue;
    }
    if (scratch || !rules_.derivation || !derive(i, out)) {
      if (searched++ % check_interval == 0) {
        context_->check();
      }
      search(i, out, scratch, !test);
    }
    out.concavity = std::max(out.concavity, bridge.high);
    if (test && bridge.state == Bridge::State::high) {
      out.stopped = true;
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
  std::array<Bridge, shadow_frame.size()> longest;
  shadow_corners_.clear();
  for (std::size_t k = 0; k < longest.size(); ++k) {
    shadow_.cast(points, hull_points, shadow_frame[k], shadow_frame[(k + 1) % shadow_frame.size()]);
    shadow_corners_.insert(shadow_corners_.end(), shadow_.corners().begin(), shadow_.corners().end());
    const auto [a, b] = shadow_.longest(points);
    longest[k].a = a;
    longest[k].b = b;
    longest[k].length = length(points[b] - points[a]);
  }
  std::stable_sort(longest.begin(), longest.end(),
                   [](const Bridge& p, const Bridge& q) { return p.length > q.length; });
  inner_hull_.clear();
  for (Bridge& bridge : longest) {
    if (bridge.a == bridge.b || is_zero(bridge)) {
      continue;
    }
    const Valley valley = find_valley(bridge, false);
    if (valley.steps.empty()) {
      return true;
    }
    if (valley.greatest <= tolerance_) {
      continue;
    }
    if (inner_hull_.vertices.empty()) {
      std::sort(shadow_corners_.begin(), shadow_corners_.end());
      shadow_corners_.erase(std::unique(shadow_corners_.begin(), shadow_corners_.end()),
                            shadow_corners_.end());
      hulls_.build(shadow_corners_, inner_hull_);
      depth_.select(inner_hull_, HullDepth::HullIs::inner);
    }
    if (cap(valley) > tolerance_) {
      return true;
    }
  }
  return false;
}

void Measurer::use_valleys(ValleyCache own, const ValleyCache* known) {
  cache_ = std::move(own);
  known_ = known;
}

ValleyCache Measurer::take_valleys() {
  return std::exchange(cache_, ValleyCache());
}

/// Puts the bridges of the order from number `from` on in order of length, at 0 the first_tested longest
/// only. Nearly all the others are edges of the surface: those needn't be sorted.
void Measurer::sort_longest_first(std::size_t from, std::span<Bridge> bridges) {
  const auto at = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
  if (from == 0) {
    // Lengths are copied beside the numbers, so that sorting doesn't look them up all over memory.
    ranked_.resize(bridges.size());
    for (std::uint32_t i = 0; i < bridges.size(); ++i) {
      ranked_[i] = {-bridges[i].length, i};
    }
    const std::size_t first = std::min(first_tested, ranked_.size());
    std::partial_sort(ranked_.begin(), ranked_.begin() + at(first), ranked_.end());
  } else {
    const auto zeros_end = std::partition(ranked_.begin() + at(from), ranked_.end(), [&](const auto& ranked) {
      Bridge& bridge = bridges[ranked.second];
      bridge.zero = is_zero(bridge);
      bridge.state = bridge.zero ? Bridge::State::low : Bridge::State::open;
      return bridge.zero;
    });
    std::sort(zeros_end, ranked_.end());
  }
  for (std::size_t n = from; n < ranked_.size(); ++n) {
    order_[n] = ranked_[n].second;
  }
}

bool Measurer::is_zero(Bridge& bridge) const {
  const std::uint32_t arc = part_.find_arc(bridge.a, bridge.b);
  if (arc != none) {
    bridge.length = static_cast<double>(part_.arc(arc).length);
    return true;
  }
  return part_.jump_exists(bridge.a, bridge.b);
}

bool Measurer::derive(std::uint32_t index, Measurement& m) const {
  const Hull& hull = m.hull;
  Bridge& bridge = m.bridges[index];
  std::array<std::uint32_t, 2> triangles = hull.edge_triangles[index];
  if (triangles[0] == none) {
    return false;
  }
  const auto apex = [&](std::uint32_t t) {
    const auto& v = hull.triangles[t];
    return v[0] != bridge.a && v[0] != bridge.b ? v[0] : (v[1] != bridge.a && v[1] != bridge.b ? v[1] : v[2]);
  };
  if (apex(triangles[1]) < apex(triangles[0])) {
    std::swap(triangles[0], triangles[1]);
  }
  const auto& points = surface_->points;
  for (const std::uint32_t t : triangles) {
    const std::uint32_t c = apex(t);
    for (const std::uint32_t kept : {bridge.a, bridge.b}) {
      const std::uint32_t moved_end = kept == bridge.a ? bridge.b : bridge.a;
      const double moved = length(points[moved_end] - points[c]);
      if (moved > derivation_share * tolerance_) {
        continue;
      }
      for (const std::uint32_t e : hull.triangle_edges[t]) {
        const Bridge& source = m.bridges[e];
        if (e != index && (source.a == kept || source.b == kept) && source.state != Bridge::State::open &&
            !source.zero && derive_from(bridge, source, moved)) {
          const Bridge& origin = m.bridges[source.source];
          const double straight =
              length(points[bridge.a] - points[origin.a]) + length(points[bridge.b] - points[origin.b]);
          const double crossed =
              length(points[bridge.a] - points[origin.b]) + length(points[bridge.b] - points[origin.a]);
          bridge.reach_a = straight <= crossed ? origin.reach_a : origin.reach_b;
          bridge.reach_b = straight <= crossed ? origin.reach_b : origin.reach_a;
          return true;
        }
      }
    }
  }
  return false;
}

bool Measurer::derive_from(Bridge& bridge, const Bridge& source, double moved) const {
  const double low = source.low - interval_growth * moved;
  const double high = source.high + interval_growth * moved;
  if (low > tolerance_) {
    bridge.state = Bridge::State::high;
  } else if (high <= tolerance_) {
    bridge.state = Bridge::State::low;
  } else {
    return false;
  }
  bridge.low = low;
  bridge.high = high;
  bridge.length = source.length + moved;
  bridge.source = source.source;
  return true;
}

bool Measurer::survives(const Valley& valley) const {
  for (std::size_t i = 1; i < valley.steps.size(); ++i) {
    const std::uint32_t from = valley.steps[i - 1].vertex;
    const Step& step = valley.steps[i];
    if (step.arc == jump_arc ? !part_.jump_exists(from, step.vertex) : !part_.arc_exists(from, step.arc)) {
      return false;
    }
  }
  return true;
}

Valley Measurer::find_valley(const Bridge& bridge, bool scratch) {
  Valley valley;
  if (cache_.find(bridge.a, bridge.b, valley) ||
      (known_ != nullptr && known_->find(bridge.a, bridge.b, valley))) {
    // A search on the same part would find the same valley again. From other parts only what is surely still
    // shortest is taken: where there are cut loops, a jump may be shorter than a deep valley.
    if (valley.part == signature_ ||
        (!scratch && !(valley.greatest > tolerance_ && part_.has_loops()) && survives(valley))) {
      return valley;
    }
  }
  valley = {};
  valley.length = search_.find(bridge.a, bridge.b, steps_);
  if (steps_.empty()) {
    return valley;
  }
  valley_points_.clear();
  for (const Step& s : steps_) {
    valley_points_.push_back(surface_->points[s.vertex]);
  }
  project_valley(valley_points_, chain_);
  chain_concavity(chain_, concavity_);
  valley.steps = steps_;
  valley.concavity = concavity_;
  valley.greatest = *std::max_element(concavity_.begin(), concavity_.end());
  valley.part = signature_;
  cache_.store(bridge.a, bridge.b, valley);
  return valley;
}

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

void Measurer::search(std::uint32_t index, Measurement& m, bool scratch, bool with_reach) {
  Bridge& bridge = m.bridges[index];
  const Valley valley = find_valley(bridge, scratch);
  bridge.source = index;
  if (valley.steps.empty()) {
    bridge.low = bridge.high = INFINITY;
  } else {
    bridge.low = bridge.high = valley.greatest > tolerance_ ? cap(valley) : valley.greatest;
    bridge.length = valley.length;
  }
  if (m.deepest == none || bridge.high > m.bridges[m.deepest].high) {
    m.deepest = index;
  }
  bridge.state = bridge.high > tolerance_ ? Bridge::State::high : Bridge::State::low;
  if (with_reach && bridge.state == Bridge::State::high && valley.steps.size() > 2) {
    find_reach(bridge, valley);
  }
}

void Measurer::find_reach(Bridge& bridge, const Valley& valley) {
  valley_points_.clear();
  for (const Step& s : valley.steps) {
    valley_points_.push_back(surface_->points[s.vertex]);
  }
  project_valley(valley_points_, chain_);
  const Separators separators = find_separators(chain_, capped_, valley.concavity, tolerance_);
  double along = 0.0;
  double at_last = 0.0;
  for (std::size_t i = 1; i < valley.steps.size(); ++i) {
    const Step& step = valley.steps[i];
    along += step.arc == jump_arc ? length(valley_points_[i] - valley_points_[i - 1])
                                  : static_cast<double>(part_.arc(step.arc).length);
    if (i == separators.first) {
      bridge.reach_a = along;
    }
    if (i == separators.last) {
      at_last = along;
    }
  }
  bridge.reach_b = along - at_last;
}

}  // namespace ridgecraft::segment
