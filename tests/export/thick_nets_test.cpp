// SPDX-License-Identifier: GPL-3.0-or-later
// Nets of board, held against what they are for: put together again as solid plates, they make the model.
#include "export/machine/thick_nets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "base/polygon.hpp"
#include "export/machine/operations.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft {
namespace {

using paper::Board;
using paper::BoardSide;
using paper::Hinge;

constexpr double right_angle = 0.5 * std::numbers::pi;

double area(const std::vector<std::vector<Vec2>>& loops) {
  double sum = 0.0;
  for (const auto& loop : loops) {
    sum += 0.5 * doubled_area(loop);
  }
  return sum;
}

}  // namespace

TEST_CASE("sides change by the formulas of their sections") {
  const Board scored{2.0, Hinge::back};
  const Board creased{2.0, Hinge::middle};
  const Board grooved{2.0, Hinge::front};
  CHECK(side_change(BoardSide::fold, -right_angle, scored) == Approx(-2.0));
  CHECK(side_change(BoardSide::fold, -right_angle, creased) == Approx(-1.0));
  CHECK(side_change(BoardSide::fold, -right_angle, grooved) == Approx(0.0));
  CHECK(side_change(BoardSide::fold, right_angle, scored) == Approx(2.0));
  CHECK(side_change(BoardSide::tab_base, -right_angle, creased) == Approx(-3.0));
  CHECK(side_change(BoardSide::tab_base, -right_angle, scored) == Approx(-4.0));
  CHECK(side_change(BoardSide::tab_target, -right_angle, scored) == Approx(0.0).margin(1e-12));
  CHECK(side_change(BoardSide::mitre, -right_angle, scored) == Approx(-2.0));
  CHECK(side_change(BoardSide::mitre, right_angle, scored) == 0.0);
  CHECK(side_change(BoardSide::border, -right_angle, scored) == 0.0);
  // Sharper than a right angle, the neighbour reaches less far; flatter than 30 degrees the step stays.
  CHECK(side_change(BoardSide::tab_target, -0.75 * std::numbers::pi, scored) == Approx(-2.0));
  CHECK(side_change(BoardSide::tab_base, -0.1, scored) == Approx(-2.0 * std::tan(0.05)));
  // Bounded at both ends.
  for (const double angle : {1e-6, 0.01, 1.0, 2.0, 3.0, 3.14159}) {
    for (const double sign : {-1.0, 1.0}) {
      for (const BoardSide side :
           {BoardSide::fold, BoardSide::tab_base, BoardSide::tab_target, BoardSide::mitre}) {
        CHECK(std::abs(side_change(side, sign * angle, scored)) <= 8.0 + 1e-9);
      }
    }
  }
  // Paper yields but for the bases of tabs.
  const Board paper_sheet{0.22, Hinge::middle};
  CHECK(side_change(BoardSide::fold, -right_angle, paper_sheet) == 0.0);
  CHECK(side_change(BoardSide::tab_base, -right_angle, paper_sheet) == Approx(-0.33));
}

TEST_CASE("faces of board meet along their folds, without a gap or an overlap") {
  const test::SamplePages sample = test::sample_pages(test::cube(), 60.0, 12.0);
  const mesh::Surface& surface = sample.model.model.surface;
  for (const Hinge hinge : {Hinge::back, Hinge::middle, Hinge::front}) {
    const Board board{2.0, hinge};
    paper::ThickReport report;
    const unfold::Nets thick = paper::thick_nets(sample.model, sample.nets, board, &report);
    CHECK(report.clamped == 0);
    CHECK(report.kept == 0);
    // Two faces meet along their fold: no gap, no overlap.
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      if (thick.use[e] == unfold::EdgeUse::fold) {
        const auto sides = surface.sides(e);
        const auto at = [&](CornerId c) { return thick.flat[mesh::face_of(c)][c.value() % 3]; };
        const Vec2 a = at(sides[0]);
        const Vec2 along = at(mesh::next(sides[0])) - a;
        for (const Vec2 p : {at(sides[1]), at(mesh::next(sides[1]))}) {
          CHECK(std::abs(cross(along / length(along), p - a)) < 1e-6);
        }
      }
    }
  }
}

TEST_CASE("outlines of nets of board are simple and enclose what the faces and tabs cover") {
  for (const auto& surface :
       {test::cube(), test::sphere(10, 6), test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}) {
    const test::SamplePages sample = test::sample_pages(surface, 50.0, 6.0);
    const mesh::Surface& model = sample.model.model.surface;
    const unfold::Nets thick = paper::thick_nets(sample.model, sample.nets, {1.5, Hinge::middle});
    for (const PieceId piece : ids<PieceId>(thick.pieces.size())) {
      double covered = 0.0;
      for (const FaceId f : thick.pieces[piece].faces) {
        covered += 0.5 * doubled_area(thick.flat[f]);
      }
      for (const unfold::Tab& tab : thick.tabs) {
        if (thick.piece[mesh::face_of(tab.side)] == piece) {
          covered += 0.5 * doubled_area(tab.polygon);
        }
      }
      CHECK(area(unfold::cut_lines(model, thick, piece).loops) == Approx(covered).epsilon(2e-3));
    }
  }
}

TEST_CASE("faces in a valley grow, those on a ridge shrink, and paper stays as it is") {
  const test::SamplePages sample =
      test::sample_pages(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), 40.0, 0.0);
  const mesh::Surface& surface = sample.model.model.surface;
  const Board board{2.0, Hinge::back};
  const unfold::Nets thick = paper::thick_nets(sample.model, sample.nets, board);
  CHECK(paper::thick_nets(sample.model, sample.nets, {}).flat == sample.nets.flat);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (thick.use[e] == unfold::EdgeUse::fold && surface.fold_angle(e) > 1e-6) {
      CHECK(side_change(BoardSide::fold, surface.fold_angle(e), board) == Approx(2.0));
    }
  }
}

TEST_CASE("board that is too thick for a model leaves its faces two thirds of their height") {
  const test::SamplePages sample = test::sample_pages(test::cube(), 10.0, 3.0);
  paper::ThickReport report;
  const unfold::Nets thick = paper::thick_nets(sample.model, sample.nets, {8.0, Hinge::back}, &report);
  CHECK(report.clamped + report.kept > 0);
  for (const FaceId f : ids<FaceId>(sample.model.model.surface.face_count())) {
    CHECK(doubled_area(thick.flat[f]) > 0.0);
  }
}

}  // namespace ridgecraft
