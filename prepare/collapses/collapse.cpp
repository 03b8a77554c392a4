// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/collapse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "base/elementary.hpp"
#include "base/no_index.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/symmetry/eigen.hpp"

namespace ridgecraft::prepare {
namespace {

/// Directions in which the error grows by less than this share of its largest growth don't matter to it.
constexpr double tells = 1e-3;

/// The place within planes where an error is least.
Vec3 least_error(const Meeting& meeting, const Eigen::Matrix4d& quadric) {
  if (meeting.directions().size() == 3) {
    return meeting.place();
  }
  Eigen::Matrix3d within = Eigen::Matrix3d::Identity();
  for (const Vec3 d : meeting.directions()) {
    within -= to_eigen(d) * to_eigen(d).transpose();
  }
  Eigen::Vector3d place = to_eigen(meeting.place());
  const Eigen::Matrix3d growth = within * quadric.topLeftCorner<3, 3>() * within;
  const Eigen::Vector3d slope =
      within * (quadric.topLeftCorner<3, 3>() * place + quadric.topRightCorner<3, 1>());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(growth);
  const double largest = solver.eigenvalues()(2);
  for (int i = 0; i < 3; ++i) {
    const double value = solver.eigenvalues()(i);
    if (value > tells * largest && value > 0.0) {
      const Eigen::Vector3d axis = solver.eigenvectors().col(i);
      place -= (axis.dot(slope) / value) * axis;
    }
  }
  return to_vec3(place);
}

}  // namespace

WallFaces::WallFaces(const Walls& walls, double tolerance, double step)
    : walls_(&walls), tolerance_(tolerance), step_(step), left_(walls.walls.size(), 0) {
  for (const std::uint32_t wall : walls.of_face) {
    if (wall != Walls::none) {
      ++left_[wall];
      any_ = true;
    }
  }
}

std::vector<std::uint32_t> WallFaces::around(const EditMesh& mesh, EditMesh::VertexHandle v0,
                                             EditMesh::VertexHandle v1) const {
  std::vector<std::uint32_t> found;
  if (!any_) {
    return found;
  }
  for (const auto v : {v0, v1}) {
    for (const auto f : mesh.vf_range(v)) {
      if (is_wall(f)) {
        found.push_back(wall(f));
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool WallFaces::holds(const std::vector<std::uint32_t>& walls, Vec3 place, double edge) const {
  const double tolerance = edge < step_ ? std::max(tolerance_, step_ / 6.0) : tolerance_;
  return std::all_of(walls.begin(), walls.end(),
                     [&](std::uint32_t w) { return std::abs(walls_->walls[w].height(place)) <= tolerance; });
}

bool WallFaces::ends_one(const EditMesh& mesh, EditMesh::HalfedgeHandle side) const {
  const auto opposite = mesh.opposite_halfedge_handle(side);
  const auto wall_beside = [&](EditMesh::HalfedgeHandle h) {
    return mesh.is_boundary(h) ? Walls::none : wall(mesh.face_handle(h));
  };
  const std::uint32_t a = wall_beside(side);
  const std::uint32_t b = wall_beside(opposite);
  return (a != Walls::none && left_[a] <= (a == b ? 2U : 1U)) || (b != Walls::none && left_[b] <= 1U);
}

void WallFaces::remove(EditMesh::FaceHandle face) {
  if (is_wall(face)) {
    --left_[wall(face)];
  }
}

std::optional<Vec3> WallFaces::best_place(const std::vector<std::uint32_t>& walls, const MirrorPlane* mirror,
                                          const Eigen::Matrix4d& quadric, Vec3 start, double edge) const {
  Meeting meeting(start);
  if (mirror != nullptr) {
    meeting.add(mirror->normal, mirror->offset);
  }
  for (const std::uint32_t w : walls) {
    meeting.add(walls_->walls[w].normal, walls_->walls[w].offset);
  }
  const Vec3 place = least_error(meeting, quadric);
  return holds(walls, place, edge) ? std::optional(place) : std::nullopt;
}

PlanePoints::PlanePoints(const PointRules& points, const std::vector<Vec3>& places, double short_edge)
    : points_(&points),
      plane_(points.plane),
      now_(points.plane.size()),
      crossing_(points.plane.size(), no_index),
      fixed_(points.crossings.size(), false) {
  std::iota(now_.begin(), now_.end(), 0U);
  for (std::uint32_t i = 0; i < points.crossings.size(); ++i) {
    const PointRules::Crossing& c = points.crossings[i];
    const MirrorPlane& plane = points.planes[points.plane[c.point]];
    const double across =
        std::abs(plane.height(places[c.end])) + std::abs(plane.height(places[c.image_of_end]));
    crossing_[c.point] = i;
    fixed_[i] = across > short_edge;
  }
}

void PlanePoints::join(EditMesh::VertexHandle gone, EditMesh::VertexHandle stays) {
  now_[static_cast<std::size_t>(gone.idx())] = static_cast<std::uint32_t>(stays.idx());
  crossing_[static_cast<std::size_t>(gone.idx())] = crossing_[static_cast<std::size_t>(stays.idx())] =
      no_index;
  if (is(gone)) {
    plane_[static_cast<std::size_t>(stays.idx())] = number(gone);
  }
}

bool PlanePoints::is_seam(const EditMesh& mesh, EditMesh::HalfedgeHandle h) const {
  return mesh.is_boundary(mesh.edge_handle(h)) && is(mesh.from_vertex_handle(h)) &&
         is(mesh.to_vertex_handle(h));
}

bool PlanePoints::joins_seam(const EditMesh& mesh, EditMesh::VertexHandle v, EditMesh::VertexHandle on,
                             EditMesh::VertexHandle w) const {
  if (is(v) || !is(on) || !is(w)) {
    return false;
  }
  const auto h = mesh.find_halfedge(on, w);
  return h.is_valid() && is_seam(mesh, h);
}

Vec3 PlanePoints::at(const EditMesh& mesh, EditMesh::VertexHandle v, const Change* change) const {
  if (change != nullptr && change->moves(v)) {
    return change->place;
  }
  if (!is_crossing(v)) {
    return to_vector(mesh.point(v));
  }
  const auto [end, image_of_end] = ends(v);
  return crossing(*plane(v, v), at(mesh, end, change), at(mesh, image_of_end, change));
}

bool PlanePoints::coincide(EditMesh::VertexHandle a, EditMesh::VertexHandle b, const Change* change) const {
  const auto same = [&](EditMesh::VertexHandle u, EditMesh::VertexHandle v) {
    return u == v || (change != nullptr && change->moves(u) && change->moves(v));
  };
  return is_crossing(a) && is_crossing(b) && same(ends(a)[0], ends(b)[0]) && same(ends(a)[1], ends(b)[1]);
}

/// Would the new vertex lie on a plane together with a neighbour that it isn't joined to by a border edge?
/// The edge between them would be one with its mirror image.
bool PlanePoints::closes_on_plane(const EditMesh& mesh, EditMesh::VertexHandle v0, EditMesh::VertexHandle v1,
                                  EditMesh::HalfedgeHandle side) const {
  if (is(v0) == is(v1)) {
    return is(v0) && !mesh.is_boundary(mesh.edge_handle(side));
  }
  const auto on = is(v0) ? v0 : v1;
  const auto off = is(v0) ? v1 : v0;
  for (const auto h : mesh.voh_range(off)) {
    const auto w = mesh.to_vertex_handle(h);
    if (w == on || !is(w)) {
      continue;
    }
    const auto joined = mesh.find_halfedge(on, w);
    if (!joined.is_valid() || !mesh.is_boundary(mesh.edge_handle(joined))) {
      return true;
    }
    // A face that would lie in the plane.
    const auto next = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
    if (!mesh.is_boundary(h) && next != on && is(next)) {
      return true;
    }
  }
  return false;
}

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
double height_fraction(Vec3 a, Vec3 b, Vec3 c, double doubled) {
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
          share = std::min(share, height_fraction(p, a, b, length(normal)));
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
