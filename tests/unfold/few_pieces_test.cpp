// SPDX-License-Identifier: GPL-3.0-or-later
// As few pieces as possible: parts are no reason for more.
#include <cstdint>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"

using namespace ridgecraft;
using unfold::Nets;

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
