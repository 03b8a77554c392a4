// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies: their mass, their files, and what a cage does to the points in it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/order.hpp"
#include "solid/cover.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

void add(Moments& sum, const Body& body) {
  for (const auto& [i, j, k] : body.triangles) {
    const Vec3 a = body.points[i];
    const Vec3 b = body.points[j];
    const Vec3 c = body.points[k];
    const double volume = dot(a, cross(b, c)) / 6.0;
    const Vec3 s = a + b + c;
    sum.volume += volume;
    sum.first = sum.first + (0.25 * volume) * s;
    // Integral of x_i x_j over the tetrahedron of the origin, a, b, c.
    const auto moment = [&](double ai, double bi, double ci, double si, double aj, double bj, double cj,
                            double sj) { return volume / 20.0 * (ai * aj + bi * bj + ci * cj + si * sj); };
    sum.second[0] += moment(a.x, b.x, c.x, s.x, a.x, b.x, c.x, s.x);
    sum.second[1] += moment(a.y, b.y, c.y, s.y, a.y, b.y, c.y, s.y);
    sum.second[2] += moment(a.z, b.z, c.z, s.z, a.z, b.z, c.z, s.z);
    sum.second[3] += moment(a.x, b.x, c.x, s.x, a.y, b.y, c.y, s.y);
    sum.second[4] += moment(a.x, b.x, c.x, s.x, a.z, b.z, c.z, s.z);
    sum.second[5] += moment(a.y, b.y, c.y, s.y, a.z, b.z, c.z, s.z);
  }
}

MassProperties from_moments(const Moments& m) {
  MassProperties result;
  result.volume = m.volume;
  if (!(m.volume > 0.0)) {
    return result;
  }
  const Vec3 c = (1.0 / m.volume) * m.first;
  const double xx = m.second[0] - m.volume * c.x * c.x;
  const double yy = m.second[1] - m.volume * c.y * c.y;
  const double zz = m.second[2] - m.volume * c.z * c.z;
  result.center = c;
  result.inertia = {yy + zz,
                    xx + zz,
                    xx + yy,
                    m.volume * c.x * c.y - m.second[3],
                    m.volume * c.x * c.z - m.second[4],
                    m.volume * c.y * c.z - m.second[5]};
  return result;
}

/// Sums of closed components that differ by more than this share from the volume on rays count space twice.
constexpr double shared_space = 0.01;

/// Whether no two components' boxes meet, so that no space can be counted twice: rays measure what is thin
/// badly. Not asked of many components, each pair of which is looked at.
bool are_apart(const mesh::Surface& surface) {
  constexpr std::size_t many = 1000;
  const std::vector<Box3> boxes = mesh::component_bounds(surface);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; boxes.size() <= many && j < i; ++j) {
      if (meet(boxes[i], boxes[j])) {
        return false;
      }
    }
  }
  return boxes.size() <= many;
}

/// Sine of the angle at which a point is taken to lie in a triangle's plane; rounding leaves about 1e-15.
constexpr double in_plane = 1e-12;

/// How many triangles run along an edge from its smaller point number to the larger, and back.
using Runs = std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::size_t, 2>>;

Runs runs_along_edges(const solid::Body& cage) {
  const std::vector<std::uint32_t> place = first_at_place(cage.points);
  Runs runs;
  for (const auto& triangle : cage.triangles) {
    const std::array corners{place[triangle[0]], place[triangle[1]], place[triangle[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      continue;  // has shrunk to an edge: its neighbours meet there
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % 3];
      ++runs[std::minmax(from, to)][from < to ? 0 : 1];
    }
  }
  return runs;
}

/// True where the rays to a triangle's corners span the whole angle around the point: it lies on the
/// triangle. Otherwise the solid angle of the triangle is added.
bool lies_on(Vec3 point, const std::array<Vec3, 3>& triangle, double& angle) {
  std::array<Vec3, 3> to;
  for (std::size_t i = 0; i < 3; ++i) {
    const double distance = length(triangle[i] - point);
    if (distance == 0.0) {
      return true;
    }
    to[i] = (triangle[i] - point) / distance;
  }
  const double volume = dot(to[0], cross(to[1], to[2]));
  const double around = 1.0 + dot(to[0], to[1]) + dot(to[1], to[2]) + dot(to[2], to[0]);
  if (std::abs(volume) <= in_plane && around <= in_plane) {
    return true;
  }
  angle += 2.0 * elementary::atan2(volume, around);
  return false;
}

bool outside(Vec3 point, const solid::Body& cage) {
  double angle = 0.0;
  for (const auto& [a, b, c] : cage.triangles) {
    if (lies_on(point, {cage.points[a], cage.points[b], cage.points[c]}, angle)) {
      return false;
    }
  }
  return std::abs(angle) < 2.0 * std::numbers::pi;  // whole turns are 4 pi each
}

// Mean value coordinates of points in a closed triangle mesh.

/// Nearer to a cage vertex or a triangle's plane than this, relative to the cage's size, counts as on it. The
/// formula loses all digits at about 1e-8.
constexpr double on_cage = 1e-9;

/// Where one point goes.
class MeanValue {
 public:
  MeanValue(const Body& before, const Body& after)
      : before_(before), after_(after), distance_(before.points.size()), direction_(before.points.size()) {
    Box3 bounds;
    for (const Vec3 p : before.points) {
      bounds.add(p);
    }
    near_ = on_cage * bounds.diagonal();
  }

  Vec3 operator()(Vec3 x) {
    for (std::size_t v = 0; v < distance_.size(); ++v) {
      const Vec3 to = before_.points[v] - x;
      distance_[v] = length(to);
      if (distance_[v] <= near_) {
        return after_.points[v];
      }
      direction_[v] = to / distance_[v];
    }
    Vec3 sum{};
    double total = 0.0;
    for (const auto& triangle : before_.triangles) {
      std::array<double, 3> weight{};
      const Seen seen = weights(triangle, weight);
      if (seen == Seen::inside) {
        return weighted(triangle, weight) / (weight[0] + weight[1] + weight[2]);
      }
      if (seen == Seen::apart) {
        sum += weighted(triangle, weight);
        total += weight[0] + weight[1] + weight[2];
      }
    }
    return sum / total;
  }

 private:
  enum class Seen { inside, edge_on, apart };

  [[nodiscard]] Vec3 weighted(const std::array<std::uint32_t, 3>& t, const std::array<double, 3>& w) const {
    return w[0] * after_.points[t[0]] + w[1] * after_.points[t[1]] + w[2] * after_.points[t[2]];
  }

  /// The spherical triangle's share for each corner (figure 4 of the paper).
  Seen weights(const std::array<std::uint32_t, 3>& t, std::array<double, 3>& weight) const {
    std::array<double, 3> side{};  // arcs of the spherical triangle, opposite to the corners
    double half = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double chord = length(direction_[t[(i + 1) % 3]] - direction_[t[(i + 2) % 3]]);
      side[i] = 2.0 * elementary::asin(std::fmin(1.0, 0.5 * chord));
      half += 0.5 * side[i];
    }
    if (std::numbers::pi - half < on_cage) {  // the point is in the triangle
      for (std::size_t i = 0; i < 3; ++i) {
        weight[i] = elementary::sin(side[i]) * distance_[t[(i + 1) % 3]] * distance_[t[(i + 2) % 3]];
      }
      return Seen::inside;
    }
    const double volume = dot(direction_[t[0]], cross(direction_[t[1]], direction_[t[2]]));
    const double sign = volume < 0.0 ? -1.0 : 1.0;
    std::array<double, 3> cosine{};
    std::array<double, 3> sine{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      cosine[i] = 2.0 * elementary::sin(half) * elementary::sin(half - side[i]) /
                      (elementary::sin(side[j]) * elementary::sin(side[k])) -
                  1.0;
      cosine[i] = std::clamp(cosine[i], -1.0, 1.0);
      sine[i] = sign * std::sqrt(1.0 - cosine[i] * cosine[i]);
      if (std::fabs(sine[i]) <= on_cage) {
        return Seen::edge_on;  // in the triangle's plane, outside it: no weight
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      weight[i] = (side[i] - cosine[j] * side[k] - cosine[k] * side[j]) /
                  (distance_[t[i]] * elementary::sin(side[j]) * sine[k]);
    }
    return Seen::apart;
  }

  const Body& before_;
  const Body& after_;
  std::vector<double> distance_;
  std::vector<Vec3> direction_;
  double near_ = 0.0;
};

}  // namespace

MassProperties mass_properties(const Body& body) {
  Moments sum;
  add(sum, body);
  return from_moments(sum);
}

MassProperties union_properties(const std::vector<Body>& bodies, const Context& context) {
  return from_moments(moments_on_rays(bodies, context));
}

namespace {

Body body_of_faces(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  Body body;
  body.points.assign(surface.points().begin(), surface.points().end());
  for (const FaceId f : faces) {
    const auto [a, b, c] = surface.vertices(f);
    body.triangles.push_back({a.value(), b.value(), c.value()});
  }
  return body;
}

}  // namespace

Body body_of(const mesh::Surface& surface) {
  const auto faces = ids<FaceId>(surface.face_count());
  return body_of_faces(surface, {faces.begin(), faces.end()});
}

Body closed_body_of(const mesh::Surface& surface) {
  return body_of_faces(surface, closed_faces(surface));
}

std::optional<MassProperties> mass_properties(const mesh::Surface& surface, const Context& context) {
  const Body whole = closed_body_of(surface);
  if (whole.triangles.empty()) {
    return std::nullopt;
  }
  const MassProperties exact = mass_properties(whole);
  if (are_apart(surface)) {
    return exact;
  }
  const MassProperties on_rays = from_moments(moments_on_rays(surface, context));
  return std::fabs(exact.volume - on_rays.volume) <= shared_space * on_rays.volume ? exact : on_rays;
}

std::string write_obj(const std::vector<Body>& bodies, std::string_view comment) {
  std::string text = fmt::format("# {}\n", comment);
  std::size_t first = 1;
  std::size_t number = 0;
  for (const Body& body : bodies) {
    text += fmt::format("o hull_{}\n", ++number);
    for (const Vec3 p : body.points) {
      text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : body.triangles) {
      text += fmt::format("f {} {} {}\n", first + a, first + b, first + c);
    }
    first += body.points.size();
  }
  return text;
}

void require_closed(const std::string& file, const solid::Body& cage) {
  struct Kind {
    const char* one;
    const char* several;
    std::size_t count = 0;
    std::pair<std::uint32_t, std::uint32_t> first;
  };
  std::array kinds{
      Kind{"edge has a triangle on one side only", "edges have a triangle on one side only", {}, {}},
      Kind{"edge has more than two triangles", "edges have more than two triangles", {}, {}},
      Kind{"edge lies between triangles that face opposite ways",
           "edges lie between triangles that face opposite ways",
           {},
           {}}};
  for (const auto& [ends, runs] : runs_along_edges(cage)) {
    const std::size_t all = runs[0] + runs[1];
    if (all != 2 || runs[0] != runs[1]) {
      Kind& kind = kinds[all == 1 ? 0 : all > 2 ? 1 : 2];
      kind.first = kind.count++ == 0 ? ends : kind.first;
    }
  }
  for (const Kind& kind : kinds) {
    if (kind.count > 0) {
      const Vec3 a = cage.points[kind.first.first];
      const Vec3 b = cage.points[kind.first.second];
      throw Error(
          ErrorKind::unusable_mesh,
          fmt::format("{} isn't closed, as a cage has to be: {} {}, {} ({:g}, {:g}, {:g}) to ({:g}, {:g}, "
                      "{:g})",
                      file, kind.count, kind.count == 1 ? kind.one : kind.several,
                      kind.count == 1 ? "from" : "the first from", a.x, a.y, a.z, b.x, b.y, b.z),
          file);
    }
  }
}

std::size_t count_outside(std::span<const Vec3> points, const solid::Body& cage, const Context& context) {
  constexpr std::size_t between_checks = 64;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % between_checks == 0) {
      context.check();
    }
    count += outside(points[i], cage) ? 1U : 0U;
  }
  return count;
}

std::vector<Vec3> deform(std::span<const Vec3> points, const Body& before, const Body& after,
                         const Context& context) {
  RIDGECRAFT_ASSERT(before.points.size() == after.points.size() && before.triangles == after.triangles);
  MeanValue moved(before, after);
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3 p : points) {
    if (result.size() % 64 == 0) {
      context.check();
    }
    result.push_back(moved(p));
  }
  return result;
}

}  // namespace ridgecraft::solid
