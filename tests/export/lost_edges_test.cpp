// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that simplification took, as lines on pages: where they are, how near to each other, and that nothing
// else changes.
#include "export/paint/lost_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "export/formats/write.hpp"
#include "export/page/obstacles.hpp"
#include "mesh/look/relief.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using export_::Drawing;
using export_::Layer;

namespace {

constexpr double side_mm = 60.0;
constexpr double reach_mm = 3.0;
constexpr double fold_angle = 0.05;

/// The cube that the paper is of, with boxes of these corners, in mm, as the model had them.
mesh::Relief relief_with(const std::vector<std::array<Vec3, 2>>& boxes) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  const auto add = [&](Vec3 low, Vec3 high) {
    const mesh::Surface box = cube();
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : box.points()) {
      points.push_back(
          {low.x + p.x * (high.x - low.x), low.y + p.y * (high.y - low.y), low.z + p.z * (high.z - low.z)});
    }
    for (const FaceId f : ids<FaceId>(box.face_count())) {
      std::array<VertexId, 3> face = box.vertices(f);
      for (VertexId& v : face) {
        v = VertexId(first + v.value());
      }
      faces.push_back(face);
    }
  };
  add({}, {side_mm, side_mm, side_mm});
  for (const auto& [low, high] : boxes) {
    add(low, high);
  }
  return mesh::Relief(*mesh::relief_of(mesh::Surface(points, faces)));
}

SamplePages paper_cube() {
  SamplePages sample = sample_pages(cube(), side_mm, 5.0);
  // Wherever that is centred, the relief is where its lowest corner is the origin.
  const Vec3 low = sample.model.model.surface.bounds().low;
  CHECK(length(low) < 1e-9);
  return sample;
}

std::vector<mesh::FaceLine> lines_of(const SamplePages& sample, const mesh::Relief& relief,
                                     unsigned threads = 1) {
  Context context;
  context.threads = threads;
  return export_::find_lost_edges(sample.model, relief, reach_mm, fold_angle, context);
}

double total(const std::vector<mesh::FaceLine>& lines) {
  double sum = 0.0;
  for (const mesh::FaceLine& line : lines) {
    sum += length(line.ends[1] - line.ends[0]);
  }
  return sum;
}

std::vector<Drawing> drawings_with(const SamplePages& sample, export_::Details details) {
  export_::Style style;
  style.details = details;
  return export_::draw({sample.model, sample.nets, sample.pages}, style, nullptr, {});
}

bool is_lost_edge(const export_::Line& line) {
  return line.layer == Layer::paint && line.like == Layer::paint;
}

}  // namespace

TEST_CASE("A flat box that was left out of a face is drawn on it, and nothing else is") {
  const SamplePages sample = paper_cube();
  const std::vector<mesh::FaceLine> lines =
      lines_of(sample, relief_with({{Vec3{20, 20, 60}, Vec3{40, 35, 62}}}));
  CHECK(total(lines) == Approx(70.0).margin(2.0));
  for (const mesh::FaceLine& line : lines) {
    for (const Vec3 p : line.ends) {
      CHECK(p.z == Approx(side_mm));
      const bool on_outline = std::min(std::abs(p.x - 20), std::abs(p.x - 40)) < 1e-6 ||
                              std::min(std::abs(p.y - 20), std::abs(p.y - 35)) < 1e-6;
      CHECK(on_outline);
    }
  }
}

TEST_CASE("What the paper folds, what is hidden, far away or a speck isn't drawn") {
  const SamplePages sample = paper_cube();
  CHECK(lines_of(sample, relief_with({})).empty());
  CHECK(lines_of(sample, relief_with({{Vec3{20, 20, 50}, Vec3{40, 35, 59}}})).empty());
  CHECK(lines_of(sample, relief_with({{Vec3{20, 20, 70}, Vec3{40, 35, 80}}})).empty());
  CHECK(lines_of(sample, relief_with({{Vec3{20, 20, 60}, Vec3{21, 20.8, 62}}})).empty());
}

TEST_CASE("Lines that run side by side are a millimetre apart") {
  const SamplePages sample = paper_cube();
  std::vector<std::array<Vec3, 2>> ribs;
  for (int i = 0; i < 40; ++i) {
    const double x = 10.0 + i;
    ribs.push_back({Vec3{x, 10, 60}, Vec3{x + 0.3, 50, 60.5}});
  }
  const std::vector<mesh::FaceLine> lines = lines_of(sample, relief_with(ribs));
  std::size_t ribs_drawn = 0;
  for (const mesh::FaceLine& one : lines) {
    const auto low = [](const mesh::FaceLine& line) { return std::min(line.ends[0].y, line.ends[1].y); };
    const auto high = [](const mesh::FaceLine& line) { return std::max(line.ends[0].y, line.ends[1].y); };
    const auto is_rib = [](const mesh::FaceLine& line) {
      return std::abs(line.ends[0].x - line.ends[1].x) < 1e-6;
    };
    ribs_drawn += is_rib(one) ? 1U : 0U;
    for (const mesh::FaceLine& other : lines) {
      const bool beside = is_rib(one) && is_rib(other) &&
                          std::min(high(one), high(other)) - std::max(low(one), low(other)) > 1e-6;
      if (&one != &other && beside) {
        CHECK(std::abs(one.ends[0].x - other.ends[0].x) >= 1.0 - 1e-6);
      }
    }
  }
  CHECK(ribs_drawn > 20);
}

TEST_CASE("Lost edges lie on faces, off texts, and change nothing else of a page") {
  SamplePages sample = paper_cube();
  std::vector<std::array<Vec3, 2>> boxes;
  for (int i = 0; i < 10; ++i) {
    boxes.push_back({Vec3{4.0 + 5 * i, 5, 60}, Vec3{7.0 + 5 * i, 55, 61}});
    boxes.push_back({Vec3{60, 4.0 + 5 * i, 5}, Vec3{61, 7.0 + 5 * i, 55}});
  }
  sample.model.lost_edges = lines_of(sample, relief_with(boxes));
  REQUIRE(!sample.model.lost_edges.empty());
  std::vector<Drawing> pages = drawings_with(sample, export_::Details::automatic);
  const std::vector<Drawing> without = drawings_with(sample, export_::Details::none);
  REQUIRE(pages.size() == without.size());
  double drawn = 0.0;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    for (std::size_t g = 0; g + 1 < pages[i].groups.size(); ++g) {
      export_::Group& group = pages[i].groups[g];
      for (const export_::Line& line : group.lines) {
        if (!is_lost_edge(line)) {
          continue;
        }
        const export_::Segment2 stroke{line.points[0], line.points[1]};
        drawn += length(stroke.b - stroke.a);
        for (const export_::Text& text : group.texts) {
          CHECK_FALSE(export_::meets(stroke, export_::box_of(text)));
        }
        for (const export_::Area& tab : group.areas) {
          const std::vector<std::vector<Vec2>> loops{tab.outline};
          CHECK_FALSE(inside(loops, 0.5 * (stroke.a + stroke.b)));
        }
      }
      std::erase_if(group.lines, is_lost_edge);
      CHECK(group.lines.size() == without[i].groups[g].lines.size());
      CHECK(group.texts.size() == without[i].groups[g].texts.size());
    }
  }
  CHECK(drawn > 0.8 * total(sample.model.lost_edges));
  CHECK(drawn <= total(sample.model.lost_edges) + 1e-6);
}

TEST_CASE("Lost edges are the same on any number of threads") {
  const SamplePages sample = paper_cube();
  const mesh::Relief relief = relief_with({{Vec3{20, 20, 60}, Vec3{40, 35, 62}}});
  const auto one = lines_of(sample, relief);
  const auto four = lines_of(sample, relief, 4);
  REQUIRE(one.size() == four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].face == four[i].face);
    CHECK(one[i].ends == four[i].ends);
  }
}
