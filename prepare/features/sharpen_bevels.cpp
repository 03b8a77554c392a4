// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/sharpen_bevels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/features/merged_regions.hpp"
#include "prepare/panels/panel_regions.hpp"
#include "prepare/panels/polygon_panels.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/walls/fold_figures.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Faces beside a bevel are folded by less than this against it each, as at most 90 degrees are between them
/// at the rim of a plate.
constexpr double bevel_fold = 75.0 * std::numbers::pi / 180.0;
/// A fold of less is none, so there is nothing to be sharpened.
constexpr double least_fold = 3.0 * std::numbers::pi / 180.0;
/// A bevel is so many times as long as it is wide.
constexpr double oblong = 1.5;
/// Planes are left by this share of what the surface may move, since more is done to it afterwards.
constexpr double bevel_moves = 0.8;
/// A new corner is no farther from the old ones than so many times the width of the widest bevel that ends
/// there.
constexpr double corner_reach = 2.0;
/// Corners are off the planes of the faces around them by no more than this share of the diagonal.
constexpr double bevel_in_plane = 5e-6;
/// What has more faces is collapsed first.
constexpr std::size_t too_many_to_sharpen = 100000;

class Sharpener {
 public:
  Sharpener(const mesh::Model& model, double short_edge, double largest_mm, const std::vector<bool>& too_fine)
      : surface_(model.surface),
        loose_(mesh::take_apart(model)),
        regions_(surface_, find_polygon_panels(model), loose_),
        short_edge_(short_edge),
        largest_mm_(largest_mm),
        near_(bevel_in_plane * surface_.bounds().diagonal()),
        goes_(regions_.count(), false) {
    find_planes();
    find_bevels(too_fine);
  }

  /// How many went. What can't go is left out, and the others are tried again.
  std::size_t run(mesh::Model& model) {
    constexpr int most_attempts = 30;
    if (!bevels_.empty()) {
      as_it_is_.emplace(surface_, short_edge_);
    }
    for (int attempt = 0; attempt < most_attempts && !bevels_.empty(); ++attempt) {
      RegionChanges changes(loose_, regions_);
      if (!settle(changes)) {
        continue;
      }
      MergedRegions result = merged_regions(surface_, loose_, regions_, changes);
      if (result.failed.empty() && mesh::is_surface(result.faces)) {
        const std::vector<Vec3> far = places_left(result.faces);
        if (far.empty()) {
          const std::size_t count = bevels_.size();
          mesh::put_together(model, std::move(result.faces));
          return count;
        }
        if (!leave_out_near(far)) {
          break;
        }
        continue;
      }
      if (!leave_out_beside(result.failed)) {
        break;
      }
    }
    return 0;
  }

 private:
  struct Bevel {
    std::uint32_t region = 0;
    /// The points at both of its ends; equal where it runs out in a tip.
    std::array<std::array<std::uint32_t, 2>, 2> rungs{};
    double width = 0.0;
  };

  void find_planes() {
    planes_.resize(regions_.count());
    for (std::uint32_t r = 0; r < regions_.count(); ++r) {
      Vec3 doubled;
      double area = 0.0;
      Vec3 moment;
      for (const std::uint32_t f : regions_.faces(r)) {
        const auto [a, b, c] = surface_.vertices(FaceId(f));
        const double own = surface_.area(FaceId(f));
        doubled += own * surface_.normal(FaceId(f));
        moment += (own / 3.0) * (surface_.point(a) + surface_.point(b) + surface_.point(c));
        area += own;
      }
      planes_[r].normal = normalized(doubled);
      planes_[r].offset = area > 0.0 ? dot(moment / area, planes_[r].normal) : 0.0;
    }
  }

  void find_bevels(const std::vector<bool>& too_fine) {
    for (std::uint32_t r = 0; r < regions_.count(); ++r) {
      if (too_fine[surface_.component(FaceId(regions_.faces(r).front())).value()]) {
        if (const auto bevel = bevel_of(r)) {
          bevels_.push_back(*bevel);
        }
      }
    }
  }

  /// The sides of a region in order around it, if it has one outline of three or four.
  [[nodiscard]] std::vector<CornerId> few_sides(std::uint32_t region) const {
    std::vector<CornerId> sides;
    for (const std::uint32_t f : regions_.faces(region)) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(FaceId(f), k);
        if (regions_.on_border(surface_.edge(c))) {
          sides.push_back(c);
        }
      }
    }
    if (sides.size() > 4 || sides.size() != regions_.faces(region).size() + 2) {
      return {};
    }
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      const auto next = std::find_if(
          sides.begin() + static_cast<std::ptrdiff_t>(i) + 1, sides.end(),
          [&](CornerId c) { return surface_.vertex(c) == surface_.vertex(mesh::next(sides[i])); });
      if (next != sides.end()) {
        std::swap(sides[i + 1], *next);
      }
    }
    return sides;
  }

  [[nodiscard]] std::optional<Bevel> bevel_of(std::uint32_t region) const {
    std::vector<CornerId> sides = few_sides(region);
    if (sides.empty()) {
      return std::nullopt;
    }
    const bool pointed = sides.size() == 3;
    const auto size = [&](std::size_t k) { return surface_.length(surface_.edge(sides[k])); };
    // The first side is to be a rung: the shortest one, or one of the two that are shorter.
    while (pointed ? size(0) > std::min(size(1), size(2))
                   : std::max(size(0), size(2)) > std::max(size(1), size(3))) {
      std::rotate(sides.begin(), sides.begin() + 1, sides.end());
    }
    const std::size_t last = sides.size() - 1;
    const double width = pointed ? size(0) : std::max(size(0), size(2));
    const auto fold = [&](std::size_t k) {
      const EdgeId e = surface_.edge(sides[k]);
      return surface_.is_border(e) ? 0.0 : surface_.fold_angle(e);
    };
    const double left = fold(1);
    const double right = fold(last);
    if (width >= short_edge_ || std::min(size(1), size(last)) < oblong * width || left * right <= 0.0 ||
        std::min(std::abs(left), std::abs(right)) < least_fold ||
        std::max(std::abs(left), std::abs(right)) > bevel_fold) {
      return std::nullopt;
    }
    const auto ends = [&](std::size_t k) {
      return std::array<std::uint32_t, 2>{surface_.vertex(sides[k]).value(),
                                          surface_.vertex(mesh::next(sides[k])).value()};
    };
    const std::uint32_t tip = ends(1)[1];
    return Bevel{region, {ends(0), pointed ? std::array<std::uint32_t, 2>{tip, tip} : ends(2)}, width};
  }

  /// Finds the places of the corners; false where some bevel couldn't go, which is left out.
  bool settle(RegionChanges& changes) {
    std::fill(goes_.begin(), goes_.end(), false);
    DisjointSets corners(surface_.vertex_count());
    std::vector<double> reach(surface_.vertex_count(), 0.0);
    std::vector<bool> is_end(surface_.vertex_count(), false);
    for (const Bevel& bevel : bevels_) {
      goes_[bevel.region] = true;
      for (const auto& [a, b] : bevel.rungs) {
        corners.join(a, b);
        is_end[a] = is_end[b] = true;
        reach[a] = std::max(reach[a], bevel.width);
        reach[b] = std::max(reach[b], bevel.width);
      }
    }
    const auto members = members_of(corners, is_end);
    std::vector<bool> bad(surface_.vertex_count(), false);
    bool fine = true;
    for (const std::vector<std::uint32_t>& points : members) {
      if (points.empty()) {
        continue;
      }
      if (const auto place = place_of(points, reach)) {
        for (const std::uint32_t p : points) {
          changes.becomes[p] = points.front();
        }
        changes.places[points.front()] = *place;
      } else {
        fine = false;
        for (const std::uint32_t p : points) {
          bad[p] = true;
        }
      }
    }
    if (!fine) {
      leave_out([&](const Bevel& bevel) { return bad[bevel.rungs[0][0]] || bad[bevel.rungs[1][0]]; });
    }
    return fine;
  }

  [[nodiscard]] static std::vector<std::vector<std::uint32_t>> members_of(DisjointSets& sets,
                                                                          const std::vector<bool>& which) {
    std::vector<std::vector<std::uint32_t>> members(which.size());
    for (std::uint32_t v = 0; v < which.size(); ++v) {
      if (which[v]) {
        members[sets.find(v)].push_back(v);
      }
    }
    return members;
  }

  /// Where the planes of all regions that stay around these points meet.
  [[nodiscard]] std::optional<Vec3> place_of(const std::vector<std::uint32_t>& points,
                                             const std::vector<double>& reach) const {
    Vec3 middle;
    double far = 0.0;
    std::vector<std::uint32_t> around;
    for (const std::uint32_t p : points) {
      middle += loose_.points[p] / static_cast<double>(points.size());
      far = std::max(far, corner_reach * reach[p]);
      for (const CornerId c : surface_.corners_at(VertexId(p))) {
        const std::uint32_t region = regions_.region(mesh::face_of(c).value());
        if (!goes_[region] && !lies_within(region, points)) {
          around.push_back(region);
        }
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    Meeting meeting(middle);
    for (const std::uint32_t region : around) {
      meeting.add(planes_[region].normal, planes_[region].offset);
    }
    const Vec3 place = meeting.place();
    const bool in_all = std::all_of(around.begin(), around.end(), [&](std::uint32_t region) {
      return std::abs(planes_[region].height(place)) <= near_;
    });
    const bool at_hand = std::all_of(points.begin(), points.end(), [&](std::uint32_t p) {
      return length(place - loose_.points[p]) <= far;
    });
    return in_all && at_hand && moves_little(place, points) ? std::optional(place) : std::nullopt;
  }

  /// Whether all corners of a region become one: it vanishes.
  [[nodiscard]] bool lies_within(std::uint32_t region, const std::vector<std::uint32_t>& points) const {
    const auto& faces = regions_.faces(region);
    return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      return std::all_of(loose_.faces[f].begin(), loose_.faces[f].end(), [&](std::uint32_t v) {
        return std::binary_search(points.begin(), points.end(), v);
      });
    });
  }

  /// How far a new corner is from the planes that it takes the place of, and from the surface as it is.
  [[nodiscard]] bool moves_little(Vec3 place, const std::vector<std::uint32_t>& points) const {
    for (const std::uint32_t p : points) {
      for (const CornerId c : surface_.corners_at(VertexId(p))) {
        const std::uint32_t region = regions_.region(mesh::face_of(c).value());
        if ((goes_[region] || lies_within(region, points)) &&
            std::abs(planes_[region].height(place)) > bevel_moves * largest_mm_) {
          return false;
        }
      }
    }
    return as_it_is_->distance(place, largest_mm_) <= largest_mm_;
  }

  /// Places of the surface as it is that what it becomes is far from.
  [[nodiscard]] std::vector<Vec3> places_left(const mesh::LooseFaces& becomes) const {
    mesh::Model model;
    mesh::put_together(model, becomes);
    const mesh::SurfaceTree tree(model.surface, surface_.bounds().diagonal());
    std::vector<Vec3> far;
    FaceId near;
    std::copy_if(as_it_is_->samples().begin(), as_it_is_->samples().end(), std::back_inserter(far),
                 [&](Vec3 p) { return tree.distance(p, largest_mm_, near) > largest_mm_; });
    return far;
  }

  [[nodiscard]] Vec3 middle(const std::array<std::uint32_t, 2>& rung) const {
    return 0.5 * (loose_.points[rung[0]] + loose_.points[rung[1]]);
  }

  /// Bevels at these places; whether there were any.
  bool leave_out_near(const std::vector<Vec3>& places) {
    const std::size_t before = bevels_.size();
    leave_out([&](const Bevel& bevel) {
      const Vec3 from = middle(bevel.rungs[0]);
      const Vec3 along = middle(bevel.rungs[1]) - from;
      return std::any_of(places.begin(), places.end(), [&](Vec3 p) {
        const double t = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
        return length(p - from - t * along) <= bevel.width + short_edge_;
      });
    });
    return bevels_.size() < before;
  }

  template <class Which>
  void leave_out(Which which) {
    bevels_.erase(std::remove_if(bevels_.begin(), bevels_.end(), which), bevels_.end());
  }

  /// Bevels at whose ends a region failed; whether there were any.
  bool leave_out_beside(const std::vector<std::uint32_t>& failed) {
    std::vector<bool> bad(regions_.count(), false);
    for (const std::uint32_t region : failed) {
      bad[region] = true;
    }
    const std::size_t before = bevels_.size();
    leave_out([&](const Bevel& bevel) {
      return std::any_of(bevel.rungs.begin(), bevel.rungs.end(), [&](const auto& rung) {
        return std::any_of(rung.begin(), rung.end(), [&](std::uint32_t p) {
          const auto corners = surface_.corners_at(VertexId(p));
          return std::any_of(corners.begin(), corners.end(),
                             [&](CornerId c) { return bad[regions_.region(mesh::face_of(c).value())]; });
        });
      });
    });
    return bevels_.size() < before;
  }

  const mesh::Surface& surface_;
  mesh::LooseFaces loose_;
  PanelRegions regions_;
  double short_edge_;
  double largest_mm_;
  double near_;
  std::vector<Wall> planes_;  ///< of each region
  std::vector<Bevel> bevels_;
  std::vector<bool> goes_;  ///< regions that are bevels
  std::optional<mesh::SurfaceTree> as_it_is_;
};

}  // namespace

std::size_t sharpen_bevels(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                           const Context& context) {
  if (model.surface.face_count() > too_many_to_sharpen) {
    return 0;
  }
  context.check();
  const std::size_t count =
      Sharpener(model, options.short_edge_mm, largest_mm, too_fine_components(model.surface, options))
          .run(model);
  if (count > 0) {
    remesh_panels(model, context);
  }
  return count;
}

}  // namespace ridgecraft::prepare
