// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/net_search.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// The panel of one of its faces; `taken` has a flag for each face.
Plate plate_at(const Patch& patch, std::uint32_t first, std::vector<std::uint8_t>& taken) {
  Plate plate;
  plate.faces.push_back(first);
  plate.place.emplace_back();
  taken[first] = 1;
  for (std::size_t i = 0; i < plate.faces.size(); ++i) {
    const std::uint32_t f = plate.faces[i];
    const Rigid at = plate.place[i];
    const Triangle& shape = patch.shape[f];
    const Triangle laid{at(shape[0]), at(shape[1]), at(shape[2])};
    plate.flat.push_back(edged(laid));
    plate.circle.push_back(smallest_circle(laid[0], laid[1], laid[2]));
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (patch.frozen[side] != 0 && taken[patch.twin[side] / 3] == 0) {
        taken[patch.twin[side] / 3] = 1;
        plate.faces.push_back(patch.twin[side] / 3);
        plate.place.push_back(at * patch.across[side]);
      }
    }
  }
  return plate;
}

}  // namespace

std::vector<Plate> plates_of(const Patch& patch) {
  std::vector<Plate> plates;
  std::vector<std::uint8_t> taken(patch.size(), 0);
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    if (taken[f] == 0) {
      plates.push_back(plate_at(patch, f, taken));
    }
  }
  return plates;
}

std::vector<Arc> arcs_between(const Patch& patch, const std::vector<Plate>& plates) {
  std::vector<std::uint32_t> plate_of(patch.size(), 0);
  std::vector<Rigid> place(patch.size());
  for (std::uint32_t p = 0; p < plates.size(); ++p) {
    for (std::size_t i = 0; i < plates[p].faces.size(); ++i) {
      plate_of[plates[p].faces[i]] = p;
      place[plates[p].faces[i]] = plates[p].place[i];
    }
  }
  std::vector<Arc> arcs;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != nothing && side < twin && plate_of[side / 3] != plate_of[twin / 3]) {
      arcs.push_back({side, plate_of[side / 3], plate_of[twin / 3],
                      place[side / 3] * patch.across[side] * place[twin / 3].inverse()});
    }
  }
  return arcs;
}

Folds folds_of_plates(const Patch& patch, const std::vector<Plate>& plates) {
  Folds folds(patch.twin.size(), 0);
  DisjointSets sets(patch.size());
  for (const Plate& plate : plates) {
    for (const std::uint32_t f : plate.faces) {
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (patch.frozen[side] != 0 && sets.join(f, patch.twin[side] / 3)) {
          set_fold(patch, folds, side, true);
        }
      }
    }
  }
  return folds;
}

namespace {

constexpr std::array kinds{StartTree::short_cuts, StartTree::depth_first, StartTree::breadth_first,
                           StartTree::flat_folds};

StartTree kind_of_start(StartTree first, int start) {
  const auto at = static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), first) - kinds.begin());
  return kinds[(at + static_cast<std::size_t>(start)) % kinds.size()];
}

/// Searches from several start trees. Most nets are found by the first within a few thousand iterations, but
/// some of its runs take a hundred times as long as others of the same patch; so after a while a second
/// search goes on beside it in turns, then a third: the tail of a sum of tails is short (M. Luby, A.
/// Sinclair, D. Zuckerman, 1993).
///
/// In each round every search makes the same number of iterations, and the first in order that finds a net in
/// it has won: the same one whether they take turns or run at the same time.
class Race {
 public:
  Race(const Patch& patch, const NetSearch& options, std::uint64_t seed, const Context& context)
      : patch_(patch), options_(options), seed_(seed), context_(context) {
    idle_ = options.idle > 0 ? options.idle : idle_iterations(patch.size());
  }

  NetFound run() {
    while (!finished()) {
      join();
      round();
    }
    NetFound found;
    found.overlaps = std::numeric_limits<std::uint64_t>::max();
    found.starts = static_cast<int>(runners_.size());
    found.iterations = iterations_;
    found.hopeless = std::all_of(runners_.begin(), runners_.end(),
                                 [](const Runner& runner) { return runner.search->hopeless(); });
    for (const Runner& runner : runners_) {
      if (runner.overlaps < found.overlaps) {
        found.overlaps = runner.overlaps;
        found.folds = runner.search->best_folds();
      }
    }
    return found;
  }

 private:
  struct Runner {
    std::unique_ptr<TreeSearch> search;
    std::uint64_t counted = 0;  ///< iterations when the last round began
    std::uint64_t overlaps = std::numeric_limits<std::uint64_t>::max();  ///< of its best tree
    bool running = true;
  };

  [[nodiscard]] bool finished() const {
    if (runners_.empty()) {
      return false;
    }
    const bool all_stopped =
        std::none_of(runners_.begin(), runners_.end(), [](const Runner& r) { return r.running; });
    const bool all_started = runners_.size() >= static_cast<std::size_t>(options_.starts);
    return won_ || (all_stopped && all_started) || given_up() || iterations_ >= options_.iterations ||
           context_.out_of_time();
  }

  /// Whether a start has come to its end far from a net: then others would, too.
  [[nodiscard]] bool given_up() const {
    return std::any_of(runners_.begin(), runners_.end(),
                       [](const Runner& r) { return !r.running && r.search->hopeless(); });
  }

  void join() {
    if (runners_.size() >= static_cast<std::size_t>(options_.starts)) {
      return;
    }
    const int number = static_cast<int>(runners_.size());
    Random random(seed_ + std::uint64_t{0x9e3779b97f4a7c15} * static_cast<std::uint64_t>(number));
    Runner& runner = runners_.emplace_back();
    runner.search = std::make_unique<TreeSearch>(patch_, options_.tolerance, random.next());
    runner.search->set_tree(start_tree(patch_, kind_of_start(options_.start, number), random));
  }

  void round() {
    const std::uint64_t n = patch_.size();
    const std::uint64_t slice =
        runners_.size() == 1 ? std::max<std::uint64_t>(n, 500) : std::max<std::uint64_t>(n / 2, 250);
    const std::uint64_t left = options_.iterations - std::min(options_.iterations, iterations_);
    std::atomic<std::size_t> winner{runners_.size()};
    do_in_parallel(runners_.size(), context_, [&](std::size_t i, const Context&) {
      // Those behind a winner needn't run; who is before it may still win instead.
      if (i < winner && runners_[i].running && advance(runners_[i], std::min(slice, left))) {
        for (std::size_t best = winner; i < best && !winner.compare_exchange_weak(best, i);) {
        }
      }
    });
    settle(winner);
  }

  /// What those behind the winner did in this round doesn't count: alone, they wouldn't have had their turn.
  void settle(std::size_t winner) {
    for (std::size_t i = 0; i < runners_.size(); ++i) {
      Runner& runner = runners_[i];
      if (i > winner) {
        runner.overlaps = std::numeric_limits<std::uint64_t>::max();
        continue;
      }
      iterations_ += runner.search->iterations() - runner.counted;
      runner.counted = runner.search->iterations();
    }
    won_ = winner < runners_.size();
  }

  /// Some iterations of one search; true when they found a net.
  bool advance(Runner& runner, std::uint64_t slice) {
    TreeSearch& search = *runner.search;
    const std::uint64_t begin = search.iterations();
    search.run({slice, idle_}, context_);
    runner.overlaps = search.best_overlaps();
    if (runner.overlaps == 0) {
      // The search counts by small steps; only a fresh layout and another routine may call a net clean.
      runner.overlaps = find_overlaps(lay_out(patch_, search.best_folds()), options_.tolerance).size();
      runner.running = false;
      return runner.overlaps == 0;
    }
    runner.running = search.iterations() - begin == slice;
    return false;
  }

  const Patch& patch_;
  const NetSearch& options_;
  const std::uint64_t seed_;
  const Context& context_;
  std::uint64_t idle_ = 0;
  std::vector<Runner> runners_;
  std::uint64_t iterations_ = 0;
  bool won_ = false;
};

}  // namespace

std::uint64_t idle_iterations(std::uint32_t faces) {
  // Solved nets need about half an iteration per face. Spiky solids need many more, but another search finds
  // theirs sooner (heated_search.hpp); hopeless small parts are common and must not hold up the rest.
  return std::max<std::uint64_t>(500, 4 * std::uint64_t{faces});
}

std::uint64_t iteration_budget(std::uint32_t faces) {
  // An iteration takes longer the larger the patch is: very large ones get their share of about a minute.
  constexpr std::uint64_t faces_times_iterations = 400'000'000;
  const std::uint64_t affordable = faces_times_iterations / std::max(faces, 1U);
  return std::min(4 * idle_iterations(faces), affordable);
}

NetFound find_net(const Patch& patch, const NetSearch& options, std::uint64_t seed, const Context& context) {
  return Race(patch, options, seed, context).run();
}

namespace {

/// Compact trees first: they are most likely to fit.
constexpr std::array start_kinds{StartTree::short_cuts, StartTree::breadth_first, StartTree::flat_folds,
                                 StartTree::breadth_first, StartTree::depth_first};
constexpr std::uint64_t least_iterations = 600;
/// After so many hopeless starts the others aren't tried.
constexpr int hopeless_starts = 2;

}  // namespace

OnePieceFound find_one_piece(const Patch& patch, const Room& room, const OnePieceSearch& search,
                             std::uint64_t seed, const Context& context) {
  OnePieceFound result;
  if (least_pieces(patch, room) > 1) {
    return result;
  }
  Random random(seed);
  NetSearch options;
  options.tolerance = search.tolerance;
  options.starts = 1;
  options.iterations = least_iterations + search.iterations_per_face * patch.size();
  options.idle = options.iterations;
  int hopeless = 0;  // starts that were
  for (int start = 0; start < search.starts && hopeless < hopeless_starts && !context.out_of_time();
       ++start) {
    context.check();
    options.start = start_kinds[static_cast<std::size_t>(start) % start_kinds.size()];
    NetFound found = find_net(patch, options, random.next(), context);
    result.cost += found.iterations * patch.size();
    hopeless += found.hopeless ? 1 : 0;
    if (found.overlaps == 0 && all_fit(patch, found.folds, room)) {
      result.tree = std::move(found.folds);
      return result;
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
