// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/mirrors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include <Eigen/Eigenvalues>

#include "base/disjoint_sets.hpp"
#include "base/no_index.hpp"
#include "base/order.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/symmetry/eigen.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {
namespace {

/// Corners of the part (3 * place of the face in the list + k) that are one vertex: those that neighbours
/// within the part share.
DisjointSets fans(const mesh::Surface& whole, std::span<const FaceId> faces) {
  std::vector<std::pair<FaceId, std::uint32_t>> place;
  place.reserve(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    place.emplace_back(faces[i], i);
  }
  std::sort(place.begin(), place.end());
  DisjointSets sets(3 * faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId twin = whole.twin(mesh::corner(faces[i], k));
      if (!twin.valid()) {
        continue;
      }
      const auto found =
          std::lower_bound(place.begin(), place.end(), std::pair(mesh::face_of(twin), std::uint32_t{0}));
      if (found == place.end() || found->first != mesh::face_of(twin)) {
        continue;
      }
      const std::uint32_t other = 3 * found->second;
      sets.join(3 * i + k, other + mesh::next(twin).value() % 3);
      sets.join(3 * i + (k + 1) % 3, other + twin.value() % 3);
    }
  }
  return sets;
}

}  // namespace

PartOf part_of(const mesh::Surface& whole, std::span<const FaceId> faces) {
  PartOf part;
  part.face = IdVector<FaceId, FaceId>(std::vector<FaceId>(faces.begin(), faces.end()));
  DisjointSets sets = fans(whole, faces);
  std::vector<std::uint32_t> number(3 * faces.size(), VertexId::none_value);
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      std::uint32_t& own = number[sets.find(3 * i + k)];
      if (own == VertexId::none_value) {
        const VertexId v = whole.vertex(mesh::corner(faces[i], k));
        own = part.vertex.push_back(v).value();
        points.push_back(whole.point(v));
      }
      corners[i][k] = VertexId(own);
    }
  }
  part.surface = mesh::Surface(std::move(points), std::move(corners));
  part.edge.resize(part.surface.edge_count());
  for (const FaceId f : ids<FaceId>(faces.size())) {
    for (unsigned k = 0; k < 3; ++k) {
      part.edge[part.surface.edge(mesh::corner(f, k))] = whole.edge(mesh::corner(faces[f.value()], k));
    }
  }
  return part;
}

namespace {

/// Corners that a candidate is tried with at first.
constexpr std::size_t first_corners = 64;
/// Corners that a plane is fitted to.
constexpr std::size_t most_fitted = 4000;
/// Of surfaces with more corners so many, spread over all, tell how far off a plane is; and as many faces.
constexpr std::size_t most_compared = 100000;
/// Where the longest edge isn't longer than so many near tolerances, a few questions ...
constexpr double nearly_fine = 4.0;
/// ... are answered by corners, which takes longer than a tree of all faces does, but needn't be made.
constexpr std::size_t few_questions = 500;
/// A candidate may be off by this share of the extent before it is fitted ...
constexpr double first_reach = 0.04;
/// ... and each fit halves what it looks at.
constexpr int fits = 4;
/// A component of a normal below this is the rounding of a file with six digits; such normals are axes.
constexpr double axis_rounding = 2e-6;
/// Two exact planes whose normals and places (as shares of the extent) differ by less are one ...
constexpr double same_plane = 1e-4;
/// ... and so are two others: each is what was found of the same one.
constexpr double same_near_plane = 0.02;
/// Corners at one distance from the centre that are tried as images of each other.
constexpr std::size_t most_images = 64;
/// A plane may hold the whole surface within so many times the near tolerance: then it mirrors nothing.
constexpr double flat = 2.0;

Vec3 column(const Eigen::Matrix3d& m, int i) {
  return {m(0, i), m(1, i), m(2, i)};
}

/// Ascending eigenvalues.
std::array<Vec3, 3> axes(const Eigen::Matrix3d& m) {
  const Eigen::Matrix3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors();
  return {column(v, 0), column(v, 1), column(v, 2)};
}

/// With the sign that MirrorPlane asks for, and axes without rounding.
MirrorPlane plane_through(Vec3 normal, Vec3 point) {
  std::array<double, 3> n{normal.x, normal.y, normal.z};
  for (double& c : n) {
    c = std::abs(c) < axis_rounding ? 0.0 : c;
  }
  normal = normalized(Vec3{n[0], n[1], n[2]});
  const double sign = normal.x != 0.0 ? normal.x : normal.y != 0.0 ? normal.y : normal.z;
  normal = sign < 0.0 ? -normal : normal;
  // Without negative zeros: they would be written into files.
  normal = normal + Vec3{};
  return {normal, dot(normal, point)};
}

/// Drops partners whose partner is another one.
template <class I>
void keep_pairs(IdVector<I, I>& partner) {
  for (const I i : ids<I>(partner.size())) {
    if (partner[i].valid() && partner[partner[i]] != i) {
      partner[i] = I();
    }
  }
}

void keep_pairs(Correspondence& maps) {
  keep_pairs(maps.vertex);
  keep_pairs(maps.edge);
  keep_pairs(maps.face);
}

class MirrorSearch {
 public:
  MirrorSearch(const mesh::Surface& surface, std::size_t most, const SymmetryTolerance& tolerance)
      : surface_(surface),
        most_(most),
        extent_(surface.bounds().largest_extent()),
        exact_(tolerance.exact * extent_),
        near_(tolerance.near * extent_),
        points_(surface.points().begin(), surface.points().end()),
        places_(places(points_)),
        tree_(points_, places_) {
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      longest_ = std::max(longest_, surface.length(e));
    }
  }

  std::vector<Mirror> all() {
    std::vector<Mirror> found;
    try_planes([&](const MirrorPlane& plane) {
      Mirror mirror = compared(plane, most_compared);
      if (mirror.deviation <= near_ && !known(plane, mirror.exact ? same_plane : same_near_plane) &&
          is_mapped(mirror)) {
        taken_.push_back(plane);
        found.push_back(std::move(mirror));
      }
      return found.size() < most_;
    });
    std::stable_sort(found.begin(), found.end(), [](const Mirror& a, const Mirror& b) {
      return a.exact != b.exact ? a.exact : !a.exact && a.deviation < b.deviation;
    });
    return found;
  }

  void until(const std::function<bool(const Mirror&)>& use) {
    bool used = false;
    std::size_t offered = 0;
    std::vector<Mirror> inexact;
    const auto offer = [&](Mirror mirror) {
      if (is_mapped(mirror)) {
        ++offered;
        used = use(mirror);
      }
    };
    try_planes([&](const MirrorPlane& plane) {
      Mirror mirror = compared(plane, most_fitted);
      if (mirror.exact) {
        mirror = compared(plane, most_compared);
      }
      if (mirror.exact) {
        taken_.push_back(plane);
        offer(std::move(mirror));
      } else if (mirror.deviation <= near_ && !known(plane, same_near_plane)) {
        taken_.push_back(plane);
        inexact.push_back(std::move(mirror));
      }
      return !used && offered + inexact.size() < most_;
    });
    std::stable_sort(inexact.begin(), inexact.end(),
                     [](const Mirror& a, const Mirror& b) { return a.deviation < b.deviation; });
    taken_.clear();
    for (std::size_t i = 0; i < inexact.size() && !used && offered < most_; ++i) {
      Mirror mirror = compared(inexact[i].plane, most_compared);
      if (mirror.deviation <= near_ && !known(mirror.plane, same_near_plane)) {
        taken_.push_back(mirror.plane);
        offer(std::move(mirror));
      }
    }
  }

 private:
  /// Calls take() with each plane that few corners don't speak against, until it returns false.
  void try_planes(const std::function<bool(const MirrorPlane&)>& take) {
    take_ = take;
    goes_on_ = true;
    const AreaFrame frame = area_frame(surface_);
    const Vec3 middle = 0.5 * (surface_.bounds().low + surface_.bounds().high);
    for (const Vec3 axis :
         {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, frame.axes[0], frame.axes[1], frame.axes[2]}) {
      try_plane(plane_through(axis, frame.centre));
      try_plane(plane_through(axis, middle));
    }
    if (goes_on_) {
      try_images(frame.centre);
    }
  }

  static std::vector<std::uint32_t> places(const std::vector<Vec3>& points) {
    const std::vector<std::uint32_t> first = first_at_place(points);
    std::vector<std::uint32_t> result;
    for (std::uint32_t v = 0; v < first.size(); ++v) {
      if (first[v] == v) {
        result.push_back(v);
      }
    }
    return result;
  }

  /// Distance of a point from the surface; any other one within `enough` where it is, and any beyond it and
  /// beyond the near tolerance where it is beyond both.
  [[nodiscard]] double distance(Vec3 p, double enough) {
    if (tree_.nearest(p, enough) != no_index) {
      return 0.0;
    }
    if (asks_corners()) {
      const std::uint32_t corner = tree_.nearest(p, std::max(enough, near_) + longest_);
      if (corner == no_index) {
        return INFINITY;
      }
      return distance_by_corners(p, length(points_[corner] - p) + longest_);
    }
    if (!faces_) {
      faces_.emplace(surface_, INFINITY);
    }
    return faces_->distance(p, enough);
  }

  [[nodiscard]] bool asks_corners() {
    return places_.size() == points_.size() &&
           (longest_ <= near_ || (longest_ <= nearly_fine * near_ && ++asked_ <= few_questions));
  }

  /// A face has a corner that is farther off than the face by no more than its longest side. So of a fine
  /// surface few corners, those within `far`, tell how far it is, and no tree of its faces has to be made.
  [[nodiscard]] double distance_by_corners(Vec3 p, double far) const {
    double least = INFINITY;
    tree_.search(
        p, [&](double squared) { return squared <= far * far; },
        [&](std::uint32_t v) {
          const Vec3 off = points_[v] - p;
          if (dot(off, off) > far * far) {
            return;
          }
          for (const CornerId corner : surface_.corners_at(VertexId(v))) {
            const auto [a, b, c] = surface_.vertices(mesh::face_of(corner));
            least = std::min(
                least, mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p));
          }
        });
    return std::sqrt(least);
  }

  [[nodiscard]] bool known(const MirrorPlane& plane, double closeness) const {
    return std::any_of(taken_.begin(), taken_.end(), [&](const MirrorPlane& other) {
      const double way = dot(other.normal, plane.normal) < 0.0 ? -1.0 : 1.0;
      return length(other.normal - way * plane.normal) < closeness &&
             std::abs(other.offset - way * plane.offset) < closeness * extent_;
    });
  }

  /// Do the images of some corners, spread over all, lie within `reach` of the surface?
  [[nodiscard]] bool worth_fitting(const MirrorPlane& plane, double reach) {
    const std::size_t step = step_for(first_corners);
    for (std::size_t i = 0; i < places_.size(); i += step) {
      if (distance(plane.image(points_[places_[i]]), reach) > reach) {
        return false;
      }
    }
    return true;
  }

  /// Least squares over corners and the corners nearest to their images; of the same surface mirrored at the
  /// best plane sum |q - image(p)|^2 is least, and its normal is the eigenvector of the least eigenvalue of
  /// sum (p q^T + q p^T) about the means.
  [[nodiscard]] std::optional<MirrorPlane> fitted(const MirrorPlane& plane, double reach, std::size_t step) {
    Vec3 sum_p;
    Vec3 sum_q;
    std::vector<std::array<std::uint32_t, 2>> pairs;
    std::size_t tried = 0;
    for (std::size_t i = 0; i < places_.size(); i += step) {
      const Vec3 p = points_[places_[i]];
      const std::uint32_t q = tree_.nearest(plane.image(p), reach);
      ++tried;
      if (q != no_index) {
        pairs.push_back({places_[i], q});
        sum_p += p;
        sum_q += points_[q];
      }
    }
    if (2 * pairs.size() < tried || pairs.size() < 3) {
      return std::nullopt;
    }
    const double count = static_cast<double>(pairs.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& [p, q] : pairs) {
      spread += outer_product(points_[p] - sum_p / count, points_[q] - sum_q / count);
    }
    const Vec3 normal = axes(spread + spread.transpose().eval())[0];
    // Few corners, or such in one line, say nothing about some directions.
    if (std::abs(dot(normal, plane.normal)) < 1.0 - first_reach) {
      return std::nullopt;
    }
    return plane_through(normal, (sum_p + sum_q) / (2.0 * count));
  }

  void try_plane(MirrorPlane plane) {
    if (!goes_on_ || known(plane, same_plane) || !worth_fitting(plane, first_reach * extent_)) {
      return;
    }
    const std::size_t step = step_for(most_fitted);
    // An exact plane needs no fit, and one could only lose digits of it.
    if (!worth_fitting(plane, exact_)) {
      double reach = first_reach * extent_;
      for (int i = 0; i < fits; ++i, reach *= 0.5) {
        plane = fitted(plane, reach, step).value_or(plane);
      }
      plane = fitted(plane, 4.0 * exact_, step_for(most_compared)).value_or(plane);
    }
    if (!holds_all(plane) && worth_fitting(plane, near_)) {
      goes_on_ = take_(plane);
    }
  }

  [[nodiscard]] bool holds_all(const MirrorPlane& plane) const {
    return std::all_of(places_.begin(), places_.end(),
                       [&](std::uint32_t v) { return std::abs(plane.height(points_[v])) <= flat * near_; });
  }

  /// Every so many places are about `most`.
  [[nodiscard]] std::size_t step_for(std::size_t most) const {
    return std::max<std::size_t>(1, places_.size() / most);
  }

  /// How far about so many corners, spread over all, are off their images; until one is too far.
  [[nodiscard]] Mirror compared(const MirrorPlane& plane, std::size_t corners) {
    Mirror mirror;
    mirror.plane = plane;
    mirror.exact = true;
    for (std::size_t i = 0; i < places_.size() && mirror.deviation <= near_; i += step_for(corners)) {
      look_at(places_[i], mirror);
    }
    return mirror;
  }

  void look_at(std::uint32_t v, Mirror& mirror) {
    const Vec3 image = mirror.plane.image(points_[v]);
    const std::uint32_t partner = tree_.nearest(image, exact_);
    if (partner != no_index) {
      mirror.deviation = std::max(mirror.deviation, length(points_[partner] - image));
      return;
    }
    mirror.exact = false;
    mirror.deviation = std::max(mirror.deviation, distance(image, exact_));
  }

  /// Adds the maps, which must have every face; and looks at the corners without a partner, of which a
  /// comparison in places may have seen none.
  [[nodiscard]] bool is_mapped(Mirror& mirror) {
    mirror.maps = correspond(surface_, surface_, mirroring(mirror.plane), mirror.exact ? exact_ : near_);
    keep_pairs(mirror.maps);
    if (mirror.exact && !mirror.maps.whole && places_.size() > most_compared) {
      for (const std::uint32_t v : places_) {
        if (!mirror.maps.vertex[VertexId(v)].valid()) {
          look_at(v, mirror);
        }
      }
      if (mirror.deviation > near_) {
        return false;
      }
    }
    return mirror.maps.whole || middles_have_images(mirror.plane);
  }

  /// Corners alone don't see that a face is missing on one side, or bent the other way.
  [[nodiscard]] bool middles_have_images(const MirrorPlane& plane) {
    const auto step =
        static_cast<std::uint32_t>(std::max<std::size_t>(1, surface_.face_count() / most_compared));
    for (std::uint32_t i = 0; i < surface_.face_count(); i += step) {
      const auto [a, b, c] = surface_.vertices(FaceId(i));
      const Vec3 middle = (surface_.point(a) + surface_.point(b) + surface_.point(c)) / 3.0;
      for (const VertexId v : {a, b, c}) {
        // Off the middle: where a square is divided the other way, that lies on the side of a triangle.
        if (distance(plane.image(0.5 * (middle + surface_.point(v))), near_) > near_) {
          return false;
        }
      }
    }
    return true;
  }

  /// Every exact plane holds the centre and maps corners at one distance from it onto each other. The fewest
  /// corners at one distance give the fewest planes: between one of them and each other one; and through it,
  /// then between a second corner and those as far as that one, or through both.
  void try_images(Vec3 centre) {
    const std::vector<std::vector<std::uint32_t>> shells = shells_about(centre);
    if (shells.empty()) {
      return;
    }
    const std::uint32_t v = shells[0][0];
    try_images_of(v, shells[0], centre);
    const Vec3 axis = normalized(points_[v] - centre);
    for (const auto& shell : shells) {
      const auto off = std::find_if(shell.begin(), shell.end(), [&](std::uint32_t u) {
        return length(cross(points_[u] - centre, axis)) > first_reach * extent_;
      });
      if (off != shell.end()) {
        try_plane(plane_through(normalized(cross(points_[*off] - centre, axis)), centre));
        for (std::size_t i = 0; i < shell.size(); ++i) {
          const Vec3 between = points_[shell[i]] - points_[*off];
          if (shell[i] != *off && std::abs(dot(between, axis)) <= 10.0 * exact_) {
            try_plane(plane_through(normalized(between), centre));
          }
        }
        return;
      }
    }
  }

  void try_images_of(std::uint32_t v, const std::vector<std::uint32_t>& shell, Vec3 centre) {
    for (const std::uint32_t w : shell) {
      if (w != v) {
        try_plane(plane_through(normalized(points_[w] - points_[v]), centre));
      }
    }
  }

  /// Corners at the same distance from the centre, the smallest shells first; not those in the centre, and
  /// not shells of more than most_images.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> shells_about(Vec3 centre) const {
    std::vector<std::pair<double, std::uint32_t>> far;
    for (const std::uint32_t v : places_) {
      const double d = length(points_[v] - centre);
      if (d > first_reach * extent_) {
        far.emplace_back(d, v);
      }
    }
    std::sort(far.begin(), far.end());
    std::vector<std::vector<std::uint32_t>> shells;
    for (std::size_t i = 0; i < far.size(); ++i) {
      if (i == 0 || far[i].first - far[i - 1].first > exact_) {
        shells.emplace_back();
      }
      shells.back().push_back(far[i].second);
    }
    std::erase_if(shells, [](const auto& shell) { return shell.size() > most_images; });
    std::stable_sort(shells.begin(), shells.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    return shells;
  }

  const mesh::Surface& surface_;
  std::size_t most_;
  double extent_;
  double exact_;
  double near_;
  double longest_ = 0.0;   ///< side of a face
  std::size_t asked_ = 0;  ///< questions of a nearly fine surface
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> places_;
  NearbyPoints tree_;
  std::optional<mesh::SurfaceTree> faces_;  ///< made when first needed
  std::vector<MirrorPlane> taken_;
  std::function<bool(const MirrorPlane&)> take_;  ///< what becomes of a plane; false ends the search
  bool goes_on_ = true;
};

}  // namespace

std::vector<Mirror> find_mirrors(const mesh::Surface& surface, std::size_t most,
                                 const SymmetryTolerance& tolerance) {
  if (surface.face_count() == 0 || most == 0) {
    return {};
  }
  return MirrorSearch(surface, most, tolerance).all();
}

void for_mirrors(const mesh::Surface& surface, std::size_t most, const SymmetryTolerance& tolerance,
                 const std::function<bool(const Mirror&)>& use) {
  if (surface.face_count() > 0 && most > 0) {
    MirrorSearch(surface, most, tolerance).until(use);
  }
}

IdVector<EdgeId, EdgeId> mirror_edges(const mesh::Surface& surface, const MirrorPlane& plane,
                                      double tolerance) {
  const double radius = tolerance * surface.bounds().largest_extent();
  IdVector<EdgeId, EdgeId> partner = match_edges(surface, surface, mirroring(plane), radius);
  keep_pairs(partner);
  return partner;
}

}  // namespace ridgecraft::prepare
