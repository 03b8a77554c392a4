// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "base/disjoint_sets.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::export_ {
namespace {

using mesh::Surface;

/// Pairs of a vertex and a face that are looked at, all bodies together: some 0.05 s.
constexpr std::size_t most_pairs = 4'000'000;
/// Vertices of one body that are enough to find what it stands on.
constexpr std::size_t most_samples = 100;

/// A vertex and a face that has it.
struct Sample {
  Vec3 point;
  FaceId face;
};

/// A body's smallest box, its vertices and its faces.
struct Extent {
  Box3 box;
  std::vector<Sample> samples;
  std::vector<FaceId> faces;
};

std::vector<Extent> extents_of(const Surface& surface) {
  std::vector<Extent> extents(surface.component_count());
  std::vector<bool> seen(surface.vertex_count(), false);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Extent& extent = extents[surface.component(f).value()];
    extent.faces.push_back(f);
    for (const VertexId v : surface.vertices(f)) {
      if (!seen[v.value()]) {
        seen[v.value()] = true;
        extent.samples.push_back({surface.point(v), f});
        extent.box.add(surface.point(v));
      }
    }
  }
  return extents;
}

/// Fewer vertices, spread over all of them.
void keep_evenly(std::vector<Sample>& samples, std::size_t most) {
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

/// The vertices of one body against the faces of another one. What is nearest is kept as a face of the other
/// body, whichever of the two that is.
void measure_to_faces(const Surface& surface, const Extent& of_vertices, const Extent& of_faces,
                      bool faces_are_other, Nearest& nearest) {
  for (const Sample& sample : of_vertices.samples) {
    Box3 point;
    point.add(sample.point);
    if (squared_gap(point, of_faces.box) >= nearest.squared) {
      continue;
    }
    for (const FaceId f : of_faces.faces) {
      const auto [a, b, c] = surface.vertices(f);
      Box3 face;
      for (const VertexId v : {a, b, c}) {
        face.add(surface.point(v));
      }
      if (squared_gap(point, face) < nearest.squared) {
        const double squared =
            mesh::squared_distance(surface.point(a), surface.point(b), surface.point(c), sample.point);
        nearest = squared < nearest.squared ? Nearest{faces_are_other ? f : sample.face, squared} : nearest;
      }
    }
  }
}

void find_nearest(const Surface& surface, const unfold::Nets& nets,
                  const std::vector<std::uint32_t>& component, std::vector<Body>& bodies) {
  std::vector<Extent> extents = extents_of(surface);
  const std::size_t samples = std::min(
      most_samples, most_pairs / (2 * bodies.size() * std::max<std::size_t>(1, surface.face_count())));
  if (samples == 0) {
    return;
  }
  for (Extent& extent : extents) {
    keep_evenly(extent.samples, samples);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Extent& own = extents[component[i]];
    // The nearest boxes first: most of the others needn't be looked at then.
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t other = 0; other < extents.size(); ++other) {
      if (other != component[i]) {
        others.emplace_back(squared_gap(own.box, extents[other].box), other);
      }
    }
    std::sort(others.begin(), others.end());
    Nearest nearest;
    for (const auto& [gap, other] : others) {
      if (gap < nearest.squared) {
        measure_to_faces(surface, own, extents[other], true, nearest);
        measure_to_faces(surface, extents[other], own, false, nearest);
      }
    }
    bodies[i].beside = nets.piece[nearest.face];
    bodies[i].distance_mm = std::sqrt(nearest.squared);
  }
}

}  // namespace

std::vector<Body> find_bodies(const prepare::Prepared& model, const unfold::Nets& nets,
                              std::span<const Contact> contacts) {
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
  find_nearest(surface, nets, component, bodies);
  for (const Contact& contact : contacts) {
    const std::uint32_t own = surface.component(nets.pieces[contact.other].faces.front()).value();
    bodies[number[own]].glued_onto.push_back({contact.other, contact.piece});
  }
  for (Body& body : bodies) {
    std::ranges::sort(body.glued_onto);
  }
  return bodies;
}

std::size_t bodies_apart(std::span<const Body> bodies) {
  std::map<PieceId, std::uint32_t> body_of;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const PieceId piece : bodies[i].pieces) {
      body_of.emplace(piece, static_cast<std::uint32_t>(i));
    }
  }
  DisjointSets sets(bodies.size());
  std::size_t apart = bodies.size();
  for (const Body& body : bodies) {
    for (const auto& [piece, other] : body.glued_onto) {
      apart -= sets.join(body_of.at(piece), body_of.at(other)) ? 1U : 0U;
    }
  }
  return apart;
}

}  // namespace ridgecraft::export_
