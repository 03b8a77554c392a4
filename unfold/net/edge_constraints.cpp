// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/edge_constraints.hpp"

#include <algorithm>
#include <cmath>

#include "base/boxes.hpp"

namespace ridgecraft::unfold {
namespace {

/// How far from an edge a segment along it may lie, as a share of the surface's diagonal: less than repair
/// and remeshing move points, more than numbers printed with six digits are off.
constexpr double near = 1e-5;
/// So much of an edge, or of a segment, has to be covered.
constexpr double most = 0.5;

Box3 box_of(Vec3 a, Vec3 b, double margin) {
  Box3 box;
  box.add(a);
  box.add(b);
  return grown(box, margin);
}

/// How much of the segment lies on the line from a to b; 0 where it runs elsewhere.
double common_length(Vec3 a, Vec3 b, const Segment& segment, double tolerance) {
  const double size = length(b - a);
  const Vec3 along = (b - a) / size;
  double at[2];
  for (std::size_t i = 0; i < 2; ++i) {
    at[i] = dot(segment[i] - a, along);
    if (length(segment[i] - a - at[i] * along) > tolerance) {
      return 0.0;
    }
  }
  return std::max(0.0, std::min(size, std::max(at[0], at[1])) - std::max(0.0, std::min(at[0], at[1])));
}

class Matcher {
 public:
  Matcher(const mesh::Surface& surface, const prepare::Panels& panels, const Context& context)
      : surface_(surface),
        panels_(panels),
        context_(context),
        tolerance_(near * surface.bounds().diagonal()) {
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const CornerId c = surface.sides(e)[0];
      a_.push_back(surface.point(surface.vertex(c)));
      b_.push_back(surface.point(surface.vertex(mesh::next(c))));
      boxes_.push_back(box_of(a_.back(), b_.back(), tolerance_));
    }
  }

  void mark(std::span<const Segment> segments, EdgeConstraint constraint, EdgeConstraints& constraints,
            SegmentCount& count) const {
    std::vector<double> covered(boxes_.size(), 0.0);
    const std::vector<std::vector<EdgeId>> edges = edges_near(segments);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (i % 1024 == 0) {
        context_.check();
      }
      const Segment& segment = segments[i];
      double open = 0.0;
      double flat = 0.0;
      const Box3 box = box_of(segment[0], segment[1], 0.0);
      for (const EdgeId e : edges[i]) {
        if (!meet(box, boxes_[e.value()]) || !(surface_.length(e) > tolerance_)) {
          continue;
        }
        const double common = common_length(a_[e.value()], b_[e.value()], segment, tolerance_);
        covered[e.value()] += common;
        (is_flat(e) ? flat : open) += common;
      }
      const double needed = most * length(segment[1] - segment[0]);
      ++(open > 0.0 && open >= needed ? count.found : flat > 0.0 ? count.flat : count.lost);
    }
    for (const EdgeId e : ids<EdgeId>(boxes_.size())) {
      if (covered[e.value()] > 0.0 && covered[e.value()] >= most * surface_.length(e) && !is_flat(e)) {
        constraints[e] = constraint;
      }
    }
  }

 private:
  /// The edges whose boxes a segment's touches, in their order; a few others are among them.
  [[nodiscard]] std::vector<std::vector<EdgeId>> edges_near(std::span<const Segment> segments) const {
    if (segments.empty()) {
      return {};
    }
    std::vector<Box3> boxes = boxes_;
    for (const Segment& segment : segments) {
      boxes.push_back(box_of(segment[0], segment[1], 0.0));
    }
    std::vector<std::vector<EdgeId>> found(segments.size());
    std::size_t pairs = 0;
    NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
      if (++pairs % (1U << 16U) == 0) {
        context_.check();
      }
      const auto [edge, segment] = std::minmax(i, j);
      if (edge < boxes_.size() && segment >= boxes_.size()) {
        found[segment - boxes_.size()].emplace_back(edge);
      }
    });
    for (std::vector<EdgeId>& edges : found) {
      std::sort(edges.begin(), edges.end());
    }
    return found;
  }

  [[nodiscard]] bool is_flat(EdgeId e) const {
    const auto [c, d] = surface_.sides(e);
    return d.valid() && panels_.panel[mesh::face_of(c)] == panels_.panel[mesh::face_of(d)];
  }

  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const Context& context_;
  double tolerance_;
  std::vector<Vec3> a_, b_;
  std::vector<Box3> boxes_;
};

}  // namespace

MatchedSegments match_segments(const mesh::Surface& surface, const prepare::Panels& panels,
                               std::span<const Segment> cut, std::span<const Segment> keep,
                               const Context& context) {
  const Matcher matcher(surface, panels, context);
  MatchedSegments matched{EdgeConstraints(surface.edge_count(), EdgeConstraint::none), {}, {}};
  matcher.mark(keep, EdgeConstraint::keep, matched.constraints, matched.keep);
  matcher.mark(cut, EdgeConstraint::cut, matched.constraints, matched.cut);
  return matched;
}

}  // namespace ridgecraft::unfold
