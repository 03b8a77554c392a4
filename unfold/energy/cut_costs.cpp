// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/cut_costs.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"
#include "base/error.hpp"

namespace ridgecraft::unfold {

namespace {

constexpr float full_turn = 6.2831853F;
/// Share of its length that a cut counts as bare where a tab may grow from one side only: something farther
/// off may take it.
constexpr double share_without_choice = 0.2;
/// A cut that opens by less is a slit: 20 degrees. Up to half as much again it is one in part.
constexpr float slit_angle = 0.34906585F;
constexpr float no_slit_angle = 1.5F * slit_angle;
/// How sharp a crease is must be to hide a seam wholly: 90 degrees.
constexpr double sharp = 1.5707963267948966;
/// A seam in a hollow shows less than one on a ridge: as a ridge that is sharper by a third.
constexpr double hollow_gain = 0.4;

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
        most = std::max(most, elementary::atan2(p.y, p.x) + elementary::asin(std::min(1.0, distance / r)));
      }
    }
  };
  add(tab.whole, at_corner ? 0.0 : clearance);
  if (at_corner) {
    add(tab.upper, clearance);
  }
  return static_cast<float>(most);
}

/// How far a seam here is in the open: 1 on a smooth place, 0 along a right-angled ridge, less in a hollow.
double openness(double fold_angle) {
  const double crease = std::min(1.0, std::abs(fold_angle) / sharp);
  return 1.0 - crease - (fold_angle > 0.0 ? hollow_gain * crease : 0.0);
}

}  // namespace

double seam_price(const Patch& patch, std::uint32_t side, const Weights& weights) {
  const double borders = is_border_of_labels(patch, side) ? weights.borders : 0.0;
  return patch.length[side] * (weights.seam + weights.open * openness(patch.fold_angle[side]) - borders);
}

CutCosts::CutCosts(const Patch& patch, const CutFacts& facts, const Weights& weights)
    : patch_(patch),
      weights_(weights),
      with_tabs_(!facts.candidates.empty()),
      images_(facts.images),
      across_(facts.across),
      behind_(patch.twin.size()),
      cut_(patch.twin.size(), 0),
      seam_(patch.twin.size(), 0),
      corner_angle_(patch.twin.size()),
      price_(patch.twin.size()),
      needed_(patch.twin.size()),
      cost_(patch.twin.size()) {
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const Triangle& t = patch.shape[side / 3];
    const std::uint32_t k = side % 3;
    const Vec2 a = t[(k + 1) % 3] - t[k];
    const Vec2 b = t[(k + 2) % 3] - t[k];
    corner_angle_[side] = static_cast<float>(elementary::atan2(cross(a, b), dot(a, b)));
    price_[side] = seam_price(patch, side, weights);
    if (!with_tabs_) {
      continue;
    }
    seam_[side] = facts.seam[side];
    for (const std::uint32_t fold : across_[side]) {
      behind_[join_of(fold)].push_back(join_of(side));
    }
    Angles& needed = needed_[side];
    for (const TabCandidate& tab : facts.candidates[side]) {
      needed.left[needed.count] = angle_needed(
          tab, tab.at_left, [](Vec2 p) { return p; }, facts.clearance_mm);
      needed.right[needed.count] = angle_needed(
          tab, tab.at_right,
          [&](Vec2 p) {
            return Vec2{patch.length[side] - p.x, p.y};
          },
          facts.clearance_mm);
      ++needed.count;
    }
  }
}

void CutCosts::set_cut(std::uint32_t side, std::uint8_t cut) {
  if (side == no_index) {
    return;
  }
  cut_[side] = cut;
  if (patch_.twin[side] != no_index) {
    cut_[patch_.twin[side]] = cut;
  }
}

void CutCosts::set_tree(const Folds& folds) {
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    cut_[side] = patch_.twin[side] == no_index || (folds[side] == 0 && patch_.frozen[side] == 0) ? 1 : 0;
  }
  total_ = 0.0;
  bare_ = 0.0;
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    if (join_of(side) != side) {
      continue;
    }
    cost_[side] = {};
    if (cut_[side] != 0) {
      cost_[side] = cost_of(side);
      total_ += cost_[side].mm;
      bare_ += cost_[side].bare;
      total_ += asymmetry(side);
    }
  }
}

double CutCosts::price_of_pair(std::uint32_t side, const SideImages& images) const {
  return 0.5 * images_times_ * images.weight * weights_.mirror *
         (patch_.length[side] + patch_.length[images.side[side]]);
}

double CutCosts::asymmetry_price(std::uint32_t side) const {
  double price = 0.0;
  for (const SideImages& images : images_) {
    price += images.side[side] == no_index ? 0.0 : price_of_pair(side, images);
  }
  return price;
}

/// What it costs that the edge's images are no cuts where it is one, or the other way round.
double CutCosts::asymmetry(std::uint32_t side) const {
  double cost = 0.0;
  for (const SideImages& images : images_) {
    const std::uint32_t image = images.side[side];
    cost += image != no_index && cut_[side] != cut_[image] ? price_of_pair(side, images) : 0.0;
  }
  return cost;
}

/// The same for both edges of the swap that is being rated. Where one is the other's image their pair counts
/// once.
double CutCosts::asymmetry_of_changed() const {
  if (changed_cut_ == no_index || changed_fold_ == no_index) {
    const std::uint32_t side = std::min(changed_cut_, changed_fold_);
    return side == no_index ? 0.0 : asymmetry(side);
  }
  double cost = asymmetry(changed_cut_) + asymmetry(changed_fold_);
  for (const SideImages& images : images_) {
    const std::uint32_t image = images.side[changed_cut_];
    if (image != no_index && join_of(image) == changed_fold_ && cut_[image] != cut_[changed_cut_]) {
      cost -= price_of_pair(changed_cut_, images);
    }
  }
  return cost;
}

void CutCosts::weigh_images(double times) {
  double uneven = 0.0;
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    uneven += join_of(side) == side && cut_[side] != 0 ? asymmetry(side) : 0.0;
  }
  total_ += (times / images_times_ - 1.0) * uneven;
  images_times_ = times;
}

CutCosts::Ends CutCosts::ends_of(std::uint32_t side) const {
  Ends ends;
  float paper = 0.0F;
  std::uint32_t at = side;
  do {
    at = next_side(cut_[at] != 0 ? at : patch_.twin[at]);
    paper += corner_angle_[at];
  } while (cut_[at] == 0);
  ends.left = full_turn - paper;
  ends.slit_left = at == patch_.twin[side];
  paper = corner_angle_[side];
  for (at = previous_side(side); cut_[at] == 0; at = previous_side(patch_.twin[at])) {
    paper += corner_angle_[patch_.twin[at]];
  }
  ends.right = full_turn - paper;
  ends.slit_right = at == patch_.twin[side];
  return ends;
}

bool CutCosts::has_room(std::uint32_t side, const Ends& ends) const {
  const Angles& needed = needed_[side];
  if (needed.count == 0 || std::any_of(across_[side].begin(), across_[side].end(),
                                       [this](std::uint32_t fold) { return cut_[fold] != 0; })) {
    return false;
  }
  for (std::uint32_t i = 0; i < needed.count; ++i) {
    if (needed.left[i] <= ends.left && needed.right[i] <= ends.right) {
      return true;
    }
  }
  return false;
}

CutCosts::Cost CutCosts::cost_of(std::uint32_t join) const {
  const std::uint32_t twin = patch_.twin[join];
  const double length = patch_.length[join];
  if (twin == no_index) {
    const bool lacks = seam_[join] != 0 && !has_room(join, ends_of(join));
    const double bare = lacks ? weights_.bare * length : 0.0;
    return {bare, bare, lacks};
  }
  const Ends ends = ends_of(join);
  Cost cost{price_[join], 0.0, false};
  if (with_tabs_) {
    const int sides = (has_room(join, ends) ? 1 : 0) + (has_room(twin, ends_of(twin)) ? 1 : 0);
    cost.lacks = sides == 0;
    cost.bare = weights_.bare * length * (sides == 0 ? 1.0 : sides == 1 ? share_without_choice : 0.0);
    cost.mm += cost.bare;
  }
  const auto slit = [](bool meets, float angle) {
    return meets ? std::clamp((no_slit_angle - angle) / (no_slit_angle - slit_angle), 0.0F, 1.0F) : 0.0F;
  };
  const float most = std::max(slit(ends.slit_left, ends.left), slit(ends.slit_right, ends.right));
  cost.mm += weights_.slits * length * static_cast<double>(most);
  return cost;
}

/// Notes a cut that is to be rated anew.
void CutCosts::note(std::uint32_t side) {
  if (side == no_index) {
    return;
  }
  const std::uint32_t join = join_of(side);
  if (std::find(changed_.begin(), changed_.end(), join) == changed_.end()) {
    changed_.push_back(join);
  }
}

/// Notes the cuts that meet this one on the outline.
void CutCosts::note_neighbours(std::uint32_t side) {
  if (side == no_index) {
    return;
  }
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

/// Notes the cuts whose tabs need this edge to be a fold.
void CutCosts::note_behind(std::uint32_t join) {
  if (join == no_index) {
    return;
  }
  for (const std::uint32_t other : behind_[join]) {
    if (cut_[other] != 0) {
      note(other);
    }
  }
}

double CutCosts::change(std::uint32_t cut, std::uint32_t fold) {
  changed_.clear();
  changed_cut_ = cut == no_index ? no_index : join_of(cut);
  changed_fold_ = fold == no_index ? no_index : join_of(fold);
  note(cut);
  note_neighbours(cut);
  const double asymmetry_before = asymmetry_of_changed();
  set_cut(cut, 0);
  set_cut(fold, 1);
  sum_ = asymmetry_of_changed() - asymmetry_before;
  note(fold);
  note_neighbours(fold);
  note_behind(changed_cut_);
  note_behind(changed_fold_);
  bare_sum_ = 0.0;
  new_cost_.resize(changed_.size());
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const std::uint32_t join = changed_[i];
    const Cost old = join == changed_fold_ ? Cost{} : cost_[join];
    new_cost_[i] = join == changed_cut_ ? Cost{} : cost_of(join);
    sum_ += new_cost_[i].mm - old.mm;
    bare_sum_ += new_cost_[i].bare - old.bare;
  }
  return sum_;
}

void CutCosts::keep() {
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    cost_[changed_[i]] = new_cost_[i];
  }
  total_ += sum_;
  bare_ += bare_sum_;
}

void CutCosts::drop() {
  set_cut(changed_cut_, 1);
  set_cut(changed_fold_, 0);
}

}  // namespace ridgecraft::unfold
