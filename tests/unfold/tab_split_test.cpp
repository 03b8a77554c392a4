// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that are split until every edge that is wide enough has a tab.
#include "unfold/pieces/tab_split.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <utility>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/shape/shapes.hpp"
#include "unfold/tree_nets.hpp"

using namespace ridgecraft;
using mesh::Surface;
using test::none;
using unfold::Nets;
using unfold::Options;
using unfold::PieceReason;

namespace {

/// Corners of a surface moved in or out at random, up to a share of their distance from the origin.
Surface dented(const Surface& s, double share, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (const Vec3 p : s.points()) {
    points.push_back((1.0 - share * random.unit()) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    faces.push_back(s.vertices(f));
  }
  return Surface(std::move(points), std::move(faces));
}

/// A sheet of `columns` by `rows` squares of two triangles, its inner corners a little above or below: cuts
/// that end at one of these hardly open.
Surface relief(int columns, int rows, double square, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const bool inner = x > 0 && x < columns && y > 0 && y < rows;
      const double z = inner ? square * (0.6 * random.unit() - 0.2) : 0.0;
      points.push_back({square * x, square * y, z});
    }
  }
  const auto v = [&](int x, int y) { return VertexId(y * (columns + 1) + x); };
  std::vector<std::array<VertexId, 3>> faces;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      if (random.unit() < 0.5) {
        faces.push_back({v(x, y), v(x + 1, y), v(x + 1, y + 1)});
        faces.push_back({v(x, y), v(x + 1, y + 1), v(x, y + 1)});
      } else {
        faces.push_back({v(x, y), v(x + 1, y), v(x, y + 1)});
        faces.push_back({v(x + 1, y), v(x + 1, y + 1), v(x, y + 1)});
      }
    }
  }
  return Surface(std::move(points), std::move(faces));
}

Nets unfolded(const Surface& s, Options options, bool split, unsigned threads = 1) {
  options.tabs.split_pieces = split;
  Context context;
  context.threads = threads;
  return unfold::unfold(s, test::no_panels(s), test::one_part(s), options, context);
}

Nets split_in_panels(const Surface& s) {
  Options options;
  options.tabs.split_pieces = true;
  return unfold::unfold(s, test::flat_panels(s), test::one_part(s), options, {});
}

/// Joins without a usable tab that could have one.
std::size_t missing(const Surface& s, const Nets& nets) {
  return static_cast<std::size_t>(
      std::count_if(nets.joins.begin(), nets.joins.end(), [&](const unfold::Join& join) {
        return !join.too_narrow && !(join.tab.valid() && unfold::is_usable(s, nets, join.tab, {}));
      }));
}

std::size_t narrow(const Nets& nets) {
  return static_cast<std::size_t>(
      std::count_if(nets.joins.begin(), nets.joins.end(), [](const auto& join) { return join.too_narrow; }));
}

std::vector<Vec2> polygon(const Nets& nets, FaceId f) {
  return {nets.flat[f].begin(), nets.flat[f].end()};
}

bool tabs_collide(const Nets& nets) {
  for (const unfold::Tab& tab : nets.tabs) {
    const PieceId piece = nets.piece[mesh::face_of(tab.side)];
    for (const FaceId f : nets.pieces[piece].faces) {
      if (test::penetration(tab.polygon, polygon(nets, f)) > 1e-6) {
        return true;
      }
    }
    for (const unfold::Tab& other : nets.tabs) {
      if (&other < &tab && nets.piece[mesh::face_of(other.side)] == piece &&
          test::penetration(tab.polygon, other.polygon) > 1e-6) {
        return true;
      }
    }
  }
  return false;
}

/// How wide the triangle behind a side is 3 mm above it, told by its height alone.
double width_behind(const Surface& s, CornerId side) {
  const CornerId twin = s.twin(side);
  const double edge = s.length(s.edge(side));
  const double height = 2.0 * s.area(mesh::face_of(twin)) / edge;
  return height > 3.0 ? edge * (1.0 - 3.0 / height) : 0.0;
}

/// Does the face behind a side go on beyond a fold so slight that a tab bends with it?
bool bends_slightly(const Surface& s, const Nets& nets, CornerId side) {
  const CornerId twin = s.twin(side);
  const auto slight = [&](CornerId c) {
    const EdgeId e = s.edge(c);
    return nets.use[e] == unfold::EdgeUse::fold && std::abs(s.fold_angle(e)) <= unfold::most_bend_of_tab;
  };
  return slight(mesh::next(twin)) || slight(mesh::previous(twin));
}

/// The fewest pieces in which a surface of few edges has no join without a tab that could have one, by trying
/// all spanning forests.
std::size_t fewest_pieces(const Surface& s) {
  test::FoldOrder order;
  std::vector<EdgeId> inner;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    order.push_back(e);
    if (!s.is_border(e)) {
      inner.push_back(e);
    }
  }
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (std::uint32_t set = 0; set < 1U << inner.size(); ++set) {
    const std::size_t folds = inner.size() - static_cast<std::size_t>(std::popcount(set));
    if (folds >= s.face_count() || s.face_count() - folds >= fewest) {
      continue;
    }
    DisjointSets faces(s.face_count());
    std::vector<EdgeId> cuts;
    bool is_forest = true;
    for (std::uint32_t i = 0; i < inner.size() && is_forest; ++i) {
      const auto [c, d] = s.sides(inner[i]);
      if ((set >> i & 1U) != 0) {
        cuts.push_back(inner[i]);
      } else {
        is_forest = faces.join(mesh::face_of(c).value(), mesh::face_of(d).value());
      }
    }
    if (!is_forest) {
      continue;
    }
    Nets nets = test::lay_out(s, order, cuts);
    REQUIRE(nets.joins.size() == cuts.size());
    if (test::faces_overlap(nets)) {
      continue;
    }
    unfold::place_tabs({s, test::no_panels(s), {}}, nets, {});
    if (missing(s, nets) == 0) {
      fewest = nets.pieces.size();
    }
  }
  return fewest;
}

}  // namespace

TEST_CASE("split pieces have a tab on every edge that is wide enough", "[tabs][slow]") {
  std::size_t missing_before = 0;
  std::size_t left = 0;
  std::size_t more = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Surface s = dented(test::scaled(test::sphere(12, 6), seed % 2 == 0 ? 15.0 : 20.0), 0.1, seed);
    const Nets whole = unfolded(s, {}, false);
    const Nets split = unfolded(s, {}, true);
    CHECK(test::faults_of(s, split, {}) == none);
    // One is left where a tab may not hang on the side that the search had for it, and is told.
    left += missing(s, split);
    CHECK_FALSE(tabs_collide(split));
    missing_before += missing(s, whole);
    more += split.pieces.size() - whole.pieces.size();
    const auto for_tabs = std::count_if(split.pieces.begin(), split.pieces.end(),
                                        [](const auto& piece) { return piece.reason == PieceReason::tabs; });
    CHECK((for_tabs > 0) == (split.pieces.size() > 1));
    // One note, and it counts what can't be helped.
    REQUIRE_FALSE(split.notes.empty());
    const std::string note = english(split.notes.back());
    CHECK(note.find("split off for tabs") != std::string::npos);
    CHECK((note.find("; " + std::to_string(narrow(split)) +
                     (narrow(split) == 1 ? " edge is too short" : " edges are too short")) !=
           std::string::npos) == (narrow(split) > 0));
    CHECK((note.find("even so") != std::string::npos) == (missing(s, split) > 0));
  }
  CHECK(missing_before > 8);
  CHECK(left <= 1);
  CHECK(more > 0);
  CHECK(2 * more <= missing_before);
}

TEST_CASE("an edge is called too narrow where the faces behind it are", "[tabs]") {
  for (const double size : {15.0, 25.0, 80.0}) {
    const Surface s = dented(test::scaled(test::sphere(14, 8), size), 0.3, 7);
    const Nets nets = unfolded(s, {}, false);
    std::size_t told = 0;
    for (const unfold::Join& join : nets.joins) {
      const auto [a, b] = s.sides(join.edge);
      const double width = std::max(width_behind(s, a), width_behind(s, b));
      const double edge = s.length(join.edge);
      if (width < 0.5 * edge - 1e-6 && !bends_slightly(s, nets, a) && !bends_slightly(s, nets, b)) {
        CHECK(join.too_narrow);
        ++told;
      } else if (width > std::max(0.5 * edge, 2.0) + 1e-6) {
        CHECK_FALSE(join.too_narrow);
      }
      CHECK_FALSE((join.too_narrow && join.tab.valid() && unfold::is_usable(s, nets, join.tab, {})));
    }
    // In between a good tree cuts none of them.
    CHECK((told == 0 || size < 50.0));
    CHECK((told > 0 || size > 20.0));
  }
}

TEST_CASE("no fewer pieces would do for small surfaces", "[tabs]") {
  // All spanning forests of 12 to 16 faces.
  std::size_t split = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Surface s = relief(seed % 2 == 0 ? 4 : 3, 2, 15.0, seed);
    const Nets nets = unfolded(s, {}, true);
    CHECK(missing(s, nets) == 0);
    const std::size_t fewest = fewest_pieces(s);
    INFO("seed " << seed);
    CHECK(nets.pieces.size() == fewest);
    split += fewest > 1 ? 1U : 0U;
  }
  CHECK(split >= 3);
}

TEST_CASE("splitting for tabs keeps to the sheet, and threads change nothing", "[threads][tabs][slow]") {
  const Surface s = dented(test::scaled(test::sphere(12, 6), 20.0), 0.1, 5);
  const Options options = test::on_sheet(70.0, 90.0);
  const Nets nets = unfolded(s, options, true);
  CHECK(test::faults_of(s, nets, options) == none);
  CHECK(missing(s, nets) == 0);
  const Nets again = unfolded(s, options, true, 3);
  CHECK(nets.use == again.use);
  CHECK(nets.notes == again.notes);
}

TEST_CASE("nets that were split in too little time say so", "[tabs]") {
  const Surface s = dented(test::scaled(test::sphere(12, 6), 20.0), 0.1, 5);
  Options options;
  options.tabs.split_pieces = true;
  const auto note_of = [&](std::optional<Deadline> deadline) {
    Context context;
    context.deadline = deadline;
    const Nets nets = unfold::unfold(s, test::no_panels(s), test::one_part(s), options, context);
    CHECK(test::faults_of(s, nets, options) == none);
    const std::string note = english(nets.notes.back());
    // One may be left, as above, and is told.
    CHECK((deadline || missing(s, nets) <= 1));
    CHECK((deadline || (note.find("even so") != std::string::npos) == (missing(s, nets) > 0)));
    return note;
  };
  const std::string late = note_of(Deadline::in(0.0));
  CHECK(late.find("time limit reached") != std::string::npos);
  // Whoever had no time to look for room doesn't know that there is none.
  CHECK(late.find("no room for a tab yet") != std::string::npos);
  CHECK(late.find("even so") == std::string::npos);
  CHECK(note_of({}).find("the time given was up") == std::string::npos);
}

TEST_CASE("a slit in a flat region takes no edge its tab", "[tabs]") {
  // A cube with two neighbouring squares as fans around points near one end of their common edge.
  const std::vector<Vec3> points{{0, 0, 0},   {40, 0, 0},   {40, 40, 0}, {0, 40, 0},  {0, 0, 40},
                                 {40, 0, 40}, {40, 40, 40}, {0, 40, 40}, {36, 4, 40}, {36, 0, 36}};
  const auto v = [](int i) { return VertexId(i); };
  std::vector<std::array<VertexId, 3>> faces;
  const auto square = [&](int a, int b, int c, int d) {
    faces.push_back({v(a), v(b), v(c)});
    faces.push_back({v(a), v(c), v(d)});
  };
  const auto fan = [&](int a, int b, int c, int d, int middle) {
    for (const auto& [x, y] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}, std::pair{d, a}}) {
      faces.push_back({v(x), v(y), v(middle)});
    }
  };
  square(0, 3, 2, 1);
  square(1, 2, 6, 5);
  square(2, 3, 7, 6);
  square(3, 0, 4, 7);
  fan(4, 5, 6, 7, 8);
  fan(0, 1, 5, 4, 9);
  const Surface s(points, faces);
  const Nets nets = split_in_panels(s);
  CHECK(nets.pieces.size() == 1);
  CHECK(missing(s, nets) == 0);
}

TEST_CASE("edges inside a flat region need no tab", "[tabs]") {
  // A cube whose top has a triangle in the middle: all of its edges are folds of the flat region.
  const std::vector<Vec3> points{{0, 0, 0},    {40, 0, 0},   {40, 40, 0},  {0, 40, 0},
                                 {0, 0, 40},   {40, 0, 40},  {40, 40, 40}, {0, 40, 40},
                                 {15, 15, 40}, {25, 15, 40}, {20, 25, 40}};
  std::vector<std::array<VertexId, 3>> faces;
  for (const auto& [a, b, c] : std::initializer_list<std::array<int, 3>>{{0, 3, 2},
                                                                         {0, 2, 1},
                                                                         {0, 1, 5},
                                                                         {0, 5, 4},
                                                                         {1, 2, 6},
                                                                         {1, 6, 5},
                                                                         {2, 3, 7},
                                                                         {2, 7, 6},
                                                                         {3, 0, 4},
                                                                         {3, 4, 7},
                                                                         {4, 5, 9},
                                                                         {4, 9, 8},
                                                                         {5, 6, 9},
                                                                         {6, 10, 9},
                                                                         {6, 7, 10},
                                                                         {7, 4, 8},
                                                                         {7, 8, 10},
                                                                         {8, 9, 10}}) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  }
  const Surface s(points, faces);
  REQUIRE(test::flat_panels(s).count() == 6);
  const Nets nets = split_in_panels(s);
  CHECK(nets.pieces.size() == 1);
  CHECK(nets.joins.size() == 7);
  CHECK(missing(s, nets) == 0);
}

TEST_CASE("what has all its tabs isn't split", "[tabs]") {
  const Nets nets = split_in_panels(test::scaled(test::cube(), 40.0));
  CHECK(nets.pieces.size() == 1);
  CHECK(nets.tabs.size() == 7);
}
