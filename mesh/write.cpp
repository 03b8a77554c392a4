// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/write.hpp"

#include <bit>
#include <iterator>

#include <fmt/format.h>

#include "base/error.hpp"

namespace ridgecraft::mesh {
namespace {

void check(const Surface& surface, const FaceColours& colours) {
  RIDGECRAFT_ASSERT(colours.empty() || colours.size() == surface.face_count());
}

/// Three numbers with the fewest digits that read back as the same doubles.
void append_point(std::string& text, Vec3 p) {
  fmt::format_to(std::back_inserter(text), "{} {} {}\n", p.x, p.y, p.z);
}

/// Three numbers of a face's corners, counted from `first`.
void append_corners(std::string& text, const Surface& surface, FaceId f, std::uint32_t first) {
  const auto [a, b, c] = surface.vertices(f);
  fmt::format_to(std::back_inserter(text), "{} {} {}", a.value() + first, b.value() + first,
                 c.value() + first);
}

void append_colour(std::string& text, const ByteColour& colour) {
  fmt::format_to(std::back_inserter(text), " {} {} {}", colour[0], colour[1], colour[2]);
}

template <class Unsigned>
void append_bytes(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

std::string ply_header(const Surface& surface, bool coloured, PlyKind kind) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\n{}end_header\n",
      kind == PlyKind::ascii ? "ascii" : "binary_little_endian", surface.vertex_count(), surface.face_count(),
      coloured ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
}

void append_binary_body(std::string& bytes, const Surface& surface, const FaceColours& colours) {
  bytes.reserve(bytes.size() + 24 * surface.vertex_count() + 16 * surface.face_count());
  for (const Vec3 p : surface.points()) {
    for (const double coordinate : {p.x, p.y, p.z}) {
      append_bytes(bytes, std::bit_cast<std::uint64_t>(coordinate));
    }
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    append_bytes(bytes, std::uint8_t{3});
    for (const VertexId v : surface.vertices(f)) {
      append_bytes(bytes, v.value());
    }
    if (!colours.empty()) {
      for (const std::uint8_t channel : colours[f]) {
        append_bytes(bytes, channel);
      }
    }
  }
}

}  // namespace

std::string write_ply(const Surface& surface, const FaceColours& colours, PlyKind kind) {
  check(surface, colours);
  std::string bytes = ply_header(surface, !colours.empty(), kind);
  if (kind == PlyKind::binary) {
    append_binary_body(bytes, surface, colours);
    return bytes;
  }
  for (const Vec3 p : surface.points()) {
    append_point(bytes, p);
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    bytes += "3 ";
    append_corners(bytes, surface, f, 0);
    if (!colours.empty()) {
      append_colour(bytes, colours[f]);
    }
    bytes += '\n';
  }
  return bytes;
}

std::string write_off(const Surface& surface, const FaceColours& colours) {
  check(surface, colours);
  std::string text =
      fmt::format("OFF\n{} {} {}\n", surface.vertex_count(), surface.face_count(), surface.edge_count());
  for (const Vec3 p : surface.points()) {
    append_point(text, p);
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    text += "3 ";
    append_corners(text, surface, f, 0);
    if (!colours.empty()) {
      append_colour(text, colours[f]);
    }
    text += '\n';
  }
  return text;
}

std::string write_obj(const Surface& surface) {
  std::string text;
  for (const Vec3 p : surface.points()) {
    text += "v ";
    append_point(text, p);
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    text += "f ";
    append_corners(text, surface, f, 1);
    text += '\n';
  }
  return text;
}

}  // namespace ridgecraft::mesh
