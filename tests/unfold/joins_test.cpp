// SPDX-License-Identifier: GPL-3.0-or-later
// Every cut is a join with a number of its own, however seams fork and run into themselves.
#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/net/nets.hpp"

using namespace ridgecraft;

TEST_CASE("every cut gets one number, whichever edges are cuts and whatever pieces they part", "[unfold]") {
  const mesh::Surface surface = test::sphere(9, 7);
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    const std::uint32_t pieces = 1 + static_cast<std::uint32_t>(random.below(4));
    const std::uint32_t one_in = 2 + static_cast<std::uint32_t>(random.below(3));
    unfold::Nets nets;
    nets.use = IdVector<EdgeId, unfold::EdgeUse>(surface.edge_count(), unfold::EdgeUse::fold);
    nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      nets.use[e] = random.below(one_in) == 0 ? unfold::EdgeUse::cut : unfold::EdgeUse::fold;
    }
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      nets.piece[f] = PieceId(static_cast<std::uint32_t>(random.below(pieces)));
    }
    unfold::number_joins(surface, nets);
    std::vector<std::size_t> joins_of(surface.edge_count(), 0);
    for (const JoinId j : ids<JoinId>(nets.joins.size())) {
      CHECK(nets.joins[j].number == j.value() + 1);
      ++joins_of[nets.joins[j].edge.value()];
    }
    std::size_t wrong = 0;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      wrong += joins_of[e.value()] != (nets.use[e] == unfold::EdgeUse::cut ? 1U : 0U) ? 1U : 0U;
    }
    CHECK(wrong == 0);
  }
}
