// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/corner_colours.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::mesh {

std::uint32_t packed_colour(const Colour& colour) {
  std::uint32_t packed = 0;
  for (const double channel : colour) {
    const double share = std::isnan(channel) ? 1.0 : std::clamp(channel, 0.0, 1.0);
    packed = packed << 8U | static_cast<std::uint32_t>(std::lround(255.0 * share));
  }
  return packed;
}

void colour_corners(Soup& soup, const std::vector<std::uint32_t>& of_point) {
  if (of_point.empty()) {
    return;
  }
  soup.corner_colour.reserve(soup.corner_point.size());
  for (const std::uint32_t p : soup.corner_point) {
    soup.corner_colour.push_back(of_point[p]);
  }
}

void colour_last_triangle(Soup& soup, const std::array<std::uint32_t, 3>& colours) {
  soup.corner_colour.resize(soup.corner_point.size() - colours.size(), Soup::none);
  soup.corner_colour.insert(soup.corner_colour.end(), colours.begin(), colours.end());
}

void finish_corner_colours(Soup& soup) {
  if (!soup.corner_colour.empty()) {
    soup.corner_colour.resize(soup.corner_point.size(), Soup::none);
  }
}

}  // namespace ridgecraft::mesh
