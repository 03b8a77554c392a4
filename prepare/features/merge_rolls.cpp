// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/merge_rolls.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/elementary.hpp"
#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/regions.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/panels/ruled_strips.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/rolls.hpp"

namespace ridgecraft::prepare {
namespace {

/// The surface moves by this share of what it may at most, since more is done to it afterwards.
constexpr double moved_by_rings = 0.5;

/// Rings on each other, with equally many points, those of one line across at one place.
struct Stack {
  std::vector<std::vector<std::uint32_t>> rings;  ///< a tip is a ring of one point, many times
  std::vector<std::vector<std::uint32_t>> faces;  ///< between each ring and the next one

  [[nodiscard]] std::size_t around() const { return rings.front().size(); }
};

class Merger {
 public:
  Merger(const mesh::Model& model, const SimplifyOptions& options)
      : surface_(model.surface),
        loose_(mesh::take_apart(model)),
        regions_(surface_, find_panels(surface_), loose_),
        most_mm_(moved_by_rings * options.largest_deviation * surface_.bounds().largest_extent()),
        flat_mm_(PanelTolerance{}.distance * surface_.bounds().diagonal()),
        least_radius_mm_(options.rolls.least_radius_mm),
        gone_(loose_.faces.size(), false) {}

  std::size_t run(mesh::Model& model) {
    std::size_t rings = 0;
    for (const RuledStrip& strip : ruled_strips(surface_, regions_, loose_)) {
      if (strip.loops) {
        rings += merge(stack_of(strip));
      }
    }
    if (rings == 0) {
      return 0;
    }
    mesh::LooseFaces faces;
    faces.points = loose_.points;
    for (std::size_t f = 0; f < gone_.size(); ++f) {
      if (!gone_[f]) {
        faces.add(loose_, f, loose_.faces[f]);
      }
    }
    for (const auto& [corners, like] : fresh_) {
      faces.add(loose_, like, corners);
    }
    if (!mesh::is_surface(faces)) {
      return 0;
    }
    mesh::put_together(model, std::move(faces));
    return rings;
  }

 private:
  [[nodiscard]] Vec3 at(std::uint32_t v) const { return loose_.points[v]; }

  [[nodiscard]] Stack stack_of(const RuledStrip& strip) const {
    Stack stack;
    for (const RulingLine& line : strip.lines) {
      stack.rings.push_back(line.points);
    }
    for (const std::vector<std::uint32_t>& between : strip.regions) {
      std::vector<std::uint32_t>& faces = stack.faces.emplace_back();
      for (const std::uint32_t region : between) {
        faces.insert(faces.end(), regions_.faces(region).begin(), regions_.faces(region).end());
      }
    }
    if (strip.round) {
      stack.rings.push_back(stack.rings.front());
      return stack;
    }
    for (const bool last : {false, true}) {
      const std::vector<std::uint32_t>& ring = last ? stack.rings.back() : stack.rings.front();
      const auto tip = faces_to_tip(ring, last ? stack.faces.back() : stack.faces.front());
      if (tip) {
        const std::uint32_t point = other_corner(tip->front(), ring[0], ring[1]);
        stack.rings.emplace(last ? stack.rings.end() : stack.rings.begin(), ring.size(), point);
        stack.faces.insert(last ? stack.faces.end() : stack.faces.begin(), *tip);
      }
    }
    return stack;
  }

  [[nodiscard]] std::uint32_t other_corner(std::uint32_t face, std::uint32_t a, std::uint32_t b) const {
    const auto& corners = loose_.faces[face];
    return *std::find_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return v != a && v != b; });
  }

  /// The triangles that lead from a ring to one point, on the other side than `behind`; none where others are
  /// there.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> faces_to_tip(
      const std::vector<std::uint32_t>& ring, const std::vector<std::uint32_t>& behind) const {
    std::vector<std::uint32_t> faces;
    for (std::size_t t = 0; t < ring.size(); ++t) {
      const std::uint32_t end = ring[(t + 1) % ring.size()];
      for (const CornerId c : surface_.corners_at(VertexId(ring[t]))) {
        const std::uint32_t f = mesh::face_of(c).value();
        const auto& corners = loose_.faces[f];
        if (std::find(corners.begin(), corners.end(), end) != corners.end() &&
            std::find(behind.begin(), behind.end(), f) == behind.end() && looks_same(f, behind.front()) &&
            regions_.faces(regions_.region(f)).size() == 1) {
          faces.push_back(f);
        }
      }
      if (faces.size() != t + 1 ||
          other_corner(faces[t], ring[t], end) != other_corner(faces[0], ring[0], ring[1])) {
        return std::nullopt;
      }
    }
    return faces;
  }

  [[nodiscard]] bool looks_same(std::uint32_t f, std::uint32_t g) const {
    return (loose_.material.empty() || loose_.material[f] == loose_.material[g]) &&
           (loose_.object.empty() || loose_.object[f] == loose_.object[g]);
  }

  /// Whether paper bends along a ring without a crease, or it is a tip.
  [[nodiscard]] bool is_round(const std::vector<std::uint32_t>& ring) const {
    double length_mm = 0.0;
    for (std::size_t t = 0; t < ring.size(); ++t) {
      const Vec3 before = at(ring[t]) - at(ring[(t + ring.size() - 1) % ring.size()]);
      const Vec3 after = at(ring[(t + 1) % ring.size()]) - at(ring[t]);
      length_mm += length(after);
      if (!(dot(before, after) > elementary::cos(most_roll_bend) * length(before) * length(after))) {
        return ring.front() == ring.back();
      }
    }
    constexpr double two_pi = 6.283185307179586;
    return length_mm >= two_pi * least_radius_mm_;
  }

  /// How far the surface moves where the rings between two go, mm; infinitely where they can't.
  [[nodiscard]] double moved(const Stack& stack, std::size_t i, std::size_t j) const {
    constexpr double too_far = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (std::size_t t = 0; t < stack.around(); ++t) {
      const std::size_t next = (t + 1) % stack.around();
      const Vec3 from = at(stack.rings[i][t]);
      const Vec3 way = at(stack.rings[j][t]) - from;
      for (std::size_t l = i + 1; l < j; ++l) {
        const Vec3 here = at(stack.rings[l][t]);
        const Vec3 before = normalized(here - at(stack.rings[l - 1][t]));
        const Vec3 after = normalized(at(stack.rings[l + 1][t]) - here);
        const double share = std::clamp(dot(here - from, way) / dot(way, way), 0.0, 1.0);
        most = std::max(most, length(here - from - share * way));
        if (most > most_mm_ || !(dot(before, after) > elementary::cos(most_roll_bend))) {
          return too_far;
        }
      }
      const Vec3 side = at(stack.rings[i][next]) - from;
      const Vec3 across = normalized(
          cross(at(stack.rings[j][next]) - from, at(stack.rings[i][next]) - at(stack.rings[j][t])));
      if (std::abs(dot(side, across)) > flat_mm_ || std::abs(dot(way, across)) > flat_mm_) {
        return too_far;
      }
    }
    return most;
  }

  /// Fewest bands first, then those that move the surface least. Returns how many rings go.
  std::size_t merge(const Stack& stack) {
    const std::size_t count = stack.faces.size();
    const bool taken = std::any_of(stack.faces.begin(), stack.faces.end(), [&](const auto& faces) {
      return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return gone_[f]; });
    });
    if (taken) {
      return 0;
    }
    std::vector<double> cost(count + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(count + 1, 0);
    cost[0] = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j <= count; ++j) {
        const double off = j == i + 1 ? 0.0 : moved(stack, i, j);
        if (off > most_mm_ || (j > i + 1 && !(is_round(stack.rings[i]) && is_round(stack.rings[j])))) {
          break;
        }
        const double share = off / most_mm_;
        const double sum = cost[i] + 1.0 + share * share / static_cast<double>(count + 1);
        if (sum < cost[j]) {
          cost[j] = sum;
          from[j] = i;
        }
      }
    }
    std::size_t rings = 0;
    for (std::size_t j = count; j > 0; j = from[j]) {
      if (from[j] + 1 < j) {
        rings += j - from[j] - 1;
        replace(stack, from[j], j);
      }
    }
    return rings;
  }

  /// Whether a face goes from one point to another as its outline runs.
  [[nodiscard]] bool runs(std::uint32_t face, std::uint32_t a, std::uint32_t b) const {
    const auto& v = loose_.faces[face];
    return (v[0] == a && v[1] == b) || (v[1] == a && v[2] == b) || (v[2] == a && v[0] == b);
  }

  void replace(const Stack& stack, std::size_t i, std::size_t j) {
    for (std::size_t between = i; between < j; ++between) {
      for (const std::uint32_t f : stack.faces[between]) {
        gone_[f] = true;
      }
    }
    const std::uint32_t like = stack.faces[i].front();
    // A ring that is no tip tells which way the faces beside it run.
    const bool tip_first = stack.rings[i].front() == stack.rings[i].back();
    const std::vector<std::uint32_t>& told = stack.rings[tip_first ? i + 1 : i];
    const bool ahead = std::any_of(stack.faces[i].begin(), stack.faces[i].end(),
                                   [&](std::uint32_t f) { return runs(f, told[0], told[1]); });
    const std::size_t low = ahead != tip_first ? i : j;
    const std::size_t high = ahead != tip_first ? j : i;
    for (std::size_t t = 0; t < stack.around(); ++t) {
      const std::size_t next = (t + 1) % stack.around();
      const std::uint32_t a = stack.rings[low][t];
      const std::uint32_t b = stack.rings[low][next];
      const std::uint32_t c = stack.rings[high][next];
      const std::uint32_t d = stack.rings[high][t];
      if (a != b) {
        fresh_.push_back({{a, b, c}, like});
      }
      if (c != d) {
        fresh_.push_back({{a, c, d}, like});
      }
    }
  }

  struct Fresh {
    std::array<std::uint32_t, 3> corners{};
    std::uint32_t like = 0;  ///< a face that it takes the place of
  };

  const mesh::Surface& surface_;
  const mesh::LooseFaces loose_;
  const PanelRegions regions_;
  const double most_mm_;
  const double flat_mm_;
  const double least_radius_mm_;
  std::vector<bool> gone_;
  std::vector<Fresh> fresh_;
};

}  // namespace

std::size_t merge_rolls(mesh::Model& model, const SimplifyOptions& options, const Context& context) {
  const std::size_t rings = options.rolls.which == Rolled::never ? 0 : Merger(model, options).run(model);
  if (rings > 0) {
    remesh_panels(model, context);
  }
  return rings;
}

}  // namespace ridgecraft::prepare
