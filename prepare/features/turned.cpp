// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/turned.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "mesh/model/faces_alone.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/symmetry/area_frame.hpp"
#include "prepare/walls/fold_figures.hpp"

namespace ridgecraft::prepare {
namespace {

/// With fewer sides a body is a prism by intention.
constexpr std::uint32_t fewest_sides = 12;
/// What is left of a round body at least.
constexpr std::uint32_t fewest_left = 6;
/// More sides nobody folds; larger numbers needn't be tried.
constexpr std::uint32_t most_left = 96;
/// How far points may be from their places on a ring, as a share of the component's extent: as rounding by a
/// program that writes few digits leaves them; and where rings lie closer than that, as a float does.
constexpr std::array<double, 2> on_ring{2e-4, 2e-6};
/// The outline between rings that are left out bends by these shares of what the surface may move.
constexpr std::array<double, 5> outline_shares{0.0, 0.1, 0.25, 0.5, 0.75};
/// Bodies of more faces have crowded edges (simplify/body.cpp).
constexpr std::size_t crowded_faces = 400;

constexpr std::uint32_t none = mesh::Soup::none;

struct Ring {
  double radius = 0.0;  ///< 0: one point on the axis
  double height = 0.0;
  std::vector<VertexId> vertices;  ///< in turn around the axis
};

/// What lies between a ring and the next one, or within a ring that has a flat end.
struct Strip {
  FaceId like;  ///< one of its faces
  std::size_t faces = 0;
  double radial = 0.0;  ///< sums over its faces: of their normals' parts away from the axis ...
  double axial = 0.0;   ///< ... and along it
};

/// A body as its outline and an axis.
struct Turned {
  Vec3 centre, axis, across, beside;  ///< right-handed: axis, across, beside
  double phase = 0.0;                 ///< angle of corner 0 of each ring
  std::uint32_t sides = 0;
  std::vector<Ring> rings;  ///< along the outline
  std::vector<Strip>
      strips;  ///< from each ring to the next; of a closed outline also from the last to the first
  bool closed = false;
  std::optional<Strip> first_end, last_end;  ///< flat ends at the first and the last ring
  bool inwards = false;                      ///< faces made ring by ring would look inwards

  [[nodiscard]] Vec3 place(const Ring& ring, double angle) const {
    return centre + ring.height * axis +
           ring.radius * (elementary::cos(angle) * across + elementary::sin(angle) * beside);
  }
};

/// Finds out whether a component was turned about one of its principal axes.
class Recogniser {
 public:
  Recogniser(const mesh::Model& model, const std::vector<FaceId>& faces)
      : model_(model), surface_(model.surface), faces_(faces), vertices_(vertices_of(surface_, faces)) {
    for (const VertexId v : vertices_) {
      box_.add(surface_.point(v));
    }
  }

  [[nodiscard]] std::optional<Turned> find() {
    if (vertices_.size() < 2 * fewest_sides) {
      return std::nullopt;
    }
    const AreaFrame frame = faces_.size() == surface_.face_count()
                                ? area_frame(surface_)
                                : area_frame(mesh::faces_alone(surface_, faces_));
    for (std::size_t k = 0; k < 3; ++k) {
      Turned about;
      about.centre = frame.centre;
      about.axis = frame.axes[k];
      about.across = frame.axes[(k + 1) % 3];
      about.beside = cross(about.axis, about.across);
      find_heights(about);
      for (const double share : on_ring) {
        near_ = share * box_.largest_extent();
        result_ = about;
        if (starts_with_rings() && find_rings() && find_strips() && put_in_order()) {
          return std::move(result_);
        }
      }
    }
    return std::nullopt;
  }

 private:
  /// A vertex in the order of its height or radius; equal ones in the order of their numbers.
  struct Placed {
    double at = 0.0;
    std::uint32_t number = 0;  ///< in vertices_

    friend bool operator<(const Placed& a, const Placed& b) {
      return std::pair(a.at, a.number) < std::pair(b.at, b.number);
    }
  };

  /// Ascending numbers, each once. O(n log n).
  static std::vector<VertexId> vertices_of(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
    std::vector<VertexId> result;
    if (faces.size() == surface.face_count()) {
      for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
        if (!surface.corners_at(v).empty()) {
          result.push_back(v);
        }
      }
      return result;
    }
    for (const FaceId f : faces) {
      const auto vertices = surface.vertices(f);
      result.insert(result.end(), vertices.begin(), vertices.end());
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  void find_heights(const Turned& about) {
    heights_.clear();
    for (const VertexId v : vertices_) {
      heights_.push_back(dot(surface_.point(v) - about.centre, about.axis));
    }
  }
  [[nodiscard]] double radius_of(std::uint32_t number) const {
    const Vec3 p = surface_.point(vertices_[number]) - result_.centre;
    return length(p - heights_[number] * result_.axis);
  }

  /// The end of what lies within the tolerance of its first one.
  [[nodiscard]] std::size_t level_end(const std::vector<Placed>& order, std::size_t from) const {
    std::size_t end = from + 1;
    while (end < order.size() && order[end].at - order[from].at <= 2.0 * near_) {
      ++end;
    }
    return end;
  }

  /// Whether the two lowest levels are rings or tips: nearly all bodies that weren't turned fail here, before
  /// anything is put in order. O(n).
  [[nodiscard]] bool starts_with_rings() {
    rings_.clear();
    double above = -INFINITY;
    for (int level = 0; level < 2; ++level) {
      double lowest = INFINITY;
      for (const double height : heights_) {
        lowest = height > above ? std::min(lowest, height) : lowest;
      }
      std::vector<Placed> members;
      for (std::uint32_t i = 0; i < heights_.size(); ++i) {
        if (heights_[i] > above && heights_[i] - lowest <= 2.0 * near_) {
          members.push_back({heights_[i], i});
        }
      }
      if (!add_level(members)) {
        return false;
      }
      for (const Placed& member : members) {
        above = std::max(above, member.at);
      }
    }
    result_.sides = 0;
    return true;
  }

  [[nodiscard]] bool find_rings() {
    rings_.clear();
    std::vector<Placed> order(vertices_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      order[i] = {heights_[i], i};
    }
    std::sort(order.begin(), order.end());
    for (std::size_t from = 0; from < order.size();) {
      const std::size_t end = level_end(order, from);
      if (!add_level({order.begin() + static_cast<std::ptrdiff_t>(from),
                      order.begin() + static_cast<std::ptrdiff_t>(end)})) {
        return false;
      }
      from = end;
    }
    return result_.sides >= fewest_sides && rings_.size() > 1;
  }

  /// Rings of one height, within each other.
  [[nodiscard]] bool add_level(std::vector<Placed> level) {
    for (Placed& member : level) {
      member.at = radius_of(member.number);
    }
    std::sort(level.begin(), level.end());
    for (std::size_t from = 0; from < level.size();) {
      const std::size_t end = level_end(level, from);
      if (!add_ring(std::span(level).subspan(from, end - from))) {
        return false;
      }
      from = end;
    }
    return true;
  }

  /// `members`: in the order of their radii.
  [[nodiscard]] bool add_ring(std::span<const Placed> members) {
    Ring ring;
    for (const Placed& member : members) {
      ring.height += heights_[member.number] / static_cast<double>(members.size());
      ring.radius += member.at / static_cast<double>(members.size());
    }
    if (ring.radius <= near_) {
      ring.radius = 0.0;
      ring.vertices.push_back(vertices_[members.front().number]);
      rings_.push_back(std::move(ring));
      return members.size() == 1;
    }
    const auto sides = static_cast<std::uint32_t>(members.size());
    if (result_.sides == 0) {
      result_.sides = sides;
      result_.phase = angle_of(vertices_[members.front().number]);
    }
    if (sides != result_.sides || sides < fewest_sides) {
      return false;
    }
    ring.vertices.assign(sides, VertexId());
    for (const Placed& member : members) {
      const VertexId v = vertices_[member.number];
      const double turn = (angle_of(v) - result_.phase) * sides / (2.0 * std::numbers::pi);
      const auto k = static_cast<std::int64_t>(std::llround(turn));
      const double off =
          std::abs(turn - static_cast<double>(k)) * 2.0 * std::numbers::pi / sides * ring.radius;
      VertexId& place = ring.vertices[static_cast<std::size_t>((k % sides + sides) % sides)];
      if (off > near_ || place.valid()) {
        return false;
      }
      place = v;
    }
    rings_.push_back(std::move(ring));
    return true;
  }

  [[nodiscard]] double angle_of(VertexId v) const {
    const Vec3 p = surface_.point(v) - result_.centre;
    return elementary::atan2(dot(p, result_.beside), dot(p, result_.across));
  }

  /// Each face lies between two rings or within one.
  [[nodiscard]] bool find_strips() {
    strips_.clear();
    const auto number = [&](VertexId v) {
      return static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) -
                                      vertices_.begin());
    };
    std::vector<std::uint32_t> ring_of(vertices_.size());
    for (std::uint32_t r = 0; r < rings_.size(); ++r) {
      for (const VertexId v : rings_[r].vertices) {
        ring_of[number(v)] = r;
      }
    }
    for (const FaceId f : faces_) {
      const auto vertices = surface_.vertices(f);
      std::array<std::uint32_t, 3> ring{ring_of[number(vertices[0])], ring_of[number(vertices[1])],
                                        ring_of[number(vertices[2])]};
      std::sort(ring.begin(), ring.end());
      if (ring[0] != ring[1] && ring[1] != ring[2]) {
        return false;
      }
      Strip& strip = strips_[{ring[0], ring[2]}];
      strip.like = strip.faces == 0 ? f : strip.like;
      if (!same_look(strip.like, f)) {
        return false;
      }
      ++strip.faces;
      const Vec3 middle =
          (surface_.point(vertices[0]) + surface_.point(vertices[1]) + surface_.point(vertices[2])) / 3.0 -
          result_.centre;
      const Vec3 out = middle - dot(middle, result_.axis) * result_.axis;
      strip.radial += surface_.area(f) * dot(surface_.normal(f), normalized(out));
      strip.axial += surface_.area(f) * dot(surface_.normal(f), result_.axis);
    }
    return std::all_of(strips_.begin(), strips_.end(), [&](const auto& entry) {
      const auto& [between, strip] = entry;
      const std::size_t sides = result_.sides;
      if (between.first == between.second) {
        return strip.faces == sides - 2;
      }
      const bool tip = rings_[between.first].radius == 0.0 || rings_[between.second].radius == 0.0;
      return strip.faces == (tip ? sides : 2 * sides);
    });
  }

  [[nodiscard]] bool same_look(FaceId a, FaceId b) const {
    return (model_.material.empty() || model_.material[a] == model_.material[b]) &&
           (model_.object.empty() || model_.object[a] == model_.object[b]);
  }

  /// The rings along the outline: a line or a circle of strips.
  [[nodiscard]] bool put_in_order() {
    std::vector<std::vector<std::uint32_t>> next(rings_.size());
    std::map<std::uint32_t, Strip> ends;
    for (const auto& [between, strip] : strips_) {
      if (between.first == between.second) {
        ends[between.first] = strip;
      } else {
        next[between.first].push_back(between.second);
        next[between.second].push_back(between.first);
      }
    }
    std::uint32_t start = 0;
    for (std::uint32_t r = 0; r < rings_.size(); ++r) {
      const std::size_t neighbours = next[r].size() + (ends.contains(r) ? 1U : 0U);
      if (neighbours > 2 || next[r].empty()) {
        return false;
      }
      start = next[r].size() == 1 ? r : start;
    }
    result_.closed = next[start].size() == 2;
    std::uint32_t before = none;
    std::uint32_t here = start;
    do {
      result_.rings.push_back(rings_[here]);
      const auto onward =
          std::find_if(next[here].begin(), next[here].end(), [&](std::uint32_t r) { return r != before; });
      if (onward == next[here].end()) {
        break;
      }
      before = here;
      here = *onward;
      result_.strips.push_back(strips_.at(std::minmax(before, here)));
    } while (here != start);
    if (result_.rings.size() != rings_.size()) {
      return false;
    }
    if (!result_.closed) {
      result_.first_end = ends.contains(start) ? std::optional(ends[start]) : std::nullopt;
      result_.last_end = ends.contains(here) ? std::optional(ends[here]) : std::nullopt;
    }
    // A strip that is made from a ring to the next looks out of the axis where the outline goes up.
    const Ring& a = result_.rings[0];
    const Ring& b = result_.rings[1 % result_.rings.size()];
    const Strip& strip = result_.strips.front();
    result_.inwards = strip.radial * (b.height - a.height) - strip.axial * (b.radius - a.radius) < 0.0;
    return true;
  }

  const mesh::Model& model_;
  const mesh::Surface& surface_;
  const std::vector<FaceId>& faces_;
  std::vector<VertexId> vertices_;
  std::vector<double> heights_;  ///< of each along the axis that is tried
  Box3 box_;
  double near_ = 0.0;
  Turned result_;
  std::vector<Ring> rings_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Strip> strips_;
};

/// Faces of a body with other numbers of rings and sides.
struct Made {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<FaceId> like;  ///< of each face: what it has taken the place of
};

/// Which rings stay where the outline may bend by this much (D. Douglas, T. Peucker, 1973); those at which
/// the look changes always do.
class Outline {
 public:
  Outline(const Turned& body, const mesh::Model& model, double bend) : body_(body), bend_(bend) {
    const std::size_t n = body.rings.size();
    stays_.assign(n, bend <= 0.0);
    std::vector<std::size_t> fixed;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == 0 || (!body.closed && i + 1 == n) || look_changes(model, i)) {
        fixed.push_back(i);
      }
    }
    if (body.closed && fixed.size() < 2) {
      // What is farthest from the first one.
      std::size_t farthest = 0;
      for (std::size_t i = 1; i < n; ++i) {
        farthest = distance(0, i) > distance(0, farthest) ? i : farthest;
      }
      fixed.push_back(farthest);
    }
    for (const std::size_t i : fixed) {
      stays_[i] = true;
    }
    for (std::size_t k = 0; k < fixed.size(); ++k) {
      if (k + 1 < fixed.size() || body.closed) {
        thin_out(fixed[k], k + 1 < fixed.size() ? fixed[k + 1] : fixed[0] + n);
      }
    }
  }

  [[nodiscard]] std::vector<std::size_t> rings() const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < stays_.size(); ++i) {
      if (stays_[i]) {
        result.push_back(i);
      }
    }
    return result;
  }

 private:
  [[nodiscard]] Vec2 at(std::size_t i) const {
    const Ring& ring = body_.rings[i % body_.rings.size()];
    return {ring.radius, ring.height};
  }
  [[nodiscard]] double distance(std::size_t i, std::size_t k) const { return length(at(k) - at(i)); }

  [[nodiscard]] bool look_changes(const mesh::Model& model, std::size_t i) const {
    const std::size_t n = body_.strips.size();
    if (i == 0 && !body_.closed) {
      return false;
    }
    const FaceId before = body_.strips[(i + n - 1) % n].like;
    const FaceId after = body_.strips[i % n].like;
    return (!model.material.empty() && model.material[before] != model.material[after]) ||
           (!model.object.empty() && model.object[before] != model.object[after]);
  }

  void thin_out(std::size_t from, std::size_t to) {
    std::size_t farthest = from;
    double most = bend_;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vec2 way = at(to) - at(from);
      const double size = length(way);
      const double off = size > 0.0 ? std::abs(cross(way, at(i) - at(from))) / size : distance(from, i);
      if (off > most) {
        most = off;
        farthest = i;
      }
    }
    if (farthest != from) {
      stays_[farthest % stays_.size()] = true;
      thin_out(from, farthest);
      thin_out(farthest, to);
    }
  }

  const Turned& body_;
  double bend_;
  std::vector<bool> stays_;
};

Made turn(const Turned& body, const std::vector<std::size_t>& rings, std::uint32_t sides) {
  Made made;
  std::vector<std::uint32_t> first;
  for (const std::size_t r : rings) {
    const Ring& ring = body.rings[r];
    first.push_back(static_cast<std::uint32_t>(made.points.size()));
    for (std::uint32_t k = 0; k < (ring.radius > 0.0 ? sides : 1U); ++k) {
      made.points.push_back(body.place(ring, body.phase + 2.0 * std::numbers::pi * k / sides));
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, FaceId like) {
    if (a != b && b != c && c != a) {
      made.faces.push_back({a, body.inwards ? c : b, body.inwards ? b : c});
      made.like.push_back(like);
    }
  };
  const std::size_t strips = body.closed ? rings.size() : rings.size() - 1;
  for (std::size_t i = 0; i < strips; ++i) {
    const std::size_t j = (i + 1) % rings.size();
    const auto corner = [&](std::size_t ring, std::uint32_t k) {
      return first[ring] + (body.rings[rings[ring]].radius > 0.0 ? k % sides : 0U);
    };
    for (std::uint32_t k = 0; k < sides; ++k) {
      const FaceId like = body.strips[rings[i]].like;
      add(corner(i, k), corner(i, k + 1), corner(j, k + 1), like);
      add(corner(i, k), corner(j, k + 1), corner(j, k), like);
    }
  }
  for (std::uint32_t k = 2; k < sides; ++k) {
    if (body.first_end) {
      const std::uint32_t f = first.front();
      add(f, f + k, f + k - 1, body.first_end->like);
    }
    if (body.last_end) {
      const std::uint32_t f = first.back();
      add(f, f + k - 1, f + k, body.last_end->like);
    }
  }
  return made;
}

mesh::Surface surface_of(const Made& made) {
  std::vector<std::array<VertexId, 3>> faces;
  for (const auto& [a, b, c] : made.faces) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  }
  return {made.points, std::move(faces)};
}

class Chooser {
 public:
  Chooser(const Turned& body, const mesh::Model& model, const SimplifyOptions& options, double largest_mm,
          const Context& context)
      : body_(body), model_(model), options_(options), largest_mm_(largest_mm), context_(context) {}

  /// The most faces that can be folded.
  [[nodiscard]] std::optional<Made> choose() const {
    double widest = 0.0;
    for (const Ring& ring : body_.rings) {
      widest = std::max(widest, ring.radius);
    }
    // Mirror planes stay.
    const std::uint32_t step = std::gcd(body_.sides, 4U);
    std::optional<Made> best;
    for (const double share : outline_shares) {
      const double bend = share * largest_mm_;
      const std::vector<std::size_t> rings = Outline(body_, model_, bend).rings();
      if (rings.size() < (body_.closed ? 3U : 2U)) {
        continue;
      }
      for (std::uint32_t sides = std::min(body_.sides, most_left / step * step); sides >= fewest_left;
           sides -= step) {
        context_.check();
        const double sagitta = widest * (1.0 - elementary::cos(std::numbers::pi / sides));
        if (sagitta + bend > largest_mm_ || (best && 2 * rings.size() * sides <= best->faces.size())) {
          break;
        }
        Made made = turn(body_, rings, sides);
        if (can_be_folded(made)) {
          if (!best || made.faces.size() > best->faces.size()) {
            best = std::move(made);
          }
          break;
        }
      }
    }
    return best;
  }

 private:
  [[nodiscard]] bool can_be_folded(const Made& made) const {
    if (made.faces.size() > options_.most_faces || made.faces.size() < std::size_t{2} * fewest_left) {
      return false;
    }
    const FoldFigures figures = fold_figures(surface_of(made), options_);
    return figures.brief_share() <= options_.short_edge_share &&
           (made.faces.size() <= crowded_faces || !figures.crowded());
  }

  const Turned& body_;
  const mesh::Model& model_;
  const SimplifyOptions& options_;
  double largest_mm_;
  const Context& context_;
};

std::vector<std::vector<FaceId>> faces_of_components(const mesh::Surface& surface) {
  std::vector<std::vector<FaceId>> faces(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces[surface.component(f).value()].push_back(f);
  }
  return faces;
}

}  // namespace

Turning turn_bodies(const mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                    const Context& context) {
  const mesh::Surface& surface = model.surface;
  const std::vector<std::vector<FaceId>> components = faces_of_components(surface);
  Turning turning;
  std::vector<std::optional<Made>> made(components.size());
  for (std::size_t c = 0; c < components.size(); ++c) {
    const std::vector<FaceId>& faces = components[c];
    context.check();
    const std::optional<Turned> body = Recogniser(model, faces).find();
    if (!body) {
      continue;
    }
    ++turning.found;
    const FoldFigures figures = fold_figures(mesh::faces_alone(surface, faces), options);
    if (figures.brief_share() > options.short_edge_share || faces.size() > options.most_faces) {
      made[c] = Chooser(*body, model, options, largest_mm, context).choose();
    }
    if (made[c] && made[c]->faces.size() >= faces.size()) {
      made[c].reset();
    }
    turning.changed += made[c] ? 1U : 0U;
  }
  if (turning.changed == 0) {
    return turning;
  }
  const mesh::LooseFaces all = mesh::take_apart(model);
  mesh::LooseFaces& result = turning.faces;
  result.points = all.points;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (!made[c]) {
      for (const FaceId f : components[c]) {
        result.add(all, f.value(), all.faces[f.value()]);
      }
      continue;
    }
    const auto first = static_cast<std::uint32_t>(result.points.size());
    result.points.insert(result.points.end(), made[c]->points.begin(), made[c]->points.end());
    for (std::size_t i = 0; i < made[c]->faces.size(); ++i) {
      const auto& [p, q, r] = made[c]->faces[i];
      result.add(all, made[c]->like[i].value(), {first + p, first + q, first + r});
      result.polygon.back() = none;
    }
  }
  return turning;
}

std::size_t simplify_turned(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                            const Context& context) {
  Turning turning = turn_bodies(model, options, largest_mm, context);
  if (turning.changed > 0) {
    mesh::put_together(model, std::move(turning.faces));
    remesh_panels(model, context);
  }
  return turning.changed;
}

}  // namespace ridgecraft::prepare
