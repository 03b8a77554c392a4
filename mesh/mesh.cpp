// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/read_soup.hpp"
#include "mesh/repair/repair.hpp"

namespace ridgecraft::mesh {

Model read(const std::filesystem::path& file, const ReadOptions& options, const Context& context) {
  context.report("reading", 0.0);
  return read(ModelFile{.bytes = read_file(file),
                        .name = file.string(),
                        .title = file.stem().string(),
                        .folder = file.has_parent_path() ? file.parent_path() : "."},
              options, context);
}

Model read(const ModelFile& file, const ReadOptions& options, const Context& context) {
  context.report("reading", 0.0);
  Soup soup = parse_soup(file.bytes, file.name, file.folder, context, options.importer);
  context.report("repairing", 0.0);
  const std::string beside = std::move(soup.beside_digest);
  try {
    Model model = repair(std::move(soup), options, context);
    model.name = printable(file.title);
    model.digest = digest(file.bytes);
    if (!beside.empty()) {
      model.digest = digest(model.digest + beside);
    }
    return model;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::unusable_mesh) {
      throw;
    }
    const std::string name = printable(file.name);
    throw Error(ErrorKind::unusable_mesh, name + " can't be used: " + error.what(), name);
  }
}

namespace {

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorKind::unusable_mesh, sentence);
}

void require_points(std::span<const Vec3> points) {
  if (points.size() >= Soup::none) {
    refuse(fmt::format("{} points are more than can be numbered", points.size()));
  }
  const auto bad = std::find_if_not(points.begin(), points.end(), is_finite);
  if (bad != points.end()) {
    refuse(fmt::format("point {} has a coordinate that is no finite number", bad - points.begin()));
  }
}

/// Adds the bytes of numbers to a text that a digest is made of.
template <class Number>
void add_bytes(std::span<const Number> numbers, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

std::string digest_of(const Soup& soup) {
  std::string bytes;
  add_bytes(std::span<const Vec3>(soup.points), bytes);
  add_bytes(std::span<const std::uint32_t>(soup.first_corner), bytes);
  add_bytes(std::span<const std::uint32_t>(soup.corner_point), bytes);
  return digest(bytes);
}

/// `Polygon`: a range of indices.
template <class Polygon>
Model repair_polygons(std::span<const Vec3> points, std::span<const Polygon> polygons,
                      const ReadOptions& options, const Context& context) {
  require_points(points);
  Soup soup;
  soup.points.assign(points.begin(), points.end());
  soup.first_corner.reserve(polygons.size() + 1);
  for (const Polygon& polygon : polygons) {
    for (const std::uint32_t corner : polygon) {
      if (corner >= points.size()) {
        refuse(fmt::format("polygon {} names point {}, and there are {}", soup.polygon_count(), corner,
                           points.size()));
      }
      soup.corner_point.push_back(corner);
    }
    if (soup.corner_point.size() >= Soup::none) {
      refuse("the polygons have more corners than can be numbered");
    }
    soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
  }
  context.report("repairing", 0.0);
  const std::string digest = digest_of(soup);
  Model model = repair(std::move(soup), options, context);
  model.digest = digest;
  return model;
}

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

/// Points and faces of PLY and OFF alike.
void append_text_body(std::string& text, const Surface& surface, const FaceColours& colours) {
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
}

}  // namespace

Model repair(std::span<const Vec3> points, std::span<const std::vector<std::uint32_t>> polygons,
             const ReadOptions& options, const Context& context) {
  return repair_polygons(points, polygons, options, context);
}

Model repair(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles,
             const ReadOptions& options, const Context& context) {
  return repair_polygons(points, triangles, options, context);
}

std::string write_ply(const Surface& surface, const FaceColours& colours, PlyKind kind) {
  check(surface, colours);
  std::string bytes = ply_header(surface, !colours.empty(), kind);
  if (kind == PlyKind::binary) {
    append_binary_body(bytes, surface, colours);
    return bytes;
  }
  append_text_body(bytes, surface, colours);
  return bytes;
}

std::string write_off(const Surface& surface, const FaceColours& colours) {
  check(surface, colours);
  std::string text =
      fmt::format("OFF\n{} {} {}\n", surface.vertex_count(), surface.face_count(), surface.edge_count());
  append_text_body(text, surface, colours);
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
