// SPDX-License-Identifier: GPL-3.0-or-later
// Borders move where a part has no single net.
#include "unfold/pieces/moved_borders.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "bench/spiky_bodies.hpp"
#include "support/shapes.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/plan.hpp"
#include "unfold/unfold.hpp"
#include "unfold/unfolded_parts.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;

namespace {

struct Case {
  mesh::Surface surface;
  prepare::Panels panels;
  IdVector<FaceId, PartId> part;
};

/// Parts by the height of the faces' middles.
IdVector<FaceId, PartId> slices(const mesh::Surface& s, std::uint32_t count) {
  const auto height = [&](FaceId f) {
    const auto [a, b, c] = s.vertices(f);
    return (s.point(a).z + s.point(b).z + s.point(c).z) / 3.0;
  };
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    low = std::min(low, height(f));
    high = std::max(high, height(f));
  }
  IdVector<FaceId, PartId> part(s.face_count());
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    const double share = 0.999 * (height(f) - low) / (high - low);
    part[f] = PartId(static_cast<std::uint32_t>(share * count));
  }
  return part;
}

std::vector<Case> cases() {
  std::vector<Case> cases;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const mesh::Surface ball = bench::spiky_ball(0, 14, 5.0, seed);
    const mesh::Surface box = bench::spiky_box(1, 1, 2, 18, 6.0, seed);
    for (const mesh::Surface& s : {ball, box}) {
      cases.push_back({s, test::no_panels(s), slices(s, 2)});
      cases.push_back({s, test::no_panels(s), slices(s, 3)});
    }
  }
  return cases;
}

std::size_t for_overlap(const Causes& causes) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < causes.size(); ++f) {
    const bool overlaps = causes[f].reason == PieceReason::overlap || causes[f].reason == PieceReason::no_net;
    count += overlaps && causes[f].piece == f ? 1U : 0U;
  }
  return count;
}

Options options_with(std::optional<Sheet> sheet, std::size_t max_panels) {
  Options options;
  options.sheet = sheet;
  options.pieces = rules_of(PieceMode::parts);
  options.pieces.max_panels = max_panels;
  options.pieces.weights.pieces = 10'000.0;  // whatever saves a piece is worth it
  return options;
}

}  // namespace

TEST_CASE("borders that move save pieces, and nets stay clean and fit", "[borders][slow]") {
  std::size_t surplus = 0;
  std::size_t saved = 0;
  for (const Case& c : cases()) {
    for (const Options& options : {options_with({}, 0), options_with(Sheet{400.0, 300.0}, 40)}) {
      const Asked asked{c.surface, c.panels, c.part, options};
      const Plan plan = make_plan(asked, {});
      const Patch patch = whole_patch(asked, plan);
      const UnfoldedParts parts = unfold_parts(asked, plan, {});
      std::vector<PieceReason> cause;
      for (const Cause& why : parts.causes) {
        cause.push_back(why.reason);
      }
      const auto moved = [&] {
        return move_borders({c.surface, plan.whole, patch, c.part.items(), options, plan.room}, parts.folds,
                            cause, {});
      };
      const MovedBorders result = moved();
      const Layout before = lay_out(patch, parts.folds);
      const Layout after = lay_out(patch, result.folds);
      CHECK(after.faces.size() + result.parts.size() == before.faces.size());
      CHECK(find_overlaps(after, net_tolerance(patch.extent)).empty());
      CHECK((all_fit(patch, result.folds, plan.room) || !all_fit(patch, parts.folds, plan.room)));
      CHECK(moved().folds == result.folds);
      surplus += for_overlap(parts.causes);
      saved += result.parts.size();
    }
  }
  INFO(saved << " of " << surplus);
  CHECK(surplus > 5);
  CHECK(2 * saved > surplus);
}

TEST_CASE("of a part whose border moved nothing is told that was so before", "[borders][slow]") {
  const std::string moved = ": moving the border with its neighbours saved pieces";
  std::size_t told = 0;
  for (const Case& c : cases()) {
    Options options = options_with({}, 0);
    options.pieces.merge = true;
    const Nets nets = unfold::unfold(c.surface, c.panels, c.part, options, Context());
    for (const std::string& note : nets.notes) {
      const std::size_t at = note.find(moved);
      if (at == std::string::npos) {
        continue;
      }
      ++told;
      const std::string begin = note.substr(0, at) + ": no single net";
      CHECK(std::none_of(nets.notes.begin(), nets.notes.end(),
                         [&](const std::string& other) { return other.starts_with(begin); }));
    }
  }
  CHECK(told > 0);
}

TEST_CASE("a piece that isn't worth what its faces cost elsewhere stays", "[borders][slow]") {
  const auto pieces_with = [](double weight) {
    std::size_t pieces = 0;
    for (const Case& c : cases()) {
      Options options = options_with({}, 0);
      options.pieces.weights.pieces = weight;
      const Asked asked{c.surface, c.panels, c.part, options};
      const Plan plan = make_plan(asked, {});
      const Patch patch = whole_patch(asked, plan);
      const UnfoldedParts parts = unfold_parts(asked, plan, {});
      std::vector<PieceReason> cause;
      for (const Cause& why : parts.causes) {
        cause.push_back(why.reason);
      }
      const MovedBorders moved = move_borders(
          {c.surface, plan.whole, patch, c.part.items(), options, plan.room}, parts.folds, cause, {});
      pieces += lay_out(patch, moved.folds).faces.size();
    }
    return pieces;
  };
  CHECK(pieces_with(0.0) > pieces_with(10'000.0));
}

TEST_CASE("a surface without a part too many stays as it is", "[borders]") {
  const mesh::Surface ball = test::scaled(test::sphere(10, 6), 40.0);
  const prepare::Panels panels = test::no_panels(ball);
  const IdVector<FaceId, PartId> part = slices(ball, 3);
  const Options options = options_with({}, 0);
  const Asked asked{ball, panels, part, options};
  const Plan plan = make_plan(asked, {});
  const Patch patch = whole_patch(asked, plan);
  const UnfoldedParts parts = unfold_parts(asked, plan, {});
  REQUIRE(for_overlap(parts.causes) == 0);
  const std::vector<PieceReason> cause(patch.size(), PieceReason::part);
  const MovedBorders result =
      move_borders({ball, plan.whole, patch, part.items(), options, plan.room}, parts.folds, cause, {});
  CHECK(result.parts.empty());
  CHECK(result.folds == parts.folds);
}

TEST_CASE("borders move until parts have no piece that is mostly their own", "[borders]") {
  const mesh::Surface ball = bench::spiky_ball(1, 80, 3.0, 1);
  const prepare::Panels panels = test::no_panels(ball);
  for (const std::uint32_t run : {3U, 7U}) {
    // Faces whose numbers follow each other: connected for short stretches, so parts have pieces too many.
    IdVector<FaceId, PartId> part(ball.face_count());
    for (const FaceId f : ids<FaceId>(ball.face_count())) {
      part[f] = PartId(f.value() / run % 30);
    }
    const Options options = options_with({}, 0);
    const Asked asked{ball, panels, part, options};
    const Plan plan = make_plan(asked, {});
    const Patch patch = whole_patch(asked, plan);
    const UnfoldedParts parts = unfold_parts(asked, plan, {});
    const std::vector<PieceReason> cause(patch.size(), PieceReason::overlap);
    const MovedBorders result =
        move_borders({ball, plan.whole, patch, part.items(), options, plan.room}, parts.folds, cause, {});
    const Layout after = lay_out(patch, result.folds);
    CHECK(after.faces.size() + result.parts.size() == lay_out(patch, parts.folds).faces.size());
    CHECK(find_overlaps(after, net_tolerance(patch.extent)).empty());
  }
}
