// SPDX-License-Identifier: GPL-3.0-or-later
// Why pieces are there: what is told must be so.
#include <algorithm>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "bench/spiky_bodies.hpp"
#include "support/shapes.hpp"
#include "unfold/edits.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/panel_parts.hpp"
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

/// Some cuts between a piece and others.
std::vector<EdgeId> longest_cuts(const mesh::Surface& s, const Nets& nets, PieceId piece) {
  std::vector<EdgeId> cuts;
  for (const Join& join : nets.joins) {
    const auto [c, d] = s.sides(join.edge);
    const PieceId a = nets.piece[mesh::face_of(c)];
    const PieceId b = nets.piece[mesh::face_of(d)];
    if (a != b && (a == piece || b == piece)) {
      cuts.push_back(join.edge);
    }
  }
  std::stable_sort(cuts.begin(), cuts.end(), [&](EdgeId a, EdgeId b) { return s.length(a) > s.length(b); });
  cuts.resize(std::min<std::size_t>(cuts.size(), 1));
  return cuts;
}

}  // namespace

TEST_CASE("what is told of a piece stops whoever joins it by hand", "[reasons][slow]") {
  std::map<PieceReason, int> told;
  for (const mesh::Surface& s : shapes()) {
    const prepare::Panels panels = test::no_panels(s);
    for (const IdVector<FaceId, PartId>& part : {test::one_part(s), slices(s)}) {
      for (const std::optional<Sheet>& sheet : {std::optional<Sheet>{}, std::optional(Sheet{150.0, 190.0})}) {
        const Options options = quick(sheet, 0);
        const UnfoldProblem problem{s, panels, part, options};
        const Nets nets = unfold::unfold(s, panels, part, options, {});
        CHECK((sheet || count(nets, PieceReason::page) == 0));
        CHECK(count(nets, PieceReason::faces) == 0);
        for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
          const PieceReason reason = nets.pieces[p].reason;
          ++told[reason];
          for (const EdgeId e : longest_cuts(s, nets, p)) {
            const ChangedNets joined = join_cut(problem, nets, e, {});
            const auto* const refusal = std::get_if<Refusal>(&joined);
            INFO(s.face_count() << " faces, piece " << nets.pieces[p].name);
            // On a sheet it is what stops most cuts, and by hand a piece may use the strip for tabs.
            CHECK((sheet || reason != PieceReason::overlap || refusal != nullptr));
            CHECK((reason != PieceReason::no_net || refusal != nullptr));
          }
        }
      }
    }
  }
  CHECK(told[PieceReason::part] > 10);
  CHECK(told[PieceReason::page] > 5);
}

TEST_CASE("of a piece that may have so many faces no neighbour has room for more", "[reasons][slow]") {
  const mesh::Surface s = test::scaled(test::sphere(10, 6), 60.0);
  const Options options = quick({}, 24);
  const Nets nets = unfold::unfold(s, test::no_panels(s), test::one_part(s), options, {});
  REQUIRE(count(nets, PieceReason::part) == 1);
  CHECK(count(nets, PieceReason::faces) > 0);
  CHECK(count(nets, PieceReason::page) == 0);
}
