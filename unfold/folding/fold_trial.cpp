// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/fold_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/boxes.hpp"

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
    std::uint32_t face = nothing;
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

}  // namespace ridgecraft::unfold
