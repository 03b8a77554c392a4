// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing_tighter.hpp"

#include <algorithm>
#include <cstddef>

#include "base/random.hpp"
#include "export/packing/packing_exact.hpp"

namespace ridgecraft::paper {
namespace {

/// Nobody has packed odd shapes more densely.
constexpr double densest_pages = 0.93;
/// Turns of each shape besides the one that it lies in. All of them need memory for each other shape's.
constexpr std::size_t turns_besides = 12;
/// Another beginning is tried when this share of the work is used up.
constexpr std::uint64_t beginnings = 4;

double needed_area(const PackingTask& task) {
  double sum = 0.0;
  for (const PackingShape& shape : task.shapes) {
    sum += shape.area;
  }
  return sum;
}

/// The page with the least paper on it.
std::uint32_t emptiest_page(const PackingTask& task, const std::vector<Packed>& packed, std::uint32_t pages) {
  std::vector<double> used(pages);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    used[packed[i].page] += task.shapes[i].area;
  }
  return static_cast<std::uint32_t>(std::min_element(used.begin(), used.end()) - used.begin());
}

class Tightening {
 public:
  Tightening(const PackingTask& task, const std::vector<Packed>& packed, const Context& context)
      : task_(task),
        random_(~context.seed),
        turns_(turns_for(task, packed)),
        separation_(task, turns_, random_, context) {}

  /// Without the emptiest page; whether that succeeded.
  bool save_page(std::uint32_t pages, std::uint64_t most_work, std::vector<Packed>& packed) {
    const std::uint32_t emptiest = emptiest_page(task_, packed, pages);
    for (std::uint64_t begin = 0; begin < beginnings; ++begin) {
      std::vector<ExactPlace> places = places_without(emptiest, pages, packed);
      separation_.forget();
      if (separation_.run(places, pages - 1, task_.area, most_work / beginnings)) {
        for (std::uint32_t i = 0; i < packed.size(); ++i) {
          const ExactPlace& place = places[i];
          packed[i] = {place.page, turns_[i][place.turn], place.at - separation_.low(i, place.turn)};
        }
        return true;
      }
    }
    return false;
  }

 private:
  static std::vector<std::vector<Turn>> turns_for(const PackingTask& task,
                                                  const std::vector<Packed>& packed) {
    std::vector<std::vector<Turn>> turns;
    for (std::size_t i = 0; i < packed.size(); ++i) {
      std::vector<Turn>& of_shape = turns.emplace_back(std::vector<Turn>{packed[i].turn});
      for (const Turn& turn : turns_to_try(task.shapes[i], task.area, turns_besides)) {
        of_shape.push_back(turn);
      }
    }
    return turns;
  }

  std::vector<ExactPlace> places_without(std::uint32_t removed, std::uint32_t pages,
                                         const std::vector<Packed>& packed) {
    std::vector<ExactPlace> places(packed.size());
    for (std::uint32_t i = 0; i < packed.size(); ++i) {
      ExactPlace& place = places[i];
      // Pages that were saved before have brought other turns than the first.
      while (turns_[i][place.turn].cosine != packed[i].turn.cosine ||
             turns_[i][place.turn].sine != packed[i].turn.sine) {
        ++place.turn;
      }
      place.at = packed[i].shift + separation_.low(i, place.turn);
      place.page = packed[i].page == removed  ? random_.below(pages - 1)
                   : packed[i].page > removed ? packed[i].page - 1
                                              : packed[i].page;
    }
    return places;
  }

  const PackingTask& task_;
  Random random_;
  std::vector<std::vector<Turn>> turns_;
  ExactSeparation separation_;
};

}  // namespace

bool pack_tighter(const PackingTask& task, std::uint64_t most_work, const Context& context,
                  std::vector<Packed>& packed) {
  std::uint32_t pages = 0;
  for (const Packed& p : packed) {
    pages = std::max(pages, p.page + 1);
  }
  const auto is_possible = [&] {
    return pages > 1 && needed_area(task) <= densest_pages * (pages - 1) * task.area.x * task.area.y;
  };
  if (most_work == 0 || !is_possible()) {
    return false;
  }
  Tightening tightening(task, packed, context);
  const std::uint32_t before = pages;
  while (is_possible() && !context.out_of_time() && tightening.save_page(pages, most_work, packed)) {
    --pages;
  }
  return pages < before;
}

}  // namespace ridgecraft::paper
