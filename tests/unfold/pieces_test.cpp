// SPDX-License-Identifier: GPL-3.0-or-later
// How a model is divided into pieces: modes, limits, panels that stay whole, merging across parts.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/energy/forest_energy.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/panel_parts.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/net_search.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using test::faults_of;
using test::none;
using test::scaled;
using unfold::Nets;
using unfold::Options;
using unfold::PieceMode;
using unfold::PieceReason;

namespace {

/// The same surface with points moved by a rigid motion and faces in the reverse order.
mesh::Surface turned_and_renumbered(const mesh::Surface& s) {
  const double c = std::cos(0.7);
  const double d = std::sin(0.7);
  std::vector<Vec3> points;
  for (const Vec3 p : s.points()) {
    points.push_back({c * p.x - d * p.y + 3.0, d * p.x + c * p.y - 5.0, p.z + 1.0});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (std::size_t f = s.face_count(); f-- > 0;) {
    faces.push_back(s.vertices(FaceId(f)));
  }
  return {std::move(points), std::move(faces)};
}

mesh::Surface mirrored(const mesh::Surface& s) {
  std::vector<Vec3> points;
  for (const Vec3 p : s.points()) {
    points.push_back({-p.x, p.y, p.z});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, e] = s.vertices(f);
    faces.push_back({a, e, b});
  }
  return {std::move(points), std::move(faces)};
}

/// A ball of 2 * longitudes * (latitudes - 1) faces whose vertices are pushed in and out.
mesh::Surface bumpy_ball(int longitudes, int latitudes, double size, std::uint64_t seed) {
  const mesh::Surface ball = test::sphere(longitudes, latitudes);
  Random random(seed);
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back(size * (0.7 + 0.6 * random.unit()) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    faces.push_back(ball.vertices(f));
  }
  return {std::move(points), std::move(faces)};
}

mesh::Surface torus(double size) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= 8; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % 8) / 8.0;
    profile.push_back({size * (1.0 + 0.4 * std::cos(angle)), 0.4 * size * std::sin(angle)});
  }
  return test::revolve(profile, 16);
}

/// A staircase with flat walls, 120 mm long.
mesh::Surface staircase() {
  return scaled(test::voxels({{0, 0, 0},
                              {1, 0, 0},
                              {2, 0, 0},
                              {3, 0, 0},
                              {1, 0, 1},
                              {2, 0, 1},
                              {3, 0, 1},
                              {2, 0, 2},
                              {3, 0, 2},
                              {3, 0, 3}}),
                30.0);
}

/// Parts by the height of the faces' middles.
IdVector<FaceId, PartId> slices_of_height(const mesh::Surface& s, double height) {
  IdVector<FaceId, PartId> part(s.face_count());
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    part[f] = PartId((s.point(a).z + s.point(b).z + s.point(c).z) / 3.0 > height ? 1 : 0);
  }
  return part;
}

Options on_paper(PieceMode mode) {
  Options options;
  options.sheet = unfold::Sheet{190.0, 277.0};
  options.pieces = unfold::rules_of(mode);
  return options;
}

std::size_t panels_of(const prepare::Panels& panels, const unfold::Piece& piece) {
  std::set<PanelId> found;
  for (const FaceId f : piece.faces) {
    found.insert(panels.panel[f]);
  }
  return found.size();
}

/// Panels whose faces lie in several pieces, or whose inner edges are cut.
std::size_t panels_cut(const mesh::Surface& s, const prepare::Panels& panels, const Nets& nets) {
  std::set<PanelId> cut;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    const auto [c, d] = s.sides(e);
    if (d.valid() && panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)] &&
        nets.use[e] != unfold::EdgeUse::fold) {
      cut.insert(panels.panel[mesh::face_of(c)]);
    }
  }
  return cut.size();
}

}  // namespace

TEST_CASE("every mode makes clean pieces, whole panels, and keeps to its limit", "[pieces][slow]") {
  const mesh::Surface shapes[] = {staircase(), bumpy_ball(12, 8, 50.0, 11), torus(45.0)};
  for (const mesh::Surface& s : shapes) {
    const prepare::Panels panels = test::flat_panels(s);
    const auto part = unfold::parts_of_whole_panels(s, panels, slices_of_height(s, 10.0));
    for (const PieceMode mode : {PieceMode::few, PieceMode::parts, PieceMode::small}) {
      const Options options = on_paper(mode);
      const Nets nets = unfold::unfold(s, panels, part, options, {});
      CHECK(faults_of(s, nets, options) == none);
      CHECK(panels_cut(s, panels, nets) == 0);
      std::set<PartId> stood_for;
      std::size_t extra = 0;
      for (const unfold::Piece& piece : nets.pieces) {
        CHECK(!piece.parts.empty());
        extra += piece.reason != PieceReason::part ? 1U : 0U;
        stood_for.insert(piece.parts.begin(), piece.parts.end());
        if (options.pieces.max_panels > 0) {
          CHECK(panels_of(panels, piece) <= options.pieces.max_panels);
        }
      }
      // A reason for every piece beyond the number of parts.
      CHECK(nets.pieces.size() - extra <= stood_for.size());
    }
  }
}

TEST_CASE("few pieces are never more than the parts' pieces, and those never more than small ones",
          "[pieces]") {
  const mesh::Surface s = staircase();
  const prepare::Panels panels = test::flat_panels(s);
  const auto part = unfold::parts_of_whole_panels(s, panels, slices_of_height(s, 45.0));
  std::vector<std::size_t> counts;
  for (const PieceMode mode : {PieceMode::few, PieceMode::parts, PieceMode::small}) {
    counts.push_back(unfold::unfold(s, panels, part, on_paper(mode), {}).pieces.size());
  }
  CHECK(counts[0] <= counts[1]);
  CHECK(counts[1] <= counts[2]);
  Options five = on_paper(PieceMode::parts);
  five.pieces.max_panels = 5;
  const Nets nets = unfold::unfold(s, panels, part, five, {});
  CHECK(faults_of(s, nets, five) == none);
  for (const unfold::Piece& piece : nets.pieces) {
    CHECK(panels_of(panels, piece) <= 5);
  }
  const bool told = std::any_of(nets.pieces.begin(), nets.pieces.end(),
                                [](const auto& piece) { return name(piece.reason) == "faces"; });
  CHECK(told);
}

TEST_CASE("turning, renumbering, mirroring and scaling keep pieces clean and complete", "[pieces]") {
  const mesh::Surface s = staircase();
  for (const mesh::Surface& other : {turned_and_renumbered(s), mirrored(s), scaled(s, 0.01)}) {
    const prepare::Panels panels = test::flat_panels(other);
    Options options = on_paper(PieceMode::few);
    const auto count = [&] {
      const Nets nets = unfold::unfold(other, panels, test::one_part(other), options, {});
      CHECK(faults_of(other, nets, options) == none);
      CHECK(panels_cut(other, panels, nets) == 0);
      return nets.pieces.size();
    };
    CHECK(count() <= 2);
    options.sheet.reset();
    CHECK(count() == 1);
  }
}

TEST_CASE("a crumb joins its neighbour, in another part too", "[pieces]") {
  // One small face of a ball as a part of its own.
  const mesh::Surface s = bumpy_ball(8, 5, 40.0, 5);
  IdVector<FaceId, PartId> part(s.face_count(), PartId(0));
  part[FaceId(17)] = PartId(1);
  Options options = on_paper(PieceMode::parts);
  options.pieces.max_panels = 0;
  options.pieces.weights.pieces = 5000.0;  // else the ball would become two calm pieces
  const Nets nets = unfold::unfold(s, test::no_panels(s), part, options, {});
  CHECK(faults_of(s, nets, options) == none);
  REQUIRE(nets.pieces.size() == 1);
  CHECK(nets.pieces[PieceId(0)].parts.size() == 2);
  // Where each part is to be by itself it stays.
  options.pieces = unfold::rules_of_single_parts();
  CHECK(unfold::unfold(s, test::no_panels(s), part, options, {}).pieces.size() == 2);
}

TEST_CASE("what giving panels whole to one part leaves apart joins its neighbours", "[pieces]") {
  const mesh::Surface s = torus(30.0);
  const prepare::Panels panels = test::flat_panels(s);
  IdVector<FaceId, PartId> part(s.face_count());
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    part[f] = PartId(f.value() % 7 == 0 ? 1 : f.value() % 2);
  }
  const auto whole = unfold::parts_of_whole_panels(s, panels, part);
  std::map<PartId, std::vector<FaceId>> faces;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    faces[whole[f]].push_back(f);
  }
  for (const auto& [p, list] : faces) {
    CHECK(unfold::connected(s, list).size() == 1);
  }
}

TEST_CASE("a part of a patch is the patch of the part", "[pieces]") {
  const mesh::Surface s = bumpy_ball(8, 5, 1.0, 9);
  std::vector<FaceId> all;
  std::vector<FaceId> some;
  std::vector<std::uint32_t> chosen;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    all.push_back(f);
    if (f.value() % 3 != 1) {
      some.push_back(f);
      chosen.push_back(f.value());
    }
  }
  const prepare::Panels panels = test::flat_panels(s);
  const unfold::Patch whole = unfold::make_patch(s, panels, all);
  const unfold::Patch direct = unfold::make_patch(s, panels, some);
  const unfold::Patch sub = unfold::sub_patch(whole, chosen);
  CHECK(sub.twin == direct.twin);
  CHECK(sub.frozen == direct.frozen);
  CHECK(sub.shape == direct.shape);
  CHECK(sub.length == direct.length);
  unfold::Folds folds(3 * all.size(), 0);
  Random random(4);
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    if (side < whole.twin[side] && random.unit() < 0.5) {
      folds[side] = folds[whole.twin[side]] = 1;
    }
  }
  unfold::Folds back = folds;
  unfold::put_back(whole, chosen, unfold::sub_folds(whole, folds, chosen), back);
  CHECK(back == folds);
}

TEST_CASE("each term of the objective has a name, and costs what it says", "[pieces]") {
  unfold::Weights weights;
  for (const std::string_view name : unfold::term_names()) {
    REQUIRE(unfold::weight_named(weights, name) != nullptr);
    *unfold::weight_named(weights, name) = 0.0;
  }
  CHECK(unfold::weight_named(weights, "tidiness") == nullptr);
  const mesh::Surface s = scaled(test::cube(), 10.0);
  const unfold::Patch cube = test::whole_patch(s, test::flat_panels(s));
  Random random(1);
  const unfold::Folds tree = test::random_tree(cube, random);
  unfold::Forest forest(cube);
  forest.set_folds(tree);
  std::vector<std::uint32_t> part(cube.size(), 0);
  part[1] = 1;
  part[5] = 2;
  const unfold::Room anywhere;
  const auto cost = [&](const unfold::Weights& weighed) {
    return unfold::ForestEnergy(forest, part, {}, anywhere, weighed).total();
  };
  CHECK(cost(weights) == 0.0);
  const auto only = [&](std::string_view name) {
    unfold::Weights one = weights;
    *unfold::weight_named(one, name) = 1.0;
    return cost(one);
  };
  CHECK(only("seam") == Approx(70.0));  // seven edges of 10 mm
  CHECK(only("pieces") == Approx(1.0));
  CHECK(only("parts") == Approx(2.0));
  CHECK(only("small") == Approx(1.0 - std::sqrt(600.0) / 30.0));
  CHECK(only("panels") == Approx(36.0 / 6400.0));
  CHECK(only("compact") > 0.0);
  CHECK(only("thin") == 0.0);
}
