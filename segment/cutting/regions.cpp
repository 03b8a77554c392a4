// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/regions.hpp"

#include <algorithm>

namespace ridgecraft::segment {
namespace {

constexpr std::uint32_t untouched = 0xfffffffeU;

}  // namespace

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
