// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers without room stand in pictures of parts of their piece, where these have room.
#include "export/page/enlarged.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "export/page/obstacles.hpp"
#include "export/page/page_index.hpp"
#include "export/page/text_placement.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

constexpr Vec2 most{180.0, 240.0};

/// The pieces of the first page with their texts.
std::vector<paper::PieceDrawing> pieces_of(const test::SamplePages& sample) {
  std::vector<paper::PieceDrawing> pieces;
  const auto contents = paper::piece_contents(sample.model.model.surface, sample.nets);
  for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
    if (sample.pages.placements[piece].page == PageId(0)) {
      pieces.push_back(paper::piece_drawing(sample.model, sample.nets, piece, contents[piece],
                                            sample.pages.placements[piece], {}));
    }
  }
  paper::DrawReport report;
  paper::place_texts(pieces, sample.pages.paper.size, paper::piece_box(sample.pages.paper), {}, report, {});
  return pieces;
}

std::size_t listed(const paper::PieceDrawing& piece) {
  return static_cast<std::size_t>(std::ranges::count(piece.seams, paper::NumberAt::list, &paper::Seam::told));
}

bool has_number(const paper::Enlarged& picture, std::uint32_t number) {
  return std::ranges::any_of(picture.marks.texts, [&](const paper::Text& text) {
    return test::number_in(text.text) == std::to_string(number);
  });
}

}  // namespace

TEST_CASE("numbers that have no room stand in enlarged parts of their piece", "[enlarged]") {
  std::size_t lost = 0;
  std::size_t without = 0;
  for (const double scale : {6.0, 9.0, 14.0}) {
    const auto sample = test::sample_pages(test::sphere(16, 10), scale, 2.0, {}, "Ball");
    for (paper::PieceDrawing& piece : pieces_of(sample)) {
      const paper::PieceDrawing before = piece;
      const std::vector<paper::Enlarged> pictures = paper::enlarged_parts(piece, {}, most, {});
      for (std::size_t i = 0; i < piece.seams.size(); ++i) {
        const paper::NumberAt told = piece.seams[i].told;
        const bool was_lost = before.seams[i].told == paper::NumberAt::list;
        lost += was_lost ? 1U : 0U;
        without += told == paper::NumberAt::list ? 1U : 0U;
        CHECK((told == paper::NumberAt::enlarged || told == paper::NumberAt::list) == was_lost);
        if (told == paper::NumberAt::enlarged) {
          CHECK(std::ranges::any_of(pictures, [&](const paper::Enlarged& picture) {
            return has_number(picture, piece.seams[i].number);
          }));
        }
      }
    }
  }
  CHECK(lost > 50);
  CHECK(10 * without <= lost);
}

TEST_CASE("an enlarged part lies in its frame, with texts clear of lines", "[enlarged]") {
  const auto sample = test::sample_pages(test::sphere(16, 10), 9.0, 2.0, {}, "Ball");
  std::size_t texts = 0;
  for (paper::PieceDrawing& piece : pieces_of(sample)) {
    for (const paper::Enlarged& picture : paper::enlarged_parts(piece, {}, most, {})) {
      CHECK(picture.words.starts_with((picture.whole ? "" : "part of ") + piece.name + ", "));
      const paper::Enlarged plain = paper::with_words(picture);
      paper::Enlarged lettered = picture;
      lettered.shown.letter = "mm";
      lettered = paper::with_words(lettered);
      for (const paper::Enlarged& all : {plain, lettered}) {
        CHECK(all.size.x <= most.x);
        CHECK(all.size.y <= most.y);
        for (const paper::Text& text : all.marks.texts) {
          const Box2 box = paper::box_of(text).bounds();
          CHECK(box.low.y >= 0.0);
          CHECK(box.high.y <= all.size.y + 1e-9);
          // Words stand above the frame.
          CHECK((box.low.y > picture.size.y || box.high.y < picture.size.y));
        }
      }
      paper::Obstacles lines(picture.size);
      for (const paper::Line& line : picture.marks.lines) {
        CHECK(line.layer == paper::Layer::mark);  // nothing that anybody cuts or folds
        for (const Vec2 p : line.points) {
          CHECK(p.x >= -1e-9);
          CHECK(p.y >= -1e-9);
          CHECK(p.x <= picture.size.x + 1e-9);
          CHECK(p.y <= picture.size.y + 1e-9);
        }
        for (std::size_t i = 1; i < line.points.size() && line.like != paper::Layer::label; ++i) {
          lines.add({line.points[i - 1], line.points[i]}, paper::Obstacles::Kind::cut);
        }
      }
      for (const paper::Text& text : picture.marks.texts) {
        CAPTURE(text.text);
        CHECK(text.layer == paper::Layer::mark);
        CHECK(text.height >= 1.6 - 1e-9);
        CHECK(lines.is_free(text, 0.3));
        ++texts;
      }
      for (const paper::Enlarged& smaller : picture.smaller) {
        CHECK(smaller.size.x <= picture.size.x);
        CHECK(smaller.size.y <= picture.size.y);
      }
    }
  }
  CHECK(texts > 20);
}

TEST_CASE("a piece whose numbers all have room is drawn once", "[enlarged]") {
  const auto sample = test::sample_pages(test::cube(), 40.0, 5.0);
  for (paper::PieceDrawing& piece : pieces_of(sample)) {
    CHECK(listed(piece) == 0);
    CHECK(paper::enlarged_parts(piece, {}, most, {}).empty());
  }
}

TEST_CASE("no heading stands twice on a page", "[enlarged]") {
  const mesh::Surface ball = test::sphere(12, 8);
  const auto cuts = test::all_edges(ball);
  std::size_t headings = 0;
  for (const double scale : {12.0, 20.0, 30.0}) {
    for (const char* format : {"A4", "120x160mm", "A3-landscape"}) {
      const auto sample = test::sample_pages(ball, scale, 3.0, cuts, "Ball", paper::parse_paper(format));
      for (const paper::Drawing& page : test::drawings(sample)) {
        std::multiset<std::string> texts;
        for (const paper::Group& group : page.groups) {
          for (const paper::Text& text : group.texts) {
            if (group.id == "page") {
              texts.insert(text.text);
            }
          }
        }
        const auto count = texts.count(std::string(paper::partner_list_heading));
        CHECK(count <= 1);
        headings += count;
      }
    }
  }
  CHECK(headings > 0);
}

}  // namespace ridgecraft
