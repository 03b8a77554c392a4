// SPDX-License-Identifier: GPL-3.0-or-later
// A model: its surface, where each face came from, and what was done to it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// Colours that the corners of a file's polygons have, polygon by polygon; whatever becomes of the faces,
/// they know their polygon.
struct CornerColours {
  std::vector<std::uint32_t> first_corner;  ///< as Soup::first_corner
  std::vector<Vec3> point;                  ///< of each corner, in the frame of the surface
  std::vector<std::uint32_t> colour;        ///< as Soup::corner_colour
};

/// A model as it was read and repaired: its surface, and what else its file says.
struct Model {
  std::string name;    ///< the file's name without folder and suffix, valid UTF-8
  std::string digest;  ///< 16 hexadecimal digits, hash of the file's bytes; marks what is made from it
  FileFrame frame;     ///< what the file says of its unit and of where up is
  Surface surface;     ///< in the file's unit (after prepare::prepare: in mm)
  FileFormat format = FileFormat::obj;  ///< that the file was read as, whatever it is called

  /// Per face: the polygon of the file that it is part of, counted from 0 in the file's order; Soup::none
  /// where a repair or simplification made a face of no polygon.
  IdVector<FaceId, std::uint32_t> polygon;
  std::size_t polygon_count = 0;  ///< polygons in the file, those that repair dropped included

  std::vector<Material> materials;
  /// Per face: index into materials or Soup::none; empty when no face has one.
  IdVector<FaceId, std::uint32_t> material;
  /// Per face: texture coordinates of its corners, as read; empty when the model has none. Steps that change
  /// faces drop them: what the surface looks like is kept by mesh/look.
  IdVector<FaceId, std::array<Vec2, 3>> texture;
  /// As the file was read: preparing the model doesn't move them. Null when no corner has a colour.
  std::shared_ptr<const CornerColours> corner_colours;

  /// Names that the file has for its objects, each once, in the file's order; none is empty.
  std::vector<std::string> objects;
  /// Per face: index into objects or Soup::none; empty when no face has one. Like its material a face keeps
  /// it through everything that is done to the model's faces.
  IdVector<FaceId, std::uint32_t> object;

  /// Edges that the file marks (Soup::lines), from point to point; they needn't be edges of the surface any
  /// more.
  std::vector<std::array<Vec3, 2>> lines;
  /// The points of the file in its order; empty unless ReadOptions asks for them. Like lines and the
  /// surface's points they are in the surface's frame, whatever repair made of them.
  std::vector<Vec3> file_points;

  /// A point of the surface times this is a point of the file. An exact power of two, and 1 unless the file's
  /// numbers are so large or so small that their products would leave the range of a double.
  double file_scale = 1.0;

  RepairReport repairs;

  /// What the file calls the object that a face belongs to; empty where it has no name for it.
  [[nodiscard]] std::string object_name(FaceId f) const {
    return object.empty() || object[f] == Soup::none ? std::string() : objects[object[f]];
  }
};

/// What repair does where the jobs differ.
struct ReadOptions {
  /// Collapse faces without area. Paper can't hold them; segmentation keeps them, since dropping them opens
  /// closed surfaces.
  bool collapse_flat_faces = true;
  bool keep_points = false;  ///< fill Model::file_points
  /// The program that reads formats by Assimp (import/); empty: they are refused.
  std::filesystem::path importer = {};
};

// From a model's frame back to the numbers of its file, for whoever writes meshes.

/// Points in the frame of a model's surface become points of its file: repair divides extreme coordinates by
/// `file_scale` (Model::file_scale). Exact, since that is a power of two.
void to_file_numbers(std::vector<Vec3>& points, double file_scale);

/// The model's surface as its file has it.
[[nodiscard]] Surface surface_in_file_numbers(const Model& model);

}  // namespace ridgecraft::mesh
