// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/instances.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace ridgecraft::mesh {

void check_repetitions(const Source& source, std::uint64_t held, std::uint64_t points,
                       std::uint64_t corners) {
  // A strip of n points makes n - 2 triangles: three corners for one byte is the most that a file can hold
  // itself.
  const std::uint64_t most = std::max(3 * largest_repeated_count, 3 * held);
  if (points > most || corners > most) {
    source.refuse(ErrorKind::unusable_mesh,
                  fmt::format("repeats its objects until they have more than {} triangles", most / 3));
  }
  if (corners > largest_corner_count) {
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("is too large: its faces have more than {} corners", largest_corner_count));
  }
}

void add_triangle(Soup& soup, std::array<std::uint32_t, 3> points,
                  const std::optional<std::array<std::uint32_t, 3>>& texture) {
  if (texture) {
    soup.corner_texture.resize(soup.corner_point.size(), Soup::none);
    soup.corner_texture.insert(soup.corner_texture.end(), texture->begin(), texture->end());
  }
  soup.corner_point.insert(soup.corner_point.end(), points.begin(), points.end());
  soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
}

void finish_triangles(Soup& soup) {
  if (!soup.corner_texture.empty()) {
    soup.corner_texture.resize(soup.corner_point.size(), Soup::none);
  }
  if (std::all_of(soup.objects.begin(), soup.objects.end(),
                  [](const auto& object) { return object.second.empty(); })) {
    soup.objects.clear();
  }
}

}  // namespace ridgecraft::mesh
