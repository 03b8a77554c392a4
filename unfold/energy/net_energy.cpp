// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/net_energy.hpp"

#include <algorithm>

#include "base/geometry.hpp"

namespace ridgecraft::unfold {

NetEnergy::NetEnergy(const Patch& patch, const RootedNet& net, const CutFacts& facts, const Room& room,
                     const Weights& weights)
    : patch_(patch), net_(net), room_(room), cut_costs_(patch, facts, weights), shape_(patch, room, weights) {
  set_tree();
}

void NetEnergy::set_tree() {
  folds_ = net_.folds();
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    if (patch_.twin[side] == nothing) {
      folds_[side] = 0;
    }
  }
  cut_costs_.set_tree(folds_);
  pieces_.clear();
  piece_.assign(patch_.size(), nothing);
  shape_cost_ = 0.0;
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    if (piece_[f] != nothing) {
      continue;
    }
    const auto number = static_cast<std::uint32_t>(pieces_.size());
    pieces_.push_back({f, shape_.measure(net_, folds_, f, nullptr, {})});
    shape_cost_ += pieces_.back().shape.cost;
    for (const PieceShape::Member& member : shape_.faces()) {
      piece_[member.face] = number;
    }
  }
}

std::optional<double> NetEnergy::rate(const Swap& swap, double most) {
  const std::uint32_t above = net_.side_above(swap.below);
  cut_ = swap.side;
  fold_ = std::min(above, patch_.twin[above]);
  const std::uint32_t piece = piece_[fold_ / 3];
  if (piece != piece_[cut_ / 3] && piece != piece_[patch_.twin[cut_] / 3]) {
    return std::nullopt;
  }
  const double change = cut_costs_.change(cut_, fold_);
  if (change > most || !rate_shapes(swap.below)) {
    cut_costs_.drop();
    return std::nullopt;
  }
  return change + shapes_change_;
}

/// Measures the one or two pieces that the swap changes; false where one would have too many panels.
bool NetEnergy::rate_shapes(std::uint32_t below) {
  const std::uint32_t a = piece_[cut_ / 3];
  const std::uint32_t b = piece_[patch_.twin[cut_] / 3];
  const RootedNet::Span moved = net_.moved_span(below);
  const Rigid motion = net_.motion(below, cut_);
  set_fold(cut_, 1);
  set_fold(fold_, 0);
  first_ = shape_.measure(net_, folds_, cut_ / 3, &moved, motion);
  shapes_change_ = first_.cost - pieces_[a].shape.cost;
  bool few_panels = true;
  if (a != b) {
    second_root_ = other_end(fold_);
    second_ = shape_.measure(net_, folds_, second_root_, &moved, motion);
    shapes_change_ += second_.cost - pieces_[b].shape.cost;
    const std::size_t before = std::max(pieces_[a].shape.panels, pieces_[b].shape.panels);
    few_panels = room_.max_panels == 0 ||
                 std::max(first_.panels, second_.panels) <= std::max(room_.max_panels, before);
  }
  set_fold(cut_, 0);
  set_fold(fold_, 1);
  return few_panels;
}

/// Of the two faces at the new cut the one that isn't in the piece that was measured last.
std::uint32_t NetEnergy::other_end(std::uint32_t fold) const {
  const auto faces = shape_.faces();
  const std::uint32_t f = fold / 3;
  return std::none_of(faces.begin(), faces.end(), [f](const auto& member) { return member.face == f; })
             ? f
             : patch_.twin[fold] / 3;
}

void NetEnergy::keep() {
  cut_costs_.keep();
  set_fold(cut_, 1);
  set_fold(fold_, 0);
  shape_cost_ += shapes_change_;
  const std::uint32_t a = piece_[cut_ / 3];
  const std::uint32_t b = piece_[patch_.twin[cut_] / 3];
  pieces_[a] = {cut_ / 3, first_};
  if (a != b) {
    pieces_[b] = {second_root_, second_};
    relabel(cut_ / 3, a);
    relabel(second_root_, b);
  }
}

void NetEnergy::drop() {
  cut_costs_.drop();
}

void NetEnergy::relabel(std::uint32_t root, std::uint32_t number) {
  static_cast<void>(shape_.measure(net_, folds_, root, nullptr, {}));
  for (const PieceShape::Member& member : shape_.faces()) {
    piece_[member.face] = number;
  }
}

bool NetEnergy::all_fit() {
  return std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
    if (piece.shape.surely_fits) {
      return true;
    }
    static_cast<void>(shape_.measure(net_, folds_, piece.face, nullptr, {}));
    std::vector<Vec2> points;
    for (const PieceShape::Member& member : shape_.faces()) {
      points.insert(points.end(), net_.flat(member.face).begin(), net_.flat(member.face).end());
    }
    return room_.holds(convex_hull(std::move(points)), piece.shape.panels);
  });
}

}  // namespace ridgecraft::unfold
