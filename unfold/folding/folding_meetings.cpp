// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/folding_meetings.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_order.hpp"

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
    if (patch.twin[side] == no_index) {
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

void FoldingMeetings::count(const Folds& folds) {
  if (!knows_always_) {
    find_always(folds);
  }
  place_all(folds);
  pairs_.clear();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hinged;
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    if (folds[side] != 0) {
      hinged.emplace_back(plate_[side / 3], plate_[patch_.twin[side] / 3]);
    }
  }
  std::sort(hinged.begin(), hinged.end());
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    for (std::uint32_t g = f + 1; g < patch_.size(); ++g) {
      const std::uint64_t looks = root_[f] == root_[g] ? near(f, centres_[f], g) : 0;
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

void FoldingMeetings::place_all(const Folds& folds) {
  root_.assign(patch_.size(), no_index);
  std::vector<std::uint32_t> open;
  for (std::uint32_t root = 0; root < patch_.size(); ++root) {
    if (root_[root] == no_index) {
      root_[root] = root;
      frame_[root] = {};
      open.push_back(root);
    }
    place_tree(folds, open);
  }
}

/// Places what hangs on the given faces, and forgets them.
void FoldingMeetings::place_tree(const Folds& folds, std::vector<std::uint32_t>& open) {
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::uint32_t f = open[i];
    settle(f);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const std::uint32_t g = folds[side] != 0 ? patch_.twin[side] / 3 : f;
      if (root_[g] == no_index) {
        root_[g] = root_[f];
        for (std::size_t t = 0; t < samples; ++t) {
          frame_[g][t] = frame_[f][t] * hinge_[side][t];
        }
        open.push_back(g);
      }
    }
  }
  open.clear();
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

/// How what a move carries moves, in every sample.
FoldingMeetings::Samples<Motion> FoldingMeetings::motions(std::uint32_t side) {
  new_fold_ = moves_[side / 3] != 0 ? patch_.twin[side] : side;
  const std::uint32_t inside = patch_.twin[new_fold_];
  Samples<Motion> motion;
  for (std::size_t t = 0; t < samples; ++t) {
    motion[t] = frame_[new_fold_ / 3][t] * hinge_[new_fold_][t] * frame_[inside / 3][t].inverse();
  }
  return motion;
}

/// The pairs that a move makes meet, no more than `limit`.
void FoldingMeetings::find_made(const Carry& carry, std::size_t limit) {
  made_.clear();
  new_fold_ = no_index;
  if (carry.side == no_index) {
    return;
  }
  motion_ = motions(carry.side);
  const std::uint32_t hinged_f = plate_[carry.side / 3];
  const std::uint32_t hinged_g = plate_[patch_.twin[carry.side] / 3];
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
    for (const std::uint32_t g : carry.to) {
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

std::size_t FoldingMeetings::after(const Carry& carry, std::size_t limit) {
  for (const std::uint32_t f : moved_) {
    moves_[f] = 0;
  }
  moved_.assign(carry.moved.begin(), carry.moved.end());
  for (const std::uint32_t f : moved_) {
    moves_[f] = 1;
  }
  const auto lost = static_cast<std::size_t>(
      std::count_if(pairs_.begin(), pairs_.end(), [&](const auto& pair) { return is_across(pair); }));
  const std::size_t kept = pairs_.size() - lost;
  if (kept >= limit) {
    return limit;
  }
  find_made(carry, limit - kept);
  return kept + made_.size();
}

void FoldingMeetings::keep(const Folds& folds) {
  pairs_.erase(
      std::remove_if(pairs_.begin(), pairs_.end(), [&](const auto& pair) { return is_across(pair); }),
      pairs_.end());
  pairs_.insert(pairs_.end(), made_.begin(), made_.end());
  if (new_fold_ == no_index) {
    return;
  }
  // From face to face along the folds within what moved, which the move leaves as they are. Moving each frame
  // by motion_ would double its error with every move.
  place_beyond(new_fold_);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const std::uint32_t above = open_[i];
    const std::uint32_t f = patch_.twin[above] / 3;
    settle(f);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (side != patch_.twin[above] && folds[side] != 0 && moves_[patch_.twin[side] / 3] != 0) {
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

}  // namespace ridgecraft::unfold
