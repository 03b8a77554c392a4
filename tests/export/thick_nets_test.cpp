// SPDX-License-Identifier: GPL-3.0-or-later
// Nets of board, held against what they are for: put together again as solid plates, they make the model.
#include "export/machine/thick_nets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "export/machine/operations.hpp"
#include "loops_area.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft {
namespace {

using export_::Board;
using export_::BoardSide;
using export_::Hinge;
using test::loops_area;

constexpr double right_angle = 0.5 * std::numbers::pi;

BoardSide kind_of(const mesh::Surface& surface, const unfold::Nets& nets, CornerId side) {
  const EdgeId edge = surface.edge(side);
  if (surface.is_border(edge)) {
    return BoardSide::border;
  }
  if (nets.use[edge] == unfold::EdgeUse::fold) {
    return BoardSide::fold;
  }
  for (const unfold::Tab& tab : nets.tabs) {
    if (surface.edge(tab.side) == edge) {
      return tab.side == side ? BoardSide::tab_base : BoardSide::tab_target;
    }
  }
  return BoardSide::mitre;
}

/// A side of a flat part on the sheet: the part lies on its left.
struct PartSide {
  BoardSide kind;
  double angle;
  Vec2 a;
  Vec2 b;
};

/// Of each flat part: faces of a panel that hang together on the sheet.
std::vector<std::vector<PartSide>> sides_of_parts(const mesh::Surface& surface, const unfold::Nets& nets) {
  const auto goes_on = [&](EdgeId edge) {
    return nets.use[edge] == unfold::EdgeUse::fold && std::abs(surface.fold_angle(edge)) < 1e-6;
  };
  std::vector<std::vector<PartSide>> parts;
  IdVector<FaceId, bool> done(surface.face_count(), false);
  for (const FaceId first : ids<FaceId>(surface.face_count())) {
    std::vector<FaceId> todo;
    if (!done[first]) {
      parts.emplace_back();
      todo.push_back(first);
      done[first] = true;
    }
    while (!todo.empty()) {
      const FaceId face = todo.back();
      todo.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(face, k);
        const EdgeId edge = surface.edge(side);
        if (!goes_on(edge)) {
          parts.back().push_back({kind_of(surface, nets, side), surface.fold_angle(edge), nets.flat[face][k],
                                  nets.flat[face][(k + 1) % 3]});
        } else if (const FaceId other = mesh::face_of(surface.twin(side)); !done[other]) {
          done[other] = true;
          todo.push_back(other);
        }
      }
    }
  }
  return parts;
}

/// Where a plate of board is: the place of a point of the sheet, and how it lies.
struct Plate {
  Vec3 origin, x, y, z;  ///< z: to the printed side

  [[nodiscard]] Vec3 at(Vec2 p, double depth) const { return origin + p.x * x + p.y * y - depth * z; }
};

/// What lies right of a line on the plate's sheet, turned about it at this depth; positive is away from the
/// printed side.
Plate turned(const Plate& plate, Vec2 a, Vec2 b, double depth, double angle) {
  const Vec3 hinge = plate.at(a, depth);
  const Vec3 axis = normalized(plate.at(b, depth) - hinge);
  const auto turn = [&](Vec3 v) {  // Rodrigues
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           (1.0 - std::cos(angle)) * dot(axis, v) * axis;
  };
  return {hinge + turn(plate.origin - hinge), turn(plate.x), turn(plate.y), turn(plate.z)};
}

double depth_of(const Board& board) {
  return board.hinge == Hinge::back     ? board.thickness_mm
         : board.hinge == Hinge::middle ? 0.5 * board.thickness_mm
                                        : 0.0;
}

/// All faces of a net of one piece, folded up about its hinges from the first one.
IdVector<FaceId, Plate> folded_up(const mesh::Surface& surface, const unfold::Nets& nets,
                                  const Board& board) {
  IdVector<FaceId, Plate> plates(surface.face_count());
  IdVector<FaceId, bool> placed(surface.face_count(), false);
  std::vector<FaceId> todo{FaceId(0)};
  plates[FaceId(0)] = {{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  placed[FaceId(0)] = true;
  while (!todo.empty()) {
    const FaceId face = todo.back();
    todo.pop_back();
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = mesh::corner(face, k);
      const EdgeId edge = surface.edge(side);
      const CornerId twin = surface.twin(side);
      if (nets.use[edge] != unfold::EdgeUse::fold || placed[mesh::face_of(twin)]) {
        continue;
      }
      const double angle = surface.fold_angle(edge);
      plates[mesh::face_of(twin)] = turned(plates[face], nets.flat[face][k], nets.flat[face][(k + 1) % 3],
                                           std::abs(angle) > 1e-6 ? depth_of(board) : 0.0, -angle);
      placed[mesh::face_of(twin)] = true;
      todo.push_back(mesh::face_of(twin));
    }
  }
  CHECK(std::ranges::all_of(placed, [](bool is) { return is; }));
  return plates;
}

Box3 box_of_plate(const Plate& plate, std::span<const Vec2> polygon, double thickness) {
  Box3 box;
  for (const Vec2 p : polygon) {
    box.add(plate.at(p, 0.0));
    box.add(plate.at(p, thickness));
  }
  return box;
}

/// How deep two boxes are in each other.
double depth_in(const Box3& one, const Box3& other) {
  const Vec3 d{std::min(one.high.x, other.high.x) - std::max(one.low.x, other.low.x),
               std::min(one.high.y, other.high.y) - std::max(one.low.y, other.low.y),
               std::min(one.high.z, other.high.z) - std::max(one.low.z, other.low.z)};
  return std::max(0.0, std::min({d.x, d.y, d.z}));
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
    export_::ThickReport report;
    const unfold::Nets thick = export_::thick_nets(sample.model, sample.nets, board, &report);
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
    const unfold::Nets thick = export_::thick_nets(sample.model, sample.nets, {1.5, Hinge::middle});
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
      CHECK(loops_area(unfold::cut_lines(model, thick, piece).loops) == Approx(covered).epsilon(2e-3));
    }
  }
}

TEST_CASE("panels of a cube of 60 mm are as wide between folds and tabs as sections through it tell") {
  const test::SamplePages sample = test::sample_pages(test::cube(), 60.0, 12.0);
  using Kinds = std::pair<BoardSide, BoardSide>;
  const auto widths_with = [&](Hinge hinge) {
    std::map<Kinds, std::vector<double>> widths;
    const unfold::Nets thick = export_::thick_nets(sample.model, sample.nets, {2.0, hinge});
    for (const auto& sides : sides_of_parts(sample.model.model.surface, thick)) {
      for (const PartSide& one : sides) {
        for (const PartSide& other : sides) {
          const Vec2 along = (one.b - one.a) / length(one.b - one.a);
          if (dot(along, other.b - other.a) < -1.0 && std::abs(cross(along, other.b - other.a)) < 1e-6 &&
              one.angle < -1e-6 && other.angle < -1e-6 && one.kind <= other.kind) {
            widths[{one.kind, other.kind}].push_back(cross(along, other.a - one.a));
          }
        }
      }
    }
    return widths;
  };
  const std::map<Hinge, std::map<Kinds, double>> wanted{
      {Hinge::back,
       {{{BoardSide::fold, BoardSide::fold}, 56.0},
        {{BoardSide::fold, BoardSide::tab_base}, 54.0},
        {{BoardSide::fold, BoardSide::tab_target}, 58.0},
        {{BoardSide::tab_base, BoardSide::tab_target}, 56.0}}},
      {Hinge::front,
       {{{BoardSide::fold, BoardSide::fold}, 60.0},
        {{BoardSide::fold, BoardSide::tab_base}, 58.0},
        {{BoardSide::fold, BoardSide::tab_target}, 60.0},
        {{BoardSide::tab_base, BoardSide::tab_target}, 58.0}}}};
  for (const auto& [hinge, by_kinds] : wanted) {
    const auto widths = widths_with(hinge);
    CHECK(widths.contains({BoardSide::fold, BoardSide::fold}));
    CHECK(widths.contains({BoardSide::fold, BoardSide::tab_base}));
    for (const auto& [kinds, found] : widths) {
      if (by_kinds.contains(kinds)) {
        for (const double width : found) {
          CHECK(width == Approx(by_kinds.at(kinds)).margin(1e-6));
        }
      }
    }
  }
}

TEST_CASE("a cube of board, folded up as plates about its hinges, is as large as asked, and its plates fit") {
  for (const double thickness : {1.0, 2.0, 3.0}) {
    for (const Hinge hinge : {Hinge::back, Hinge::middle, Hinge::front}) {
      CAPTURE(thickness, static_cast<int>(hinge));
      const test::SamplePages sample = test::sample_pages(test::cube(), 60.0, 12.0);
      const mesh::Surface& surface = sample.model.model.surface;
      REQUIRE(sample.nets.pieces.size() == 1);
      const Board board{thickness, hinge};
      const unfold::Nets thick = export_::thick_nets(sample.model, sample.nets, board);
      const IdVector<FaceId, Plate> plates = folded_up(surface, thick, board);
      std::map<PanelId, Box3> panels;
      Box3 all;
      for (const FaceId face : ids<FaceId>(surface.face_count())) {
        Box3& panel = panels[sample.model.panels.panel[face]];
        const Box3 own = box_of_plate(plates[face], thick.flat[face], thickness);
        for (Box3* box : {&panel, &all}) {
          box->add(own.low);
          box->add(own.high);
        }
      }
      CHECK(all.high.x - all.low.x == Approx(60.0).margin(0.01));
      CHECK(all.high.y - all.low.y == Approx(60.0).margin(0.01));
      CHECK(all.high.z - all.low.z == Approx(60.0).margin(0.01));
      if (hinge != Hinge::back) {
        continue;  // what is creased is pressed, and what is grooved is taken away, at the inside of a fold
      }
      for (const auto& [one, box] : panels) {
        for (const auto& [other, beside] : panels) {
          if (one < other) {
            CHECK(depth_in(box, beside) <= 0.05 * thickness);
          }
        }
      }
      REQUIRE_FALSE(thick.tabs.empty());
      for (const unfold::Tab& tab : thick.tabs) {
        if (std::abs(surface.fold_angle(surface.edge(tab.side))) < 1e-6) {
          continue;  // within a face of the cube, where the board's step stays
        }
        const FaceId own = mesh::face_of(tab.side);
        const FaceId target = mesh::face_of(surface.twin(tab.side));
        const Plate plate = turned(plates[own], tab.polygon[1], tab.polygon[0], thickness,
                                   -surface.fold_angle(surface.edge(tab.side)));
        const Box3 box = box_of_plate(plate, tab.polygon, thickness);
        // It lies behind the face that it is glued to, back to front.
        const Plate& before = plates[target];
        double nearest = 1e9;
        for (const Vec2 p : tab.polygon) {
          nearest = std::min(nearest, dot(before.origin - plate.at(p, 0.0), before.z));
        }
        CHECK(nearest == Approx(thickness).margin(0.05 * thickness));
        CHECK(depth_in(box, panels[sample.model.panels.panel[target]]) <= 0.05 * thickness);
        CHECK(depth_in(box, panels[sample.model.panels.panel[own]]) <= 0.05 * thickness);
      }
    }
  }
}

TEST_CASE("panels at a valley grow, and paper stays as it is") {
  const mesh::Surface block = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
  std::vector<EdgeId> ridges = test::all_edges(block);
  std::erase_if(ridges, [&](EdgeId edge) { return block.fold_angle(edge) > 0.0; });
  const test::SamplePages sample = test::sample_pages(block, 40.0, 0.0, ridges);
  CHECK(export_::thick_nets(sample.model, sample.nets, {}).flat == sample.nets.flat);
  // At the valley h tan 45 degrees is added; across lies a mitre, which takes 2 mm.
  for (const auto& [hinge, width] :
       {std::pair{Hinge::back, 40.0}, {Hinge::middle, 39.0}, {Hinge::front, 38.0}}) {
    export_::ThickReport report;
    const unfold::Nets thick = export_::thick_nets(sample.model, sample.nets, {2.0, hinge}, &report);
    CHECK(report.kept == 0);
    std::size_t found = 0;
    for (const auto& sides : sides_of_parts(sample.model.model.surface, thick)) {
      for (const PartSide& valley : sides) {
        for (const PartSide& other : sides) {
          const Vec2 along = (valley.b - valley.a) / length(valley.b - valley.a);
          if (valley.angle > 1e-6 && dot(along, other.b - other.a) < -1.0) {
            CHECK(cross(along, other.a - valley.a) == Approx(width).margin(1e-6));
            ++found;
          }
        }
      }
    }
    CHECK(found == 2);
  }
}

TEST_CASE("board that is too thick for a model leaves its faces two thirds of their height") {
  const test::SamplePages sample = test::sample_pages(test::cube(), 10.0, 3.0);
  export_::ThickReport report;
  const unfold::Nets thick = export_::thick_nets(sample.model, sample.nets, {8.0, Hinge::back}, &report);
  CHECK(report.clamped + report.kept > 0);
  for (const FaceId f : ids<FaceId>(sample.model.model.surface.face_count())) {
    CHECK(doubled_area(thick.flat[f]) > 0.0);
  }
}

}  // namespace ridgecraft
