// SPDX-License-Identifier: GPL-3.0-or-later
// Why pieces are there: what is told must be so.
#include <algorithm>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "bench/spiky_bodies.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/panel_parts.hpp"
#include "unfold/pieces/patch_nets.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;

namespace {

std::size_t count(const Nets& nets, PieceReason reason) {
  return static_cast<std::size_t>(std::count_if(nets.pieces.begin(), nets.pieces.end(),
                                                [&](const Piece& piece) { return piece.reason == reason; }));
}

/// Parts by the height of the faces' middles.
IdVector<FaceId, PartId> slices(const mesh::Surface& s) {
  IdVector<FaceId, PartId> part(s.face_count());
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const auto [a, b, c] = s.vertices(f);
    part[f] = PartId((s.point(a).z + s.point(b).z + s.point(c).z) / 3.0 > 1.0 ? 1 : 0);
  }
  return part;
}

std::vector<mesh::Surface> shapes() {
  std::vector<mesh::Surface> shapes;
  shapes.push_back(test::scaled(test::sphere(10, 6), 60.0));
  shapes.push_back(bench::spiky_ball(0, 12, 2.0, 1));
  shapes.push_back(bench::spiky_box(1, 1, 2, 20, 6.0, 2));
  shapes.push_back(
      test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}}, 2), 50.0));
  return shapes;
}

Options quick(std::optional<Sheet> sheet, std::size_t max_panels) {
  Options options;
  options.sheet = sheet;
  options.pieces.max_panels = max_panels;
  options.pieces.trials_per_face = 0;
  return options;
}

}  // namespace

TEST_CASE("without paper no piece is there for the page, and a larger sheet saves those that are",
          "[reasons][slow]") {
  std::size_t for_page = 0;
  std::size_t for_faces = 0;
  for (const mesh::Surface& s : shapes()) {
    const prepare::Panels panels = test::no_panels(s);
    for (const IdVector<FaceId, PartId>& part : {test::one_part(s), slices(s)}) {
      for (const std::size_t most : {std::size_t{0}, std::size_t{24}}) {
        const auto nets_on = [&](std::optional<Sheet> sheet) {
          const Options options = quick(sheet, most);
          return unfold::unfold(s, panels, part, options, {});
        };
        const Nets any = nets_on({});
        CHECK(count(any, PieceReason::page) == 0);
        CHECK((most > 0 || count(any, PieceReason::faces) == 0));
        const Nets small = nets_on(Sheet{150.0, 190.0});
        const Nets large = nets_on(Sheet{5000.0, 5000.0});
        CHECK(count(large, PieceReason::page) == 0);
        INFO(s.face_count() << " faces, at most " << most << ": " << small.pieces.size() << " pieces, "
                            << large.pieces.size() << " on a large sheet");
        CHECK(large.pieces.size() + count(small, PieceReason::page) <= small.pieces.size());
        for_page += count(small, PieceReason::page);
        for_faces += count(small, PieceReason::faces);
      }
    }
  }
  CHECK(for_page > 5);
  CHECK(for_faces > 5);
}

TEST_CASE("the largest piece stands for a patch, then come overlap, faces and the page", "[reasons]") {
  const mesh::Surface cube = test::cube();
  const Patch patch = test::whole_patch(cube);
  const Folds apart(patch.twin.size(), 0);
  PiecesWithout without{2, 4, PieceReason::no_net};
  const std::vector<PieceReason> reasons = piece_reasons(patch, apart, without);
  REQUIRE(reasons.size() == 12);
  CHECK(std::count(reasons.begin(), reasons.end(), PieceReason::part) == 1);
  CHECK(std::count(reasons.begin(), reasons.end(), PieceReason::no_net) == 1);
  CHECK(std::count(reasons.begin(), reasons.end(), PieceReason::faces) == 2);
  CHECK(std::count(reasons.begin(), reasons.end(), PieceReason::page) == 8);
}
