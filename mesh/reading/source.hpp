// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of all formats have in common: what they read, how they refuse it and count what they
// ignore; objects that a file says once and has many times; colours and materials.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/vector.hpp"
#include "mesh/model/soup.hpp"

namespace ridgecraft::mesh {

/// A texture coordinate beyond this many repetitions of the picture is taken for a mistake.
inline constexpr double largest_texture_coordinate = 1e4;
/// More corners of faces than this are refused (2^31): indices of corners are 32 bits wide.
inline constexpr std::uint64_t largest_corner_count = std::uint64_t{1} << 31U;

/// A file in memory.
struct Source {
  std::string_view bytes;
  std::string file;              ///< its name as messages print it
  std::filesystem::path folder;  ///< where its material files are looked for; empty for nowhere
  const Context& context;
  std::filesystem::path importer = {};  ///< as ReadOptions::importer

  /// Number of the line that a place in the bytes is on, from 1. Linear: for messages only.
  [[nodiscard]] std::size_t line(const char* place) const;
  /// Throws with "FILE REASON".
  [[noreturn]] void refuse(ErrorKind kind, std::string_view reason) const;
  /// Throws with "FILE, byte N: REASON", for binary files.
  [[noreturn]] void refuse_byte(ErrorKind kind, const char* place, std::string_view reason) const;
  /// Throws with "FILE, line N: REASON".
  [[noreturn]] void refuse_line(ErrorKind kind, const char* place, std::string_view reason) const;
};

/// Counts what a reader ignores and remembers where it was first, so that the line is worked out once only.
struct Tally {
  std::size_t count = 0;
  const char* first = nullptr;

  void add(const char* place) {
    if (count++ == 0) {
      first = place;
    }
  }
  void report(RepairKind kind, const Source& source, RepairReport& report) const;
};

/// Throws where a soup has more corners than can be numbered.
void check_corner_count(const Source& source, const Soup& soup);

/// Zero bytes and DOS end marks after a text belong to no mesh: the text without them; they are remarked on.
[[nodiscard]] std::string_view without_trailing_zeros(std::string_view text, RepairReport& remarks);

// One reader per format.

// Each takes bytes that detect_format() found to be of its format and fills the whole soup.
[[nodiscard]] Soup read_obj(const Source& source);
[[nodiscard]] Soup read_stl_ascii(const Source& source);
[[nodiscard]] Soup read_stl_binary(const Source& source);
[[nodiscard]] Soup read_ply(const Source& source);
[[nodiscard]] Soup read_off(const Source& source);
[[nodiscard]] Soup read_gltf(const Source& source);
[[nodiscard]] Soup read_glb(const Source& source);
[[nodiscard]] Soup read_3mf(const Source& source);
[[nodiscard]] Soup read_pdo(const Source& source);
/// Formats that Assimp reads: by Source::importer.
[[nodiscard]] Soup read_imported(FileFormat format, const Source& source);

// Sizes of a binary STL file: 80 bytes of anything, a count, then facets of a normal, three corners and two
// bytes.

inline constexpr std::size_t stl_header_size = 84;
inline constexpr std::size_t stl_facet_size = 50;

/// The count in the header of at least stl_header_size bytes.
[[nodiscard]] std::uint32_t stl_facet_count(std::string_view bytes);

[[nodiscard]] constexpr std::uint64_t stl_file_size(std::uint64_t facets) {
  return stl_header_size + stl_facet_size * facets;
}

/// The keyword that a word begins with: "OFF", in letters of either case, with the prefixes of the format's
/// description (Geomview): [ST][C][N][4][n]OFF. Only a number or a comment may follow it. Empty where there
/// is none.
[[nodiscard]] std::string_view off_keyword(std::string_view word);

/// What somebody can do with a file of a format that only Assimp reads.
[[nodiscard]] std::string_view way_by_blender();

// Formats in which a file may say once what it has many times: a few lines could make more faces than any
// memory holds.

/// So many triangles may come from repetitions alone; no paper model is near it.
inline constexpr std::uint64_t largest_repeated_count = 2'000'000;

/// Refuses a file whose objects, repeated, have more points or corners than its bytes could hold, and than
/// largest_repeated_count triangles have. `held` are the bytes, unpacked; `points` and `corners` what the
/// soup would have.
void check_repetitions(const Source& source, std::uint64_t held, std::uint64_t points, std::uint64_t corners);

/// Appends a triangle: indices into the points of the soup, and into its texture points where it has some.
void add_triangle(Soup& soup, std::array<std::uint32_t, 3> points,
                  const std::optional<std::array<std::uint32_t, 3>>& texture);

/// A polygon has texture coordinates at all of its corners or at none: the rest couldn't be drawn. Those with
/// a corner that is `bad`, or beyond the texture points, are remarked on.
void complete_textures(Soup& soup, const std::vector<bool>& bad);

/// What a soup lacks at the end: texture corners, colours and materials of the last faces; names, where none
/// says anything, go.
void complete(Soup& soup);

// Where a file puts an object: turned, scaled, sheared, mirrored and moved.

/// p goes to (rows[0] . p, rows[1] . p, rows[2] . p) + shift.
struct Affine {
  std::array<Vec3, 3> rows{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  Vec3 shift;

  [[nodiscard]] constexpr Vec3 turn(Vec3 p) const {
    return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
  }
  [[nodiscard]] constexpr Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
  /// True where it turns the outside of a surface inside.
  [[nodiscard]] constexpr bool mirrors() const { return dot(rows[0], cross(rows[1], rows[2])) < 0.0; }

  friend constexpr bool operator==(const Affine&, const Affine&) = default;
};

/// First b, then a.
[[nodiscard]] constexpr Affine operator*(const Affine& a, const Affine& b) {
  Affine both;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 row = a.rows[i];
    both.rows[i] = row.x * b.rows[0] + row.y * b.rows[1] + row.z * b.rows[2];
  }
  both.shift = a(b.shift);
  return both;
}

// Colours that a file gives point by point (PLY, OFF) or corner by corner (glTF, 3MF).

/// Channels outside [0, 1] are brought into it; NaN is 1.
[[nodiscard]] Colour in_range(Colour colour);

/// 0xRRGGBB of the colour in_range().
[[nodiscard]] std::uint32_t packed_colour(const Colour& colour);

/// Each corner takes the colour of its point. `of_point` holds one for each point, or is empty, which changes
/// nothing.
void colour_corners(Soup& soup, const std::vector<std::uint32_t>& of_point);

/// The last three corners have these colours; corners before that have none stay so.
void colour_last_triangle(Soup& soup, const std::array<std::uint32_t, 3>& colours);

// Materials of formats whose faces may have a colour of their own besides: one for each pair that is
// different.

/// A colour in 256 steps a channel, as files and screens have it.
using ColourBytes = std::array<std::uint8_t, 3>;

[[nodiscard]] constexpr Colour colour_of(ColourBytes bytes) {
  return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0};
}

class MaterialTable {
 public:
  /// Paints the soup's last polygon. `id` is the number that the file gives to the material, Soup::none for
  /// none; `material` is called for its value the first time. A colour of the face's own takes the place of
  /// the material's.
  template <class MaterialOf>
  void paint(Soup& soup, std::uint32_t id, std::optional<ColourBytes> own, const MaterialOf& material) {
    if (id == Soup::none && !own) {
      return;
    }
    const auto [found, fresh] = number_.try_emplace({id, own}, static_cast<std::uint32_t>(number_.size()));
    if (fresh) {
      soup.materials.push_back(id == Soup::none ? Material{} : material(id));
      finish(soup.materials.back(), own, found->second);
    }
    soup.polygon_material.resize(soup.polygon_count() - 1, Soup::none);
    soup.polygon_material.push_back(found->second);
  }

 private:
  static void finish(Material& material, std::optional<ColourBytes> own, std::uint32_t number);

  std::map<std::pair<std::uint32_t, std::optional<ColourBytes>>, std::uint32_t> number_;
};

}  // namespace ridgecraft::mesh
