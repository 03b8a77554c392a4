// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

/// Share of the fold in the weight; the rest is length alone.
constexpr double alpha = 0.8;
/// More than any cosine: no edge is too flat to be concave.
constexpr double no_dead_zone = 2.0;
/// cos 5 degrees: flatter concave edges are noise of the mesh, no place to cut.
constexpr double dead_zone_cosine = 0.99619469809174555;
/// Relative height of the neighbour's centroid above a facet from which the edge is concave: rounding of
/// centroids.
constexpr double rise_tolerance = 1e-9;
constexpr double least_weight = 1e-6;
constexpr double capacity_steps = 0x1p20;
/// Keeps the sum over all sides of the largest mesh below 2^63.
constexpr double largest_weight = 1e6;

bool is_concave(const ScaledSurface& s, std::uint32_t f, std::uint32_t g, double flattest_cosine) {
  const Vec3 n = s.facet_normal(f);
  const Vec3 m = s.facet_normal(g);
  if (n == Vec3{} || m == Vec3{} || dot(n, m) >= flattest_cosine) {
    return false;
  }
  const auto centroid = [&](std::uint32_t facet) {
    const auto& [a, b, c] = s.corners[facet];
    return (s.points[a] + s.points[b] + s.points[c]) / 3.0;
  };
  const Vec3 over = centroid(g) - centroid(f);
  return dot(n, over) > rise_tolerance * length(over);
}

/// Do two facets have labels that differ? Facets that close holes have none.
bool at_border(const ScaledSurface& s, std::span<const std::uint32_t> label, std::uint32_t f,
               std::uint32_t g) {
  if (label.empty()) {
    return false;
  }
  const auto number = [&](std::uint32_t facet) {
    return facet < s.face_of.size() ? s.face_of[facet] : facet;
  };
  const std::uint32_t a = number(f);
  const std::uint32_t b = number(g);
  return a < label.size() && b < label.size() && label[a] != label[b];
}

}  // namespace

EdgeWeights::EdgeWeights(const ScaledSurface& s, const Rules& rules, std::span<const std::uint32_t> label)
    : surface_(&s), folds_by_length_(rules.folds_by_length), kind_(3 * s.facet_count(), EdgeKind::rim) {
  const double flattest_cosine = folds_by_length_ ? dead_zone_cosine : no_dead_zone;
  double length_sum = 0.0;
  double smoothness_sum = 0.0;
  std::size_t edges = 0;
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == no_index || g < f) {
        continue;
      }
      const std::uint32_t to = s.corners[f][(k + 1) % 3];
      std::uint32_t j = 0;
      while (j < 2 && !(s.neighbors[g][j] == f && s.corners[g][j] == to)) {
        ++j;
      }
      const std::uint32_t side = 3 * f + k;
      const bool concave = is_concave(s, f, g, flattest_cosine);
      kind_[side] = kind_[3 * g + j] = at_border(s, label, f, g)
                                           ? (concave ? EdgeKind::drawn_in_hollow : EdgeKind::drawn)
                                           : (concave ? EdgeKind::hollow : EdgeKind::smooth);
      length_sum += s.side_length(side);
      smoothness_sum += smoothness(side);
      ++edges;
    }
  }
  if (edges > 0) {
    const auto count = static_cast<double>(edges);
    mean_length_ = length_sum > 0.0 ? length_sum / count : 1.0;
    mean_smoothness_ = smoothness_sum / count;
  }
}

std::int64_t EdgeWeights::capacity(std::size_t side) const {
  if (kind_[side] == EdgeKind::rim) {
    return 0;
  }
  const double fold = alpha * smoothness(side) / mean_smoothness_;
  const double relative_length = surface_->side_length(side) / mean_length_;
  const double weight =
      folds_by_length_ ? (fold + 1.0 - alpha) * relative_length : fold + (1.0 - alpha) * relative_length;
  return std::llround(capacity_steps * std::clamp(weight, least_weight, largest_weight));
}

EdgeWeights weigh_edges(const ScaledSurface& s, const Rules& rules, std::span<const std::uint32_t> label) {
  return {s, rules, label};
}

/// After cuts of so many facets the room for them is given back: parts are smaller than the whole, and what
/// is looked at next, their hulls, needs as much.
constexpr std::size_t most_kept_facets = 1U << 18U;

Cutter::Cutter(const ScaledSurface& surface, const EdgeWeights& weights, std::size_t coarse_from)
    : surface_(&surface),
      weights_(&weights),
      coarse_from_(coarse_from),
      regions_(surface),
      label_(surface.facet_count(), no_index),
      node_(surface.facet_count(), 0),
      node_mark_(surface.facet_count(), 0) {}

std::vector<Facets> Cutter::components(std::span<const std::uint32_t> facets) {
  return components(facets, label_);
}

std::vector<Facets> Cutter::components(std::span<const std::uint32_t> facets,
                                       std::span<const std::uint32_t> label) {
  // The label says what may be together; a facet is taken out of its set by its mark.
  ++mark_;
  for (const std::uint32_t f : facets) {
    node_mark_[f] = mark_;
  }
  const std::uint32_t open = mark_++;
  std::vector<Facets> found;
  // Facets ascend, so components are found, and filled, in order.
  for (const std::uint32_t start : facets) {
    if (node_mark_[start] == open) {
      const auto number = static_cast<std::uint32_t>(found.size());
      found.emplace_back();
      nodes_.assign(1, start);
      node_mark_[start] = mark_;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        node_[nodes_[i]] = number;
        for (const std::uint32_t g : surface_->neighbors[nodes_[i]]) {
          if (g != no_index && node_mark_[g] == open && label[g] == label[start]) {
            node_mark_[g] = mark_;
            nodes_.push_back(g);
          }
        }
      }
      found.back().reserve(nodes_.size());
    }
    found[node_[start]].push_back(start);
  }
  return found;
}

std::vector<std::uint32_t> Cutter::cut_order(std::span<const Ridge> ridges) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t r = 0; r < ridges.size(); ++r) {
    if (!regions_.must_link(r).empty()) {
      order.push_back(r);
    }
  }
  if (order.size() > most_ridges) {
    // Those with the largest must-links are cut off; one more stands for the rest, which stays together.
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t r, std::uint32_t s) {
      return regions_.must_link(r).size() > regions_.must_link(s).size();
    });
    const auto cut_last = order.begin() + (most_ridges - 1);
    std::sort(order.begin(), cut_last);
    std::stable_sort(order.begin(), cut_last, [&](std::uint32_t r, std::uint32_t s) {
      return ridges[r].diagonal < ridges[s].diagonal;
    });
    order.resize(most_ridges);
    return order;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t r, std::uint32_t s) { return ridges[r].diagonal < ridges[s].diagonal; });
  return order;
}

std::vector<Facets> Cutter::cut(Measurer& measurer, const Measurement& measurement) {
  const PartGraph& part = measurer.graph();
  const std::vector<Ridge> ridges = find_ridges(measurement, surface_->points);
  regions_.assign(measurer, ridges);
  for (const std::uint32_t f : part.facets()) {
    label_[f] = no_index;
  }
  const std::vector<std::uint32_t> order = cut_order(ridges);
  cut_off_.assign(ridges.size(), false);
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    measurer.context().check();
    cut_off(part, order[i]);
  }
  std::vector<Facets> children = components(part.facets());
  if (part.facets().size() > most_kept_facets) {
    coarse_ = CoarseCut();
    flow_ = MaximumFlow();
    nodes_ = {};
    side_ = {};
    touched_ = {};
    flow_node_ = {};
  }
  return children;
}

void Cutter::cut_off(const PartGraph& part, std::uint32_t ridge) {
  cut_off_[ridge] = true;
  flood_fuzzy(part, ridge);
  side_.assign(nodes_.size(), CutSide::open);
  if (nodes_.size() >= coarse_from_) {
    narrow_down(part, ridge);
  }
  do {
    build_flow(part, ridge);
    flow_.run();
  } while (touched_holds(part) && coarse_.widen(touched_, side_));
  for (const std::uint32_t f : regions_.must_link(ridge)) {
    label_[f] = ridge;
  }
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (side_[i] == CutSide::source || (side_[i] == CutSide::open && flow_.on_source_side(flow_node_[i]))) {
      label_[nodes_[i]] = ridge;
    }
  }
}

/// Collects the fuzzy facets that nobody has yet and that hang together with the ridge's must-link.
void Cutter::flood_fuzzy(const PartGraph& part, std::uint32_t ridge) {
  ++mark_;
  nodes_.clear();
  const auto visit = [&](std::uint32_t f) {
    for (const std::uint32_t g : surface_->neighbors[f]) {
      if (part.has(g) && node_mark_[g] != mark_ && regions_.owner(g) == fuzzy && label_[g] == no_index) {
        node_mark_[g] = mark_;
        node_[g] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(g);
      }
    }
  };
  for (const std::uint32_t f : regions_.must_link(ridge)) {
    visit(f);
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    visit(nodes_[i]);
  }
}

/// Calls inner(side, other node, capacity) for each side of a node beyond which another one lies; gives what
/// goes to the regions that are source and sink.
template <class Inner>
Cutter::Ends Cutter::for_sides(const PartGraph& part, std::uint32_t ridge, std::uint32_t node,
                               Inner inner) const {
  const std::uint32_t f = nodes_[node];
  Ends ends;
  for (unsigned k = 0; k < 3; ++k) {
    const std::uint32_t g = surface_->neighbors[f][k];
    if (!part.has(g)) {
      continue;
    }
    const std::int64_t capacity =
        surface_->same_group(f, g) ? MaximumFlow::infinite_capacity : weights_->capacity(3 * f + k);
    const std::uint32_t owner = regions_.owner(g);
    if (owner == fuzzy) {
      if (node_mark_[g] == mark_) {
        inner(k, node_[g], capacity);
      }
    } else if (owner == ridge) {
      ends.source += capacity;
    } else if (!cut_off_[owner]) {
      ends.sink += capacity;
    }
  }
  return ends;
}

/// What build_flow() makes a flow of, with all nodes open.
class Cutter::FuzzyGraph final : public CutGraph {
 public:
  FuzzyGraph(const Cutter& cutter, const PartGraph& part, std::uint32_t ridge)
      : cutter_(cutter), part_(part), ridge_(ridge) {}

  [[nodiscard]] std::size_t size() const override { return cutter_.nodes_.size(); }
  [[nodiscard]] Node node(std::uint32_t i) const override {
    Node result;
    const auto inner = [&](unsigned k, std::uint32_t other, std::int64_t capacity) {
      result.sides[k] = {capacity, other, cutter_.weights_->smoothness(3 * cutter_.nodes_[i] + k) < 1.0};
    };
    const Ends ends = cutter_.for_sides(part_, ridge_, i, inner);
    result.source = ends.source;
    result.sink = ends.sink;
    return result;
  }

 private:
  const Cutter& cutter_;
  const PartGraph& part_;
  std::uint32_t ridge_;
};

/// Decides most nodes by a cut between clusters.
void Cutter::narrow_down(const PartGraph& part, std::uint32_t ridge) {
  coarse_.run(FuzzyGraph(*this, part, ridge), side_);
}

/// Whether the cut runs against nodes that were decided among clusters: a better one may lie beyond.
bool Cutter::touched_holds(const PartGraph& part) {
  touched_.clear();
  if (nodes_.size() < coarse_from_) {
    return false;
  }
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (side_[i] != CutSide::open) {
      continue;
    }
    const CutSide other_side = flow_.on_source_side(flow_node_[i]) ? CutSide::sink : CutSide::source;
    for (const std::uint32_t g : surface_->neighbors[nodes_[i]]) {
      if (part.has(g) && node_mark_[g] == mark_ && side_[node_[g]] == other_side) {
        touched_.push_back(node_[g]);
      }
    }
  }
  return !touched_.empty();
}

void Cutter::build_flow(const PartGraph& part, std::uint32_t ridge) {
  flow_node_.resize(nodes_.size());
  std::uint32_t open = 0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    flow_node_[i] = open;
    open += side_[i] == CutSide::open ? 1U : 0U;
  }
  flow_.reset(open);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (side_[i] != CutSide::open) {
      continue;
    }
    const std::uint32_t node = flow_node_[i];
    const auto inner = [&](unsigned k, std::uint32_t other, std::int64_t capacity) {
      switch (side_[other]) {
        case CutSide::open:
          flow_.set_arc(node, k, flow_node_[other], capacity);
          break;
        case CutSide::source:
          flow_.add_source(node, capacity);
          break;
        case CutSide::sink:
          flow_.add_sink(node, capacity);
          break;
      }
    };
    const Ends ends = for_sides(part, ridge, i, inner);
    flow_.add_source(node, ends.source);
    flow_.add_sink(node, ends.sink);
  }
}

std::vector<Facets> Cutter::split(Measurer& measurer, const Measurement& measurement, bool halves) {
  const PartGraph& part = measurer.graph();
  const std::span<const std::uint32_t> facets = part.facets();
  const std::uint32_t deepest = measurement.deepest;
  std::array<std::vector<double>, 2> distance;
  std::vector<std::uint32_t> reached;
  for (std::size_t end = 0; end < 2; ++end) {
    const Start start{deepest == no_index ? part.vertices()[0]
                      : end == 0          ? measurement.bridges[deepest].a
                                          : measurement.bridges[deepest].b,
                      0.0};
    measurer.search().flood({&start, 1}, INFINITY, reached);
    for (const std::uint32_t f : facets) {
      const auto& v = surface_->corners[f];
      distance[end].push_back(measurer.search().key(v[0]) + measurer.search().key(v[1]) +
                              measurer.search().key(v[2]));
    }
  }
  // Facets of one polygon count together, from its first one on.
  std::vector<double> leaning(facets.size());
  std::vector<std::uint32_t> position;  // of polygons' first facets in `facets`
  for (std::size_t i = 0; i < facets.size(); ++i) {
    leaning[i] = distance[0][i] - distance[1][i];
    if (std::isnan(leaning[i])) {
      leaning[i] = 0.0;
    }
    const auto together = surface_->facets_with(facets[i]);
    if (*std::min_element(together.begin(), together.end()) == facets[i]) {
      position.push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (halves) {
    std::stable_sort(position.begin(), position.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return leaning[i] < leaning[j]; });
  }
  for (std::size_t n = 0; n < position.size(); ++n) {
    const std::uint32_t i = position[n];
    const bool near_a = halves ? n < position.size() / 2 : leaning[i] <= 0.0;
    for (const std::uint32_t f : surface_->facets_with(facets[i])) {
      label_[f] = near_a ? 0 : 1;
    }
  }
  std::vector<Facets> children = components(facets);
  if (children.size() < 2) {
    // Each facet, or each polygon, alone.
    for (std::uint32_t n = 0; n < position.size(); ++n) {
      for (const std::uint32_t f : surface_->facets_with(facets[position[n]])) {
        label_[f] = n;
      }
    }
    children = components(facets);
  }
  return children;
}

}  // namespace ridgecraft::segment
