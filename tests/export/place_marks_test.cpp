// SPDX-License-Identifier: GPL-3.0-or-later
// The letters and frames that tell where on a piece an enlarged picture lies.
#include "export/page/place_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/polygon.hpp"
#include "export/machine/operations.hpp"
#include "export/style/stroke_font.hpp"
#include "sample_pages.hpp"
#include "strokes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

bool is_letter(const paper::Text& text) {
  return text.layer == paper::Layer::mark && text.text.size() <= 2 &&
         std::ranges::all_of(text.text, [](char c) { return c >= 'a' && c <= 'z'; });
}

bool is_thin_mark(const paper::Line& line) {
  return line.layer == paper::Layer::mark && line.like == paper::Layer::label;
}

/// Balls with many short edges, on pages of several sizes.
std::vector<test::SamplePages> crowded_pages() {
  std::vector<test::SamplePages> samples;
  for (const double scale : {9.0, 14.0, 20.0, 26.0}) {
    for (const char* format : {"A4", "A3-landscape"}) {
      samples.push_back(
          test::sample_pages(test::sphere(16, 10), scale, 3.0, {}, "Ball", paper::parse_paper(format), 0.4));
    }
  }
  return samples;
}

/// A piece without folds.
paper::PieceDrawing square_piece(Vec2 low, double side, const std::string& name) {
  paper::PieceDrawing piece;
  piece.name = name;
  piece.group.lines.push_back({paper::Layer::cut,
                               {low, low + Vec2{side, 0.0}, low + Vec2{side, side}, low + Vec2{0.0, side}},
                               true,
                               paper::Fold::none});
  return piece;
}

constexpr Vec2 sheet{200.0, 200.0};
const Box2 printable{{10.0, 10.0}, {190.0, 190.0}};

/// Of the thin lines, but for rings.
double frame_length(const paper::PieceDrawing& piece) {
  double sum = 0.0;
  for (const paper::Line& line : piece.group.lines) {
    sum += is_thin_mark(line) && !line.closed ? length_of(line.points) : 0.0;
  }
  return sum;
}

}  // namespace

TEST_CASE("letters of pictures are small, all different, and none a digit's likeness", "[place_marks]") {
  CHECK(paper::picture_letter(0) == "a");
  CHECK(paper::picture_letter(22) == "z");
  CHECK(paper::picture_letter(23) == "aa");
  std::set<std::string> letters;
  for (std::size_t i = 0; i < 700; ++i) {
    const std::string letter = paper::picture_letter(i);
    CHECK(letter.find_first_not_of("abcdefghjkmnpqrstuvwxyz") == std::string::npos);
    CHECK(letters.insert(letter).second);
  }
}

TEST_CASE("a ring holds its letter", "[place_marks]") {
  for (const char* letter : {"a", "b", "g", "w", "mm", "qd"}) {
    CAPTURE(letter);
    const Vec2 middle{30.0, 40.0};
    const paper::PageMarks ring = paper::ringed(letter, middle);
    for (const auto& stroke : paper::text_strokes(ring.texts.at(0))) {
      for (const Vec2 p : stroke) {
        CHECK(length(p - middle) < paper::ring_radius(letter) - 0.2);
      }
    }
    for (const Vec2 p : ring.lines.at(0).points) {
      CHECK(std::abs(length(p - middle) - paper::ring_radius(letter)) < 1e-9);
    }
  }
}

TEST_CASE("a frame goes all round its place but for the ring on it", "[place_marks]") {
  std::vector<paper::PieceDrawing> pieces{square_piece({40.0, 40.0}, 100.0, "A")};
  const Box2 window{{70.0, 80.0}, {90.0, 95.0}};
  paper::mark_places(pieces, std::vector<paper::PicturePlace>{{0, 0, window, "a"}}, {}, sheet, printable);
  REQUIRE(pieces[0].group.texts.size() == 1);
  CHECK(pieces[0].group.texts[0].text == "a");
  for (const paper::Line& line : pieces[0].group.lines) {
    for (const Vec2 p : line.points) {
      const double out =
          std::max({window.low.x - p.x, p.x - window.high.x, window.low.y - p.y, p.y - window.high.y});
      CHECK((line.layer == paper::Layer::cut || line.closed || std::abs(out) < 1e-9));
    }
  }
  CHECK(frame_length(pieces[0]) == Approx(70.0 - 2.0 * paper::ring_radius("a")).margin(0.01));
}

TEST_CASE("frames stay off other pieces, pictures and the border of the page", "[place_marks]") {
  std::vector<paper::PieceDrawing> pieces{square_piece({20.0, 20.0}, 30.0, "A"),
                                          square_piece({52.0, 20.0}, 40.0, "B")};
  paper::PageMarks beside;
  beside.lines.push_back(
      {paper::Layer::mark, {{20.0, 53.0}, {40.0, 53.0}, {40.0, 80.0}, {20.0, 80.0}}, true});
  // Reaches over the border below and on the left, over the picture above, over B on the right.
  const Box2 window{{5.0, 5.0}, {60.0, 60.0}};
  paper::mark_places(pieces, std::vector<paper::PicturePlace>{{0, 0, window, "b"}}, beside, sheet, printable);
  CHECK(frame_length(pieces[0]) > 60.0);
  for (const paper::Line& line : pieces[0].group.lines) {
    if (line.layer == paper::Layer::cut) {
      continue;
    }
    for (const test::Stroke& stroke : test::strokes_of(line)) {
      for (const double t : {0.01, 0.5, 0.99}) {
        const Vec2 p = stroke.a + t * (stroke.b - stroke.a);
        CHECK(p.x >= printable.low.x);
        CHECK(p.y >= printable.low.y);
        CHECK_FALSE(inside(std::array{pieces[1].group.lines[0].points}, p));
        CHECK_FALSE(inside(std::array{beside.lines[0].points}, p));
      }
    }
  }
}

TEST_CASE("each picture of a part has its letter on its piece", "[place_marks]") {
  std::size_t pictures = 0;
  std::size_t marked = 0;
  for (const auto& sample : crowded_pages()) {
    std::map<std::string, std::string> words;  // of each letter's picture
    std::map<std::string, std::string> on;     // of each letter its piece
    for (const auto& drawing : test::drawings(sample)) {
      for (const auto& group : drawing.groups) {
        for (const auto& text : group.texts) {
          if (!is_letter(text)) {
            continue;
          }
          if (group.id != "page") {
            CHECK(on.emplace(text.text, group.id).second);
            continue;
          }
          // The first words to the right of a picture's letter.
          const auto nearest = std::ranges::min_element(group.texts, {}, [&](const paper::Text& other) {
            const Vec2 d = other.centre - text.centre;
            return other.text.size() > 2 && d.x > 0.0 && std::abs(d.y) < 2.0 ? d.x : double{INFINITY};
          });
          CHECK(words.emplace(text.text, nearest->text).second);
        }
      }
    }
    for (const auto& [letter, group] : on) {
      REQUIRE(words.contains(letter));
      const std::string name = group.substr(std::string("piece-").size());
      CHECK(words[letter].find("part of " + name) != std::string::npos);
    }
    pictures += words.size();
    marked += on.size();
  }
  CHECK(pictures > 10);
  CHECK(2 * marked > pictures);  // others have no room on such balls
}

TEST_CASE("rings and frames keep clear of texts, rings of lines too", "[place_marks]") {
  std::size_t rings = 0;
  for (const auto& sample : crowded_pages()) {
    for (const auto& drawing : test::drawings(sample)) {
      std::vector<std::vector<test::Stroke>> letters, ring_lines, other_texts, other_lines, frames;
      for (const auto& group : drawing.groups) {
        for (const auto& text : group.texts) {
          const bool marks = group.id != "page" && is_letter(text);
          (marks ? letters : other_texts).push_back(test::strokes_of(paper::text_strokes(text)));
        }
        for (const auto& line : group.lines) {
          const bool thin = group.id != "page" && is_thin_mark(line);
          (thin && line.closed ? ring_lines : thin ? frames : other_lines).push_back(test::strokes_of(line));
        }
      }
      CHECK(letters.size() == ring_lines.size());
      rings += ring_lines.size();
      for (const auto& ring : ring_lines) {
        CHECK(std::ranges::all_of(other_texts,
                                  [&](const auto& text) { return test::nearest(text, ring) > 0.2; }));
        CHECK(std::ranges::all_of(other_lines,
                                  [&](const auto& line) { return test::nearest(ring, line) > 0.2; }));
      }
      for (const auto& frame : frames) {
        CHECK(std::ranges::all_of(other_texts,
                                  [&](const auto& text) { return test::nearest(text, frame) > 0.2; }));
        CHECK(
            std::ranges::all_of(letters, [&](const auto& text) { return test::nearest(text, frame) > 0.2; }));
      }
    }
  }
  CHECK(rings > 10);
}

TEST_CASE("machines do nothing at marks of pictures, which their files don't have", "[place_marks]") {
  for (const auto& sample : crowded_pages()) {
    for (const auto& drawing : test::drawings(sample)) {
      paper::Drawing bare = drawing;
      for (auto& group : bare.groups) {
        std::erase_if(group.lines, is_thin_mark);
        std::erase_if(group.texts, is_letter);
      }
      const auto paths = paper::machine_paths(drawing);
      const auto expected = paper::machine_paths(bare);
      REQUIRE(paths.size() == expected.size());
      CHECK(std::ranges::equal(paths, expected, [](const auto& a, const auto& b) {
        return a.operation == b.operation && a.points == b.points && a.closed == b.closed;
      }));
    }
  }
}

TEST_CASE("where numbers are on the backs of sheets, so are marks of pictures", "[place_marks]") {
  paper::Style style;
  style.numbers = paper::Numbers::back;
  std::size_t letters = 0;
  for (const auto& sample : crowded_pages()) {
    for (const auto& drawing : paper::draw(sample.model, sample.nets, sample.pages, style)) {
      for (const auto& group : drawing.groups) {
        CHECK((group.id == "page" || std::ranges::none_of(group.texts, is_letter)));
        CHECK((group.id == "page" || std::ranges::none_of(group.lines, is_thin_mark)));
      }
      for (const auto& group : drawing.back) {
        letters += static_cast<std::size_t>(std::ranges::count_if(group.texts, is_letter));
      }
    }
  }
  CHECK(letters > 10);
}

}  // namespace ridgecraft
