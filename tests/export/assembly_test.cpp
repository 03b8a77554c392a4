// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which pieces are put together: complete, always glued to what stands, and kind to fingers.
#include "export/assembly/assembly.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/simple_nets.hpp"

namespace ridgecraft {
namespace {

using export_::Assembly;
using export_::AssemblyStep;
using mesh::Surface;

/// Copies of a surface, each at its place and its scale.
struct Copy {
  double scale = 1.0;
  Vec3 shift;
};
Surface copies(const Surface& surface, const std::vector<Copy>& places) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const Copy& copy : places) {
    const auto first = points.size();
    for (const Vec3 p : surface.points()) {
      points.push_back(copy.scale * p + copy.shift);
    }
    for (const FaceId face : ids<FaceId>(surface.face_count())) {
      auto& corners = faces.emplace_back(surface.vertices(face));
      for (VertexId& v : corners) {
        v = VertexId(v.value() + first);
      }
    }
  }
  return {std::move(points), std::move(faces)};
}

std::vector<EdgeId> folded_edges(const Surface& surface) {
  std::vector<EdgeId> edges;
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    if (std::abs(surface.fold_angle(edge)) > 0.01) {
      edges.push_back(edge);
    }
  }
  return edges;
}

/// What every assembly is: worked out from the nets alone.
void check_assembly(const Surface& surface, const unfold::Nets& nets, const Assembly& assembly) {
  IdVector<PieceId, std::size_t> step(nets.pieces.size(), assembly.steps.size());
  for (std::size_t s = 0; s < assembly.steps.size(); ++s) {
    CHECK(std::is_sorted(assembly.steps[s].pieces.begin(), assembly.steps[s].pieces.end()));
    for (const PieceId piece : assembly.steps[s].pieces) {
      CHECK(step[piece] == assembly.steps.size());
      step[piece] = s;
    }
  }
  std::vector<std::set<JoinId>> own(assembly.steps.size());
  std::vector<std::set<JoinId>> joins(assembly.steps.size());
  std::set<PieceId> glued;
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    const auto [c, d] = surface.sides(nets.joins[j].edge);
    const PieceId a = nets.piece[mesh::face_of(c)];
    const PieceId b = nets.piece[mesh::face_of(d)];
    REQUIRE(std::max(step[a], step[b]) < assembly.steps.size());
    (a == b ? own : joins)[std::max(step[a], step[b])].insert(j);
    if (step[a] != step[b]) {
      glued.insert(step[a] > step[b] ? a : b);
    }
  }
  for (std::size_t s = 0; s < assembly.steps.size(); ++s) {
    const AssemblyStep& told = assembly.steps[s];
    CHECK(std::vector<JoinId>(own[s].begin(), own[s].end()) == told.own);
    CHECK(std::vector<JoinId>(joins[s].begin(), joins[s].end()) == told.joins);
    for (const PieceId piece : told.pieces) {
      CHECK(glued.contains(piece) != told.starts);
    }
  }
}

TEST_CASE("each piece stands once, each join is glued once, on what stands", "[assembly]") {
  Random random(7);
  for (const Surface& shape :
       {test::cube(), test::sphere(8, 5), test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}) {
    for (int round = 0; round < 20; ++round) {
      std::vector<EdgeId> cuts;
      for (const EdgeId edge : folded_edges(shape)) {
        if (random.below(3) > 0) {
          cuts.push_back(edge);
        }
      }
      const unfold::Nets nets = test::simple_nets(shape, cuts);
      check_assembly(shape, nets, export_::assembly_order(shape, nets));
    }
  }
}

TEST_CASE("pieces whose seams have hardly a length stand once, too", "[assembly]") {
  // No seam of the second cube is longer than rounding.
  const Surface surface = copies(test::cube(), {{50.0, {}}, {1e-8, {100.0, 0.0, 0.0}}});
  std::vector<EdgeId> cuts;
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    cuts.push_back(edge);
  }
  const unfold::Nets nets = test::simple_nets(surface, cuts);
  std::vector<PieceId> placed;
  for (const AssemblyStep& step : export_::assembly_order(surface, nets).steps) {
    placed.insert(placed.end(), step.pieces.begin(), step.pieces.end());
  }
  std::ranges::sort(placed);
  CHECK(placed.size() == nets.pieces.size());
  CHECK(std::ranges::adjacent_find(placed) == placed.end());
}

TEST_CASE("a closed body ends with a piece without which the others hang together", "[assembly]") {
  const Surface cube = test::cube();
  const unfold::Nets nets = test::simple_nets(copies(cube, {{50.0, {}}}), folded_edges(cube));
  REQUIRE(nets.pieces.size() == 6);
  const Surface large = copies(cube, {{50.0, {}}});
  const Assembly assembly = export_::assembly_order(large, nets);
  REQUIRE(assembly.steps.size() == 6);
  CHECK(assembly.steps.front().starts);
  CHECK(assembly.steps.back().closes);
  CHECK(assembly.steps.back().joins.size() == 4);
  for (std::size_t s = 0; s + 1 < 6; ++s) {
    CHECK_FALSE(assembly.steps[s].closes);
  }
}

TEST_CASE("a closed body ends on its underside, if that closes easily enough", "[assembly]") {
  const Surface cube = copies(test::cube(), {{50.0, {}}});
  const unfold::Nets nets = test::simple_nets(cube, folded_edges(cube));
  for (const Vec3 up : {Vec3{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}) {
    const Assembly assembly = export_::assembly_order(cube, nets, up);
    check_assembly(cube, nets, assembly);
    const PieceId last = assembly.steps.back().pieces.front();
    for (const FaceId f : nets.pieces[last].faces) {
      CHECK(dot(cube.normal(f), up) < -0.9);
    }
  }
}

TEST_CASE("what meets most of what stands comes first", "[assembly]") {
  const Surface shape = test::sphere(8, 5);
  const unfold::Nets nets = test::simple_nets(shape, folded_edges(shape));
  const export_::SeamGraph graph = export_::seam_graph(shape, nets);
  const Assembly assembly = export_::assembly_order(shape, nets);
  // At most one piece, the last one, is kept back.
  const PieceId last = assembly.steps.back().pieces.front();
  std::set<PieceId> standing;
  const auto seam = [&](PieceId piece) {
    double sum = 0.0;
    for (const PieceId other : standing) {
      sum += graph.seam_between(piece, other);
    }
    return sum;
  };
  for (const AssemblyStep& step : assembly.steps) {
    for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
      if (!step.starts && piece != last && !standing.contains(piece)) {
        CHECK(seam(piece) <= seam(step.pieces.front()) + 1e-5);
      }
    }
    standing.insert(step.pieces.begin(), step.pieces.end());
  }
}

TEST_CASE("inner bodies come before those around them", "[assembly]") {
  const Surface cube = test::cube();
  const Surface nested = copies(
      cube, {{50.0, {}}, {10.0, {100.0, 0.0, 0.0}}, {20.0, {10.0, 10.0, 10.0}}, {5.0, {12.0, 12.0, 12.0}}});
  const unfold::Nets nets = test::simple_nets(nested);
  REQUIRE(nets.pieces.size() == 4);
  const auto order = export_::inner_groups_first(nested, nets, export_::seam_graph(nested, nets));
  CHECK(order == std::vector<std::size_t>{3, 2, 0, 1});
  CHECK(export_::assembly_order(nested, nets).steps.front().pieces == std::vector<PieceId>{PieceId(3)});
}

TEST_CASE("a body that begins in another one and stands out of it, or lies on it, isn't inside",
          "[assembly]") {
  // A large cube with a corner cut out, and a small one that fills a part of the notch and of what is around
  // it; or one a hair inside of a side.
  const Surface notched = test::scaled(
      test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}), 40.0);
  const auto order_with = [&](double scale, Vec3 shift) {
    const Surface both = test::together({notched, copies(test::cube(), {{scale, shift}})});
    const unfold::Nets nets = test::simple_nets(both);
    const export_::SeamGraph graph = export_::seam_graph(both, nets);
    REQUIRE(graph.groups.size() == 2);
    return export_::inner_groups_first(both, nets, graph);
  };
  const std::vector<std::size_t> as_numbered{0, 1};
  const std::vector<std::size_t> inner_first{1, 0};
  CHECK(order_with(20.0, {32.0, 32.0, 32.0}) == as_numbered);
  CHECK(order_with(0.4, {10.0, 10.0, 0.2}) == as_numbered);
  CHECK(order_with(20.0, {10.0, 10.0, 10.0}) == inner_first);
}

TEST_CASE("a body is found inside another wherever it stands on a grid", "[assembly]") {
  // Simple directions from a corner of it meet edges and corners of what is around it.
  const Surface cube = test::cube();
  for (double x = 2.0; x <= 48.0; x += 2.0) {
    for (double y = 2.0; y <= 48.0; y += 2.0) {
      for (double z = 2.0; z <= 48.0; z += 2.0) {
        const Surface nested = copies(cube, {{60.0, {}}, {10.0, {x, y, z}}});
        const unfold::Nets nets = test::simple_nets(nested);
        if (export_::inner_groups_first(nested, nets, export_::seam_graph(nested, nets)) !=
            std::vector<std::size_t>{1, 0}) {
          FAIL("at " << x << ", " << y << ", " << z);
        }
      }
    }
  }
}

TEST_CASE("equal bodies are built side by side", "[assembly]") {
  const Surface cube = test::cube();
  const Surface wheels = copies(cube, {{10.0, {}}, {10.0, {50.0, 0.0, 0.0}}, {10.0, {0.0, 50.0, 0.0}}});
  unfold::Nets nets = test::simple_nets(wheels, folded_edges(wheels));
  REQUIRE(nets.pieces.size() == 18);
  // Side k of a wheel is equal to side k of the others, and the sides of one are told apart.
  const export_::SeamGraph graph = export_::seam_graph(wheels, nets);
  for (std::size_t k = 0; k < 6; ++k) {
    auto& kind = nets.equal.emplace_back();
    for (const auto& group : graph.groups) {
      kind.push_back({group[k], false, {}});
    }
  }
  const Assembly assembly = export_::assembly_order(wheels, nets);
  check_assembly(wheels, nets, assembly);
  CHECK(assembly.steps.size() == 6);
  for (const AssemblyStep& step : assembly.steps) {
    CHECK(step.pieces.size() == 3);
  }
}

}  // namespace
}  // namespace ridgecraft
