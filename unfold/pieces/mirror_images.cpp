// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/mirror_images.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// Of the length of all edges so much has a mirror image, at least, where cuts are carried over.
constexpr double least_share_mirrored = 0.4;
EdgeId edge_of(const mesh::Surface& surface, const Patch& patch, std::uint32_t side) {
  return surface.edge(mesh::corner(patch.face[side / 3], side % 3));
}

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

}  // namespace

MirrorImages mirror_images(const mesh::Surface& surface, const Weights& weights) {
  if (weights.mirror <= 0.0 || surface.face_count() > most_faces_of_images) {
    return {};
  }
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
  const IdVector<EdgeId, double> seen = prepare::seen_lengths(surface);
  const double all = std::accumulate(seen.begin(), seen.end(), 0.0);
  MirrorImages best;
  double most = least_share_mirrored * all;
  for (const prepare::MirrorPlane& plane : planes) {
    IdVector<EdgeId, EdgeId> images = prepare::mirror_edges(surface, plane, seen_as_image);
    const double length = prepare::length_with_image(seen, images);
    if (length > most) {
      // A later plane has to be clearly better.
      most = 1.02 * length;
      best = {std::move(images), plane};
    }
  }
  return best;
}

std::vector<std::uint32_t> mirror_sides(const mesh::Surface& surface, const Patch& patch,
                                        const IdVector<EdgeId, EdgeId>& images) {
  std::vector<std::uint32_t> result(patch.twin.size(), no_index);
  if (images.empty()) {
    return result;
  }
  const std::map<EdgeId, std::uint32_t> side_of = exchangeable_sides(surface, patch);
  for (const auto& [edge, side] : side_of) {
    const EdgeId image = images[edge];
    const auto found = image.valid() && image != edge ? side_of.find(image) : side_of.end();
    if (found != side_of.end()) {
      result[side] = result[patch.twin[side]] = found->second;
    }
  }
  return result;
}

IdVector<EdgeId, InForest> edges_in_forest(const mesh::Surface& surface, const Patch& whole,
                                           const Folds& folds) {
  IdVector<EdgeId, InForest> result(surface.edge_count(), InForest::fixed);
  for (const auto& [edge, side] : exchangeable_sides(surface, whole)) {
    result[edge] = folds[side] != 0 ? InForest::fold : InForest::cut;
  }
  return result;
}

std::vector<std::int8_t> images_outside(const mesh::Surface& surface, const Patch& patch,
                                        const IdVector<EdgeId, EdgeId>& images,
                                        const IdVector<EdgeId, InForest>& edges) {
  std::vector<std::int8_t> result(patch.twin.size(), 0);
  if (images.empty()) {
    return result;
  }
  const std::map<EdgeId, std::uint32_t> side_of = exchangeable_sides(surface, patch);
  for (const auto& [edge, side] : side_of) {
    const EdgeId image = images[edge];
    if (image.valid() && side_of.count(image) == 0) {
      result[side] = result[patch.twin[side]] = static_cast<std::int8_t>(edges[image]);
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
