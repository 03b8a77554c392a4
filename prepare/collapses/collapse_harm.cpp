// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/collapse_harm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/elementary.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {
namespace {

/// A face may turn by at most this much in one collapse.
const double turn_cosine = elementary::cos(75.0 * std::numbers::pi / 180.0);
/// Neighbours may not fold back onto each other further than this where they didn't before: paper can't be
/// folded shut.
const double fold_cosine = elementary::cos(160.0 * std::numbers::pi / 180.0);
/// Smallest height over longest side of a new face where the old faces weren't worse.
constexpr double thinnest_face = 0.02;
/// The same for the triangles of a wall, which are one face on paper: all they need is an area.
constexpr double thinnest_in_wall = 1e-4;

/// The thinnest of some faces before and after a change: height over longest side.
struct Worst {
  double limit = 0.0;
  double before = 1.0;
  double after = 1.0;
  [[nodiscard]] bool is_allowed() const { return after >= limit || after >= before; }
};

/// Height over longest side.
double height_share(Vec3 a, Vec3 b, Vec3 c, double doubled) {
  const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return longest > 0.0 ? doubled / longest : 0.0;
}

Vec3 outer_normal(const EditMesh& mesh, EditMesh::HalfedgeHandle side, EditMesh::VertexHandle v0,
                  EditMesh::VertexHandle v1) {
  const auto opposite = mesh.opposite_halfedge_handle(side);
  if (mesh.is_boundary(opposite)) {
    return {};
  }
  const auto tip = mesh.to_vertex_handle(mesh.next_halfedge_handle(opposite));
  if (tip == v0 || tip == v1) {
    return {};
  }
  const Vec3 a = to_vector(mesh.point(mesh.from_vertex_handle(opposite)));
  const Vec3 b = to_vector(mesh.point(mesh.to_vertex_handle(opposite)));
  return normalized(cross(b - a, to_vector(mesh.point(tip)) - a));
}

/// Crossings that go along with the change move faces that it doesn't touch: would one of these be turned?
bool turns_beside_crossings(const EditMesh& mesh, const PlanePoints& bound, const Change& change) {
  const auto turns = [&](EditMesh::FaceHandle f) {
    std::array<Vec3, 3> before;
    std::array<Vec3, 3> after;
    std::size_t k = 0;
    for (const auto w : mesh.fv_range(f)) {
      if (change.moves(w)) {
        return false;
      }
      before[k] = bound.at(mesh, w, nullptr);
      after[k++] = bound.at(mesh, w, &change);
    }
    const Vec3 old_normal = normalized(cross(before[1] - before[0], before[2] - before[0]));
    const Vec3 new_normal = normalized(cross(after[1] - after[0], after[2] - after[0]));
    return old_normal != Vec3{} && new_normal != Vec3{} && dot(old_normal, new_normal) < turn_cosine;
  };
  for (const auto v : {change.v0, change.v1}) {
    for (const auto w : mesh.vv_range(v)) {
      if (bound.follows(w, change)) {
        for (const auto f : mesh.vf_range(w)) {
          if (turns(f)) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

/// Cosine between a normal and its mirror image.
double with_image(const MirrorPlane& plane, Vec3 normal) {
  const double across = dot(plane.normal, normal);
  return dot(normal, normal) - 2.0 * across * across;
}

/// Would an edge of the new faces be folded back further than allowed and than the worst was before?
bool folds_back(const std::vector<Rim>& rim, const MirrorPlane* plane) {
  double before = 1.0;
  double after = 1.0;
  for (const Rim& f : rim) {
    if (f.was_at_plane) {
      before = std::min(before, with_image(*plane, f.old_normal));
    }
    if (f.at_plane) {
      after = std::min(after, with_image(*plane, f.new_normal));
    }
    if (f.outer_normal != Vec3{}) {
      before = std::min(before, dot(f.old_normal, f.outer_normal));
      after = std::min(after, dot(f.new_normal, f.outer_normal));
    }
    for (const Rim& g : rim) {
      if (f.to == g.from) {
        before = std::min(before, dot(f.old_normal, g.old_normal));
        after = std::min(after, dot(f.new_normal, g.new_normal));
      }
    }
  }
  return after < fold_cosine && after < before;
}

}  // namespace

bool harmless(const EditMesh& mesh, const PlanePoints& bound, const WallFaces& walls, const Change& change,
              std::vector<Rim>& rim) {
  const auto& [v0, v1, place] = change;
  const MirrorPlane* plane = bound.plane(v0, v1);
  Worst faces{thinnest_face};
  Worst in_walls{thinnest_in_wall};
  for (const auto v : {v0, v1}) {
    const auto other = v == v0 ? v1 : v0;
    for (const auto h : mesh.voh_range(v)) {
      if (mesh.is_boundary(h)) {
        continue;
      }
      const auto side = mesh.next_halfedge_handle(h);
      const auto from = mesh.from_vertex_handle(side);
      const auto to = mesh.to_vertex_handle(side);
      Worst& worst = walls.is_wall(mesh.face_handle(h)) ? in_walls : faces;
      const auto doubled = [&](const Change* when, double& share) {
        const Vec3 p = bound.at(mesh, v, when);
        const Vec3 a = bound.at(mesh, from, when);
        const Vec3 b = bound.at(mesh, to, when);
        const Vec3 normal = cross(a - p, b - p);
        if (!bound.coincide(from, to, when)) {
          share = std::min(share, height_share(p, a, b, length(normal)));
        }
        return normal;
      };
      const Vec3 old_doubled = doubled(nullptr, worst.before);
      if (from == other || to == other || bound.coincide(from, to, &change)) {
        continue;  // vanishes with the edge
      }
      const Vec3 new_doubled = doubled(&change, worst.after);
      const bool seam = plane != nullptr && (bound.is_seam(mesh, h) || bound.is_seam(mesh, side) ||
                                             bound.is_seam(mesh, mesh.next_halfedge_handle(side)));
      const bool new_seam = plane != nullptr &&
                            (bound.joins_seam(mesh, v, other, from) || bound.joins_seam(mesh, v, other, to));
      Rim face{from,
               to,
               normalized(old_doubled),
               normalized(new_doubled),
               outer_normal(mesh, side, v0, v1),
               seam,
               seam || new_seam};
      if (dot(face.old_normal, face.new_normal) < turn_cosine && face.old_normal != Vec3{}) {
        return false;
      }
      rim.push_back(face);
    }
  }
  return faces.is_allowed() && in_walls.is_allowed() && !folds_back(rim, plane) &&
         !turns_beside_crossings(mesh, bound, change);
}

double drift_after(const EditMesh& mesh, const Change& change, const std::vector<Rim>& rim,
                   const std::vector<double>& drift) {
  const auto& [v0, v1, place] = change;
  double result = 0.0;
  for (const auto v : {v0, v1}) {
    const Vec3 p = to_vector(mesh.point(v));
    double nearest = dot(p - place, p - place);
    for (const Rim& f : rim) {
      nearest = std::min(nearest, mesh::squared_distance(place, to_vector(mesh.point(f.from)),
                                                         to_vector(mesh.point(f.to)), p));
    }
    result = std::max(result, drift[static_cast<std::size_t>(v.idx())] + std::sqrt(nearest));
  }
  return result;
}

}  // namespace ridgecraft::prepare
