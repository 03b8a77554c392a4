// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of one material or object each.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "export/sheet/pages.hpp"
#include "job/job.hpp"
#include "mesh/mesh.hpp"

using namespace ridgecraft;

namespace {

/// A house with a red roof, a step in its front wall of the roof's colour within the plane of that wall, and
/// a box apart.
mesh::Model house() {
  const std::string text =
      "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2\nv 4 0 2\nv 4 3 2\nv 0 3 2\nv 0 1.5 4\nv 4 1.5 4\n"
      "v 2 0 0\nv 2 0 2\n"
      "v 6 0 0\nv 7 0 0\nv 7 1 0\nv 6 1 0\nv 6 0 1\nv 7 0 1\nv 7 1 1\nv 6 1 1\n"
      "o walls\nusemtl stone\nf 4 3 2 11 1\nf 1 11 12 5\nf 2 3 7 10 6\nf 3 4 8 7\nf 4 1 5 9 8\n"
      "usemtl tiles\nf 11 2 6 12\no roof\nf 5 12 6 10 9\nf 7 8 9 10\n"
      "o box\nf 13 16 15 14\nf 17 18 19 20\nf 13 14 18 17\nf 14 15 19 18\nf 15 16 20 19\nf 16 13 17 20\n";
  return mesh::read(mesh::ModelFile{text, "house.obj", "house", {}}, {}, {});
}

job::Result made(job::PageBy by) {
  job::Options options;
  options.page_by = by;
  return job::run(house(), options, {});
}

}  // namespace

TEST_CASE("pages of one material hold nothing else, and say so", "[job]") {
  const job::Result paper = made(job::PageBy::material);
  const mesh::Model& model = paper.prepared.model;
  REQUIRE(paper.pages.names.size() == paper.pages.count);
  CHECK(std::set<std::string>(paper.pages.names.begin(), paper.pages.names.end()) ==
        std::set<std::string>{"stone", "tiles"});
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const PageId page = paper.pages.placements[paper.nets.piece[f]].page;
    CHECK(model.materials[model.material[f]].name == paper.pages.names[page.value()]);
  }
  REQUIRE(paper.drawings.size() >= paper.pages.count);
  for (std::size_t i = 0; i < paper.pages.count; ++i) {
    CHECK(paper.drawings[i].title == "house: " + paper.pages.names[i]);
  }
  // The front wall is of two materials within one plane: it comes apart there.
  double front = 0.0;
  std::set<PieceId> pieces;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    if (model.surface.normal(f).y < -0.99 && model.object_name(f) == "walls") {
      front += model.surface.area(f);
      pieces.insert(paper.nets.piece[f]);
    }
  }
  CHECK(front > 0.0);
  CHECK(pieces.size() == 2);
}

TEST_CASE("pages along the paper's grain pass the check of their files, which tell of it", "[job]") {
  job::Options options;
  export_::Paper sheet;
  sheet.grain = export_::Grain::long_side;
  options.paper = sheet;
  options.size.largest_extent_mm = 80.0;  // so that each piece fits either way
  const job::Result paper = job::run(house(), options, {});
  CHECK(paper.fold.find("\"grain\": \"long\"") != std::string::npos);
  const auto lines = export_::fold_directions(paper.prepared.model.surface, paper.nets);
  for (const PieceId piece : ids<PieceId>(lines.size())) {
    const export_::Placement& place = paper.pages.placements[piece];
    CHECK(std::abs((place(lines[piece]) - place({})).x) < 0.26);  // sine of 15 degrees
  }
}

TEST_CASE("pages of one object", "[job]") {
  const job::Result paper = made(job::PageBy::object);
  CHECK(std::set<std::string>(paper.pages.names.begin(), paper.pages.names.end()) ==
        std::set<std::string>{"walls", "roof", "box"});
  for (const FaceId f : ids<FaceId>(paper.prepared.model.surface.face_count())) {
    const PageId page = paper.pages.placements[paper.nets.piece[f]].page;
    CHECK(paper.prepared.model.object_name(f) == paper.pages.names[page.value()]);
  }
}

TEST_CASE("without a constraint pages hold anything", "[job]") {
  const job::Result paper = made(job::PageBy::any);
  CHECK(paper.pages.names.empty());
  std::map<PageId, std::set<std::string>> objects;
  for (const FaceId f : ids<FaceId>(paper.prepared.model.surface.face_count())) {
    objects[paper.pages.placements[paper.nets.piece[f]].page].insert(paper.prepared.model.object_name(f));
  }
  CHECK(std::any_of(objects.begin(), objects.end(), [](const auto& page) { return page.second.size() > 1; }));
  CHECK(paper.drawings[0].title == "house");
}
