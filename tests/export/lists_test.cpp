// SPDX-License-Identifier: GPL-3.0-or-later
// No number is lost: what has no room at its edge stands in a list; and what the lists of a page say.
#include "export/page/lists.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/elementary.hpp"
#include "export/export.hpp"
#include "export/page/numbers.hpp"
#include "export/page/obstacles.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

// No number is lost: what has no room at its edge stands in a list that tells where it belongs.

/// A piece with these numbers; those with a minus sign have no place on it.
export_::PieceDrawing piece_with(const std::vector<int>& numbers) {
  export_::PieceDrawing piece;
  piece.name = "E";
  for (const int number : numbers) {
    export_::Seam seam;
    seam.number = static_cast<std::uint32_t>(std::abs(number));
    seam.at = number > 0 ? export_::NumberAt::edge : export_::NumberAt::list;
    piece.sides.push_back({piece.seams.size()});
    piece.seams.push_back(seam);
  }
  return piece;
}

/// The number that a text is: "12", "B:12"; or nothing.
std::string number_of(const std::string& text) {
  const std::string number = test::number_in(text);
  return number.find_first_not_of("0123456789") == std::string::npos ? number : std::string();
}

/// Numbers of joins at edges and on tabs of a page.
std::multiset<std::string> numbers_on(const export_::Drawing& page) {
  std::multiset<std::string> numbers;
  for (const export_::Group& group : page.groups) {
    for (const export_::Text& text : group.texts) {
      if (group.id != "page" && !number_of(text.text).empty()) {
        numbers.insert(number_of(text.text));
      }
    }
  }
  return numbers;
}

/// Numbers that the lists of a page call unmarked, each with its piece: "A 13".
std::set<std::string> unmarked_on(const export_::Drawing& page) {
  std::string all;
  for (const export_::Group& group : page.groups) {
    for (const export_::Text& text : group.texts) {
      all += group.id == "page" ? text.text + " " : "";
    }
  }
  std::set<std::string> unmarked;
  std::istringstream words(all);
  std::string piece;
  std::set<std::string> numbers;
  for (std::string word; words >> word;) {
    if (word == "unmarked" || word == "unmarked;") {
      unmarked.merge(numbers);
    } else if (word.back() == ':') {
      piece = word.substr(0, word.size() - 1);
      numbers.clear();
    } else if (word.find_first_not_of("0123456789-,") == std::string::npos) {
      const std::size_t dash = word.find('-');
      const int first = std::stoi(word);
      for (int i = first; i <= (dash == std::string::npos ? first : std::stoi(word.substr(dash + 1))); ++i) {
        numbers.insert(piece + " " + std::to_string(i));
      }
    }
  }
  return unmarked;
}

/// Numbers whose two edges meet when an outline is closed like a zip: equal neighbours are taken out until
/// there are none.
std::set<std::uint32_t> zipped(const export_::PieceDrawing& piece) {
  std::map<JoinId, std::uint32_t> numbers;
  for (const export_::Seam& seam : piece.seams) {
    numbers[seam.join] = seam.number;
  }
  std::set<std::uint32_t> gone;
  for (const auto& rim : piece.rims) {
    std::vector<JoinId> left;
    for (const std::size_t seam : rim) {
      left.push_back(piece.seams[seam].join);
    }
    for (std::size_t i = 0; i < left.size();) {
      const std::size_t next = (i + 1) % left.size();
      if (left.size() > 1 && left[i] == left[next]) {
        gone.insert(numbers.at(left[i]));
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

TEST_CASE("a row names the numbers that stand nowhere on the piece", "[number_list]") {
  const auto words = [](const std::vector<int>& numbers) {
    return export_::unmarked_row(piece_with(numbers)).words;
  };
  CHECK(words({12, 13, 14}).empty());
  CHECK(export_::unmarked_row(piece_with({-2})).of == "E");
  CHECK(words({12, -14, -13, 21, -22}) == std::vector<std::string>{"13, 14, 22 unmarked"});
  CHECK(words({-7, 8, -7}) == std::vector<std::string>{"7 unmarked"});
  export_::PieceDrawing piece = piece_with({-5, -6, -7});
  piece.spots = {{"B", {}, false}, {"C", {}, true}, {"D", {}, false}};
  CHECK(export_::unmarked_row(piece).words ==
        std::vector<std::string>{"5-7 unmarked", "within short dashes B, D"});
}

TEST_CASE("every number of every edge stands somewhere, or needs no place", "[number_list]") {
  const mesh::Surface ball = test::sphere(16, 10);
  for (const double scale : {4.0, 9.0, 25.0}) {
    for (const char* format : {"A4", "60x60mm"}) {
      const auto sample = test::sample_pages(ball, scale, 0.0, {}, "Ball", export_::parse_paper(format));
      export_::DrawReport report;
      const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {}, &report);
      CHECK(pages.size() == sample.pages.count + report.list_pages);
      CHECK(report.labels_left_out.empty());
      std::multiset<std::string> labels;
      std::set<std::string> unmarked;
      for (const export_::Drawing& page : pages) {
        CHECK(page.page_count == static_cast<int>(pages.size()));
        labels.merge(numbers_on(page));
        unmarked.merge(unmarked_on(page));
      }
      for (const auto& [piece, number] : report.labels_listed) {
        CAPTURE(piece, number);
        CHECK(unmarked.contains(piece + " " + std::to_string(number)));
        labels.insert(std::to_string(number));
      }
      std::set<std::uint32_t> closing;
      const auto contents = export_::piece_contents(sample.model.model.surface, sample.nets);
      for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
        closing.merge(zipped(export_::piece_drawing(
            {sample.model, sample.nets, piece, contents[piece], sample.pages.placements[piece]}, {})));
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
  CHECK(export_::draw({sample.model, sample.nets, sample.pages}, {}, &report).size() == sample.pages.count);
  CHECK(report.labels_listed.empty());
  CHECK_FALSE(report.labels_left_out.empty());
}

TEST_CASE("numbers follow each other clockwise on the printed side", "[number_list]") {
  const mesh::Surface ball = test::sphere(10, 6);
  const auto sample = test::sample_pages(ball, 40.0, 0.0, {}, "Ball");
  const auto contents = export_::piece_contents(sample.model.model.surface, sample.nets);
  for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
    const export_::PieceDrawing drawing = export_::piece_drawing(
        {sample.model, sample.nets, piece, contents[piece], sample.pages.placements[piece]}, {});
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
    std::size_t edges = 0;
    for (const std::vector<std::size_t>& side : drawing.sides) {
      edges += side.size();
      for (std::size_t i = 1; i < side.size(); ++i) {
        CHECK(length(drawing.seams[side[i - 1]].edge.b - drawing.seams[side[i]].edge.a) < 1e-9);
        CHECK(drawing.seams[side[i - 1]].number == drawing.seams[side[i]].number);
      }
    }
    CHECK(edges == drawing.seams.size());
  }
}

namespace {

// The index of a page: true, in its place, and no hindrance to anything else.

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
  return rows.size();
}

TEST_CASE("the index stands beside the pieces, clear of all else", "[page_index]") {
  const mesh::Surface cube = test::cube();
  for (const double scale : {15.0, 30.0, 55.0, 70.0}) {
    CAPTURE(scale);
    const auto sample = test::sample_pages(cube, scale, 5.0, test::all_edges(cube));
    const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {});
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
  std::size_t lists = 0;
  for (const double scale : {9.0, 14.0}) {
    for (const char* format : {"A4", "120x160mm", "A3-landscape"}) {
      for (const auto& edges : {std::vector<EdgeId>{}, cuts}) {
        CAPTURE(scale, format, edges.size());
        const auto sample = test::sample_pages(ball, scale, 3.0, edges, "Ball", export_::parse_paper(format));
        for (const export_::Drawing& page : test::drawings(sample)) {
          checked_rows(sample, page);
          lists += unmarked_on(page).empty() ? 0U : 1U;
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
    const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {}, &report);
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
  CHECK(index_of(export_::draw({sample.model, sample.nets, sample.pages}, {}).front()).empty());
}

// Numbers are left out only where the paper itself says what is glued to what.

using export_::NumberAt;

/// A piece whose outline has these numbers, clockwise; those with a minus sign have no place. No seam is
/// where the number is 0: a border.
export_::PieceDrawing outline(const std::vector<int>& numbers) {
  export_::PieceDrawing piece;
  piece.rims.emplace_back();
  const auto corner = [&](std::size_t i) {
    const double turn =
        -6.283185307179586 * static_cast<double>(i % numbers.size()) / static_cast<double>(numbers.size());
    return Vec2{elementary::cos(turn), elementary::sin(turn)};
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != 0) {
      export_::Seam seam;
      seam.number = static_cast<std::uint32_t>(std::abs(numbers[i]));
      seam.join = JoinId(seam.number);
      seam.edge = {corner(i + 1), corner(i)};  // its face on the left
      seam.at = numbers[i] > 0 ? NumberAt::edge : NumberAt::list;
      piece.rims[0].push_back(piece.seams.size());
      piece.seams.push_back(seam);
    }
  }
  return piece;
}

/// Places in the outline, borders left out, whose numbers needed none.
std::vector<std::size_t> left_out(const std::vector<int>& numbers) {
  export_::PieceDrawing piece = outline(numbers);
  export_::leave_out_closing(piece);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < piece.seams.size(); ++i) {
    if (piece.seams[i].at == NumberAt::closing) {
      places.push_back(i);
    }
  }
  return places;
}

using Places = std::vector<std::size_t>;

}  // namespace

TEST_CASE("an edge beside the one with its number needs none", "[closing_edges]") {
  CHECK(left_out({1, 2, -2, 3}) == Places{2});
  CHECK(left_out({1, -2, 2, 3}) == Places{1});
  CHECK(left_out({-2, 1, 3, 2}) == Places{0});  // over the end of the outline
  CHECK(left_out({1, 2, 3, 4}).empty());
}

TEST_CASE("what closes like a zip needs no number from its end on", "[closing_edges]") {
  CHECK(left_out({1, 2, 3, 3, -2, 4}) == Places{4});
  CHECK(left_out({1, 2, 3, 3, 5, 5, -2, 4}) == Places{6});
  // 3 is glued elsewhere, so the two edges of 2 don't meet by themselves.
  CHECK(left_out({1, 2, 3, -2, 4, 3}).empty());
  CHECK(left_out({1, 2, 3, 4, 3, 4, -2, 5}).empty());
}

TEST_CASE("a border parts edges", "[closing_edges]") {
  CHECK(left_out({1, 2, 0, -2, 3}).empty());
  CHECK(left_out({1, 2, 3, 0, 3, -2, 4}).empty());
}

}  // namespace ridgecraft
