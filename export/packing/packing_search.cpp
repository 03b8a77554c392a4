// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "export/packing/packing_finish.hpp"
#include "export/packing/packing_separate.hpp"

namespace ridgecraft::paper {
namespace {

/// Arrangements tried without progress before a walk ends, at most and for each shape: two shapes have few.
constexpr int patience = 2000;
constexpr int patience_of_shape = 150;
/// Words of bitmap read by all simple orders, and by the walk after them; 2 million take some 8 ms.
constexpr std::uint64_t walk_work = 2'000'000;
/// Runs of cells that moving apart may look at in vain; some 8 ms.
constexpr std::uint64_t separation_work = 4'000'000;
/// Shapes, half the gap around them included, that fill more than this share of their pages can't be moved
/// apart in any time that makers would wait.
constexpr double densest_separation = 0.85;
/// Of two arrangements on as many pages, differences below this share of a page's area, squared and summed
/// over the pages, don't count against keeping groups together.
constexpr double same_use = 0.02;

}  // namespace

std::vector<PackingSearch::Order> PackingSearch::simple_orders() const {
  const std::size_t count = task_.shapes.size();
  std::vector<double> area;
  std::vector<double> longest;
  std::vector<double> boxed;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 size = fill_.rasters(i).front().size;
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
    const double share = used / fill_.page_area();
    merit.exact_evenness += 1.0 - share * share;
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
    Recipe recipe{order, std::vector<std::uint32_t>(order.size(), Recipe::any_turn), false, false, false};
    for (const auto& [narrow, together] :
         {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
      recipe.narrow = narrow;
      recipe.together = together;
      const Arrangement next = fill_.fill(fill_.nothing(), recipe);
      if (best_.empty() || next.packs_better(best_)) {
        recipe_ = recipe;
      }
      offer(next);
      if (next.used.size() == 1) {
        return;  // nothing to gain
      }
      if (context_.out_of_time()) {
        return;
      }
      if (fill_.work() > walk_work && tried > 0) {
        break;
      }
    }
    if (++tried >= 2 && fill_.work() > walk_work) {
      return;
    }
  }
}

/// A few shapes earlier or later, and turned.
Recipe PackingSearch::changed(Recipe recipe, const Arrangement& at) {
  const auto count = static_cast<std::uint32_t>(recipe.order.size());
  const auto emptiest =
      static_cast<std::uint32_t>(std::min_element(at.used.begin(), at.used.end()) - at.used.begin());
  for (std::uint32_t moves = 1 + random_.below(3); moves > 0; --moves) {
    std::uint32_t from = random_.below(count);
    // Half of the moves take a shape of the emptiest page: that page is the one to get rid of.
    for (int tries = 0; tries < 8 && random_.below(2) == 0 && at.places[recipe.order[from]].page != emptiest;
         ++tries) {
      from = random_.below(count);
    }
    const std::uint32_t shape = recipe.order[from];
    recipe.order.erase(recipe.order.begin() + from);
    recipe.order.insert(recipe.order.begin() + random_.below(count), shape);
    const std::uint32_t turned = random_.below(count);
    const auto turns = static_cast<std::uint32_t>(fill_.rasters(turned).size());
    recipe.turn[turned] = random_.below(4) == 0 ? Recipe::any_turn : random_.below(turns);
  }
  recipe.together = random_.below(4) == 0;
  recipe.leftmost = random_.below(2) == 0;
  recipe.narrow = random_.below(2) == 0;
  return recipe;
}

/// Empties the emptiest page and another one, and fills them again in about the order of area (ruin and
/// recreate, Schrimpf et al. 2000).
Arrangement PackingSearch::refilled(const Arrangement& at) {
  const auto count = static_cast<std::uint32_t>(at.used.size());
  const auto emptiest =
      static_cast<std::uint32_t>(std::min_element(at.used.begin(), at.used.end()) - at.used.begin());
  const std::uint32_t other = (emptiest + 1 + random_.below(count - 1)) % count;
  Recipe recipe;
  Arrangement rest = fill_.without(at, {other, emptiest}, recipe.order);
  recipe.turn.assign(task_.shapes.size(), Recipe::any_turn);
  std::vector<double> key(task_.shapes.size());
  for (const std::uint32_t shape : recipe.order) {
    const auto turns = static_cast<std::uint32_t>(fill_.rasters(shape).size());
    key[shape] = task_.shapes[shape].area * (0.5 + random_.unit());
    recipe.turn[shape] = random_.below(3) == 0 ? random_.below(turns) : Recipe::any_turn;
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

void PackingSearch::walk() {
  const std::size_t fewest = fill_.fewest_pages();
  const std::uint64_t limit = fill_.work() + walk_work;
  Recipe recipe = recipe_;
  Arrangement current = best_;
  const int most_idle = std::min(
      patience, patience_of_shape * static_cast<int>(std::min<std::size_t>(1000, task_.shapes.size())));
  for (int idle = 0;
       idle < most_idle && fill_.work() < limit && best_.used.size() > fewest && !context_.out_of_time();
       ++idle) {
    // With two pages both ways empty everything, but the walk over orders remembers what was good.
    const bool by_order = current.used.size() == 2;
    Recipe next = by_order ? changed(recipe, current) : Recipe{};
    Arrangement candidate = by_order ? fill_.fill(fill_.nothing(), next) : refilled(current);
    offer(candidate);
    if (!current.packs_better(candidate)) {
      idle = candidate.packs_better(current) ? -1 : idle;
      if (by_order) {
        recipe = std::move(next);
      }
      current = std::move(candidate);
    }
  }
}

/// Tries to do without the emptiest page: its shapes go onto the others, then all are moved apart.
bool PackingSearch::separate() {
  const auto pages = static_cast<std::uint32_t>(shown_.used.size() - 1);
  if (pages == 0 || fill_.needed_area() > densest_separation * pages * fill_.page_area() ||
      context_.out_of_time()) {
    return false;
  }
  const auto emptiest = static_cast<std::uint32_t>(std::min_element(shown_.used.begin(), shown_.used.end()) -
                                                   shown_.used.begin());
  std::vector<Place> places = shown_.places;
  for (Place& place : places) {
    if (place.page == emptiest) {
      place.page = random_.below(pages);
      place.spot = {};
    } else if (place.page > emptiest) {
      --place.page;
    }
  }
  PackingSeparation separation(fill_, random_, context_);
  if (!separation.run(places, pages, separation_work)) {
    return false;
  }
  offer(fill_.placed(places));
  return true;
}

std::vector<Packed> PackingSearch::run() {
  start();
  walk();
  while (separate()) {
  }
  share_with_lonely_page(fill_, shown_);
  order_pages(task_, shown_);
  return result();
}

std::size_t PackingSearch::rough_page_count() {
  start();
  separate();
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

}  // namespace ridgecraft::paper
