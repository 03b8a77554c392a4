// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/collapse_sequence.hpp"

// The mesh and CGAL's view of it must be known before the simplification is.
// clang-format off
#include "prepare/simplify/edit_mesh.hpp"
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
// clang-format on

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace ridgecraft::prepare {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Policies = sms::GarlandHeckbert_plane_policies<EditMesh, EditKernel>;
using Place = EditKernel::Point_3;
using Quadric = Policies::Mat_4;

/// A face may turn by at most this much in one collapse.
const double turn_cosine = std::cos(75.0 * std::numbers::pi / 180.0);
/// Neighbours may not fold back onto each other further than this where they didn't before: paper can't be
/// folded shut.
const double fold_cosine = std::cos(160.0 * std::numbers::pi / 180.0);
/// Smallest height over longest side of a new face where the old faces weren't worse.
constexpr double thin = 0.02;

Vec3 vector(const EditMesh::Point& p) {
  return {p[0], p[1], p[2]};
}

/// A face around the collapsed edge: its corner at the edge moves to the new place, the other two stay.
struct Rim {
  EditMesh::VertexHandle from;
  EditMesh::VertexHandle to;
  Vec3 old_normal;
  Vec3 new_normal;
  Vec3 outer_normal;  ///< of the face across the side that stays; zero where there is none
  bool was_at_plane;  ///< its mirror image lay across one of its sides ...
  bool at_plane;      ///< ... and will
};

/// Which vertices stay on planes, as collapses go on, and what that means for errors and places.
class Bound {
 public:
  Bound(const PointRules& points, const std::vector<Vec3>& places, double short_edge)
      : points_(&points),
        plane_(points.plane),
        now_(points.plane.size()),
        crossing_(points.plane.size(), none),
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

  [[nodiscard]] bool is(EditMesh::VertexHandle v) const { return number(v) != PointRules::none; }
  /// The plane of either vertex; no edge joins vertices of two planes.
  [[nodiscard]] const MirrorPlane* plane(EditMesh::VertexHandle v0, EditMesh::VertexHandle v1) const {
    const std::uint32_t found = is(v0) ? number(v0) : number(v1);
    return found == PointRules::none ? nullptr : &points_->planes[found];
  }
  void join(EditMesh::VertexHandle gone, EditMesh::VertexHandle stays) {
    now_[static_cast<std::size_t>(gone.idx())] = static_cast<std::uint32_t>(stays.idx());
    crossing_[static_cast<std::size_t>(gone.idx())] = crossing_[static_cast<std::size_t>(stays.idx())] = none;
    if (is(gone)) {
      plane_[static_cast<std::size_t>(stays.idx())] = number(gone);
    }
  }
  [[nodiscard]] std::uint32_t copies(EditMesh::VertexHandle v) const {
    return points_->copies[static_cast<std::size_t>(v.idx())];
  }

  /// Where the plane asks a point to be.
  [[nodiscard]] static Place place(const MirrorPlane* plane, const Place& p) {
    if (plane == nullptr) {
      return p;
    }
    const Vec3 foot = plane->foot({p.x(), p.y(), p.z()});
    return {foot.x, foot.y, foot.z};
  }
  [[nodiscard]] static Quadric mirrored(const MirrorPlane& plane, const Quadric& q) {
    const Eigen::Vector4d n(plane.normal.x, plane.normal.y, plane.normal.z, 0.0);
    const Eigen::Vector4d at(plane.normal.x, plane.normal.y, plane.normal.z, -plane.offset);
    const Eigen::Matrix4d image = Eigen::Matrix4d::Identity() - 2.0 * n * at.transpose();
    return image.transpose() * q * image;
  }
  /// Error of what a collapse makes of two vertices (and of their mirror images, where those become the same
  /// vertex). Those on a plane have the whole's quadrics.
  template <class Profile>
  [[nodiscard]] Quadric quadric(const Policies& policies, const Profile& profile) const {
    const Quadric q0 = get(policies.vcm(), profile.v0());
    const Quadric q1 = get(policies.vcm(), profile.v1());
    if (is(profile.v0()) == is(profile.v1())) {
      return q0 + q1;
    }
    const MirrorPlane& at = *plane(profile.v0(), profile.v1());
    return q0 + q1 + mirrored(at, is(profile.v0()) ? q1 : q0);
  }

  /// Does the mirror image lie across this side?
  [[nodiscard]] bool is_seam(const EditMesh& mesh, EditMesh::HalfedgeHandle h) const {
    return mesh.is_boundary(mesh.edge_handle(h)) && is(mesh.from_vertex_handle(h)) &&
           is(mesh.to_vertex_handle(h));
  }

  /// Will the side from v to w lie on the plane when v becomes one with `on`?
  [[nodiscard]] bool joins_seam(const EditMesh& mesh, EditMesh::VertexHandle v, EditMesh::VertexHandle on,
                                EditMesh::VertexHandle w) const {
    if (is(v) || !is(on) || !is(w)) {
      return false;
    }
    const auto h = mesh.find_halfedge(on, w);
    return h.is_valid() && is_seam(mesh, h);
  }

  /// Whether a collapse would spoil the symmetric whole.
  template <class Profile>
  [[nodiscard]] bool forbids(const Profile& profile) const {
    return is_fixed(profile.v0()) || is_fixed(profile.v1()) || closes_on_plane(profile);
  }

  /// Two vertices become one, at a place.
  struct Change {
    EditMesh::VertexHandle v0;
    EditMesh::VertexHandle v1;
    Vec3 place;
    [[nodiscard]] bool moves(EditMesh::VertexHandle v) const { return v == v0 || v == v1; }
  };
  /// Where a vertex is (after a change, if given): crossings go along with the ends of their edges until they
  /// are changed themselves, or an end comes to the plane.
  [[nodiscard]] Vec3 at(const EditMesh& mesh, EditMesh::VertexHandle v, const Change* change) const {
    if (change != nullptr && change->moves(v)) {
      return change->place;
    }
    if (!is_crossing(v)) {
      return vector(mesh.point(v));
    }
    const auto [end, image_of_end] = ends(v);
    return crossing(*plane(v, v), at(mesh, end, change), at(mesh, image_of_end, change));
  }
  [[nodiscard]] bool follows(EditMesh::VertexHandle v, const Change& change) const {
    return is_crossing(v) && (change.moves(ends(v)[0]) || change.moves(ends(v)[1]));
  }
  /// Are these crossings of one edge after a change?
  [[nodiscard]] bool coincide(EditMesh::VertexHandle a, EditMesh::VertexHandle b,
                              const Change* change) const {
    const auto same = [&](EditMesh::VertexHandle u, EditMesh::VertexHandle v) {
      return u == v || (change != nullptr && change->moves(u) && change->moves(v));
    };
    return is_crossing(a) && is_crossing(b) && same(ends(a)[0], ends(b)[0]) && same(ends(a)[1], ends(b)[1]);
  }

 private:
  /// Would the new vertex lie on a plane together with a neighbour that it isn't joined to by a border edge?
  /// The edge between them would be one with its mirror image.
  template <class Profile>
  [[nodiscard]] bool closes_on_plane(const Profile& profile) const {
    const EditMesh& mesh = profile.surface_mesh();
    const auto v0 = profile.v0();
    const auto v1 = profile.v1();
    if (is(v0) == is(v1)) {
      return is(v0) && !mesh.is_boundary(mesh.edge_handle(profile.v0_v1()));
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

  [[nodiscard]] bool is_crossing(EditMesh::VertexHandle v) const {
    return crossing_[static_cast<std::size_t>(v.idx())] != none && !is(ends(v)[0]) && !is(ends(v)[1]);
  }
  [[nodiscard]] bool is_fixed(EditMesh::VertexHandle v) const {
    const std::uint32_t crossing = crossing_[static_cast<std::size_t>(v.idx())];
    return crossing != none && fixed_[crossing];
  }
  [[nodiscard]] EditMesh::VertexHandle now(std::uint32_t v) const {
    while (now_[v] != v) {
      v = now_[v];
    }
    return EditMesh::VertexHandle(static_cast<int>(v));
  }
  [[nodiscard]] std::array<EditMesh::VertexHandle, 2> ends(EditMesh::VertexHandle v) const {
    const PointRules::Crossing& c = points_->crossings[crossing_[static_cast<std::size_t>(v.idx())]];
    return {now(c.end), now(c.image_of_end)};
  }
  [[nodiscard]] std::uint32_t number(EditMesh::VertexHandle v) const {
    return plane_[static_cast<std::size_t>(v.idx())];
  }
  const PointRules* points_;
  std::vector<std::uint32_t> plane_;
  static constexpr std::uint32_t none = PointRules::none;
  std::vector<std::uint32_t> now_;       ///< what each vertex became part of
  std::vector<std::uint32_t> crossing_;  ///< of each vertex: its number among crossings
  std::vector<bool> fixed_;              ///< of each crossing: no collapse may touch it
};

double shape(Vec3 a, Vec3 b, Vec3 c, double doubled) {
  const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return longest > 0.0 ? doubled / longest : 0.0;
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
  NearPlacement(const Policies& policies, const Bound& bound) : policies_(&policies), bound_(&bound) {}
  template <class Profile>
  boost::optional<Place> operator()(const Profile& profile) const {
    const MirrorPlane* plane = bound_->plane(profile.v0(), profile.v1());
    const Place middle = Bound::place(plane, CGAL::midpoint(profile.p0(), profile.p1()));
    if (!has_quadrics(policies_->get_placement(), profile)) {
      return middle;
    }
    const auto homogeneous = [](const Place& p) { return Policies::point_to_homogenous_column(p); };
    const auto best = policies_->construct_optimum(bound_->quadric(*policies_, profile),
                                                   homogeneous(profile.p0()), homogeneous(profile.p1()));
    const Place place = Bound::place(plane, Place(best(0) / best(3), best(1) / best(3), best(2) / best(3)));
    const double reach = CGAL::squared_distance(profile.p0(), profile.p1());
    return CGAL::squared_distance(place, middle) <= reach ? place : middle;
  }

 private:
  const Policies* policies_;
  const Bound* bound_;
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
  GuardedPlacement(const Policies& policies, const Bound& bound, const CollapseRules& rules,
                   const std::vector<double>& drift, Watch& watch)
      : near_(policies, bound), bound_(&bound), rules_(rules), drift_(&drift), watch_(&watch) {}

  /// As a placement: the best place, or another one on the edge where that would spoil something.
  template <class Profile>
  boost::optional<Place> operator()(const Profile& profile) const {
    const Place best = *near_(profile);
    const MirrorPlane* plane = bound_->plane(profile.v0(), profile.v1());
    for (const Place& place :
         {best, CGAL::midpoint(profile.p0(), profile.p1()), profile.p0(), profile.p1()}) {
      const Place allowed = Bound::place(plane, place);
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
  bool fits(const Profile& profile, const Place& p) const {
    watch_->count();
    const Vec3 place{p.x(), p.y(), p.z()};
    const EditMesh& mesh = profile.surface_mesh();
    std::vector<Rim> rim;
    return !bound_->forbids(profile) && harmless(mesh, *bound_, profile.v0(), profile.v1(), place, rim) &&
           (rules_.field == nullptr || near_original(mesh, profile.v0(), profile.v1(), place, rim));
  }

  bool near_original(const EditMesh& mesh, EditMesh::VertexHandle v0, EditMesh::VertexHandle v1, Vec3 place,
                     const std::vector<Rim>& rim) const {
    if (drift_after(mesh, v0, v1, place, rim, *drift_) > rules_.largest_deviation ||
        !rules_.field->contains(place)) {
      return false;
    }
    return std::all_of(rim.begin(), rim.end(), [&](const Rim& f) {
      const Vec3 a = vector(mesh.point(f.from));
      const Vec3 b = vector(mesh.point(f.to));
      return rules_.field->contains((place + a + b) / 3.0) && rules_.field->contains(0.5 * (place + a));
    });
  }

 public:
  /// The drift of the new vertex: that of the old ones and how far they are from the new faces.
  static double drift_after(const EditMesh& mesh, EditMesh::VertexHandle v0, EditMesh::VertexHandle v1,
                            Vec3 place, const std::vector<Rim>& rim, const std::vector<double>& drift) {
    double result = 0.0;
    for (const auto v : {v0, v1}) {
      const Vec3 p = vector(mesh.point(v));
      double nearest = dot(p - place, p - place);
      for (const Rim& f : rim) {
        nearest = std::min(
            nearest, mesh::squared_distance(place, vector(mesh.point(f.from)), vector(mesh.point(f.to)), p));
      }
      result = std::max(result, drift[static_cast<std::size_t>(v.idx())] + std::sqrt(nearest));
    }
    return result;
  }

  /// Fills `rim` with the faces that stay and tells whether none of them is spoiled.
  static bool harmless(const EditMesh& mesh, const Bound& bound, EditMesh::VertexHandle v0,
                       EditMesh::VertexHandle v1, Vec3 place, std::vector<Rim>& rim) {
    const MirrorPlane* plane = bound.plane(v0, v1);
    const Bound::Change change{v0, v1, place};
    double worst_old = 1.0;
    double worst_new = 1.0;
    for (const auto v : {v0, v1}) {
      const auto other = v == v0 ? v1 : v0;
      for (const auto h : mesh.voh_range(v)) {
        if (mesh.is_boundary(h)) {
          continue;
        }
        const auto side = mesh.next_halfedge_handle(h);
        const auto from = mesh.from_vertex_handle(side);
        const auto to = mesh.to_vertex_handle(side);
        const auto doubled = [&](const Bound::Change* when, double& worst) {
          const Vec3 p = bound.at(mesh, v, when);
          const Vec3 a = bound.at(mesh, from, when);
          const Vec3 b = bound.at(mesh, to, when);
          const Vec3 normal = cross(a - p, b - p);
          if (!bound.coincide(from, to, when)) {
            worst = std::min(worst, shape(p, a, b, length(normal)));
          }
          return normal;
        };
        const Vec3 old_doubled = doubled(nullptr, worst_old);
        if (from == other || to == other || bound.coincide(from, to, &change)) {
          continue;  // vanishes with the edge
        }
        const Vec3 new_doubled = doubled(&change, worst_new);
        const bool seam = plane != nullptr && (bound.is_seam(mesh, h) || bound.is_seam(mesh, side) ||
                                               bound.is_seam(mesh, mesh.next_halfedge_handle(side)));
        const bool new_seam = plane != nullptr && (bound.joins_seam(mesh, v, other, from) ||
                                                   bound.joins_seam(mesh, v, other, to));
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
    return (worst_new >= thin || worst_new >= worst_old) && !folds(rim, plane) &&
           !turns_beside_crossings(mesh, bound, change);
  }

 private:
  static Vec3 outer_normal(const EditMesh& mesh, EditMesh::HalfedgeHandle side, EditMesh::VertexHandle v0,
                           EditMesh::VertexHandle v1) {
    const auto opposite = mesh.opposite_halfedge_handle(side);
    if (mesh.is_boundary(opposite)) {
      return {};
    }
    const auto tip = mesh.to_vertex_handle(mesh.next_halfedge_handle(opposite));
    if (tip == v0 || tip == v1) {
      return {};
    }
    const Vec3 a = vector(mesh.point(mesh.from_vertex_handle(opposite)));
    const Vec3 b = vector(mesh.point(mesh.to_vertex_handle(opposite)));
    return normalized(cross(b - a, vector(mesh.point(tip)) - a));
  }

  /// Crossings that go along with the change move faces that it doesn't touch: would one of these be turned?
  static bool turns_beside_crossings(const EditMesh& mesh, const Bound& bound, const Bound::Change& change) {
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

  /// Would an edge of the new faces be folded back further than allowed and than the worst was before?
  static bool folds(const std::vector<Rim>& rim, const MirrorPlane* plane) {
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

  /// Cosine between a normal and its mirror image.
  static double with_image(const MirrorPlane& plane, Vec3 normal) {
    const double across = dot(plane.normal, normal);
    return dot(normal, normal) - 2.0 * across * across;
  }

  NearPlacement near_;
  const Bound* bound_;
  CollapseRules rules_;
  const std::vector<double>* drift_;
  Watch* watch_;
};

/// CGAL's cost, weighted so that short edges come first.
class WeightedCost {
 public:
  // Tells CGAL to call the next two.
  using Update_tag = CGAL::Tag_true;
  template <class Map, class Traits>
  void initialize(const EditMesh& mesh, const Map& map, const Traits& traits) const {
    policies_->initialize(mesh, map, traits);
    for (const auto v : mesh.vertices()) {
      if (const MirrorPlane* plane = bound_->plane(v, v)) {
        put(policies_->vcm(), v, whole_quadric(mesh, map, traits, v, *plane));
      }
    }
  }
  template <class Profile>
  void update_after_collapse(const Profile& profile, EditMesh::VertexHandle v) const {
    put(policies_->vcm(), v, bound_->quadric(*policies_, profile));
    bound_->join(profile.v0() == v ? profile.v1() : profile.v0(), v);
  }

  WeightedCost(const Policies& policies, Bound& bound, const CollapseRules& rules, Watch& watch)
      : policies_(&policies), bound_(&bound), rules_(rules), watch_(&watch) {}

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
    const double cost = (p.transpose() * bound_->quadric(*policies_, profile) * p)(0, 0);
    if (rules_.power == 0.0) {
      return cost;
    }
    const double squared = CGAL::squared_distance(profile.p0(), profile.p1());
    const double ratio = std::max(squared / (rules_.short_edge * rules_.short_edge), 1e-4);
    // In flat regions all errors are nothing but rounding: there the length alone decides.
    return (std::max(cost, 0.0) + flat_error * squared) * std::pow(ratio, 0.5 * rules_.power);
  }

 private:
  /// Error of an edge that is as good as none, as a share of its squared length.
  static constexpr double flat_error = 1e-6;

  /// As CGAL's initialize makes it of the whole surface: of faces and border edges, and their mirror images.
  template <class Map, class Traits>
  Quadric whole_quadric(const EditMesh& mesh, const Map& map, const Traits& traits, EditMesh::VertexHandle v,
                        const MirrorPlane& plane) const {
    constexpr double discontinuity = 100.0;  // CGAL's own default
    Quadric sum = Quadric::Zero();
    for (const auto f : mesh.vf_range(v)) {
      sum += policies_->construct_quadric(f, mesh, map, traits);
    }
    for (const auto h : mesh.voh_range(v)) {
      if (mesh.is_boundary(mesh.edge_handle(h)) && !bound_->is_seam(mesh, h)) {
        const auto inner =
            mesh.is_boundary(h) ? mesh.opposite_halfedge_handle(h) : EditMesh::HalfedgeHandle(h);
        sum += discontinuity * policies_->construct_quadric(inner, mesh, map, traits);
      }
    }
    return sum + Bound::mirrored(plane, sum);
  }

  const Policies* policies_;
  Bound* bound_;
  CollapseRules rules_;
  Watch* watch_;
};

/// Writes the collapses down as they happen. CGAL copies visitors.
class Recorder : public sms::Edge_collapse_visitor_base<EditMesh> {
 public:
  Recorder(std::vector<Collapse>& collapses, const Bound& bound, std::vector<double>& drift,
           std::size_t faces, const Context& context)
      : collapses_(&collapses),
        bound_(&bound),
        drift_(&drift),
        faces_(faces),
        all_(faces),
        context_(&context) {}

  void OnCollapsing(const Profile& profile, const boost::optional<Place>& place) {
    if (place) {
      const Vec3 p{place->x(), place->y(), place->z()};
      std::vector<Rim> rim;
      GuardedPlacement::harmless(profile.surface_mesh(), *bound_, profile.v0(), profile.v1(), p, rim);
      new_drift_ =
          GuardedPlacement::drift_after(profile.surface_mesh(), profile.v0(), profile.v1(), p, rim, *drift_);
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
                           vector(p), static_cast<std::uint32_t>(faces_)});
    if (collapses_->size() % 1024 == 0) {
      context_->check();
      context_->report("simplifying", 1.0 - static_cast<double>(faces_) / static_cast<double>(all_));
    }
  }

 private:
  std::vector<Collapse>* collapses_;
  const Bound* bound_;
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
                                        std::size_t faces, const CollapseRules& rules,
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
  Bound bound(points, loose.points, rules.short_edge);
  std::vector<double> drift(loose.points.size(), 0.0);
  const StopAt stop{&collapses, faces};
  Watch watch(context);
  const WeightedCost cost(policies, bound, rules, watch);
  const GuardedPlacement guard(policies, bound, rules, drift, watch);
  const Recorder recorder(collapses, bound, drift, all, context);
  namespace parameters = CGAL::parameters;
  if (rules.field != nullptr) {
    sms::edge_collapse(mesh, stop, parameters::get_cost(cost).get_placement(guard).visitor(recorder));
  } else {
    // Far from any limit it's enough, and much faster, to look at a collapse only when its turn has come.
    sms::edge_collapse(mesh, stop,
                       parameters::get_cost(cost)
                           .get_placement(NearPlacement(policies, bound))
                           .filter(guard)
                           .visitor(recorder));
  }
  return collapses;
}

Vec3 crossing(const MirrorPlane& plane, Vec3 end, Vec3 image_of_end) {
  const double height = plane.height(end);
  const double sum = height + plane.height(image_of_end);
  const double share = sum > 0.0 || sum < 0.0 ? height / sum : 0.0;
  return plane.foot(end + share * (plane.image(image_of_end) - end));
}

std::vector<std::uint32_t> points_after(std::size_t count, std::span<const Collapse> collapses) {
  std::vector<std::uint32_t> now(count);
  for (std::uint32_t v = 0; v < now.size(); ++v) {
    now[v] = v;
  }
  // A vertex that stayed may be gone later: from the last collapse back, each points to where it ended.
  for (std::size_t i = collapses.size(); i-- > 0;) {
    now[collapses[i].gone] = now[collapses[i].stays];
  }
  return now;
}

std::vector<std::uint32_t> planes_after(const PointRules& points, std::span<const Collapse> collapses) {
  std::vector<std::uint32_t> plane = points.plane;
  for (const Collapse& c : collapses) {
    if (plane[c.gone] != PointRules::none) {
      plane[c.stays] = plane[c.gone];
    }
  }
  return plane;
}

mesh::LooseFaces replay(const mesh::LooseFaces& loose, std::span<const Collapse> collapses) {
  mesh::LooseFaces result;
  result.points = loose.points;
  const std::vector<std::uint32_t> now = points_after(loose.points.size(), collapses);
  std::vector<bool> moved(loose.points.size(), false);
  for (const Collapse& c : collapses) {
    result.points[c.stays] = c.place;
    moved[c.gone] = moved[c.stays] = true;
  }
  for (std::size_t f = 0; f < loose.faces.size(); ++f) {
    const auto& [a, b, c] = loose.faces[f];
    const std::array<std::uint32_t, 3> face{now[a], now[b], now[c]};
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
      result.add(loose, f, face, loose.texture.empty() ? std::array<Vec2, 3>{} : loose.texture[f]);
      if (moved[a] || moved[b] || moved[c]) {
        result.polygon.back() = mesh::Soup::none;
      }
    }
  }
  return result;
}

}  // namespace ridgecraft::prepare
