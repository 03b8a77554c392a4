// SPDX-License-Identifier: GPL-3.0-or-later
// What the knife follows, each line once, where gaps are so narrow that their sides are one line.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>

#include "base/elementary.hpp"
#include "unfold/net/outline.hpp"

using namespace ridgecraft;
using unfold::CutLines;

namespace {

constexpr double touch_mm = 0.0105;

/// A strip of 100 x 60 mm with a gap from its upper side down to the middle, `wide` mm at its mouth. The left
/// side of the gap has a corner every `step` mm; all is turned by `angle`.
std::vector<Vec2> strip_with_gap(double wide, double step, double angle) {
  std::vector<Vec2> loop{{0.0, 0.0}, {100.0, 0.0}, {100.0, 60.0}, {50.0 + wide, 60.0}};
  for (double y = 10.0; y <= 60.0; y += step) {
    loop.push_back({50.0, y});
  }
  loop.push_back({0.0, 60.0});
  const double c = elementary::cos(angle);
  const double s = elementary::sin(angle);
  for (Vec2& p : loop) {
    p = {c * p.x - s * p.y, s * p.x + c * p.y};
  }
  return loop;
}

struct CutLine {
  Vec2 a;
  Vec2 b;
};

std::vector<CutLine> lines_of(const CutLines& cuts) {
  std::vector<CutLine> lines;
  for (const auto& loop : cuts.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      lines.push_back({loop[i], loop[(i + 1) % loop.size()]});
    }
  }
  for (const auto& slit : cuts.slits) {
    for (std::size_t i = 1; i < slit.size(); ++i) {
      lines.push_back({slit[i - 1], slit[i]});
    }
  }
  return lines;
}

double distance_from_line(Vec2 p, const CutLine& line) {
  const Vec2 along = line.b - line.a;
  const double t = std::clamp(dot(p - line.a, along) / dot(along, along), 0.0, 1.0);
  return length(p - line.a - t * along);
}

/// Whether some line lies within a hundredth of a millimetre of another one, as long or longer, all along.
bool draws_twice(const std::vector<CutLine>& lines) {
  for (const CutLine& line : lines) {
    for (const CutLine& other : lines) {
      if (&other != &line && length(other.b - other.a) >= length(line.b - line.a) &&
          distance_from_line(line.a, other) <= 0.01 && distance_from_line(line.b, other) <= 0.01) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

TEST_CASE("no line of a narrow gap is drawn twice, and none moves far", "[cuts]") {
  const double angle = GENERATE(0.0, 0.7, 2.0);
  const double step = GENERATE(4.6, 5.0, 11.0);
  const double wide = GENERATE(0.0, 0.03, 0.08, 0.2, 1.0);
  CAPTURE(angle, step, wide);
  const std::vector<Vec2> loop = strip_with_gap(wide, step, angle);
  const CutLines cuts = unfold::arrange_cuts({loop}, touch_mm);
  const std::vector<CutLine> lines = lines_of(cuts);
  CHECK_FALSE(draws_twice(lines));
  for (const Vec2 p : loop) {
    CHECK(std::any_of(lines.begin(), lines.end(),
                      [&](const CutLine& line) { return distance_from_line(p, line) <= touch_mm; }));
  }
  for (const CutLine& line : lines) {
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec2 p = line.a + t * (line.b - line.a);
      double nearest = INFINITY;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        nearest = std::min(nearest, distance_from_line(p, {loop[i], loop[(i + 1) % loop.size()]}));
      }
      CHECK(nearest <= 4.0 * touch_mm);
    }
  }
}

TEST_CASE("corners a hair apart that lie beside each other's lines in turn come to an end", "[cuts]") {
  // In each round one of the places has a slit that is no slit in the next one.
  const CutLines cuts =
      unfold::arrange_cuts({{{0, 0}, {0.00256, 0.01041}, {0.01147, 0}, {1.01147, -1}, {-1, -1}},
                            {{10, 0}, {10.01147, 0}, {11.01147, -1}, {9, -1}},
                            {{10.00256, 0.01041}, {11.00256, 3}, {9.00256, 3}}},
                           0.0105);
  CHECK(cuts.slits.size() < 4);
  double length_of_all = 0.0;
  for (const CutLine& line : lines_of(cuts)) {
    length_of_all += length(line.b - line.a);
  }
  CHECK(length_of_all == Approx(18.02).margin(0.05));
}

TEST_CASE("no line is a slit and a part of a loop", "[cuts]") {
  const CutLines cuts = unfold::arrange_cuts({{{-1, -1},
                                               {1, -1},
                                               {1, .1455},
                                               {.0145, .1455},
                                               {.0039, .0691},
                                               {.0034, .041},
                                               {0, 0},
                                               {.0011, .0611},
                                               {.0026, .1353},
                                               {0, .1455},
                                               {-1, .1455}}},
                                             0.0105);
  std::vector<CutLine> lines = lines_of(cuts);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      CHECK_FALSE(((lines[i].a == lines[k].a && lines[i].b == lines[k].b) ||
                   (lines[i].a == lines[k].b && lines[i].b == lines[k].a)));
    }
  }
}
