// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/collapse_sequence.hpp"

// The mesh and CGAL's view of it must be known before the simplification is.
// clang-format off
#include "prepare/collapses/collapse.hpp"
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
// clang-format on

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.hpp"

namespace ridgecraft::prepare {
namespace {

// Which edge CGAL's simplification collapses next, and where its vertex comes to lie.

using Policies = CGAL::Surface_mesh_simplification::GarlandHeckbert_plane_policies<EditMesh, EditKernel>;
using Place = EditKernel::Point_3;
using Quadric = Policies::Mat_4;

/// Where the plane asks a point to be.
Place on_plane(const MirrorPlane* plane, const Place& p) {
  if (plane == nullptr) {
    return p;
  }
  const Vec3 foot = plane->foot({p.x(), p.y(), p.z()});
  return {foot.x, foot.y, foot.z};
}

Quadric mirrored(const MirrorPlane& plane, const Quadric& q) {
  const Eigen::Vector4d n(plane.normal.x, plane.normal.y, plane.normal.z, 0.0);
  const Eigen::Vector4d at(plane.normal.x, plane.normal.y, plane.normal.z, -plane.offset);
  const Eigen::Matrix4d image = Eigen::Matrix4d::Identity() - 2.0 * n * at.transpose();
  return image.transpose() * q * image;
}

/// Error of what a collapse makes of two vertices (and of their mirror images, where those become the same
/// vertex). Those on a plane have the whole's quadrics.
template <class Profile>
[[nodiscard]] Quadric quadric_of(const Policies& policies, const PlanePoints& bound, const Profile& profile) {
  const Quadric q0 = get(policies.vcm(), profile.v0());
  const Quadric q1 = get(policies.vcm(), profile.v1());
  if (bound.is(profile.v0()) == bound.is(profile.v1())) {
    return q0 + q1;
  }
  const MirrorPlane& at = *bound.plane(profile.v0(), profile.v1());
  return q0 + q1 + mirrored(at, bound.is(profile.v0()) ? q1 : q0);
}

template <class Profile>
[[nodiscard]] double length_of(const Profile& profile) {
  return std::sqrt(CGAL::squared_distance(profile.p0(), profile.p1()));
}

double area_of(const EditMesh& mesh, EditMesh::FaceHandle f) {
  std::array<Vec3, 3> corner;
  std::size_t k = 0;
  for (const auto v : mesh.fv_range(f)) {
    corner[k++] = to_vector(mesh.point(v));
  }
  return 0.5 * length(cross(corner[1] - corner[0], corner[2] - corner[0]));
}

/// Whether both ends of an edge have a quadric. A vertex among faces that are too small to have a normal has
/// none, and CGAL demands one.
template <class Policy, class Profile>
bool has_quadrics(const Policy& policy, const Profile& profile) {
  return !get(policy.vcm(), profile.v0()).isZero(0) && !get(policy.vcm(), profile.v1()).isZero(0);
}

/// CGAL's placement, or the middle of the edge where that is far off: so it is where the surface is nearly
/// flat.
class NearPlacement {
 public:
  NearPlacement(const Policies& policies, const PlanePoints& bound, const WallFaces& walls)
      : policies_(&policies), bound_(&bound), walls_(&walls) {}
  template <class Profile>
  boost::optional<Place> operator()(const Profile& profile) const {
    const MirrorPlane* plane = bound_->plane(profile.v0(), profile.v1());
    const Place middle = on_plane(plane, CGAL::midpoint(profile.p0(), profile.p1()));
    const auto around = walls_->around(profile.surface_mesh(), profile.v0(), profile.v1());
    if (!around.empty()) {
      return in_walls(profile, around, plane, middle);
    }
    if (!has_quadrics(policies_->get_placement(), profile)) {
      return middle;
    }
    const auto homogeneous = [](const Place& p) { return Policies::point_to_homogenous_column(p); };
    const auto best = policies_->construct_optimum(quadric_of(*policies_, *bound_, profile),
                                                   homogeneous(profile.p0()), homogeneous(profile.p1()));
    const Place place = on_plane(plane, Place(best(0) / best(3), best(1) / best(3), best(2) / best(3)));
    const double reach = CGAL::squared_distance(profile.p0(), profile.p1());
    return CGAL::squared_distance(place, middle) <= reach ? place : middle;
  }

 private:
  /// Two walls with a narrow face between them meet there; walls without a common point keep their distance.
  template <class Profile>
  boost::optional<Place> in_walls(const Profile& profile, const std::vector<std::uint32_t>& walls,
                                  const MirrorPlane* plane, const Place& middle) const {
    const auto best = walls_->best_place(walls, plane, quadric_of(*policies_, *bound_, profile),
                                         {middle.x(), middle.y(), middle.z()}, length_of(profile));
    const double reach = CGAL::squared_distance(profile.p0(), profile.p1());
    if (best && CGAL::squared_distance(Place(best->x, best->y, best->z), middle) <= reach) {
      return Place(best->x, best->y, best->z);
    }
    for (const Place& place : {middle, profile.p0(), profile.p1()}) {
      if (walls_->holds(walls, {place.x(), place.y(), place.z()}, length_of(profile))) {
        return place;
      }
    }
    return boost::none;
  }

  const Policies* policies_;
  const PlanePoints* bound_;
  const WallFaces* walls_;
};

/// For CGAL's own check of a collapse, which compares the directions of faces beside each other and refuses
/// any where one has ten thousand times the area of the other: here all have the same. A fine cylinder's lid
/// has crumbs at its rim beside faces as long as the cylinder; what is thin is the guard's concern.
struct Directions : EditKernel {
  struct Construct_cross_product_vector_3 {  // NOLINT(readability-identifier-naming): CGAL's name
    Vector_3 operator()(const Vector_3& a, const Vector_3& b) const {
      const Vector_3 product = CGAL::cross_product(a, b);
      const double length = std::sqrt(product.squared_length());
      return length > 0.0 ? product / length : product;
    }
  };
  [[nodiscard]] Construct_cross_product_vector_3 construct_cross_product_vector_3_object() const {
    return {};
  }
};

/// Asks now and then whether to stop: when costs are collected, and while no edge may be collapsed.
class Watch {
 public:
  explicit Watch(const Context& context) : context_(context) {}
  void count() {
    if (++calls_ % 1024 == 0) {
      context_.check();
    }
  }

 private:
  const Context& context_;
  std::size_t calls_ = 0;
};

/// A placement that doesn't spoil the surface.
class GuardedPlacement {
 public:
  /// `drift` is per vertex a bound of how far the original surface around it is from the present one.
  GuardedPlacement(const Policies& policies, const PlanePoints& bound, const WallFaces& walls,
                   const CollapseRules& rules, const std::vector<double>& drift, Watch& watch)
      : near_(policies, bound, walls),
        bound_(&bound),
        walls_(&walls),
        rules_(rules),
        drift_(&drift),
        watch_(&watch) {}

  /// As a placement: the best place, or another one on the edge where that would spoil something.
  template <class Profile>
  boost::optional<Place> operator()(const Profile& profile) const {
    const boost::optional<Place> best = near_(profile);
    if (!best) {
      return boost::none;
    }
    const MirrorPlane* plane = bound_->plane(profile.v0(), profile.v1());
    for (const Place& place :
         {*best, CGAL::midpoint(profile.p0(), profile.p1()), profile.p0(), profile.p1()}) {
      const Place allowed = on_plane(plane, place);
      if (fits(profile, allowed)) {
        return allowed;
      }
    }
    return boost::none;
  }

  /// As a filter of what another placement says.
  template <class Profile>
  boost::optional<Place> operator()(const Profile& profile, const boost::optional<Place>& place) const {
    return place && fits(profile, *place) ? place : boost::none;
  }

 private:
  template <class Profile>
  [[nodiscard]] bool fits(const Profile& profile, const Place& p) const {
    watch_->count();
    const EditMesh& mesh = profile.surface_mesh();
    const Change change{profile.v0(), profile.v1(), {p.x(), p.y(), p.z()}};
    std::vector<Rim> rim;
    return !bound_->forbids(mesh, change.v0, change.v1, profile.v0_v1()) &&
           !walls_->ends_one(mesh, profile.v0_v1()) &&
           walls_->holds(walls_->around(mesh, change.v0, change.v1), change.place, length_of(profile)) &&
           harmless(mesh, *bound_, *walls_, change, rim) &&
           (rules_.field == nullptr || near_original(mesh, change, rim));
  }

  [[nodiscard]] bool near_original(const EditMesh& mesh, const Change& change,
                                   const std::vector<Rim>& rim) const {
    const Vec3 place = change.place;
    if (drift_after(mesh, change, rim, *drift_) > rules_.largest_deviation ||
        !rules_.field->contains(place)) {
      return false;
    }
    return std::all_of(rim.begin(), rim.end(), [&](const Rim& f) {
      const Vec3 a = to_vector(mesh.point(f.from));
      const Vec3 b = to_vector(mesh.point(f.to));
      return rules_.field->contains((place + a + b) / 3.0) && rules_.field->contains(0.5 * (place + a));
    });
  }

  NearPlacement near_;
  const PlanePoints* bound_;
  const WallFaces* walls_;
  CollapseRules rules_;
  const std::vector<double>* drift_;
  Watch* watch_;
};

/// CGAL's cost, weighted by areas.
class WeightedCost {
 public:
  // Tells CGAL to call the next two.
  using Update_tag = CGAL::Tag_true;
  template <class Map, class Traits>
  void initialize(const EditMesh& mesh, const Map& map, const Traits& traits) const {
    policies_->initialize(mesh, map, traits);
    for (const auto v : mesh.vertices()) {
      put(policies_->vcm(), v, whole_quadric(mesh, map, traits, v));
    }
  }
  template <class Profile>
  void update_after_collapse(const Profile& profile, EditMesh::VertexHandle v) const {
    put(policies_->vcm(), v, quadric_of(*policies_, *bound_, profile));
    bound_->join(profile.v0() == v ? profile.v1() : profile.v0(), v);
  }

  WeightedCost(const Policies& policies, PlanePoints& bound, Watch& watch)
      : policies_(&policies), bound_(&bound), watch_(&watch) {}

  template <class Profile>
  boost::optional<EditKernel::FT> operator()(const Profile& profile,
                                             const boost::optional<Place>& place) const {
    watch_->count();
    if (place && !has_quadrics(policies_->get_cost(), profile)) {
      return 0.0;  // nothing is lost with faces that small
    }
    if (!place) {
      return boost::none;
    }
    const auto p = Policies::point_to_homogenous_column(*place);
    const double cost = (p.transpose() * quadric_of(*policies_, *bound_, profile) * p)(0, 0);
    const double squared = CGAL::squared_distance(profile.p0(), profile.p1());
    // In flat regions all errors are nothing but rounding: there the length alone decides.
    return (std::max(cost, 0.0) + flat_error * squared * squared) * squared;
  }

 private:
  /// Error of an edge that is as good as none, as a share of its length to the fourth.
  static constexpr double flat_error = 1e-6;

  /// Of faces and border edges as CGAL's initialize makes it, each weighted by its area, and of the mirror
  /// images of those beside a plane: without the weights a wall would count no more than a crumb beside it.
  template <class Map, class Traits>
  [[nodiscard]] Quadric whole_quadric(const EditMesh& mesh, const Map& map, const Traits& traits,
                                      EditMesh::VertexHandle v) const {
    constexpr double discontinuity = 100.0;  // CGAL's own default
    const auto weighted = [&](EditMesh::FaceHandle f, const Quadric& quadric) {
      return Quadric(area_of(mesh, f) * quadric);
    };
    Quadric sum = Quadric::Zero();
    for (const auto f : mesh.vf_range(v)) {
      sum += weighted(f, policies_->construct_quadric(f, mesh, map, traits));
    }
    for (const auto h : mesh.voh_range(v)) {
      if (mesh.is_boundary(mesh.edge_handle(h)) && !bound_->is_seam(mesh, h)) {
        const auto inner =
            mesh.is_boundary(h) ? mesh.opposite_halfedge_handle(h) : EditMesh::HalfedgeHandle(h);
        sum += discontinuity *
               weighted(mesh.face_handle(inner), policies_->construct_quadric(inner, mesh, map, traits));
      }
    }
    const MirrorPlane* const plane = bound_->plane(v, v);
    return plane == nullptr ? sum : Quadric(sum + mirrored(*plane, sum));
  }

  const Policies* policies_;
  PlanePoints* bound_;
  Watch* watch_;
};

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

std::vector<Collapse> collapse_sequence(const FundamentalDomain& domain, const Walls& walls,
                                        const CollapseRules& rules, const Context& context) {
  const mesh::LooseFaces& loose = domain.faces;
  const PointRules& points = domain.points;
  std::vector<Collapse> collapses;
  std::size_t all = 0;
  for (const auto& face : loose.faces) {
    all += points.copies[face[0]];
  }
  all -= 2 * points.crossings.size();
  if (all <= rules.faces) {
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
  const StopAt stop{&collapses, rules.faces};
  Watch watch(context);
  const WeightedCost cost(policies, bound, watch);
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
