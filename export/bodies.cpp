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

/// A vertex and a face that has it.
struct Sample {
  Vec3 point;
  FaceId face;
};

/// A body's smallest box, its vertices and its faces.
struct Hull {
  Box3 box;
  std::vector<Sample> samples;
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
        hull.samples.push_back({surface.point(v), f});
        hull.box.add(surface.point(v));
      }
    }
  }
  return hulls;
}

/// Fewer vertices, spread over all of them.
void thin_out(std::vector<Sample>& samples, std::size_t most) {
  const std::size_t step = (samples.size() + most - 1) / most;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    samples[kept++] = samples[i];
  }
  samples.resize(kept);
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

/// Vertices of one body against the faces of another one; the face of `other` is kept, whichever side it is
/// on.
void look_at(const Surface& surface, const Hull& corners, const Hull& sides, bool sides_are_other,
             Nearest& nearest) {
  for (const Sample& sample : corners.samples) {
    Box3 point;
    point.add(sample.point);
    if (squared_gap(point, sides.box) >= nearest.squared) {
      continue;
    }
    for (const FaceId f : sides.faces) {
      const auto [a, b, c] = surface.vertices(f);
      Box3 face;
      for (const VertexId v : {a, b, c}) {
        face.add(surface.point(v));
      }
      if (squared_gap(point, face) < nearest.squared) {
        const double squared =
            mesh::squared_distance(surface.point(a), surface.point(b), surface.point(c), sample.point);
        nearest = squared < nearest.squared ? Nearest{sides_are_other ? f : sample.face, squared} : nearest;
      }
    }
  }
}

void find_neighbours(const Surface& surface, const unfold::Nets& nets,
                     const std::vector<std::uint32_t>& component, std::vector<Body>& bodies) {
  std::vector<Hull> hulls = hulls_of(surface);
  const std::size_t samples = std::min(
      most_samples, most_pairs / (2 * bodies.size() * std::max<std::size_t>(1, surface.face_count())));
  if (samples == 0) {
    return;
  }
  for (Hull& hull : hulls) {
    thin_out(hull.samples, samples);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Hull& own = hulls[component[i]];
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
        look_at(surface, own, hulls[other], true, nearest);
        look_at(surface, hulls[other], own, false, nearest);
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
