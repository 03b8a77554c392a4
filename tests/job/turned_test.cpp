// SPDX-License-Identifier: GPL-3.0-or-later
// What turned pieces come to when a whole job is made of them.
#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "job/job.hpp"
#include "mesh/mesh.hpp"

using namespace ridgecraft;

TEST_CASE("a piece that turning makes has a reason", "[job]") {
  const mesh::Model model =
      mesh::read(std::string(RIDGECRAFT_SOURCE_DIR) + "/tests/job/three_arms.obj", {}, {});
  job::Options options;
  options.size.largest_extent_mm = 120.0;
  options.simplify.mode = prepare::Simplification::keep;
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  const job::Paper made = job::paper(model, options, {});
  CHECK(made.nets.pieces.size() > made.part_count);
  CHECK(std::any_of(made.nets.pieces.begin(), made.nets.pieces.end(),
                    [](const unfold::Piece& piece) { return piece.reason == unfold::PieceReason::shape; }));
}
