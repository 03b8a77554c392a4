// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/quick_collapses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace ridgecraft::prepare {
namespace {

/// Of all edges, the share that is considered in a pass: those of least error.
constexpr double considered = 0.4;
/// A pass that removes less than this share of the faces is the last one.
constexpr double least_progress = 0.01;
/// Cosine of how far a face may turn in one collapse.
constexpr double largest_turn_cosine = 0.5;
/// Smallest height over longest side of a new face where the old one wasn't worse.
constexpr double thinnest_new_face = 0.02;
/// Pull towards the middle of an edge, as a share of the quadric's growth: it decides where the surface is
/// flat.
constexpr double pull = 1e-3;
/// Error of an edge as a share of its squared length, for the same reason.
constexpr double flat_error = 1e-6;

using Corners = std::array<std::uint32_t, 3>;

/// Sum of squared distances from planes, each weighted by an area: a quadric.
class PlaneSum {
 public:
  void add(Vec3 normal, double offset, double weight) {
    const Eigen::Vector3d n = vector(normal);
    matrix_ += weight * n * n.transpose();
    slope_ -= weight * offset * n;
    constant_ += weight * offset * offset;
  }
  PlaneSum& operator+=(const PlaneSum& other) {
    matrix_ += other.matrix_;
    slope_ += other.slope_;
    constant_ += other.constant_;
    return *this;
  }
  /// The weights together.
  [[nodiscard]] double weight() const { return matrix_.trace(); }
  [[nodiscard]] double at(Vec3 place) const {
    const Eigen::Vector3d p = vector(place);
    return std::max(0.0, p.dot(matrix_ * p) + 2.0 * slope_.dot(p) + constant_);
  }
  /// Where the sum is least, held by a weak pull to a place.
  [[nodiscard]] Vec3 least_near(Vec3 place) const {
    if (!(weight() > 0.0)) {
      return place;
    }
    const Eigen::Matrix3d held = matrix_ + pull * weight() * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d step = held.llt().solve(-(matrix_ * vector(place) + slope_));
    return place + Vec3{step.x(), step.y(), step.z()};
  }

 private:
  static Eigen::Vector3d vector(Vec3 v) { return {v.x, v.y, v.z}; }

  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d slope_ = Eigen::Vector3d::Zero();
  double constant_ = 0.0;
};

class QuickCollapses {
 public:
  QuickCollapses(const mesh::LooseFaces& loose, const PointRules& rules, const Walls& walls)
      : rules_(rules),
        points_(loose.points),
        faces_(loose.faces),
        sums_(points_.size()),
        bound_(points_.size(), false) {
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      bound_[v] = rules.plane[v] != PointRules::none;
    }
    for (const PointRules::Crossing& c : rules.crossings) {
      bound_[c.point] = bound_[c.end] = bound_[c.image_of_end] = true;
    }
    std::vector<std::int64_t> open(points_.size(), 0);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto& [a, b, c] = faces_[f];
      const Vec3 doubled = cross(points_[b] - points_[a], points_[c] - points_[a]);
      const Vec3 normal = normalized(doubled);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = faces_[f][k];
        sums_[v].add(normal, dot(normal, points_[a]), 0.5 * length(doubled));
        bound_[v] = bound_[v] || walls.wall(f) != Walls::none;
        // Of a closed fan the next corners are the corners before, in another order.
        open[v] += std::int64_t{faces_[f][(k + 1) % 3]} - std::int64_t{faces_[f][(k + 2) % 3]};
      }
      all_ += rules.copies[a];
    }
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      bound_[v] = bound_[v] || open[v] != 0;
    }
    all_ -= 2 * rules.crossings.size();
  }

  std::vector<Collapse> run(std::size_t faces, const Context& context) {
    while (all_ > faces) {
      context.check();
      const std::size_t before = all_;
      pass(faces);
      if (static_cast<double>(before - all_) < least_progress * static_cast<double>(before)) {
        break;
      }
    }
    return std::move(collapses_);
  }

 private:
  struct Edge {
    double error;
    std::uint32_t a;
    std::uint32_t b;
  };

  [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t v) const {
    return std::span(face_at_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

  void pass(std::size_t aim) {
    find_fans();
    std::vector<Edge> edges = edges_by_error();
    touched_.assign(points_.size(), false);
    for (const Edge& e : edges) {
      if (all_ <= aim) {
        break;
      }
      if (!touched_[e.a] && !touched_[e.b]) {
        collapse(e.a, e.b);
      }
    }
    std::erase_if(faces_, [](const Corners& face) { return face[0] == face[1]; });
  }

  void find_fans() {
    first_.assign(points_.size() + 1, 0);
    for (const Corners& face : faces_) {
      for (const std::uint32_t v : face) {
        ++first_[v + 1];
      }
    }
    degree_.assign(first_.begin() + 1, first_.end());
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    face_at_.resize(3 * faces_.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (const std::uint32_t v : faces_[f]) {
        face_at_[next[v]++] = f;
      }
    }
  }

  [[nodiscard]] std::vector<Edge> edges_by_error() const {
    std::vector<Edge> edges;
    edges.reserve(3 * faces_.size() / 2);
    for (const Corners& face : faces_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = face[k];
        const std::uint32_t b = face[(k + 1) % 3];
        if (a < b && !bound_[a] && !bound_[b]) {
          edges.push_back({error(a, b), a, b});
        }
      }
    }
    const auto before = [](const Edge& x, const Edge& y) {
      return std::tie(x.error, x.a, x.b) < std::tie(y.error, y.a, y.b);
    };
    const auto count = static_cast<std::ptrdiff_t>(considered * static_cast<double>(edges.size()));
    std::nth_element(edges.begin(), edges.begin() + count, edges.end(), before);
    edges.resize(static_cast<std::size_t>(count));
    std::sort(edges.begin(), edges.end(), before);
    return edges;
  }

  [[nodiscard]] Vec3 place_of(std::uint32_t a, std::uint32_t b, const PlaneSum& sum) const {
    const Vec3 middle = 0.5 * (points_[a] + points_[b]);
    const Vec3 place = sum.least_near(middle);
    const Vec3 edge = points_[b] - points_[a];
    const Vec3 away = place - middle;
    return dot(away, away) <= dot(edge, edge) ? place : middle;
  }

  [[nodiscard]] double error(std::uint32_t a, std::uint32_t b) const {
    PlaneSum sum = sums_[a];
    sum += sums_[b];
    const Vec3 edge = points_[b] - points_[a];
    return sum.at(place_of(a, b, sum)) + flat_error * sum.weight() * dot(edge, edge);
  }

  /// The corners beside those of a fan, each once.
  void find_ring(std::uint32_t v, std::vector<std::uint32_t>& ring) const {
    ring.clear();
    for (const std::uint32_t f : around(v)) {
      const Corners& face = faces_[f];
      const std::size_t k = face[0] == v ? 0 : face[1] == v ? 1 : 2;
      ring.push_back(face[(k + 1) % 3]);
    }
  }

  /// Do the ends of an edge have no other neighbours in common than the two across its faces, and have these
  /// enough other faces?
  [[nodiscard]] bool stays_manifold(std::uint32_t a, std::uint32_t b) {
    find_ring(a, ring_a_);
    find_ring(b, ring_b_);
    std::size_t common = 0;
    for (const std::uint32_t v : ring_a_) {
      if (std::find(ring_b_.begin(), ring_b_.end(), v) != ring_b_.end()) {
        ++common;
        if (degree_[v] <= 3) {
          return false;
        }
      }
    }
    return common == 2 && ring_a_.size() + ring_b_.size() > 6;
  }

  /// Would a face with this corner be turned or made thin?
  [[nodiscard]] bool spoils(std::uint32_t v, std::uint32_t other, Vec3 place) const {
    for (const std::uint32_t f : around(v)) {
      const Corners& face = faces_[f];
      const std::size_t k = face[0] == v ? 0 : face[1] == v ? 1 : 2;
      const std::uint32_t from = face[(k + 1) % 3];
      const std::uint32_t to = face[(k + 2) % 3];
      if (from == other || to == other) {
        continue;
      }
      const Shape was = shape_of(points_[v], points_[from], points_[to]);
      const Shape is = shape_of(place, points_[from], points_[to]);
      if (dot(was.normal, is.normal) < largest_turn_cosine ||
          (is.height_share < thinnest_new_face && is.height_share < was.height_share)) {
        return true;
      }
    }
    return false;
  }

  struct Shape {
    Vec3 normal;
    double height_share;
  };
  static Shape shape_of(Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 doubled = cross(b - a, c - a);
    const double twice = length(doubled);
    const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    return twice > 0.0 ? Shape{(1.0 / twice) * doubled, twice / longest} : Shape{{}, 0.0};
  }

  void collapse(std::uint32_t a, std::uint32_t b) {
    PlaneSum sum = sums_[a];
    sum += sums_[b];
    const Vec3 place = place_of(a, b, sum);
    if (!stays_manifold(a, b) || spoils(a, b, place) || spoils(b, a, place)) {
      return;
    }
    for (const auto* ring : {&ring_a_, &ring_b_}) {
      for (const std::uint32_t v : *ring) {
        touched_[v] = true;
      }
    }
    for (const std::uint32_t f : around(b)) {
      Corners& face = faces_[f];
      if (std::find(face.begin(), face.end(), a) != face.end()) {
        for (const std::uint32_t v : face) {
          --degree_[v];
        }
        all_ -= rules_.copies[a];
        face = {a, a, a};  // goes at the end of the pass
      } else {
        *std::find(face.begin(), face.end(), b) = a;
      }
    }
    points_[a] = place;
    sums_[a] = sum;
    collapses_.push_back({b, a, place, static_cast<std::uint32_t>(all_)});
  }

  const PointRules& rules_;
  std::vector<Vec3> points_;
  std::vector<Corners> faces_;
  std::vector<PlaneSum> sums_;
  std::vector<bool> bound_;
  std::size_t all_ = 0;  ///< faces of the whole
  std::vector<Collapse> collapses_;
  // Of a pass: the faces at each point, how many there are now, and which points have changed faces.
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> face_at_;
  std::vector<std::uint32_t> degree_;
  std::vector<bool> touched_;
  std::vector<std::uint32_t> ring_a_;
  std::vector<std::uint32_t> ring_b_;
};

}  // namespace

std::vector<Collapse> quick_collapses(const mesh::LooseFaces& loose, const PointRules& points,
                                      const Walls& walls, std::size_t faces, const Context& context) {
  return QuickCollapses(loose, points, walls).run(faces, context);
}

}  // namespace ridgecraft::prepare
