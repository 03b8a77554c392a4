// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/bands.hpp"

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
/// No corner along a strip of triangles turns its rim by more, radians: about 20 degrees. More is a zigzag,
/// which nobody would cut out for a strip.
constexpr double most_rim_turn = 0.35;
/// Nor is one of its rungs so many times as long as another: else it is a strip by chance.
constexpr double most_uneven = 1.7;
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

/// A side of a region's outline: the region's angle where it begins, and whether the outline turns there.
struct OutlineSide {
  std::uint32_t side = 0;
  double angle = 0.0;
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
    outline.push_back({next, angle, turn > least_turn});
    side = next;
  } while (side != start);
  return convex ? outline : std::vector<OutlineSide>();
}

/// What the outline of a region with three or four corners has between two of them: sides in a straight line.
struct Flank {
  std::vector<std::uint32_t> sides;  ///< counterclockwise
  std::uint32_t region = 0;
  std::uint32_t next = no_index;      ///< flanks of the region around the end
  std::uint32_t previous = no_index;  ///< and around the start
  double start_angle = 0.0;           ///< the region's where the flank begins, radians
  double end_angle = 0.0;
  double length_mm = 0.0;
};

/// The flanks of all such regions, and for each side that one begins with, which it is; nothing for others.
struct Regions {
  std::vector<Flank> flanks;
  std::vector<std::uint32_t> begins;
  std::uint32_t count = 0;

  /// In a region of four flanks the one opposite, else nothing.
  [[nodiscard]] std::uint32_t across(std::uint32_t flank) const {
    const std::uint32_t next = flanks[flanks[flank].next].next;
    const std::uint32_t previous = flanks[flanks[flank].previous].previous;
    return next == previous ? next : no_index;
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
  const auto corners = static_cast<std::uint32_t>(
      std::count_if(outline.begin(), outline.end(), [](const auto& at) { return at.at_corner; }));
  if (corners != 3 && corners != 4) {
    return;
  }
  std::rotate(outline.begin(),
              std::find_if(outline.begin(), outline.end(), [](const auto& at) { return at.at_corner; }),
              outline.end());
  const auto first = static_cast<std::uint32_t>(regions.flanks.size());
  for (const OutlineSide& at : outline) {
    if (at.at_corner) {
      const auto k = static_cast<std::uint32_t>(regions.flanks.size()) - first;
      regions.begins[at.side] = first + k;
      regions.flanks.push_back({{},
                                regions.count,
                                first + (k + 1) % corners,
                                first + (k + corners - 1) % corners,
                                at.angle,
                                0.0,
                                0.0});
    }
    regions.flanks.back().sides.push_back(at.side);
    regions.flanks.back().length_mm += patch.length[at.side];
  }
  for (std::uint32_t k = first; k < first + corners; ++k) {
    regions.flanks[k].end_angle = regions.flanks[regions.flanks[k].next].start_angle;
  }
  ++regions.count;
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

/// The corners along one rim of a strip, and what its regions leave of a straight angle there.
class Rim {
 public:
  void add(double angle) { angle_.back() += angle; }
  void next_corner(double angle) { angle_.push_back(angle); }
  /// After the last corner of a ring has turned out to be the first.
  void close() {
    if (angle_.size() > 1) {
      angle_.front() += angle_.back();
      angle_.pop_back();
    }
  }
  [[nodiscard]] bool calm() const {
    return std::all_of(angle_.begin(), angle_.end(),
                       [](double angle) { return std::abs(std::numbers::pi - angle) < most_rim_turn; });
  }

 private:
  std::vector<double> angle_{0.0};
};

/// A band: the flanks over which one passes along it, and how long its rims are.
struct Strip {
  std::vector<std::uint32_t> rungs;
  std::vector<std::uint32_t> regions;
  double mean_rung_mm = 0.0;
  double rims_mm = 0.0;    ///< both
  std::size_t halves = 0;  ///< triangles, and twice the regions of four flanks
  bool closed = true;
};

/// Strips are followed from rung to rung: through a region of four flanks to the one across, through one of
/// three to the left and to the right by turns, as between two polygons, or where walls of four were halved.
class StripWalk {
 public:
  StripWalk(const Patch& patch, const Regions& regions)
      : patch_(patch), regions_(regions), seen_(2 * regions.flanks.size(), 0), walk_(regions.count, 0) {}

  /// The band over this rung, the first triangle being left to the right or not; nothing where the strip
  /// ends, is too short to be one, or would be ragged, and where it was followed before.
  std::optional<Strip> ring_over(std::uint32_t start, bool right) {
    ++walks_;
    Strip ring;
    Rim left_rim;
    Rim right_rim;
    bool once = true;
    bool triangles = false;
    const bool right_first = right;
    std::uint32_t at = start;
    do {
      const Flank& rung = regions_.flanks[at];
      std::uint8_t& seen = seen_[2 * at + (right ? 1 : 0)];
      if (seen != 0) {
        return std::nullopt;
      }
      seen = 1;
      once = once && walk_[rung.region] != walks_;
      walk_[rung.region] = walks_;
      ring.rungs.push_back(at);
      ring.regions.push_back(rung.region);
      ring.mean_rung_mm += rung.length_mm;
      const std::uint32_t across = regions_.across(at);
      const bool four = across != no_index;
      const std::uint32_t out = four ? across : right ? rung.next : rung.previous;
      const Flank& exit = regions_.flanks[out];
      left_rim.add(rung.start_angle);
      right_rim.add(rung.end_angle);
      if (four || right) {
        left_rim.next_corner(exit.end_angle);
        ring.rims_mm += regions_.flanks[rung.previous].length_mm;
      }
      if (four || !right) {
        right_rim.next_corner(exit.start_angle);
        ring.rims_mm += regions_.flanks[rung.next].length_mm;
      }
      ring.halves += four ? 2 : 1;
      triangles = triangles || !four;
      right = four ? right : !right;
      at = regions_.beyond(patch_, out);
    } while (at != no_index && (at != start || right != right_first));
    left_rim.close();
    right_rim.close();
    if (at == no_index || !once || ring.halves < 2 * fewest_regions ||
        (triangles && !(left_rim.calm() && right_rim.calm() && even(ring.rungs)))) {
      return std::nullopt;
    }
    ring.mean_rung_mm /= static_cast<double>(ring.rungs.size());
    return ring;
  }

  /// The strip of regions of four flanks that begins behind this one, if it goes round far enough, though
  /// something stands in its way, such as a handle: all rungs bend the same way, by open_turn in all.
  std::optional<Strip> strip_from(std::uint32_t start) {
    if (regions_.across(start) == no_index || leads_on(start)) {
      return std::nullopt;
    }
    Strip strip;
    strip.closed = false;
    double turn = 0.0;
    std::uint32_t at = start;
    while (true) {
      const Flank& entry = regions_.flanks[at];
      strip.rims_mm += regions_.flanks[entry.previous].length_mm + regions_.flanks[entry.next].length_mm;
      strip.halves += 2;
      strip.regions.push_back(entry.region);
      const std::uint32_t out = regions_.across(at);
      if (!leads_on(out)) {
        break;
      }
      const double bend = patch_.fold_angle[regions_.flanks[out].sides.front()];
      if (bend * turn < 0.0) {
        return std::nullopt;
      }
      turn += bend;
      at = regions_.beyond(patch_, out);
      strip.rungs.push_back(at);
      strip.mean_rung_mm += regions_.flanks[at].length_mm;
    }
    if (strip.halves < 2 * fewest_regions || std::abs(turn) < open_turn) {
      return std::nullopt;
    }
    strip.mean_rung_mm /= static_cast<double>(strip.rungs.size());
    return strip;
  }

 private:
  [[nodiscard]] bool even(const std::vector<std::uint32_t>& rungs) const {
    const auto length = [&](std::uint32_t rung) { return regions_.flanks[rung].length_mm; };
    const auto [shortest, longest] = std::minmax_element(
        rungs.begin(), rungs.end(), [&](std::uint32_t a, std::uint32_t b) { return length(a) < length(b); });
    return length(*longest) <= most_uneven * length(*shortest);
  }

  /// Whether a strip goes on over this flank, into another region of four.
  [[nodiscard]] bool leads_on(std::uint32_t flank) const {
    const std::uint32_t other = regions_.beyond(patch_, flank);
    return other != no_index && regions_.across(other) != no_index;
  }

  const Patch& patch_;
  const Regions& regions_;
  std::vector<std::uint8_t> seen_;   ///< per flank, to the left and to the right
  std::vector<std::uint32_t> walk_;  ///< per region: which walk came through it last
  std::uint32_t walks_ = 0;
};

}  // namespace

Bands find_bands(const Patch& patch) {
  const Regions regions = find_regions(patch);
  StripWalk walk(patch, regions);
  std::vector<Strip> strips;
  for (std::uint32_t flank = 0; flank < regions.flanks.size(); ++flank) {
    for (const bool right : {true, false}) {
      if (std::optional<Strip> ring = walk.ring_over(flank, right)) {
        strips.push_back(std::move(*ring));
      }
    }
    if (std::optional<Strip> strip = walk.strip_from(flank)) {
      strips.push_back(std::move(*strip));
    }
  }
  std::stable_sort(strips.begin(), strips.end(),
                   [](const Strip& a, const Strip& b) { return a.mean_rung_mm > b.mean_rung_mm; });
  Bands bands;
  bands.band.assign(patch.twin.size(), no_index);
  std::vector<std::uint8_t> taken(regions.count, 0);
  for (const Strip& strip : strips) {
    if (std::any_of(strip.regions.begin(), strip.regions.end(),
                    [&](std::uint32_t region) { return taken[region] != 0; })) {
      continue;
    }
    for (const std::uint32_t region : strip.regions) {
      taken[region] = 1;
    }
    const auto number = static_cast<std::uint32_t>(bands.seam_mm.size());
    double longest = 0.0;
    for (const std::uint32_t rung : strip.rungs) {
      for (const std::uint32_t side : regions.flanks[rung].sides) {
        bands.band[side] = bands.band[patch.twin[side]] = number;
      }
      longest = std::max(longest, regions.flanks[rung].length_mm);
    }
    bands.seam_mm.push_back(strip.closed ? longest : 0.0);
    bands.closed.push_back(strip.closed ? 1 : 0);
    bands.mean_rung_mm.push_back(strip.mean_rung_mm);
    bands.mean_rim_mm.push_back(strip.rims_mm / static_cast<double>(strip.halves));
  }
  return bands;
}

}  // namespace ridgecraft::unfold
