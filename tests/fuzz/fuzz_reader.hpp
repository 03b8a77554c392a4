// SPDX-License-Identifier: GPL-3.0-or-later
// What all fuzz targets check: bytes are read or refused with a proper sentence, and what is read keeps its
// promises.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/reading/read_soup.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::test {

inline void require(bool condition) {
  if (!condition) {
    std::abort();
  }
}

/// The promises of mesh/model/soup.hpp.
inline void check_soup(const mesh::Soup& soup, std::size_t bytes) {
  require(soup.polygon_count() > 0 && soup.first_corner.front() == 0);
  require(soup.first_corner.back() == soup.corner_point.size());
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    require(soup.first_corner[i] <= soup.first_corner[i + 1]);
  }
  for (const Vec3 p : soup.points) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  for (const Vec2 p : soup.texture_points) {
    require(std::isfinite(p.x) && std::isfinite(p.y));
  }
  for (const std::uint32_t p : soup.corner_point) {
    require(p < soup.points.size());
  }
  require(soup.corner_texture.empty() || soup.corner_texture.size() == soup.corner_point.size());
  for (const std::uint32_t t : soup.corner_texture) {
    require(t == mesh::Soup::none || t < soup.texture_points.size());
  }
  require(soup.polygon_material.empty() || soup.polygon_material.size() == soup.polygon_count());
  for (const std::uint32_t m : soup.polygon_material) {
    require(m == mesh::Soup::none || m < soup.materials.size());
  }
  // A strip of n points makes n - 2 triangles: three corners for a byte is the most that a format can do,
  // unless it knows repetitions.
  const bool repeats = soup.format == mesh::FileFormat::gltf || soup.format == mesh::FileFormat::glb ||
                       soup.format == mesh::FileFormat::threemf;
  const std::size_t most =
      repeats ? std::max<std::size_t>(3 * mesh::largest_repeated_count, 3 * bytes) : 3 * bytes;
  require(soup.corner_point.size() <= most && soup.points.size() <= (repeats ? most : bytes));
  for (std::size_t i = 0; i < soup.objects.size(); ++i) {
    require(soup.objects[i].first <= soup.polygon_count() &&
            printable(soup.objects[i].second) == soup.objects[i].second);
    require(i == 0 || soup.objects[i - 1].first <= soup.objects[i].first);
  }
  for (const mesh::Repair& remark : soup.remarks.entries()) {
    require(remark.count > 0 && !english(mesh::message(remark)).empty());
    require(printable(remark.detail) == remark.detail);
  }
}

/// Reads the bytes as a file of this name.
inline int fuzz_reader(const std::uint8_t* data, std::size_t size, std::string_view file_name) {
  // libFuzzer hands over raw bytes; the reader takes characters.
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    check_soup(mesh::parse_soup(bytes, file_name, {}, {}), size);
  } catch (const Error& error) {
    const std::string sentence = error.what();
    require(error.kind() == ErrorKind::unreadable_input || error.kind() == ErrorKind::unusable_mesh);
    require(sentence.starts_with(file_name) && !sentence.ends_with('.') && sentence.size() < 500);
    require(printable(sentence) == sentence);
  }
  return 0;
}

}  // namespace ridgecraft::test
