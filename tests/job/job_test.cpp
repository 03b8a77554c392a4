// SPDX-License-Identifier: GPL-3.0-or-later
// A whole job as a function of values, and jobs that are entered in the middle.
#include "job/job.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;

namespace {

mesh::Model sample(const std::string& name, bool keep_points = false) {
  return mesh::read(std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/" + name, {.keep_points = keep_points},
                    {});
}

/// The nets without what was asked for them: two ways to one result differ in nothing else.
std::string bytes_of(const job::Result& made) {
  std::string text = made.fold;
  for (const export_::Drawing& page : made.drawings) {
    text += export_::write_svg(page, {});
  }
  return text;
}

}  // namespace

TEST_CASE("a job keeps every value on its way, and they agree", "[job]") {
  const job::Result made = job::run(sample("house.obj"), {}, {});
  CHECK(made.part.size() == made.prepared.model.surface.face_count());
  CHECK(made.part_count > 0);
  CHECK(made.nets.piece.size() == made.part.size());
  CHECK(made.pages.placements.size() == made.nets.pieces.size());
  CHECK(made.drawings.size() == made.pages.count);
  CHECK(made.figures.pieces == made.nets.pieces.size());
  CHECK(made.figures.overlaps == 0);
  CHECK_FALSE(made.fold.empty());
  std::vector<std::string> stages;
  for (const auto& [name, seconds] : made.seconds) {
    stages.push_back(name);
  }
  CHECK(stages == std::vector<std::string>{"prepare", "segment", "unfold", "lay out", "hint", "draw", "write",
                                           "verify"});
}

TEST_CASE("the same tabs again and the same paper again give the same bytes", "[job]") {
  const job::Result made = job::run(sample("rocket.obj"), {}, {});
  CHECK(bytes_of(job::with_tabs(made, made.options.tabs, {})) == bytes_of(made));
  CHECK(bytes_of(job::with_pages(made, *made.options.paper, made.options.style, {})) == bytes_of(made));
}

TEST_CASE("with an option that a job names its model is the work that the job says", "[job]") {
  job::Options options;
  options.simplify.mode = prepare::Simplification::keep;
  options.simplify.budget.hours = 1.0;
  const job::Result made = job::run(sample("penguin.obj"), options, {});
  const auto named = std::ranges::find_if(
      made.remedies, [](const job::Remedy& remedy) { return remedy.kind == job::RemedyKind::faces; });
  REQUIRE(named != made.remedies.end());
  CHECK(named->hours <= 1.0);
  options.simplify.mode = prepare::Simplification::count;
  options.simplify.faces = std::stoul(named->value);
  const job::Result other = job::run(sample("penguin.obj"), options, {});
  CHECK(prepare::minutes_of(other.prepared.work) == Approx(60.0 * named->hours).epsilon(0.01));
  CHECK(other.remedies.empty());
}

TEST_CASE("other tabs change tabs and nothing of the nets", "[job]") {
  const job::Result made = job::run(sample("house.obj"), {}, {});
  unfold::TabOptions lower = made.options.tabs;
  lower.height_mm = 3.5;
  const job::Result other = job::with_tabs(made, lower, {});
  CHECK(other.nets.use == made.nets.use);
  CHECK(other.nets.flat == made.nets.flat);
  CHECK(other.nets.piece == made.nets.piece);
  CHECK(other.nets.tabs.size() > 0);
  CHECK(bytes_of(other) != bytes_of(made));
  CHECK(bytes_of(job::with_tabs(other, made.options.tabs, {})) == bytes_of(made));
  unfold::TabOptions none = made.options.tabs;
  none.wanted = false;
  const job::Result bare = job::with_tabs(made, none, {});
  CHECK(bare.nets.tabs.empty());
  CHECK(bare.figures.tabs == 0);
  CHECK(bytes_of(job::with_tabs(bare, made.options.tabs, {})) == bytes_of(made));
}

TEST_CASE("other paper changes pages and nothing of the nets", "[job]") {
  const job::Result made = job::run(sample("whale.obj"), {}, {});
  const job::Result large = job::with_pages(made, export_::parse_paper("A2"), made.options.style, {});
  CHECK(large.pages.count <= made.pages.count);
  CHECK(large.nets.flat == made.nets.flat);
  CHECK(large.drawings.size() == large.pages.count);
  CHECK_THROWS_AS(job::with_pages(made, export_::parse_paper("40x60mm"), made.options.style, {}), Error);
}

TEST_CASE("a file tells what its nets were searched with, whatever was changed since", "[job]") {
  Context first;
  first.seed = 7;
  Context later;
  later.seed = 8;
  const auto setting = [](const job::Result& made, const std::string& name) {
    const std::string key = "\"" + name + "\":";
    const std::size_t at = made.fold.find(key);
    if (at == std::string::npos) {
      return std::string();
    }
    const std::size_t begin = made.fold.find_first_not_of(' ', at + key.size());
    return made.fold.substr(begin, made.fold.find_first_of(",}\n", begin) - begin);
  };
  const job::Result made = job::run(sample("house.obj"), {}, first);
  CHECK(setting(made, "seed") == "7");
  CHECK(made.fold.find("\"searched_") == std::string::npos);

  // Tabs that ask for more pieces get none: nothing is searched for them any more.
  unfold::TabOptions tabs = made.options.tabs;
  tabs.height_mm = 3.5;
  tabs.split_pieces = true;
  const job::Result lower = job::with_tabs(made, tabs, later);
  CHECK(setting(lower, "seed") == "7");
  CHECK(setting(lower, "all_tabs").empty());
  CHECK(setting(lower, "tab_height_mm") == "3.5");
  CHECK(setting(lower, "searched_tab_height_mm") == "5");

  const job::Result large = job::with_pages(made, export_::parse_paper("A2"), made.options.style, later);
  CHECK(setting(large, "seed") == "7");
  CHECK(large.fold.find("\"searched_paper_mm\"") != std::string::npos);
  CHECK(bytes_of(job::with_pages(large, *made.options.paper, made.options.style, later)) == bytes_of(made));
}

TEST_CASE("pieces that were split for tabs stay so without them", "[job]") {
  job::Options options;
  options.tabs.split_pieces = true;
  const job::Result made = job::run(sample("rocket.obj"), options, {});
  unfold::TabOptions none = options.tabs;
  none.wanted = false;
  const job::Result bare = job::with_tabs(made, none, {});
  CHECK(bare.nets.piece == made.nets.piece);
  CHECK(bare.fold.find("\"searched_all_tabs\"") != std::string::npos);
}

TEST_CASE("the times of a job that goes on are those of all its steps", "[job]") {
  const job::Result made = job::run(sample("house.obj"), {}, {});
  const job::Result other = job::with_tabs(made, made.options.tabs, {});
  REQUIRE(other.seconds.size() == made.seconds.size() + 1);
  CHECK(other.seconds.back().first == "tabs");
  for (std::size_t i = 0; i < made.seconds.size(); ++i) {
    CHECK(other.seconds[i].first == made.seconds[i].first);
    CHECK(other.seconds[i].second >= made.seconds[i].second);
  }
}

TEST_CASE("folds that get no line are no short folds, either", "[job]") {
  job::Options options;
  options.style.hidden_fold_angle = 0.2;
  const job::Result made = job::run(sample("gem.stl"), options, {});
  CHECK(made.used.simplify.hidden_fold_angle == made.options.style.hidden_fold_angle);
}

TEST_CASE("a size that the program chose gives what asking for that size does", "[job]") {
  // Twelve tiles in pairs that run into each other, so thin that tabs have no room at 150 mm, and a bar that
  // is too small at that size alone.
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  const auto add = [&](Vec3 low, Vec3 high) {
    for (const auto& face : test::shifted(test::box_faces, static_cast<std::uint32_t>(points.size()))) {
      faces.push_back(face);
    }
    for (const Vec3 p : test::box_points(low, high)) {
      points.push_back(p);
    }
  };
  for (int i = 0; i < 6; ++i) {
    const double x = 26.0 * i;
    add({x, 0, 0}, {x + 12, 14, 4.9});
    add({x + 8, 0, 0}, {x + 20, 14, 4.9});
  }
  add({130, 4, 4.9}, {150, 6.6, 7.5});
  mesh::Model model = test::repaired(test::soup(points, faces));
  model.digest = "0123456789abcdef";
  job::Options options;
  options.size.adapts = true;
  const job::Result chosen = job::run(model, options, {});
  REQUIRE(chosen.prepared.size_reason == prepare::SizeReason::folds);
  const double size = chosen.used.size.largest_extent_mm;
  CHECK(size > 150.0);
  CHECK_FALSE(chosen.used.size.judged_at_mm);
  options.size.adapts = false;
  options.size.largest_extent_mm = size;
  const job::Result asked = job::run(model, options, {});
  CHECK(std::ranges::equal(asked.prepared.model.surface.points(), chosen.prepared.model.surface.points()));
  CHECK(asked.cleanup.left_out.count() == chosen.cleanup.left_out.count());
  CHECK(asked.nets.pieces.size() == chosen.nets.pieces.size());
}

TEST_CASE("without paper there are nets and no pages", "[job]") {
  job::Options options;
  options.paper = std::nullopt;
  options.parts = job::PartsFrom::components;
  const job::Result made = job::run(sample("gem.stl"), options, {});
  CHECK(made.pages.count == 0);
  CHECK(made.drawings.empty());
  CHECK(made.nets.pieces.size() == 1);
  CHECK(made.figures.faces == made.part.size());
}

TEST_CASE("nets of board tell where bodies touch, as those of paper do", "[job]") {
  // A box on a larger one: nothing joins them.
  const std::string text =
      "v 0 0 0\nv 6 0 0\nv 6 5 0\nv 0 5 0\nv 0 0 2\nv 6 0 2\nv 6 5 2\nv 0 5 2\n"
      "v 2 1 2\nv 4 1 2\nv 4 4 2\nv 2 4 2\nv 2 1 4\nv 4 1 4\nv 4 4 4\nv 2 4 4\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
      "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
  const mesh::Model model = mesh::read(mesh::ModelFile{text, "boxes.obj", "boxes", {}}, {}, {});
  job::Options options;
  options.bodies = prepare::Bodies::keep;
  const job::Result paper = job::run(model, options, {});
  REQUIRE_FALSE(paper.drawn.glue_outlines.empty());
  options.board.thickness_mm = 1.0;
  const job::Result board = job::run(model, options, {});
  const auto glue_of = [](const std::string& fold) {
    const std::size_t begin = fold.find("\"ridgecraft:glue\"");
    REQUIRE(begin != std::string::npos);
    return fold.substr(begin, fold.find("\"ridgecraft:", begin + 1) - begin);
  };
  CHECK(glue_of(board.fold) == glue_of(paper.fold));
}

TEST_CASE("edges are named by points of the file", "[job]") {
  mesh::Model model = sample("packaging_box.obj", true);
  job::Options options;
  options.edges.cut = job::EdgeList{{{0, 1}}, digest("0 1")};
  const job::Result made = job::run(std::move(model), options, {});
  CHECK(made.used.simplify.mode == prepare::Simplification::keep);
  CHECK(made.fold.find("\"cuts\"") != std::string::npos);

  const auto refused = [](mesh::Model file, const job::Options& asked) {
    try {
      static_cast<void>(job::run(std::move(file), asked, {}));
    } catch (const Error& error) {
      return error.kind() == ErrorKind::unreadable_input;
    }
    return false;
  };
  options.edges.cut = job::EdgeList{{{0, 4'000'000}}, digest("0 4000000")};
  CHECK(refused(sample("packaging_box.obj", true), options));
  options.edges = {};
  options.edges.keep = job::EdgeList{{{0, 1}}, digest("0 1")};
  CHECK(refused(sample("packaging_box.obj", false), options));
}

TEST_CASE("a listener is told of hundreds of pages and of folds too short for fingers", "[job]") {
  std::vector<job::Remark> told;
  const job::Listener listener = [&](const job::Remark& remark) { told.push_back(remark); };
  job::Options options;
  options.simplify.mode = prepare::Simplification::keep;
  options.size.largest_extent_mm = 12.0;
  static_cast<void>(job::run(sample("gem.stl"), options, {}, listener));
  REQUIRE(told.size() == 1);
  CHECK(std::holds_alternative<job::ShortFolds>(told.front()));
  told.clear();
  options.size.largest_extent_mm = 150.0;
  static_cast<void>(job::run(sample("gem.stl"), options, {}, listener));
  CHECK(told.empty());
  // Whoever is told may end the job, before the long work.
  options.size.largest_extent_mm = 10000.0;
  const job::Listener ends = [&](const job::Remark& remark) {
    told.push_back(remark);
    throw Error(ErrorKind::usage, "enough");
  };
  CHECK_THROWS_AS(job::run(sample("whale.obj"), options, {}, ends), Error);
  REQUIRE(told.size() == 1);
  REQUIRE(std::holds_alternative<job::ManyPages>(told.front()));
  const auto& many = std::get<job::ManyPages>(told.front());
  CHECK(many.pages > 2000.0);
  CHECK(many.size_mm == Approx(10000.0));
  CHECK_FALSE(many.counted);
}

TEST_CASE("a job without time says so, and one that is stopped, too", "[job]") {
  Context late;
  late.deadline = Deadline::in(0.0);
  try {
    static_cast<void>(job::run(sample("whale.obj"), {}, late));
    FAIL("nothing could be prepared in no time");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::out_of_time);
  }
  StopSource source;
  source.request_stop();
  Context stopped;
  stopped.stop = source.get_token();
  CHECK_THROWS_AS(job::run(sample("whale.obj"), {}, stopped), Error);
}
