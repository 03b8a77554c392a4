// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept together.
#include "unfold/net/edge_constraints.hpp"

#include <algorithm>
#include <ctime>
#include <vector>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/panel_parts.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using test::faults_of;
using test::none;
using test::scaled;
using unfold::EdgeConstraint;
using unfold::EdgeConstraints;
using unfold::EdgeUse;
using unfold::Nets;
using unfold::Options;
using unfold::PieceReason;
using unfold::Segment;

namespace {

Segment segment_of(const mesh::Surface& s, EdgeId e) {
  const CornerId c = s.sides(e)[0];
  return {s.point(s.vertex(c)), s.point(s.vertex(mesh::next(c)))};
}

Options on_paper() {
  Options options;
  options.sheet = unfold::Sheet{190.0, 277.0};
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  return options;
}

std::size_t noted(const Nets& nets, const std::string& words) {
  return static_cast<std::size_t>(std::count_if(nets.notes.begin(), nets.notes.end(), [&](const auto& note) {
    return english(note).find(words) != std::string::npos;
  }));
}

}  // namespace

TEST_CASE("what is to be cut is cut, what can be kept is kept", "[constraints]") {
  const mesh::Surface s = scaled(test::sphere(10, 7), 40.0);
  const prepare::Panels panels = test::flat_panels(s);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    Options options = on_paper();
    options.constraints = EdgeConstraints(s.edge_count(), EdgeConstraint::none);
    DisjointSets together(s.face_count());
    for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
      const auto [c, d] = s.sides(e);
      const FaceId f = mesh::face_of(c);
      const FaceId g = mesh::face_of(d);
      if (panels.panel[f] == panels.panel[g]) {
        together.join(f.value(), g.value());
      }
    }
    for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
      const auto [c, d] = s.sides(e);
      const double chance = random.unit();
      if (panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)]) {
        continue;
      }
      if (chance < 0.1) {
        options.constraints[e] = EdgeConstraint::cut;
      } else if (chance < 0.15 && together.join(mesh::face_of(c).value(), mesh::face_of(d).value())) {
        options.constraints[e] = EdgeConstraint::keep;
      }
    }
    const Nets nets = unfold::unfold(s, panels, test::one_part(s), options, {});
    CHECK(faults_of(s, nets, options) == none);
    for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
      if (options.constraints[e] != EdgeConstraint::none) {
        CHECK(nets.use[e] == (options.constraints[e] == EdgeConstraint::cut ? EdgeUse::cut : EdgeUse::fold));
      }
    }
    CHECK(noted(nets, "to be kept") == 0);
  }
}

TEST_CASE("nets that are given survive, whatever the seed", "[constraints]") {
  const mesh::Surface s = scaled(test::sphere(9, 6), 60.0);
  const prepare::Panels panels = test::flat_panels(s);
  IdVector<FaceId, PartId> part(s.face_count(), PartId(0));
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    part[f] = PartId(f.value() % 2 == 0 && f.value() < 20 ? 1 : 0);
  }
  Options options = on_paper();
  const Nets before = unfold::unfold(s, panels, test::one_part(s), options, {});
  options.constraints = EdgeConstraints(s.edge_count(), EdgeConstraint::none);
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    options.constraints[e] = before.use[e] == EdgeUse::fold ? EdgeConstraint::keep : EdgeConstraint::cut;
  }
  Context context;
  context.seed = 99;
  // Other parts and another limit change nothing either.
  options.pieces.max_panels = 3;
  const Nets after =
      unfold::unfold(s, panels, unfold::parts_of_whole_panels(s, panels, part), options, context);
  CHECK(faults_of(s, after, options) == none);
  CHECK(after.use == before.use);
  CHECK(after.pieces.size() == before.pieces.size());
}

TEST_CASE("a cut all the way round makes a piece on request", "[constraints]") {
  const mesh::Surface s = scaled(test::cube(), 20.0);
  Options options = on_paper();
  options.constraints = EdgeConstraints(s.edge_count(), EdgeConstraint::none);
  const prepare::Panels panels = test::flat_panels(s);
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    const auto [c, d] = s.sides(e);
    const PanelId p = panels.panel[mesh::face_of(c)];
    const PanelId q = panels.panel[mesh::face_of(d)];
    options.constraints[e] =
        p != q && (p == PanelId(0) || q == PanelId(0)) ? EdgeConstraint::cut : EdgeConstraint::none;
  }
  const Nets nets = unfold::unfold(s, panels, test::one_part(s), options, {});
  CHECK(faults_of(s, nets, options) == none);
  REQUIRE(nets.pieces.size() == 2);
  CHECK(nets.pieces[PieceId(1)].reason == PieceReason::request);
}

TEST_CASE("what can't all be kept is kept as far as possible, and told", "[constraints]") {
  const mesh::Surface s = scaled(test::sphere(8, 5), 90.0);
  Options options = on_paper();
  options.constraints = EdgeConstraints(s.edge_count(), EdgeConstraint::keep);
  const Nets nets = unfold::unfold(s, test::flat_panels(s), test::one_part(s), options, {});
  CHECK(faults_of(s, nets, options) == none);
  CHECK(noted(nets, "to be kept") == 1);
}

TEST_CASE("segments are found on edges that were divided or joined since", "[constraints]") {
  const mesh::Surface s = scaled(test::cube(), 20.0);
  const prepare::Panels panels = test::flat_panels(s);
  std::vector<Segment> cut;
  std::vector<Segment> keep;
  EdgeId divided;
  EdgeId flat;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    const auto [c, d] = s.sides(e);
    (panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)] ? flat : divided) = e;
  }
  const auto [a, b] = segment_of(s, divided);
  cut.push_back({b, 0.4 * a + 0.6 * b});
  cut.push_back({a, 0.4 * a + 0.6 * b});
  cut.push_back({a, a + 0.3 * (b - a) + Vec3{0.1, 0.2, 0.3}});
  keep.push_back(segment_of(s, flat));
  const Segment whole = segment_of(s, divided.value() == 0 ? EdgeId(1) : EdgeId(0));
  keep.push_back({whole[0] - (whole[1] - whole[0]), whole[1]});  // an edge that is half as long now
  const auto [constraints, cuts, keeps] = unfold::match_segments(s, panels, cut, keep, {});
  CHECK(constraints[divided] == EdgeConstraint::cut);
  CHECK(std::count(constraints.begin(), constraints.end(), EdgeConstraint::cut) == 1);
  CHECK(cuts.found == 2);
  CHECK(cuts.lost == 1);
  CHECK(keeps.flat >= 1);
  CHECK(keeps.found + keeps.flat + keeps.lost == 2);
}

TEST_CASE("the edges of a large model are found in no time", "[constraints]") {
  const mesh::Surface s = scaled(test::sphere(200, 120), 60.0);
  const prepare::Panels panels = test::no_panels(s);
  std::vector<Segment> cut;
  std::vector<Segment> keep;
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    (e.value() % 3 == 0 ? cut : keep).push_back(segment_of(s, e));
  }
  const std::clock_t begin = std::clock();
  const auto [constraints, cuts, keeps] = unfold::match_segments(s, panels, cut, keep, {});
  // 70,000 edges: each with each took 12 s.
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 3.0);
  CHECK(cuts.found == cut.size());
  CHECK(keeps.found == keep.size());
  for (const EdgeId e : ids<EdgeId>(s.edge_count())) {
    if (constraints[e] != (e.value() % 3 == 0 ? EdgeConstraint::cut : EdgeConstraint::keep)) {
      FAIL("edge " << e.value());
    }
  }
}
