// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of folding ends in the model.
#include "unfold/folding/fold_motion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/nets_checks.hpp"

using namespace ridgecraft;
using unfold::FoldMotion;
using unfold::Nets;

namespace {

/// Greatest difference of a distance between two corners in the folded piece and in the model.
double refold_error(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  const FoldMotion motion(unfold::flat_piece(surface, nets, piece));
  FoldMotion::Pose pose;
  motion.pose(std::vector<double>(motion.creases().size(), 1.0), pose);
  const auto& corners = pose.corners;
  std::vector<Vec3> folded;
  std::vector<Vec3> model;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto vertices = surface.vertices(nets.pieces[piece].faces[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      folded.push_back(corners[i][k]);
      model.push_back(surface.point(vertices[k]));
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < folded.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      worst = std::max(worst, std::abs(length(folded[i] - folded[j]) - length(model[i] - model[j])));
    }
    // Mirrored pieces keep their distances, so orientation is looked at, too.
    if (i >= 5) {
      const auto volume = [&](const std::vector<Vec3>& p) {
        return dot(cross(p[1] - p[0], p[2] - p[0]), p[i] - p[0]);
      };
      worst = std::max(worst, std::abs(volume(folded) - volume(model)));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("folded by all of their angles, pieces are the model", "[unfold]") {
  std::vector<mesh::Surface> surfaces{test::cube(), test::tetrahedron(), test::sphere(8, 5),
                                      test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 2)};
  for (const mesh::Surface& surface : surfaces) {
    const Nets nets = test::default_nets(surface);
    for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
      CHECK(refold_error(surface, nets, piece) < 1e-9);
    }
  }
}

TEST_CASE("one crease after the other ends where all at a time do", "[unfold]") {
  const mesh::Surface surface = test::sphere(9, 6);
  const Nets nets = test::default_nets(surface);
  const FoldMotion motion(unfold::flat_piece(surface, nets, PieceId(0)));
  const auto creases = static_cast<std::uint32_t>(motion.creases().size());
  Random random(3);
  FoldMotion::Pose stepwise;
  motion.pose(std::vector<double>(creases, 0.0), stepwise);
  for (int step = 0; step < 200; ++step) {
    const std::uint32_t crease = random.below(creases);
    const FoldMotion::Pose before = stepwise;
    motion.fold(crease, random.unit(), stepwise);
    FoldMotion::Pose afresh;
    motion.pose(stepwise.share, afresh);
    const std::vector<std::uint32_t> beyond = motion.faces_beyond(crease);
    for (std::uint32_t f = 0; f < afresh.corners.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(length(stepwise.corners[f][k] - afresh.corners[f][k]) < 1e-12);
      }
      const bool stays = std::find(beyond.begin(), beyond.end(), f) == beyond.end();
      CHECK((!stays || before.corners[f] == stepwise.corners[f]));
    }
  }
}
