// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/collapse_sequence.hpp"

// CGAL's view of the mesh must be known before the simplification is.
// clang-format off
#include "prepare/collapses/collapse_policies.hpp"
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
// clang-format on

#include <cstdint>

#include "prepare/collapses/plane_points.hpp"

namespace ridgecraft::prepare {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using VertexPoints = boost::property_map<EditMesh, CGAL::vertex_point_t>::type;

/// Vertices of a wall are off its plane by no more than this share of the diagonal: as in a panel.
constexpr double in_plane = 1e-5;
/// A step between two walls that is lower than this share of the short edge can be seen, but not folded.
constexpr double step = 1.0 / 6.0;

/// Writes the collapses down as they happen. CGAL copies visitors.
class Recorder : public sms::Edge_collapse_visitor_base<EditMesh, VertexPoints, Directions> {
 public:
  Recorder(std::vector<Collapse>& collapses, const PlanePoints& bound, WallFaces& walls,
           std::vector<double>& drift, std::size_t faces, const Context& context)
      : collapses_(&collapses),
        bound_(&bound),
        walls_(&walls),
        drift_(&drift),
        faces_(faces),
        all_(faces),
        context_(&context) {}

  void OnCollapsing(const Profile& profile, const boost::optional<Place>& place) {
    if (place) {
      const Change change{profile.v0(), profile.v1(), {place->x(), place->y(), place->z()}};
      std::vector<Rim> rim;
      const EditMesh& mesh = profile.surface_mesh();
      static_cast<void>(harmless(mesh, *bound_, *walls_, change, rim));
      new_drift_ = drift_after(mesh, change, rim, *drift_);
      for (const EditMesh::HalfedgeHandle h :
           {EditMesh::HalfedgeHandle(profile.v0_v1()), EditMesh::HalfedgeHandle(profile.v1_v0())}) {
        if (!mesh.is_boundary(h)) {
          walls_->remove(mesh.face_handle(h));
        }
      }
    }
    removed_ = (profile.left_face_exists() ? 1U : 0U) + (profile.right_face_exists() ? 1U : 0U);
    removed_ *= bound_->copies(profile.v0());
  }
  void OnCollapsed(const Profile& profile, const EditMesh::VertexHandle& v) {
    faces_ -= removed_;
    (*drift_)[static_cast<std::size_t>(v.idx())] = new_drift_;
    const auto gone = profile.v0() == v ? profile.v1() : profile.v0();
    const auto& p = profile.surface_mesh().point(v);
    collapses_->push_back({static_cast<std::uint32_t>(gone.idx()), static_cast<std::uint32_t>(v.idx()),
                           to_vector(p), static_cast<std::uint32_t>(faces_)});
    if (collapses_->size() % 1024 == 0) {
      context_->check();
      context_->report("simplifying", 1.0 - static_cast<double>(faces_) / static_cast<double>(all_));
    }
  }

 private:
  std::vector<Collapse>* collapses_;
  const PlanePoints* bound_;
  WallFaces* walls_;
  std::vector<double>* drift_;
  double new_drift_ = 0.0;
  std::size_t faces_;
  std::size_t all_;
  std::size_t removed_ = 0;
  const Context* context_;
};

struct StopAt {
  const std::vector<Collapse>* collapses;
  std::size_t faces;
  template <class Cost, class Profile, class Count>
  bool operator()(const Cost&, const Profile&, Count, Count) const {
    return !collapses->empty() && collapses->back().faces <= faces;
  }
};

}  // namespace

std::vector<Collapse> collapse_sequence(const mesh::LooseFaces& loose, const PointRules& points,
                                        const Walls& walls, std::size_t faces, const CollapseRules& rules,
                                        const Context& context) {
  std::vector<Collapse> collapses;
  std::size_t all = 0;
  for (const auto& face : loose.faces) {
    all += points.copies[face[0]];
  }
  all -= 2 * points.crossings.size();
  if (all <= faces) {
    return collapses;
  }
  EditMesh mesh = edit_mesh(loose);
  const Policies policies(mesh);
  PlanePoints bound(points, loose.points, rules.short_edge);
  Box3 box;
  for (const auto& face : loose.faces) {
    for (const std::uint32_t v : face) {
      box.add(loose.points[v]);
    }
  }
  WallFaces wall_faces(walls, in_plane * box.diagonal(), step * rules.short_edge);
  std::vector<double> drift(loose.points.size(), 0.0);
  const StopAt stop{&collapses, faces};
  Watch watch(context);
  const WeightedCost cost(policies, bound, rules, watch);
  const GuardedPlacement guard(policies, bound, wall_faces, rules, drift, watch);
  const Recorder recorder(collapses, bound, wall_faces, drift, all, context);
  namespace parameters = CGAL::parameters;
  if (rules.field != nullptr) {
    sms::edge_collapse(
        mesh, stop,
        parameters::geom_traits(Directions()).get_cost(cost).get_placement(guard).visitor(recorder));
  } else {
    // Far from any limit it's enough, and much faster, to look at a collapse only when its turn has come.
    sms::edge_collapse(mesh, stop,
                       parameters::geom_traits(Directions())
                           .get_cost(cost)
                           .get_placement(NearPlacement(policies, bound, wall_faces))
                           .filter(guard)
                           .visitor(recorder));
  }
  return collapses;
}

}  // namespace ridgecraft::prepare
