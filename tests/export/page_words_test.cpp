// SPDX-License-Identifier: GPL-3.0-or-later
// What a maker reads on a page: numbers apart from each other, lines that lead to them, names with their
// upper side, the legend, and which body a piece belongs to.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "export/page/furniture.hpp"
#include "export/page/texts.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using export_::Layer;

std::vector<export_::Drawing> drawn(const test::SamplePages& sample, export_::DrawReport* report = nullptr) {
  return export_::draw({sample.model, sample.nets, sample.pages}, {}, report);
}

/// Crowded on purpose: short edges, many numbers of two and three digits.
test::SamplePages crowded(double scale, double turn) {
  const mesh::Surface ball = test::sphere(18, 12);
  return test::sample_pages(ball, scale, 3.0, {}, "Ball", {}, turn);
}

/// Extent of the text's strokes along a direction.
std::pair<double, double> extent(const export_::Text& text, Vec2 along) {
  std::pair<double, double> range{INFINITY, -INFINITY};
  for (const auto& stroke : export_::text_strokes(text)) {
    for (const Vec2 p : stroke) {
      range.first = std::min(range.first, dot(p, along));
      range.second = std::max(range.second, dot(p, along));
    }
  }
  return range;
}

TEST_CASE("numbers in one line stand farther apart than their digits") {
  std::size_t pairs = 0;
  for (const double scale : {28.0, 40.0}) {
    for (const double turn : {0.0, 0.9}) {
      for (const auto& page : drawn(crowded(scale, turn))) {
        std::vector<export_::Text> texts;
        for (const auto& group : page.groups) {
          std::ranges::copy_if(group.texts, std::back_inserter(texts),
                               [](const auto& text) { return text.layer == Layer::label; });
        }
        for (const auto& a : texts) {
          for (const auto& b : texts) {
            const Vec2 along{std::cos(a.angle), std::sin(a.angle)};
            const Vec2 from_a = b.centre - a.centre;
            const bool in_line = std::abs(std::sin(a.angle - b.angle)) < 0.3 &&
                                 std::abs(cross(along, from_a)) < 0.5 * std::min(a.height, b.height) &&
                                 dot(along, from_a) > 0.0;
            if (in_line && dot(along, from_a) < 12.0) {
              ++pairs;
              // Digits of one number are 0.21 of its height apart.
              CHECK(extent(b, along).first - extent(a, along).second > 0.36 * std::min(a.height, b.height));
            }
          }
        }
      }
    }
  }
  CHECK(pairs > 10);
}

TEST_CASE("lines to numbers leave their edge steeply and run along no line") {
  std::size_t leaders = 0;
  for (const double scale : {20.0, 28.0, 40.0}) {
    for (const auto& page : drawn(crowded(scale, 0.3))) {
      for (const auto& group : page.groups) {
        for (const auto& leader : group.lines) {
          if (group.id == "page" || leader.layer != Layer::label) {
            continue;
          }
          ++leaders;
          CHECK(export_::style_of(leader).color.red > 0x60);
          REQUIRE(leader.points.size() == 2);
          const Vec2 d = leader.points[1] - leader.points[0];
          for (const auto& line : group.lines) {
            const std::size_t count = line.points.size() - (line.closed ? 0 : 1);
            for (std::size_t i = 0; line.layer != Layer::label && i < count; ++i) {
              const Vec2 a = line.points[i];
              const Vec2 side = line.points[(i + 1) % line.points.size()] - a;
              const double size = length(side);
              const double along = dot(leader.points[0] - a, side) / size;
              const bool starts_here = along > -0.01 && along < size + 0.01 &&
                                       std::abs(cross(side, leader.points[0] - a)) < 0.05 * size;
              const bool shares_corner = along < 0.1 || along > size - 0.1;
              if (starts_here && !shares_corner) {
                CHECK(std::abs(cross(side, d)) > 0.6 * size * length(d));
              }
            }
          }
        }
      }
    }
  }
  CHECK(leaders > 3);
}

TEST_CASE("each name has a line under it and stands level where it has room") {
  for (const double turn : {0.0, 0.7, 1.5}) {
    for (const auto& page : drawn(test::sample_pages(test::cube(), 40.0, 5.0, {}, "Cube", {}, turn))) {
      for (const auto& group : page.groups) {
        for (const auto& text : group.texts) {
          if (text.layer == Layer::piece_name) {
            CHECK(text.underlined);
            CHECK(text.angle == 0.0);
          }
        }
      }
    }
  }
}

bool same_look(const export_::Line& a, const export_::Line& b) {
  const auto x = export_::style_of(a);
  const auto y = export_::style_of(b);
  return std::ranges::equal(x.dashes, y.dashes) && x.color.red == y.color.red;
}

TEST_CASE("the legend shows each kind of line of its page, and no other") {
  std::vector<test::SamplePages> samples;
  samples.push_back(crowded(28.0, 0.3));
  samples.push_back(test::sample_pages(test::cube(), 40.0, 5.0));
  samples.push_back(test::sample_pages(test::cube(), 40.0, 0.0));
  samples.push_back(test::sample_pages(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 2), 22.0,
                                       4.0, {}, "Corner"));
  for (const auto& sample : samples) {
    for (const auto& page : drawn(sample)) {
      const auto& legend = page.groups.back();
      REQUIRE(legend.id == "page");
      std::size_t kinds = 0;
      for (std::size_t g = 0; g + 1 < page.groups.size(); ++g) {
        for (const auto& line : page.groups[g].lines) {
          if (line.layer == Layer::mark) {
            continue;  // a tick tells enough
          }
          INFO(sample.model.model.name << " " << export_::id(line.layer));
          CHECK(std::ranges::any_of(legend.lines, [&](const auto& item) { return same_look(item, line); }));
        }
        kinds += page.groups[g].areas.empty() ? 0U : 1U;
      }
      CHECK(std::ranges::any_of(legend.texts, [](const auto& t) { return t.text.ends_with("tab"); }) ==
            (kinds > 0));
      const auto drawn_fold = [&](Layer layer) {
        return std::ranges::any_of(page.groups, [&](const auto& group) {
          return std::ranges::any_of(group.lines, [&](const auto& line) { return line.layer == layer; });
        });
      };
      if (!drawn_fold(Layer::valley) && !drawn_fold(Layer::tab_fold)) {
        CHECK_FALSE(std::ranges::any_of(
            legend.texts, [](const auto& t) { return t.text.find("valley") != std::string::npos; }));
      }
    }
  }
}

TEST_CASE("ticks tell where edges meet that look like one, and where one chain goes on as another") {
  // Every panel of the corner is divided in four: its sides have a vertex in the middle, and no tabs hide it.
  const mesh::Surface corner = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 2);
  const auto sample = test::sample_pages(corner, 22.0, 0.0, {}, "Corner");
  std::size_t ticks = 0;
  for (const auto& page : drawn(sample)) {
    for (std::size_t g = 0; g + 1 < page.groups.size(); ++g) {
      const auto& lines = page.groups[g].lines;
      for (const auto& tick : lines) {
        if (tick.layer != Layer::mark) {
          continue;
        }
        ++ticks;
        const double size = length(tick.points[1] - tick.points[0]);
        const bool within = size == Approx(1.1);
        CHECK((within || size == Approx(2.0)));
        // It begins on the outline, and no fold ends there that would tell the same.
        bool on_cut = false;
        for (const auto& line : lines) {
          for (std::size_t i = 0; i < line.points.size(); ++i) {
            const Vec2 a = line.points[i];
            const Vec2 b = line.points[(i + 1) % line.points.size()];
            const double off =
                std::abs(length(tick.points[0] - a) + length(tick.points[0] - b) - length(b - a));
            on_cut = on_cut || (line.layer == Layer::cut && off < 1e-6);
            const bool fold = line.layer == Layer::mountain || line.layer == Layer::valley;
            CHECK_FALSE((within && fold && length(a - tick.points[0]) < 0.01));
          }
        }
        CHECK(on_cut);
      }
    }
  }
  CHECK(ticks > 0);
  // A cube's edges end at its corners.
  for (const auto& page : drawn(test::sample_pages(test::cube(), 40.0, 0.0))) {
    for (const auto& line : page.groups.front().lines) {
      CHECK(line.layer != Layer::mark);
    }
  }
}

TEST_CASE("furniture lies on the sheet without a margin, pens and tails of letters included") {
  for (const char* name : {"a4", "a6", "letter", "a5-landscape"}) {
    for (const double margin : {0.0, 0.4, 1.0}) {
      export_::Paper sheet = export_::parse_paper(name);
      sheet.margin = margin;
      const export_::Group group =
          export_::furniture(sheet, {{}, "gypsy jaguar", 3, 10, {}, {}}, {true, true, true, true, true, true},
                             {true, true, true, true, true, true});
      Box2 box;
      for (const auto& text : group.texts) {
        for (const auto& stroke : export_::text_strokes(text)) {
          for (const Vec2 p : stroke) {
            box.add(p);
          }
        }
      }
      for (const auto& line : group.lines) {
        for (const Vec2 p : line.points) {
          box.add(p);
        }
      }
      INFO(name << " " << margin);
      CHECK(box.low.x > 0.3);
      CHECK(box.low.y > 0.3);
      CHECK(box.high.x < sheet.size.x - 0.3);
      CHECK(box.high.y < sheet.margin + export_::furniture_height);
    }
  }
}

/// Two cubes apart, and a triangle that floats near the second: nothing joins it.
mesh::Surface three_bodies() {
  const mesh::Surface cubes = test::voxels({{0, 0, 0}, {4, 0, 0}});
  std::vector<Vec3> points(cubes.points().begin(), cubes.points().end());
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(cubes.face_count())) {
    faces.push_back(cubes.vertices(f));
  }
  const auto first = static_cast<std::uint32_t>(points.size());
  for (const Vec3 p : {Vec3{4.2, 0.2, 1.3}, Vec3{4.8, 0.2, 1.3}, Vec3{4.5, 0.8, 1.3}}) {
    points.push_back(p);
  }
  faces.push_back({VertexId(first), VertexId(first + 1), VertexId(first + 2)});
  return {std::move(points), std::move(faces)};
}

TEST_CASE("a piece that nothing joins tells its body and its place") {
  const auto sample = test::sample_pages(three_bodies(), 25.0, 4.0);
  REQUIRE(sample.model.model.surface.component_count() == 3);
  export_::DrawReport report;
  const auto pages = drawn(sample, &report);
  REQUIRE(report.bodies.size() == 3);
  const auto& nets = sample.nets;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const auto own = sample.model.model.surface.component(nets.pieces[p].faces.front());
    const auto body = std::ranges::find_if(report.bodies, [&](const export_::Body& b) {
      return std::ranges::find(b.pieces, p) != b.pieces.end();
    });
    REQUIRE(body != report.bodies.end());
    for (const PieceId other : body->pieces) {
      CHECK(sample.model.model.surface.component(nets.pieces[other].faces.front()) == own);
    }
    const std::string words = "body " + std::to_string(body - report.bodies.begin() + 1) + " of 3";
    const auto has = [&](const std::string& wanted) {
      return std::ranges::any_of(pages, [&](const auto& page) {
        return std::ranges::any_of(page.groups, [&](const auto& group) {
          return group.id == "piece-" + nets.pieces[p].name &&
                 std::ranges::any_of(group.texts, [&](const auto& text) { return text.text == wanted; });
        });
      });
    };
    CHECK(has(words));
    if (nets.pieces[p].faces.size() == 1) {
      // The second cube is 0.3 below it, the first one 3.2 beside it.
      const auto near = sample.model.model.surface.component(nets.pieces[body->beside].faces.front());
      CHECK(sample.model.model.surface
                .points()[sample.model.model.surface.vertices(nets.pieces[body->beside].faces.front())[0]
                              .value()]
                .x > 0.0);
      CHECK(near != own);
      CHECK(body->distance_mm == Approx(0.3 * 25.0));
      CHECK(has("at " + nets.pieces[body->beside].name));
    }
  }
}

}  // namespace
}  // namespace ridgecraft

TEST_CASE("notes lie on their piece, or beside it within the page's area") {
  using namespace ridgecraft;
  // Strips at the left of the sheet, which are lower than a name with its note, or hardly higher.
  for (const double height : {5.0, 7.0, 9.0, 12.0}) {
    for (const bool has_seam : {false, true}) {
      CAPTURE(height, has_seam);
      const Box2 area{{10.0, 10.0}, {200.0, 287.0}};
      const Vec2 low{10.0, 100.0};
      const Vec2 high{low.x + 60.0, low.y + height};
      const std::vector<Vec2> outline{low, {high.x, low.y}, high, {low.x, high.y}};
      export_::PieceDrawing piece;
      piece.name = "I";
      piece.notes = {"I and L are mirror images"};
      piece.faces = {{outline[0], outline[1], outline[2]}, {outline[0], outline[2], outline[3]}};
      piece.group.lines.push_back({export_::Layer::cut, outline, true});
      if (has_seam) {
        export_::Seam& seam = piece.seams.emplace_back();
        seam.edge = {outline[0], outline[1]};
      }
      export_::Obstacles obstacles({210.0, 297.0});
      for (std::size_t i = 0; i < outline.size(); ++i) {
        obstacles.add({outline[i], outline[(i + 1) % outline.size()]}, export_::Obstacles::Kind::cut);
      }
      static_cast<void>(export_::place_name(piece, obstacles, area));
      const bool is_beside = std::any_of(piece.group.lines.begin() + 1, piece.group.lines.end(),
                                         [](const export_::Line&) { return true; });
      for (const export_::Text& text : piece.group.texts) {
        CAPTURE(text.text);
        const Box2 box = export_::box_of(text).bounds();
        const Box2 room = is_beside ? area : Box2{low, high};
        CHECK(box.low.x >= room.low.x);
        CHECK(box.low.y >= room.low.y);
        CHECK(box.high.x <= room.high.x);
        CHECK(box.high.y <= room.high.y);
      }
    }
  }
}
