// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/bands.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include "base/elementary.hpp"

namespace ridgecraft::unfold {
namespace {

/// Fewer regions make a box rather than a wall that goes round: it has no seam of its own.
constexpr std::size_t fewest_regions = 5;
/// A corner of a region turns its outline by as much, radians: about 6 degrees.
constexpr double least_turn = 0.1;

bool inside_region(const Patch& patch, std::uint32_t side) {
  return patch.twin[side] != nothing && patch.frozen[side] == frozen_in_panel;
}

double corner_angle(const Patch& patch, std::uint32_t side) {
  const Triangle& t = patch.shape[side / 3];
  const Vec2 a = t[(side + 1) % 3] - t[side % 3];
  const Vec2 b = t[(side + 2) % 3] - t[side % 3];
  return elementary::atan2(cross(a, b), dot(a, b));
}

/// A side of a region's outline, and whether the outline turns where it begins.
struct OutlineSide {
  std::uint32_t side = 0;
  bool at_corner = false;
};

/// The outline of a region from one of its sides on, counterclockwise; concave corners make it useless, and
/// empty.
std::vector<OutlineSide> outline_from(const Patch& patch, std::uint32_t start) {
  std::vector<OutlineSide> outline;
  bool convex = true;
  std::uint32_t side = start;
  do {
    std::uint32_t next = next_side(side);
    double angle = corner_angle(patch, next);
    while (inside_region(patch, next)) {
      next = next_side(patch.twin[next]);
      angle += corner_angle(patch, next);
    }
    const double turn = std::numbers::pi - angle;
    convex = convex && turn > -least_turn;
    outline.push_back({next, turn > least_turn});
    side = next;
  } while (side != start);
  return convex ? outline : std::vector<OutlineSide>();
}

/// What lies opposite to a side in its region, and which region that is.
struct Opposites {
  std::vector<std::uint32_t> side;    ///< per side; nothing where there is none
  std::vector<std::uint32_t> region;  ///< per side of an outline: any number of its region's own
};

Opposites find_opposites(const Patch& patch) {
  Opposites result{std::vector<std::uint32_t>(patch.twin.size(), nothing),
                   std::vector<std::uint32_t>(patch.twin.size(), nothing)};
  std::vector<std::uint8_t> seen(patch.twin.size(), 0);
  for (std::uint32_t start = 0; start < patch.twin.size(); ++start) {
    if (seen[start] != 0 || inside_region(patch, start)) {
      continue;
    }
    std::vector<OutlineSide> outline = outline_from(patch, start);
    seen[start] = 1;
    for (const OutlineSide& at : outline) {
      seen[at.side] = 1;
      result.region[at.side] = start;
    }
    const auto corners =
        std::count_if(outline.begin(), outline.end(), [](const auto& at) { return at.at_corner; });
    if (corners != 4) {
      continue;
    }
    std::rotate(outline.begin(),
                std::find_if(outline.begin(), outline.end(), [](const auto& at) { return at.at_corner; }),
                outline.end());
    std::array<std::vector<std::uint32_t>, 4> sides;
    std::size_t k = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      k += i > 0 && outline[i].at_corner ? 1U : 0U;
      sides[k].push_back(outline[i].side);
    }
    for (const std::size_t one : {0U, 1U}) {
      if (sides[one].size() == 1 && sides[one + 2].size() == 1) {
        result.side[sides[one][0]] = sides[one + 2][0];
        result.side[sides[one + 2][0]] = sides[one][0];
      }
    }
  }
  return result;
}

/// The rungs of the band over this one; empty where the strip ends, or is too short to be one.
std::vector<std::uint32_t> ring_over(const Patch& patch, const Opposites& opposites, std::uint32_t start) {
  std::vector<std::uint32_t> rungs;
  std::uint32_t side = start;
  do {
    rungs.push_back(side);
    side = opposites.side[side];
    side = side == nothing ? nothing : patch.twin[side];
  } while (side != nothing && side != start && rungs.size() <= patch.size());
  return side == start && rungs.size() >= fewest_regions ? rungs : std::vector<std::uint32_t>();
}

double mean_length(const Patch& patch, const std::vector<std::uint32_t>& rungs) {
  double sum = 0.0;
  for (const std::uint32_t side : rungs) {
    sum += patch.length[side];
  }
  return sum / static_cast<double>(rungs.size());
}

}  // namespace

Bands find_bands(const Patch& patch) {
  const Opposites opposites = find_opposites(patch);
  std::vector<std::vector<std::uint32_t>> rings;
  std::vector<std::uint8_t> seen(patch.twin.size(), 0);
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (seen[side] == 0 && opposites.side[side] != nothing) {
      std::vector<std::uint32_t> rungs = ring_over(patch, opposites, side);
      for (const std::uint32_t rung : rungs) {
        seen[rung] = seen[patch.twin[rung]] = 1;
      }
      if (!rungs.empty()) {
        rings.push_back(std::move(rungs));
      }
    }
  }
  std::stable_sort(rings.begin(), rings.end(), [&](const auto& a, const auto& b) {
    return mean_length(patch, a) > mean_length(patch, b);
  });
  Bands bands{std::vector<std::uint32_t>(patch.twin.size(), nothing), {}};
  std::vector<std::uint8_t> taken(patch.twin.size(), 0);  // per region
  for (const std::vector<std::uint32_t>& rungs : rings) {
    if (std::any_of(rungs.begin(), rungs.end(),
                    [&](std::uint32_t s) { return taken[opposites.region[s]] != 0; })) {
      continue;
    }
    double longest = 0.0;
    for (const std::uint32_t rung : rungs) {
      taken[opposites.region[rung]] = 1;
      bands.band[rung] = bands.band[patch.twin[rung]] = static_cast<std::uint32_t>(bands.rung_mm.size());
      longest = std::max(longest, patch.length[rung]);
    }
    bands.rung_mm.push_back(longest);
  }
  return bands;
}

}  // namespace ridgecraft::unfold
