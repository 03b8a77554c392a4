// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/bodies/thin_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/bodies/faces_met.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

/// Skins are parallel when their normals are opposite within 45 degrees (cosine).
constexpr double opposite = -0.7071067811865476;
/// Between two faces nothing is seen through, share of the thickness that counts as thin.
constexpr double face_hair = 1e-6;
/// A face belongs to a skin if so many of its places have the other one behind them.
constexpr double most_places = 0.5;
/// Where two skins meet at an edge as sharp as this there is no rim between them, radians (120 degrees).
constexpr double sharp = 2.0943951023931953;
/// Faces beside skins hang together where they bend by less than this, radians (45 degrees).
constexpr double blunt = 0.7853981633974483;
/// Faces between skins are steps of one, not a rim or a flange, if they are narrower than this share of the
/// thickness that counts as thin.
constexpr double narrow = 0.5;
/// So often faces may join a skin beside those that have just joined it.
constexpr int most_rounds = 8;
/// Skins are against each other where this share of one of them has the other behind it; at sharp corners a
/// skin has a little of itself behind it.
constexpr double few_against = 0.1;
/// What goes is nowhere farther from what stays than this many times the thickness that counts as thin.
constexpr double reach = 1.25;
/// Skins that differ by less than this share of their area are equally large.
constexpr double equal_skins = 1e-6;
/// A component is left as it is where less than this share of it would go.
constexpr double least_gone = 0.25;
/// A skin has a twin where this share of its area at least has one other skin behind it.
constexpr double least_paired = 0.8;
/// Components that are smaller than this share of the model are plates on something: as sheets they would
/// hang on nothing.
constexpr double least_extent = 0.5;
/// No wall is thin that is thicker than this share of the model: a house as small as a thumbnail is a house.
constexpr double most_fraction = 0.05;
/// Of so many faces of a component, spread over it, those with another skin behind them have this share of
/// the area at least, or nothing is looked at more closely.
constexpr std::size_t few_faces = 200;
constexpr double few_thin = 0.25;
/// Places of a face are about as far apart as walls are thin, but no more than so many along a side.
constexpr double most_steps = 8.0;

/// Places inside a face, spread over it.
std::vector<Vec3> places_of(const mesh::Surface& surface, FaceId f, double spacing) {
  const auto [a, b, c] = surface.vertices(f);
  const Vec3 u = surface.point(b) - surface.point(a);
  const Vec3 v = surface.point(c) - surface.point(a);
  // By its longest side: of the long faces of a wall one end may be beside something else.
  const double longest = std::max({length(u), length(v), length(v - u)});
  const int steps = static_cast<int>(std::clamp(longest / spacing, 1.0, most_steps));
  std::vector<Vec3> places;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; i + k < steps; ++k) {
      places.push_back(surface.point(a) + (i + 1.0 / 3.0) / steps * u + (k + 1.0 / 3.0) / steps * v);
    }
  }
  return places;
}

/// One component, and which of its faces stay.
class ThinWalls {
 public:
  /// `number`: of each face its place in its component.
  ThinWalls(const mesh::Surface& surface, const std::vector<FaceId>& faces,
            const IdVector<FaceId, std::uint32_t>& number, double thin, const Context& context)
      : surface_(surface),
        faces_(faces),
        number_(number),
        thin_(thin),
        context_(context),
        tree_(surface, faces, face_hair) {}

  /// One answer for each face; nothing where the component stays as it is.
  [[nodiscard]] std::optional<std::vector<bool>> stays() {
    if (!may_have_two_skins()) {
      return std::nullopt;
    }
    look_behind();
    find_patches();
    const std::optional<std::uint32_t> kept = larger_skin();
    if (!kept) {
      return std::nullopt;
    }
    return without_what_is_near(*kept);
  }

  /// Of faces that stay: how thick the wall is there, 0 where that isn't known. By place in the component.
  [[nodiscard]] const std::vector<double>& thickness() const { return thickness_; }

 private:
  /// A few faces tell of most bodies that they aren't thin.
  [[nodiscard]] bool may_have_two_skins() const {
    double thin_area = 0.0;
    double area = 0.0;
    const std::size_t step = std::max<std::size_t>(1, faces_.size() / few_faces);
    for (std::size_t i = 0; i < faces_.size(); i += step) {
      for (const Vec3 p : places_of(surface_, faces_[i], thin_)) {
        thin_area += behind(p, faces_[i]) ? surface_.area(faces_[i]) : 0.0;
        area += surface_.area(faces_[i]);
      }
    }
    return thin_area >= few_thin * area;
  }

  /// What is no farther behind a place of a face than a wall is thin.
  [[nodiscard]] std::optional<FacesMet::Met> behind(Vec3 p, FaceId f) const {
    return tree_.find(p, -thin_ * surface_.normal(f), [&](FaceId other) {
      return other != f && dot(surface_.normal(other), surface_.normal(f)) <= opposite;
    });
  }

  void look_behind() {
    behind_.resize(faces_.size());
    thickness_.assign(faces_.size(), 0.0);
    paired_.assign(faces_.size(), false);
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      context_.check();
      const std::vector<Vec3> places = places_of(surface_, faces_[i], thin_);
      for (const Vec3 p : places) {
        if (const auto found = behind(p, faces_[i])) {
          behind_[i].push_back(number_[found->face]);
          thickness_[i] += found->at * thin_;
        }
      }
      thickness_[i] /= std::max<double>(1.0, static_cast<double>(behind_[i].size()));
      paired_[i] = static_cast<double>(behind_[i].size()) >= most_places * static_cast<double>(places.size());
    }
  }

  /// Patches of faces that hang together, those of skins apart from the others.
  void find_patches() {
    in_skin_ = paired_;
    DisjointSets sets = hang_together();
    // Faces that have joined a skin may be what parted it from others.
    for (int round = 0; round < most_rounds && join_corners_and_steps(sets); ++round) {
      context_.check();
      sets = hang_together();
    }
    patch_.resize(faces_.size());
    area_.assign(faces_.size(), 0.0);
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      patch_[i] = sets.find(i);
      area_[patch_[i]] += surface_.area(faces_[i]);
    }
  }

  [[nodiscard]] DisjointSets hang_together() const {
    DisjointSets sets(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(faces_[i], k);
        const FaceId g = surface_.neighbor(c);
        if (!g.valid() || surface_.fold_angle(surface_.edge(c)) < -sharp) {
          continue;
        }
        // A rim and the round corner of a wall that it ends at are two things.
        const std::uint32_t other = number_[g];
        if (in_skin_[other] == in_skin_[i] && (in_skin_[i] || is_blunt(c))) {
          sets.join(i, other);
        }
      }
    }
    return sets;
  }

  [[nodiscard]] bool is_blunt(CornerId c) const {
    return std::abs(surface_.fold_angle(surface_.edge(c))) <= blunt;
  }

  /// Faces of no skin that hang together, and the skins that they touch, by the first face of each.
  struct Between {
    double area = 0.0;
    double outline_mm = 0.0;
    std::set<std::uint32_t> skins;
    bool goes_on = false;  ///< from one of them without a bend
    bool joins = false;    ///< one of them, and is no rim
  };

  /// Round a corner of a wall the other skin is beside a face rather than behind it, and a skin that was made
  /// of small cubes has steps: what lies between patches of skins belongs to them, unless two of them are
  /// against each other. Then it is the rim between them. Returns whether anything joined a skin.
  bool join_corners_and_steps(DisjointSets& sets) {
    // Of each skin: those that it has behind it, and how much of its area has.
    std::map<std::uint32_t, std::map<std::uint32_t, double>> against;
    std::vector<double> area(faces_.size(), 0.0);
    std::map<std::uint32_t, Between> between;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      area[sets.find(i)] += surface_.area(faces_[i]);
      if (in_skin_[i]) {
        for (const std::uint32_t other : behind_[i]) {
          against[sets.find(i)][sets.find(other)] +=
              surface_.area(faces_[i]) / static_cast<double>(behind_[i].size());
        }
      } else {
        look_around(i, sets, between[sets.find(i)]);
      }
    }
    const auto is_rim = [&](const Between& faces) {
      return std::ranges::any_of(faces.skins, [&](std::uint32_t skin) {
        return std::ranges::any_of(against[skin], [&](const auto& behind) {
          return behind.second >= few_against * area[skin] && faces.skins.contains(behind.first);
        });
      });
    };
    for (auto& [first, faces] : between) {
      const bool is_step = 2.0 * faces.area <= narrow * thin_ * faces.outline_mm;
      faces.joins = !faces.skins.empty() && (is_step || faces.goes_on) && !is_rim(faces);
    }
    bool any = false;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (!in_skin_[i] && between[sets.find(i)].joins) {
        in_skin_[i] = true;
        any = true;
      }
    }
    return any;
  }

  void look_around(std::uint32_t i, DisjointSets& sets, Between& here) const {
    here.area += surface_.area(faces_[i]);
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(faces_[i], k);
      const FaceId g = surface_.neighbor(c);
      if (g.valid() && sets.find(number_[g]) == sets.find(i)) {
        continue;
      }
      here.outline_mm += surface_.length(surface_.edge(c));
      if (g.valid() && in_skin_[number_[g]] && surface_.fold_angle(surface_.edge(c)) >= -sharp) {
        here.skins.insert(sets.find(number_[g]));
        here.goes_on = here.goes_on || is_blunt(c);
      }
    }
  }

  /// The larger one of the two skins that have each other behind them; by its patch.
  [[nodiscard]] std::optional<std::uint32_t> larger_skin() const {
    std::optional<std::uint32_t> largest;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (in_skin_[i] && patch_[i] == i && (!largest || area_[i] > (1.0 + equal_skins) * area_[*largest])) {
        largest = i;
      }
    }
    if (!largest) {
      return std::nullopt;
    }
    std::map<std::uint32_t, double> behind;  // area by patch
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (patch_[i] == *largest) {
        for (const std::uint32_t other : behind_[i]) {
          behind[patch_[other]] += surface_.area(faces_[i]) / static_cast<double>(behind_[i].size());
        }
      }
    }
    if (behind.empty()) {
      return std::nullopt;
    }
    const auto most = std::max_element(behind.begin(), behind.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const bool has_twin =
        most->first != *largest && in_skin_[most->first] && most->second >= least_paired * area_[*largest];
    return has_twin ? largest : std::nullopt;
  }

  /// All patches go that lie near the skin that stays with all their places.
  [[nodiscard]] std::optional<std::vector<bool>> without_what_is_near(std::uint32_t skin) const {
    std::vector<FaceId> stay;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (patch_[i] == skin) {
        stay.push_back(faces_[i]);
      }
    }
    const mesh::Surface sheet = mesh::faces_alone(surface_, stay);
    const mesh::SurfaceTree near(sheet, sheet.bounds().largest_extent());
    const double farthest = reach * thin_;
    const auto is_near = [&](Vec3 p) { return near.distance(p, farthest) <= farthest; };
    std::vector<bool> goes(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      goes[i] = patch_[i] == i && i != skin;
    }
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      context_.check();
      if (!goes[patch_[i]]) {
        continue;
      }
      const std::array<VertexId, 3> corners = surface_.vertices(faces_[i]);
      const std::vector<Vec3> places = places_of(surface_, faces_[i], thin_);
      goes[patch_[i]] = std::all_of(corners.begin(), corners.end(),
                                    [&](VertexId v) { return is_near(surface_.point(v)); }) &&
                        std::all_of(places.begin(), places.end(), is_near);
    }
    double gone = 0.0;
    double all = 0.0;
    std::vector<bool> stays(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      stays[i] = !goes[patch_[i]];
      all += surface_.area(faces_[i]);
      gone += stays[i] ? 0.0 : surface_.area(faces_[i]);
    }
    return gone >= least_gone * all ? std::optional(std::move(stays)) : std::nullopt;
  }

  const mesh::Surface& surface_;
  const std::vector<FaceId>& faces_;
  const IdVector<FaceId, std::uint32_t>& number_;
  double thin_;
  const Context& context_;
  FacesMet tree_;
  std::vector<std::vector<std::uint32_t>> behind_;  ///< per face: what its places have behind them
  std::vector<double> thickness_;                   ///< per face, mean of its places
  std::vector<bool> paired_;                        ///< per face: whether the other skin is behind it
  std::vector<bool> in_skin_;                       ///< per face: whether it belongs to a skin
  std::vector<std::uint32_t> patch_;                ///< per face: the first face of its patch
  std::vector<double> area_;                        ///< by the first face of each patch
};

/// Moves points by half of the wall's thickness into the wall.
void move_to_middle(mesh::LooseFaces& loose, const mesh::Surface& surface,
                    const IdVector<FaceId, double>& thickness) {
  std::vector<Vec3> moved = loose.points;
  for (const VertexId v : ids<VertexId>(surface.points().size())) {
    Vec3 normal;
    double thick = 0.0;
    double area = 0.0;
    for (const CornerId c : surface.corners_at(v)) {
      const FaceId f = mesh::face_of(c);
      if (thickness[f] > 0.0) {
        normal += surface.area(f) * surface.normal(f);
        thick += surface.area(f) * thickness[f];
        area += surface.area(f);
      }
    }
    if (area > 0.0 && length(normal) > 0.0) {
      moved[v.value()] -= 0.5 * thick / area * normalized(normal);
    }
  }
  loose.points = std::move(moved);
}

}  // namespace

ThinWallReport merge_thin_walls(mesh::Model& model, Skins skins, double thin, const Context& context) {
  ThinWallReport report;
  const mesh::Surface& surface = model.surface;
  thin = std::min(thin, most_fraction * surface.bounds().largest_extent());
  if (skins == Skins::both || !(thin > 0.0)) {
    return report;
  }
  const std::vector<std::vector<FaceId>> components = prepare::components(surface);
  IdVector<FaceId, std::uint32_t> number(surface.face_count());
  for (const std::vector<FaceId>& faces : components) {
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      number[faces[i]] = i;
    }
  }
  std::vector<bool> kept(surface.face_count(), true);
  IdVector<FaceId, double> thickness(surface.face_count(), 0.0);
  const std::vector<Box3> boxes = mesh::component_bounds(surface);
  for (std::size_t c = 0; c < components.size(); ++c) {
    const std::vector<FaceId>& faces = components[c];
    if (boxes[c].largest_extent() < least_extent * surface.bounds().largest_extent()) {
      continue;
    }
    ThinWalls walls(surface, faces, number, thin, context);
    const auto stays = walls.stays();
    if (!stays) {
      continue;
    }
    ++report.walls;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      kept[faces[i].value()] = (*stays)[i];
      if ((*stays)[i]) {
        thickness[faces[i]] = walls.thickness()[i];
        report.thickness_mm = std::max(report.thickness_mm, walls.thickness()[i]);
      }
    }
  }
  if (report.walls == 0) {
    return report;
  }
  if (skins == Skins::middle) {
    mesh::LooseFaces loose = mesh::take_apart(model);
    move_to_middle(loose, surface, thickness);
    mesh::put_together(model, std::move(loose));
  }
  mesh::keep_faces(model, kept);
  return report;
}

}  // namespace ridgecraft::prepare
