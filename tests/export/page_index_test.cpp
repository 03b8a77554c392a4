// SPDX-License-Identifier: GPL-3.0-or-later
// The index of a page: true, in its place, and no hindrance to anything else.
#include "export/page/page_index.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "export/page/obstacles.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using export_::number_ranges;

std::vector<export_::Text> index_of(const export_::Drawing& page) {
  std::vector<export_::Text> texts;
  for (const export_::Group& group : page.groups) {
    for (const export_::Text& text : group.texts) {
      if (group.id == "page" && text.centre.y > export_::piece_box({}).low.y) {
        texts.push_back(text);
      }
    }
  }
  return texts;
}

TEST_CASE("rows of numbers are told by their ends", "[page_index]") {
  CHECK(number_ranges({}).empty());
  CHECK(number_ranges({4}) == "4");
  CHECK(number_ranges({4, 5}) == "4, 5");
  CHECK(number_ranges({4, 5, 6}) == "4-6");
  CHECK(number_ranges({1, 2, 3, 5, 7, 8, 10, 11, 12}) == "1-3, 5, 7, 8, 10-12");
}

TEST_CASE("neighbours are those of the joins, both ways", "[page_index]") {
  const mesh::Surface cube = test::cube();
  const auto sample = test::sample_pages(cube, 30.0, 0.0, test::all_edges(cube));
  const mesh::Surface& surface = sample.model.model.surface;
  const auto neighbours = export_::find_neighbours(surface, sample.nets);
  std::set<std::string> told;
  for (const PieceId piece : ids<PieceId>(neighbours.size())) {
    CHECK(neighbours[piece].size() == 4);  // a side of a cube
    for (const auto& neighbour : neighbours[piece]) {
      for (const std::uint32_t number : neighbour.numbers) {
        told.insert(std::to_string(piece.value()) + " " + std::to_string(neighbour.piece.value()) + " " +
                    std::to_string(number));
      }
    }
  }
  std::set<std::string> expected;
  for (const unfold::Join& join : sample.nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const auto name = [&](CornerId x, CornerId y) {
      return std::to_string(sample.nets.piece[mesh::face_of(x)].value()) + " " +
             std::to_string(sample.nets.piece[mesh::face_of(y)].value()) + " " + std::to_string(join.number);
    };
    expected.insert(name(c, d));
    expected.insert(name(d, c));
  }
  CHECK(told == expected);
}

/// Whether a point lies on a face of the page.
bool on_a_piece(const test::SamplePages& sample, const export_::Drawing& page, Vec2 p) {
  const auto faces = ids<FaceId>(sample.nets.piece.size());
  return std::any_of(faces.begin(), faces.end(), [&](FaceId f) {
    const export_::Placement& place = sample.pages.placements[sample.nets.piece[f]];
    const Vec2 a = place(sample.nets.flat[f][0]);
    const Vec2 b = place(sample.nets.flat[f][1]);
    const Vec2 c = place(sample.nets.flat[f][2]);
    return place.page.value() + 1 == static_cast<std::uint32_t>(page.page) && cross(b - a, p - a) > 0.0 &&
           cross(c - b, p - b) > 0.0 && cross(a - c, p - c) > 0.0;
  });
}

/// Checks that the page's lists touch nothing and no heading stands twice; how many rows they have.
std::size_t checked_rows(const test::SamplePages& sample, const export_::Drawing& page) {
  export_::Obstacles all(page.size);
  for (const export_::Group& group : page.groups) {
    for (const export_::Line& line : group.lines) {
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        all.add({line.points[i - 1], line.points[i]}, export_::Obstacles::Kind::cut);
      }
    }
    for (const export_::Text& text : group.texts) {
      if (group.id != "page") {
        all.add(text);
      }
    }
  }
  std::multiset<std::string> rows;
  for (const export_::Text& text : index_of(page)) {
    CAPTURE(text.text);
    CHECK(all.is_free(text, 1.0));
    all.add(text);
    CHECK(box_of(text).bounds().high.x <= page.size.x - 10.0 + 1e-6);
    CHECK_FALSE(on_a_piece(sample, page, text.centre));
    rows.insert(text.text);
  }
  CHECK(rows.count(std::string(export_::partner_list_heading)) <= 1);
  CHECK(rows.count(std::string(export_::number_list_heading)) <= 1);
  return rows.size();
}

TEST_CASE("the index stands beside the pieces, clear of all else", "[page_index]") {
  const mesh::Surface cube = test::cube();
  for (const double scale : {15.0, 30.0, 55.0, 70.0}) {
    CAPTURE(scale);
    const auto sample = test::sample_pages(cube, scale, 5.0, test::all_edges(cube));
    const auto pages = export_::draw(sample.model, sample.nets, sample.pages, {});
    std::size_t rows = 0;
    for (const export_::Drawing& page : pages) {
      rows += checked_rows(sample, page);
    }
    CHECK(rows > pages.size());
  }
}

TEST_CASE("numbers without room stand in a list beside the pieces, clear of all else", "[page_index]") {
  const mesh::Surface ball = test::sphere(16, 10);
  const auto cuts = test::all_edges(ball);
  const std::string heading(export_::number_list_heading.substr(0, 12));
  std::size_t lists = 0;
  for (const double scale : {9.0, 14.0}) {
    for (const char* format : {"A4", "120x160mm", "A3-landscape"}) {
      for (const auto& edges : {std::vector<EdgeId>{}, cuts}) {
        CAPTURE(scale, format, edges.size());
        const auto sample = test::sample_pages(ball, scale, 3.0, edges, "Ball", export_::parse_paper(format));
        for (const export_::Drawing& page : test::drawings(sample)) {
          checked_rows(sample, page);
          const auto index = index_of(page);
          lists += static_cast<std::size_t>(std::count_if(
              index.begin(), index.end(), [&](const auto& text) { return text.text.starts_with(heading); }));
        }
      }
    }
  }
  CHECK(lists > 3);
}

TEST_CASE("an index alone has a page of its own only where pieces lie on several pages", "[page_index]") {
  const mesh::Surface cube = test::cube();
  const auto edges = test::all_edges(cube);
  std::size_t without_index = 0;
  std::size_t with_list_page = 0;
  for (double height = 90.0; height < 260.0; height += 2.0) {
    export_::Paper paper;
    paper.size = {200.0, height};
    const auto sample = test::sample_pages(cube, 48.0, 5.0, edges, "Sample", paper);
    export_::DrawReport report;
    const auto pages = export_::draw(sample.model, sample.nets, sample.pages, {}, &report);
    if (sample.pages.count == 1 && report.labels_listed.empty()) {
      CHECK(report.list_pages == 0);
      without_index += index_of(pages.front()).empty() ? 1U : 0U;
    }
    with_list_page += sample.pages.count > 1 && report.list_pages > 0 ? 1U : 0U;
  }
  CHECK(without_index > 0);
  CHECK(with_list_page > 0);
}

TEST_CASE("a model of one piece has no index", "[page_index]") {
  const auto sample = test::sample_pages(test::cube(), 30.0, 5.0);
  REQUIRE(sample.nets.pieces.size() == 1);
  CHECK(index_of(export_::draw(sample.model, sample.nets, sample.pages, {}).front()).empty());
}

}  // namespace
}  // namespace ridgecraft
