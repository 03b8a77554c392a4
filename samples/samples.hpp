// SPDX-License-Identifier: GPL-3.0-or-later
// The samples, each as a finished shape; the small kit that they are built with, polygons over shared points,
// grown from rings and from each other; and their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::samples {

using Index = std::uint32_t;
using Ring = std::vector<Vec3>;

struct Material {
  std::string name;
  Vec3 colour;  ///< red, green, blue in [0, 1]
};

struct Face {
  std::vector<Index> corners;  ///< counterclockwise from outside
  Index material = 0;
};

/// A model while it is built. Points may repeat: finish() joins them. z is up, the front looks along -y.
class Shape {
 public:
  Index material(const std::string& name, Vec3 colour);
  /// Adds a polygon, counterclockwise seen from outside; returns its number.
  Index face(const Ring& corners, Index material);

  /// The face moves to new corners and is joined to its old place by a wall: an inset, an extrusion, a fin.
  /// The face keeps its number; the walls get the material given.
  void raise(Index face, const Ring& corners, Index wall_material);
  /// The same with all new corners in one point: the face becomes a pyramid.
  void raise_to_point(Index face, Vec3 tip, Index material);
  /// Removes two faces with as many corners and joins their borders through rings of quadrilaterals, given
  /// from one to the other without both ends; corner k of each ring goes with corner k of `from`. The ends of
  /// a handle.
  void bridge(Index from, Index to, const std::vector<Ring>& between, Index material);

  [[nodiscard]] Ring ring(Index face) const;
  [[nodiscard]] Vec3 centre(Index face) const;
  [[nodiscard]] Vec3 normal(Index face) const;
  void set_material(Index face, Index material) { faces_[face].material = material; }
  [[nodiscard]] Index face_count() const { return static_cast<Index>(faces_.size()); }

  /// Adds the mirror image on the other side of the plane x = 0.
  void mirror_x();
  /// Adds another shape.
  void add(const Shape& other);
  /// Calls move(Vec3) -> Vec3 for all points.
  template <typename Move>
  void transform(const Move& move) {
    for (Vec3& p : points_) {
      p = move(p);
    }
  }

  /// Rounds to the digits that files have, joins equal points, drops corners and faces that vanish by that,
  /// and splits polygons that aren't plane along the diagonal that makes a mountain.
  void finish();

  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<Material>& materials() const { return materials_; }

 private:
  void join_equal_points();
  void split_bent_faces();

  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::vector<Material> materials_;
};

/// Faces of a strip grid: face(i, k) is between ring i and ring i + 1, at corner k of the rings.
struct Grid {
  Index first = 0;
  Index columns = 0;

  [[nodiscard]] Index face(std::size_t i, std::size_t k) const {
    return first + static_cast<Index>(i) * columns + static_cast<Index>(k);
  }
};

/// Joins rings with equal numbers of points, one after the other, by quadrilaterals. `closed` rings go round,
/// open ones have a strip less. Seen from outside, with the rings following each other to the right, the
/// points of a ring run upwards. A ring whose points are all equal is a tip.
Grid loft(Shape& shape, const std::vector<Ring>& rings, bool closed, Index material);

/// A profile (radius, height) turned about the z axis, from below on the outside to above; corners of the
/// rings start at `start` radians and go round counterclockwise.
Grid revolve(Shape& shape, const std::vector<Vec2>& profile, int steps, Index material, double start = 0.0);

/// A regular ring about the z axis.
[[nodiscard]] Ring circle(double radius, double height, int steps, double start = 0.0);
[[nodiscard]] Ring reversed(Ring ring);
/// Each point p becomes centre + factor * (p - centre) + shift.
[[nodiscard]] Ring scaled(const Ring& ring, Vec3 centre, double factor, Vec3 shift = {});
[[nodiscard]] Ring shifted(const Ring& ring, Vec3 by);
/// The part of a quadrilateral between two corners of the unit square; (0, 0) is its first corner, (1, 0) its
/// second.
[[nodiscard]] Ring patch(const Ring& quad, Vec2 low, Vec2 high);
[[nodiscard]] Vec3 mean(const Ring& ring);

// The samples, each as a finished shape.

// animals.cpp
[[nodiscard]] Shape whale();
[[nodiscard]] Shape fish();
[[nodiscard]] Shape dinosaur();
[[nodiscard]] Shape penguin();
[[nodiscard]] Shape fox_head();
// things.cpp
[[nodiscard]] Shape rocket();
[[nodiscard]] Shape mug();
[[nodiscard]] Shape vase();
[[nodiscard]] Shape chess_rook();
[[nodiscard]] Shape torus();
[[nodiscard]] Shape heart();
[[nodiscard]] Shape house();
[[nodiscard]] Shape lighthouse();
[[nodiscard]] Shape gem();
[[nodiscard]] Shape star();
[[nodiscard]] Shape packaging_box();  ///< the only one with a border

struct Sample {
  const char* file;  ///< its suffix says the format
  Shape (*make)();
  bool closed = true;  ///< a surface without border
};

/// All of them.
[[nodiscard]] std::span<const Sample> all();

// Finished shapes as files: OBJ with its materials, binary STL, ASCII PLY and OFF with colours.

/// Writes the shape in the format of the file's suffix (.obj, .stl, .ply, .off); an OBJ's materials go to a
/// file next to it. The same bytes on every machine. Throws std::runtime_error where a file can't be written.
void write_model(const Shape& shape, const std::filesystem::path& file);

}  // namespace ridgecraft::samples
