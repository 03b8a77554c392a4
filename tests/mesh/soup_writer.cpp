// SPDX-License-Identifier: GPL-3.0-or-later
#include "soup_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>

namespace ridgecraft::test {
namespace {

std::string decimal(Vec3 p) {
  char text[100];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
  return text;
}

template <class Unsigned>
void append_bytes(std::string& bytes, Unsigned value, bool big_endian) {
  std::string more;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    more += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
  if (big_endian) {
    std::reverse(more.begin(), more.end());
  }
  bytes += more;
}

std::string obj(const mesh::Soup& soup) {
  std::string text;
  for (const Vec3 p : soup.points) {
    text += "v " + decimal(p);
  }
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    text += 'f';
    for (const std::uint32_t p : soup.polygon(i)) {
      // All forms in turn; what stands after the slashes refers to texture points that aren't there or to
      // normals.
      text += ' ' + (p % 3 == 0
                         ? std::to_string(p + 1) + "//7"
                         : std::to_string(std::int64_t{p} - static_cast<std::int64_t>(soup.points.size())));
    }
    text += '\n';
  }
  return text;
}

std::string indexed_text(const mesh::Soup& soup) {
  std::string text;
  for (const Vec3 p : soup.points) {
    text += decimal(p);
  }
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    text += std::to_string(soup.polygon(i).size());
    for (const std::uint32_t p : soup.polygon(i)) {
      text += ' ' + std::to_string(p);
    }
    text += '\n';
  }
  return text;
}

std::string ply(const mesh::Soup& soup, SoupFormat format) {
  const bool big_endian = format == SoupFormat::ply_big_endian;
  std::string bytes = format == SoupFormat::ply_ascii ? "ply\nformat ascii 1.0\n"
                      : big_endian                    ? "ply\nformat binary_big_endian 1.0\n"
                                                      : "ply\nformat binary_little_endian 1.0\n";
  bytes += "element vertex " + std::to_string(soup.points.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
           std::to_string(soup.polygon_count()) + "\nproperty list ushort uint vertex_index\nend_header\n";
  if (format == SoupFormat::ply_ascii) {
    return bytes + indexed_text(soup);
  }
  for (const Vec3 p : soup.points) {
    for (const double coordinate : {p.x, p.y, p.z}) {
      append_bytes(bytes, std::bit_cast<std::uint64_t>(coordinate), big_endian);
    }
  }
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    append_bytes(bytes, static_cast<std::uint16_t>(soup.polygon(i).size()), big_endian);
    for (const std::uint32_t p : soup.polygon(i)) {
      append_bytes(bytes, p, big_endian);
    }
  }
  return bytes;
}

std::string stl_ascii(const mesh::Soup& soup) {
  std::string text = "solid test\n";
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t p : soup.polygon(i)) {
      text += "vertex " + decimal(soup.points[p]);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid test\n";
}

std::string stl_binary(const mesh::Soup& soup) {
  std::string bytes(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(soup.polygon_count()), false);
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    bytes += std::string(12, '\0');
    for (const std::uint32_t p : soup.polygon(i)) {
      for (const double coordinate : {soup.points[p].x, soup.points[p].y, soup.points[p].z}) {
        append_bytes(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(coordinate)), false);
      }
    }
    bytes += "ab";
  }
  return bytes;
}

}  // namespace

std::string written(const mesh::Soup& soup, SoupFormat format) {
  switch (format) {
    case SoupFormat::obj:
      return obj(soup);
    case SoupFormat::off:
      return "OFF\n" + std::to_string(soup.points.size()) + ' ' + std::to_string(soup.polygon_count()) +
             " 0\n" + indexed_text(soup);
    case SoupFormat::stl_ascii:
      return stl_ascii(soup);
    case SoupFormat::stl_binary:
      return stl_binary(soup);
    default:
      return ply(soup, format);
  }
}

}  // namespace ridgecraft::test
