// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/folding_meetings.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/random.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/overlap_pairs.hpp"

namespace ridgecraft::unfold {
namespace {

/// Centres of balls are kept in single precision, and balls made larger by this to make up for it, mm.
constexpr double ball_give_mm = 1e-3;

Vec3 in_space(Vec2 p) {
  return {p.x, p.y, 0.0};
}

}  // namespace

FoldingMeetings::FoldingMeetings(const Patch& patch) : patch_(patch) {
  static_assert(samples < 64, "near() has a bit for each");
  find_plates();
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    Samples<Motion>& hinge = hinge_.emplace_back();
    if (patch.twin[side] == nothing) {
      continue;
    }
    const Triangle& corners = patch.shape[side / 3];
    const Vec2 start = corners[side % 3];
    const Vec2 along = corners[(side % 3 + 1) % 3] - start;
    const Rigid& flat = patch.across[side];
    Motion laid;
    laid.rows = {Vec3{flat.cosine, -flat.sine, 0.0}, Vec3{flat.sine, flat.cosine, 0.0}, Vec3{0.0, 0.0, 1.0}};
    laid.shift = in_space(flat.shift);
    for (std::size_t t = 0; t < samples; ++t) {
      const double share = static_cast<double>(t + 1) / samples_of_motion;
      hinge[t] = turn_about(start, along / length(along), -share * patch.fold_angle[side]) * laid;
    }
  }
  for (const Triangle& shape : patch.shape) {
    Corners corners{in_space(shape[0]), in_space(shape[1]), in_space(shape[2])};
    const bool left = without_seam(corners, corners);
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    double radius = 0.0;
    for (const Vec3 p : corners) {
      radius = std::max(radius, length(p - centre));
    }
    rest_.push_back(corners);
    radius_.push_back(left ? static_cast<float>(radius + ball_give_mm) : -1.0F);
  }
  frame_.resize(patch.size());
  solid_.resize(patch.size());
  centres_.resize(patch.size());
  moves_.assign(patch.size(), 0);
}

void FoldingMeetings::find_plates() {
  DisjointSets sets(patch_.size());
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    if (patch_.frozen[side] != 0 && std::abs(patch_.fold_angle[side]) < flat_fold) {
      sets.join(side / 3, patch_.twin[side] / 3);
    }
  }
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    plate_.push_back(sets.find(f));
  }
}

void FoldingMeetings::count(const Folds& tree) {
  if (!knows_always_) {
    find_always(tree);
  }
  place_all(tree);
  pairs_.clear();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hinged;
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    if (tree[side] != 0) {
      hinged.emplace_back(plate_[side / 3], plate_[patch_.twin[side] / 3]);
    }
  }
  std::sort(hinged.begin(), hinged.end());
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    for (std::uint32_t g = f + 1; g < patch_.size(); ++g) {
      const std::uint64_t looks = near(f, centres_[f], g);
      if (looks != 0 && plate_[f] != plate_[g] && !always(f, g) &&
          !std::binary_search(hinged.begin(), hinged.end(), std::pair(plate_[f], plate_[g])) &&
          meets(f, nullptr, g, looks)) {
        pairs_.emplace_back(f, g);
      }
    }
  }
}

/// The folded piece is the same whatever its tree.
void FoldingMeetings::find_always(const Folds& tree) {
  const FoldMotion motion(flat_piece(patch_, tree));
  always_ = FoldTrial(motion, {}).always();
  knows_always_ = true;
}

void FoldingMeetings::place_all(const Folds& tree) {
  std::vector<std::uint8_t> placed(patch_.size(), 0);
  std::vector<std::uint32_t> open{0};
  frame_[0] = {};
  placed[0] = 1;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::uint32_t f = open[i];
    settle(f);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const std::uint32_t g = tree[side] != 0 ? patch_.twin[side] / 3 : f;
      if (placed[g] == 0) {
        placed[g] = 1;
        for (std::size_t t = 0; t < samples; ++t) {
          frame_[g][t] = frame_[f][t] * hinge_[side][t];
        }
        open.push_back(g);
      }
    }
  }
}

/// What follows from the frame of a face.
void FoldingMeetings::settle(std::uint32_t face) {
  for (std::size_t t = 0; t < samples; ++t) {
    Corners& corners = solid_[face][t];
    std::transform(rest_[face].begin(), rest_[face].end(), corners.begin(), frame_[face][t]);
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    centres_[face].x[t] = static_cast<float>(centre.x);
    centres_[face].y[t] = static_cast<float>(centre.y);
    centres_[face].z[t] = static_cast<float>(centre.z);
  }
}

bool FoldingMeetings::always(std::uint32_t f, std::uint32_t g) const {
  return !always_.empty() && std::binary_search(always_.begin(), always_.end(),
                                                std::pair<std::uint32_t, std::uint32_t>(std::minmax(f, g)));
}

/// In which samples the balls around two faces touch, as bits; the first face's centres are given.
std::uint64_t FoldingMeetings::near(std::uint32_t f, const Centres& centres_of_f, std::uint32_t g) const {
  if (radius_[f] < 0.0F || radius_[g] < 0.0F) {
    return 0;
  }
  const Centres& other = centres_[g];
  const float reach = radius_[f] + radius_[g];
  const float most = reach * reach;
  Samples<float> apart;
  for (std::size_t t = 0; t < samples; ++t) {
    const float x = centres_of_f.x[t] - other.x[t];
    const float y = centres_of_f.y[t] - other.y[t];
    const float z = centres_of_f.z[t] - other.z[t];
    apart[t] = x * x + y * y + z * z - most;
  }
  float least = apart[0];
  for (std::size_t t = 1; t < samples; ++t) {
    least = std::min(least, apart[t]);
  }
  std::uint64_t looks = 0;
  for (std::size_t t = 0; least <= 0.0F && t < samples; ++t) {
    looks |= apart[t] <= 0.0F ? std::uint64_t{1} << t : 0;
  }
  return looks;
}

/// Whether two faces meet in one of these samples, the first one moved, if by anything.
bool FoldingMeetings::meets(std::uint32_t f, const Samples<Motion>* motion, std::uint32_t g,
                            std::uint64_t near) const {
  for (std::uint64_t looks = near; looks != 0; looks &= looks - 1) {
    const auto t = static_cast<std::size_t>(std::countr_zero(looks));
    Corners corners = solid_[f][t];
    if (motion != nullptr) {
      std::transform(corners.begin(), corners.end(), corners.begin(), (*motion)[t]);
    }
    if (meet(corners, solid_[g][t])) {
      return true;
    }
  }
  return false;
}

/// How what a swap moves moves, in every sample.
FoldingMeetings::Samples<Motion> FoldingMeetings::motions(std::uint32_t side) {
  new_fold_ = moves_[side / 3] != 0 ? patch_.twin[side] : side;
  const std::uint32_t inside = patch_.twin[new_fold_];
  Samples<Motion> motion;
  for (std::size_t t = 0; t < samples; ++t) {
    motion[t] = frame_[new_fold_ / 3][t] * hinge_[new_fold_][t] * frame_[inside / 3][t].inverse();
  }
  return motion;
}

/// The pairs that a swap makes meet, no more than `limit`.
void FoldingMeetings::find_made(std::uint32_t side, std::size_t limit) {
  made_.clear();
  motion_ = motions(side);
  const std::uint32_t hinged_f = plate_[side / 3];
  const std::uint32_t hinged_g = plate_[patch_.twin[side] / 3];
  const auto hinged = [&](std::uint32_t f, std::uint32_t g) {
    return (plate_[f] == hinged_f && plate_[g] == hinged_g) ||
           (plate_[f] == hinged_g && plate_[g] == hinged_f);
  };
  for (const std::uint32_t f : moved_) {
    Centres centres;
    for (std::size_t t = 0; t < samples; ++t) {
      const Vec3 centre =
          motion_[t](Vec3{static_cast<double>(centres_[f].x[t]), static_cast<double>(centres_[f].y[t]),
                          static_cast<double>(centres_[f].z[t])});
      centres.x[t] = static_cast<float>(centre.x);
      centres.y[t] = static_cast<float>(centre.y);
      centres.z[t] = static_cast<float>(centre.z);
    }
    for (std::uint32_t g = 0; g < patch_.size(); ++g) {
      const std::uint64_t looks = moves_[g] != 0 ? 0 : near(f, centres, g);
      if (looks != 0 && !hinged(f, g) && !always(f, g) && meets(f, &motion_, g, looks)) {
        made_.push_back(std::minmax(f, g));
        if (made_.size() >= limit) {
          return;
        }
      }
    }
  }
}

std::size_t FoldingMeetings::after(std::span<const std::uint32_t> moved, std::uint32_t side,
                                   std::size_t limit) {
  for (const std::uint32_t f : moved_) {
    moves_[f] = 0;
  }
  moved_.assign(moved.begin(), moved.end());
  for (const std::uint32_t f : moved_) {
    moves_[f] = 1;
  }
  const auto lost = static_cast<std::size_t>(
      std::count_if(pairs_.begin(), pairs_.end(), [&](const auto& pair) { return is_across(pair); }));
  const std::size_t kept = pairs_.size() - lost;
  if (kept >= limit) {
    return limit;
  }
  find_made(side, limit - kept);
  return kept + made_.size();
}

void FoldingMeetings::keep(const Folds& tree) {
  pairs_.erase(
      std::remove_if(pairs_.begin(), pairs_.end(), [&](const auto& pair) { return is_across(pair); }),
      pairs_.end());
  pairs_.insert(pairs_.end(), made_.begin(), made_.end());
  // From face to face along the folds within what moved, which the swap leaves as they are. Moving each frame
  // by motion_ would double its error with every swap.
  place_beyond(new_fold_);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const std::uint32_t above = open_[i];
    const std::uint32_t f = patch_.twin[above] / 3;
    settle(f);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (side != patch_.twin[above] && tree[side] != 0 && moves_[patch_.twin[side] / 3] != 0) {
        place_beyond(side);
      }
    }
  }
  open_.clear();
}

/// Places the face beyond a fold, and notes it.
void FoldingMeetings::place_beyond(std::uint32_t fold) {
  const std::uint32_t f = fold / 3;
  const std::uint32_t g = patch_.twin[fold] / 3;
  for (std::size_t t = 0; t < samples; ++t) {
    frame_[g][t] = frame_[f][t] * hinge_[fold][t];
  }
  open_.push_back(fold);
}

namespace {

/// Swaps that are drawn on one walk: most that arrive do so within a hundred.
constexpr std::size_t draws_per_walk = 1500;
/// Draws of all walks times the faces of the piece, since one takes longer the larger the piece is, and at
/// most: about 0.02 s.
constexpr std::size_t draws_times_faces = 200'000;
constexpr std::size_t most_draws = 6000;
/// Walks that arrive, and how many of the trees that they come to, those with the shortest cuts, are looked
/// at closely: that takes longer than the walk.
constexpr std::size_t most_arrivals = 16;
constexpr std::size_t looked_at = 4;
/// Larger pieces aren't tried: too many of their faces meet.
constexpr std::size_t most_faces = 1000;
/// Nor are such with more pairs that meet for each face: of those that walks freed none had half of it.
constexpr std::size_t most_meetings_per_face = 1;
/// A swap that costs d more is made with probability exp(-d / heat).
constexpr double heat = 0.35;
/// What a pair that meets on the way or overlaps is worth, in mm of cut.
constexpr double pair_mm = 60.0;
/// Draws between two looks at the clock.
constexpr std::size_t draws_per_look = 64;

/// Walks from tree to tree until there is neither meeting nor overlap; both are counted alike.
class FreeFolding {
 public:
  FreeFolding(const Patch& piece, const Folds& tree, double tolerance, std::uint64_t seed,
              const Context& context)
      : piece_(piece),
        tree_(tree),
        context_(context),
        random_(seed),
        branch_(piece),
        net_(piece),
        overlaps_(net_, tolerance),
        meetings_(piece) {}

  /// Whether so few faces of the given tree meet that a walk may arrive.
  [[nodiscard]] bool may_arrive() {
    net_.set_tree(tree_);
    meetings_.count(net_.folds());
    return meetings_.total() <= most_meetings_per_face * piece_.size();
  }

  /// Goes from the given tree to one without any; false where the draws are spent before, or the time.
  bool walk(std::size_t draws) {
    net_.set_tree(tree_);
    overlaps_.find_all();
    meetings_.count(net_.folds());
    longer_mm_ = 0.0;
    for (drawn_ = 0; drawn_ < draws && !done(); ++drawn_) {
      if (drawn_ % draws_per_look == 0) {
        context_.check();
        if (context_.out_of_time()) {
          break;
        }
      }
      step();
    }
    return done();
  }

  [[nodiscard]] const Folds& folds() const { return net_.folds(); }
  /// Of the last walk: swaps drawn, and by how much it made the cuts longer.
  [[nodiscard]] std::size_t drawn() const { return drawn_; }
  [[nodiscard]] double longer_mm() const { return longer_mm_; }

 private:
  [[nodiscard]] bool done() const { return meetings_.total() + overlaps_.total() == 0; }

  std::pair<std::uint32_t, std::uint32_t> draw_pair() {
    const std::uint32_t overlaps = static_cast<std::uint32_t>(overlaps_.total());
    const std::uint32_t meetings = static_cast<std::uint32_t>(meetings_.total());
    if (random_.below(overlaps + meetings) < meetings) {
      return draw(meetings_.pairs(), random_);
    }
    const std::uint32_t f = draw(overlaps_.bad_faces(), random_);
    return {f, draw(overlaps_.met_by(f), random_)};
  }

  void step() {
    const auto [f, g] = draw_pair();
    const std::optional<Swap> swap = draw_swap_between(f, g, net_, branch_, random_);
    if (!swap) {
      return;
    }
    const double longer = piece_.length[net_.side_above(swap->below)] - piece_.length[swap->side];
    const double may_cost = -heat * elementary::log(1.0 - random_.unit()) - longer / pair_mm;
    const auto met = static_cast<std::int64_t>(meetings_.total());
    // So many pairs may be left; overlaps are counted first, since that is quicker.
    const auto most = met + static_cast<std::int64_t>(std::floor(may_cost));
    const std::int64_t left = most - overlaps_.added(swap->below, swap->side, most + 1);
    if (left < 0) {
      return;
    }
    const std::size_t limit = static_cast<std::size_t>(left) + 1;
    const RootedNet::Span half = net_.moved_span(swap->below);
    moved_.clear();
    for (std::uint32_t i = 0; i < half.count; ++i) {
      moved_.push_back(net_.face_in(half, i));
    }
    if (meetings_.after(moved_, swap->side, limit) < limit) {
      overlaps_.swap(swap->below, swap->side);
      meetings_.keep(net_.folds());
      longer_mm_ += longer;
    }
  }

  const Patch& piece_;
  const Folds& tree_;
  const Context& context_;
  Random random_;
  Branch branch_;
  RootedNet net_;
  OverlapPairs overlaps_;
  FoldingMeetings meetings_;
  std::vector<std::uint32_t> moved_;  ///< space to work in
  std::size_t drawn_ = 0;
  double longer_mm_ = 0.0;
};

/// Trees that fold together, the one with the shortest cuts first.
std::vector<Folds> trees_that_fold(const Patch& piece, const Folds& given, double tolerance,
                                   std::uint64_t seed, const Context& context) {
  FreeFolding search(piece, given, tolerance, seed, context);
  std::vector<std::pair<double, Folds>> found;
  std::size_t draws = search.may_arrive() ? std::min(most_draws, draws_times_faces / piece.size()) : 0;
  while (draws > 0 && found.size() < most_arrivals && !context.out_of_time()) {
    if (search.walk(std::min(draws, draws_per_walk))) {
      found.emplace_back(search.longer_mm(), search.folds());
    }
    draws -= std::min(draws, search.drawn());
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Folds> trees;
  for (auto& [longer, tree] : found) {
    if (std::find(trees.begin(), trees.end(), tree) == trees.end()) {
      trees.push_back(std::move(tree));
    }
  }
  return trees;
}

}  // namespace

bool folds_together(const Patch& piece, const Folds& tree, const Context& context) {
  const FoldMotion motion(flat_piece(piece, tree));
  return FoldTrial(motion, context).together_works();
}

std::optional<Folds> fold_freely(const Patch& piece, const Folds& given, const FreeFoldingRules& rules,
                                 std::uint64_t seed, const Context& context) {
  if (piece.size() > most_faces || folds_together(piece, given, context)) {
    return std::nullopt;
  }
  std::vector<Folds> trees = trees_that_fold(piece, given, rules.tolerance, seed, context);
  trees.resize(std::min(trees.size(), looked_at));
  double least = rules.cost(given).value_or(std::numeric_limits<double>::infinity()) + rules.worth;
  std::optional<Folds> best;
  for (Folds& tree : trees) {
    const std::optional<double> costs = rules.cost(tree);
    if (costs && *costs <= least && find_overlaps(lay_out(piece, tree), rules.tolerance).empty() &&
        folds_together(piece, tree, context)) {
      least = *costs;
      best = std::move(tree);
    }
  }
  return best;
}

}  // namespace ridgecraft::unfold
