// SPDX-License-Identifier: GPL-3.0-or-later
// What one side of a symmetric model is divided into, the other side is, too.
#include "unfold/pieces/even_pieces.hpp"

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/even_parts.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/mirror_images.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::MirrorImages;
using unfold::Patch;

namespace {

/// An egg that only the plane x = 0 mirrors onto itself: half of one, and its mirror image.
mesh::Surface egg() {
  const mesh::Surface ball = test::sphere(16, 9);
  std::map<std::array<long, 3>, VertexId> at;
  std::vector<Vec3> points;
  const auto vertex = [&](Vec3 p) {
    const auto [found, is_new] = at.try_emplace(
        {std::lround(1e6 * p.x), std::lround(1e6 * p.y), std::lround(1e6 * p.z)}, VertexId(points.size()));
    if (is_new) {
      points.push_back({30.0 * p.x, 40.0 * p.y + 6.0 * p.z * p.z, 50.0 * p.z + 8.0 * p.y});
    }
    return found->second;
  };
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    const auto [a, b, c] = ball.vertices(f);
    const std::array corners{ball.point(a), ball.point(b), ball.point(c)};
    if (corners[0].x + corners[1].x + corners[2].x > 0.0) {
      const auto mirrored = [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; };
      faces.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
      faces.push_back(
          {vertex(mirrored(corners[0])), vertex(mirrored(corners[2])), vertex(mirrored(corners[1]))});
    }
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

/// Per face the face whose corners are its mirror image's.
std::vector<std::uint32_t> image_of_faces(const mesh::Surface& surface) {
  const auto key = [&](FaceId f, double sign) {
    std::multiset<std::array<long, 3>> corners;  // rounding makes 0 of -0
    for (const VertexId v : surface.vertices(f)) {
      const Vec3 p = surface.point(v);
      corners.insert({std::lround(1e4 * sign * p.x), std::lround(1e4 * p.y), std::lround(1e4 * p.z)});
    }
    return corners;
  };
  std::map<std::multiset<std::array<long, 3>>, std::uint32_t> at;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    at[key(f, 1.0)] = f.value();
  }
  std::vector<std::uint32_t> image;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    image.push_back(at.at(key(f, -1.0)));
  }
  return image;
}

/// Whether faces that are together have images that are together.
template <class SetOf>
bool is_even(const std::vector<std::uint32_t>& image, SetOf set_of) {
  std::map<std::uint32_t, std::uint32_t> other;
  for (std::uint32_t f = 0; f < image.size(); ++f) {
    const auto [at, is_new] = other.try_emplace(set_of(f), set_of(image[f]));
    if (!is_new && at->second != set_of(image[f])) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("parts of a symmetric model become even", "[unfold]") {
  const mesh::Surface surface = egg();
  const std::vector<std::uint32_t> image = image_of_faces(surface);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    // Parts by the nearest of a few points, which know nothing of symmetry.
    Random random(seed);
    std::vector<Vec3> centres;
    for (int i = 0; i < 5; ++i) {
      centres.push_back(
          surface.point(VertexId(random.below(static_cast<std::uint32_t>(surface.points().size())))));
    }
    IdVector<FaceId, PartId> part(surface.face_count());
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const Vec3 p = surface.point(surface.vertices(f)[0]);
      std::uint32_t nearest = 0;
      for (std::uint32_t i = 1; i < centres.size(); ++i) {
        nearest = length(p - centres[i]) < length(p - centres[nearest]) ? i : nearest;
      }
      part[f] = PartId(nearest);
    }
    const auto even = unfold::even_parts(surface, test::no_panels(surface), part, unfold::Weights());
    CAPTURE(seed);
    CHECK(is_even(image, [&](std::uint32_t f) { return even[FaceId(f)].value(); }));
    unfold::Weights none;
    none.mirror = 0.0;
    const auto kept = unfold::even_parts(surface, test::no_panels(surface), part, none);
    CHECK(std::equal(part.begin(), part.end(), kept.begin()));
  }
}

TEST_CASE("evened pieces are clean nets, no more of them, each the image of one", "[unfold]") {
  const mesh::Surface surface = egg();
  const prepare::Panels panels = test::no_panels(surface);
  const Patch patch = test::whole_patch(surface, panels);
  const unfold::Weights weights;
  const MirrorImages images = unfold::mirror_images(surface, weights);
  REQUIRE(!images.edge.empty());
  const double tolerance = unfold::net_tolerance(patch.extent);
  const unfold::Options options;
  const unfold::Room room;
  std::size_t evened = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    Folds folds = unfold::start_tree(patch, unfold::StartTree::breadth_first, random);
    // Bands of the egg's length, so that no piece overlaps itself.
    for (std::uint32_t side = 0; side < folds.size(); ++side) {
      const std::uint32_t twin = patch.twin[side];
      if (folds[side] != 0 && random.below(6) == 0) {
        folds[side] = folds[twin] = 0;
      }
    }
    if (!unfold::find_overlaps(unfold::lay_out(patch, folds), tolerance).empty()) {
      continue;
    }
    Context seeded;
    seeded.seed = seed;
    const Folds even =
        unfold::even_pieces({surface, panels, patch, {}, options, room}, folds, images, {}, seeded);
    const unfold::Layout before = unfold::lay_out(patch, folds);
    const unfold::Layout after = unfold::lay_out(patch, even);
    CHECK(after.faces.size() <= before.faces.size());
    CHECK(unfold::find_overlaps(after, tolerance).empty());
    if (even != folds) {
      ++evened;
      CHECK(is_even(image_of_faces(surface), [&](std::uint32_t f) { return after.piece[f]; }));
    }
  }
  CHECK(evened > 0);
}
