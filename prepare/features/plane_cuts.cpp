// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/plane_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/delaunay.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::prepare {

PlaneCuts::PlaneCuts(const mesh::Model& model, double in_plane)
    : surface_(model.surface),
      all_(mesh::take_apart(model)),
      in_plane_(in_plane),
      gone_(surface_.face_count(), false) {}

bool PlaneCuts::stands_out(const PlaneSide& side, FaceId f) const {
  const auto corners = surface_.vertices(f);
  return std::any_of(corners.begin(), corners.end(),
                     [&](VertexId v) { return side.height(surface_.point(v)) > in_plane_; });
}

std::vector<FaceId> PlaneCuts::in_front(const PlaneSide& side, FaceId start,
                                        const std::function<bool(VertexId)>& may_go,
                                        std::set<std::uint32_t>& tried) const {
  std::vector<FaceId> faces{start};
  std::set<std::uint32_t> own{start.value()};
  const auto height = [&](VertexId v) { return side.height(surface_.point(v)); };
  bool fits = true;
  for (std::size_t i = 0; i < faces.size() && fits; ++i) {
    fits = !is_gone(faces[i]);
    for (const VertexId v : surface_.vertices(faces[i])) {
      fits = fits && (height(v) <= in_plane_ || may_go(v));
    }
    for (unsigned k = 0; k < 3 && fits; ++k) {
      const CornerId c = mesh::corner(faces[i], k);
      const CornerId beyond = surface_.twin(c);
      const double higher = std::max(height(surface_.vertex(c)), height(surface_.vertex(mesh::next(c))));
      if (beyond.valid() && higher > in_plane_ && own.insert(mesh::face_of(beyond).value()).second) {
        fits = !tried.contains(mesh::face_of(beyond).value());
        faces.push_back(mesh::face_of(beyond));
      }
    }
  }
  tried.insert(own.begin(), own.end());
  return fits ? faces : std::vector<FaceId>();
}

std::optional<PlaneCut> PlaneCuts::look_at(const PlaneSide& side, const std::vector<FaceId>& faces,
                                           FaceId like) {
  PlaneCut cut;
  cut.faces = faces;
  cut.first_point = all_.points.size();
  Line line;
  for (const FaceId f : faces) {
    divide(side, f, cut, line);
  }
  if (!cap(side, line, like.value(), cut.caps)) {
    drop(cut);
    return std::nullopt;
  }
  return cut;
}

double PlaneCuts::covered(const PlaneCut& cut) const {
  double area = 0.0;
  for (const auto& [corners, like] : cut.caps) {
    const auto& [a, b, c] = corners;
    area += 0.5 * length(cross(all_.points[b] - all_.points[a], all_.points[c] - all_.points[a]));
  }
  return area;
}

void PlaneCuts::make(const PlaneCut& cut) {
  rests_.insert(rests_.end(), cut.rests.begin(), cut.rests.end());
  caps_.insert(caps_.end(), cut.caps.begin(), cut.caps.end());
  for (const FaceId f : cut.faces) {
    gone_[f.value()] = true;
  }
}

bool PlaneCuts::finish(mesh::Model& model) {
  mesh::LooseFaces result = with_caps(all_, gone_, caps_);
  for (const auto& [face, like] : rests_) {
    result.add(all_, like, face);
  }
  if (!mesh::is_surface(result)) {
    return false;
  }
  mesh::put_together(model, std::move(result));
  return true;
}

std::uint32_t PlaneCuts::crossing(const PlaneSide& side, VertexId a, VertexId b, Line& line) {
  const std::array<std::uint32_t, 2> edge{std::min(a.value(), b.value()), std::max(a.value(), b.value())};
  const auto [at, is_new] = line.crossing.try_emplace(edge, static_cast<std::uint32_t>(all_.points.size()));
  if (is_new) {
    const Vec3 low = surface_.point(VertexId(edge[0]));
    const Vec3 high = surface_.point(VertexId(edge[1]));
    const double t = side.height(low) / (side.height(low) - side.height(high));
    all_.points.push_back(low + t * (high - low));
  }
  return at->second;
}

/// The part of a face behind the plane stays; the line between it and the other part, or the face's own side
/// in the plane, is where it is cut.
void PlaneCuts::divide(const PlaneSide& side, FaceId f, PlaneCut& cut, Line& line) {
  const auto corners = surface_.vertices(f);
  std::vector<std::uint32_t> above;
  std::vector<std::uint32_t> below;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = corners[k];
    const VertexId w = corners[(k + 1) % 3];
    const double here = side.height(surface_.point(v));
    const double there = side.height(surface_.point(w));
    if (here >= -in_plane_) {
      above.push_back(v.value());
    }
    if (here <= in_plane_) {
      below.push_back(v.value());
    }
    if (std::min(here, there) < -in_plane_ && std::max(here, there) > in_plane_) {
      const std::uint32_t p = crossing(side, v, w, line);
      above.push_back(p);
      below.push_back(p);
    }
  }
  const auto is_in_plane = [&](std::uint32_t p) {
    return p >= surface_.vertex_count() || std::abs(side.height(surface_.point(VertexId(p)))) <= in_plane_;
  };
  for (std::size_t i = 0; i < above.size(); ++i) {
    const std::uint32_t p = above[i];
    const std::uint32_t q = above[(i + 1) % above.size()];
    if (is_in_plane(p) && is_in_plane(q)) {
      line.sides.push_back({p, q});
    }
  }
  for (std::size_t i = 2; i < below.size(); ++i) {
    cut.rests.push_back({{below[0], below[i - 1], below[i]}, f.value()});
  }
}

/// The plane goes on where something was cut off. False where the line isn't closed.
bool PlaneCuts::cap(const PlaneSide& side, const Line& line, std::size_t like, Caps& caps) const {
  std::map<std::uint32_t, std::uint32_t> index;
  std::map<std::uint32_t, int> balance;
  std::vector<std::uint32_t> vertices;
  std::vector<Vec2> flat;
  std::vector<std::array<std::uint32_t, 2>> sides;
  if (line.sides.empty()) {
    return false;
  }
  const PlaneFrame frame(all_.points[line.sides.front()[0]], side.plane.normal);
  for (const auto& [p, q] : line.sides) {
    std::array<std::uint32_t, 2> ends{};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t v = k == 0 ? p : q;
      const auto [at, is_new] = index.try_emplace(v, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) {
        vertices.push_back(v);
        flat.push_back(frame.flat(all_.points[v]));
      }
      ends[k] = at->second;
    }
    ++balance[p];
    --balance[q];
    sides.push_back(ends);
  }
  if (std::any_of(balance.begin(), balance.end(), [](const auto& b) { return b.second != 0; })) {
    return false;
  }
  const auto triangles = triangulate_inside(flat, sides);
  if (!triangles || triangles->empty()) {
    return false;
  }
  for (const auto& [a, b, c] : *triangles) {
    caps.push_back({{vertices[a], vertices[b], vertices[c]}, like});
  }
  return true;
}

}  // namespace ridgecraft::prepare
