// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.hpp"

namespace ridgecraft::export_ {
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

/// Arrangements for each shape that a walk tries without progress before it ends: few shapes have few.
constexpr std::size_t patience_of_shape = 100;
/// Words of bitmap that the walk of rough_page_count() may read.
constexpr std::uint64_t rough_work = 2'000'000;
/// Of two arrangements on as many pages, differences below this share of a page's area, squared and summed
/// over the pages, don't count against keeping groups together.
constexpr double same_use = 0.02;

/// Pages that hold less than this share of their area in paper look forgotten, when there are others to share
/// with: a single small piece, most times.
constexpr double lonely_fill = 0.15;
/// Such pages get shapes until they hold the first share; not beyond the second one, if any shape is small
/// enough: a page that was full had better stay so.
constexpr double shared_fill = 0.2;
constexpr double most_shared_fill = 0.3;
/// A page that holds less than this share of what each other one does comes last.
constexpr double emptier = 0.6;

std::uint32_t emptiest_page(const Arrangement& a) {
  return static_cast<std::uint32_t>(std::min_element(a.used.begin(), a.used.end()) - a.used.begin());
}

/// All shapes: those of the page's groups first, then those of the nearest groups, large ones before small
/// ones.
std::vector<std::uint32_t> nearest_to(const PackingTask& task, const Arrangement& a, std::uint32_t page) {
  std::set<std::uint32_t> groups;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    if (a.places[i].page == page) {
      groups.insert(task.group[i]);
    }
  }
  std::vector<std::uint32_t> distance;
  for (const std::uint32_t own : task.group) {
    std::uint32_t nearest = UINT32_MAX;
    for (const std::uint32_t group : groups) {
      nearest = std::min(nearest, group > own ? group - own : own - group);
    }
    distance.push_back(nearest);
  }
  std::vector<std::uint32_t> order(a.places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto p, auto q) {
    return distance[p] != distance[q] ? distance[p] < distance[q] : task.shapes[p].area > task.shapes[q].area;
  });
  return order;
}

/// Where a page holds next to nothing, it gets shapes of the same groups (or of the next ones) from fuller
/// pages.
void share_with_lonely_page(PackingFill& fill, Arrangement& a) {
  const std::uint32_t lonely = emptiest_page(a);
  if (a.used.size() < 2 || a.used[lonely] >= lonely_fill * fill.page_area()) {
    return;
  }
  const std::vector<std::uint32_t> order = nearest_to(fill.task(), a, lonely);
  for (const double most : {most_shared_fill, 1.0}) {
    for (const std::uint32_t shape : order) {
      const double area = fill.task().shapes[shape].area;
      const std::uint32_t from = a.places[shape].page;
      if (a.used[lonely] < shared_fill * fill.page_area() && from != lonely &&
          a.used[lonely] + area <= most * fill.page_area() && a.used[from] - area >= a.used[lonely] + area) {
        static_cast<void>(fill.move(a, shape, lonely));
      }
    }
  }
}

/// Pages in the order of the groups on them, but one that is much emptier than all others last.
void order_pages(const PackingTask& task, Arrangement& a) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> first;  // lowest group, page
  for (std::uint32_t page = 0; page < a.used.size(); ++page) {
    first.emplace_back(UINT32_MAX, page);
  }
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    auto& group = first[a.places[i].page].first;
    group = std::min(group, task.group[i]);
  }
  std::vector<double> used = a.used;
  std::sort(used.begin(), used.end());
  if (used.size() > 1 && used[0] < emptier * used[1]) {
    first[emptiest_page(a)].first = UINT32_MAX;
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
      const PackingPage& on = is_new ? fresh : base.pages[page];
      auto place = recipe.narrow ? narrowest(on, shape, recipe.leftmost) : lowest(on, shape, recipe.leftmost);
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
  // The bitmap of the page that it leaves still shows it; no more room is looked for there.
  a.used[a.places[shape].page] -= task_->shapes[shape].area;
  place->page = page;
  put(a, shape, *place);
  return true;
}

std::size_t PackingFill::fewest_pages() const {
  double needed = 0.0;
  for (const auto& rasters : rasters_) {
    needed += 0.5 * (cells(rasters.front().solid) + cells(rasters.front().padded)) * grid_.cell * grid_.cell;
  }
  return static_cast<std::size_t>(std::max(1.0, std::ceil(densest_packing * needed / page_area())));
}

std::vector<PackingSearch::Order> PackingSearch::simple_orders() const {
  const std::size_t count = task_.shapes.size();
  std::vector<double> area;
  std::vector<double> boxed;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 size = fill_.rasters(i).front().size;
    area.push_back(task_.shapes[i].area);
    boxed.push_back(size.x * size.y);
  }
  std::vector<Order> orders;
  for (const std::vector<double>* key : {&boxed, &area}) {
    Order order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [key](auto a, auto b) { return (*key)[a] > (*key)[b]; });
    orders.push_back(std::move(order));
  }
  // One group after the other, large shapes first. It comes second, since large jobs stop after two.
  Order grouped = orders.front();
  std::stable_sort(grouped.begin(), grouped.end(),
                   [&](auto a, auto b) { return task_.group[a] < task_.group[b]; });
  orders.insert(orders.begin() + 1, std::move(grouped));
  return orders;
}

/// How many pages each group is spread over, summed.
std::size_t PackingSearch::splits(const Arrangement& a) const {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    seen.emplace(task_.group[i], a.places[i].page);
  }
  return seen.size();
}

PackingMerit PackingSearch::merit(const Arrangement& a) const {
  PackingMerit merit{a.used.size(), 0.0, splits(a), 0.0};
  for (const double used : a.used) {
    const double fraction = used / fill_.page_area();
    merit.exact_evenness += 1.0 - fraction * fraction;
  }
  merit.evenness = std::round(merit.exact_evenness / same_use);
  return merit;
}

void PackingSearch::offer(const Arrangement& candidate) {
  if (shown_.empty() || merit(candidate) < merit(shown_)) {
    shown_ = candidate;
  }
  if (best_.empty() || candidate.packs_better(best_)) {
    best_ = candidate;
  }
}

void PackingSearch::start() {
  int tried = 0;
  for (const Order& order : simple_orders()) {
    Recipe recipe{order};
    for (const auto& [narrow, together] :
         {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
      recipe.narrow = narrow;
      recipe.together = together;
      const Arrangement next = fill_.fill(fill_.nothing(), recipe);
      offer(next);
      if (next.used.size() == 1 || context_.out_of_time()) {
        return;
      }
      if (fill_.work() > task_.search_work && tried > 0) {
        break;
      }
    }
    if (++tried >= 2 && fill_.work() > task_.search_work) {
      return;
    }
  }
}

/// Empties the emptiest page and another one, and fills them again in about the order of area (ruin and
/// recreate, Schrimpf et al. 2000).
Arrangement PackingSearch::refilled(const Arrangement& at) {
  const auto count = static_cast<std::uint32_t>(at.used.size());
  const std::uint32_t emptiest = emptiest_page(at);
  const std::uint32_t other = (emptiest + 1 + random_.below(count - 1)) % count;
  Recipe recipe;
  Arrangement rest = fill_.without(at, {other, emptiest}, recipe.order);
  std::vector<double> key(task_.shapes.size());
  for (const std::uint32_t shape : recipe.order) {
    key[shape] = task_.shapes[shape].area * (0.5 + random_.unit());
  }
  std::stable_sort(recipe.order.begin(), recipe.order.end(), [&](auto a, auto b) { return key[a] > key[b]; });
  recipe.together = random_.below(4) == 0;
  recipe.leftmost = random_.below(2) == 0;
  recipe.narrow = random_.below(2) == 0;
  Arrangement result = fill_.fill(std::move(rest), recipe);
  for (std::uint32_t page = count; page-- > 0;) {
    if (result.used[page] == 0.0) {
      result.used.erase(result.used.begin() + page);
      result.pages.erase(result.pages.begin() + page);
      for (Place& place : result.places) {
        place.page -= place.page > page ? 1U : 0U;
      }
    }
  }
  return result;
}

/// Goes on from what isn't worse, until so few pages are reached.
void PackingSearch::walk(std::size_t enough_pages, std::uint64_t work) {
  const std::size_t fewest = std::max(fill_.fewest_pages(), enough_pages);
  const std::uint64_t limit = fill_.work() + work;
  const std::size_t most_idle = patience_of_shape * task_.shapes.size();
  Arrangement current = best_;
  for (std::size_t idle = 0;
       idle < most_idle && fill_.work() < limit && best_.used.size() > fewest && !context_.out_of_time();
       ++idle) {
    Arrangement candidate = refilled(current);
    offer(candidate);
    if (!current.packs_better(candidate)) {
      idle = candidate.packs_better(current) ? 0 : idle;
      current = std::move(candidate);
    }
  }
}

std::vector<Packed> PackingSearch::run(std::size_t enough_pages) {
  start();
  walk(enough_pages, task_.search_work);
  share_with_lonely_page(fill_, shown_);
  order_pages(task_, shown_);
  return result();
}

std::size_t PackingSearch::rough_page_count() {
  start();
  walk(1, rough_work);
  return shown_.used.size();
}

std::vector<Packed> PackingSearch::run_for_one_page() {
  start();
  return shown_.used.size() == 1 ? result() : std::vector<Packed>{};
}

std::vector<Packed> PackingSearch::result() const {
  std::vector<Packed> result;
  for (std::uint32_t i = 0; i < shown_.places.size(); ++i) {
    const Place& place = shown_.places[i];
    const Raster& raster = fill_.rasters(i)[place.turn];
    // Half a turn of the whole page: filling began at the bottom right, and people begin to read at the top
    // left.
    const Turn turn{-raster.turn.cosine, -raster.turn.sine};
    result.push_back({place.page, turn, task_.area - fill_.corner(place.spot) + raster.low});
  }
  return result;
}

}  // namespace ridgecraft::export_
