// SPDX-License-Identifier: GPL-3.0-or-later
// The surface that every stage after mesh/ reads: triangles in flat arrays, immutable, with what is derived
// once.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"

namespace ridgecraft::mesh {

/// Corner k (0, 1, 2) of face f. It also names the side of f that runs from corner k to corner k + 1.
[[nodiscard]] constexpr CornerId corner(FaceId f, unsigned k) {
  return CornerId(3 * f.value() + k);
}
[[nodiscard]] constexpr FaceId face_of(CornerId c) {
  return FaceId(c.value() / 3);
}
[[nodiscard]] constexpr CornerId next(CornerId c) {
  return CornerId(c.value() % 3 == 2 ? c.value() - 2 : c.value() + 1);
}
[[nodiscard]] constexpr CornerId previous(CornerId c) {
  return CornerId(c.value() % 3 == 0 ? c.value() + 2 : c.value() - 1);
}

/// An oriented manifold triangle surface, with or without border, of one or several components.
///
/// Invariants: an edge has one or two faces; two faces run along their edge in
/// opposite directions; no face repeats a vertex; every vertex has at least one face and its faces form one
/// fan. Faces are counterclockwise seen from outside where the surface has an outside. Faces without area are
/// allowed; their normal is the zero vector.
class Surface {
 public:
  Surface() = default;
  /// Takes points and the vertices of each face. O(n log n). The invariants are the caller's duty: check()
  /// tells whether they hold, repair() of mesh/mesh.hpp makes them true of anything. Those about edges are
  /// asserted.
  Surface(std::vector<Vec3> points, std::vector<std::array<VertexId, 3>> faces);
  /// Throws Error(unusable_mesh) with one sentence about the first thing found that keeps these from being a
  /// surface: an invariant that doesn't hold, an index beyond the points, a coordinate that isn't finite.
  /// O(n log n).
  static void check(std::span<const Vec3> points, std::span<const std::array<VertexId, 3>> faces);

  [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
  [[nodiscard]] std::size_t face_count() const { return corners_.size() / 3; }
  [[nodiscard]] std::size_t corner_count() const { return corners_.size(); }
  [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }
  [[nodiscard]] std::size_t component_count() const { return component_count_; }

  [[nodiscard]] Vec3 point(VertexId v) const { return points_[v.value()]; }
  [[nodiscard]] std::span<const Vec3> points() const { return points_; }

  /// The vertex at a corner.
  [[nodiscard]] VertexId vertex(CornerId c) const { return corners_[c.value()]; }
  [[nodiscard]] std::array<VertexId, 3> vertices(FaceId f) const {
    return {corners_[3 * f.value()], corners_[3 * f.value() + 1], corners_[3 * f.value() + 2]};
  }
  /// The other face's side along the same edge (it runs the other way); none at a border.
  [[nodiscard]] CornerId twin(CornerId c) const { return twins_[c.value()]; }
  /// The neighbour across side c; none at a border.
  [[nodiscard]] FaceId neighbor(CornerId c) const {
    const CornerId t = twins_[c.value()];
    return t.valid() ? face_of(t) : FaceId();
  }
  [[nodiscard]] EdgeId edge(CornerId c) const { return corner_edges_[c.value()]; }
  /// The two sides that are this edge, the one with the smaller number first; the second is none at a border.
  [[nodiscard]] std::array<CornerId, 2> sides(EdgeId e) const { return edges_[e.value()]; }
  [[nodiscard]] bool is_border(EdgeId e) const { return !edges_[e.value()][1].valid(); }
  /// The corners at a vertex, one per face around it, in no particular order.
  [[nodiscard]] std::span<const CornerId> corners_at(VertexId v) const {
    return {vertex_corners_.data() + vertex_first_[v.value()],
            vertex_first_[v.value() + 1] - vertex_first_[v.value()]};
  }

  [[nodiscard]] double length(EdgeId e) const { return lengths_[e.value()]; }
  [[nodiscard]] double area(FaceId f) const { return areas_[f.value()]; }
  /// Unit normal; the zero vector for a face without area.
  [[nodiscard]] Vec3 normal(FaceId f) const { return normals_[f.value()]; }
  /// How far the surface is folded along an edge, radians, in [-pi, pi]: 0 where it goes on flat and at
  /// borders, negative on convex edges (mountain folds), positive on concave ones (valley folds); 180 degrees
  /// minus the dihedral angle. 0 next to a face without area.
  [[nodiscard]] double fold_angle(EdgeId e) const { return fold_angles_[e.value()]; }
  [[nodiscard]] ComponentId component(FaceId f) const { return components_[f.value()]; }
  [[nodiscard]] const Box3& bounds() const { return bounds_; }
  /// The box around one face.
  [[nodiscard]] Box3 bounds(FaceId f) const;

 private:
  void connect();
  void measure();
  void find_components();

  std::vector<Vec3> points_;
  std::vector<VertexId> corners_;
  std::vector<CornerId> twins_;
  std::vector<EdgeId> corner_edges_;
  std::vector<std::array<CornerId, 2>> edges_;
  std::vector<std::uint32_t> vertex_first_;
  std::vector<CornerId> vertex_corners_;
  std::vector<double> lengths_;
  std::vector<double> areas_;
  std::vector<Vec3> normals_;
  std::vector<double> fold_angles_;
  std::vector<ComponentId> components_;
  std::size_t component_count_ = 0;
  Box3 bounds_;
};

/// Linear.
[[nodiscard]] double total_area(const Surface& surface);
/// The box of each component, by its number. O(n).
[[nodiscard]] std::vector<Box3> component_bounds(const Surface& surface);

/// In the order given, with the points that they use and no others. O(n log n).
[[nodiscard]] Surface faces_alone(const Surface& surface, const std::vector<FaceId>& faces);

/// What is no farther apart than this touches: paper is about as thick.
inline constexpr double touching_mm = 0.2;

/// A closed border that lies in a plane.
struct Opening {
  std::vector<CornerId> sides;  ///< as they follow each other, each with the face at it
  Vec3 middle;                  ///< of the sides' ends
  Vec3 normal;                  ///< of a face that would close it; it looks out of the surface
};

/// Openings whose ends of sides are no farther from their common plane than `flat_mm`, in the order of their
/// first sides. O(n) for n corners.
[[nodiscard]] std::vector<Opening> flat_openings(const Surface& surface, double flat_mm);

/// Whether the face at a side of an opening rises from its plane by 30 degrees and more: what has such
/// sides stands on what lies below; the others are those of a hole in a flat face, or of a sheet.
[[nodiscard]] bool rises_at(const Surface& surface, const Opening& opening, CornerId side);

/// Triangles that close an opening: from its middle to each side, in their order, where the middle sees all
/// of it, else any. None where its border crosses itself. O(n log n) for n sides.
[[nodiscard]] std::vector<std::array<Vec3, 3>> triangles_of(const Surface& surface, const Opening& opening);

}  // namespace ridgecraft::mesh
