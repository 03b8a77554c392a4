// SPDX-License-Identifier: GPL-3.0-or-later
// Layout by its promises: inside the page, the gap between pieces, as few pages as a plain packer at most.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "base/random.hpp"
#include "export/export.hpp"
#include "export/sheet/pages.hpp"
#include "layout_promises.hpp"
#include "plain_pieces.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using test::blob;
using test::check_promises;
using test::shelf_pages;

TEST_CASE("random blobs keep the gap, stay inside and beat shelves", "[layout]") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    test::PlainPieces pieces;
    const std::uint32_t count = 5 + random.below(50);
    for (std::uint32_t i = 0; i < count; ++i) {
      pieces.add_fan(blob(random, 8.0 + 50.0 * random.unit() * random.unit()), i / 4);
    }
    const auto pages = export_::layout(pieces.nets(), {}, {});
    check_promises(pieces.nets(), pages);
    CHECK(pages.count <= shelf_pages(pieces.nets(), {}));
  }
}

TEST_CASE("pieces with tabs and needles keep the gap on any paper", "[layout]") {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Random random(100 + seed);
    test::PlainPieces pieces;
    export_::Paper paper = export_::parse_paper(seed % 3 == 0 ? "a5-landscape" : seed % 3 == 1 ? "a4" : "a6");
    paper.gap = seed % 4 == 0 ? 0.0 : 5.0 * random.unit();
    paper.margin = 12.0 * random.unit();
    const std::uint32_t count = 2 + random.below(seed % 5 == 0 ? 60 : 14);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (random.below(6) == 0) {  // a needle: long, and narrower than a cell of any grid
        const double angle = 6.0 * random.unit();
        const Vec2 along{std::cos(angle), std::sin(angle)};
        pieces.add_fan({{0, 0}, 60.0 * along, 59.0 * along + 0.3 * random.unit() * perpendicular(along)},
                       i / 3);
      } else {
        pieces.add_fan(blob(random, 5.0 + 35.0 * random.unit()), i / 3);
        pieces.add_tab();
      }
    }
    INFO("seed " << seed << ", gap " << paper.gap << ", margin " << paper.margin);
    check_promises(pieces.nets(), export_::layout(pieces.nets(), paper, {}));
  }
}

TEST_CASE("of pages that can't be saved one stays as empty as it may", "[layout]") {
  // Four fill a page; the fifth comes last, whatever groups they are of.
  test::PlainPieces pieces;
  for (std::uint32_t i = 0; i < 5; ++i) {
    pieces.add_boxes({{0, 0, 92, 130}}, i / 3);
  }
  const auto pages = export_::layout(pieces.nets(), {}, {});
  check_promises(pieces.nets(), pages);
  REQUIRE(pages.count == 2);
  CHECK(std::ranges::count_if(pages.placements, [](const auto& p) { return p.page.value() == 1; }) == 1);
}

TEST_CASE("several pages are filled by half and more", "[layout]") {
  // Stars with hollows, 2 mm apart: Blender's add-on fills 23 % with nets, shelves of boxes about 40 %.
  double filled = 0.0;
  double whole = 0.0;
  std::size_t shelves = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    test::PlainPieces pieces;
    for (std::uint32_t i = 0; i < 60; ++i) {
      pieces.add_fan(blob(random, 10.0 + 50.0 * random.unit()), i / 4);
    }
    const auto pages = export_::layout(pieces.nets(), {}, {});
    check_promises(pieces.nets(), pages);
    const Vec2 area = export_::piece_area({});
    filled += test::area_of(pieces.nets());
    whole += static_cast<double>(pages.count) * area.x * area.y;
    count += pages.count;
    shelves += shelf_pages(pieces.nets(), {});
  }
  CAPTURE(filled / whole, count, shelves);
  CHECK(filled / whole > 0.5);
  CHECK(count < shelves);
}

TEST_CASE("combs interlock on one page", "[layout]") {
  // Two combs whose teeth fill each other's gaps: each needs two thirds of the page in height.
  test::PlainPieces pieces;
  for (int i = 0; i < 2; ++i) {
    std::vector<std::array<double, 4>> boxes{{0, 0, 180, 30}};
    for (int tooth = 0; tooth < 4; ++tooth) {
      boxes.push_back({50.0 * tooth, 30, 50.0 * tooth + 15, 190});
    }
    pieces.add_boxes(boxes);
  }
  CHECK(shelf_pages(pieces.nets(), {}) == 2);
  const auto pages = export_::layout(pieces.nets(), {}, {});
  check_promises(pieces.nets(), pages);
  CHECK(pages.count == 1);
}

TEST_CASE("small pieces lie in the hole of a large one", "[layout]") {
  test::PlainPieces pieces;
  pieces.add_boxes({{0, 0, 190, 40}, {0, 225, 190, 265}, {0, 40, 40, 225}, {150, 40, 190, 225}});
  for (int i = 0; i < 4; ++i) {
    pieces.add_boxes({{0, 0, 50, 85}});
  }
  const auto pages = export_::layout(pieces.nets(), {}, {});
  check_promises(pieces.nets(), pages);
  CHECK(pages.count == 1);
}

TEST_CASE("a strip that fits only from corner to corner is found", "[layout]") {
  const Vec2 area = export_::piece_area({});
  const double diagonal = length(area);
  for (const double width : {1.0, 8.0}) {
    // As long as it may be: the ends just touch both sides.
    double strip = diagonal;
    const auto fits = [&](double size) {
      for (int step = 0; step < 200000; ++step) {
        const double angle = step * std::numbers::pi / 400000.0;
        if (size * std::cos(angle) + width * std::sin(angle) <= area.x &&
            size * std::sin(angle) + width * std::cos(angle) <= area.y) {
          return true;
        }
      }
      return false;
    };
    while (!fits(strip)) {
      strip -= 0.05;
    }
    for (const double turned : {0.0, 1.0, 2.5}) {
      test::PlainPieces pieces;
      const Vec2 along{std::cos(turned), std::sin(turned)};
      const Vec2 across = width * perpendicular(along);
      pieces.add_fan({{0, 0}, strip * along, strip * along + across, across});
      CHECK(strip > area.y);
      const auto pages = export_::layout(pieces.nets(), {}, {});
      check_promises(pieces.nets(), pages);
    }
  }
}

TEST_CASE("a piece that fits no page is named with its size and the page's", "[layout]") {
  test::PlainPieces pieces;
  pieces.add_boxes({{0, 0, 100, 100}});
  pieces.add_boxes({{0, 0, 191, 265}});
  try {
    static_cast<void>(export_::layout(pieces.nets(), {}, {}));
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::no_nets);
    CHECK(std::string(error.what()) ==
          "piece P1 of 191.0 x 265.0 mm doesn't fit the 190.0 x 265.0 mm that paper of 210.0 x 297.0 mm "
          "leaves for "
          "pieces");
  }
  test::PlainPieces exact;
  exact.add_boxes({{0, 0, 265, 190}});
  CHECK(export_::layout(exact.nets(), {}, {}).count == 1);
}

TEST_CASE("500 pieces, the same twice", "[layout]") {
  Random random(11);
  test::PlainPieces pieces;
  for (std::uint32_t i = 0; i < 500; ++i) {
    pieces.add_fan(blob(random, 5.0 + 20.0 * random.unit()), i / 10);
  }
  const auto pages = export_::layout(pieces.nets(), {}, {});
  check_promises(pieces.nets(), pages);
  CHECK(pages.count <= shelf_pages(pieces.nets(), {}));
  const auto again = export_::layout(pieces.nets(), {}, {});
  bool same = pages.count == again.count;
  for (const PieceId p : ids<PieceId>(pages.placements.size())) {
    const auto& a = pages.placements[p];
    const auto& b = again.placements[p];
    same = same && a.page == b.page && a.cosine == b.cosine && a.sine == b.sine && a.shift == b.shift;
  }
  CHECK(same);
}

TEST_CASE("no page is left with one lonely triangle, and pages follow the parts", "[layout]") {
  test::PlainPieces pieces;
  for (std::uint32_t i = 0; i < 8; ++i) {
    pieces.add_boxes({{0, 0, 92, 130}}, 7 - i);
  }
  pieces.add_fan({{0, 0}, {12, 0}, {0, 12}}, 3);
  const auto pages = export_::layout(pieces.nets(), {}, {});
  check_promises(pieces.nets(), pages);
  REQUIRE(pages.count == 3);
  std::vector<double> paper_on(3);
  std::vector<std::uint32_t> first(3, 99);
  for (const PieceId p : ids<PieceId>(pages.placements.size())) {
    const std::uint32_t page = pages.placements[p].page.value();
    paper_on[page] += p.value() < 8 ? 92.0 * 130.0 : 72.0;
    first[page] = std::min(first[page], pieces.nets().pieces[p].parts.front().value());
  }
  CHECK(*std::min_element(paper_on.begin(), paper_on.end()) > 0.1 * 190.0 * 265.0);
  // The page that is much emptier than the others comes last, whatever is on it.
  CHECK(paper_on[2] < 0.6 * std::min(paper_on[0], paper_on[1]));
  CHECK(first[0] < first[1]);
}

TEST_CASE("pieces of a part share a page where that costs none", "[layout]") {
  test::PlainPieces pieces;
  for (std::uint32_t i = 0; i < 24; ++i) {
    pieces.add_boxes({{0, 0, 60, 60}}, i % 2);
  }
  const auto pages = export_::layout(pieces.nets(), {}, {});
  check_promises(pieces.nets(), pages);
  REQUIRE(pages.count == 2);
  for (const PieceId p : ids<PieceId>(pages.placements.size())) {
    CHECK(pages.placements[p].page.value() == p.value() % 2);
  }
}

TEST_CASE("other papers, margins and gaps", "[layout]") {
  Random random(21);
  test::PlainPieces pieces;
  for (std::uint32_t i = 0; i < 20; ++i) {
    pieces.add_fan(blob(random, 10.0 + 20.0 * random.unit()), i);
  }
  for (const char* name : {"a6", "a0", "letter-landscape", "mat-12x12", "2000x100mm"}) {
    for (const double gap : {0.0, 0.3, 7.0}) {
      INFO(name << " " << gap);
      export_::Paper paper = export_::parse_paper(name);
      paper.gap = gap;
      paper.margin = 3.0;
      const auto pages = export_::layout(pieces.nets(), paper, {});
      check_promises(pieces.nets(), pages);
      CHECK(pages.count <= shelf_pages(pieces.nets(), paper));
    }
  }
}

TEST_CASE("folds run along the paper's grain wherever a piece fits so", "[layout]") {
  // Blobs with a direction of their own each, and a strip that is longer than a sheet is wide.
  test::PlainPieces pieces;
  IdVector<PieceId, Vec2> lines;
  Random random(3);
  for (std::uint32_t i = 0; i < 14; ++i) {
    pieces.add_fan(blob(random, 12.0 + 20.0 * random.unit()), i / 4);
    const double angle = 2.0 * std::numbers::pi * random.unit();
    lines.push_back({std::cos(angle), std::sin(angle)});
  }
  pieces.add_boxes({{0, 0, 250, 20}}, 5);
  lines.push_back({0.0, 1.0});
  for (const auto& [grain, size] : {std::pair{export_::Grain::long_side, Vec2{210, 297}},
                                    {export_::Grain::short_side, Vec2{210, 297}},
                                    {export_::Grain::long_side, Vec2{297, 210}}}) {
    CAPTURE(static_cast<int>(grain), size.x);
    export_::Paper sheet;
    sheet.size = size;
    sheet.grain = grain;
    const auto pages = export_::layout(pieces.nets(), sheet, {}, {{}, lines});
    check_promises(pieces.nets(), pages);
    const bool upright = (size.y > size.x) == (grain == export_::Grain::long_side);
    for (const PieceId piece : ids<PieceId>(14)) {
      const Vec2 placed = pages.placements[piece](lines[piece]) - pages.placements[piece]({});
      CHECK(std::abs(upright ? placed.x : placed.y) <= std::sin(15.1 * std::numbers::pi / 180.0));
    }
    // The strip's folds lie across it: it fits these sheets only along their long side, or nearly.
    const PieceId strip(14);
    const Vec2 placed = pages.placements[strip](lines[strip]) - pages.placements[strip]({});
    CHECK(std::abs(size.y > size.x ? placed.x : placed.y) > 0.7);
    CHECK(export_::pieces_off_grain(lines, pages) ==
          (grain == export_::Grain::long_side ? std::vector<PieceId>{strip} : std::vector<PieceId>{}));
    // Not heeded, the same as without directions.
    sheet.grain = export_::Grain::any;
    const auto with = export_::layout(pieces.nets(), sheet, {}, {{}, lines});
    CHECK(export_::pieces_off_grain(lines, with).empty());
    const auto without = export_::layout(pieces.nets(), sheet, {});
    for (const PieceId piece : ids<PieceId>(15)) {
      CHECK(with.placements[piece]({1, 2}) == without.placements[piece]({1, 2}));
    }
  }
}

TEST_CASE("the direction of folds is that in which most of them run, by length and angle") {
  // A tube: its folds run along its axis, those within its flat sides count for nothing.
  const test::SamplePages sample = test::sample_pages(test::revolve({{20, 0}, {20, 200}}, 18), 1.0, 0.0);
  const mesh::Surface& surface = sample.model.model.surface;
  const auto directions = export_::fold_directions(surface, sample.nets);
  REQUIRE(directions.size() == sample.nets.pieces.size());
  std::size_t along_axis = 0;
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    const CornerId side = surface.sides(edge)[0];
    const FaceId face = mesh::face_of(side);
    if (sample.nets.use[edge] == unfold::EdgeUse::fold && surface.length(edge) > 199.0 &&
        std::abs(surface.fold_angle(edge)) > 0.1) {
      const Vec2 a = sample.nets.flat[face][side.value() % 3];
      const Vec2 b = sample.nets.flat[face][mesh::next(side).value() % 3];
      const Vec2 direction = directions[sample.nets.piece[face]];
      CHECK(length(direction) == Approx(1.0));
      CHECK(std::abs(cross(direction, (b - a) / length(b - a))) < 1e-6);
      ++along_axis;
    }
  }
  CHECK(along_axis > 3);
}

TEST_CASE("no pieces, no pages", "[layout]") {
  CHECK(export_::layout({}, {}, {}).count == 0);
}

TEST_CASE("layout stops when it is asked to", "[layout]") {
  test::PlainPieces pieces;
  pieces.add_boxes({{0, 0, 10, 10}});
  StopSource stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  CHECK_THROWS_AS(export_::layout(pieces.nets(), {}, context), Error);
}
