// SPDX-License-Identifier: GPL-3.0-or-later
// Equal pieces are twins where the model's author has divided them alike.
#include "unfold/pieces/twin_pieces.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "nets_checks.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "unfold/patch/patch.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Patch;
using unfold::TwinPieces;

namespace {

constexpr std::uint32_t faces_of_body = 12;

/// Four equal bodies of six flat sides without a symmetry; two of them are turned.
mesh::Surface four_bodies() {
  const mesh::Surface one = test::mapped(test::cube(), [](Vec3 p) {
    return Vec3{20.0 * p.x + 3.0 * p.y, 26.0 * p.y + 2.0 * p.z, 35.0 * p.z + 4.0 * p.x};
  });
  const auto at = [&](double x, double turn) {
    return test::mapped(one, [&](Vec3 p) { return Vec3{turn * p.x + x, turn * p.y, p.z}; });
  };
  return test::together({at(0.0, 1.0), at(100.0, -1.0), at(200.0, 1.0), at(300.0, -1.0)});
}

/// Every body in one piece.
Folds one_piece_each(const Patch& patch) {
  Folds folds(patch.twin.size(), 0);
  std::vector<std::uint32_t> root(patch.size());
  std::iota(root.begin(), root.end(), 0U);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != unfold::nothing && root[side / 3] != root[twin / 3]) {
      const std::uint32_t old = root[twin / 3];
      for (std::uint32_t& r : root) {
        r = r == old ? root[side / 3] : r;
      }
      folds[side] = folds[twin] = 1;
    }
  }
  return folds;
}

TwinPieces twins_of(const mesh::Surface& surface, const prepare::Panels& panels,
                    const std::vector<std::uint32_t>& labels) {
  const Patch patch = test::whole_patch(surface, panels, labels);
  return unfold::find_twin_pieces(surface, patch, one_piece_each(patch), {});
}

std::vector<std::uint32_t> bodies_of(const std::vector<unfold::TwinPiece>& kind) {
  std::vector<std::uint32_t> bodies;
  for (const unfold::TwinPiece& piece : kind) {
    CHECK(piece.faces.size() == faces_of_body);
    bodies.push_back(piece.faces.front() / faces_of_body);
  }
  return bodies;
}

}  // namespace

TEST_CASE("twins are those that labels divide alike", "[twins]") {
  const mesh::Surface surface = four_bodies();
  REQUIRE(surface.face_count() == 4 * faces_of_body);
  const prepare::Panels panels = prepare::find_panels(surface);
  std::vector<std::uint32_t> labels(surface.face_count(), 0);
  REQUIRE(twins_of(surface, panels, labels).size() == 1);
  CHECK(twins_of(surface, panels, labels)[0].size() == 4);

  // A label of its own for a whole body divides nothing within it.
  std::fill_n(labels.begin() + 2 * faces_of_body, faces_of_body, 1U);
  REQUIRE(twins_of(surface, panels, labels).size() == 1);

  // One side of two bodies.
  std::fill(labels.begin(), labels.end(), 0U);
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    const std::uint32_t body = f / faces_of_body;
    const bool first_side = panels.panel[FaceId(f)] == panels.panel[FaceId(body * faces_of_body)];
    labels[f] = body >= 2 && first_side ? 1 : 0;
  }
  const TwinPieces twins = twins_of(surface, panels, labels);
  REQUIRE(twins.size() == 2);
  CHECK(bodies_of(twins[0]) == std::vector<std::uint32_t>{0, 1});
  CHECK(bodies_of(twins[1]) == std::vector<std::uint32_t>{2, 3});
  const auto is_border = [&](EdgeId e) {
    const auto [c, d] = surface.sides(e);
    return labels[mesh::face_of(c).value()] != labels[mesh::face_of(d).value()];
  };
  for (const std::vector<unfold::TwinPiece>& kind : twins) {
    for (const unfold::TwinPiece& piece : kind) {
      CHECK(piece.edges.size() == 18);
      for (const auto& [original, edge] : piece.edges) {
        CHECK(mesh::face_of(surface.sides(original)[0]).value() / faces_of_body ==
              kind[0].faces.front() / faces_of_body);
        CHECK(surface.length(original) == Approx(surface.length(edge)));
        CHECK(is_border(original) == is_border(edge));
      }
    }
  }
}
