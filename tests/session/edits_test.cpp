// SPDX-License-Identifier: GPL-3.0-or-later
// Edits by hand: what comes out is sound, what can't be is refused, and every state comes back byte by byte.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/random.hpp"
#include "session/projects.hpp"
#include "session/session.hpp"
#include "verify/verify.hpp"

using namespace ridgecraft;
using session::Cut;
using session::Edge;
using session::Edit;
using session::Join;
using session::NoTab;
using session::Project;
using session::TabFrom;
using session_test::bytes_of;
using session_test::cube;
using session_test::done;
using session_test::edges_used;
using session_test::name_of;
using session_test::refused;
using session_test::sample;
using session_test::saved;
using session_test::surface_of;

namespace {

/// Cuts and joins at random edges, every third time at one that was cut last. After each one the file is
/// sound, and the way back gives the bytes from before; so does the way back to the start, and the saved file
/// gives the last ones.
void edit_at_random(job::Result made, std::uint64_t seed, std::size_t edits) {
  Project project = session::open(std::move(made));
  const mesh::Surface surface = surface_of(project);
  std::vector<std::string> bytes{bytes_of(project.now)};
  Random random(seed);
  std::size_t cuts = 0;
  std::size_t joins = 0;
  std::vector<EdgeId> opened;
  for (std::size_t i = 0; i < edits; ++i) {
    EdgeId e(random.below(static_cast<std::uint32_t>(surface.edge_count())));
    if (i % 3 == 2 && !opened.empty()) {
      e = opened.back();
      opened.pop_back();
    }
    const Edge edge = name_of(surface, e);
    const bool folded = project.now.nets.use[e] == unfold::EdgeUse::fold;
    const std::array<Edit, 1> edit{folded ? Edit(Cut{edge}) : Edit(Join{edge})};
    const session::Answer answer = session::apply(project, edit, {});
    if (const auto* const refusal = std::get_if<session::Refusal>(&answer)) {
      CHECK_FALSE(english(refusal->why).empty());
      CHECK_FALSE(refusal->faces.empty());
      continue;
    }
    const Project& changed = std::get<Project>(answer);
    INFO(session::text_of(edit));
    CHECK(verify::verify(changed.now.fold, {}, {}).sound());
    CHECK(changed.now.nets.pieces.size() ==
          project.now.nets.pieces.size() + (folded ? 1 : 0) - (folded ? 0 : 1));
    CHECK(bytes_of(session::undo(changed, {}).now) == bytes.back());
    bytes.push_back(bytes_of(changed.now));
    project = changed;
    (folded ? cuts : joins) += 1;
    if (folded) {
      opened.push_back(e);
    }
  }
  CHECK(cuts > 0);
  CHECK(joins > 0);
  project = saved(project);
  CHECK(bytes_of(project.now) == bytes.back());
  CHECK(project.steps.size() == bytes.size() - 1);
  for (std::size_t i = bytes.size(); i-- > 1;) {
    project = session::undo(project, {});
    CHECK(bytes_of(project.now) == bytes[i - 1]);
  }
  CHECK_FALSE(project.can_undo());
}

}  // namespace

TEST_CASE("a face of a cube is cut off, and joined elsewhere", "[session]") {
  const Project start = session::open(cube());
  REQUIRE(start.now.nets.pieces.size() == 1);
  const Edge fold = edges_used(start, unfold::EdgeUse::fold).front();
  const Project apart = done(start, {Cut{fold}});
  CHECK(apart.now.nets.pieces.size() == 2);
  CHECK(apart.now.nets.joins.size() == start.now.nets.joins.size() + 1);
  CHECK(apart.now.nets.pieces[PieceId(1)].reason == unfold::PieceReason::request);
  CHECK(apart.now.figures.overlaps == 0);
  std::size_t ways = 0;
  for (const Edge& cut : edges_used(apart, unfold::EdgeUse::cut)) {
    const session::Answer answer = session::apply(apart, std::vector<Edit>{Join{cut}}, {});
    if (const auto* const joined = std::get_if<Project>(&answer)) {
      CHECK(joined->now.nets.pieces.size() == 1);
      ++ways;
    }
  }
  CHECK(ways > 1);
}

TEST_CASE("joined by hand, a piece may have more faces than a search would give it", "[session]") {
  const Project start = session::open(cube(4));
  REQUIRE(start.now.nets.pieces.size() == 2);
  std::size_t ways = 0;
  for (const Edge& cut : edges_used(start, unfold::EdgeUse::cut)) {
    const session::Answer answer = session::apply(start, std::vector<Edit>{Join{cut}}, {});
    if (const auto* const joined = std::get_if<Project>(&answer)) {
      REQUIRE(joined->now.nets.pieces.size() == 1);
      CHECK(done(*joined, {session::Retry{FaceId(0), 1}}).now.nets.pieces.size() == 1);
      ++ways;
    }
  }
  CHECK(ways > 0);
}

TEST_CASE("what can't be is refused with a reason and a place", "[session]") {
  const Project start = session::open(cube());
  const Edge fold = edges_used(start, unfold::EdgeUse::fold).front();
  const Edge cut = edges_used(start, unfold::EdgeUse::cut).front();
  CHECK(refused(start, {Cut{cut}}).why.code == "cut_already");
  CHECK(refused(start, {Join{fold}}).why.code == "fold_already");
  const session::Refusal loop = refused(start, {Join{cut}});
  CHECK(loop.why == Message("closes_loop", {{"a", "A"}}));
  CHECK(loop.faces.size() == 2);
  CHECK(refused(start, {Cut{{VertexId(0), VertexId(99)}}}).why.code == "no_such_edge");
  CHECK(refused(start, {Cut{{VertexId(99), VertexId(0)}}}).why.code == "no_such_edge");
  const mesh::Surface& surface = surface_of(start);
  const auto& panel = start.now.prepared.panels.panel;
  std::size_t inside = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (panel[mesh::face_of(c)] == panel[mesh::face_of(d)]) {
      CHECK(refused(start, {Cut{name_of(surface, e)}}).why.code == "inside_flat_region");
      ++inside;
    }
  }
  CHECK(inside == 6);
}

TEST_CASE("edits that are done together are done all or none", "[session]") {
  const Project start = session::open(cube());
  const std::vector<Edge> folds = edges_used(start, unfold::EdgeUse::fold);
  REQUIRE(folds.size() == 5);
  const Project both = done(start, {Cut{folds[0]}, Cut{folds[1]}});
  CHECK(both.now.nets.pieces.size() == 3);
  CHECK(both.steps.size() == 1);
  CHECK(bytes_of(session::undo(both, {}).now) == bytes_of(start.now));
  CHECK(refused(start, {Cut{folds[0]}, Cut{folds[0]}}).edit == 1);
  CHECK(done(start, {}).steps.empty());
}

TEST_CASE("what would be refused is told before", "[session]") {
  const Project start = session::open(cube());
  const Edge fold = edges_used(start, unfold::EdgeUse::fold).front();
  CHECK_FALSE(session::why_not(start, std::vector<Edit>{Cut{fold}}, {}));
  const auto refusal = session::why_not(start, std::vector<Edit>{Cut{fold}, Cut{fold}}, {});
  REQUIRE(refusal);
  CHECK(refusal->edit == 1);
  CHECK(refusal->why == refused(start, {Cut{fold}, Cut{fold}}).why);
  CHECK(refusal->faces == refused(start, {Cut{fold}, Cut{fold}}).faces);
}

TEST_CASE("a tab goes over to the other side of its edge, and away", "[session]") {
  const Project start = session::open(cube());
  const mesh::Surface& surface = surface_of(start);
  const unfold::Join& join = start.now.nets.joins[JoinId(0)];
  const auto tab_at = [&](const Project& project) -> CornerId {
    const auto& joins = project.now.nets.joins;
    const auto found =
        std::find_if(joins.begin(), joins.end(), [&](const unfold::Join& j) { return j.edge == join.edge; });
    return found->tab.valid() ? project.now.nets.tabs[found->tab].side : CornerId();
  };
  const CornerId here = tab_at(start);
  REQUIRE(here.valid());
  const CornerId there = surface.sides(join.edge)[surface.sides(join.edge)[0] == here ? 1 : 0];
  const Edge other{surface.vertex(there), surface.vertex(mesh::next(there))};
  const Project over = done(start, {TabFrom{other}});
  CHECK(tab_at(over) == there);
  CHECK(over.now.nets.pieces.size() == start.now.nets.pieces.size());
  CHECK(verify::verify(over.now.fold, {}, {}).sound());
  CHECK(bytes_of(session::undo(over, {}).now) == bytes_of(start.now));
  CHECK(tab_at(done(over, {TabFrom{{other.to, other.from}}})) == here);
  const Project without = done(over, {NoTab{other}});
  CHECK_FALSE(tab_at(without).valid());
  // It stays so, whatever is cut elsewhere; and the saved file tells it.
  const Project cut = done(over, {Cut{edges_used(over, unfold::EdgeUse::fold).front()}});
  CHECK(tab_at(cut) == there);
  CHECK(bytes_of(saved(cut).now) == bytes_of(cut.now));
  const Edge fold = edges_used(start, unfold::EdgeUse::fold).front();
  CHECK(refused(start, {TabFrom{fold}}).why.code == "only_glued_edges");
}

TEST_CASE("a tab that has no room on the other side stays, and why is told", "[session][slow]") {
  // Nearly all have room; which model has one that hasn't, searches decide.
  std::size_t refusals = 0;
  for (const std::string file : {"mug.obj", "lighthouse.obj", "penguin.obj", "dinosaur.obj"}) {
    if (refusals > 0) {
      break;
    }
    const Project start = session::open(sample(file));
    const mesh::Surface& surface = surface_of(start);
    for (const unfold::Join& join : start.now.nets.joins) {
      if (!join.tab.valid() || refusals > 0) {
        continue;
      }
      const auto sides = surface.sides(join.edge);
      const CornerId there = sides[sides[0] == start.now.nets.tabs[join.tab].side ? 1 : 0];
      const session::Answer answer = session::apply(
          start, std::vector<Edit>{TabFrom{{surface.vertex(there), surface.vertex(mesh::next(there))}}}, {});
      if (const auto* const refusal = std::get_if<session::Refusal>(&answer)) {
        CHECK(refusal->why.code == "no_room_for_tab");
        CHECK(refusal->faces == std::vector<FaceId>{mesh::face_of(there)});
        ++refusals;
      }
    }
  }
  CHECK(refusals == 1);
}

TEST_CASE("a guide that is drawn when somebody asks for it is the one that a job makes", "[session]") {
  job::Options with_guide;
  with_guide.guide = true;
  const job::Result at_once = sample("gem.stl", with_guide);
  const job::Result later = sample("gem.stl");
  REQUIRE(later.guide.pages.empty());
  CHECK(export_::write_guide_pdf(job::guide_of(later, {}).pages, {}) ==
        export_::write_guide_pdf(at_once.guide.pages, {}));
}

TEST_CASE("steps are repeated on another job as far as they can be done", "[session]") {
  const Project start = session::open(cube());
  const std::vector<Edge> folds = edges_used(start, unfold::EdgeUse::fold);
  const std::vector<std::vector<Edit>> steps{
      {Cut{folds[0]}}, {Cut{folds[1]}, Cut{folds[0]}}, {Join{folds[0]}}, {Cut{folds[1]}}};
  const session::Repeated repeated = session::repeat(cube(), steps, {});
  CHECK(repeated.left_out == std::vector<std::size_t>{1});
  Project by_hand = done(start, steps[0]);
  by_hand = done(by_hand, steps[2]);
  by_hand = done(by_hand, steps[3]);
  CHECK(bytes_of(repeated.project.now) == bytes_of(by_hand.now));
  CHECK(bytes_of(session::undo(repeated.project, {}).now) == bytes_of(session::undo(by_hand, {}).now));
  CHECK(bytes_of(session::repeat(cube(), {}, {}).project.now) == bytes_of(start.now));
}

TEST_CASE("a join that would overlap names the faces", "[session][slow]") {
  Project project = session::open(sample("mug.obj"));
  std::size_t overlaps = 0;
  for (const Edge& cut : edges_used(project, unfold::EdgeUse::cut)) {
    const session::Answer answer = session::apply(project, std::vector<Edit>{Join{cut}}, {});
    const auto* const refusal = std::get_if<session::Refusal>(&answer);
    if (refusal != nullptr && refusal->why.code == "would_overlap") {
      CHECK(refusal->faces.size() > 1);
      ++overlaps;
    }
    if (overlaps == 3) {
      break;
    }
  }
  CHECK(overlaps == 3);
}

TEST_CASE("random edits leave sound nets, and every state comes back", "[session][slow]") {
  edit_at_random(cube(), 1, 120);
  edit_at_random(sample("mug.obj"), 2, 25);
  edit_at_random(sample("torus.off"), 3, 25);
}

TEST_CASE("edits are text and come back from it", "[session]") {
  const std::vector<Edit> step{Cut{{VertexId(3), VertexId(17)}}, Join{{VertexId(5), VertexId(0)}}};
  CHECK(session::text_of(step) == "cut 3 17; join 5 0");
  CHECK(session::steps_of("cut 3 17; join 5 0\njoin 1 2") ==
        std::vector<std::vector<Edit>>{step, {Join{{VertexId(1), VertexId(2)}}}});
  const std::vector<Edit> tabs{TabFrom{{VertexId(3), VertexId(17)}}, NoTab{{VertexId(5), VertexId(0)}}};
  CHECK(session::text_of(tabs) == "tab-from 3 17; no-tab 5 0");
  CHECK(session::steps_of("tab-from 3 17; no-tab 5 0") == std::vector<std::vector<Edit>>{tabs});
  const std::vector<Edit> places{session::Place{FaceId(12), 0, {55.5, -0.1}, 90.25},
                                 session::Pin{FaceId(12)},
                                 session::Unpin{FaceId(3)},
                                 session::Retry{FaceId(4), 18446744073709551615U},
                                 session::Pack{},
                                 session::Pack{{FaceId(1), FaceId(2)}}};
  CHECK(session::text_of(places) ==
        "place 12 1 55.5 -0.1 90.25; pin 12; unpin 3; retry 4 18446744073709551615; pack; pack 1 2");
  CHECK(session::steps_of(session::text_of(places)) == std::vector<std::vector<Edit>>{places});
  CHECK(session::steps_of("").empty());
  for (const char* const wrong :
       {"cut", "cut 1", "cut 1 2 3", "cut 1 -2", "cut 1 2;join 3 4", "turn 1 2", "cut 1 4294967296",
        "join  1 2", "place 1 0 1 1 1", "place 1 1 nan 1 1", "place 1 1 inf 1 1", "place 1 1 1 1", "pin",
        "pin 1 2", "retry 1", "pack x"}) {
    INFO(wrong);
    CHECK_THROWS_AS(session::steps_of(wrong), Error);
  }
}

TEST_CASE("edits of a paper that goes on with other tabs are told with those that follow",
          "[session][slow]") {
  const Project start = session::open(sample("lighthouse.obj"));
  const Project cut = done(start, {Cut{edges_used(start, unfold::EdgeUse::fold).front()}});
  unfold::TabOptions lower = start.start->options.tabs;
  lower.height_mm *= 0.5;
  const Project on = session::open(job::with_tabs(cut.now, lower, {}));
  const std::vector<Edge> folds = edges_used(on, unfold::EdgeUse::fold);
  const auto next = std::find_if(folds.begin(), folds.end(), [&](const Edge& edge) {
    return !session::why_not(on, std::array<Edit, 1>{Cut{edge}}, {});
  });
  REQUIRE(next != folds.end());
  const Project twice = done(on, {Cut{*next}});
  CHECK(twice.now.edits.starts_with(cut.now.edits + "\npack\n"));
  CHECK(bytes_of(saved(twice, job::with_tabs(*start.start, lower, {})).now) == bytes_of(twice.now));
}

TEST_CASE("one tab gets a height and an angle of its own, or a second one", "[session]") {
  const Project start = session::open(cube(3));
  std::size_t shaped = 0;
  for (const unfold::Join& join : start.now.nets.joins) {
    if (!join.tab.valid()) {
      continue;
    }
    const CornerId side = start.now.nets.tabs[join.tab].side;
    const mesh::Surface& surface = surface_of(start);
    const session::Edge edge{surface.vertex(side), surface.vertex(mesh::next(side))};
    const Project high = done(start, {session::TabShape{edge, 8.0, 80.0}});
    const auto now = std::find_if(high.now.nets.joins.begin(), high.now.nets.joins.end(),
                                  [&](const unfold::Join& j) { return j.edge == join.edge; });
    REQUIRE(now != high.now.nets.joins.end());
    const std::vector<Vec2>& polygon = high.now.nets.tabs[now->tab].polygon;
    const Vec2 base = polygon[1] - polygon[0];
    const double height = std::abs(cross(base, polygon[2] - polygon[0])) / length(base);
    shaped += height > 7.9 && height < 8.1 ? 1U : 0U;
    CHECK(
        session::steps_of(session::text_of(std::vector<session::Edit>{session::TabShape{edge, 8.0, 80.0}})) ==
        std::vector<std::vector<session::Edit>>{{session::TabShape{edge, 8.0, 80.0}}});
    const Project both = done(start, {session::BothTabs{edge}});
    CHECK(both.now.nets.tabs.size() >= start.now.nets.tabs.size());
    CHECK(bytes_of(saved(high).now) == bytes_of(high.now));
  }
  CHECK(shaped > 0);
}
