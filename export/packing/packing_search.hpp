// SPDX-License-Identifier: GPL-3.0-or-later
// The search over arrangements: simple orders first, then a random walk that accepts what is not worse (over
// orders, or by emptying two pages and filling them again), then the attempt to do with a page less by moving
// shapes apart. Of all that it meets, people get the fewest pages, then the fullest ones, then groups that
// stay together.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "export/packing/packing_fill.hpp"
#include "export/packing/packing_task.hpp"

namespace ridgecraft::paper {

/// What people would choose by, the most important first; smaller is better.
struct PackingMerit {
  std::size_t pages = SIZE_MAX;
  double evenness = 0.0;  ///< pages less the sum of their squared use: full pages and one that is nearly
                          ///< empty are better than all of them half full; in steps of same_use
  std::size_t splits = 0;
  double exact_evenness = 0.0;

  friend auto operator<=>(const PackingMerit&, const PackingMerit&) = default;
};

/// One search. The task and the context must outlive it.
class PackingSearch {
 public:
  PackingSearch(const PackingTask& task, const PackingDetail& detail, const Context& context)
      : task_(task), context_(context), fill_(task, detail, context), random_(context.seed) {}
  /// The best arrangement that a fixed amount of work finds.
  [[nodiscard]] std::vector<Packed> run();
  /// Pages after the simple orders and one attempt with a page less.
  [[nodiscard]] std::size_t rough_page_count();
  /// What the simple orders find, if that is one page.
  [[nodiscard]] std::vector<Packed> run_for_one_page();

 private:
  using Order = std::vector<std::uint32_t>;
  [[nodiscard]] std::vector<Order> simple_orders() const;
  void start();
  void walk();
  [[nodiscard]] std::vector<Packed> result() const;
  [[nodiscard]] Recipe changed(Recipe recipe, const Arrangement& at);
  [[nodiscard]] Arrangement refilled(const Arrangement& at);
  bool separate();
  void offer(const Arrangement& candidate);
  [[nodiscard]] PackingMerit merit(const Arrangement& a) const;
  [[nodiscard]] std::size_t splits(const Arrangement& a) const;

  const PackingTask& task_;
  const Context& context_;
  PackingFill fill_;
  Random random_;
  Recipe recipe_;      ///< of best_, after start()
  Arrangement best_;   ///< as the search counts
  Arrangement shown_;  ///< as people would choose, among those with the fewest pages
};

}  // namespace ridgecraft::paper
