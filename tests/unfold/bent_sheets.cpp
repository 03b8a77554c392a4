// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/bent_sheets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace ridgecraft::test {

mesh::Surface bent_sheet(const std::vector<Vec2>& profile, double width) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (const Vec2 p : profile) {
    points.push_back({p.x, p.y, 0.0});
    points.push_back({p.x, p.y, width});
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto at = [&](std::size_t k) { return VertexId(2 * i + k); };
    faces.push_back({at(0), at(2), at(3)});
    faces.push_back({at(0), at(3), at(1)});
  }
  return {std::move(points), std::move(faces)};
}

bool crosses(const std::vector<Vec2>& profile, const std::vector<double>& share, double shortened) {
  std::vector<std::array<Vec2, 2>> stretches;
  Vec2 at{};
  double heading = 0.0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 along = profile[i + 1] - profile[i];
    if (i > 0) {
      const Vec2 before = profile[i] - profile[i - 1];
      heading += share[i] * std::atan2(cross(before, along), dot(before, along));
    }
    const Vec2 way{std::cos(heading), std::sin(heading)};
    const Vec2 end = at + length(along) * way;
    stretches.push_back({at + shortened * way, end - shortened * way});
    at = end;
  }
  const auto side = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); };
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (std::size_t j = i + 2; j < stretches.size(); ++j) {
      const auto& [a, b] = stretches[i];
      const auto& [c, d] = stretches[j];
      // Stretches on one line are on no side of each other but for rounding.
      constexpr double rounding = -1e-9;
      if (side(a, b, c) * side(a, b, d) < rounding && side(c, d, a) * side(c, d, b) < rounding) {
        return true;
      }
    }
  }
  return false;
}

std::vector<Vec2> random_profile(Random& random) {
  std::vector<Vec2> profile{{0.0, 0.0}};
  double heading = 0.0;
  for (int i = 0; i < 14; ++i) {
    const double reach = 10.0 + 60.0 * random.unit();
    profile.push_back(profile.back() + reach * Vec2{std::cos(heading), std::sin(heading)});
    if (i > 1 && crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)) {
      profile.pop_back();
      break;
    }
    heading += (random.below(3) == 0 ? -1.0 : 1.0) * (0.5 + 2.0 * random.unit());
  }
  return profile;
}

std::vector<Vec2> random_hooks(Random& random) {
  std::vector<Vec2> profile{{30, 20}, {30, 30}, {10, 30}, {10, 10}, {0, 10},
                            {0, 40},  {60, 40}, {60, 24}, {20, 24}, {20, 10}};
  for (Vec2& p : profile) {
    p += Vec2{12.0 * random.unit() - 6.0, 12.0 * random.unit() - 6.0};
  }
  const std::size_t length = 6 + random.below(5);
  profile.resize(std::min(length, profile.size()));
  return crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)
             ? std::vector<Vec2>{{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}}
             : profile;
}

std::vector<Vec2> random_spiral(Random& random) {
  for (;;) {
    std::vector<Vec2> profile{{0.0, 0.0}};
    double heading = 0.0;
    const double to_and_fro = random.unit();
    for (int i = 0; i < 7; ++i) {
      const double reach = 8.0 + 40.0 * random.unit();
      profile.push_back(profile.back() + reach * Vec2{std::cos(heading), std::sin(heading)});
      heading += (random.unit() < to_and_fro ? -1.0 : 1.0) * (0.9 + 1.8 * random.unit());
    }
    if (!crosses(profile, std::vector<double>(profile.size(), 1.0), -1.0)) {
      return profile;
    }
  }
}

bool crosses_together(const std::vector<Vec2>& profile, double shortened) {
  for (int sample = 1; sample < samples; ++sample) {
    const double share = static_cast<double>(sample) / samples;
    if (crosses(profile, std::vector<double>(profile.size(), share), shortened)) {
      return true;
    }
  }
  return false;
}

bool crosses_in_order(const std::vector<Vec2>& profile, const std::vector<std::size_t>& joints,
                      double shortened) {
  std::vector<double> share(profile.size(), 0.0);
  for (const std::size_t joint : joints) {
    for (int sample = 1; sample <= samples; ++sample) {
      share[joint] = static_cast<double>(sample) / samples;
      if (crosses(profile, share, shortened)) {
        return true;
      }
    }
  }
  return false;
}

bool any_order_works(const std::vector<Vec2>& profile, double shortened) {
  std::vector<std::size_t> joints(profile.size() - 2);
  std::iota(joints.begin(), joints.end(), std::size_t{1});
  do {
    if (!crosses_in_order(profile, joints, shortened)) {
      return true;
    }
  } while (std::next_permutation(joints.begin(), joints.end()));
  return false;
}

std::vector<std::size_t> joints_of(const mesh::Surface& sheet, const unfold::FoldOrder& folding) {
  std::vector<std::size_t> joints;
  for (const auto& step : folding.steps) {
    joints.push_back(sheet.vertex(step.front()).value() / 2);
  }
  return joints;
}

}  // namespace ridgecraft::test
