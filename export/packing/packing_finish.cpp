// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_finish.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace ridgecraft::paper {
namespace {

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

}  // namespace

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

}  // namespace ridgecraft::paper
