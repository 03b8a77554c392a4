// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/bodies.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/surface_distance.hpp"

namespace ridgecraft::paper {
namespace {

using mesh::Surface;

/// Pairs of a vertex and a face that are looked at, all bodies together: some 0.05 s.
constexpr std::size_t most_pairs = 4'000'000;
/// Vertices of one body that are enough to find what it stands on.
constexpr std::size_t most_samples = 100;
/// Names in a row before the rest is only counted.
constexpr std::size_t most_names = 6;

/// Smallest rectangles round a body's faces, and its vertices.
struct Hull {
  Box3 box;
  std::vector<Vec3> points;
  std::vector<FaceId> faces;
};

std::vector<Hull> hulls_of(const Surface& surface) {
  std::vector<Hull> hulls(surface.component_count());
  std::vector<bool> seen(surface.vertex_count(), false);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Hull& hull = hulls[surface.component(f).value()];
    hull.faces.push_back(f);
    for (const VertexId v : surface.vertices(f)) {
      if (!seen[v.value()]) {
        seen[v.value()] = true;
        hull.points.push_back(surface.point(v));
        hull.box.add(surface.point(v));
      }
    }
  }
  return hulls;
}

double squared_gap(const Box3& a, const Box3& b) {
  const auto gap = [](double low, double high, double other_low, double other_high) {
    return std::max({0.0, other_low - high, low - other_high});
  };
  const Vec3 d{gap(a.low.x, a.high.x, b.low.x, b.high.x), gap(a.low.y, a.high.y, b.low.y, b.high.y),
               gap(a.low.z, a.high.z, b.low.z, b.high.z)};
  return dot(d, d);
}

struct Nearest {
  FaceId face;
  double squared = INFINITY;
};

/// The face of `other` nearest to some of the points.
void look_at(const Surface& surface, const Hull& other, const std::vector<Vec3>& points, Nearest& nearest) {
  for (const Vec3 p : points) {
    Box3 point;
    point.add(p);
    if (squared_gap(point, other.box) >= nearest.squared) {
      continue;
    }
    for (const FaceId f : other.faces) {
      const auto [a, b, c] = surface.vertices(f);
      const double squared = mesh::squared_distance(surface.point(a), surface.point(b), surface.point(c), p);
      if (squared < nearest.squared) {
        nearest = {f, squared};
      }
    }
  }
}

std::vector<Vec3> thinned(const std::vector<Vec3>& points, std::size_t most) {
  std::vector<Vec3> some;
  const std::size_t step = (points.size() + most - 1) / most;
  for (std::size_t i = 0; i < points.size(); i += step) {
    some.push_back(points[i]);
  }
  return some;
}

void find_neighbours(const Surface& surface, const unfold::Nets& nets,
                     const std::vector<std::uint32_t>& component, std::vector<Body>& bodies) {
  const std::vector<Hull> hulls = hulls_of(surface);
  const std::size_t samples =
      std::min(most_samples, most_pairs / (bodies.size() * std::max<std::size_t>(1, surface.face_count())));
  for (std::size_t i = 0; samples > 0 && i < bodies.size(); ++i) {
    const Hull& own = hulls[component[i]];
    const std::vector<Vec3> points = thinned(own.points, samples);
    // The nearest boxes first: most of the others needn't be looked at then.
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t other = 0; other < hulls.size(); ++other) {
      if (other != component[i]) {
        others.emplace_back(squared_gap(own.box, hulls[other].box), other);
      }
    }
    std::sort(others.begin(), others.end());
    Nearest nearest;
    for (const auto& [gap, other] : others) {
      if (gap < nearest.squared) {
        look_at(surface, hulls[other], points, nearest);
      }
    }
    bodies[i].beside = nets.piece[nearest.face];
    bodies[i].distance_mm = std::sqrt(nearest.squared);
  }
}

}  // namespace

std::vector<Body> find_bodies(const mesh::Prepared& model, const unfold::Nets& nets) {
  const Surface& surface = model.model.surface;
  if (surface.component_count() < 2) {
    return {};
  }
  std::vector<Body> bodies;
  std::vector<std::uint32_t> component;  // of each body
  std::vector<std::size_t> number(surface.component_count(), SIZE_MAX);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const std::uint32_t own = surface.component(nets.pieces[p].faces.front()).value();
    if (number[own] == SIZE_MAX) {
      number[own] = bodies.size();
      bodies.emplace_back();
      component.push_back(own);
    }
    bodies[number[own]].pieces.push_back(p);
  }
  find_neighbours(surface, nets, component, bodies);
  return bodies;
}

std::string piece_names(const unfold::Nets& nets, const std::vector<PieceId>& pieces) {
  const auto name = [&](PieceId p) { return nets.pieces[p].name; };
  const bool in_a_row = pieces.back().value() - pieces.front().value() + 1 == pieces.size();
  if (in_a_row && pieces.size() > 2) {
    return name(pieces.front()) + " to " + name(pieces.back());
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(pieces.size(), most_names); ++i) {
    text += (i == 0 ? "" : ", ") + name(pieces[i]);
  }
  return pieces.size() <= most_names ? text
                                     : text + " and " + std::to_string(pieces.size() - most_names) + " more";
}

}  // namespace ridgecraft::paper
