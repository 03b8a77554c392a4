// SPDX-License-Identifier: GPL-3.0-or-later
// What an edit doesn't change keeps its name, its numbers and its place.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "session/projects.hpp"
#include "session/session.hpp"
#include "unfold/net/chains.hpp"

using namespace ridgecraft;
using session::Cut;
using session::Edge;
using session::Edit;
using session::Join;
using session::Number;
using session::Project;
using session_test::done;
using session_test::edges_used;
using session_test::sample;

namespace {

/// All that a maker sees of a piece on its sheet.
struct Seen {
  std::string name;
  std::map<EdgeId, std::uint32_t> numbers;
  std::size_t page = 0;
  std::vector<Vec2> faces;  ///< as they lie
};

Seen seen(const Project& project, PieceId id) {
  const job::Result& now = project.now;
  const export_::Placement& at = now.pages.placements[id];
  Seen piece{now.nets.pieces[id].name, {}, at.page.value(), {}};
  for (const unfold::Join& join : now.nets.joins) {
    const auto [c, d] = now.prepared.model.surface.sides(join.edge);
    if (now.nets.piece[mesh::face_of(c)] == id || now.nets.piece[mesh::face_of(d)] == id) {
      piece.numbers[join.edge] = join.number;
    }
  }
  for (const FaceId f : now.nets.pieces[id].faces) {
    for (const Vec2 corner : now.nets.flat[f]) {
      piece.faces.push_back(at(corner));
    }
  }
  return piece;
}

/// What became otherwise of pieces whose faces are those of before.
struct Changed {
  std::size_t pieces = 0, names = 0, numbers = 0, places = 0;
};
Changed changed(const Project& before, const Project& after) {
  Changed count;
  for (const PieceId id : ids<PieceId>(after.now.nets.pieces.size())) {
    const unfold::Piece& piece = after.now.nets.pieces[id];
    const PieceId old = before.now.nets.piece[piece.faces.front()];
    if (before.now.nets.pieces[old].faces != piece.faces) {
      continue;
    }
    const Seen was = seen(before, old);
    const Seen is = seen(after, id);
    ++count.pieces;
    count.names += was.name == is.name ? 0U : 1U;
    count.numbers += was.numbers == is.numbers ? 0U : 1U;
    count.places += was.page == is.page && was.faces == is.faces ? 0U : 1U;
  }
  return count;
}

}  // namespace

TEST_CASE("a cut changes nothing of other pieces", "[slow]") {
  const auto* const name = GENERATE("house.obj", "fish.obj", "fox_head.obj", "rocket.obj", "dinosaur.obj",
                                    "whale.obj", "penguin.obj", "mug.obj");
  const Project start = session::open(sample(name));
  const std::vector<Edge> folds = edges_used(start, unfold::EdgeUse::fold);
  Changed all;
  for (std::size_t i = 0; i < folds.size(); i += 1 + folds.size() / 6) {
    const session::Answer answer = session::apply(start, std::vector<Edit>{Cut{folds[i]}}, {});
    if (const auto* const after = std::get_if<Project>(&answer)) {
      const Changed one = changed(start, *after);
      all.pieces += one.pieces;
      all.names += one.names;
      all.numbers += one.numbers;
      all.places += one.places;
    }
  }
  INFO(name << ": " << all.pieces << " pieces, " << all.names << " names, " << all.numbers << " numbers, "
            << all.places << " places");
  CHECK(all.pieces > 0);
  CHECK(all.names == 0);
  CHECK(all.numbers == 0);
  CHECK(all.places == 0);
}

TEST_CASE("pieces that are new get names and numbers that nothing had before", "[session]") {
  const Project start = session::open(sample("house.obj"));
  const std::vector<Edge> folds = edges_used(start, unfold::EdgeUse::fold);
  const Project parted = done(start, {Cut{folds.front()}});
  const auto names = [](const Project& project) {
    std::set<std::string> all;
    for (const unfold::Piece& piece : project.now.nets.pieces) {
      all.insert(piece.name);
    }
    return all;
  };
  std::vector<std::string> fresh;
  const std::set<std::string> old = names(start);
  const std::set<std::string> now = names(parted);
  std::set_difference(now.begin(), now.end(), old.begin(), old.end(), std::back_inserter(fresh));
  REQUIRE(fresh.size() == 2);
  CHECK(fresh[0] == fresh[0].substr(0, 1) + ".1");
  CHECK(fresh[1] == fresh[0].substr(0, 1) + ".2");
  CHECK_FALSE(now.contains(fresh[0].substr(0, 1)));
  CHECK(parted.now.nets.joins.items().back().number > start.now.nets.joins.items().back().number);

  // Joined again where it was cut, it is the piece that it was.
  CHECK(names(done(parted, {Join{folds.front()}})) == old);

  // All names and numbers as the program gives them.
  const Project numbered = done(parted, {Number{}});
  std::uint32_t expected = 0;
  for (const unfold::Chain& chain :
       unfold::chains_of(numbered.now.prepared.model.surface, numbered.now.nets)) {
    CHECK(chain.number == ++expected);
  }
  CHECK(numbered.now.nets.pieces.items().back().name.find('.') == std::string::npos);
}
