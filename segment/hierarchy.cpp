// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hierarchy.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/no_index.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/joining/partition.hpp"
#include "segment/surface/redundant_points.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

/// Tolerances of the finest parts: fine enough to slide through, and where to stop looking for more.
constexpr double first_tolerance = 0.03;
constexpr double least_tolerance = 0.005;

/// A border between two nodes that are parts at the time.
struct Meeting : Border {
  /// Of the union of the two once it is measured. When one of them has grown since: what it was before.
  /// Growing rarely makes a union less concave, so that is nearly always a lower bound, and a pair needs to
  /// be measured again only when its bound is the least of all.
  double concavity = 0.0;
  bool measured = false;

  void add(const Meeting& other) {
    Border::add(other);
    concavity = std::max(concavity, other.concavity);
    measured = false;
  }
};

class Joiner {
 public:
  Joiner(const mesh::Surface& surface, std::span<const std::uint32_t> polygon, double tolerance,
         const Context& context)
      : scaled_(scale_surface(surface, polygon)),
        weights_(weigh_edges(scaled_)),
        graph_(build_vertex_graph(scaled_, arc_sagitta_share * tolerance)),
        measurer_(scaled_, graph_, {tolerance, {}}, context),
        context_(&context) {}

  Hierarchy run(const Segmentation& finest) {
    out_.leaves = finest.parts.size();
    out_.faces = scaled_.facet_count();
    out_.nodes.assign(finest.parts.begin(), finest.parts.end());
    find_borders(finest);
    while (!waiting_.empty()) {
      context_->check();
      const Pair pair = waiting_.take();
      const auto [a, b] = pair;
      if (Meeting& meeting = borders_.between(a, b); !meeting.measured) {
        measure(a, b, {});
        meeting.concavity = std::max(meeting.concavity, measurement_.concavity);
        meeting.measured = true;
        wait(pair);
        continue;
      }
      join(a, b);
      context_->report("hierarchy",
                       static_cast<double>(out_.joinings.size()) / static_cast<double>(out_.leaves));
    }
    sort_joinings();
    return std::move(out_);
  }

 private:
  /// The least concave union first, of equal ones that with the more convex border.
  void wait(const Pair& pair) {
    const Meeting& meeting = borders_.between(pair.first, pair.second);
    waiting_.put(pair, {meeting.concavity, -meeting.mean()});
  }

  void find_borders(const Segmentation& finest) {
    for (std::size_t i = 0; i < out_.leaves; ++i) {
      borders_.add_set();
    }
    for (std::uint32_t f = 0; f < scaled_.facet_count(); ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t g = scaled_.neighbors[f][k];
        if (g == no_index || g < f) {
          continue;
        }
        const std::uint32_t p = finest.part[FaceId(f)].value();
        const std::uint32_t q = finest.part[FaceId(g)].value();
        if (p != q) {
          borders_.between(p, q).add_side(scaled_, weights_, std::size_t{3} * f + k);
        }
      }
    }
    for (const auto& [pair, meeting] : borders_.all()) {
      waiting_.put(pair, {meeting.concavity, -meeting.mean()});
    }
  }

  /// Leaves the facets in facets_ and the values in measurement_.
  void measure(std::uint32_t a, std::uint32_t b, const MeasureOptions& options) {
    facets_.clear();
    hull_points_.clear();
    for (const std::uint32_t node : {a, b}) {
      for (const FaceId f : out_.nodes[node].faces) {
        facets_.push_back(f.value());
      }
      for (const VertexId v : out_.nodes[node].hull_vertices) {
        hull_points_.push_back(v.value());
      }
    }
    std::sort(facets_.begin(), facets_.end());
    std::sort(hull_points_.begin(), hull_points_.end());
    hull_points_.erase(std::unique(hull_points_.begin(), hull_points_.end()), hull_points_.end());
    if (options.from_scratch) {
      hull_points_.clear();
    }
    measurer_.measure(facets_, hull_points_, options, measurement_);
  }

  void join(std::uint32_t a, std::uint32_t b) {
    measure(a, b, {.from_scratch = true});
    Part part = part_of(scaled_, facets_, measurement_.hull, measurement_.concavity, PartReason::merged);
    double least = part.concavity;
    for (const std::uint32_t node : {a, b}) {
      least = std::max(least, node < out_.leaves ? out_.nodes[node].concavity
                                                 : out_.joinings[node - out_.leaves].concavity);
    }
    out_.nodes.push_back(std::move(part));
    out_.joinings.push_back({std::min(a, b), std::max(a, b), least});
    const std::uint32_t node = borders_.add_set();
    for (const std::uint32_t taken_in : {a, b}) {
      borders_.take_in(node, taken_in, [&](const Pair& pair) { waiting_.drop(pair); });
    }
    for (const std::uint32_t other : borders_.beside(node)) {
      wait(std::minmax(node, other));
    }
  }

  /// Ascending by concavity; what a node is made of still comes before it, since it is no more concave.
  void sort_joinings() {
    const std::size_t made = out_.joinings.size();
    std::vector<std::uint32_t> order(made);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return out_.joinings[i].concavity < out_.joinings[j].concavity;
    });
    std::vector<std::uint32_t> becomes(made);
    for (std::uint32_t i = 0; i < made; ++i) {
      becomes[order[i]] = i;
    }
    const auto leaves = static_cast<std::uint32_t>(out_.leaves);
    const auto renumbered = [&](std::uint32_t node) {
      return node < leaves ? node : leaves + becomes[node - leaves];
    };
    std::vector<Joining> joinings;
    std::vector<Part> nodes(out_.nodes.begin(), out_.nodes.begin() + static_cast<std::ptrdiff_t>(leaves));
    for (const std::uint32_t i : order) {
      const Joining& joining = out_.joinings[i];
      const auto [first, second] = std::minmax({renumbered(joining.first), renumbered(joining.second)});
      joinings.push_back({first, second, joining.concavity});
      nodes.push_back(std::move(out_.nodes[leaves + i]));
    }
    out_.joinings = std::move(joinings);
    out_.nodes = std::move(nodes);
  }

  ScaledSurface scaled_;
  EdgeWeights weights_;
  VertexGraph graph_;
  Measurer measurer_;
  const Context* context_;
  Measurement measurement_;
  BorderGraph<Meeting> borders_;
  PairQueue<std::pair<double, double>> waiting_;
  std::vector<std::uint32_t> facets_;
  std::vector<std::uint32_t> hull_points_;
  Hierarchy out_;
};

}  // namespace

Segmentation Hierarchy::parts(std::size_t count) const {
  const std::size_t made = leaves - count;
  std::vector<bool> alive(leaves + made, true);
  for (std::size_t i = 0; i < made; ++i) {
    alive[joinings[i].first] = alive[joinings[i].second] = false;
  }
  Segmentation s;
  for (std::size_t i = 0; i < alive.size(); ++i) {
    if (alive[i]) {
      s.parts.push_back(nodes[i]);
    }
  }
  std::sort(s.parts.begin(), s.parts.end(),
            [](const Part& a, const Part& b) { return a.faces.front() < b.faces.front(); });
  s.part.resize(faces);
  for (const PartId p : ids<PartId>(s.parts.size())) {
    for (const FaceId f : s.parts[p].faces) {
      s.part[f] = p;
    }
  }
  return s;
}

Hierarchy find_hierarchy(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                         std::size_t at_least, const Context& context) {
  Options options;
  options.concavity = first_tolerance;
  options.holes = Options::Holes::keep;
  // What is measured between parts needs the points in the valleys, too.
  const DividedValleys divided = divide_valleys(surface, polygon, shortest_valley_share * least_tolerance);
  const mesh::Surface& measured = divided.any() ? divided.surface : surface;
  const std::span<const std::uint32_t> together = divided.any() ? divided.polygon : polygon;
  Segmentation finest = segment(measured, together, options, context);
  double tolerance = options.concavity;
  while (finest.parts.size() < at_least && options.concavity > least_tolerance) {
    options.concavity = std::max(least_tolerance, 0.5 * options.concavity);
    // A lower tolerance rarely gives fewer parts, but it may: other cuts are made.
    Segmentation finer = segment(measured, together, options, context);
    if (finer.parts.size() > finest.parts.size()) {
      finest = std::move(finer);
      tolerance = options.concavity;
    }
  }
  if (finest.parts.empty()) {
    return {};
  }
  Hierarchy hierarchy = Joiner(measured, together, tolerance, context).run(finest);
  if (divided.any()) {
    hierarchy.faces = surface.face_count();
    for (Part& node : hierarchy.nodes) {
      divided.to_given_numbers(node);
    }
  }
  return hierarchy;
}

}  // namespace ridgecraft::segment
