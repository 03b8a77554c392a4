// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/regions.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

/// Union-find over hull vertices in which enemies never meet.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n), enemies_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void make_enemies(std::uint32_t a, std::uint32_t b) {
    enemies_[a].push_back(b);
    enemies_[b].push_back(a);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = root(a);
    std::uint32_t y = root(b);
    if (x == y) {
      return;
    }
    if (enemies_[x].size() < enemies_[y].size()) {
      std::swap(x, y);
    }
    // Enmity goes both ways, so the shorter list tells.
    for (const std::uint32_t enemy : enemies_[y]) {
      if (root(enemy) == x) {
        return;
      }
    }
    parent_[y] = x;
    enemies_[x].insert(enemies_[x].end(), enemies_[y].begin(), enemies_[y].end());
    enemies_[y].clear();
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::vector<std::uint32_t>> enemies_;
};

}  // namespace

std::vector<Ridge> find_ridges(const Measurement& m, std::span<const Vec3> points) {
  const auto& hull = m.hull.vertices;
  const auto local = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(hull.begin(), hull.end(), v) - hull.begin());
  };
  Sets sets(hull.size());
  std::vector<double> reach(hull.size(), -1.0);
  std::vector<std::pair<double, std::uint32_t>> low;  // length of the valley, number
  for (std::uint32_t i = 0; i < m.bridges.size(); ++i) {
    const Bridge& b = m.bridges[i];
    if (!b.high) {
      low.emplace_back(b.length, i);
      continue;
    }
    const std::uint32_t a = local(b.a);
    const std::uint32_t c = local(b.b);
    sets.make_enemies(a, c);
    const auto [from_a, from_b] = sub_valleys(b, m.bridges);
    reach[a] = std::max(reach[a], from_a);
    reach[c] = std::max(reach[c], from_b);
  }
  std::sort(low.begin(), low.end());
  for (const auto& [length, i] : low) {
    sets.join(local(m.bridges[i].a), local(m.bridges[i].b));
  }
  // Hull vertices ascend, so ridges are numbered by their smallest one.
  std::vector<std::uint32_t> number(hull.size(), no_index);
  std::vector<Ridge> all;
  for (std::uint32_t v = 0; v < hull.size(); ++v) {
    std::uint32_t& n = number[sets.root(v)];
    if (n == no_index) {
      n = static_cast<std::uint32_t>(all.size());
      all.emplace_back();
    }
    all[n].vertices.push_back(hull[v]);
    if (reach[v] >= 0.0) {
      all[n].ends.push_back({hull[v], reach[v]});
    }
  }
  std::erase_if(all, [](const Ridge& r) { return r.ends.empty(); });
  for (Ridge& r : all) {
    Box3 box;
    for (const std::uint32_t v : r.vertices) {
      box.add(points[v]);
    }
    r.diagonal = box.diagonal();
  }
  return all;
}

constexpr std::uint32_t untouched = 0xfffffffeU;

Regions::Regions(const ScaledSurface& surface)
    : surface_(&surface),
      owner_(surface.facet_count(), fuzzy),
      mark_(surface.facet_count(), 0),
      corners_(surface.facet_count(), 0),
      group_mark_(surface.group_first.size(), 0),
      group_count_(surface.group_first.size(), 0) {}

void Regions::assign(Measurer& measurer, std::span<const Ridge> ridges) {
  const PartGraph& part = measurer.graph();
  for (const std::uint32_t f : part.facets()) {
    owner_[f] = untouched;
  }
  for (std::uint32_t r = 0; r < ridges.size(); ++r) {
    measurer.context().check();
    find_potential_region(measurer, ridges[r]);
    for (const std::uint32_t f : region_) {
      owner_[f] = owner_[f] == untouched ? r : fuzzy;
    }
  }
  must_link_.assign(ridges.size(), {});
  for (const std::uint32_t f : part.facets()) {
    if (owner_[f] == untouched) {
      owner_[f] = fuzzy;
    } else if (owner_[f] != fuzzy) {
      must_link_[owner_[f]].push_back(f);
    }
  }
  fill_empty(part, ridges);
}

void Regions::find_potential_region(Measurer& measurer, const Ridge& ridge) {
  starts_.clear();
  for (const Ridge::End& end : ridge.ends) {
    if (end.reach > 0.0) {
      starts_.push_back({end.vertex, -end.reach});
    }
  }
  measurer.search().flood(starts_, 0.0, reached_);
  const PartGraph& part = measurer.graph();
  ++flood_;
  region_.clear();
  for (const std::uint32_t v : reached_) {
    for (const std::uint32_t f : surface_->facets_at(v)) {
      if (!part.has(f)) {
        continue;
      }
      if (mark_[f] != flood_) {
        mark_[f] = flood_;
        corners_[f] = 0;
      }
      if (++corners_[f] == 3) {
        region_.push_back(f);
      }
    }
  }
  keep_whole_polygons();
}

void Regions::keep_whole_polygons() {
  if (surface_->group.empty()) {
    return;
  }
  for (const std::uint32_t f : region_) {
    const std::uint32_t g = surface_->group[f];
    if (group_mark_[g] != flood_) {
      group_mark_[g] = flood_;
      group_count_[g] = 0;
    }
    ++group_count_[g];
  }
  std::erase_if(region_, [&](std::uint32_t f) {
    return group_count_[surface_->group[f]] != surface_->facets_with(f).size();
  });
}

void Regions::fill_empty(const PartGraph& part, std::span<const Ridge> ridges) {
  for (std::uint32_t r = 0; r < ridges.size(); ++r) {
    if (!must_link_[r].empty()) {
      continue;
    }
    for (const Ridge::End& end : ridges[r].ends) {
      for (const std::uint32_t around : surface_->facets_at(end.vertex)) {
        if (!part.has(around) || owner_[around] != fuzzy) {
          continue;
        }
        for (const std::uint32_t f : surface_->facets_with(around)) {
          owner_[f] = r;
          must_link_[r].push_back(f);
        }
      }
    }
  }
}

}  // namespace ridgecraft::segment
