// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/kept_bands.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "unfold/energy/bands.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {
namespace {

/// The mean rung of a band that stays a strip, of what its regions have of a rim; divided by Weights::bands.
constexpr double least_rung_to_rim = 1.1;

/// The rungs of each band as edges; none of bands with a border of labels across them.
std::vector<std::vector<EdgeId>> edges_of(const mesh::Surface& surface, const Patch& patch,
                                          const Bands& bands) {
  std::vector<std::vector<EdgeId>> edges(bands.seam_mm.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (bands.band[side] != nothing && side < patch.twin[side]) {
      edges[bands.band[side]].push_back(surface.edge(mesh::corner(patch.face[side / 3], side % 3)));
    }
  }
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (bands.band[side] != nothing && is_border_of_labels(patch, side)) {
      edges[bands.band[side]].clear();
    }
  }
  return edges;
}

class Seams {
 public:
  Seams(const mesh::Surface& surface, const MirrorImages& images)
      : surface_(surface), images_(images), chosen_(surface.edge_count(), 0) {}

  /// The rung at which a band is cut: the image of the one at which its mirror image is, else the nearest to
  /// the plane. (Of rungs equally near, the farthest along two odd directions: which it is depends on nothing
  /// but the place.)
  EdgeId of(const std::vector<EdgeId>& rungs) {
    auto seam = std::find_if(rungs.begin(), rungs.end(), [&](EdgeId e) {
      const EdgeId image = image_of(e);
      return image.valid() && chosen_[image] != 0;
    });
    if (seam == rungs.end()) {
      seam = std::min_element(rungs.begin(), rungs.end(),
                              [&](EdgeId a, EdgeId b) { return place(a) < place(b); });
    }
    chosen_[*seam] = 1;
    return *seam;
  }

 private:
  [[nodiscard]] EdgeId image_of(EdgeId e) const { return images_.edge.empty() ? EdgeId() : images_.edge[e]; }

  /// Smaller is better.
  [[nodiscard]] std::tuple<double, double, EdgeId> place(EdgeId e) const {
    const CornerId c = surface_.sides(e)[0];
    const Vec3 middle =
        0.5 * (surface_.point(surface_.vertex(c)) + surface_.point(surface_.vertex(mesh::next(c))));
    // Equal but for rounding is equal.
    const double unit = 1e-6 * surface_.bounds().largest_extent();
    const double off = images_.edge.empty() ? 0.0 : std::abs(images_.plane.height(middle));
    return {std::round(off / unit), std::round(-(middle.y + 0.01 * middle.x) / unit), e};
  }

  const mesh::Surface& surface_;
  const MirrorImages& images_;
  IdVector<EdgeId, std::uint8_t> chosen_;
};

}  // namespace

EdgeWishes with_bands_kept(const mesh::Surface& surface, const prepare::Panels& panels,
                           std::span<const std::uint32_t> labels, const EdgeWishes& wishes,
                           const Weights& weights) {
  if (weights.bands <= 0.0) {
    return wishes;
  }
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  const Patch patch = make_patch(surface, panels, faces, wishes.items(), labels);
  const Bands bands = find_bands(patch);
  if (bands.empty()) {
    return wishes;
  }
  // The edges of a rung lie between the same two flat regions.
  const auto beside = [&](EdgeId e) -> std::pair<PanelId, PanelId> {
    const auto [c, d] = surface.sides(e);
    const PanelId a = panels.panel[mesh::face_of(c)];
    const PanelId b = panels.panel[mesh::face_of(d)];
    return {std::min(a, b), std::max(a, b)};
  };
  const MirrorImages images = mirror_images(surface, weights);
  Seams seams(surface, images);
  EdgeWishes result = wishes.empty() ? EdgeWishes(surface.edge_count(), EdgeWish::none) : wishes;
  const std::vector<std::vector<EdgeId>> edges = edges_of(surface, patch, bands);
  for (std::size_t band = 0; band < edges.size(); ++band) {
    if (edges[band].empty() ||
        weights.bands * bands.mean_rung_mm[band] < least_rung_to_rim * bands.mean_rim_mm[band] ||
        std::any_of(edges[band].begin(), edges[band].end(),
                    [&](EdgeId e) { return result[e] != EdgeWish::none; })) {
      continue;
    }
    for (const EdgeId e : edges[band]) {
      result[e] = EdgeWish::band;
    }
    if (bands.closed[band] != 0) {
      const std::pair<PanelId, PanelId> seam = beside(seams.of(edges[band]));
      for (const EdgeId e : edges[band]) {
        result[e] = beside(e) == seam ? EdgeWish::none : EdgeWish::band;
      }
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
