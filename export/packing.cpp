// SPDX-License-Identifier: GPL-3.0-or-later
// The search over arrangements: simple orders first, then a random walk that accepts what is not worse (over
// orders, or by emptying two pages and filling them again). Of all that it meets, people get the fewest
// pages, then the fullest ones, then groups that stay together. Coarse searches from two sides and a fine one
// follow each other.
#include "export/packing.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <set>

#include "export/packing_fill.hpp"
#include "mesh/error.hpp"

namespace ridgecraft::paper {
namespace {

/// Arrangements tried without progress before a search ends, at most and for each shape: two shapes have few.
constexpr int patience = 2000;
constexpr int patience_of_shape = 150;
/// Pages that hold less than this share of their area in paper look forgotten, when there are others to share
/// with.
constexpr double lonely_fill = 0.03;
/// Such pages are filled up to this share.
constexpr double shared_fill = 0.25;
/// Of two arrangements on as many pages, differences below this share of a page's area, squared and summed
/// over the pages, don't count against keeping groups together.
constexpr double same_use = 0.02;
/// A page that holds less than this share of what each other one does comes last.
constexpr double emptier = 0.6;

/// One search: how fine, from which side pages are filled, and how long (words of bitmap read; 4 million take
/// some 0.05 s).
struct Search {
  PackingDetail detail;
  bool sideways;
  std::uint64_t work;
};

/// Few shapes: coarse searches with many turns find the orders that save a page, a fine one the places that
/// only just suffice. Many: one order after the other takes all the time there is.
std::vector<Search> searches_for(std::size_t shapes) {
  if (shapes > 150) {
    return {{{220.0, 4}, false, 4'000'000}};
  }
  if (shapes > 40) {
    return {{{150.0, 12}, false, 5'000'000}, {{150.0, 12}, true, 5'000'000}, {{300.0, 8}, false, 4'000'000}};
  }
  return {{{150.0, 32}, false, 6'000'000}, {{150.0, 32}, true, 6'000'000}, {{300.0, 16}, false, 4'000'000}};
}

using Order = std::vector<std::uint32_t>;

/// What people would choose by, the most important first; smaller is better.
struct Merit {
  std::size_t pages = SIZE_MAX;
  double evenness = 0.0;  ///< pages less the sum of their squared use: full pages and one that is nearly
                          ///< empty are better than all of them half full; in steps of same_use
  std::size_t splits = 0;
  double exact_evenness = 0.0;

  friend auto operator<=>(const Merit&, const Merit&) = default;
};

class Packer {
 public:
  Packer(const PackingTask& task, const Search& search, const Context& context)
      : task_(task),
        context_(context),
        work_limit_(search.work),
        fill_(task, search.detail, context),
        random_(context.seed) {}
  void run();
  [[nodiscard]] Merit merit() const { return merit(shown_); }
  [[nodiscard]] std::vector<Packed> result() const;
  /// No search can do with fewer pages, or make fewer of them fuller.
  [[nodiscard]] bool is_least() const { return shown_.used.size() == 1; }

 private:
  [[nodiscard]] std::vector<Order> simple_orders() const;
  void start();
  void walk();
  [[nodiscard]] Recipe changed(Recipe recipe, const Arrangement& at);
  [[nodiscard]] Arrangement refilled(const Arrangement& at);
  void offer(const Arrangement& candidate);
  [[nodiscard]] Merit merit(const Arrangement& a) const;
  [[nodiscard]] std::size_t splits(const Arrangement& a) const;
  [[nodiscard]] std::size_t lonely_pages(const Arrangement& a) const;
  void share_with_lonely_page(Arrangement& a);
  void order_pages(Arrangement& a) const;

  const PackingTask& task_;
  const Context& context_;
  std::uint64_t work_limit_;
  PackingFill fill_;
  Random random_;
  Recipe recipe_;      ///< of best_, after start()
  Arrangement best_;   ///< as the search counts
  Arrangement shown_;  ///< as people would choose, among those with the fewest pages
};

std::vector<Order> Packer::simple_orders() const {
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
std::size_t Packer::splits(const Arrangement& a) const {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    seen.emplace(task_.group[i], a.places[i].page);
  }
  return seen.size();
}

std::size_t Packer::lonely_pages(const Arrangement& a) const {
  const auto count = std::count_if(a.used.begin(), a.used.end(),
                                   [&](double used) { return used < lonely_fill * fill_.page_area(); });
  return a.used.size() > 1 ? static_cast<std::size_t>(count) : 0;
}

Merit Packer::merit(const Arrangement& a) const {
  Merit merit{a.used.size(), 0.0, splits(a), 0.0};
  for (const double used : a.used) {
    const double share = used / fill_.page_area();
    merit.exact_evenness += 1.0 - share * share;
  }
  merit.evenness = std::round(merit.exact_evenness / same_use);
  return merit;
}

void Packer::offer(const Arrangement& candidate) {
  if (shown_.empty() || merit(candidate) < merit(shown_)) {
    shown_ = candidate;
  }
  if (best_.empty() || candidate.packs_better(best_)) {
    best_ = candidate;
  }
}

void Packer::start() {
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
      if (fill_.work() > work_limit_ && tried > 0) {
        break;
      }
    }
    if (++tried >= 2 && fill_.work() > work_limit_) {
      return;
    }
  }
}

/// A few shapes earlier or later, and turned.
Recipe Packer::changed(Recipe recipe, const Arrangement& at) {
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
Arrangement Packer::refilled(const Arrangement& at) {
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

void Packer::walk() {
  const std::size_t fewest = fill_.fewest_pages();
  const std::uint64_t limit = fill_.work() + work_limit_;
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
      recipe = by_order ? std::move(next) : std::move(recipe);
      current = std::move(candidate);
    }
  }
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
  // Shapes of the same groups first, then those of the nearest groups, large ones before small ones.
  const auto distance = [&](std::uint32_t shape) {
    std::uint32_t nearest = UINT32_MAX;
    for (const std::uint32_t group : groups) {
      nearest = std::min(
          nearest, group > task_.group[shape] ? group - task_.group[shape] : task_.group[shape] - group);
    }
    return nearest;
  };
  Order order(a.places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto p, auto q) {
    return distance(p) != distance(q) ? distance(p) < distance(q)
                                      : task_.shapes[p].area > task_.shapes[q].area;
  });
  for (const std::uint32_t shape : order) {
    const double area = task_.shapes[shape].area;
    const std::uint32_t from = a.places[shape].page;
    if (a.used[lonely] < shared_fill * fill_.page_area() && from != lonely &&
        a.used[from] - area >= a.used[lonely] + area) {
      static_cast<void>(fill_.move(a, shape, lonely));
    }
  }
}

/// Pages in the order of the groups on them, but one that is much emptier than all others last.
void Packer::order_pages(Arrangement& a) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> first;  // lowest group, page
  for (std::uint32_t page = 0; page < a.used.size(); ++page) {
    first.emplace_back(UINT32_MAX, page);
  }
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    auto& group = first[a.places[i].page].first;
    group = std::min(group, task_.group[i]);
  }
  std::vector<double> used = a.used;
  std::sort(used.begin(), used.end());
  if (used.size() > 1 && used[0] < emptier * used[1]) {
    const auto emptiest = std::min_element(a.used.begin(), a.used.end()) - a.used.begin();
    first[static_cast<std::size_t>(emptiest)].first = UINT32_MAX;
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

void Packer::run() {
  start();
  walk();
  share_with_lonely_page(shown_);
  order_pages(shown_);
}

std::vector<Packed> Packer::result() const {
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

/// A page of which the right side was the lower one, turned back.
std::vector<Packed> turned_back(std::vector<Packed> packed, Vec2 area) {
  for (Packed& p : packed) {
    p.turn = {-p.turn.sine, p.turn.cosine};
    p.shift = perpendicular(p.shift) + Vec2{area.x, 0.0};
  }
  return packed;
}

}  // namespace

std::vector<Packed> pack(const PackingTask& task, const Context& context) {
  if (task.shapes.empty()) {
    return {};
  }
  PackingTask sideways = task;
  std::swap(sideways.area.x, sideways.area.y);
  std::vector<Packed> best;
  Merit least;
  for (const Search& search : searches_for(task.shapes.size())) {
    Packer packer(search.sideways ? sideways : task, search, context);
    packer.run();
    if (packer.merit() < least) {
      least = packer.merit();
      best = search.sideways ? turned_back(packer.result(), task.area) : packer.result();
    }
    if (packer.is_least() || context.out_of_time()) {
      break;
    }
  }
  return best;
}

}  // namespace ridgecraft::paper
