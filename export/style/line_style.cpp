// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/style/line_style.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ridgecraft::export_ {
namespace {

constexpr double mountain_dashes[] = {4.0, 1.2, 0.6, 1.2};
constexpr double valley_dashes[] = {3.0, 1.5};
/// The base of a tab that stays in the plane of its face is not folded: fine dots say where the glue begins.
constexpr double flat_dashes[] = {0.4, 1.0};

constexpr double cut_width = 0.2;
constexpr double fold_width = 0.15;
constexpr double tab_fold_width = 0.12;
constexpr double mark_width = 0.15;
/// Lines from a number to its edge: thinner and paler than anything that is cut or folded.
constexpr double leader_width = 0.1;
/// Where another piece is glued on: short dashes, which no fold has, and which stay visible as an outline.
constexpr double glue_width = 0.15;
constexpr double glue_dashes[] = {1.0, 0.8};
constexpr Color leader_grey{0x80, 0x80, 0x80};
/// Edges of the model that are printed, not folded: paler than a leader, and broader, so that printers show
/// them.
constexpr double lost_edge_width = 0.15;
constexpr Color lost_edge_grey{0xa0, 0xa0, 0xa0};
/// On dark colours. Not white: printers leave that out, so whoever looks for lines takes white ones for none.
constexpr Color light_tone{0xec, 0xec, 0xec};
/// A dash isn't shortened below this as long as shortening the rest of the pattern can be avoided, mm.
constexpr double shortest_dash = 1.0;

std::span<const double> pattern_of(Fold fold) {
  switch (fold) {
    case Fold::mountain:
      return mountain_dashes;
    case Fold::valley:
      return valley_dashes;
    case Fold::none:
      break;
  }
  return {};
}

LineStyle dark_style_of(const Line& line) {
  if (line.pen) {
    return {line.pen->width, line.pen->color, {}};
  }
  switch (line.layer == Layer::mark ? line.like : line.layer) {
    case Layer::cut:
      return {cut_width, {}, {}};
    case Layer::mountain:
      return {fold_width, {}, mountain_dashes};
    case Layer::valley:
      return {fold_width, {}, valley_dashes};
    case Layer::tab_fold:
      return {tab_fold_width,
              {},
              line.fold == Fold::none ? std::span<const double>(flat_dashes) : pattern_of(line.fold)};
    case Layer::glue:
      return {glue_width, {}, glue_dashes};
    case Layer::label:
    case Layer::shadow:
      return {leader_width, leader_grey, {}};
    case Layer::mark:
      return {line.fold == Fold::none ? mark_width : fold_width, {}, pattern_of(line.fold)};
    case Layer::paint:
      return {lost_edge_width, lost_edge_grey, {}};
    case Layer::tab_fill:
    case Layer::piece_name:
    case Layer::picture:
      break;
  }
  return {mark_width, {}, {}};
}

}  // namespace

LineStyle style_of(const Line& line) {
  if (line.layer == Layer::paint && line.like != Layer::paint) {
    Line around = line;
    around.layer = line.like;
    const LineStyle style = dark_style_of(around);
    return {style.width + 2.0 * halo_mm, light_tone, style.dashes};
  }
  LineStyle style = dark_style_of(line);
  if (line.tone == Tone::light) {
    style.color = light_tone;
  }
  return style;
}

Color fill_of(Layer layer) {
  constexpr std::uint8_t tab_grey = 0xe6;
  return layer == Layer::tab_fill || layer == Layer::mark ? Color{tab_grey, tab_grey, tab_grey} : Color{};
}

Color color_of(const Text& text) {
  if (text.color) {
    return *text.color;
  }
  return text.layer == Layer::paint || text.tone == Tone::light ? light_tone : Color{};
}

std::vector<double> fitted_dashes(std::span<const double> pattern, double length) {
  if (pattern.empty() || length < shortest_dashed_mm) {
    return {};
  }
  const double period = std::accumulate(pattern.begin(), pattern.end(), 0.0);
  const double between = period - pattern[0];  // from the end of one first dash to the next
  const double dash_count = std::max(2.0, std::round((length + between) / period));
  std::vector<double> dashes(pattern.begin(), pattern.end());
  const double first = (length - (dash_count - 1.0) * between) / dash_count;
  if (dash_count == 2.0 && first < pattern[0] && first >= std::min(shortest_dash, pattern[0])) {
    dashes[0] = first;  // a short line: the gaps keep their size, so the pattern is still recognised
    return dashes;
  }
  const double scale = length / (dash_count * period - between);
  for (double& dash : dashes) {
    dash *= scale;
  }
  return dashes;
}

std::vector<double> dashes_of(const Line& line) {
  double total = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    total += length(line.points[i] - line.points[i - 1]);
  }
  return fitted_dashes(style_of(line).dashes, total);
}

}  // namespace ridgecraft::export_
