// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "prepare/symmetry/correspondence.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// How far an image may be off for cuts to be carried over, as a share of the model's extent: hardly seen.
constexpr double seen_as_image = 0.02;
/// The same for turns: what can be turned was copied or computed, not modelled twice by hand.
constexpr double seen_as_turned = 0.005;
/// Larger models are searched without regard to symmetry: finding it would take as long as all else.
constexpr std::size_t most_faces_of_images = 20'000;
/// Of the length of all edges so much has an image, at least, where cuts are carried over.
constexpr double least_share = 0.4;
/// A model that comes to lie on itself by finer turns than this part of a circle is round: then it is turned
/// by the finest one that also brings it there.
constexpr int finest_turn = 16;

/// One side of each edge that could be a fold or a cut.
std::map<EdgeId, std::uint32_t> exchangeable_sides(const mesh::Surface& surface, const Patch& patch) {
  std::map<EdgeId, std::uint32_t> side_of;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != no_index && side < patch.twin[side] && patch.frozen[side] == 0) {
      side_of[edge_of(surface, patch, side)] = side;
    }
  }
  return side_of;
}

bool is_tree(const Patch& patch, const Folds& folds) {
  DisjointSets sets(patch.size());
  std::uint32_t joined = 0;
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    if (folds[side] != 0 && side < patch.twin[side]) {
      if (!sets.join(side / 3, patch.twin[side] / 3)) {
        return false;
      }
      ++joined;
    }
  }
  return joined + 1 == patch.size();
}

/// Of several motions the one that brings the greatest length of edges onto others.
class BestImages {
 public:
  explicit BestImages(const mesh::Surface& surface)
      : seen_(prepare::seen_lengths(surface)),
        most_(least_share * std::accumulate(seen_.begin(), seen_.end(), 0.0)) {}

  bool offer(IdVector<EdgeId, EdgeId> images) {
    const double length = prepare::length_with_image(seen_, images);
    if (length <= most_) {
      return false;
    }
    // A later one has to be clearly better.
    most_ = 1.02 * length;
    best_ = std::move(images);
    return true;
  }
  [[nodiscard]] const IdVector<EdgeId, EdgeId>& best() const { return best_; }

 private:
  const IdVector<EdgeId, double> seen_;
  double most_;
  IdVector<EdgeId, EdgeId> best_;
};

/// Whether a fair part of some vertices, evenly drawn, has an image.
class QuickLook {
 public:
  explicit QuickLook(const mesh::Surface& surface)
      : points_(surface.points().begin(), surface.points().end()),
        near_(points_, numbers(points_.size())),
        radius_(seen_as_turned * surface.bounds().largest_extent()) {}

  [[nodiscard]] bool may_be(const prepare::Isometry& isometry) const {
    const std::size_t step = std::max<std::size_t>(1, points_.size() / looked_at);
    std::size_t all = 0;
    std::size_t found = 0;
    for (std::size_t v = 0; v < points_.size(); v += step, ++all) {
      found += near_.nearest(isometry(points_[v]), radius_) != no_index ? 1U : 0U;
    }
    return static_cast<double>(found) > least_share * static_cast<double>(all);
  }

 private:
  static constexpr std::size_t looked_at = 64;
  static std::vector<std::uint32_t> numbers(std::size_t n) {
    std::vector<std::uint32_t> all(n);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  std::vector<Vec3> points_;
  prepare::NearbyPoints near_;
  double radius_;
};

void find_plane(const mesh::Surface& surface, Symmetry& symmetry) {
  // People model along axes, and what isn't symmetric as a whole, such as a face with one scar, mostly is in
  // its middle; so these come first.
  std::vector<prepare::MirrorPlane> planes;
  const Box3 box = surface.bounds();
  for (const Vec3 normal : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
    planes.push_back({normal, 0.5 * dot(box.low + box.high, normal)});
  }
  for (const prepare::Mirror& mirror : prepare::find_mirrors(surface, 1, {.near = seen_as_image})) {
    planes.push_back(mirror.plane);
  }
  BestImages images(surface);
  for (const prepare::MirrorPlane& plane : planes) {
    if (images.offer(prepare::mirror_edges(surface, plane, seen_as_image))) {
      symmetry.plane = plane;
    }
  }
  if (symmetry.plane) {
    symmetry.images.push_back({images.best()});
  }
}

/// Turns by the n-th part of a circle about an axis through a point.
prepare::Isometry turn_about(Vec3 axis, Vec3 point, int n) {
  const Vec3 odd = std::abs(axis.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 normal = normalized(cross(axis, odd));
  const Vec3 across = cross(axis, normal);
  const double angle = std::numbers::pi / n;
  const Vec3 other = elementary::cos(angle) * normal + elementary::sin(angle) * across;
  // Two mirrorings turn by twice the angle between their planes.
  return prepare::mirroring({other, dot(other, point)}) * prepare::mirroring({normal, dot(normal, point)});
}

/// Axes of coordinates and of the surface, through the middle of its box and of its area, each once.
std::vector<std::pair<Vec3, Vec3>> likely_axes(const mesh::Surface& surface) {
  const Box3 box = surface.bounds();
  const prepare::AreaFrame frame = prepare::area_frame(surface);
  const double same = 1e-9 * box.largest_extent();
  std::vector<std::pair<Vec3, Vec3>> axes;
  for (const Vec3 axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}, frame.axes[0],
                          frame.axes[1], frame.axes[2]}) {
    for (const Vec3 middle : {0.5 * (box.low + box.high), frame.centre}) {
      if (std::none_of(axes.begin(), axes.end(), [&](const auto& other) {
            return length(cross(axis, other.first)) < 1e-9 &&
                   length(cross(axis, middle - other.second)) < same;
          })) {
        axes.emplace_back(axis, middle);
      }
    }
  }
  return axes;
}

void find_turn(const mesh::Surface& surface, const Context& context, Symmetry& symmetry) {
  const QuickLook look(surface);
  const double radius = seen_as_turned * surface.bounds().largest_extent();
  const std::vector<std::pair<Vec3, Vec3>> axes = likely_axes(surface);
  BestImages images(surface);
  for (int n = finest_turn; n > 1; --n) {
    for (const auto& [axis, middle] : axes) {
      context.check();
      const prepare::Isometry turn = turn_about(axis, middle, n);
      if (!context.out_of_time() && look.may_be(turn)) {
        images.offer(prepare::match_edges(surface, surface, turn, radius));
      }
    }
  }
  if (images.best().empty()) {
    return;
  }
  IdVector<EdgeId, EdgeId> back(images.best().size());
  for (const EdgeId e : ids<EdgeId>(back.size())) {
    if (const EdgeId image = images.best()[e]; image.valid()) {
      back[image] = e;
    }
  }
  symmetry.images.push_back({images.best(), 0.5});
  symmetry.images.push_back({std::move(back), 0.5});
}

}  // namespace

Symmetry find_symmetry(const mesh::Surface& surface, const Weights& weights, const Context& context) {
  Symmetry symmetry;
  if (weights.mirror > 0.0 && surface.face_count() <= most_faces_of_images && !context.out_of_time()) {
    find_plane(surface, symmetry);
    find_turn(surface, context, symmetry);
  }
  return symmetry;
}

std::vector<SideImages> images_of_sides(const mesh::Surface& surface, const Patch& patch,
                                        std::span<const EdgeImages> images) {
  std::vector<SideImages> result;
  const std::map<EdgeId, std::uint32_t> side_of =
      images.empty() ? std::map<EdgeId, std::uint32_t>() : exchangeable_sides(surface, patch);
  for (const EdgeImages& of : images) {
    SideImages& own = result.emplace_back();
    own.weight = of.weight;
    own.side.assign(patch.twin.size(), no_index);
    for (const auto& [edge, side] : side_of) {
      const EdgeId image = of.edge[edge];
      const auto found = image.valid() && image != edge ? side_of.find(image) : side_of.end();
      if (found != side_of.end() &&
          is_border_of_labels(patch, side) == is_border_of_labels(patch, found->second)) {
        own.side[side] = own.side[patch.twin[side]] = found->second;
      }
    }
  }
  return result;
}

std::optional<Folds> carried_over(const mesh::Surface& surface, const Patch& from, const Folds& tree,
                                  const Patch& to, const IdVector<EdgeId, EdgeId>& images) {
  if (images.empty() || from.size() != to.size()) {
    return std::nullopt;
  }
  const std::map<EdgeId, std::uint32_t> side_from = exchangeable_sides(surface, from);
  Folds result(to.twin.size(), 0);
  for (const auto& [edge, side] : exchangeable_sides(surface, to)) {
    const auto image = images[edge].valid() ? side_from.find(images[edge]) : side_from.end();
    if (image == side_from.end()) {
      return std::nullopt;
    }
    set_fold(to, result, side, tree[image->second] != 0);
  }
  // What holds flat regions together has no image: any tree of it does.
  DisjointSets sets(to.size());
  for (std::uint32_t side = 0; side < to.twin.size(); ++side) {
    if (to.frozen[side] != 0 && side < to.twin[side] && sets.join(side / 3, to.twin[side] / 3)) {
      set_fold(to, result, side, true);
    }
  }
  return is_tree(to, result) ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace ridgecraft::unfold
