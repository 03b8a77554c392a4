// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of folds.
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/tree.hpp"

using namespace ridgecraft;

TEST_CASE("a circle of folds is told, not followed for ever", "[forest]") {
  // The folds around one corner of a tetrahedron.
  const mesh::Surface surface = test::tetrahedron();
  const unfold::Patch patch = test::whole_patch(surface);
  unfold::Folds folds(patch.twin.size(), 0);
  const CornerId start = CornerId(0);
  CornerId around = start;
  do {
    unfold::set_fold(patch, folds, around.value(), true);
    around = mesh::next(surface.twin(around));
  } while (around != start);
  std::vector<std::uint32_t> place(patch.face.size(), no_index);
  CHECK_THROWS_AS(unfold::rooted_tree(patch, folds, 0, place), Error);
  unfold::set_fold(patch, folds, start.value(), false);
  CHECK(unfold::rooted_tree(patch, folds, 0, place).order.size() == 3);
}
