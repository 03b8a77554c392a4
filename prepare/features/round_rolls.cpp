// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/round_rolls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "base/id.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/regions.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/rolls.hpp"

namespace ridgecraft::prepare {
namespace {

/// The thickness of paper: a tooth that is less off its rim lies on it. Each side of a rim is one, so smaller
/// sides are more teeth to cut and to glue.
constexpr double round_mm = 0.2;

/// The point at share t of the arc from a to b on the circle through these and c; c lies beyond one of them.
Vec3 on_arc(Vec3 a, Vec3 b, Vec3 c, double t) {
  const Vec3 across = cross(b - a, c - a);
  const double square = dot(across, across);
  const double chord = length(b - a);
  if (!(std::sqrt(square) > 1e-9 * chord * length(c - a))) {
    return a + t * (b - a);
  }
  const Vec3 to_centre =
      (dot(c - a, c - a) * cross(across, b - a) + dot(b - a, b - a) * cross(c - a, across)) / (2.0 * square);
  const Vec3 from = -to_centre;
  const Vec3 to = b - a - to_centre;
  const double angle = elementary::atan2(length(cross(from, to)), dot(from, to));
  const double whole = elementary::sin(angle);
  return a + to_centre + (elementary::sin((1.0 - t) * angle) / whole) * from +
         (elementary::sin(t * angle) / whole) * to;
}

/// Four corners of a rim, the outer ones where there are any: between the inner ones it becomes an arc.
struct Rim {
  std::optional<std::uint32_t> before;
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::optional<std::uint32_t> after;
};

/// A region of a band, from ruling to ruling.
struct Bay {
  std::uint32_t region = 0;
  /// Of either rim its edge, none at a tip; the first rim runs as the region's outline does, the second
  /// against it.
  std::array<EdgeId, 2> edges;
  std::array<std::uint32_t, 2> from{};  ///< points of the first ruling
  std::array<std::uint32_t, 2> to{};
};

class Rounder {
 public:
  Rounder(const mesh::Model& model, const Panels& panels, const SimplifyOptions& options)
      : surface_(model.surface),
        panels_(panels),
        short_edge_mm_(options.short_edge_mm),
        flat_mm_(PanelTolerance{}.distance * surface_.bounds().diagonal()),
        loose_(mesh::take_apart(model)),
        regions_(surface_, panels, loose_),
        columns_(surface_.edge_count()),
        bay_of_(regions_.count()),
        parts_(surface_.edge_count(), 1) {}

  std::size_t run(const Rolls& rolls, mesh::Model& model, const Context& context) {
    for (const Roll& roll : rolls.rolls) {
      add_bays(roll);
    }
    choose_parts();
    std::size_t rulings = place_points();
    while (rulings > 0 && !divide_regions()) {
      context.check();
      const std::size_t before = rulings;
      rulings = place_points();
      if (rulings == before) {
        return 0;
      }
    }
    if (rulings > 0) {
      mesh::put_together(model, std::move(faces_));
    }
    return rulings;
  }

 private:
  [[nodiscard]] Vec3 at(std::uint32_t v) const { return loose_.points[v]; }
  [[nodiscard]] std::uint32_t start(CornerId side) const { return surface_.vertex(side).value(); }
  [[nodiscard]] std::uint32_t end(CornerId side) const { return start(mesh::next(side)); }
  [[nodiscard]] std::uint32_t region(CornerId side) const {
    return regions_.region(mesh::face_of(side).value());
  }

  // What becomes round.

  void add_bays(const Roll& roll) {
    const std::size_t n = roll.rulings.size();
    // Point 0 of each ruling is where the region before it has its start, as the outline runs.
    std::vector<std::array<std::uint32_t, 2>> rulings;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [c, d] = surface_.sides(roll.rulings[i]);
      const CornerId side = panels_.panel[mesh::face_of(c)] == roll.panels[i] ? c : d;
      rulings.push_back({start(side), end(side)});
    }
    for (std::size_t i = 0; i + 1 < n || (roll.closed && i < n); ++i) {
      const auto ruling = [&](std::size_t ahead) -> std::optional<std::array<std::uint32_t, 2>> {
        const std::size_t k = i + ahead;  // counted from the one before
        return roll.closed || (k >= 1 && k <= n) ? std::optional(rulings[(k + n - 1) % n]) : std::nullopt;
      };
      add_bay(roll.panels[(i + 1) % roll.panels.size()], {ruling(0), ruling(1), ruling(2), ruling(3)});
    }
  }

  void add_bay(PanelId panel, const std::array<std::optional<std::array<std::uint32_t, 2>>, 4>& rulings) {
    const std::vector<FaceId>& faces = panels_.faces[panel];
    Bay bay;
    bay.region = regions_.region(faces.front().value());
    bay.from = *rulings[1];
    bay.to = *rulings[2];
    const bool tip = bay.from[0] == bay.to[0] || bay.from[1] == bay.to[1];
    bool whole = faces.size() == (tip ? 1U : 2U) && regions_.faces(bay.region).size() == faces.size();
    for (const std::size_t side : {0U, 1U}) {
      if (bay.from[side] != bay.to[side]) {
        bay.edges[side] = edge_between(faces, bay.from[side], bay.to[side]);
        whole = whole && bay.edges[side].valid();
      }
    }
    for (const std::size_t side : {0U, 1U}) {
      const EdgeId e = bay.edges[side];
      if (!e.valid()) {
        continue;
      }
      const auto point = [&](std::size_t i) {
        return rulings[i] ? std::optional((*rulings[i])[side]) : std::nullopt;
      };
      Rim rim{point(0), bay.from[side], bay.to[side], point(3)};
      if (rim.from > rim.to) {  // as the band on its other side has it
        rim = {rim.after, rim.to, rim.from, rim.before};
      }
      const auto [known, fresh] = rims_.try_emplace(e, rim);
      const Rim& other = known->second;
      if (!whole || (!fresh && (other.before != rim.before || other.after != rim.after))) {
        blocked_.push_back(e);
      }
    }
    if (bay.edges[0].valid() && bay.edges[1].valid()) {
      columns_.join(bay.edges[0].value(), bay.edges[1].value());
    }
    if (whole) {
      bay_of_[bay.region] = bays_.size();
      bays_.push_back(bay);
    }
  }

  [[nodiscard]] EdgeId edge_between(const std::vector<FaceId>& faces, std::uint32_t a,
                                    std::uint32_t b) const {
    for (const FaceId f : faces) {
      for (const unsigned k : {0U, 1U, 2U}) {
        const CornerId side = mesh::corner(f, k);
        if (std::minmax({start(side), end(side)}) == std::minmax({a, b})) {
          return surface_.edge(side);
        }
      }
    }
    return {};
  }

  [[nodiscard]] Vec3 on_rim(const Rim& rim, double t) const {
    const auto arc = [&](std::optional<std::uint32_t> third) {
      return third ? on_arc(at(rim.from), at(rim.to), at(*third), t)
                   : at(rim.from) + t * (at(rim.to) - at(rim.from));
    };
    const double share = !rim.before ? 1.0 : !rim.after ? 0.0 : t;
    return (1.0 - share) * arc(rim.before) + share * arc(rim.after);
  }

  void choose_parts() {
    std::vector<std::uint32_t> wanted(surface_.edge_count(), 1);
    std::vector<std::uint32_t> most(surface_.edge_count(), no_index);
    for (const auto& [e, rim] : rims_) {
      const std::uint32_t column = columns_.find(e.value());
      const double off = length(on_rim(rim, 0.5) - 0.5 * (at(rim.from) + at(rim.to)));
      wanted[column] =
          std::max(wanted[column], static_cast<std::uint32_t>(std::ceil(std::sqrt(off / round_mm) - 1e-6)));
      most[column] =
          std::min(most[column], static_cast<std::uint32_t>(surface_.length(e) / short_edge_mm_ + 1e-6));
    }
    for (const auto& [e, rim] : rims_) {
      const std::uint32_t column = columns_.find(e.value());
      parts_[column] = std::max(1U, std::min(wanted[column], most[column]));
    }
    for (const auto& [e, rim] : rims_) {
      if (!may_be_round(e, rim)) {
        blocked_.push_back(e);
      }
    }
    for (const Bay& bay : bays_) {
      if (!has_flat_parts(bay)) {
        blocked_.push_back(bay.edges[bay.edges[0].valid() ? 0 : 1]);
      }
    }
    block();
  }

  void block() {
    for (const EdgeId e : blocked_) {
      parts_[columns_.find(e.value())] = 1;
    }
    blocked_.clear();
  }

  [[nodiscard]] std::uint32_t parts(EdgeId e) { return parts_[columns_.find(e.value())]; }

  /// Whether what lies on either side of a rim is a region of a band that has it as a rim, or in its plane.
  [[nodiscard]] bool may_be_round(EdgeId e, const Rim& rim) {
    const std::uint32_t n = parts(e);
    for (const CornerId side : surface_.sides(e)) {
      if (!side.valid()) {
        continue;
      }
      const auto bay = bay_of_[region(side)];
      if (bay) {
        const std::array<EdgeId, 2>& own = bays_[*bay].edges;
        if (own[0] != e && own[1] != e) {
          return false;
        }
        continue;
      }
      const Vec3 normal = surface_.normal(mesh::face_of(side));
      for (std::uint32_t k = 1; k < n; ++k) {
        if (std::abs(dot(normal, on_rim(rim, static_cast<double>(k) / n) - at(rim.from))) > flat_mm_) {
          return false;
        }
      }
    }
    return true;
  }

  /// Where the parts of a bay have their corners on one of its rims, from the first ruling to the second.
  [[nodiscard]] Vec3 corner_of(const Bay& bay, std::size_t side, std::uint32_t k, std::uint32_t n) const {
    const EdgeId e = bay.edges[side];
    if (!e.valid() || k == 0 || k == n) {
      return at(k == 0 ? bay.from[side] : bay.to[side]);
    }
    const Rim& rim = rims_.at(e);
    const bool along = rim.from == bay.from[side];
    return on_rim(rim, static_cast<double>(along ? k : n - k) / n);
  }

  [[nodiscard]] bool has_flat_parts(const Bay& bay) {
    const std::uint32_t n = parts(bay.edges[bay.edges[0].valid() ? 0 : 1]);
    if (!bay.edges[0].valid() || !bay.edges[1].valid()) {
      return true;
    }
    for (std::uint32_t k = 0; n > 1 && k < n; ++k) {
      const Vec3 a = corner_of(bay, 0, k, n);
      const Vec3 b = corner_of(bay, 0, k + 1, n);
      const Vec3 c = corner_of(bay, 1, k + 1, n);
      const Vec3 d = corner_of(bay, 1, k, n);
      const Vec3 normal = normalized(cross(c - a, d - b));
      if (std::abs(dot(b - a, normal)) > flat_mm_) {
        return false;
      }
    }
    return true;
  }

  // The new faces.

  /// How many rulings come of it.
  std::size_t place_points() {
    places_ = loose_.points;
    between_.clear();
    std::size_t rulings = 0;
    for (const auto& [e, rim] : rims_) {
      const std::uint32_t n = parts(e);
      std::vector<std::uint32_t>& points = between_[e];
      for (std::uint32_t k = 1; k < n; ++k) {
        points.push_back(static_cast<std::uint32_t>(places_.size()));
        places_.push_back(on_rim(rim, static_cast<double>(k) / n));
      }
    }
    for (const Bay& bay : bays_) {
      rulings += parts(bay.edges[bay.edges[0].valid() ? 0 : 1]) - 1;
    }
    return rulings;
  }

  /// The points that come between those of an edge, in the order from a point of it.
  [[nodiscard]] std::vector<std::uint32_t> points_from(EdgeId e, std::uint32_t from) const {
    const auto found = between_.find(e);
    std::vector<std::uint32_t> points =
        found == between_.end() ? std::vector<std::uint32_t>() : found->second;
    if (!points.empty() && rims_.at(e).from != from) {
      std::reverse(points.begin(), points.end());
    }
    return points;
  }

  bool divide_regions() {
    faces_ = {};
    faces_.points = places_;
    for (std::uint32_t r = 0; r < regions_.count(); ++r) {
      if (bay_of_[r]) {
        divide(bays_[*bay_of_[r]]);
      } else if (!fill(r)) {
        return false;
      }
    }
    return mesh::is_surface(faces_);
  }

  void divide(const Bay& bay) {
    const std::uint32_t first = regions_.faces(bay.region).front();
    std::array<std::vector<std::uint32_t>, 2> rims;
    for (const std::size_t side : {0U, 1U}) {
      rims[side].push_back(bay.from[side]);
      if (bay.edges[side].valid()) {
        const auto between = points_from(bay.edges[side], bay.from[side]);
        rims[side].insert(rims[side].end(), between.begin(), between.end());
        rims[side].push_back(bay.to[side]);
      }
    }
    const std::size_t n = std::max(rims[0].size(), rims[1].size());
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const auto point = [&](std::size_t side, std::size_t i) {
        return rims[side][std::min(i, rims[side].size() - 1)];
      };
      if (rims[0].size() > 1) {
        faces_.add(loose_, first, {point(0, k), point(0, k + 1), point(1, k + 1)});
      }
      if (rims[1].size() > 1) {
        faces_.add(loose_, first, {point(0, k), point(1, k + 1), point(1, k)});
      }
    }
  }

  /// A flat region with the points that came to its outline; where that can't be, its rims stay as they were.
  bool fill(std::uint32_t r) {
    std::vector<OutlineSide> sides;
    std::vector<EdgeId> rims;
    for (const std::uint32_t f : regions_.faces(r)) {
      for (const unsigned k : {0U, 1U, 2U}) {
        const CornerId side = mesh::corner(FaceId(f), k);
        const EdgeId e = surface_.edge(side);
        if (!regions_.on_border(e)) {
          continue;
        }
        std::uint32_t from = start(side);
        for (const std::uint32_t v : points_from(e, from)) {
          sides.push_back({from, v});
          from = v;
          rims.push_back(e);
        }
        sides.push_back({from, end(side)});
      }
    }
    if (rims.empty()) {
      for (const std::uint32_t f : regions_.faces(r)) {
        faces_.add(loose_, f, loose_.faces[f]);
      }
      return true;
    }
    const std::uint32_t first = regions_.faces(r).front();
    const PlaneFrame frame(at(loose_.faces[first][0]), surface_.normal(FaceId(first)));
    const auto triangles = triangles_between(sides, places_, frame);
    if (!triangles || triangles->empty()) {
      blocked_ = rims;
      block();
      return false;
    }
    for (const auto& t : *triangles) {
      faces_.add(loose_, first, t);
    }
    return true;
  }

  const mesh::Surface& surface_;
  const Panels& panels_;
  const double short_edge_mm_;
  const double flat_mm_;
  const mesh::LooseFaces loose_;
  const PanelRegions regions_;
  std::map<EdgeId, Rim> rims_;
  DisjointSets columns_;  ///< of edges: rims with as many parts, as they lie across from each other
  std::vector<Bay> bays_;
  std::vector<std::optional<std::size_t>> bay_of_;  ///< of each region
  std::vector<std::uint32_t> parts_;                ///< of each column
  std::vector<EdgeId> blocked_;
  std::vector<Vec3> places_;
  std::map<EdgeId, std::vector<std::uint32_t>> between_;
  mesh::LooseFaces faces_;
};

}  // namespace

std::size_t round_rolls(mesh::Model& model, const SimplifyOptions& options, const Context& context) {
  const Panels panels = find_panels(model.surface);
  const Rolls rolls = find_rolls(model.surface, panels, options.rolls);
  return rolls.rolls.empty() ? 0 : Rounder(model, panels, options).run(rolls, model, context);
}

}  // namespace ridgecraft::prepare
