// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/fold_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/boxes.hpp"
#include "base/random.hpp"

namespace ridgecraft::unfold {
namespace {

/// Looks one after the other in this stride meet early what lies anywhere on the way: prime to the number of
/// samples, about a golden section of it.
constexpr int stride = 31;
static_assert(samples_of_motion % stride != 0 && stride % 5 != 0 && stride % 2 != 0);

/// Which look at a motion is the i-th, i from 0; shares of the way beyond 0.
double share_of_way(int i) {
  return static_cast<double>((i * stride + stride - 1) % samples_of_motion + 1) / samples_of_motion;
}

/// Steps of work for looking at a pair once.
constexpr std::uint64_t work_of_look = 2;

}  // namespace

FoldTrial::FoldTrial(const FoldMotion& motion, const Context& context)
    : motion_(motion), context_(context), solids_(motion.face_count()) {
  set_all(1.0);
  always_ = meetings(false);
  set_all(0.0);
}

bool FoldTrial::together_works() {
  bool works = true;
  for (int i = 0; i < samples_of_motion && works; ++i) {
    const double share = share_of_way(i);
    if (share < 1.0) {
      set_all(share);
      works = meetings(true).empty();
    }
  }
  set_all(0.0);
  return works;
}

bool FoldTrial::order_works(std::span<const std::uint32_t> order) {
  set_all(0.0);
  return std::all_of(order.begin(), order.end(), [&](std::uint32_t crease) {
    if (context_.out_of_time() || obstacle(crease, 1.0)) {
      return false;
    }
    fold(crease, 1.0);
    return true;
  });
}

void FoldTrial::set_all(double share) {
  context_.check();
  motion_.pose(std::vector<double>(motion_.creases().size(), share), pose_);
  for (std::uint32_t f = 0; f < solids_.size(); ++f) {
    solids_[f] = solid(f);
  }
}

void FoldTrial::fold(std::uint32_t crease, double share) {
  motion_.fold(crease, share, pose_);
  for (const std::uint32_t f : motion_.faces_beyond(crease)) {
    solids_[f] = solid(f);
  }
}

std::optional<FoldTrial::Pair> FoldTrial::obstacle(std::uint32_t crease, double share,
                                                   std::optional<Pair> suspects) {
  context_.check();
  if (suspects) {
    candidates_.assign(1, *suspects);
    if (!motion_.moves(crease, suspects->first)) {
      std::swap(candidates_.front().first, candidates_.front().second);
    }
    if (const auto met = first_meeting(crease, share)) {
      return met;
    }
  }
  find_candidates(crease);
  return first_meeting(crease, share);
}

FoldTrial::Solid FoldTrial::solid(std::uint32_t face) const {
  Solid s;
  s.empty = !without_seam(pose_.corners[face], s.corners);
  if (!s.empty) {
    s.centre = (s.corners[0] + s.corners[1] + s.corners[2]) / 3.0;
    for (const Vec3 p : s.corners) {
      s.radius = std::max(s.radius, length(p - s.centre));
    }
  }
  return s;
}

FoldTrial::Ring FoldTrial::ring(std::uint32_t face, Vec3 on_line, Vec3 along) const {
  const Solid& s = solids_[face];
  const auto distance = [&](Vec3 p) { return length(cross(p - on_line, along)); };
  Ring ring;
  ring.face = face;
  ring.low = ring.high = dot(along, s.corners[0] - on_line);
  for (const Vec3 p : s.corners) {
    ring.low = std::min(ring.low, dot(along, p - on_line));
    ring.high = std::max(ring.high, dot(along, p - on_line));
    ring.outer = std::max(ring.outer, distance(p));
  }
  ring.inner = std::max(0.0, distance(s.centre) - s.radius);
  return ring;
}

/// Whether it matters that these faces meet.
bool FoldTrial::counts(std::uint32_t f, std::uint32_t g) const {
  const std::uint32_t p = motion_.plate(f);
  const std::uint32_t q = motion_.plate(g);
  return p != q && !motion_.hinged(p, q) &&
         !std::binary_search(always_.begin(), always_.end(), Pair(std::minmax(f, g)));
}

/// Pairs of faces that meet in the present pose, ascending; no more than one where any will do.
std::vector<FoldTrial::Pair> FoldTrial::meetings(bool any_will_do) {
  std::vector<std::uint32_t> face;
  std::vector<Box3> boxes;
  for (std::uint32_t f = 0; f < solids_.size(); ++f) {
    if (!solids_[f].empty) {
      face.push_back(f);
      Box3& box = boxes.emplace_back();
      for (const Vec3 p : solids_[f].corners) {
        box.add(p);
      }
    }
  }
  std::vector<Pair> found;
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    if ((!any_will_do || found.empty()) && counts(face[i], face[j]) &&
        meet(solids_[face[i]].corners, solids_[face[j]].corners)) {
      found.push_back(std::minmax(face[i], face[j]));
    }
  });
  std::sort(found.begin(), found.end());
  return found;
}

void FoldTrial::find_candidates(std::uint32_t crease) {
  const auto [on_line, along] = motion_.line_of(crease, pose_);
  moving_.clear();
  resting_.clear();
  for (std::uint32_t f = 0; f < solids_.size(); ++f) {
    if (!solids_[f].empty) {
      (motion_.moves(crease, f) ? moving_ : resting_).push_back(ring(f, on_line, along));
    }
  }
  candidates_.clear();
  for (const Ring& f : moving_) {
    for (const Ring& g : resting_) {
      const bool near = f.low <= g.high && g.low <= f.high && f.inner <= g.outer && g.inner <= f.outer;
      if (near && counts(f.face, g.face)) {
        candidates_.emplace_back(f.face, g.face);
      }
    }
  }
  work_ += solids_.size() * 4 + moving_.size() * resting_.size() / 4;
}

/// Of the candidates, on the way to this share.
std::optional<FoldTrial::Pair> FoldTrial::first_meeting(std::uint32_t crease, double share) {
  const double from = pose_.share[crease];
  for (int i = 0; i < samples_of_motion; ++i) {
    const Motion moved = motion_.beyond(crease, from + share_of_way(i) * (share - from), pose_);
    std::uint32_t face = no_index;
    Corners corners{};
    Vec3 centre;
    for (const auto& [f, g] : candidates_) {
      if (f != face) {
        face = f;
        centre = moved(solids_[f].centre);
        std::transform(solids_[f].corners.begin(), solids_[f].corners.end(), corners.begin(), moved);
      }
      const Vec3 between = solids_[g].centre - centre;
      const double reach = solids_[f].radius + solids_[g].radius;
      if (dot(between, between) <= reach * reach && meet(corners, solids_[g].corners)) {
        work_ += work_of_look * candidates_.size() * static_cast<std::uint64_t>(i + 1);
        return Pair(std::minmax(f, g));
      }
    }
  }
  work_ += work_of_look * candidates_.size() * samples_of_motion;
  return std::nullopt;
}

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

namespace {

/// Creases times faces that single creases are tried for: more takes seconds.
constexpr std::size_t most_single = 1'000'000;

}  // namespace

Folding find_folding(const FoldMotion& motion, FoldTrial& trial, const Context& context) {
  return trial.together_works() ? Folding{} : find_order(motion, trial, context);
}

Folding find_order(const FoldMotion& motion, FoldTrial& trial, const Context& context) {
  Folding result;
  const auto& creases = motion.creases();
  std::vector<std::uint32_t> outwards(creases.size());
  std::iota(outwards.begin(), outwards.end(), 0U);
  std::stable_sort(outwards.begin(), outwards.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return creases[a].depth < creases[b].depth; });
  result.order.assign(outwards.rbegin(), outwards.rend());
  result.way = FoldWay::with_care;
  if (creases.size() * motion.face_count() > most_single || context.out_of_time()) {
    return result;
  }
  if (trial.order_works(result.order)) {
    result.way = FoldWay::leaves_first;
  } else if (trial.order_works(outwards)) {
    result.way = FoldWay::middle_first;
    result.order = std::move(outwards);
  } else {
    const Opening opening = open_piece(motion, trial, context);
    if (opening.opened.size() == creases.size()) {
      std::vector<std::uint32_t> backwards(opening.opened.rbegin(), opening.opened.rend());
      // Where faces graze each other opening and folding may round differently.
      if (trial.order_works(backwards)) {
        result.way = FoldWay::in_order;
        result.order = std::move(backwards);
      }
    }
    result.in_the_way = opening.in_the_way;
  }
  return result;
}

FoldOrder find_fold_order(const mesh::Surface& surface, const Nets& nets, PieceId piece,
                          const Context& context) {
  const FoldMotion motion(flat_piece(surface, nets, piece));
  FoldTrial trial(motion, context);
  const Folding folding = find_folding(motion, trial, context);
  const std::vector<FaceId>& faces = nets.pieces[piece].faces;
  FoldOrder result;
  result.way = folding.way;
  if (folding.in_the_way) {
    const auto [f, g] = *folding.in_the_way;
    result.in_the_way = std::array<FaceId, 2>{faces[f], faces[g]};
  }
  const auto add = [&](const FoldMotion::Crease& crease, std::vector<CornerId>& step) {
    for (const std::uint32_t side : crease.sides) {
      step.push_back(mesh::corner(faces[side / 3], side % 3));
    }
  };
  if (folding.way == FoldWay::together && !motion.creases().empty()) {
    std::vector<CornerId>& all = result.steps.emplace_back();
    for (const FoldMotion::Crease& crease : motion.creases()) {
      add(crease, all);
    }
  }
  for (const std::uint32_t crease : folding.order) {
    add(motion.creases()[crease], result.steps.emplace_back());
  }
  return result;
}

}  // namespace ridgecraft::unfold
