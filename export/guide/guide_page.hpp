// SPDX-License-Identifier: GPL-3.0-or-later
// The sheet that the guide is laid out on, and what all of its pages have.
#pragma once

#include <cstddef>
#include <string>

#include "export/sheet/drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::paper {

/// Upright, in millimetres: A4, or letter where the nets are on a size of paper made of inches. The guide is
/// read, not cut, so it needn't have the size of the nets.
struct GuideSheet {
  Vec2 size{210.0, 297.0};
  double margin = 14.0;
  double foot = 10.0;  ///< of the printable height, for the page's number

  /// What the pages' contents have.
  [[nodiscard]] Box2 room() const { return {{margin, margin + foot}, {size.x - margin, size.y - margin}}; }
};
[[nodiscard]] GuideSheet guide_sheet(const Paper& nets);

inline constexpr Color guide_grey{0x70, 0x70, 0x70};

/// A line over the page's width or a part of it.
[[nodiscard]] Line guide_rule(Vec2 from, Vec2 to);
/// Texts in grey.
[[nodiscard]] Text in_grey(Text text);

/// The foot of a page: the model's name, and which page it is.
[[nodiscard]] Group guide_foot(const GuideSheet& sheet, const std::string& title, std::size_t page,
                               std::size_t count);

}  // namespace ridgecraft::paper
