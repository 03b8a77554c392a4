// SPDX-License-Identifier: GPL-3.0-or-later
// Folding pieces up: the motion ends in the model, and orders hold every fold once.
#include "unfold/folding/fold_order.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/free_folding.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/net_search.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using unfold::FoldMotion;
using unfold::FoldWay;
using unfold::Nets;

namespace {

Nets nets_of(const mesh::Surface& surface) {
  return unfold::unfold(surface, test::flat_panels(surface), test::one_part(surface), {}, {});
}

/// A sheet that is bent along parallel lines: its profile, pulled along z.
mesh::Surface bent_sheet(const std::vector<Vec2>& profile, double width) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const Vec2 p : profile) {
    points.push_back({p.x, p.y, 0.0});
    points.push_back({p.x, p.y, width});
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto at = [&](std::size_t k) { return VertexId(2 * i + k); };
    faces.push_back({at(0), at(2), at(3)});
    faces.push_back({at(0), at(3), at(1)});
  }
  return {std::move(points), std::move(faces)};
}

/// Whether the profile with each joint turned by its share of what it is turned by crosses itself, its
/// stretches shortened at both ends.
bool crosses(const std::vector<Vec2>& profile, const std::vector<double>& share, double shortened) {
  std::vector<std::array<Vec2, 2>> stretches;
  Vec2 at{};
  double heading = 0.0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 along = profile[i + 1] - profile[i];
    if (i > 0) {
      const Vec2 before = profile[i] - profile[i - 1];
      heading += share[i] * std::atan2(cross(before, along), dot(before, along));
    }
    const Vec2 way{std::cos(heading), std::sin(heading)};
    const Vec2 end = at + length(along) * way;
    stretches.push_back({at + shortened * way, end - shortened * way});
    at = end;
  }
  const auto side = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); };
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (std::size_t j = i + 2; j < stretches.size(); ++j) {
      const auto& [a, b] = stretches[i];
      const auto& [c, d] = stretches[j];
      if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) {
        return true;
      }
    }
  }
  return false;
}

/// Stretches of 10 to 70 mm at sharp and blunt angles; where it would cross itself it stops.
std::vector<Vec2> random_profile(Random& random) {
  std::vector<Vec2> profile{{0.0, 0.0}};
  double heading = 0.0;
  for (int i = 0; i < 14; ++i) {
    const double reach = 10.0 + 60.0 * random.unit();
    profile.push_back(profile.back() + reach * Vec2{std::cos(heading), std::sin(heading)});
    if (i > 1 && crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)) {
      profile.pop_back();
      break;
    }
    heading += (random.below(3) == 0 ? -1.0 : 1.0) * (0.5 + 2.0 * random.unit());
  }
  return profile;
}

/// Two hooks that hold each other, bent a little; straight where that would make them cross.
std::vector<Vec2> random_hooks(Random& random) {
  std::vector<Vec2> profile{{30, 20}, {30, 30}, {10, 30}, {10, 10}, {0, 10},
                            {0, 40},  {60, 40}, {60, 24}, {20, 24}, {20, 10}};
  for (Vec2& p : profile) {
    p += Vec2{12.0 * random.unit() - 6.0, 12.0 * random.unit() - 6.0};
  }
  const std::size_t length = 6 + random.below(5);
  profile.resize(std::min(length, profile.size()));
  return crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)
             ? std::vector<Vec2>{{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}}
             : profile;
}

bool crosses_together(const std::vector<Vec2>& profile, double shortened) {
  for (int sample = 1; sample < 24; ++sample) {
    if (crosses(profile, std::vector<double>(profile.size(), sample / 24.0), shortened)) {
      return true;
    }
  }
  return false;
}

bool crosses_in_order(const std::vector<Vec2>& profile, const std::vector<std::size_t>& joints,
                      double shortened) {
  std::vector<double> share(profile.size(), 0.0);
  for (const std::size_t joint : joints) {
    for (int sample = 1; sample <= 6; ++sample) {
      share[joint] = sample / 6.0;
      if (crosses(profile, share, shortened)) {
        return true;
      }
    }
  }
  return false;
}

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
    const Nets nets = nets_of(surface);
    for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
      CHECK(refold_error(surface, nets, piece) < 1e-9);
    }
  }
}

TEST_CASE("one crease after the other ends where all at a time do", "[unfold]") {
  const mesh::Surface surface = test::sphere(9, 6);
  const Nets nets = nets_of(surface);
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

TEST_CASE("a tree that gets in its own way is exchanged for one that doesn't", "[unfold]") {
  // Long strips wound round a ball and round a knot of cubes: many of them run through themselves.
  const std::vector<mesh::Surface> surfaces{
      test::scaled(test::sphere(14, 9), 40.0),
      test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 2), 30.0)};
  int stuck = 0;
  int freed = 0;
  for (const mesh::Surface& surface : surfaces) {
    std::vector<FaceId> faces;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      faces.push_back(f);
    }
    const unfold::Patch patch = unfold::make_patch(surface, test::flat_panels(surface), faces);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      unfold::NetSearch search;
      search.start = unfold::StartTree::depth_first;
      search.tolerance = unfold::net_tolerance(patch.extent);
      search.iterations = 2000;
      const unfold::NetFound net = unfold::find_net(patch, search, seed, {});
      if (net.overlaps > 0 || unfold::folds_freely(patch, net.folds, {})) {
        continue;
      }
      ++stuck;
      const auto freed_if = [&](bool allowed) {
        unfold::ChangingNet changing(patch, net.folds, search.tolerance);
        const bool changed =
            unfold::fold_freely(changing, [&](unfold::ChangingNet&) { return allowed; }, seed, {});
        CHECK(changed == (changing.folds() != net.folds));
        return changing.folds();
      };
      const unfold::Folds other = freed_if(true);
      CHECK(unfold::lay_out(patch, other).faces.size() == 1);
      CHECK(unfold::find_overlaps(unfold::lay_out(patch, other), search.tolerance).empty());
      for (std::size_t side = 0; side < other.size(); ++side) {
        CHECK((patch.frozen[side] == 0 || other[side] == net.folds[side]));
      }
      CHECK((other == net.folds || unfold::folds_freely(patch, other, {})));
      freed += other != net.folds ? 1 : 0;
      CHECK(freed_if(true) == other);
      CHECK(freed_if(false) == net.folds);
    }
  }
  CHECK(stuck > 0);
  CHECK(2 * freed >= stuck);
}

TEST_CASE("an order of folding has each folded edge once", "[unfold]") {
  std::vector<mesh::Surface> surfaces{test::cube(), test::sphere(12, 8),
                                      test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 3)};
  for (const std::string& file : test::shared_models()) {
    if (file.find("bunny_128") != std::string::npos || file.find("star80") != std::string::npos) {
      surfaces.push_back(test::read_off(file));
    }
  }
  for (const mesh::Surface& surface : surfaces) {
    const Nets nets = nets_of(surface);
    std::map<EdgeId, int> times;
    for (const unfold::Piece& piece : nets.pieces) {
      for (const auto& step : piece.folding.steps) {
        CHECK(!step.empty());
        for (const CornerId side : step) {
          ++times[surface.edge(side)];
          CHECK(nets.piece[mesh::face_of(side)] == PieceId(&piece - &nets.pieces[PieceId(0)]));
        }
      }
      CHECK((piece.folding.way != FoldWay::together || piece.folding.steps.size() <= 1));
    }
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const bool folded = nets.use[e] == unfold::EdgeUse::fold && std::abs(surface.fold_angle(e)) > 1e-5;
      CHECK(times[e] == (folded ? 1 : 0));
    }
  }
}

TEST_CASE("a cube folds up with all creases at a time", "[unfold]") {
  const mesh::Surface cube = test::scaled(test::cube(), 50.0);
  const Nets nets = nets_of(cube);
  CHECK(nets.pieces[PieceId(0)].folding.way == FoldWay::together);
}

TEST_CASE("strips fold as their profiles say", "[unfold]") {
  // The profile's joints turn in the plane: whether it crosses itself there is another question than the
  // program's, with the same answer.
  Random random(7);
  std::map<FoldWay, int> seen;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Vec2> profile = round % 2 == 0 ? random_profile(random) : random_hooks(random);
    const mesh::Surface sheet = bent_sheet(profile, 30.0);
    const Nets nets = nets_of(sheet);
    REQUIRE(nets.pieces.size() == 1);
    const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
    ++seen[folding.way];
    CHECK((folding.way == FoldWay::together) == !crosses_together(profile, 0.3));
    if (folding.way == FoldWay::leaves_first || folding.way == FoldWay::middle_first) {
      std::vector<std::size_t> joints;
      for (const auto& step : folding.steps) {
        joints.push_back(sheet.vertex(step.front()).value() / 2);
      }
      CHECK(!crosses_in_order(profile, joints, 0.3));
    }
  }
  CHECK(seen[FoldWay::together] > 0);
  CHECK(seen[FoldWay::leaves_first] > 0);
  CHECK(seen[FoldWay::with_care] > 0);
}

TEST_CASE("hooks that hold each other need care", "[unfold]") {
  const mesh::Surface hooks = bent_sheet(
      {{30, 20}, {30, 30}, {10, 30}, {10, 10}, {0, 10}, {0, 40}, {60, 40}, {60, 24}, {20, 24}, {20, 10}},
      30.0);
  const Nets nets = nets_of(hooks);
  REQUIRE(nets.pieces.size() == 1);
  CHECK(nets.pieces[PieceId(0)].folding.way == FoldWay::with_care);
}
