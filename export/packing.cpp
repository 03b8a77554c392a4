// SPDX-License-Identifier: GPL-3.0-or-later
// First fit by true shape, bottom-left on each page (Baker, Coffman and Rivest 1980, here over bitmaps as in
// Burke et al. 2006), then a random walk over orders that accepts what is not worse.
#include "export/packing.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <optional>
#include <set>

#include "export/packing_page.hpp"
#include "mesh/error.hpp"

namespace ridgecraft::paper {
namespace {

/// Words of bitmap read by the search over orders: about a tenth of a second.
constexpr std::uint64_t work_limit = 12'000'000;
/// Orders tried without progress before the search ends.
constexpr int patience = 200;
/// Pages that hold less than this share of their area in paper look forgotten, when there are others to share
/// with.
constexpr double lonely_fill = 0.1;
/// Such pages are filled up to this share.
constexpr double shared_fill = 0.25;

/// Cells of the grid, mm: fine enough that rounding costs less than the gap, coarse enough for speed.
double cell_size(Vec2 area, std::size_t shapes) {
  return std::clamp(std::sqrt(area.x * area.y) / (shapes <= 150 ? 300.0 : 220.0), 0.5, 2.0);
}

/// Turns tried for each shape: all that help with few shapes, few with hundreds.
std::size_t turn_count(std::size_t shapes) {
  return shapes <= 40 ? 16 : shapes <= 150 ? 8 : 4;
}

/// What an arrangement is made from.
struct Recipe {
  std::vector<std::uint32_t> order;  ///< of the shapes
  std::vector<std::uint32_t> turn;   ///< of each shape: tried alone before all others are, unless `any_turn`
  bool together = false;             ///< on pages with shapes of its group first
  bool leftmost = false;             ///< fills rows from the left
};
constexpr std::uint32_t any_turn = UINT32_MAX;

struct Place {
  std::uint32_t page = 0;
  std::uint32_t turn = 0;
  Spot spot;
};

struct Arrangement {
  std::vector<Place> places;  ///< of each shape
  std::vector<double> used;   ///< area of paper on each page, mm2

  [[nodiscard]] double concentration() const {
    return std::accumulate(used.begin(), used.end(), 0.0, [](double sum, double u) { return sum + u * u; });
  }
  /// For the search: full pages and an empty one are half way to a page less.
  [[nodiscard]] bool packs_better(const Arrangement& other) const {
    return used.size() != other.used.size() ? used.size() < other.used.size()
                                            : concentration() > other.concentration();
  }
};

class Packer {
 public:
  Packer(const PackingTask& task, const Context& context)
      : task_(task),
        context_(context),
        grid_(task.area, cell_size(task.area, task.shapes.size())),
        page_area_(task.area.x * task.area.y) {
    const std::size_t most = turn_count(task.shapes.size());
    for (const PackingShape& shape : task.shapes) {
      std::vector<Raster> rasters;
      for (const Turn& turn : promising_turns(shape.hull, task.area, most)) {
        rasters.push_back(rasterize(shape, turn, grid_.cell, task.gap));
      }
      RIDGECRAFT_ASSERT(!rasters.empty());
      rasters_.push_back(std::move(rasters));
      context.check();
    }
  }

  [[nodiscard]] std::vector<Packed> run();

 private:
  using Order = std::vector<std::uint32_t>;

  /// Pieces one after the other, each on the first page with room.
  [[nodiscard]] Arrangement pack(const Recipe& recipe);
  [[nodiscard]] std::optional<Place> fit(const PackingPage& page, std::uint32_t shape, std::uint32_t only,
                                         bool leftmost);
  [[nodiscard]] std::vector<Order> simple_orders() const;
  void walk(Recipe recipe, const Arrangement& start);
  [[nodiscard]] Recipe changed(Recipe recipe, const Arrangement& at, Random& random) const;
  void offer(const Arrangement& candidate);
  [[nodiscard]] bool shows_better(const Arrangement& a, const Arrangement& b) const;
  [[nodiscard]] std::size_t splits(const Arrangement& a) const;
  [[nodiscard]] std::size_t lonely_pages(const Arrangement& a) const;
  void share_with_lonely_page(Arrangement& a);
  [[nodiscard]] PackingPage rebuilt(const Arrangement& a, std::uint32_t page) const;
  void order_pages(Arrangement& a) const;

  const PackingTask& task_;
  const Context& context_;
  PackingGrid grid_;
  double page_area_;
  std::vector<std::vector<Raster>> rasters_;  ///< of each shape, for each turn
  std::uint64_t work_ = 0;
  Arrangement best_;   ///< as the search counts
  Arrangement shown_;  ///< as people would choose, among those with the fewest pages
};

std::optional<Place> Packer::fit(const PackingPage& page, std::uint32_t shape, std::uint32_t only,
                                 bool leftmost) {
  std::optional<Place> best;
  double limit = task_.area.y + fit_tolerance_mm;
  for (std::uint32_t turn = 0; turn < rasters_[shape].size(); ++turn) {
    if (only != any_turn && turn != only) {
      continue;
    }
    const Raster& raster = rasters_[shape][turn];
    if (const auto spot = page.find(raster, limit, leftmost, work_)) {
      best = Place{0, turn, *spot};
      // The next turn has to lie lower by at least a cell.
      limit = spot->row * grid_.cell + raster.size.y - grid_.cell;
    }
  }
  return best || only == any_turn ? best : fit(page, shape, any_turn, leftmost);
}

Arrangement Packer::pack(const Recipe& recipe) {
  Arrangement result;
  result.places.resize(task_.shapes.size());
  std::vector<PackingPage> pages;
  std::vector<std::vector<std::uint32_t>> groups;  // on each page
  for (const std::uint32_t shape : recipe.order) {
    context_.check();
    const double area = task_.shapes[shape].area;
    std::vector<std::uint32_t> candidates(pages.size());
    std::iota(candidates.begin(), candidates.end(), 0U);
    if (recipe.together) {
      std::stable_partition(candidates.begin(), candidates.end(), [&](std::uint32_t page) {
        return std::find(groups[page].begin(), groups[page].end(), task_.group[shape]) != groups[page].end();
      });
    }
    candidates.push_back(static_cast<std::uint32_t>(pages.size()));
    for (const std::uint32_t page : candidates) {
      if (page == pages.size()) {
        pages.emplace_back(grid_);
        groups.emplace_back();
        result.used.push_back(0.0);
      } else if (result.used[page] + area > page_area_) {
        continue;
      }
      if (auto place = fit(pages[page], shape, recipe.turn[shape], recipe.leftmost)) {
        place->page = page;
        pages[page].take(rasters_[shape][place->turn], place->spot);
        groups[page].push_back(task_.group[shape]);
        result.used[page] += area;
        result.places[shape] = *place;
        break;
      }
    }
  }
  return result;
}

std::vector<Packer::Order> Packer::simple_orders() const {
  const std::size_t count = task_.shapes.size();
  std::vector<double> area;
  std::vector<double> longest;
  std::vector<double> boxed;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 size = rasters_[i].front().size;
    area.push_back(task_.shapes[i].area);
    longest.push_back(std::max(size.x, size.y));
    boxed.push_back(size.x * size.y);
  }
  std::vector<Order> orders;
  for (const std::vector<double>* key : {&boxed, &area, &longest}) {
    Order order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [key](auto a, auto b) { return (*key)[a] > (*key)[b]; });
    orders.push_back(std::move(order));
  }
  // One group after the other, large shapes first.
  Order grouped = orders.front();
  std::stable_sort(grouped.begin(), grouped.end(),
                   [&](auto a, auto b) { return task_.group[a] < task_.group[b]; });
  orders.push_back(std::move(grouped));
  return orders;
}

std::size_t Packer::splits(const Arrangement& a) const {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    seen.emplace(task_.group[i], a.places[i].page);
  }
  return seen.size();
}

std::size_t Packer::lonely_pages(const Arrangement& a) const {
  const auto count = std::count_if(a.used.begin(), a.used.end(),
                                   [&](double used) { return used < lonely_fill * page_area_; });
  return a.used.size() > 1 ? static_cast<std::size_t>(count) : 0;
}

bool Packer::shows_better(const Arrangement& a, const Arrangement& b) const {
  if (a.used.size() != b.used.size()) {
    return a.used.size() < b.used.size();
  }
  if (const auto order = splits(a) <=> splits(b); order != 0) {
    return order < 0;
  }
  if (const auto order = lonely_pages(a) <=> lonely_pages(b); order != 0) {
    return order < 0;
  }
  return a.concentration() > b.concentration();
}

void Packer::offer(const Arrangement& candidate) {
  if (shown_.used.empty() || shows_better(candidate, shown_)) {
    shown_ = candidate;
  }
  if (best_.used.empty() || candidate.packs_better(best_)) {
    best_ = candidate;
  }
}

Recipe Packer::changed(Recipe recipe, const Arrangement& at, Random& random) const {
  const auto count = static_cast<std::uint32_t>(recipe.order.size());
  const auto emptiest =
      static_cast<std::uint32_t>(std::min_element(at.used.begin(), at.used.end()) - at.used.begin());
  const std::uint32_t moves = 1 + random.below(3);
  for (std::uint32_t m = 0; m < moves; ++m) {
    std::uint32_t from = random.below(count);
    // Half of the moves bring a piece of the emptiest page forward: that page is the one to get rid of.
    for (int tries = 0; tries < 8 && random.below(2) == 0 && at.places[recipe.order[from]].page != emptiest;
         ++tries) {
      from = random.below(count);
    }
    const std::uint32_t shape = recipe.order[from];
    recipe.order.erase(recipe.order.begin() + from);
    recipe.order.insert(recipe.order.begin() + random.below(count), shape);
    const std::uint32_t turned = random.below(count);
    const auto turns = static_cast<std::uint32_t>(rasters_[turned].size());
    recipe.turn[turned] = random.below(4) == 0 ? any_turn : random.below(turns);
  }
  recipe.together = random.below(4) == 0;
  recipe.leftmost = random.below(2) == 0;
  return recipe;
}

void Packer::walk(Recipe recipe, const Arrangement& start) {
  const double total = std::accumulate(start.used.begin(), start.used.end(), 0.0);
  const auto fewest = static_cast<std::size_t>(std::max(1.0, std::ceil(total / page_area_)));
  Random random(context_.seed);
  Arrangement current = start;
  const std::uint64_t limit = work_ + work_limit;
  for (int idle = 0; idle < patience && work_ < limit && best_.used.size() > fewest; ++idle) {
    Recipe next = changed(recipe, current, random);
    Arrangement candidate = pack(next);
    offer(candidate);
    if (!current.packs_better(candidate)) {
      idle = candidate.packs_better(current) ? -1 : idle;
      recipe = std::move(next);
      current = std::move(candidate);
    }
  }
}

PackingPage Packer::rebuilt(const Arrangement& a, std::uint32_t page) const {
  PackingPage result(grid_);
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    if (a.places[i].page == page) {
      result.take(rasters_[i][a.places[i].turn], a.places[i].spot);
    }
  }
  return result;
}

void Packer::share_with_lonely_page(Arrangement& a) {
  if (lonely_pages(a) == 0) {
    return;
  }
  const auto lonely =
      static_cast<std::uint32_t>(std::min_element(a.used.begin(), a.used.end()) - a.used.begin());
  std::set<std::uint32_t> groups;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    if (a.places[i].page == lonely) {
      groups.insert(task_.group[i]);
    }
  }
  // Pieces of the same groups first, then those of the nearest groups, large ones before small ones.
  Order order(a.places.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto distance = [&](std::uint32_t shape) {
    std::uint32_t nearest = UINT32_MAX;
    for (const std::uint32_t group : groups) {
      nearest = std::min(
          nearest, group > task_.group[shape] ? group - task_.group[shape] : task_.group[shape] - group);
    }
    return nearest;
  };
  std::stable_sort(order.begin(), order.end(), [&](auto p, auto q) {
    return distance(p) != distance(q) ? distance(p) < distance(q)
                                      : task_.shapes[p].area > task_.shapes[q].area;
  });
  PackingPage page = rebuilt(a, lonely);
  for (const std::uint32_t shape : order) {
    const double area = task_.shapes[shape].area;
    const std::uint32_t from = a.places[shape].page;
    const bool enough = a.used[lonely] >= shared_fill * page_area_;
    if (enough || from == lonely || a.used[from] - area < a.used[lonely] + area) {
      continue;
    }
    if (auto place = fit(page, shape, any_turn, false)) {
      page.take(rasters_[shape][place->turn], place->spot);
      place->page = lonely;
      a.places[shape] = *place;
      a.used[from] -= area;
      a.used[lonely] += area;
    }
  }
}

void Packer::order_pages(Arrangement& a) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> first;  // lowest group, page
  for (std::uint32_t page = 0; page < a.used.size(); ++page) {
    first.emplace_back(UINT32_MAX, page);
  }
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    auto& group = first[a.places[i].page].first;
    group = std::min(group, task_.group[i]);
  }
  std::sort(first.begin(), first.end());
  std::vector<std::uint32_t> number(first.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    number[first[i].second] = i;
  }
  for (Place& place : a.places) {
    place.page = number[place.page];
  }
}

std::vector<Packed> Packer::run() {
  Recipe best;
  for (const Order& order : simple_orders()) {
    Recipe recipe{order, std::vector<std::uint32_t>(order.size(), any_turn), false, false};
    const Arrangement plain = pack(recipe);
    if (best_.used.empty() || plain.packs_better(best_)) {
      best = recipe;
    }
    offer(plain);
    if (plain.used.size() == 1 || work_ > work_limit) {
      break;  // nothing to gain, or no time for it
    }
    recipe.together = true;
    offer(pack(recipe));
  }
  walk(best, Arrangement(best_));
  share_with_lonely_page(shown_);
  order_pages(shown_);
  std::vector<Packed> result;
  for (std::size_t i = 0; i < shown_.places.size(); ++i) {
    const Place& place = shown_.places[i];
    const Raster& raster = rasters_[i][place.turn];
    const Vec2 corner{place.spot.column * grid_.cell, place.spot.row * grid_.cell};
    // Half a turn of the whole page: filling began at the bottom right, and people begin to read at the top
    // left.
    const Turn turn{-raster.turn.cosine, -raster.turn.sine};
    result.push_back({place.page, turn, task_.area - corner + raster.low});
  }
  return result;
}

}  // namespace

std::vector<Packed> pack(const PackingTask& task, const Context& context) {
  if (task.shapes.empty()) {
    return {};
  }
  return Packer(task, context).run();
}

}  // namespace ridgecraft::paper
