// SPDX-License-Identifier: GPL-3.0-or-later
// The size that would save a page: told where squares can be counted by hand.
#include <catch2/catch.hpp>

#include "export/export.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

/// The six squares of a cube of this size on A4, with 190 x 265 mm for pieces.
std::optional<double> share(double side_mm, std::size_t expected_pages) {
  const mesh::Surface cube = test::cube();
  const double scale = side_mm / cube.bounds().size().x;
  const auto sample = test::sample_pages(cube, scale, 0.0, test::all_edges(cube));
  REQUIRE(sample.nets.pieces.size() == 6);
  const export_::Pages pages = export_::layout(sample.nets, {}, {});
  REQUIRE(pages.count == expected_pages);
  return export_::scale_that_saves_a_page(sample.nets, pages, {});
}

TEST_CASE("a size that saves a page is told", "[page_saving]") {
  // Two beside each other and two rows; a third row needs 87 mm, 85 in the coarse cells of a quick search.
  CHECK(share(89.0, 2).value_or(0.0) == 0.9);
  CHECK(share(92.0, 2).value_or(0.0) == 0.87);
  // Two beside each other need 94 mm; two rows of one do until then: the gap is 2 mm.
  CHECK(share(96.0, 3).value_or(0.0) == 0.93);
}

TEST_CASE("where no size nearby saves a page, none is told", "[page_saving]") {
  CHECK_FALSE(share(60.0, 1).has_value());
  CHECK_FALSE(share(130.0, 3).has_value());
}

}  // namespace
}  // namespace ridgecraft
