// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace ridgecraft::segment {

Cutter::Cutter(const ScaledSurface& surface, const EdgeWeights& weights)
    : surface_(&surface),
      weights_(&weights),
      regions_(surface),
      label_(surface.facet_count(), none),
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
          if (g != none && node_mark_[g] == open && label[g] == label[start]) {
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
    label_[f] = none;
  }
  const std::vector<std::uint32_t> order = cut_order(ridges);
  cut_off_.assign(ridges.size(), false);
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    measurer.context().check();
    cut_off(part, order[i]);
  }
  return components(part.facets());
}

void Cutter::cut_off(const PartGraph& part, std::uint32_t ridge) {
  cut_off_[ridge] = true;
  flood_fuzzy(part, ridge);
  build_flow(part, ridge);
  flow_.run();
  for (const std::uint32_t f : regions_.must_link(ridge)) {
    label_[f] = ridge;
  }
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (flow_.on_source_side(i)) {
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
      if (part.has(g) && node_mark_[g] != mark_ && regions_.owner(g) == fuzzy && label_[g] == none) {
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

void Cutter::build_flow(const PartGraph& part, std::uint32_t ridge) {
  flow_.reset(static_cast<std::uint32_t>(nodes_.size()));
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const std::uint32_t f = nodes_[i];
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = surface_->neighbors[f][k];
      if (!part.has(g)) {
        continue;
      }
      const std::int64_t capacity =
          surface_->same_group(f, g) ? MaximumFlow::infinite_capacity : weights_->capacity[3 * f + k];
      const std::uint32_t owner = regions_.owner(g);
      if (owner == fuzzy) {
        if (node_mark_[g] == mark_) {
          flow_.set_arc(i, k, node_[g], capacity);
        }
      } else if (owner == ridge) {
        flow_.add_source(i, capacity);
      } else if (!cut_off_[owner]) {
        flow_.add_sink(i, capacity);
      }
    }
  }
}

std::vector<Facets> Cutter::split(Measurer& measurer, const Measurement& measurement, bool halves) {
  const PartGraph& part = measurer.graph();
  const std::span<const std::uint32_t> facets = part.facets();
  const std::uint32_t deepest = measurement.deepest;
  std::array<std::vector<double>, 2> distance;
  std::vector<std::uint32_t> reached;
  for (std::size_t end = 0; end < 2; ++end) {
    const Start start{deepest == none ? part.vertices()[0]
                      : end == 0      ? measurement.bridges[deepest].a
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
