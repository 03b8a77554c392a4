// SPDX-License-Identifier: GPL-3.0-or-later
// What a beam needs beside the outlines: room for itself, and lines in gaps that are narrower than it is.
// Held against the definition: wherever the knife was to go, the beam passes.
#include "export/machine/kerf.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "export/machine/marks.hpp"
#include "export/machine/operations.hpp"
#include "loops_area.hpp"
#include "machine_pages.hpp"
#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using test::loops_area;
using Loops = std::vector<std::vector<Vec2>>;

double perimeter(const Loops& loops) {
  double sum = 0.0;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sum += length(loop[(i + 1) % loop.size()] - loop[i]);
    }
  }
  return sum;
}

double distance_to(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double t = std::clamp(dot(p - a, along) / std::max(dot(along, along), 1e-30), 0.0, 1.0);
  return length(p - (a + t * along));
}

double distance_to(Vec2 p, const export_::CutPaths& paths) {
  double least = 1e9;
  for (const auto& loop : paths.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      least = std::min(least, distance_to(p, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  for (const auto& line : paths.lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      least = std::min(least, distance_to(p, line[i - 1], line[i]));
    }
  }
  return least;
}

/// The farthest that a point of the loops is from what is cut.
double farthest(const Loops& loops, const export_::CutPaths& paths) {
  double most = 0.0;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      const int steps = std::max(1, static_cast<int>(length(b - a) / 0.1));
      for (int k = 0; k <= steps; ++k) {
        most = std::max(most, distance_to(a + (static_cast<double>(k) / steps) * (b - a), paths));
      }
    }
  }
  return most;
}

/// How far a beam of this kerf along the paths reaches into the paper beyond the loops, at points along the
/// moved loops: these lie half a kerf outside.
void check_outside(const Loops& loops, const export_::CutPaths& paths, double kerf) {
  const export_::CutPaths given{loops, {}};
  for (const auto& loop : paths.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      for (const double share : {0.0, 0.3, 0.7}) {
        const Vec2 p = loop[i] + share * (loop[(i + 1) % loop.size()] - loop[i]);
        CHECK(distance_to(p, given) > 0.5 * kerf - 1e-3);
      }
    }
  }
}

/// A square with a wedge of this opening (degrees) cut into it, 30 mm deep.
Loops with_wedge(double degrees) {
  const double half = 30.0 * std::tan(0.5 * degrees * std::numbers::pi / 180.0);
  return {{{0, 0}, {50, 0}, {50, 40}, {25 + half, 40}, {25, 10}, {25 - half, 40}, {0, 40}}};
}

}  // namespace

TEST_CASE("a frame and its hole are moved apart by half of the kerf each") {
  const Loops frame{{{0, 0}, {60, 0}, {60, 40}, {0, 40}}, {{20, 10}, {20, 30}, {40, 30}, {40, 10}}};
  const export_::CutPaths cut = export_::with_kerf(frame, 0.2);
  REQUIRE(cut.loops.size() == 2);
  CHECK(cut.lines.empty());
  CHECK(0.5 * doubled_area(cut.loops[0]) == Approx(60.2 * 40.2));
  CHECK(0.5 * doubled_area(cut.loops[1]) == Approx(-19.8 * 19.8));
  CHECK(export_::with_kerf(frame, 0.0).loops == frame);
}

TEST_CASE("the tip of a wedge is reached, however narrow it is") {
  for (const double degrees : {0.5, 1.0, 3.0, 10.0, 30.0, 59.0, 75.0}) {
    for (const double kerf : {0.08, 0.1, 0.2, 0.5}) {
      CAPTURE(degrees, kerf);
      const Loops piece = with_wedge(degrees);
      const export_::CutPaths cut = export_::with_kerf(piece, kerf);
      CHECK(farthest(piece, cut) < 0.5 * kerf + 0.05 + 1e-6);
      check_outside(piece, cut, kerf);
      const double bridged = 0.5 * kerf / std::sin(0.5 * degrees * std::numbers::pi / 180.0);
      if (bridged > 0.5 * kerf + 0.06) {
        REQUIRE(cut.lines.size() == 1);
        double to_tip = 1e9;
        for (const Vec2 p : cut.lines[0]) {
          to_tip = std::min(to_tip, length(p - Vec2{25, 10}));
        }
        CHECK(to_tip < 1e-4);
      }
    }
  }
}

TEST_CASE("a gap that is narrow in its middle alone is cut there, and what it encloses stays a hole") {
  // A keyhole: a mouth of 0.06 mm, 5 mm long, before a chamber of 10 x 10.
  const Loops piece{{{0, 0},
                     {40, 0},
                     {40, 30},
                     {20.03, 30},
                     {20.03, 25},
                     {25, 25},
                     {25, 15},
                     {15, 15},
                     {15, 25},
                     {19.97, 25},
                     {19.97, 30},
                     {0, 30}}};
  const export_::CutPaths cut = export_::with_kerf(piece, 0.2);
  CHECK(cut.loops.size() == 2);
  CHECK(cut.lines.size() == 1);
  CHECK(farthest(piece, cut) < 0.15);
}

TEST_CASE("a spike is cut off at the kerf and not beyond") {
  const Loops needle{{{0, 0}, {40, 0.5}, {0, 1}}};
  const export_::CutPaths cut = export_::with_kerf(needle, 0.2);
  REQUIRE(cut.loops.size() == 1);
  double most = 0.0;
  for (const Vec2 p : cut.loops[0]) {
    most = std::max(most, p.x);
  }
  CHECK(most == Approx(40.2).margin(1e-3));
  check_outside(needle, cut, 0.2);
}

TEST_CASE("stars of all kinds are cut out whole") {
  Random random(7);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    Loops star(1);
    const int count = 5 + static_cast<int>(random.below(60));
    for (int i = 0; i < count; ++i) {
      const double turn = 2.0 * std::numbers::pi * (i + 0.3 * random.unit()) / count;
      const double radius = i % 2 == 0 ? 10.0 + 20.0 * random.unit() : 2.0 + 10.0 * random.unit();
      star[0].push_back(Vec2{100, 50} + radius * Vec2{std::cos(turn), std::sin(turn)});
    }
    const double kerf = 0.05 + 0.4 * random.unit();
    const export_::CutPaths cut = export_::with_kerf(star, kerf);
    CHECK(farthest(star, cut) < 0.5 * kerf + 0.05 + 1e-6);
    check_outside(star, cut, kerf);
    CHECK(loops_area(cut.loops) > loops_area(star));
    // Each corner adds a mitre of no more than 4 half kerfs squared, gaps add what they hold.
    CHECK(loops_area(cut.loops) < loops_area(star) + 0.5 * kerf * perimeter(star) + count * kerf * kerf);
  }
}

TEST_CASE("with a kerf folds stay, outlines grow, and every cut of a page is made") {
  for (const export_::Drawing& page : test::pages_for_machines()) {
    const auto drawn = export_::machine_paths(page, {.engraves = false});
    const auto cut = export_::machine_paths(page, {.engraves = false, .kerf_mm = 0.2});
    export_::CutPaths all;
    Loops loops;
    std::vector<export_::Path> folds;
    for (const export_::Path& path : cut) {
      if (path.operation < export_::Operation::cut_inner) {
        folds.push_back(path);
      } else if (path.closed) {
        all.loops.push_back(path.points);
      } else {
        all.lines.push_back(path.points);
      }
    }
    std::size_t fold = 0;
    for (const export_::Path& path : drawn) {
      if (path.operation < export_::Operation::cut_inner) {
        REQUIRE(fold < folds.size());
        CHECK(folds[fold++].points == path.points);
      } else if (path.closed) {
        loops.push_back(path.points);
      }
    }
    // Points within 0.05 mm of each other are one in machine files, before and after.
    CHECK(farthest(loops, all) < 0.1 + 0.05 + 0.06);
    CHECK(loops_area(all.loops) > loops_area(loops));
  }
}

TEST_CASE(
    "the test piece is 20 mm wide with a hole of 10, on the first page that has room, else on its own") {
  const test::SamplePages sample = test::sample_pages(test::cube(), 40.0, 5.0);
  std::vector<export_::Drawing> pages = export_::draw({sample.model, sample.nets, sample.pages}, {});
  const std::size_t count = pages.size();
  export_::add_kerf_test(pages, sample.pages.paper);
  REQUIRE(pages.size() == count);
  std::vector<std::vector<Vec2>> found;
  for (const export_::Path& path : export_::machine_paths(pages[0], {.engraves = false})) {
    const double size = std::abs(0.5 * doubled_area(path.points));
    if (path.closed && (size == Approx(400.0) || size == Approx(100.0))) {
      found.push_back(path.points);
    }
  }
  CHECK(found.size() == 2);
  std::vector<export_::Drawing> none;
  export_::add_kerf_test(none, export_::Paper{});
  CHECK(none.size() == 1);
}

}  // namespace ridgecraft
