// SPDX-License-Identifier: GPL-3.0-or-later
// Size, subdivision, and what is too small to be cut.
#include "prepare/prepare.hpp"

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/common_models.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::Prepared;
using prepare::SimplifyOptions;
using prepare::SizeOptions;
using test::page;

namespace {

Prepared prepared_unchanged(const mesh::Surface& surface, SizeOptions size = {}) {
  SimplifyOptions keep;
  keep.mode = prepare::Simplification::keep;
  return prepare::prepare(test::repaired(test::soup_of(surface)), size, keep, page, {});
}

}  // namespace

TEST_CASE("the largest extent becomes the size asked for, centred", "[prepare]") {
  const Prepared p = prepared_unchanged(test::revolve({{0, 0}, {3, 4}, {0, 5}}, 16));
  const Box3& box = p.model.surface.bounds();
  CHECK(std::max({box.size().x, box.size().y, box.size().z}) == Approx(150.0));
  CHECK(length(box.low + box.high) < 1e-9);
  CHECK(p.mm_per_unit == Approx(25.0));
  CHECK(p.model.surface.face_count() == 32);
  CHECK(p.panels.panel.size() == p.model.surface.face_count());
}

TEST_CASE("a scale wins over the size and undoes the file's scale", "[prepare]") {
  mesh::Model model = test::repaired(test::soup({{0, 0, 0}, {1e300, 0, 0}, {0, 1e300, 0}}, {{0, 1, 2}}));
  SizeOptions size;
  size.mm_per_unit = 2e-299;
  const Prepared p = prepare::prepare(model, size, {}, page, {});
  CHECK(p.model.surface.bounds().size().x == Approx(20.0));
  CHECK(p.mm_per_unit == 2e-299);
  CHECK(p.model.file_scale == 1.0);
}

TEST_CASE("sizes that no paper has are refused", "[prepare]") {
  for (const double scale : {1e9, 1e-9}) {
    SizeOptions size;
    size.mm_per_unit = scale;
    try {
      static_cast<void>(prepared_unchanged(test::cube(), size));
      FAIL("no error");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::no_nets);
    }
  }
}

TEST_CASE("faces too narrow to be cut are noted, or refused when all are", "[prepare]") {
  const auto slab = [](double height) {
    return test::repaired(
        test::soup({{0, 0, 0},
                    {1, 0, 0},
                    {1, 1, 0},
                    {0, 1, 0},
                    {0, 0, height},
                    {1, 0, height},
                    {1, 1, height},
                    {0, 1, height}},
                   {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}));
  };
  const Prepared p = prepare::prepare(slab(1e-4), {}, {}, page, {});
  CHECK(p.model.repairs.count(mesh::RepairKind::narrow_faces) == 8);
  const mesh::Model needle =
      test::repaired(test::soup({{0, 0, 0}, {1, 0, 0}, {1, 1e-7, 0}}, {{0, 1, 2}}), false);
  CHECK_THROWS_AS(prepare::prepare(needle, {}, {}, page, {}), Error);
}

TEST_CASE("preparation can be stopped", "[prepare]") {
  StopSource stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  CHECK_THROWS_AS(
      prepare::prepare(test::repaired(test::soup_of(test::sphere(32, 16))), {}, {}, page, context), Error);
}
