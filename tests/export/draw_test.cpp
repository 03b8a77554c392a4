// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn on a page, by measures of its own: outlines, folds, texts clear of lines and of each other,
// furniture.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "export/page/furniture.hpp"
#include "export/page/lines.hpp"
#include "export/page/numbers.hpp"
#include "export/style/stroke_font.hpp"
#include "sample_pages.hpp"
#include "strokes.hpp"
#include "support/shapes.hpp"
#include "unfold/net/chains.hpp"

namespace ridgecraft {
namespace {

using export_::Layer;

using test::nearest;
using test::Stroke;
using test::strokes_of;

std::vector<test::SamplePages> samples(double turn) {
  std::vector<test::SamplePages> all;
  all.push_back(test::sample_pages(test::cube(), 40.0, 5.0, {}, "Cube", {}, turn));
  const mesh::Surface ball = test::sphere(14, 8);
  all.push_back(test::sample_pages(ball, 60.0, 4.0, test::all_edges(ball), "Ball", {}, turn));
  all.push_back(test::sample_pages(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 2), 22.0, 4.0,
                                   {}, "Corner", export_::parse_paper("A3"), turn));
  return all;
}

TEST_CASE("past the deadline and its grace, pages have the numbers that find room at once") {
  const auto sample =
      test::sample_pages(test::sphere(24, 14), 60.0, 4.0, test::all_edges(test::sphere(24, 14)), "Ball");
  const auto numbers_listed = [&](double grace_s) {
    Context context;
    context.deadline = Deadline::in(-1.0);
    context.grace_s = grace_s;
    export_::DrawReport report;
    const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {}, &report, context);
    CHECK(pages.size() == sample.pages.count + report.list_pages);
    return report.labels_listed.size();
  };
  export_::DrawReport unlimited;
  static_cast<void>(export_::draw({sample.model, sample.nets, sample.pages}, {}, &unlimited));
  CHECK(numbers_listed(3600.0) == unlimited.labels_listed.size());
  CHECK(numbers_listed(0.0) > unlimited.labels_listed.size());
  CHECK(numbers_listed(0.0) < sample.nets.joins.size());
}

TEST_CASE("texts keep clear of lines and of each other") {
  for (const double turn : {0.0, 0.7, 2.5}) {
    for (const auto& sample : samples(turn)) {
      export_::DrawReport report;
      for (const auto& page : export_::draw({sample.model, sample.nets, sample.pages}, {}, &report)) {
        std::vector<std::vector<Stroke>> texts;
        std::vector<std::vector<Stroke>> lines;
        for (const auto& group : page.groups) {
          for (const auto& text : group.texts) {
            if (group.id != "page") {
              texts.push_back(strokes_of(export_::text_strokes(text)));
            }
          }
          for (const auto& line : group.lines) {
            if (group.id != "page" && line.layer != Layer::label) {
              lines.push_back(strokes_of(line));
            }
          }
        }
        for (std::size_t i = 0; i < texts.size(); ++i) {
          const Box2 box = test::bounds(texts[i]);
          for (std::size_t j = i + 1; j < texts.size(); ++j) {
            if (!test::far_apart(box, test::bounds(texts[j]))) {
              CHECK(nearest(texts[i], texts[j]) > 0.25);
            }
          }
          for (const auto& line : lines) {
            std::vector<Stroke> close;
            std::ranges::copy_if(line, std::back_inserter(close),
                                 [&](const Stroke& s) { return !test::far_apart(box, test::bounds({s})); });
            if (!close.empty()) {
              CHECK(nearest(texts[i], close) > 0.2);
            }
          }
        }
      }
      CHECK(report.labels_listed.empty());
      CHECK(report.names_left_out == 0);
    }
  }
}

bool in_face(const test::SamplePages& sample, PieceId piece, Vec2 p) {
  for (const FaceId f : sample.nets.pieces[piece].faces) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = sample.pages.placements[piece](sample.nets.flat[f][k]);
      const Vec2 b = sample.pages.placements[piece](sample.nets.flat[f][(k + 1) % 3]);
      inside = inside && cross(b - a, p - a) > -1e-9;
    }
    if (inside) {
      return true;
    }
  }
  return false;
}

/// Whether a number of a chain stands near one of these sides and along it: inside the piece or, where there
/// is one, on a tab.
bool has_number(const test::SamplePages& sample, const std::vector<export_::Drawing>& pages,
                const std::vector<CornerId>& sides, std::uint32_t number) {
  bool found = false;
  const PieceId piece = sample.nets.piece[mesh::face_of(sides.front())];
  const auto& place = sample.pages.placements[piece];
  for (const CornerId c : sides) {
    const Vec2 a = place(sample.nets.flat[mesh::face_of(c)][c.value() % 3]);
    const Vec2 b = place(sample.nets.flat[mesh::face_of(c)][mesh::next(c).value() % 3]);
    const Vec2 along = (b - a) / length(b - a);
    for (const auto& group : pages[place.page.value()].groups) {
      for (const auto& text : group.texts) {
        if (text.layer == Layer::label && group.id == "piece-" + sample.nets.pieces[piece].name &&
            test::number_in(text.text) == std::to_string(number)) {
          const double off = cross(along, text.centre - a);
          const double at = dot(along, text.centre - a);
          const bool inside = in_face(sample, piece, text.centre) && off > 0.0 && off < 6.0;
          const bool on_tab = std::ranges::any_of(sample.nets.tabs, [&](const unfold::Tab& tab) {
            return tab.side == c && off < 0.0 && off > -5.0;
          });
          found = found || ((inside || on_tab) && at > -1.0 && at < length(b - a) + 1.0);
          CHECK(text.height >= 1.6);
          CHECK(std::cos(text.angle) > -2e-3);  // never upside down
        }
      }
    }
  }
  return found;
}

TEST_CASE("each chain has its number on both sides between any two sharp corners") {
  for (const auto& sample : samples(0.4)) {
    const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {});
    const mesh::Surface& surface = sample.model.model.surface;
    const auto direction = [&](CornerId c) {
      const auto& flat = sample.nets.flat[mesh::face_of(c)];
      const Vec2 way = flat[mesh::next(c).value() % 3] - flat[c.value() % 3];
      return way / length(way);
    };
    const auto size_of = [&](const std::vector<CornerId>& row) {
      double size = 0.0;
      for (const CornerId side : row) {
        size += surface.length(surface.edge(side));
      }
      return size;
    };
    for (const unfold::Chain& chain : unfold::chains_of(surface, sample.nets)) {
      std::vector<CornerId> beyond;
      for (const CornerId side : chain.sides) {
        beyond.insert(beyond.begin(), surface.twin(side));
      }
      for (const std::vector<CornerId>& sides : {chain.sides, beyond}) {
        std::vector<CornerId> row;
        for (std::size_t i = 0; i < sides.size(); ++i) {
          row.push_back(sides[i]);
          if (i + 1 == sides.size() || dot(direction(sides[i]), direction(sides[i + 1])) < 0.5) {
            INFO(sample.model.model.name << " chain " << chain.number);
            CHECK((size_of(row) < 10.0 || has_number(sample, pages, row, chain.number)));
            row.clear();
          }
        }
      }
    }
  }
}

TEST_CASE(
    "a triangulated cube has five folds, an L one valley chain, and closed outlines count pieces and holes") {
  const auto count = [](const std::vector<export_::Drawing>& pages, Layer layer, bool closed) {
    std::size_t lines = 0;
    for (const auto& page : pages) {
      for (const auto& group : page.groups) {
        lines += static_cast<std::size_t>(std::ranges::count_if(group.lines, [&](const export_::Line& line) {
          return line.layer == layer && line.closed == closed;
        }));
      }
    }
    return lines;
  };
  const auto cube = test::sample_pages(test::cube(), 40.0, 0.0);
  const auto pages = export_::draw({cube.model, cube.nets, cube.pages}, {});
  // The net of the triangulated cube may be cut through squares: then a square's halves hang on folds of
  // their own.
  std::size_t folds = 0;
  for (const EdgeId e : ids<EdgeId>(cube.nets.use.size())) {
    folds +=
        cube.nets.use[e] == unfold::EdgeUse::fold && std::abs(cube.model.model.surface.fold_angle(e)) > 0.1
            ? 1U
            : 0U;
  }
  CHECK(count(pages, Layer::mountain, false) <= folds);
  CHECK(count(pages, Layer::mountain, false) >= 5);
  CHECK(count(pages, Layer::valley, false) == 0);
  CHECK(count(pages, Layer::cut, true) == cube.nets.pieces.size());
  CHECK(count(pages, Layer::cut, false) == 0);
}

TEST_CASE("an angle of 0 hides exactly flat folds only, a large one hides all") {
  const auto count = [](const test::SamplePages& sample, double angle) {
    export_::Style style;
    style.hidden_fold_angle = angle;
    std::size_t lines = 0;
    for (const auto& page : export_::draw({sample.model, sample.nets, sample.pages}, style)) {
      for (const auto& group : page.groups) {
        lines += static_cast<std::size_t>(std::ranges::count_if(group.lines, [](const export_::Line& line) {
          return line.layer == Layer::mountain || line.layer == Layer::valley;
        }));
      }
    }
    return lines;
  };
  auto cube = test::sample_pages(test::cube(), 40.0, 0.0);
  const std::size_t folds = count(cube, 0.05);
  for (const FaceId f : ids<FaceId>(cube.model.panels.panel.size())) {
    cube.model.panels.panel[f] = PanelId(f.value());  // each triangle a panel: the angle alone decides
  }
  CHECK(count(cube, 0.0) == folds);
  CHECK(count(cube, 2.0) == 0);
}

double drawn_length(const std::vector<export_::Drawing>& pages, std::initializer_list<Layer> layers) {
  double sum = 0.0;
  for (const auto& page : pages) {
    for (const auto& group : page.groups) {
      for (const auto& line : group.lines) {
        if (std::ranges::find(layers, line.layer) != layers.end()) {
          for (const Stroke& s : strokes_of(line)) {
            sum += length(s.b - s.a);
          }
        }
      }
    }
  }
  return sum;
}

TEST_CASE("drawn lengths are those of the nets") {
  for (const auto& sample : samples(0.2)) {
    const mesh::Surface& surface = sample.model.model.surface;
    const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {});
    double folds = 0.0;
    double cuts = 0.0;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      if (sample.nets.use[e] == unfold::EdgeUse::fold) {
        folds += std::abs(surface.fold_angle(e)) > 0.06 ? surface.length(e) : 0.0;
      } else {
        cuts += (surface.is_border(e) ? 1.0 : 2.0) * surface.length(e);
      }
    }
    for (const auto& tab : sample.nets.tabs) {
      cuts -= length(tab.polygon[1] - tab.polygon[0]);
      for (std::size_t i = 1; i < tab.polygon.size(); ++i) {
        cuts += length(tab.polygon[(i + 1) % tab.polygon.size()] - tab.polygon[i]);
      }
    }
    // The corner's faces lie on each other (nothing searched for a net without overlap), and so do some of
    // its lines.
    CHECK(drawn_length(pages, {Layer::mountain, Layer::valley}) <= folds + 1e-6);
    if (sample.model.model.name != "Corner") {
      CHECK(drawn_length(pages, {Layer::mountain, Layer::valley}) == Approx(folds).epsilon(1e-6));
    }
    // Slits are drawn once; these nets have none but where squares of one side were cut apart.
    CHECK(drawn_length(pages, {Layer::cut}) <= cuts + 1e-6);
    CHECK(drawn_length(pages, {Layer::cut}) > 0.8 * cuts);
  }
}

TEST_CASE("furniture stays in its band on every paper") {
  for (const std::string& name : export_::paper_names()) {
    for (const std::string suffix : {"", "-landscape"}) {
      const export_::Paper sheet = export_::parse_paper(name + suffix);
      for (const std::string title : {"Fox", "A name that is longer than the page is wide, whatever the page",
                                      "狐狐狐狐狐狐狐狐狐狐"}) {
        const export_::Group group =
            export_::furniture(sheet, {{}, title, 12, 345, {}, {}}, {true, true, true, true, true, true},
                               {true, true, true, true, true, true});
        Box2 box;
        bool bar = false;
        const double bar_mm = sheet.size.x < 80.0 ? 20.0 : 50.0;
        for (const auto& line : group.lines) {
          for (const Vec2 p : line.points) {
            box.add(p);
          }
          bar = bar ||
                (line.points.size() == 2 && std::abs(line.points[1].x - line.points[0].x - bar_mm) < 1e-9);
        }
        std::vector<Box2> texts;
        for (const auto& text : group.texts) {
          const double half = 0.5 * export_::text_width(text.text, text.height);
          Box2 own;
          own.add(text.centre - Vec2{half, 0.5 * text.height});
          own.add(text.centre + Vec2{half, 0.5 * text.height});
          box.add(own.low);
          box.add(own.high);
          for (const Box2& other : texts) {
            const bool apart = own.low.x > other.high.x || other.low.x > own.high.x ||
                               own.low.y > other.high.y || other.low.y > own.high.y;
            CHECK(apart);
          }
          texts.push_back(own);
        }
        INFO(name << suffix << " " << title);
        CHECK(bar);
        CHECK(box.low.x >= sheet.margin - 1e-9);
        CHECK(box.high.x <= sheet.size.x - sheet.margin + 1e-9);
        CHECK(box.low.y >= sheet.margin - 1e-9);
        CHECK(box.high.y <= sheet.margin + export_::furniture_height - 1.0);
        CHECK(texts.size() >= 6);
      }
    }
  }
}

TEST_CASE("numbers that are others upside down are marked") {
  for (const std::string marked : {"6", "9", "66", "68", "86", "89", "98", "99", "16", "91", "806"}) {
    CHECK(export_::ambiguous_upside_down(marked));
  }
  for (const std::string plain : {"0", "1", "8", "11", "69", "96", "60", "26", "3", "88", "101", "10", ""}) {
    CHECK_FALSE(export_::ambiguous_upside_down(plain));
  }
}

TEST_CASE("the alphabet covers what is written on a page") {
  for (const std::string text :
       {"0123456789", "ABCDEFGHIJKLMNOPQRSTUVWXYZ", "abcdefghijklmnopqrstuvwxyz",
        "print at 100 %, not fitted to the page", "Füchsin ßÄÖÜñéçøÅ", "page 1 / 2 …", ""}) {
    CHECK(export_::stroke_font_covers(text));
  }
  CHECK_FALSE(export_::stroke_font_covers("狐"));
  CHECK_FALSE(export_::stroke_font_covers("\xff"));
  // Letters of one text don't run into each other, and the box is as said.
  for (char c = '!'; c <= '~'; ++c) {
    for (const char d : std::string("1Wgj.")) {
      const export_::Text pair{Layer::label, {c, d}, {0.0, 0.0}, 10.0, 0.0, false};
      const double half = 0.5 * export_::text_width(pair.text, 10.0);
      for (const auto& stroke : export_::text_strokes(pair)) {
        REQUIRE(stroke.size() >= 2);
        for (const Vec2 p : stroke) {
          CHECK(std::abs(p.x) <= half + 1e-9);
          CHECK(std::abs(p.y) <= 9.0);
        }
      }
    }
  }
}

}  // namespace

// Corners that are too near to each other to be meant.

TEST_CASE("crumbs go where the line stays, corners that count don't", "[crumbs]") {
  using export_::without_crumbs;
  const std::vector<Vec2> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  CHECK(without_crumbs(square, true) == square);
  CHECK(without_crumbs({{0, 0}, {10, 0}, {10, 0.012}, {10, 10}, {0, 10}}, true).size() == 4);
  CHECK(without_crumbs({{0, 0}, {5, 0.001}, {5.02, 0.0}, {10, 0}, {10, 10}, {0, 10}}, true).size() == 5);
  // A notch 0.04 mm wide and 1 mm deep.
  const std::vector<Vec2> notch{{0, 0}, {5, 0}, {5, 1}, {5.04, 1}, {5.04, 0}, {10, 0}, {10, 10}, {0, 10}};
  CHECK(without_crumbs(notch, true).size() >= 7);
  // Many small bends in one sense: a curve stays one.
  std::vector<Vec2> circle;
  for (int i = 0; i < 400; ++i) {
    circle.push_back({2.0 * std::cos(i * 0.0157079633), 2.0 * std::sin(i * 0.0157079633)});
  }
  const std::vector<Vec2> fewer = without_crumbs(circle, true);
  CHECK(fewer.size() < 200);
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    CHECK(length(0.5 * (fewer[i] + fewer[(i + 1) % fewer.size()])) > 2.0 - 0.0105);
  }
  CHECK(without_crumbs({{0, 0}, {0.01, 0}, {0.02, 0}}, false) == std::vector<Vec2>{{0, 0}, {0.02, 0}});
}

}  // namespace ridgecraft
