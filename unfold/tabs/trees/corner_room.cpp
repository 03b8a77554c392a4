// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/trees/corner_room.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"

namespace ridgecraft::unfold {

namespace {

constexpr double full_turn = 6.283185307179586;
/// What it is worth that a tab may grow from either side: where only one has room, something farther off may
/// take it.
constexpr double worth_of_choice = 0.25;

std::uint32_t next_side(std::uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
std::uint32_t previous_side(std::uint32_t side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

/// The angle at the origin that a tab takes together with the clearance from a ray on its left side; `seen`
/// brings an end of the base to the origin. A tab that shares the corner keeps the clearance farther up only.
template <class Seen>
float angle_needed(const TabCandidate& tab, bool at_corner, Seen seen, double clearance) {
  double most = 0.0;
  const auto add = [&](const Walled<4>& shape, double distance) {
    for (const Vec2 corner : shape.corner) {
      const Vec2 p = seen(corner);
      const double r = length(p);
      if (r > 0.0) {
        most = std::max(most, std::atan2(p.y, p.x) + std::asin(std::min(1.0, distance / r)));
      }
    }
  };
  add(tab.whole, at_corner ? 0.0 : clearance);
  if (at_corner) {
    add(tab.upper, clearance);
  }
  return static_cast<float>(most);
}

}  // namespace

TabWedges::TabWedges(const Patch& patch, const std::vector<std::vector<TabCandidate>>& candidates,
                     const std::vector<std::uint8_t>& seam, double clearance_mm)
    : patch_(patch),
      cut_(patch.twin.size(), 0),
      seam_(seam),
      corner_angle_(patch.twin.size()),
      needed_(patch.twin.size()),
      cost_(patch.twin.size(), 0.0) {
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const Triangle& t = patch.shape[side / 3];
    const std::uint32_t k = side % 3;
    const Vec2 a = t[(k + 1) % 3] - t[k];
    const Vec2 b = t[(k + 2) % 3] - t[k];
    corner_angle_[side] = std::atan2(cross(a, b), dot(a, b));
    Angles& needed = needed_[side];
    for (const TabCandidate& tab : candidates[side]) {
      needed.left[needed.count] = angle_needed(
          tab, tab.at_left, [](Vec2 p) { return p; }, clearance_mm);
      needed.right[needed.count] = angle_needed(
          tab, tab.at_right,
          [&](Vec2 p) {
            return Vec2{patch.length[side] - p.x, p.y};
          },
          clearance_mm);
      ++needed.count;
    }
  }
}

void TabWedges::set_cut(std::uint32_t side, std::uint8_t cut) {
  cut_[side] = cut;
  if (patch_.twin[side] != nothing) {
    cut_[patch_.twin[side]] = cut;
  }
}

void TabWedges::set_tree(const Folds& folds) {
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    cut_[side] = patch_.twin[side] == nothing || (folds[side] == 0 && patch_.frozen[side] == 0) ? 1 : 0;
  }
  missing_ = 0.0;
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    if (cut_[side] != 0 && join_of(side) == side) {
      cost_[side] = cost_of(side);
      missing_ += cost_[side];
    }
  }
}

bool TabWedges::has_room(std::uint32_t side) const {
  const Angles& needed = needed_[side];
  if (needed.count == 0) {
    return false;
  }
  double paper = 0.0;
  std::uint32_t at = side;
  do {
    at = next_side(cut_[at] != 0 ? at : patch_.twin[at]);
    paper += corner_angle_[at];
  } while (cut_[at] == 0);
  const auto left = static_cast<float>(full_turn - paper);
  paper = corner_angle_[side];
  for (at = previous_side(side); cut_[at] == 0; at = previous_side(patch_.twin[at])) {
    paper += corner_angle_[patch_.twin[at]];
  }
  const auto right = static_cast<float>(full_turn - paper);
  for (std::uint32_t i = 0; i < needed.count; ++i) {
    if (needed.left[i] <= left && needed.right[i] <= right) {
      return true;
    }
  }
  return false;
}

double TabWedges::cost_of(std::uint32_t join) const {
  const std::uint32_t twin = patch_.twin[join];
  if (twin == nothing) {
    return seam_[join] == 0 || has_room(join) ? 0.0 : tab_worth(patch_.length[join]);
  }
  if (!has_room(join)) {
    return has_room(twin) ? worth_of_choice : tab_worth(patch_.length[join]);
  }
  return has_room(twin) ? 0.0 : worth_of_choice;
}

/// Notes a cut that is to be rated anew.
void TabWedges::note(std::uint32_t side) {
  const std::uint32_t join = join_of(side);
  for (std::size_t i = 0; i < changes_; ++i) {
    if (changed_[i] == join) {
      return;
    }
  }
  RIDGECRAFT_ASSERT(changes_ < most_changed);
  changed_[changes_++] = join;
}

/// Notes the cuts that meet this one on the outline.
void TabWedges::note_neighbours(std::uint32_t side) {
  for (const std::uint32_t s : {side, patch_.twin[side]}) {
    std::uint32_t at = next_side(s);
    while (cut_[at] == 0) {
      at = next_side(patch_.twin[at]);
    }
    note(at);
    at = previous_side(s);
    while (cut_[at] == 0) {
      at = previous_side(patch_.twin[at]);
    }
    note(at);
  }
}

double TabWedges::change(std::uint32_t cut, std::uint32_t fold) {
  changes_ = 0;
  changed_cut_ = join_of(cut);
  changed_fold_ = join_of(fold);
  note(cut);
  note_neighbours(cut);
  set_cut(cut, 0);
  set_cut(fold, 1);
  note(fold);
  note_neighbours(fold);
  sum_ = 0.0;
  for (std::size_t i = 0; i < changes_; ++i) {
    const std::uint32_t join = changed_[i];
    const double old = join == changed_fold_ ? 0.0 : cost_[join];
    new_cost_[i] = join == changed_cut_ ? 0.0 : cost_of(join);
    sum_ += new_cost_[i] - old;
  }
  return sum_;
}

void TabWedges::keep() {
  for (std::size_t i = 0; i < changes_; ++i) {
    cost_[changed_[i]] = new_cost_[i];
  }
  missing_ += sum_;
}

void TabWedges::drop() {
  set_cut(changed_cut_, 1);
  set_cut(changed_fold_, 0);
}

}  // namespace ridgecraft::unfold
