// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/collapses/quick_collapses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "base/no_index.hpp"
#include "base/order.hpp"

namespace ridgecraft::prepare {
namespace {

/// Of all edges, the fraction that is considered in a pass: those of least error.
constexpr double considered = 0.5;
/// The largest error among these is estimated from about so many edges.
constexpr std::size_t sample_size = 20000;
/// After a pass that removes less than this fraction of the faces, more edges are considered, ...
constexpr double good_progress = 0.2;
constexpr double larger_fraction = 1.4;
/// ... and one of all edges that removes less than this fraction is the last one.
constexpr double least_progress = 0.01;
/// Cosine of how far a face may turn in one collapse.
constexpr double largest_turn_cosine = 0.5;
/// Smallest height over longest side of a new face where the old one wasn't worse.
constexpr double thinnest_new_face = 0.02;
/// Pull towards the middle of an edge, as a fraction of the quadric's growth: it decides where the surface is
/// flat.
constexpr double pull = 1e-3;
/// Error of an edge as a fraction of its squared length, for the same reason.
constexpr double flat_error = 1e-6;

using Corners = std::array<std::uint32_t, 3>;

/// Sum of squared distances from planes, each weighted by an area: a quadric.
class PlaneSum {
 public:
  void add(Vec3 n, double offset, double weight) {
    xx_ += weight * n.x * n.x;
    xy_ += weight * n.x * n.y;
    xz_ += weight * n.x * n.z;
    yy_ += weight * n.y * n.y;
    yz_ += weight * n.y * n.z;
    zz_ += weight * n.z * n.z;
    slope_ -= (weight * offset) * n;
    constant_ += weight * offset * offset;
  }
  PlaneSum& operator+=(const PlaneSum& other) {
    xx_ += other.xx_;
    xy_ += other.xy_;
    xz_ += other.xz_;
    yy_ += other.yy_;
    yz_ += other.yz_;
    zz_ += other.zz_;
    slope_ += other.slope_;
    constant_ += other.constant_;
    return *this;
  }
  /// The weights together.
  [[nodiscard]] double weight() const { return xx_ + yy_ + zz_; }
  [[nodiscard]] double at(Vec3 p) const {
    return std::max(0.0, dot(p, times(p)) + 2.0 * dot(slope_, p) + constant_);
  }
  /// How to go from a place to where the sum is least, held by a weak pull to the place. The pull keeps the
  /// matrix far from singular, so that Cramer's rule is good enough.
  [[nodiscard]] Vec3 step_from(Vec3 place) const {
    if (!(weight() > 0.0)) {
      return {};
    }
    const double held = pull * weight();
    const double xx = xx_ + held;
    const double yy = yy_ + held;
    const double zz = zz_ + held;
    const Vec3 first{yy * zz - yz_ * yz_, xz_ * yz_ - xy_ * zz, xy_ * yz_ - xz_ * yy};
    const Vec3 second{first.y, xx * zz - xz_ * xz_, xy_ * xz_ - xx * yz_};
    const Vec3 third{first.z, second.z, xx * yy - xy_ * xy_};
    const double determinant = xx * first.x + xy_ * first.y + xz_ * first.z;
    const Vec3 down = -(times(place) + slope_);
    return Vec3{dot(first, down), dot(second, down), dot(third, down)} / determinant;
  }

 private:
  [[nodiscard]] Vec3 times(Vec3 p) const {
    return {xx_ * p.x + xy_ * p.y + xz_ * p.z, xy_ * p.x + yy_ * p.y + yz_ * p.z,
            xz_ * p.x + yz_ * p.y + zz_ * p.z};
  }

  double xx_ = 0.0, xy_ = 0.0, xz_ = 0.0, yy_ = 0.0, yz_ = 0.0, zz_ = 0.0;
  Vec3 slope_;
  double constant_ = 0.0;
};

class QuickCollapses {
 public:
  QuickCollapses(const mesh::LooseFaces& loose, const PointRules& rules, const Walls& walls, double farthest)
      : rules_(rules),
        farthest_(farthest),
        points_(loose.points),
        faces_(loose.faces),
        sums_(points_.size()),
        bound_(points_.size(), 0) {
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      bound_[v] = rules.plane[v] != no_index ? 1 : 0;
    }
    for (const PointRules::Crossing& c : rules.crossings) {
      bound_[c.point] = bound_[c.end] = bound_[c.image_of_end] = 1;
    }
    std::vector<std::int64_t> open(points_.size(), 0);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto& [a, b, c] = faces_[f];
      const Vec3 doubled = cross(points_[b] - points_[a], points_[c] - points_[a]);
      const Vec3 normal = normalized(doubled);
      PlaneSum plane;
      plane.add(normal, dot(normal, points_[a]), 0.5 * length(doubled));
      const bool of_wall = walls.wall(f) != Walls::none;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = faces_[f][k];
        sums_[v] += plane;
        if (of_wall) {
          bound_[v] = 1;
        }
        // Of a closed fan the next corners are the corners before, in another order.
        open[v] += std::int64_t{faces_[f][(k + 1) % 3]} - std::int64_t{faces_[f][(k + 2) % 3]};
      }
      all_ += rules.copies[a];
    }
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      if (open[v] != 0) {
        bound_[v] = 1;
      }
    }
    all_ -= 2 * rules.crossings.size();
  }

  std::vector<Collapse> run(std::size_t faces, const Context& context) {
    double fraction = considered;
    while (all_ > faces) {
      context.check();
      const std::size_t before = all_;
      pass(faces, fraction);
      // Edges that can't go are tried again and again: beside them there have to be others.
      const double progress = static_cast<double>(before - all_) / static_cast<double>(before);
      if (progress < least_progress && fraction == 1.0) {
        break;
      }
      fraction = progress < good_progress ? std::min(1.0, larger_fraction * fraction) : fraction;
    }
    return std::move(collapses_);
  }

 private:
  /// The sides that a pass tries, in this order.
  struct Candidates {
    std::vector<std::uint32_t> sides;  ///< side k of face f is 3 f + k
    double largest_error = 0.0;
  };
  struct Place {
    Vec3 place;
    double error;
    double most;  ///< that the error may be
  };

  [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t v) const {
    return std::span(face_at_).subspan(first_[v], degree_[v]);
  }
  [[nodiscard]] bool gone(std::uint32_t face) const { return faces_[face][0] == faces_[face][1]; }

  void pass(std::size_t aim, double fraction) {
    find_fans();
    const Candidates candidates = least_errors(fraction);
    changed_.assign(points_.size(), 0);
    const std::vector<std::uint32_t>& sides = candidates.sides;
    for (std::size_t i = 0; i < sides.size() && all_ > aim; ++i) {
      fetch_ahead(sides, i);
      const std::uint32_t side = sides[i];
      const std::uint32_t face = side / 3;
      if (!gone(face)) {
        const std::uint32_t k = side % 3;
        collapse(faces_[face][k], faces_[face][k == 2 ? 0 : k + 1], candidates.largest_error);
      }
    }
    std::erase_if(faces_, [](const Corners& face) { return face[0] == face[1]; });
  }

  /// Edges in the order of their errors lie all over memory: what the next ones need is asked for before it
  /// is needed.
  void fetch_ahead(const std::vector<std::uint32_t>& sides, std::size_t i) const {
    constexpr std::size_t faces_ahead = 24;
    constexpr std::size_t points_ahead = 16;
    constexpr std::size_t fans_ahead = 8;
    if (i + faces_ahead >= sides.size()) {
      return;
    }
    fetch(&faces_[sides[i + faces_ahead] / 3]);
    for (const std::uint32_t v : faces_[sides[i + points_ahead] / 3]) {
      fetch(&points_[v]);
      fetch(&sums_[v]);
      fetch(&first_[v]);
      fetch(&degree_[v]);
    }
    for (const std::uint32_t v : faces_[sides[i + fans_ahead] / 3]) {
      for (const std::uint32_t f : around(v)) {
        fetch(&faces_[f]);
      }
    }
  }
  template <class T>
  static void fetch(const T* place) {
#if defined(__GNUC__)
    __builtin_prefetch(place);
#else
    static_cast<void>(place);
#endif
  }

  void find_fans() {
    degree_.assign(points_.size(), 0);
    for (const Corners& face : faces_) {
      for (const std::uint32_t v : face) {
        ++degree_[v];
      }
    }
    first_.resize(points_.size());
    std::exclusive_scan(degree_.begin(), degree_.end(), first_.begin(), 0U);
    face_at_.resize(3 * faces_.size());
    std::vector<std::uint32_t> next = first_;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (const std::uint32_t v : faces_[f]) {
        face_at_[next[v]++] = f;
      }
    }
  }

  [[nodiscard]] Candidates least_errors(double fraction) const {
    Candidates candidates;
    std::vector<float> errors;
    errors.reserve(3 * faces_.size() / 2);
    candidates.sides.reserve(3 * faces_.size() / 2);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = faces_[f][k];
        const std::uint32_t b = faces_[f][k == 2 ? 0 : k + 1];
        if (a < b && bound_[a] == 0 && bound_[b] == 0) {
          errors.push_back(static_cast<float>(best_place(a, b).error));
          candidates.sides.push_back(3 * f + k);
        }
      }
    }
    if (errors.empty()) {
      return candidates;
    }
    std::vector<float> some;
    const std::size_t step = std::max<std::size_t>(1, errors.size() / sample_size);
    for (std::size_t i = 0; i < errors.size(); i += step) {
      some.push_back(errors[i]);
    }
    const auto at =
        some.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(some.size() - 1));
    std::nth_element(some.begin(), at, some.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] <= *at) {
        errors[kept] = errors[i];
        candidates.sides[kept++] = candidates.sides[i];
      }
    }
    errors.resize(kept);
    candidates.largest_error = *at;
    std::vector<std::uint32_t> sorted = ascending_order(errors);
    for (std::uint32_t& i : sorted) {
      i = candidates.sides[i];
    }
    candidates.sides = std::move(sorted);
    return candidates;
  }

  /// Where the end of an edge would best be that its two ends become, and the error there.
  [[nodiscard]] Place best_place(std::uint32_t a, std::uint32_t b) const {
    PlaneSum sum = sums_[a];
    sum += sums_[b];
    const Vec3 middle = 0.5 * (points_[a] + points_[b]);
    const Vec3 step = sum.step_from(middle);
    const Vec3 edge = points_[b] - points_[a];
    const Vec3 place = dot(step, step) <= dot(edge, edge) ? middle + step : middle;
    return {place, sum.at(place) + flat_error * sum.weight() * dot(edge, edge),
            farthest_ * farthest_ * sum.weight()};
  }

  /// The corners beside those of a fan, each once.
  void find_ring(std::uint32_t v, std::vector<std::uint32_t>& ring) const {
    ring.clear();
    for (const std::uint32_t f : around(v)) {
      const Corners& face = faces_[f];
      ring.push_back(face[0] == v ? face[1] : face[1] == v ? face[2] : face[0]);
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
          (is.height_fraction < thinnest_new_face && is.height_fraction < was.height_fraction)) {
        return true;
      }
    }
    return false;
  }

  struct Shape {
    Vec3 normal;
    double height_fraction;
  };
  static Shape shape_of(Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 doubled = cross(b - a, c - a);
    const double twice = length(doubled);
    const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    return twice > 0.0 ? Shape{(1.0 / twice) * doubled, twice / longest} : Shape{{}, 0.0};
  }

  void collapse(std::uint32_t a, std::uint32_t b, double largest_error) {
    if (bound_[a] != 0 || bound_[b] != 0) {
      return;
    }
    const Place best = best_place(a, b);
    // What was changed in this pass may be dearer now than what others will be.
    if (((changed_[a] != 0 || changed_[b] != 0) && best.error > largest_error) || best.error > best.most ||
        !stays_manifold(a, b) || spoils(a, b, best.place) || spoils(b, a, best.place)) {
      return;
    }
    all_ -= 2 * rules_.copies[a];
    put_fans_together(a, b);
    points_[a] = best.place;
    sums_[a] += sums_[b];
    changed_[a] = 1;
    collapses_.push_back({b, a, best.place, static_cast<std::uint32_t>(all_)});
  }

  /// The faces between the ends of an edge go, and those of the second end get the first as their corner.
  void put_fans_together(std::uint32_t a, std::uint32_t b) {
    fan_.clear();
    for (const std::uint32_t v : {a, b}) {
      for (const std::uint32_t f : around(v)) {
        const Corners& face = faces_[f];
        const bool between = std::find(face.begin(), face.end(), v == a ? b : a) != face.end();
        if (!between) {
          fan_.push_back(f);
        } else if (v == a) {
          between_.push_back(f);
        }
      }
    }
    for (const std::uint32_t f : between_) {
      for (const std::uint32_t v : faces_[f]) {
        if (v != a && v != b) {
          take_out(f, v);
        }
      }
    }
    for (const std::uint32_t f : between_) {
      faces_[f] = {a, a, a};  // goes at the end of the pass
    }
    between_.clear();
    for (const std::uint32_t f : around(b)) {
      if (!gone(f)) {
        *std::find(faces_[f].begin(), faces_[f].end(), b) = a;
      }
    }
    first_[a] = static_cast<std::uint32_t>(face_at_.size());
    degree_[a] = static_cast<std::uint32_t>(fan_.size());
    degree_[b] = 0;
    face_at_.insert(face_at_.end(), fan_.begin(), fan_.end());
  }

  /// A face out of the fan of one of its corners.
  void take_out(std::uint32_t face, std::uint32_t v) {
    const auto fan = std::span(face_at_).subspan(first_[v], degree_[v]);
    *std::find(fan.begin(), fan.end(), face) = fan.back();
    --degree_[v];
  }

  const PointRules& rules_;
  double farthest_;
  std::vector<Vec3> points_;
  std::vector<Corners> faces_;
  std::vector<PlaneSum> sums_;
  std::vector<std::uint8_t> bound_;  ///< of each point: whether it stays
  std::size_t all_ = 0;              ///< faces of the whole
  std::vector<Collapse> collapses_;
  // Of a pass: the faces at each point as they are now, and which points have moved.
  std::vector<std::uint32_t> face_at_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> degree_;
  std::vector<std::uint8_t> changed_;
  // Of a collapse.
  std::vector<std::uint32_t> ring_a_;
  std::vector<std::uint32_t> ring_b_;
  std::vector<std::uint32_t> fan_;
  std::vector<std::uint32_t> between_;
};

}  // namespace

std::vector<Collapse> quick_collapses(const FundamentalDomain& domain, const Walls& walls, std::size_t faces,
                                      double farthest, const Context& context) {
  return QuickCollapses(domain.faces, domain.points, walls, farthest).run(faces, context);
}

}  // namespace ridgecraft::prepare
