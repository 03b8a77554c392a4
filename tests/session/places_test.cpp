// SPDX-License-Identifier: GPL-3.0-or-later
// Places by hand: what isn't touched stays, what is laid lies there, and what has no room is refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "session/projects.hpp"
#include "session/session.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "verify/verify.hpp"

using namespace ridgecraft;
using session::Cut;
using session::Edge;
using session::Edit;
using session::Join;
using session::Pack;
using session::Pin;
using session::Place;
using session::Project;
using session::Retry;
using session::Unpin;
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

/// Where the corners of a face lie on its page.
std::array<Vec2, 3> on_page(const Project& project, FaceId face) {
  std::array<Vec2, 3> corners = project.now.nets.flat[face];
  for (Vec2& corner : corners) {
    corner = project.now.pages.placements[project.now.nets.piece[face]](corner);
  }
  return corners;
}

PageId page_of(const Project& project, FaceId face) {
  return project.now.pages.placements[project.now.nets.piece[face]].page;
}

/// The piece as it lies, but shifted and turned about the first corner of its first face.
Place moved(const Project& project, PieceId piece, Vec2 by, double degrees = 0.0) {
  const FaceId face = project.now.nets.pieces[piece].faces.front();
  const std::array<Vec2, 3> at = on_page(project, face);
  const Vec2 side = at[1] - at[0];
  return {face, page_of(project, face).value(), at[0] + by,
          std::atan2(side.y, side.x) * 180.0 / std::acos(-1.0) + degrees};
}

/// Faces that lie elsewhere now, or on another page.
std::size_t faces_elsewhere(const Project& before, const Project& after) {
  std::size_t count = 0;
  for (const FaceId f : ids<FaceId>(surface_of(before).face_count())) {
    const auto old = on_page(before, f);
    const auto now = on_page(after, f);
    const bool same =
        page_of(before, f) == page_of(after, f) &&
        std::equal(old.begin(), old.end(), now.begin(), [](Vec2 a, Vec2 b) { return length(a - b) < 1e-9; });
    count += same ? 0U : 1U;
  }
  return count;
}

std::size_t faces_of(const Project& project, PieceId piece) {
  return project.now.nets.pieces[piece].faces.size();
}

/// The sides that tabs of a piece grow from, and their corners in its plane.
std::map<CornerId, std::vector<Vec2>> tabs_of(const Project& project, const unfold::Piece& piece) {
  const unfold::Nets& nets = project.now.nets;
  std::map<CornerId, std::vector<Vec2>> tabs;
  for (const unfold::Tab& tab : nets.tabs) {
    if (nets.piece[mesh::face_of(tab.side)] == nets.piece[piece.faces.front()]) {
      tabs[tab.side] = tab.polygon;
    }
  }
  return tabs;
}

/// A cube in two pieces: the whole model but for one face, and that face.
Project two_pieces() {
  Project start = session::open(cube());
  for (const Edge& fold : edges_used(start, unfold::EdgeUse::fold)) {
    Project cut = done(start, {Cut{fold}});
    if (std::min(faces_of(cut, PieceId(0)), faces_of(cut, PieceId(1))) == 2) {
      return cut;
    }
  }
  FAIL("no face of the cube hangs on one fold");
  return start;
}

}  // namespace

TEST_CASE("what an edit doesn't change stays where it lies", "[session][slow]") {
  const Project start = session::open(sample("mug.obj"));
  std::size_t tried = 0;
  for (const Edge& fold : edges_used(start, unfold::EdgeUse::fold)) {
    const session::Answer answer = session::apply(start, std::vector<Edit>{Cut{fold}}, {});
    const auto* const cut = std::get_if<Project>(&answer);
    if (cut == nullptr || ++tried > 8) {
      continue;
    }
    // The larger half stays, too, or finds no room with its new tabs.
    const std::size_t pieces = cut->now.nets.pieces.size();
    REQUIRE(pieces == start.now.nets.pieces.size() + 1);
    std::size_t changed = 0;
    for (const unfold::Piece& piece : start.now.nets.pieces) {
      // One that is another's equal no more, or is now, may get other tabs, and have no room with them.
      const bool whole =
          std::any_of(cut->now.nets.pieces.begin(), cut->now.nets.pieces.end(), [&](const unfold::Piece& p) {
            return p.faces == piece.faces && tabs_of(*cut, p) == tabs_of(start, piece);
          });
      changed += whole ? 0U : piece.faces.size();
    }
    CHECK(faces_elsewhere(start, *cut) <= changed);
    CHECK(verify::verify(cut->now.fold, {}, {}).sound());
    CHECK(bytes_of(session::undo(*cut, {}).now) == bytes_of(start.now));
  }
  CHECK(tried > 4);
}

TEST_CASE("a piece is laid elsewhere and turned, and comes back", "[session]") {
  const Project start = two_pieces();
  const PieceId small = PieceId(faces_of(start, PieceId(0)) < faces_of(start, PieceId(1)) ? 0 : 1);
  const Place there = moved(start, small, {0.0, 0.0}, 90.0);
  Place free = there;
  free.page = static_cast<std::uint32_t>(start.now.pages.count);
  free.at = {100.0, 140.0};
  const Project laid = done(start, {free});
  const auto corners = on_page(laid, free.face);
  CHECK(length(corners[0] - free.at) < 1e-9);
  CHECK(page_of(laid, free.face).value() == free.page);
  CHECK(laid.now.pages.count == start.now.pages.count + 1);
  CHECK(faces_elsewhere(start, laid) == faces_of(start, small));
  CHECK(verify::verify(laid.now.fold, {}, {}).sound());
  CHECK(laid.now.figures.overlaps == 0);
  CHECK(bytes_of(session::undo(laid, {}).now) == bytes_of(start.now));
  CHECK(bytes_of(saved(laid).now) == bytes_of(laid.now));
}

TEST_CASE("a page that is left empty goes", "[session]") {
  const Project start = two_pieces();
  REQUIRE(start.now.pages.count == 1);
  Place place = moved(start, PieceId(1), {});
  place.page = 1;
  const Project apart = done(start, {place});
  CHECK(apart.now.pages.count == 2);
  Place other = moved(apart, PieceId(0), {});
  other.page = 2;
  const Project later = done(apart, {other});
  CHECK(later.now.pages.count == 2);
  CHECK(page_of(later, place.face).value() == 0);
  CHECK(page_of(later, other.face).value() == 1);
}

TEST_CASE("a place without room is refused with both pieces", "[session]") {
  const Project start = two_pieces();
  Place onto = moved(start, PieceId(1), {});
  onto.at = on_page(start, start.now.nets.pieces[PieceId(0)].faces.front())[0];
  const session::Refusal refusal = refused(start, {onto});
  const std::string a = start.now.nets.pieces[PieceId(0)].name;
  const std::string b = start.now.nets.pieces[PieceId(1)].name;
  CHECK(english(refusal.why).starts_with("there piece " + b + " would lie on piece " + a));
  CHECK(refusal.faces.size() == surface_of(start).face_count());
  const auto told = session::why_not(start, std::vector<Edit>{onto}, {});
  REQUIRE(told);
  CHECK(told->why == refusal.why);
  CHECK_FALSE(session::why_not(start, std::vector<Edit>{moved(start, PieceId(1), {})}, {}));
  CHECK(refused(start, {moved(start, PieceId(1), {500.0, 0.0})}).why == Message("beyond_sheet", {{"a", b}}));
  Place far = moved(start, PieceId(1), {});
  far.page = 2;
  CHECK(refused(start, {far}).why.code == "no_such_page");
  CHECK(refused(start, {Pin{FaceId(99)}}).why.code == "no_such_face");
  job::Options options;
  options.paper.reset();
  const job::Result nets_alone = job::run(mesh::Model(start.start->prepared.model), options, {});
  const Project boundless = session::open(nets_alone);
  CHECK(refused(boundless, {Place{FaceId(0), 0, {0.0, 0.0}, 0.0}}).why.code == "no_pages");
}

TEST_CASE("a piece that is held nearly where it has room can be laid there", "[session]") {
  const Project start = two_pieces();
  Random random(1);
  std::size_t elsewhere = 0;
  std::size_t nowhere = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec2 by{60.0 * random.unit() - 30.0, 60.0 * random.unit() - 30.0};
    const Place held = moved(start, PieceId(1), by, 90.0 * random.unit());
    const bool has_room = !session::why_not(start, std::vector<Edit>{held}, {});
    const std::optional<Place> found = session::nearby_place(start, held, {});
    if (!found) {
      CHECK_FALSE(has_room);
      ++nowhere;
      continue;
    }
    CHECK_FALSE(session::why_not(start, std::vector<Edit>{*found}, {}));
    CHECK(found->page == held.page);
    CHECK(found->degrees == held.degrees);
    CHECK(length(found->at - held.at) <= session::nearby_mm + 1e-9);
    CHECK(has_room == (length(found->at - held.at) < 1e-9));
    elsewhere += has_room ? 0U : 1U;
  }
  CHECK(elsewhere > 0);
  CHECK(nowhere > 0);
  CHECK_FALSE(session::nearby_place(start, moved(start, PieceId(1), {500.0, 0.0}), {}));
  const Project pinned = done(start, {Pin{start.now.nets.pieces[PieceId(1)].faces.front()}});
  CHECK_FALSE(session::nearby_place(pinned, moved(pinned, PieceId(1), {1.0, 0.0}), {}));
  Place far = moved(start, PieceId(1), {});
  far.page = 2;
  CHECK_FALSE(session::nearby_place(start, far, {}));
  far.page = 1;
  CHECK(session::nearby_place(start, far, {}));
}

TEST_CASE("a pinned piece stays as it is", "[session]") {
  const Project start = two_pieces();
  const PieceId large = PieceId(faces_of(start, PieceId(0)) > faces_of(start, PieceId(1)) ? 0 : 1);
  const FaceId face = start.now.nets.pieces[large].faces.front();
  const Project pinned = done(start, {Pin{face}});
  CHECK(bytes_of(session::undo(pinned, {}).now) == bytes_of(start.now));
  const std::vector<MessageValue> named{{"a", start.now.nets.pieces[large].name}};
  const Message why("pinned", named);
  CHECK(refused(pinned, {moved(pinned, large, {1.0, 0.0})}).why == why);
  CHECK(refused(pinned, {Retry{face, 1}}).why == why);
  CHECK(refused(pinned, {Pack{{face}}}).why == why);
  CHECK(refused(pinned, {Pin{face}}).why == Message("pinned_already", named));
  for (const Edge& fold : edges_used(pinned, unfold::EdgeUse::fold)) {
    CHECK(refused(pinned, {Cut{fold}}).why == why);
  }
  for (const Edge& cut : edges_used(pinned, unfold::EdgeUse::cut)) {
    CHECK(session::why_not(pinned, std::vector<Edit>{Join{cut}}, {}));
  }
  const Project packed = done(pinned, {Pack{}});
  CHECK(faces_elsewhere(pinned, packed) <= surface_of(start).face_count() - faces_of(start, large));
  const Project loose = done(pinned, {Unpin{face}});
  CHECK(refused(loose, {Unpin{face}}).why == Message("not_pinned", named));
  CHECK_FALSE(
      session::why_not(loose, std::vector<Edit>{Cut{edges_used(loose, unfold::EdgeUse::fold).front()}}, {}));
  CHECK(saved(pinned).state().pinned == pinned.state().pinned);
}

TEST_CASE("a piece gets another net, and the others stay", "[session][slow]") {
  const Project start = session::open(sample("mug.obj"));
  std::size_t found = 0;
  for (const PieceId p : ids<PieceId>(start.now.nets.pieces.size())) {
    const FaceId face = start.now.nets.pieces[p].faces.front();
    const session::Answer answer = session::apply(start, std::vector<Edit>{Retry{face, 7}}, {});
    if (const auto* const refusal = std::get_if<session::Refusal>(&answer)) {
      CHECK(refusal->why == Message("no_other_net", {{"a", start.now.nets.pieces[p].name}}));
      continue;
    }
    const Project& other = std::get<Project>(answer);
    ++found;
    CHECK(other.now.nets.pieces.size() == start.now.nets.pieces.size());
    const unfold::Piece& piece = other.now.nets.pieces[other.now.nets.piece[face]];
    CHECK(piece.faces == start.now.nets.pieces[p].faces);
    CHECK(other.now.nets.use != start.now.nets.use);
    CHECK(verify::verify(other.now.fold, {}, {}).sound());
    CHECK(bytes_of(session::undo(other, {}).now) == bytes_of(start.now));
    CHECK(bytes_of(done(start, {Retry{face, 7}}).now) == bytes_of(other.now));
  }
  CHECK(found > 0);
}

TEST_CASE("all pieces are placed anew as a job places them", "[session][slow]") {
  const Project start = session::open(sample("mug.obj"));
  Place away = moved(start, PieceId(0), {});
  away.page = static_cast<std::uint32_t>(start.now.pages.count);
  const Project laid = done(start, {away});
  const Project packed = done(laid, {Pack{}});
  CHECK(faces_elsewhere(start, packed) == 0);
}

TEST_CASE("edits don't heed a deadline", "[session][slow]") {
  const Project start = session::open(sample("mug.obj"));
  const auto folds = edges_used(start, unfold::EdgeUse::fold);
  const auto fold = std::find_if(folds.begin(), folds.end(), [&](const Edge& edge) {
    return !session::why_not(start, std::vector<Edit>{Cut{edge}}, {});
  });
  REQUIRE(fold != folds.end());
  const std::vector<Edit> cut{Cut{*fold}};
  Context late;
  late.deadline = Deadline::in(0.0);
  const Project in_time = done(start, cut);
  const session::Answer answer = session::apply(start, cut, late);
  REQUIRE(std::holds_alternative<Project>(answer));
  CHECK(bytes_of(std::get<Project>(answer).now) == bytes_of(in_time.now));
  CHECK(bytes_of(session::undo(in_time, late).now) == bytes_of(start.now));
  CHECK(bytes_of(session::repeat(*start.start, std::vector<std::vector<Edit>>{cut}, late).project.now) ==
        bytes_of(in_time.now));
}

TEST_CASE("edges that were to be kept are counted after each edit", "[session]") {
  const Project plain = session::open(cube());
  const mesh::Surface& surface = surface_of(plain);
  job::Result made = *plain.start;
  made.constraints = unfold::EdgeConstraints(surface.edge_count(), unfold::EdgeConstraint::none);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    made.constraints[e] = unfold::EdgeConstraint::keep;
  }
  made.early_notes = {Message("most_edges_marked")};
  const Project start = session::open(made);
  const Project cut = done(start, {Cut{edges_used(start, unfold::EdgeUse::fold).front()}});
  // A cube's net has seven cuts.
  CHECK(cut.now.nets.broken_constraints == 8);
  CHECK(cut.now.nets.notes == made.early_notes);
}

TEST_CASE("edges that were to be cut stay so when a join lays them on each other", "[session][slow]") {
  const Project start = session::open(sample("mug.obj"));
  const mesh::Surface& surface = surface_of(start);
  job::Result made = *start.start;
  made.constraints = unfold::EdgeConstraints(surface.edge_count(), unfold::EdgeConstraint::none);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    made.constraints[e] = start.now.nets.use[e] == unfold::EdgeUse::cut ? unfold::EdgeConstraint::cut
                                                                        : unfold::EdgeConstraint::none;
  }
  const Project asked = session::open(made);
  std::size_t joins = 0;
  for (const Edge& cut : edges_used(asked, unfold::EdgeUse::cut)) {
    const session::Answer answer = session::apply(asked, std::vector<Edit>{Join{cut}}, {});
    if (const auto* const joined = std::get_if<Project>(&answer)) {
      std::size_t folds = 0;
      for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
        folds +=
            asked.now.nets.use[e] == unfold::EdgeUse::cut && joined->now.nets.use[e] == unfold::EdgeUse::fold
                ? 1U
                : 0U;
      }
      CHECK(folds == 1);
      if (++joins == 3) {
        break;
      }
    }
  }
  CHECK(joins == 3);
}

TEST_CASE("what a file asks of tabs by numbers goes with their edges", "[session][slow]") {
  job::Result made = sample("mug.obj");
  const auto joins = made.nets.joins;
  const auto with_tab =
      std::find_if(joins.begin(), joins.end(), [](const unfold::Join& j) { return j.tab.valid(); });
  REQUIRE(with_tab != joins.end());
  const unfold::Join& last = *std::find_if(joins.items().rbegin(), joins.items().rend(),
                                           [](const unfold::Join& j) { return j.tab.valid(); });
  made.options.tab_choice.edges.push_back({last.number, "tabs.txt, line 1", false, false, {}, {}, {}});
  made = job::with_tabs(made, made.options.tabs, {});
  const Project start = session::open(made);
  const auto tab_at = [](const Project& project, EdgeId edge) {
    const auto& all = project.now.nets.joins;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const unfold::Join& j) { return j.edge == edge; });
    REQUIRE(found != all.end());
    return std::pair(found->tab.valid(), found->number);
  };
  REQUIRE_FALSE(tab_at(start, last.edge).first);
  std::size_t renumbered = 0;
  std::size_t tried = 0;
  for (const Edge& fold : edges_used(start, unfold::EdgeUse::fold)) {
    const session::Answer answer = session::apply(start, std::vector<Edit>{Cut{fold}}, {});
    if (const auto* const cut = std::get_if<Project>(&answer); cut != nullptr && tried < 8) {
      ++tried;
      CHECK_FALSE(tab_at(*cut, last.edge).first);
      renumbered += tab_at(*cut, last.edge).second != last.number ? 1U : 0U;
    }
  }
  CHECK(renumbered == 0);
}

TEST_CASE("places, pins and nets at random leave sound pages, and every state comes back",
          "[session][slow]") {
  Project project = session::open(sample("mug.obj"));
  const std::size_t faces = surface_of(project).face_count();
  Random random(11);
  std::vector<std::string> bytes{bytes_of(project.now)};
  std::map<std::size_t, std::size_t> kinds;
  for (std::size_t i = 0; i < 60; ++i) {
    const FaceId face(random.below(static_cast<std::uint32_t>(faces)));
    const PieceId piece = project.now.nets.piece[face];
    const auto number = [&](std::uint32_t most) { return static_cast<double>(random.below(most)); };
    std::array<Edit, 1> edit{Pin{face}};
    switch (random.below(6)) {
      case 0: {
        Place place = moved(project, piece, {number(20) - 10.0, number(20) - 10.0}, 15.0 * number(3));
        if (random.below(2) == 0) {
          place = moved(project, piece, {});
          place.page = static_cast<std::uint32_t>(project.now.pages.count);
        }
        edit[0] = place;
        break;
      }
      case 1:
        if (project.state().is_pinned(piece) || random.below(2) == 0) {
          edit[0] = Unpin{face};
        }
        break;
      case 2:
        edit[0] = Retry{face, i};
        break;
      case 3:
        edit[0] = random.below(2) == 0 ? Pack{} : Pack{{face}};
        break;
      case 4: {
        const EdgeId e = surface_of(project).edge(mesh::corner(face, 0));
        const Edge edge = name_of(surface_of(project), e);
        edit[0] = project.now.nets.use[e] == unfold::EdgeUse::fold ? Edit(Cut{edge}) : Edit(Join{edge});
        break;
      }
      default:
        // Whatever is pinned refuses all else, so a third of the edits let go.
        edit[0] = Unpin{face};
        break;
    }
    INFO(session::text_of(edit));
    const session::Answer answer = session::apply(project, edit, {});
    if (const auto* const refusal = std::get_if<session::Refusal>(&answer)) {
      CHECK_FALSE(english(refusal->why).empty());
      CHECK_FALSE(refusal->faces.empty());
      continue;
    }
    project = std::get<Project>(answer);
    ++kinds[edit[0].index()];
    CHECK(verify::verify(project.now.fold, {}, {}).sound());
    bytes.push_back(bytes_of(project.now));
  }
  CHECK(kinds.size() >= 5);
  project = saved(project);
  for (std::size_t i = bytes.size(); i-- > 1;) {
    CHECK(bytes_of(project.now) == bytes[i]);
    project = session::undo(project, {});
  }
  CHECK(bytes_of(project.now) == bytes[0]);
}
