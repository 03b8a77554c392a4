// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/tree_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// Cosines and sines of the directions k * 22.5 degrees, k = 0 .. 7, four and four; those of 8 .. 15 are
/// opposite.
constexpr std::size_t lanes = 4;
constexpr std::array<FloatLanes, 2> cosines{
    {{1.0F, 0.92387953F, 0.70710678F, 0.38268343F}, {0.0F, -0.38268343F, -0.70710678F, -0.92387953F}}};
constexpr std::array<FloatLanes, 2> sines{
    {{0.0F, 0.38268343F, 0.70710678F, 0.92387953F}, {1.0F, 0.92387953F, 0.70710678F, 0.38268343F}}};
/// Unit of a piece's hollows, mm2.
constexpr double hollow_unit_mm2 = 100.0;
/// Unit of the square of a piece's outline, mm.
constexpr double outline_unit_mm = 1000.0;
/// A piece this wide is held without trouble, mm.
constexpr double handy_mm = 30.0;
/// A piece of so many panels is an evening's work by itself.
constexpr double many_panels = 80.0;
/// What a millimetre beyond the sheet costs, mm: more than any seam would save by it.
constexpr double overhang_price = 20.0;
/// What a flat region more than a piece may have costs, mm: the same.
constexpr double panel_price = 50.0;

/// Area of the polygon around a convex set with these reaches in 16 directions, from that set's own.
double area_within(const std::array<float, 16>& reach) {
  constexpr double cosine = 0.92387953251128674;
  constexpr double sine = 0.38268343236508978;
  double twice = 0.0;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto h = static_cast<double>(reach[i]);
    const auto beside = static_cast<double>(reach[(i + 1) % 16] + reach[(i + 15) % 16]);
    const double side = (beside - 2.0 * cosine * h) / sine;
    twice += h * side;
  }
  return 0.5 * twice;
}

/// The turn that lays the longer principal axis of these points along x: of a strip the polygon around it is
/// the strip then, wherever it points.
Turn along_axes(const std::vector<Vec2>& points) {
  Vec2 mean;
  for (const Vec2 p : points) {
    mean += p;
  }
  mean = mean / static_cast<double>(points.size());
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Vec2 p : points) {
    const Vec2 d = p - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  // Half of the angle of (xx - yy, 2 xy), without trigonometry.
  const Vec2 twice{xx - yy, 2.0 * xy};
  const double size = length(twice);
  if (!(size > 0.0)) {
    return {};
  }
  const double cosine = std::sqrt(std::max(0.0, 0.5 * (1.0 + twice.x / size)));
  const double sine = std::sqrt(std::max(0.0, 0.5 * (1.0 - twice.x / size)));
  return {cosine, twice.y < 0.0 ? sine : -sine};
}

}  // namespace

TreeShape::TreeShape(const Patch& patch, std::span<const std::uint32_t> part, const Room& room,
                     const Weights& weights)
    : patch_(patch),
      part_(part),
      room_(room),
      weights_(weights),
      narrow_(narrow_sides(patch)),
      part_in_(part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1, 0),
      members_(patch.size()) {
  area_.reserve(patch.size());
  for (const Triangle& t : patch.shape) {
    area_.push_back(area_of(t));
  }
}

void TreeShape::collect(const Folds& folds, std::uint32_t root) {
  members_[0] = {root, 0, no_index, area_[root]};
  count_ = 1;
  panels_ = 1;
  parts_ = 0;
  ++question_;
  outline_ = 0.0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const Member member = members_[i];
    if (!part_.empty() && part_in_[part_[member.face]] != question_) {
      part_in_[part_[member.face]] = question_;
      ++parts_;
    }
    for (std::uint32_t side = 3 * member.face; side < 3 * member.face + 3; ++side) {
      if (folds[side] == 0) {
        outline_ += patch_.frozen[side] == 0 ? patch_.length[side] : 0.0;
        continue;
      }
      const std::uint32_t twin = patch_.twin[side];
      if (twin != no_index && side != member.up) {
        members_[count_++] = {twin / 3, i, twin, area_[twin / 3]};
        panels_ += patch_.frozen[side] != frozen_in_panel ? 1U : 0U;
      }
    }
  }
  for (std::size_t i = count_; i-- > 1;) {
    members_[members_[i].parent].behind += members_[i].behind;
  }
}

double TreeShape::necks(const Folds& folds) const {
  double sum = 0.0;
  for (std::size_t i = 1; i < count_; ++i) {
    const Member& member = members_[i];
    if (patch_.frozen[member.up] == 0) {
      sum += neck_cost(patch_.length[member.up], std::min(member.behind, members_[0].behind - member.behind));
    }
  }
  for (std::size_t i = 0; i < count_ && !narrow_.empty(); ++i) {
    const Member& member = members_[i];
    const std::uint32_t cut = only_cut(folds, member.face);
    if (cut != no_index && narrow_[cut] != 0) {
      const double area = area_[member.face];
      const double behind = i > 0 ? member.behind - area : members_[1].behind;
      sum += thread_cost_between(behind, members_[0].behind - area - behind);
    }
  }
  return sum;
}

/// By how much the piece is larger than the sheet at the best of eight turns, mm.
double TreeShape::overhang(const std::array<float, 2 * directions>& reach) const {
  const double width = room_.sheet->width - 2.0 * room_.strip;
  const double height = room_.sheet->height - 2.0 * room_.strip;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < directions; ++i) {
    const std::size_t k = (i + 4) % (2 * directions);
    const auto across = static_cast<double>(reach[i] + reach[i + directions]);
    const auto along = static_cast<double>(reach[k] + reach[(k + directions) % (2 * directions)]);
    least = std::min(least, std::max(0.0, across - width) + std::max(0.0, along - height));
  }
  return least;
}

TreeShape::Measure TreeShape::measure(const Forest& forest, const Folds& folds, std::uint32_t root,
                                      const Forest::Carried* moved) {
  collect(folds, root);
  work_ += count_;
  // Seen from a corner of the root's, so that floats are enough.
  const auto place = [&](std::uint32_t f, std::uint32_t corner) {
    const Vec2 at = forest.flat(f)[corner];
    return moved != nullptr && forest.in_span(moved->faces, f) ? moved->motion(at) : at;
  };
  const Vec2 origin = place(root, 0);
  std::array<FloatLanes, 2> high{};
  std::array<FloatLanes, 2> low{};
  points_.clear();
  const auto add = [&](std::uint32_t f, std::uint32_t corner) {
    points_.push_back(place(f, corner) - origin);
  };
  add(root, 0);
  add(root, 1);
  add(root, 2);
  // Two corners of any other face are its parent's.
  for (const Member& member : faces().subspan(1)) {
    add(member.face, (member.up + 2) % 3);
  }
  const Turn upright = along_axes(points_);
  for (const Vec2 point : points_) {
    const Vec2 p = upright(point);
    const auto x = static_cast<float>(p.x);
    const auto y = static_cast<float>(p.y);
    for (std::size_t half = 0; half < 2; ++half) {
      const FloatLanes at = x * cosines[half] + y * sines[half];
      high[half] = larger(at, high[half]);
      low[half] = smaller(at, low[half]);
    }
  }
  std::array<float, 2 * directions> reach;
  for (std::size_t d = 0; d < directions; ++d) {
    reach[d] = high[d / lanes][d % lanes];
    reach[d + directions] = -low[d / lanes][d % lanes];
  }
  Measure result;
  const double paper = members_[0].behind;
  result.cost = weights_.compact * std::max(0.0, area_within(reach) - paper) / hollow_unit_mm2 +
                weights_.outline * outline_ * outline_ / outline_unit_mm + weights_.thin * necks(folds);
  const double panels = static_cast<double>(panels_) / many_panels;
  result.cost +=
      weights_.pieces + weights_.parts * static_cast<double>(std::max<std::size_t>(parts_, 1) - 1) +
      weights_.small * std::max(0.0, 1.0 - std::sqrt(paper) / handy_mm) + weights_.panels * panels * panels;
  if (room_.sheet) {
    const double over = overhang(reach);
    result.surely_fits = over <= 0.0;
    result.cost += overhang_price * over;
  }
  if (room_.max_panels > 0 && panels_ > room_.max_panels) {
    result.surely_fits = false;
    result.cost += panel_price * static_cast<double>(panels_ - room_.max_panels);
  }
  return result;
}

}  // namespace ridgecraft::unfold
