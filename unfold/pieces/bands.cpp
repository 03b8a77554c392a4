// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/bands.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "base/elementary.hpp"

namespace ridgecraft::unfold {
namespace {

/// Fewer regions make a box rather than a wall that goes round: it has no seam of its own.
constexpr std::size_t fewest_regions = 5;
/// A corner of a region turns its outline by as much, radians: about 6 degrees.
constexpr double least_turn = 0.1;
/// A strip with two ends goes round when its rungs bend by so much in all, radians: half of a wall that goes
/// all the way.
constexpr double open_turn = 3.1;

bool inside_region(const Patch& patch, std::uint32_t side) {
  return patch.twin[side] != no_index && patch.frozen[side] == frozen_in_panel;
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

/// What the outline of a region with four corners has between two of them: sides in a straight line.
struct Flank {
  std::vector<std::uint32_t> sides;  ///< counterclockwise
  double length_mm = 0.0;
};

/// The four flanks of one region after those of the other, counterclockwise.
struct Regions {
  std::vector<Flank> flanks;
  std::vector<std::uint32_t> begins;  ///< per side: the flank that it begins; nothing for others

  [[nodiscard]] static std::uint32_t across(std::uint32_t flank) { return flank ^ 2U; }
  /// What a region has of both rims, over whose flank a strip comes in, mm.
  [[nodiscard]] double rims_mm(std::uint32_t flank) const {
    return flanks[flank ^ 1U].length_mm + flanks[flank ^ 3U].length_mm;
  }
  /// The flank of the region beyond that is made of the same edges; nothing where there is none.
  [[nodiscard]] std::uint32_t beyond(const Patch& patch, std::uint32_t flank) const {
    const std::vector<std::uint32_t>& sides = flanks[flank].sides;
    const std::uint32_t first = patch.twin[sides.back()];
    const std::uint32_t other = first == no_index ? no_index : begins[first];
    const bool same =
        other != no_index &&
        std::equal(sides.rbegin(), sides.rend(), flanks[other].sides.begin(), flanks[other].sides.end(),
                   [&](std::uint32_t s, std::uint32_t t) { return patch.twin[s] == t; });
    return same ? other : no_index;
  }
};

void add_region(const Patch& patch, std::vector<OutlineSide> outline, Regions& regions) {
  const auto at_corner = [](const OutlineSide& at) { return at.at_corner; };
  if (std::count_if(outline.begin(), outline.end(), at_corner) != 4) {
    return;
  }
  std::rotate(outline.begin(), std::find_if(outline.begin(), outline.end(), at_corner), outline.end());
  for (const OutlineSide& at : outline) {
    if (at.at_corner) {
      regions.begins[at.side] = static_cast<std::uint32_t>(regions.flanks.size());
      regions.flanks.emplace_back();
    }
    regions.flanks.back().sides.push_back(at.side);
    regions.flanks.back().length_mm += patch.length[at.side];
  }
}

Regions find_regions(const Patch& patch) {
  Regions regions;
  regions.begins.assign(patch.twin.size(), no_index);
  std::vector<std::uint8_t> seen(patch.twin.size(), 0);
  for (std::uint32_t start = 0; start < patch.twin.size(); ++start) {
    if (seen[start] != 0 || inside_region(patch, start)) {
      continue;
    }
    std::vector<OutlineSide> outline = outline_from(patch, start);
    seen[start] = 1;
    for (const OutlineSide& at : outline) {
      seen[at.side] = 1;
    }
    add_region(patch, std::move(outline), regions);
  }
  return regions;
}

/// The flanks over which a strip comes into its regions; of one with two ends the first isn't a rung.
struct Strip {
  std::vector<std::uint32_t> entries;
  bool closed = false;
};

class StripFinder {
 public:
  StripFinder(const Patch& patch, const Regions& regions) : patch_(patch), regions_(regions) {}

  /// All strips that are bands, each in both directions. What has two ends comes before what goes round:
  /// rings are what is left.
  std::vector<Strip> find() {
    const auto count = static_cast<std::uint32_t>(regions_.flanks.size());
    std::vector<std::uint8_t> seen(count, 0);
    std::vector<Strip> strips;
    for (const bool from_ends : {true, false}) {
      for (std::uint32_t flank = 0; flank < count; ++flank) {
        if (seen[flank] != 0 || (from_ends && regions_.beyond(patch_, flank) != no_index)) {
          continue;
        }
        Strip strip = strip_over(flank);
        for (const std::uint32_t entry : strip.entries) {
          seen[entry] = 1;
        }
        if (is_band(strip)) {
          strips.push_back(std::move(strip));
        }
      }
    }
    return strips;
  }

 private:
  [[nodiscard]] Strip strip_over(std::uint32_t start) const {
    Strip strip{{start}};
    while (true) {
      const std::uint32_t next = regions_.beyond(patch_, Regions::across(strip.entries.back()));
      strip.closed = next == start;
      if (next == no_index || next == start) {
        return strip;
      }
      strip.entries.push_back(next);
    }
  }

  [[nodiscard]] bool is_band(const Strip& strip) const {
    std::vector<std::uint32_t> regions;
    for (const std::uint32_t entry : strip.entries) {
      regions.push_back(entry / 4);
    }
    std::sort(regions.begin(), regions.end());
    const bool once = std::adjacent_find(regions.begin(), regions.end()) == regions.end();
    return once && regions.size() >= fewest_regions && (strip.closed || goes_round(strip));
  }

  /// Whether something stands in the way of a wall that goes round, such as a handle: all rungs bend the same
  /// way, by open_turn in all.
  [[nodiscard]] bool goes_round(const Strip& strip) const {
    double turn = 0.0;
    for (std::size_t i = 1; i < strip.entries.size(); ++i) {
      const double bend = patch_.fold_angle[regions_.flanks[strip.entries[i]].sides.front()];
      if (bend * turn < 0.0) {
        return false;
      }
      turn += bend;
    }
    return std::abs(turn) >= open_turn;
  }

  const Patch& patch_;
  const Regions& regions_;
};

Band band_of(const Strip& strip, const Regions& regions) {
  Band band;
  band.closed = strip.closed;
  std::size_t rungs = 0;
  for (std::size_t i = 0; i < strip.entries.size(); ++i) {
    band.mean_rim_mm += regions.rims_mm(strip.entries[i]);
    if (i > 0 || strip.closed) {
      const Flank& rung = regions.flanks[strip.entries[i]];
      band.rungs.insert(band.rungs.end(), rung.sides.begin(), rung.sides.end());
      band.mean_rung_mm += rung.length_mm;
      ++rungs;
    }
  }
  band.mean_rung_mm /= static_cast<double>(rungs);
  band.mean_rim_mm /= 2.0 * static_cast<double>(strip.entries.size());
  return band;
}

}  // namespace

std::vector<Band> find_bands(const Patch& patch) {
  const Regions regions = find_regions(patch);
  std::vector<std::pair<Band, Strip>> all;
  for (Strip& strip : StripFinder(patch, regions).find()) {
    Band band = band_of(strip, regions);
    all.emplace_back(std::move(band), std::move(strip));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first.mean_rung_mm > b.first.mean_rung_mm; });
  std::vector<Band> bands;
  std::vector<std::uint8_t> taken(regions.flanks.size() / 4, 0);
  for (auto& [band, strip] : all) {
    const bool free = std::none_of(strip.entries.begin(), strip.entries.end(),
                                   [&taken](std::uint32_t entry) { return taken[entry / 4] != 0; });
    if (free) {
      for (const std::uint32_t entry : strip.entries) {
        taken[entry / 4] = 1;
      }
      bands.push_back(std::move(band));
    }
  }
  return bands;
}

}  // namespace ridgecraft::unfold
