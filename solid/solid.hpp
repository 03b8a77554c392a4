// SPDX-License-Identifier: GPL-3.0-or-later
// What nearly convex parts are good for besides paper: hulls for physics engines, cages, watertight shells.
// Read this header first.
//
//   Surface + Segmentation --hulls--> one convex Body per part
//   Bodies --cage--> one closed Body around them        Surface --shell--> one closed Body around it
//   points + cage before + cage after --deform--> points
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::solid {

/// A closed triangle mesh, counterclockwise seen from outside.
struct Body {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The faces of a surface, which encloses something or doesn't.
[[nodiscard]] Body body_of(const mesh::Surface& surface);

/// Mass properties at density 1, in the points' unit.
struct MassProperties {
  double volume = 0.0;
  Vec3 center;
  /// About the centre: xx, yy, zz, xy, xz, yz, with the signs of the inertia tensor.
  std::array<double, 6> inertia{};
};

/// By signed tetrahedra from the origin. O(n).
[[nodiscard]] MassProperties mass_properties(const Body& body);
/// Of the union of convex bodies, on rays: within a few thousandths.
[[nodiscard]] MassProperties union_properties(const std::vector<Body>& bodies, const Context& context);

/// Of what the closed components of a surface enclose, in its unit: exact where they share no space, else on
/// rays. None where none is closed.
[[nodiscard]] std::optional<MassProperties> mass_properties(const mesh::Surface& surface,
                                                            const Context& context);

/// Hulls leave no larger share of a solid uncovered.
inline constexpr double most_uncovered = 1e-3;

/// How many and how large hulls may be: physics engines have limits.
struct HullOptions {
  /// No hull has more vertices; at least 8. 0: as many as it takes.
  std::size_t max_vertices = 0;
  /// There are no more hulls: the ones whose joint hull adds least air are joined. 0: as many as it takes.
  std::size_t max_hulls = 0;
};

/// How well hulls stand for the solid that the closed components of a model enclose, measured on rays.
struct Fit {
  double solid_volume = 0.0;  ///< 0 where no component is closed: nothing is known then
  double union_volume = 0.0;  ///< of all hulls
  double uncovered = 0.0;     ///< share of the solid in no hull
};

/// A model's hulls, and what is known of them together.
struct HullSet {
  std::vector<Body> bodies;
  Fit fit;
  std::size_t filling = 0;  ///< bodies that were added for what parts' hulls leave uncovered
  bool of_cuts = false;     ///< bodies are hulls of what planes cut off, not of parts
};

/// Hulls for a model: as many as its parts, and more where the parts' hulls leave more than `most_uncovered`
/// of what it encloses in none (parts are sets of faces: the walls of a box may be parts by themselves). They
/// are those of the parts, or of as many pieces that planes cut off the solid where these hold less air.
/// Every vertex is in them, whatever the limits.
[[nodiscard]] HullSet model_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                                  const HullOptions& options, const Context& context);

/// One convex body per part, in the parts' order, that encloses every point of the part, also as rounded
/// doubles. Up to max_vertices it is the part's convex hull, else a polytope around that, of planes that
/// touch the hull, each put where the body so far stood out farthest. The same hulls give the same bytes. A
/// part without volume gets a thickness of 1e-4 of the surface's diagonal. O(n log n) for a part of n
/// vertices, plus O(max_vertices * hull size).
[[nodiscard]] std::vector<Body> part_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                                           const HullOptions& options, const Context& context);

/// How coarse a cage is.
struct CageOptions {
  /// At most this many faces, where the shape allows it; at least 20.
  std::size_t faces = 500;
};

/// A closed, manifold surface around all bodies: their union, slightly expanded and coarsened, by alpha
/// wrapping (Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner, Alliez, "Alpha wrapping with an offset", ACM
/// Transactions on Graphics 41(4), 2022; CGAL). The probe's size is searched for until the number of faces is
/// just below the one asked for.
[[nodiscard]] Body cage(const std::vector<Body>& bodies, const CageOptions& options, const Context& context);

/// How closely a shell follows.
struct ShellOptions {
  /// Openings and gaps narrower than this are closed, as a share of the bounding box's diagonal; in (0, 1].
  double opening = 0.05;
  /// Distance from the surface at which the shell lies, as a share of the diagonal; in (0, 0.1].
  double offset = 0.002;
};

/// A closed, manifold surface around a broken one, by the same method.
[[nodiscard]] Body shell(const mesh::Surface& surface, const ShellOptions& options, const Context& context);

/// Where points go when the cage around them goes from `before` to `after` (same triangles, at least 4): mean
/// value coordinates (Ju, Schaefer, Warren, "Mean value coordinates for closed triangular meshes", SIGGRAPH
/// 2005). They reproduce every affine map. O(points * cage faces).
[[nodiscard]] std::vector<Vec3> deform(std::span<const Vec3> points, const Body& before, const Body& after,
                                       const Context& context);

// Whether a cage that somebody brings can hold a model: closed, and around it.

/// Throws Error(unusable_mesh) with a sentence that names the file and the first place, unless each edge of
/// the cage lies between two triangles that run along it in opposite directions. Points in one place count as
/// one, since many formats write each triangle with points of its own. O(n log n).
void require_closed(const std::string& file, const solid::Body& cage);

/// How many of the points lie outside a closed cage; on it is not outside. Winding numbers from solid angles
/// (van Oosterom, Strackee, "The solid angle of a plane triangle", IEEE Transactions on Biomedical
/// Engineering 30(2), 1983), so bodies of one cage may overlap. O(points * cage faces), as the deformation
/// itself.
[[nodiscard]] std::size_t count_outside(std::span<const Vec3> points, const solid::Body& cage,
                                        const Context& context);

// Bodies as files.

/// OBJ with one object per body, named hull_1, hull_2, ...; every bit of the coordinates is kept. `comment`
/// becomes the first line.
[[nodiscard]] std::string write_obj(const std::vector<Body>& bodies, std::string_view comment);

/// What a description of a rigid body says in addition to its shape. Paths are as the reader of the
/// description resolves them; lengths of the meshes are multiplied by `metres_per_unit`.
struct RigidBody {
  std::string name;
  std::string comment;
  std::string visual_file;
  std::vector<std::string> mesh_files;  ///< convex, one for each collision element
  double metres_per_unit = 0.001;
  double density = 1000.0;  ///< kg/m^3
  MassProperties mass;      ///< of the solid, at density 1, in the meshes' unit
};

// Descriptions that name mesh files: a visual one, and one a hull.

/// URDF (ROS): a link.
[[nodiscard]] std::string write_urdf(const RigidBody& body);
/// MJCF (MuJoCo): a body with a free joint. MuJoCo takes the hull of each mesh, which is what the mesh is.
[[nodiscard]] std::string write_mjcf(const RigidBody& body);
/// SDFormat 1.9 (Gazebo): a model with a link.
[[nodiscard]] std::string write_sdf(const RigidBody& body);

// Files that hold the meshes: the names of mesh files don't count.

/// USD as text with UsdPhysics (Isaac Sim, Newton): a rigid body, a mesh to be seen, and a guide mesh a hull
/// that stands for itself as a convex hull. Lengths are the meshes'; the stage says how many metres they are.
[[nodiscard]] std::string write_usd(const RigidBody& body, const Body& visual,
                                    const std::vector<Body>& hulls);
/// GLB with KHR_physics_rigid_bodies: a node that moves, a mesh to be seen, and a collider a hull, whose mesh
/// no scene shows. Metres, as glTF has them, in single precision.
[[nodiscard]] std::string write_glb(const RigidBody& body, const Body& visual,
                                    const std::vector<Body>& hulls);

/// Principal moments of inertia, ascending, and the rotation from their axes to the body's: w, x, y, z.
struct PrincipalInertia {
  std::array<double, 3> moments{};
  std::array<double, 4> rotation{1.0, 0.0, 0.0, 0.0};
};
/// `inertia`: xx, yy, zz, xy, xz, yz.
[[nodiscard]] PrincipalInertia principal_inertia(const std::array<double, 6>& inertia);

}  // namespace ridgecraft::solid
