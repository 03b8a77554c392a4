// SPDX-License-Identifier: GPL-3.0-or-later
// Separate bodies that touch: where one is glued onto the other, on paper and in the file of nets.
#include "export/page/glue_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "export/export.hpp"
#include "export/guide/words.hpp"
#include "export/sheet/bodies.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"
#include "verify/verify.hpp"

namespace ridgecraft {
namespace {

/// Boxes by two corners each; they share no points.
mesh::Surface boxes(const std::vector<std::array<Vec3, 2>>& corners) {
  const mesh::Surface cube = test::cube();
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const auto& [low, high] : corners) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : cube.points()) {
      points.push_back(
          {low.x + p.x * (high.x - low.x), low.y + p.y * (high.y - low.y), low.z + p.z * (high.z - low.z)});
    }
    for (const FaceId f : ids<FaceId>(cube.face_count())) {
      const auto [a, b, c] = cube.vertices(f);
      faces.push_back(
          {VertexId(first + a.value()), VertexId(first + b.value()), VertexId(first + c.value())});
    }
  }
  return {std::move(points), std::move(faces)};
}

double area_of(const export_::GlueOutline& glued) {
  double doubled = 0.0;
  for (const std::vector<Vec2>& outline : glued.outlines) {
    doubled += doubled_area(outline);
  }
  return 0.5 * doubled;
}

std::string fold_of(const test::SamplePages& sample, const export_::DrawReport& report) {
  const IdVector<FaceId, PartId> part(sample.model.model.surface.face_count(), PartId(0));
  return export_::write_fold(
      {sample.model, part, sample.nets, export_::assembly_order(sample.model.model.surface, sample.nets),
       &sample.pages, report.glue_outlines},
      {"another program 1", "Boxes", "0123456789abcdef", {}});
}

}  // namespace

TEST_CASE("a box on a box is glued where it stands", "[glue_outlines]") {
  const mesh::Surface surface = boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{20, 10, 20}, {40, 40, 35}}}});
  const auto sample = test::sample_pages(surface, 1.0, 5.0);
  const auto glue_outlines = export_::find_glue_outlines(sample.model.model.surface, sample.nets);
  REQUIRE(glue_outlines.size() == 1);
  CHECK(glue_outlines[0].piece == PieceId(0));
  CHECK(glue_outlines[0].other == PieceId(1));
  // A net may divide the face that it stands on.
  REQUIRE(glue_outlines[0].outlines.size() <= 2);
  CHECK(glue_outlines[0].outlines[0].size() <= 4);
  CHECK(area_of(glue_outlines[0]) == Approx(600.0).epsilon(0.001));
}

TEST_CASE("what is far off, or meets an edge at a right angle, isn't glued", "[glue_outlines]") {
  const double gap = GENERATE(0.19, 1.1, 1.3, 5.0);
  const mesh::Surface apart =
      boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{20, 10, 20 + gap}, {40, 40, 35 + gap}}}});
  const auto sample = test::sample_pages(apart, 1.0, 5.0);
  CHECK(export_::find_glue_outlines(sample.model.model.surface, sample.nets).size() ==
        (gap < export_::near_enough_mm ? 1 : 0));
  const mesh::Surface edge = boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{60, 0, 20}, {80, 50, 40}}}});
  const auto on_edge = test::sample_pages(edge, 1.0, 5.0);
  CHECK(export_::find_glue_outlines(on_edge.model.model.surface, on_edge.nets).empty());
}

TEST_CASE("a cap without a back is glued where its border stands", "[glue_outlines]") {
  // A pyramid of four faces over a box, open below; the second one stands on nothing but its tip.
  const auto with_cap = [](double rim, double tip) {
    mesh::Surface box = boxes({{{{0, 0, 0}, {60, 50, 20}}}});
    std::vector<Vec3> points(box.points().begin(), box.points().end());
    std::vector<std::array<VertexId, 3>> faces;
    for (const FaceId f : ids<FaceId>(box.face_count())) {
      faces.push_back(box.vertices(f));
    }
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3 p : {Vec3{20, 10, rim}, Vec3{40, 10, rim}, Vec3{40, 30, rim}, Vec3{20, 30, rim}}) {
      points.push_back(p);
    }
    points.push_back({30, 20, tip});
    for (std::uint32_t k = 0; k < 4; ++k) {
      const VertexId a(first + k);
      const VertexId b(first + (k + 1) % 4);
      faces.push_back(tip > rim ? std::array{a, b, VertexId(first + 4)}
                                : std::array{b, a, VertexId(first + 4)});
    }
    return mesh::Surface(std::move(points), std::move(faces));
  };
  const auto sample = test::sample_pages(with_cap(20.17, 26.0), 1.0, 0.0);
  export_::DrawReport report;
  static_cast<void>(export_::draw({sample.model, sample.nets, sample.pages}, {}, &report));
  REQUIRE(report.glue_outlines.size() == 1);
  CHECK(report.glue_outlines[0].piece == PieceId(0));
  double area = 0.0;
  for (const export_::GlueOutline& glued : report.glue_outlines) {
    area += area_of(glued);
  }
  CHECK(area == Approx(400.0).epsilon(0.001));
  // Its middle is far from its paper, but within its opening.
  const verify::Report checked = verify::verify(fold_of(sample, report), {}, {});
  CHECK(std::none_of(checked.faults.begin(), checked.faults.end(), [](const verify::Fault& fault) {
    return fault.message.find("glue spot") != std::string::npos;
  }));
  // What nothing else holds is glued at its tip.
  const auto on_tip = test::sample_pages(with_cap(30.0, 20.0), 1.0, 0.0);
  const auto at_tip = export_::find_glue_outlines(on_tip.model.model.surface, on_tip.nets);
  REQUIRE(at_tip.size() == 1);
  CHECK(area_of(at_tip[0]) < 10.0);
}

TEST_CASE("what a body holds already isn't glued to what comes near it, too", "[glue_outlines]") {
  // The second box stands on the first, and the third one on both: beside the second, 1 mm away.
  const mesh::Surface surface =
      boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{5, 10, 20}, {25, 40, 35}}}, {{{26, 10, 20}, {46, 40, 30}}}});
  const auto sample = test::sample_pages(surface, 1.0, 5.0);
  const auto outlines = export_::find_glue_outlines(sample.model.model.surface, sample.nets);
  CHECK(outlines.size() == 2);
  CHECK(std::ranges::all_of(outlines, [](const auto& one) { return one.piece == PieceId(0); }));
}

TEST_CASE("within what is glued on no line is drawn where two of its pieces meet", "[glue_outlines]") {
  // A square that two pieces of one body bring, a triangle each, and then two bodies.
  const auto sample =
      test::sample_pages(boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{20, 10, 20.1}, {40, 30, 40}}}}), 1.0, 0.0);
  unfold::Nets nets = sample.nets;
  nets.pieces.push_back(nets.pieces[PieceId(1)]);
  const auto drawn_mm = [&](PieceId other) {
    const std::vector<export_::GlueOutline> all{{PieceId(0), PieceId(1), {{{0, 0}, {10, 0}, {10, 10}}}},
                                                {PieceId(0), other, {{{0, 0}, {10, 10}, {0, 10}}}}};
    export_::PieceDrawing drawing;
    const export_::PieceContents contents;
    export_::add_glue_outlines(
        all, {sample.model, nets, PieceId(0), contents, sample.pages.placements[PieceId(0)]}, drawing);
    CHECK(drawing.spots.size() == 2);
    double sum = 0.0;
    for (const export_::Line& line : drawing.group.lines) {
      CHECK(line.layer == export_::Layer::glue);
      sum += length(line.points.back() - line.points.front());
    }
    return sum;
  };
  CHECK(drawn_mm(PieceId(2)) == Approx(40.0));
  CHECK(drawn_mm(PieceId(0)) == Approx(40.0 + std::sqrt(200.0)));
}

TEST_CASE("the guide says onto what a body is glued, once", "[glue_outlines]") {
  const mesh::Surface surface = boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{20, 10, 20}, {40, 40, 35}}}});
  const auto sample = test::sample_pages(surface, 1.0, 5.0);
  const auto glue_outlines = export_::find_glue_outlines(sample.model.model.surface, sample.nets);
  const std::vector<export_::Body> bodies = export_::find_bodies(sample.model, sample.nets, glue_outlines);
  REQUIRE(bodies.size() == 2);
  CHECK(export_::bodies_apart(bodies) == 1);
  CHECK(export_::bodies_apart(export_::find_bodies(sample.model, sample.nets, {})) == 2);
  const export_::Assembly assembly = export_::assembly_order(sample.model.model.surface, sample.nets);
  const auto times_told = [&](const std::string& sentence, const std::vector<export_::Body>& of) {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < assembly.steps.size(); ++i) {
      const std::vector<std::string> sentences =
          export_::step_sentences(sample.model, sample.nets, assembly, i, of);
      count += std::ranges::count(sentences, sentence);
    }
    return count;
  };
  const std::string below = sample.nets.pieces[glue_outlines.front().piece].name;
  const std::string above = sample.nets.pieces[glue_outlines.front().other].name;
  CHECK(times_told("Glue " + above + " onto " + below + ", within the dashed line.", bodies) == 1);
  CHECK(times_told(above + " belongs beside " + below + ": no number joins it.", bodies) == 0);
}

TEST_CASE("an opening of any size lies on a face, whatever its shape", "[glue_outlines]") {
  // An L without a bottom, larger than the box that it stands on; its middle doesn't see all of its opening.
  const std::vector<Vec2> foot{{2, 2}, {48, 2}, {48, 8}, {8, 8}, {8, 48}, {2, 48}};
  const mesh::Surface box = boxes({{{{0, 0, 0}, {50, 50, 5}}}});
  std::vector<Vec3> points(box.points().begin(), box.points().end());
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(box.face_count())) {
    faces.push_back(box.vertices(f));
  }
  const auto first = static_cast<std::uint32_t>(points.size());
  for (const double z : {5.0, 105.0}) {
    for (const Vec2 p : foot) {
      points.push_back({p.x, p.y, z});
    }
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    faces.push_back({VertexId(first + i), VertexId(first + next), VertexId(first + 6 + next)});
    faces.push_back({VertexId(first + i), VertexId(first + 6 + next), VertexId(first + 6 + i)});
  }
  const auto sample = test::sample_pages(mesh::Surface(std::move(points), std::move(faces)), 1.0, 5.0);
  const auto glue_outlines = export_::find_glue_outlines(sample.model.model.surface, sample.nets);
  double area = 0.0;
  for (const export_::GlueOutline& glued : glue_outlines) {
    CHECK(sample.model.model.surface.component(sample.nets.pieces[glued.piece].faces.front()) ==
          sample.model.model.surface.component(FaceId(0)));
    area += area_of(glued);
  }
  CHECK(area == Approx(46.0 * 6.0 + 40.0 * 6.0).epsilon(0.001));
}

TEST_CASE("a body that reaches over an edge is glued as far as the face goes", "[glue_outlines]") {
  const mesh::Surface surface = boxes({{{{0, 0, 0}, {60, 50, 20}}}, {{{50, 10, 20}, {75, 40, 35}}}});
  const auto sample = test::sample_pages(surface, 1.0, 5.0);
  const auto glue_outlines = export_::find_glue_outlines(sample.model.model.surface, sample.nets);
  REQUIRE(glue_outlines.size() == 1);
  CHECK(area_of(glue_outlines[0]) == Approx(300.0).epsilon(0.001));
}

TEST_CASE("spots are drawn, named, told, and hold in the check", "[glue_outlines]") {
  const mesh::Surface surface = boxes({{{{0, 0, 0}, {60, 50, 20}}},
                                       {{{5, 10, 20}, {25, 40, 35}}},
                                       {{{30, 10, 20}, {33, 12, 25}}},
                                       {{{60, 5, 5}, {70, 20, 15}}}});
  const auto sample = test::sample_pages(surface, 1.0, 0.0);
  export_::DrawReport report;
  const auto pages = export_::draw({sample.model, sample.nets, sample.pages}, {}, &report);
  REQUIRE(report.glue_outlines.size() == 3);
  std::set<std::string> names;
  double drawn = 0.0;
  for (const export_::Drawing& page : pages) {
    for (const export_::Group& group : page.groups) {
      for (const export_::Text& text : group.texts) {
        if (text.layer == export_::Layer::glue) {
          CHECK(names.insert(text.text).second);
        }
      }
      for (const export_::Line& line : group.lines) {
        drawn += line.layer == export_::Layer::glue ? length(line.points[1] - line.points[0]) : 0.0;
      }
    }
  }
  CHECK(names == std::set<std::string>{"B", "C", "D"});
  CHECK(drawn == Approx(100.0 + 10.0 + 50.0).epsilon(0.01));

  // These nets have no fold order and other things that files of the program have.
  const auto glue_faults = [&](const export_::DrawReport& told) {
    const verify::Report checked = verify::verify(fold_of(sample, told), {}, {});
    return std::count_if(checked.faults.begin(), checked.faults.end(), [](const verify::Fault& fault) {
      return fault.message.find("glue spot") != std::string::npos;
    });
  };
  CHECK(glue_faults(report) == 0);
  export_::DrawReport moved = report;
  for (Vec2& p : moved.glue_outlines[0].outlines[0]) {
    p += Vec2{0.5, 0.0};
  }
  CHECK(glue_faults(moved) == 1);
  moved = report;
  std::swap(moved.glue_outlines[0].piece, moved.glue_outlines[0].other);
  CHECK(glue_faults(moved) == 1);
}

}  // namespace ridgecraft
