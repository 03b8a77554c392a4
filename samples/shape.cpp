// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace ridgecraft::samples {
namespace {

/// Places behind the point in the files: flat regions stay flat to far less than paper shows.
constexpr double grain = 1e6;
/// A polygon is plane when no corner is farther from its plane than rounding can bring it.
constexpr double plane_tolerance = 1.0 / grain;

double rounded(double x) {
  const double result = std::round(x * grain) / grain;
  return result == 0.0 ? 0.0 : result;  // no negative zero in the files
}

Vec3 area_vector(const Ring& ring) {
  Vec3 sum;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    sum += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return sum;
}

/// The ring, begun at the corner that brings it nearest to another one, corner by corner.
Ring nearest_turn(Ring ring, const Ring& other) {
  Ring best = ring;
  const auto distance = [&other](const Ring& r) {
    double sum = 0.0;
    for (std::size_t k = 0; k < r.size(); ++k) {
      sum += length(r[k] - other[k]);
    }
    return sum;
  };
  for (std::size_t k = 0; k < other.size(); ++k) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    best = distance(ring) < distance(best) ? ring : best;
  }
  return best;
}

}  // namespace

Index Shape::material(const std::string& name, Vec3 colour) {
  materials_.push_back({name, colour});
  return static_cast<Index>(materials_.size() - 1);
}

Index Shape::face(const Ring& corners, Index material) {
  Face face{{}, material};
  for (const Vec3 p : corners) {
    face.corners.push_back(static_cast<Index>(points_.size()));
    points_.push_back(p);
  }
  faces_.push_back(std::move(face));
  return static_cast<Index>(faces_.size() - 1);
}

void Shape::raise(Index number, const Ring& corners, Index wall_material) {
  const Ring old = ring(number);
  const Index own = faces_[number].material;
  for (std::size_t k = 0; k < old.size(); ++k) {
    const std::size_t next = (k + 1) % old.size();
    face({old[k], old[next], corners[next], corners[k]}, wall_material);
  }
  face(corners, own);
  std::swap(faces_[number], faces_.back());
  faces_.pop_back();
}

void Shape::raise_to_point(Index number, Vec3 tip, Index material) {
  raise(number, Ring(faces_[number].corners.size(), tip), material);
}

void Shape::bridge(Index from, Index to, const std::vector<Ring>& between, Index material) {
  std::vector<Ring> rings = {ring(from)};
  rings.insert(rings.end(), between.begin(), between.end());
  rings.push_back(nearest_turn(reversed(ring(to)), rings.back()));
  faces_[from].corners.clear();
  faces_[to].corners.clear();
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t k = 0; k < rings[i].size(); ++k) {
      const std::size_t next = (k + 1) % rings[i].size();
      face({rings[i][k], rings[i][next], rings[i + 1][next], rings[i + 1][k]}, material);
    }
  }
}

Ring Shape::ring(Index number) const {
  Ring result;
  for (const Index p : faces_[number].corners) {
    result.push_back(points_[p]);
  }
  return result;
}

Vec3 Shape::centre(Index number) const {
  return mean(ring(number));
}

Vec3 Shape::normal(Index number) const {
  return normalized(area_vector(ring(number)));
}

void Shape::mirror_x() {
  const std::size_t count = faces_.size();
  for (std::size_t f = 0; f < count; ++f) {
    Ring corners = reversed(ring(static_cast<Index>(f)));
    for (Vec3& p : corners) {
      p.x = -p.x;
    }
    face(corners, faces_[f].material);
  }
}

void Shape::add(const Shape& other) {
  const auto shift = static_cast<Index>(points_.size());
  const auto material_shift = static_cast<Index>(materials_.size());
  points_.insert(points_.end(), other.points_.begin(), other.points_.end());
  materials_.insert(materials_.end(), other.materials_.begin(), other.materials_.end());
  for (Face face : other.faces_) {
    for (Index& corner : face.corners) {
      corner += shift;
    }
    face.material += material_shift;
    faces_.push_back(std::move(face));
  }
}

void Shape::join_equal_points() {
  std::map<std::array<double, 3>, Index> known;
  std::vector<Vec3> points;
  for (Face& face : faces_) {
    std::vector<Index> corners;
    for (const Index corner : face.corners) {
      const Vec3 p = points_[corner];
      const Vec3 q{rounded(p.x), rounded(p.y), rounded(p.z)};
      const auto [place, is_new] = known.try_emplace({q.x, q.y, q.z}, static_cast<Index>(points.size()));
      if (is_new) {
        points.push_back(q);
      }
      if (corners.empty() || corners.back() != place->second) {
        corners.push_back(place->second);
      }
    }
    while (corners.size() > 1 && corners.front() == corners.back()) {
      corners.pop_back();
    }
    face.corners = std::move(corners);
  }
  points_ = std::move(points);
  std::erase_if(faces_, [](const Face& face) { return face.corners.size() < 3; });
}

void Shape::split_bent_faces() {
  std::vector<Face> result;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Ring corners = ring(static_cast<Index>(f));
    const Vec3 up = normal(static_cast<Index>(f));
    const Vec3 middle = mean(corners);
    const bool plane = std::all_of(corners.begin(), corners.end(),
                                   [&](Vec3 p) { return std::abs(dot(p - middle, up)) <= plane_tolerance; });
    if (plane) {
      result.push_back(faces_[f]);
      continue;
    }
    if (corners.size() != 4) {
      throw std::logic_error("a polygon with " + std::to_string(corners.size()) + " corners isn't plane");
    }
    // Is the fourth corner behind the plane of the first three? Then the diagonal between first and third is
    // a ridge.
    const bool ridge = dot(area_vector({corners[0], corners[1], corners[2]}), corners[3] - corners[0]) < 0.0;
    const std::vector<Index>& c = faces_[f].corners;
    const std::size_t s = ridge ? 0 : 1;
    result.push_back({{c[s], c[s + 1], c[s + 2]}, faces_[f].material});
    result.push_back({{c[s], c[s + 2], c[(s + 3) % 4]}, faces_[f].material});
  }
  faces_ = std::move(result);
}

void Shape::finish() {
  join_equal_points();
  split_bent_faces();
}

Grid loft(Shape& shape, const std::vector<Ring>& rings, bool closed, Index material) {
  const std::size_t points = rings.front().size();
  const std::size_t columns = closed ? points : points - 1;
  const Grid grid{shape.face_count(), static_cast<Index>(columns)};
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t next = (k + 1) % points;
      shape.face({rings[i][k], rings[i + 1][k], rings[i + 1][next], rings[i][next]}, material);
    }
  }
  return grid;
}

Grid revolve(Shape& shape, const std::vector<Vec2>& profile, int steps, Index material, double start) {
  std::vector<Ring> rings;
  for (const Vec2 p : profile) {
    // Upwards on the outside, seen from there, is to the right when the rings run clockwise.
    rings.push_back(reversed(circle(p.x, p.y, steps, start)));
  }
  return loft(shape, rings, true, material);
}

Ring circle(double radius, double height, int steps, double start) {
  Ring ring;
  for (int k = 0; k < steps; ++k) {
    const double angle = start + 2.0 * std::numbers::pi * k / steps;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
  }
  return ring;
}

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring scaled(const Ring& ring, Vec3 centre, double factor, Vec3 shift) {
  Ring result;
  for (const Vec3 p : ring) {
    result.push_back(centre + factor * (p - centre) + shift);
  }
  return result;
}

Ring patch(const Ring& quad, Vec2 low, Vec2 high) {
  const auto at = [&quad](double u, double v) {
    return (1.0 - v) * ((1.0 - u) * quad[0] + u * quad[1]) + v * ((1.0 - u) * quad[3] + u * quad[2]);
  };
  return {at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
}

Ring shifted(const Ring& ring, Vec3 by) {
  return scaled(ring, {}, 1.0, by);
}

Vec3 mean(const Ring& ring) {
  Vec3 sum;
  for (const Vec3 p : ring) {
    sum += p / static_cast<double>(ring.size());
  }
  return sum;
}

}  // namespace ridgecraft::samples
