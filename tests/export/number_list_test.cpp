// SPDX-License-Identifier: GPL-3.0-or-later
// No number is lost: what has no room at its edge stands in a list that tells where it belongs.
#include "export/page/number_list.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "export/export.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

/// A piece with one outline of edges as long as told; those with a minus sign have no number on paper.
export_::PieceDrawing rim(const std::vector<int>& numbers, const std::vector<double>& sizes = {}) {
  export_::PieceDrawing piece;
  piece.name = "E";
  piece.rims.emplace_back();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    export_::Seam seam;
    seam.number = static_cast<std::uint32_t>(std::abs(numbers[i]));
    seam.edge = {{0.0, 0.0}, {sizes.empty() ? 1.0 : sizes[i], 0.0}};
    seam.at = numbers[i] > 0 ? export_::NumberAt::edge : export_::NumberAt::list;
    piece.rims[0].push_back(piece.seams.size());
    piece.seams.push_back(seam);
  }
  return piece;
}

/// The number that a text is: "12", "B:12"; or nothing.
std::string number_of(const std::string& text) {
  const std::string number = test::number_in(text);
  return number.find_first_not_of("0123456789") == std::string::npos ? number : std::string();
}

/// All numbers of joins on a page: at edges and in rows of the list.
std::multiset<std::string> numbers_on(const export_::Drawing& page) {
  std::multiset<std::string> numbers;
  for (const export_::Group& group : page.groups) {
    for (const export_::Text& text : group.texts) {
      if (!number_of(text.text).empty()) {
        numbers.insert(number_of(text.text));
        continue;
      }
      std::istringstream words(group.id == "page" ? text.text : "");
      bool listed = false;
      for (std::string word; words >> word;) {
        listed = (listed || word == "come" || word == "comes" || word == "edge:") && word != "then";
        word.erase(std::remove_if(word.begin(), word.end(), [](char c) { return c == ',' || c == ';'; }),
                   word.end());
        if (listed && !number_of(word).empty()) {
          numbers.insert(word);
        }
      }
    }
  }
  return numbers;
}

/// Numbers whose two edges meet when an outline is closed like a zip: equal neighbours are taken out until
/// there are none.
std::set<std::uint32_t> zipped(const export_::PieceDrawing& piece) {
  std::set<std::uint32_t> gone;
  for (const auto& rim : piece.rims) {
    std::vector<std::uint32_t> left;
    for (const std::size_t seam : rim) {
      left.push_back(piece.seams[seam].number);
    }
    for (std::size_t i = 0; i < left.size();) {
      const std::size_t next = (i + 1) % left.size();
      if (left.size() > 1 && left[i] == left[next]) {
        gone.insert(left[i]);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
        i = 0;
      } else {
        ++i;
      }
    }
  }
  return gone;
}

}  // namespace

TEST_CASE("a row names the number before those that have no room", "[number_list]") {
  CHECK(export_::number_row(rim({12, 13, 14})).empty());
  CHECK(export_::number_row(rim({12, -13, -14, 21, -22})) ==
        "E: after 12 come 13, 14, then 21; after 21 comes 22, then 12");
  // The run goes over the end of the outline.
  CHECK(export_::number_row(rim({-5, 12, 13, -4})) == "E: after 13 come 4, 5, then 12");
  CHECK(export_::number_row(rim({-5, -6, -7}, {1.0, 3.0, 2.0})) ==
        "E: all round, from the longest edge: 6, 7, 5");
  // 12 stands there twice: the number before it tells which one is meant.
  CHECK(export_::number_row(rim({11, 12, -13, 14, 12, -15})) ==
        "E: after 12 comes 13, then 14; after 12 comes 15, then 11");
  // 12 and 14 follow each other twice: so does the number before them.
  CHECK(export_::number_row(rim({11, 12, -13, 14, 10, 12, -15, 14})) ==
        "E: after 11, 12 comes 13, then 14; after 10, 12 comes 15, then 14");
  CHECK(export_::number_row(rim({72, 11, 72, -72})) == "E: after 72 comes 72, then 72");
  export_::PieceDrawing two = rim({1, -2});
  two.rims.push_back({2});
  two.seams.push_back(two.seams[1]);
  two.seams.back().number = 9;
  CHECK(export_::number_row(two) == "E: after 1 comes 2, then 1; all round, from the longest edge: 9");
}

TEST_CASE("every number of every edge stands somewhere, or needs no place", "[number_list]") {
  const mesh::Surface ball = test::sphere(16, 10);
  for (const double scale : {4.0, 9.0, 25.0}) {
    for (const char* format : {"A4", "60x60mm"}) {
      const auto sample = test::sample_pages(ball, scale, 0.0, {}, "Ball", export_::parse_paper(format));
      export_::DrawReport report;
      const auto pages = export_::draw(sample.model, sample.nets, sample.pages, {}, &report);
      CHECK(pages.size() == sample.pages.count + report.list_pages);
      CHECK(report.labels_left_out.empty());
      std::multiset<std::string> labels;
      for (const export_::Drawing& page : pages) {
        CHECK(page.page_count == static_cast<int>(pages.size()));
        labels.merge(numbers_on(page));
      }
      std::set<std::uint32_t> closing;
      const auto contents = export_::piece_contents(sample.model.model.surface, sample.nets);
      for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
        closing.merge(zipped(export_::piece_drawing(sample.model, sample.nets, piece, contents[piece],
                                                    sample.pages.placements[piece], {})));
      }
      for (const unfold::Join& join : sample.nets.joins) {
        CAPTURE(join.number);
        CHECK((labels.count(std::to_string(join.number)) >= 2 || closing.contains(join.number)));
      }
      if (scale == 4.0) {
        CHECK(report.labels_listed.size() > 20);
      }
    }
  }
}

TEST_CASE("paper that is too small for a list has none, and that is told", "[number_list]") {
  const auto sample =
      test::sample_pages(test::sphere(16, 10), 2.0, 0.0, {}, "Ball", export_::parse_paper("45x60mm"));
  export_::DrawReport report;
  CHECK(export_::draw(sample.model, sample.nets, sample.pages, {}, &report).size() == sample.pages.count);
  CHECK(report.labels_listed.empty());
  CHECK_FALSE(report.labels_left_out.empty());
}

TEST_CASE("numbers follow each other clockwise on the printed side", "[number_list]") {
  const mesh::Surface ball = test::sphere(10, 6);
  const auto sample = test::sample_pages(ball, 40.0, 0.0, {}, "Ball");
  const auto contents = export_::piece_contents(sample.model.model.surface, sample.nets);
  for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
    const export_::PieceDrawing drawing = export_::piece_drawing(
        sample.model, sample.nets, piece, contents[piece], sample.pages.placements[piece], {});
    REQUIRE(drawing.rims.size() == 1);
    const auto& rim = drawing.rims[0];
    REQUIRE(rim.size() == drawing.seams.size());
    double area = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const export_::Segment2& here = drawing.seams[rim[i]].edge;
      const export_::Segment2& next = drawing.seams[rim[(i + 1) % rim.size()]].edge;
      CHECK(length(next.b - here.a) < 1e-9);
      area += 0.5 * cross(here.b, here.a);
    }
    CHECK(area < 0.0);  // clockwise with y up
  }
}

}  // namespace ridgecraft
