// SPDX-License-Identifier: GPL-3.0-or-later
// As few pieces as possible: parts are no reason for more.
#include "unfold/pieces/fewer_pieces.hpp"

#include <cstdint>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Nets;
using unfold::Patch;

namespace {

Nets few_pieces(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                const unfold::Options& options) {
  return unfold::unfold(surface, test::no_panels(surface), part, options, Context());
}

}  // namespace

TEST_CASE("a model in many parts needs no more pieces than the same in one", "[pieces]") {
  Random random(11);
  for (const double mm : {40.0, 70.0, 90.0}) {
    const mesh::Surface ball = test::scaled(test::sphere(8, 6), mm);
    IdVector<FaceId, PartId> many;
    for (std::size_t f = 0; f < ball.face_count(); ++f) {
      many.push_back(PartId(random.below(9)));
    }
    unfold::Options options = test::on_sheet(190.0, 277.0);
    options.pieces = unfold::rules_of(unfold::PieceMode::few);
    options.pieces.trials_per_face = 50.0;
    const Nets apart = few_pieces(ball, many, options);
    const Nets whole = few_pieces(ball, test::one_part(ball), options);
    CAPTURE(mm);
    CHECK(test::faults_of(ball, apart, options).empty());
    CHECK(apart.pieces.size() <= whole.pieces.size());
  }
}

TEST_CASE("pieces join where one net takes them, and stay clean and on the sheet", "[pieces]") {
  const mesh::Surface ball = test::scaled(test::sphere(7, 5), 30.0);
  const prepare::Panels panels = test::no_panels(ball);
  const Patch patch = test::whole_patch(ball, panels);
  // Each face by itself; all of them are one net of this size.
  const Folds crumbs(patch.twin.size(), 0);
  for (const double width : {60.0, 110.0, 400.0}) {
    unfold::Options options = test::on_sheet(width, 300.0);
    options.pieces = unfold::rules_of(unfold::PieceMode::few);
    const unfold::Room room{options.sheet, 5.0, 0};
    const Folds fewer = unfold::fewer_pieces({ball, panels, patch, {}, options, room}, crumbs, Context());
    const unfold::Layout layout = lay_out(patch, fewer);
    CAPTURE(width, layout.faces.size());
    CHECK(all_fit(patch, fewer, room));
    CHECK(find_overlaps(layout, 1e-5).empty());
    CHECK(layout.faces.size() >= least_pieces(patch, room));
    CHECK((width < 400.0 || layout.faces.size() == 1));
    CHECK(layout.faces.size() < 8);
  }
}
