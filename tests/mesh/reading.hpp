// SPDX-License-Identifier: GPL-3.0-or-later
// Short words for tests of the readers: text in, soup or refusal out.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/vector.hpp"
#include "mesh/reading/read_soup.hpp"

namespace ridgecraft::test {

/// The soup in a text that is called "model" with this suffix.
[[nodiscard]] inline mesh::Soup parsed(std::string_view text, const std::string& suffix) {
  return mesh::parse_soup(text, "model." + suffix, {}, {});
}

/// How a text is refused: "3 SENTENCE" for unreadable_input, "4 SENTENCE" for unusable_mesh; empty where it
/// is read.
[[nodiscard]] inline std::string refusal(std::string_view text, const std::string& suffix) {
  try {
    (void)parsed(text, suffix);
  } catch (const Error& error) {
    return (error.kind() == ErrorKind::unreadable_input ? "3 "
            : error.kind() == ErrorKind::unusable_mesh  ? "4 "
                                                        : "? ") +
           std::string(error.what());
  }
  return {};
}

/// The volume that the triangles from `from` to before `to` enclose, negative where they look inwards.
[[nodiscard]] inline double signed_volume(const mesh::Soup& soup, std::size_t from, std::size_t to) {
  double volume = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    const auto t = soup.polygon(i);
    volume += dot(soup.points[t[0]], cross(soup.points[t[1]], soup.points[t[2]])) / 6.0;
  }
  return volume;
}

}  // namespace ridgecraft::test
