// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/twins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "base/no_index.hpp"
#include "base/order.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/symmetry/correspondence.hpp"
#include "prepare/symmetry/eigen.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {
namespace {

/// Pairs of corners that are tried as images of the first body's two; more are as good as equal.
constexpr std::size_t most_tries = 128;
/// Motions of either turn that are asked whether they keep the triangles, too.
constexpr std::size_t most_motions = 4;
/// Corners that a motion is tried with first.
constexpr std::size_t first_tries = 16;
/// A second corner that is nearer to the line through the centre and the first one, as a share of the extent,
/// tells no direction.
constexpr double off_line = 0.01;
/// Cosine of the angle up to which two faces face the same way.
constexpr double same_way = 0.99;
/// Faces of a twin without a partner among which one is looked for by its place; of more, any does.
constexpr std::size_t most_alone = 1000;

/// One body with what twins have in common.
struct Shape {
  PartOf part;
  std::vector<Vec3> points;          ///< one for each place
  std::vector<std::uint32_t> order;  ///< 0, 1, ...
  Vec3 centre;                       ///< of area: it doesn't depend on triangles
  double area = 0.0;
  double extent = 0.0;
  std::uint32_t first = no_index;   ///< the farthest point from the centre
  std::uint32_t second = no_index;  ///< the farthest from the line through both; no_index: all are on it
};

double off_axis(const Shape& s, Vec3 axis, std::uint32_t i) {
  return length(cross(s.points[i] - s.centre, axis));
}

Shape shape_of(const mesh::Surface& whole, const std::vector<FaceId>& faces) {
  Shape s;
  s.part = part_of(whole, faces);
  const mesh::Surface& surface = s.part.surface;
  const std::vector<std::uint32_t> first = first_at_place(surface.points());
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] == v) {
      s.points.push_back(surface.point(VertexId(v)));
    }
  }
  s.order.resize(s.points.size());
  std::iota(s.order.begin(), s.order.end(), 0U);
  s.extent = surface.bounds().diagonal();
  const Vec3 origin = surface.bounds().low;
  Vec3 sum;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    sum += surface.area(f) / 3.0 * (surface.point(a) + surface.point(b) + surface.point(c) - 3.0 * origin);
    s.area += surface.area(f);
  }
  s.centre = s.area > 0.0 ? origin + sum / s.area : origin;
  const auto far = [&](std::uint32_t i) { return length(s.points[i] - s.centre); };
  s.first = *std::max_element(s.order.begin(), s.order.end(),
                              [&](std::uint32_t i, std::uint32_t k) { return far(i) < far(k); });
  const Vec3 axis = normalized(s.points[s.first] - s.centre);
  const std::uint32_t second = *std::max_element(
      s.order.begin(), s.order.end(),
      [&](std::uint32_t i, std::uint32_t k) { return off_axis(s, axis, i) < off_axis(s, axis, k); });
  s.second = off_axis(s, axis, second) > off_line * s.extent ? second : no_index;
  return s;
}

std::array<Vec3, 3> frame(const Shape& s, std::uint32_t first, std::uint32_t second) {
  const Vec3 x = normalized(s.points[first] - s.centre);
  const Vec3 other = s.points[second] - s.centre;
  const Vec3 y = normalized(other - dot(other, x) * x);
  return {x, y, cross(x, y)};
}

/// Brings a body onto another one.
class Aligner {
 public:
  Aligner(const Shape& from, const Shape& to, double radius)
      : from_(from), to_(to), radius_(radius), tree_(to.points, to.order) {}

  /// Gives motions that do, until one is accepted; not more than a few of them.
  template <class Accept>
  void run(const Accept& accept) const {
    if (from_.second == no_index || to_.second == no_index) {
      return;
    }
    const std::vector<std::array<std::uint32_t, 2>> images = possible_images();
    for (const bool mirrors : {false, true}) {
      std::size_t found = 0;
      for (const auto& [first, second] : images) {
        const Isometry rough = between(first, second, mirrors);
        if (found == most_motions || !fits(rough, 3.0 * radius_, first_tries)) {
          continue;
        }
        const Isometry fine = fitted(rough);
        if (fits(fine, radius_, from_.points.size())) {
          ++found;
          if (accept(fine)) {
            return;
          }
        }
      }
    }
  }

 private:
  /// What the two corners of the first body may lie on: points as far from the centre and from each other.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> possible_images() const {
    const auto far = [](const Shape& s, std::uint32_t i) { return length(s.points[i] - s.centre); };
    const double apart = length(from_.points[from_.first] - from_.points[from_.second]);
    const double reach = 2.0 * radius_;
    std::vector<std::uint32_t> firsts;
    std::vector<std::uint32_t> seconds;
    for (const std::uint32_t i : to_.order) {
      if (std::abs(far(to_, i) - far(from_, from_.first)) <= reach) {
        firsts.push_back(i);
      }
      if (std::abs(far(to_, i) - far(from_, from_.second)) <= reach) {
        seconds.push_back(i);
      }
    }
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const std::uint32_t i : firsts) {
      for (const std::uint32_t k : seconds) {
        if (pairs.size() < most_tries &&
            std::abs(length(to_.points[i] - to_.points[k]) - apart) <= 2.0 * reach) {
          pairs.push_back({i, k});
        }
      }
    }
    return pairs;
  }

  [[nodiscard]] Isometry between(std::uint32_t first, std::uint32_t second, bool mirrors) const {
    const std::array<Vec3, 3> a = frame(from_, from_.first, from_.second);
    std::array<Vec3, 3> b = frame(to_, first, second);
    b[2] = mirrors ? -b[2] : b[2];
    Isometry result;
    result.mirrors = mirrors;
    result.motion.rows = {b[0].x * a[0] + b[1].x * a[1] + b[2].x * a[2],
                          b[0].y * a[0] + b[1].y * a[1] + b[2].y * a[2],
                          b[0].z * a[0] + b[1].z * a[1] + b[2].z * a[2]};
    result.motion.shift = to_.centre - result.turn(from_.centre);
    return result;
  }

  [[nodiscard]] bool fits(const Isometry& motion, double radius, std::size_t tries) const {
    const std::size_t step = std::max<std::size_t>(1, from_.points.size() / tries);
    for (std::size_t i = 0; i < from_.points.size(); i += step) {
      if (tree_.nearest(motion(from_.points[i]), radius) == no_index) {
        return false;
      }
    }
    return true;
  }

  /// The motion that brings all points nearest to their partners (W. Kabsch, 1976).
  [[nodiscard]] Isometry fitted(const Isometry& rough) const {
    std::vector<std::array<Vec3, 2>> pairs;
    Vec3 sum_p;
    Vec3 sum_q;
    for (const Vec3 p : from_.points) {
      const std::uint32_t q = tree_.nearest(rough(p), 3.0 * radius_);
      if (q != no_index) {
        pairs.push_back({p, to_.points[q]});
        sum_p += p;
        sum_q += to_.points[q];
      }
    }
    const double count = static_cast<double>(std::max<std::size_t>(1, pairs.size()));
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& [p, q] : pairs) {
      const Vec3 a = p - sum_p / count;
      const Vec3 b = q - sum_q / count;
      spread += outer_product(b, a);
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1.0, 1.0, 1.0);
    const bool turned = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0;
    signs(2) = turned == rough.mirrors ? 1.0 : -1.0;
    const Eigen::Matrix3d m = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    Isometry result;
    result.mirrors = rough.mirrors;
    for (int i = 0; i < 3; ++i) {
      result.motion.rows[static_cast<std::size_t>(i)] = {m(i, 0), m(i, 1), m(i, 2)};
    }
    result.motion.shift = sum_q / count - result.turn(sum_p / count);
    return result;
  }

  const Shape& from_;
  const Shape& to_;
  double radius_;
  NearbyPoints tree_;
};

template <class I>
std::vector<std::pair<I, I>> pairs(const IdVector<I, I>& partner, const IdVector<I, I>& from,
                                   const IdVector<I, I>& to) {
  std::vector<std::pair<I, I>> result;
  for (const I i : ids<I>(partner.size())) {
    if (partner[i].valid()) {
      result.emplace_back(from[i], to[partner[i]]);
    }
  }
  return result;
}

Twin twin_by(const Isometry& motion, const Correspondence& maps, const PartOf& from, const PartOf& to) {
  Twin twin;
  twin.motion = motion;
  twin.deviation = maps.farthest;
  twin.whole = maps.whole;
  twin.vertices = pairs(maps.vertex, from.vertex, to.vertex);
  twin.edges = pairs(maps.edge, from.edge, to.edge);
  twin.faces = pairs(maps.face, from.face, to.face);
  return twin;
}

std::optional<Twin> match(const Shape& from, const Shape& to, double tolerance) {
  const double radius = tolerance * from.extent;
  // A body that is symmetric as a set of points may be so in its triangles, too: then there is a motion that
  // keeps these, or more of them, and it is the better one.
  std::optional<Twin> best;
  Aligner(from, to, radius).run([&](const Isometry& motion) {
    const Correspondence maps = correspond(from.part.surface, to.part.surface, motion, radius);
    if (maps.farthest <= radius) {
      Twin twin = twin_by(motion, maps, from.part, to.part);
      if (!best || twin.whole || twin.faces.size() > best->faces.size()) {
        best = std::move(twin);
      }
    }
    return best && best->whole;
  });
  return best;
}

/// The first body of a group, and its twins so far.
struct Group {
  Shape shape;
  std::vector<Twin> twins;
};

Twin itself(std::size_t body, const PartOf& part) {
  Twin twin;
  twin.body = body;
  twin.whole = true;
  const auto add = [](const auto& from, auto& to) {
    for (const auto i : from) {
      to.emplace_back(i, i);
    }
  };
  add(part.vertex, twin.vertices);
  add(part.edge, twin.edges);
  add(part.face, twin.faces);
  return twin;
}

}  // namespace

std::vector<std::vector<Twin>> find_twins(const mesh::Surface& surface,
                                          std::span<const std::vector<FaceId>> bodies, const Context& context,
                                          double tolerance) {
  std::vector<Group> groups;
  std::multimap<std::pair<std::size_t, double>, std::size_t> by_size;  // places and area
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (b % 64 == 0) {
      context.check();
    }
    if (bodies[b].empty()) {
      continue;
    }
    Shape shape = shape_of(surface, bodies[b]);
    const std::size_t places = shape.points.size();
    bool found = false;
    const double slack = 4.0 * tolerance * shape.area;
    for (auto i = by_size.lower_bound({places, shape.area - slack});
         i != by_size.end() && i->first.first == places && i->first.second <= shape.area + slack && !found;
         ++i) {
      Group& group = groups[i->second];
      if (auto twin = match(group.shape, shape, tolerance)) {
        twin->body = b;
        group.twins.push_back(std::move(*twin));
        found = true;
      }
    }
    if (!found) {
      by_size.emplace(std::pair(places, shape.area), groups.size());
      std::vector<Twin> own{itself(b, shape.part)};
      groups.push_back({std::move(shape), std::move(own)});
    }
  }
  std::vector<std::vector<Twin>> result;
  for (Group& group : groups) {
    if (group.twins.size() > 1) {
      result.push_back(std::move(group.twins));
    }
  }
  return result;
}

TwinFaces::TwinFaces(const mesh::Surface& surface, const Twin& twin, std::span<const FaceId> body)
    : surface_(surface), twin_(twin), body_(body) {
  std::vector<FaceId> partners;
  for (const auto& [face, partner] : twin.faces) {
    partners.push_back(partner);
  }
  std::sort(partners.begin(), partners.end());
  std::copy_if(body.begin(), body.end(), std::back_inserter(alone_),
               [&](FaceId f) { return !std::binary_search(partners.begin(), partners.end(), f); });
}

FaceId TwinFaces::operator()(FaceId face) const {
  const auto found = std::lower_bound(twin_.faces.begin(), twin_.faces.end(), std::pair(face, FaceId(0)));
  if (found != twin_.faces.end() && found->first == face) {
    return found->second;
  }
  if (alone_.empty() || alone_.size() > most_alone) {
    return body_.front();
  }
  const auto [a, b, c] = surface_.vertices(face);
  const Vec3 middle = twin_.motion((surface_.point(a) + surface_.point(b) + surface_.point(c)) / 3.0);
  const Vec3 normal = twin_.motion.turn(surface_.normal(face));
  FaceId best;
  std::pair<bool, double> least(true, INFINITY);
  for (const FaceId f : alone_) {
    const auto [i, j, k] = surface_.vertices(f);
    const bool faces_another_way = dot(normal, surface_.normal(f)) < same_way;
    const std::pair rank(faces_another_way, mesh::squared_distance(surface_.point(i), surface_.point(j),
                                                                   surface_.point(k), middle));
    if (!best.valid() || rank < least) {
      least = rank;
      best = f;
    }
  }
  return best;
}

std::vector<std::vector<FaceId>> components(const mesh::Surface& surface) {
  std::vector<std::vector<FaceId>> result(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    result[surface.component(f).value()].push_back(f);
  }
  return result;
}

}  // namespace ridgecraft::prepare
