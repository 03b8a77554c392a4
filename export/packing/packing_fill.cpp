// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_fill.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace ridgecraft::paper {
namespace {

/// No packing of odd shapes fills more of a page than this, gaps included.
constexpr double densest_packing = 0.92;

/// Widths that differ by less are one: rounding between a turn and the same half a turn later, mm. The next
/// larger difference that counts is a cell.
constexpr double same_width_mm = 1e-6;

/// Cells of the grid, mm.
double cell_size(Vec2 area, double cells) {
  return std::clamp(std::sqrt(area.x * area.y) / cells, 0.5, 4.0);
}

double cells(const std::vector<Raster::Run>& runs) {
  return std::accumulate(runs.begin(), runs.end(), 0.0,
                         [](double sum, const Raster::Run& run) { return sum + run.end - run.begin; });
}

}  // namespace

bool Arrangement::packs_better(const Arrangement& other) const {
  if (used.size() != other.used.size()) {
    return used.size() < other.used.size();
  }
  const auto squares = [](const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  };
  return squares(used) > squares(other.used);
}

PackingFill::PackingFill(const PackingTask& task, const PackingDetail& detail, const Context& context)
    : task_(&task), context_(&context), grid_(task.area, cell_size(task.area, detail.cells)) {
  for (const PackingShape& shape : task.shapes) {
    std::vector<Raster> rasters;
    for (const Turn& turn : turns_to_try(shape, task.area, detail.turns)) {
      rasters.push_back(rasterize(shape, turn, grid_.cell, task.gap));
    }
    RIDGECRAFT_ASSERT(!rasters.empty());
    std::vector<std::uint32_t> turns(rasters.size());
    std::iota(turns.begin(), turns.end(), 0U);
    std::stable_sort(turns.begin(), turns.end(),
                     [&](auto a, auto b) { return rasters[a].size.x < rasters[b].size.x - same_width_mm; });
    by_width_.push_back(std::move(turns));
    rasters_.push_back(std::move(rasters));
    context.check();
  }
}

std::optional<Place> PackingFill::fit(const PackingPage& page, std::uint32_t shape, const Recipe& recipe) {
  if (const std::uint32_t turn = recipe.turn[shape]; turn != Recipe::any_turn) {
    if (const auto spot =
            page.find(rasters_[shape][turn], task_->area.y + fit_tolerance_mm, recipe.leftmost, work_)) {
      return Place{0, turn, *spot};
    }
  }
  return recipe.narrow ? narrowest(page, shape, recipe.leftmost) : lowest(page, shape, recipe.leftmost);
}

std::optional<Place> PackingFill::lowest(const PackingPage& page, std::uint32_t shape, bool leftmost) {
  std::optional<Place> best;
  double limit = task_->area.y + fit_tolerance_mm;
  for (std::uint32_t turn = 0; turn < rasters_[shape].size(); ++turn) {
    const Raster& raster = rasters_[shape][turn];
    if (const auto spot = page.find(raster, limit, leftmost, work_)) {
      best = Place{0, turn, *spot};
      // The next turn has to lie lower by at least a cell.
      limit = spot->row * grid_.cell + raster.size.y - grid_.cell;
    }
  }
  return best;
}

std::optional<Place> PackingFill::narrowest(const PackingPage& page, std::uint32_t shape, bool leftmost) {
  for (const std::uint32_t turn : by_width_[shape]) {
    if (const auto spot =
            page.find(rasters_[shape][turn], task_->area.y + fit_tolerance_mm, leftmost, work_)) {
      return Place{0, turn, *spot};
    }
  }
  return std::nullopt;
}

void PackingFill::put(Arrangement& a, std::uint32_t shape, Place place) const {
  if (place.page == a.pages.size()) {
    a.pages.emplace_back(grid_);
    a.used.push_back(0.0);
  }
  a.pages[place.page].take(rasters_[shape][place.turn], place.spot);
  a.used[place.page] += task_->shapes[shape].area;
  a.places[shape] = place;
}

Arrangement PackingFill::nothing() const {
  Arrangement a;
  a.places.resize(task_->shapes.size());
  return a;
}

Arrangement PackingFill::fill(Arrangement base, const Recipe& recipe) {
  std::vector<std::vector<std::uint32_t>> groups(base.pages.size());
  for (std::size_t i = 0; recipe.together && i < base.places.size(); ++i) {
    if (base.places[i].page != UINT32_MAX) {
      groups[base.places[i].page].push_back(task_->group[i]);
    }
  }
  const PackingPage fresh(grid_);
  std::vector<std::uint32_t> candidates;
  for (const std::uint32_t shape : recipe.order) {
    context_->check();
    candidates.resize(base.pages.size());
    std::iota(candidates.begin(), candidates.end(), 0U);
    std::stable_partition(candidates.begin(), candidates.end(),
                          [&](auto page) { return base.used[page] > 0.0; });
    if (recipe.together) {
      std::stable_partition(candidates.begin(), candidates.end(), [&](std::uint32_t page) {
        return std::find(groups[page].begin(), groups[page].end(), task_->group[shape]) != groups[page].end();
      });
    }
    // After the time limit a page for each shape is enough: the last one, or a new one.
    if (candidates.size() > 1 && context_->out_of_time()) {
      candidates.erase(candidates.begin(), candidates.end() - 1);
    }
    candidates.push_back(static_cast<std::uint32_t>(base.pages.size()));
    for (const std::uint32_t page : candidates) {
      const bool is_new = page == base.pages.size();
      if (!is_new && base.used[page] + task_->shapes[shape].area > page_area()) {
        continue;
      }
      auto place = fit(is_new ? fresh : base.pages[page], shape, recipe);
      RIDGECRAFT_ASSERT(place || !is_new);
      if (place) {
        place->page = page;
        put(base, shape, *place);
        groups.resize(base.pages.size());
        groups[page].push_back(task_->group[shape]);
        break;
      }
    }
  }
  return base;
}

Arrangement PackingFill::without(const Arrangement& a, const std::vector<std::uint32_t>& pages,
                                 std::vector<std::uint32_t>& removed) const {
  Arrangement rest = a;
  for (const std::uint32_t page : pages) {
    rest.pages[page] = PackingPage(grid_);
    rest.used[page] = 0.0;
  }
  for (std::uint32_t i = 0; i < rest.places.size(); ++i) {
    if (std::find(pages.begin(), pages.end(), rest.places[i].page) != pages.end()) {
      rest.places[i] = Place{};
      removed.push_back(i);
    }
  }
  return rest;
}

bool PackingFill::move(Arrangement& a, std::uint32_t shape, std::uint32_t page) {
  auto place = lowest(a.pages[page], shape, false);
  if (!place) {
    return false;
  }
  // The bitmap of the page that it leaves still shows it; nobody asks for more room there.
  a.used[a.places[shape].page] -= task_->shapes[shape].area;
  place->page = page;
  put(a, shape, *place);
  return true;
}

Arrangement PackingFill::placed(const std::vector<Place>& places) const {
  Arrangement a = nothing();
  std::uint32_t pages = 0;
  for (const Place& place : places) {
    pages = std::max(pages, place.page + 1);
  }
  a.pages.assign(pages, PackingPage(grid_));
  a.used.assign(pages, 0.0);
  for (std::uint32_t shape = 0; shape < places.size(); ++shape) {
    put(a, shape, places[shape]);
  }
  return a;
}

double PackingFill::needed_area() const {
  double area = 0.0;
  for (const auto& rasters : rasters_) {
    area += 0.5 * (cells(rasters.front().solid) + cells(rasters.front().padded)) * grid_.cell * grid_.cell;
  }
  return area;
}

std::size_t PackingFill::fewest_pages() const {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(densest_packing * needed_area() / page_area())));
}

}  // namespace ridgecraft::paper
