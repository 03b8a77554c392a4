// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/opening.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/random.hpp"

namespace ridgecraft::unfold {
namespace {

/// Attempts, and the work of all of them (FoldTrial::work): about 0.2 s.
constexpr int most_attempts = 60;
constexpr std::uint64_t most_work = 20'000'000;

/// Opens the piece as far as it goes when creases are tried in one order of preference.
class Attempt {
 public:
  Attempt(const FoldMotion& motion, FoldTrial& trial) : motion_(motion), trial_(trial) {}

  /// `may_go_on` is asked before each crease.
  template <class MayGoOn>
  Opening run(const std::vector<std::uint32_t>& preference, MayGoOn may_go_on) {
    trial_.set_all(1.0);
    kept_by_.assign(preference.size(), {});
    Opening opening;
    std::vector<std::uint32_t> folded = preference;
    for (std::size_t i = 0; i < folded.size() && may_go_on();) {
      if (!is_free(folded[i])) {
        ++i;
        continue;
      }
      open(folded[i], opening);
      folded.erase(folded.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
    for (const std::uint32_t crease : folded) {
      if (const auto& pair = kept_by_[crease].pair) {
        opening.in_the_way = pair;
        break;
      }
    }
    return opening;
  }

 private:
  /// Two faces that keep a crease from going flat, as long as nothing between them moves.
  struct Obstacle {
    std::optional<FoldTrial::Pair> pair;
    bool holds = false;
  };

  bool is_free(std::uint32_t crease) {
    Obstacle& kept = kept_by_[crease];
    if (!kept.holds) {
      kept.pair = trial_.obstacle(crease, 0.0, kept.pair);
      kept.holds = kept.pair.has_value();
    }
    return !kept.pair;
  }

  void open(std::uint32_t crease, Opening& opening) {
    trial_.fold(crease, 0.0);
    opening.opened.push_back(crease);
    for (Obstacle& kept : kept_by_) {
      if (kept.pair && motion_.moves(crease, kept.pair->first) != motion_.moves(crease, kept.pair->second)) {
        kept.holds = false;
      }
    }
  }

  const FoldMotion& motion_;
  FoldTrial& trial_;
  std::vector<Obstacle> kept_by_;  ///< per crease
};

/// In which order creases are preferred: by how often they were stuck, then the outermost or the innermost
/// first, then as it comes.
class Preference {
 public:
  explicit Preference(const FoldMotion& motion) : motion_(motion), stuck_(motion.creases().size(), 0) {
    order_.resize(stuck_.size());
    std::iota(order_.begin(), order_.end(), 0U);
  }

  [[nodiscard]] const std::vector<std::uint32_t>& next(int attempt) {
    const auto& creases = motion_.creases();
    for (std::size_t i = order_.size(); attempt > 1 && i > 1; --i) {
      std::swap(order_[i - 1], order_[random_.below(static_cast<std::uint32_t>(i))]);
    }
    const bool outer_first = attempt % 2 == 0;
    const auto rank = [&](std::uint32_t c) {
      const int depth = static_cast<int>(creases[c].depth);
      return std::pair(-stuck_[c], attempt > 3 ? 0 : outer_first ? -depth : depth);
    };
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    return order_;
  }

  void was_stuck(const std::vector<std::uint32_t>& opened) {
    std::vector<std::uint8_t> open(stuck_.size(), 0);
    for (const std::uint32_t c : opened) {
      open[c] = 1;
    }
    for (std::size_t c = 0; c < stuck_.size(); ++c) {
      stuck_[c] += open[c] == 0 ? 1 : 0;
    }
  }

 private:
  const FoldMotion& motion_;
  std::vector<int> stuck_;  ///< per crease: attempts in which it was
  std::vector<std::uint32_t> order_;
  Random random_{1};  ///< pieces have no seeds of their own, and the same piece is to fold in the same order
};

}  // namespace

Opening open_piece(const FoldMotion& motion, FoldTrial& trial, const Context& context) {
  Attempt attempt(motion, trial);
  Preference preference(motion);
  Opening best;
  const std::uint64_t limit = trial.work() + most_work;
  const auto may_go_on = [&] { return trial.work() < limit && !context.out_of_time(); };
  for (int i = 0; i < most_attempts && may_go_on(); ++i) {
    Opening opening = attempt.run(preference.next(i), may_go_on);
    const bool impossible = opening.opened.empty();
    preference.was_stuck(opening.opened);
    if (i == 0 || opening.opened.size() > best.opened.size()) {
      best = std::move(opening);
    }
    if (impossible || best.opened.size() == motion.creases().size()) {
      break;
    }
  }
  return best;
}

}  // namespace ridgecraft::unfold
