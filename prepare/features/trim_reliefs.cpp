// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/trim_reliefs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/constrained_delaunay.hpp"
#include "base/plane_frame.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/features/wall_loops.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// What is no farther from a wall than this share of the short edge lies in its plane.
constexpr double in_plane = 0.01;
/// What goes makes room for what is found after it: a panel within a panel.
constexpr int most_rounds = 4;
/// Much to fold: so many faces at least, ...
constexpr std::size_t busy_faces = 16;
/// ... and this share of their edges shorter than folds should be.
constexpr double busy_share = 0.5;

class ReliefTrimmer {
 public:
  ReliefTrimmer(const mesh::Model& model, const SimplifyOptions& options, const ReliefLimits& limits)
      : surface_(model.surface),
        all_(mesh::take_apart(model)),
        walls_(find_walls(surface_, find_panels(surface_), options.short_edge_mm, Slats::are_none)),
        loops_(loops_within(surface_, walls_)),
        short_edge_(options.short_edge_mm),
        limits_(limits),
        in_plane_(in_plane * options.short_edge_mm),
        of_loop_(surface_.corner_count(), false),
        done_(surface_.face_count(), false) {}

  std::size_t run(mesh::Model& model) {
    for (const WallLoop& loop : loops_) {
      for (const CornerId c : loop.sides) {
        of_loop_[c.value()] = true;
      }
    }
    std::size_t count = 0;
    for (const WallLoop& loop : loops_) {
      if (loop.box.largest_extent() <= short_edge_ || loop.leaves_wall()) {
        count += close(loop) ? 1U : trim(loop, 1.0) + trim(loop, -1.0);
      }
    }
    if (count == 0) {
      return 0;
    }
    mesh::LooseFaces result = with_caps(all_, done_, caps_);
    for (const auto& [face, like] : rests_) {
      result.add(all_, like, face);
    }
    if (!mesh::is_surface(result)) {
      return 0;
    }
    mesh::put_together(model, std::move(result));
    return count;
  }

 private:
  /// One side of a wall's plane, and what is near a loop in it.
  struct Side {
    const Wall* wall;
    double sign;
    const WallLoop* loop;
  };

  [[nodiscard]] double height(const Side& side, VertexId v) const {
    return side.sign * side.wall->height(surface_.point(v));
  }

  [[nodiscard]] bool is_shallow(const Side& side, VertexId v) const {
    return height(side, v) <= limits_.height_mm &&
           distance(side.loop->box, surface_.point(v)) <= limits_.height_mm;
  }

  static double distance(const Box3& box, Vec3 p) {
    return length(p - Vec3{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y),
                           std::clamp(p.z, box.low.z, box.high.z)});
  }

  /// Takes out all that is behind a loop, if all of it is shallow and comes out nowhere else.
  bool close(const WallLoop& loop) {
    std::set<FaceId> inside;
    std::vector<FaceId> next;
    const auto visit = [&](CornerId beyond) {
      const FaceId f = mesh::face_of(beyond);
      if (inside.insert(f).second) {
        next.push_back(f);
      }
    };
    std::set<std::uint32_t> ends;
    for (const CornerId c : loop.sides) {
      ends.insert(c.value());
      if (surface_.twin(c).valid()) {
        visit(surface_.twin(c));
      }
    }
    const Wall& wall = walls_.walls[loop.wall];
    while (!next.empty()) {
      const FaceId f = next.back();
      next.pop_back();
      const auto corners = surface_.vertices(f);
      if (done_[f.value()] || !std::all_of(corners.begin(), corners.end(), [&](VertexId v) {
            return is_shallow({&wall, 1.0, &loop}, v) && is_shallow({&wall, -1.0, &loop}, v);
          })) {
        return false;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId beyond = surface_.twin(mesh::corner(f, k));
        if (!beyond.valid() || ends.contains(beyond.value())) {
          continue;
        }
        if (of_loop_[beyond.value()]) {
          return false;
        }
        visit(beyond);
      }
    }
    if (inside.empty() || !goes({&wall, 1.0, &loop}, inside) || !close_loop(surface_, walls_, loop, caps_)) {
      return false;
    }
    for (const FaceId f : inside) {
      done_[f.value()] = true;
    }
    return true;
  }

  /// Cuts off what is shallow on one side of the wall; returns how many places.
  std::size_t trim(const WallLoop& loop, double sign) {
    const Side side{&walls_.walls[loop.wall], sign, &loop};
    std::size_t count = 0;
    std::set<std::uint32_t> tried;
    for (const CornerId c : loop.sides) {
      const CornerId beyond = surface_.twin(c);
      if (beyond.valid() && !tried.contains(mesh::face_of(beyond).value()) &&
          stands_out(side, mesh::face_of(beyond))) {
        count += cut_off(side, mesh::face_of(beyond), tried) ? 1U : 0U;
      }
    }
    return count;
  }

  [[nodiscard]] bool stands_out(const Side& side, FaceId f) const {
    const auto corners = surface_.vertices(f);
    return std::any_of(corners.begin(), corners.end(),
                       [&](VertexId v) { return height(side, v) > in_plane_; });
  }

  /// What hangs together on this side of the plane: faces, some of them only with a part. None where it isn't
  /// to go. `tried`: faces of what was looked at before.
  std::vector<FaceId> what_stands_out(const Side& side, FaceId start, std::set<std::uint32_t>& tried) const {
    std::vector<FaceId> faces{start};
    std::set<std::uint32_t> own{start.value()};
    bool fits = true;
    for (std::size_t i = 0; i < faces.size() && fits; ++i) {
      fits = !done_[faces[i].value()];
      for (const VertexId v : surface_.vertices(faces[i])) {
        fits = fits && (height(side, v) <= in_plane_ || is_shallow(side, v));
      }
      for (unsigned k = 0; k < 3 && fits; ++k) {
        const CornerId c = mesh::corner(faces[i], k);
        const CornerId beyond = surface_.twin(c);
        const double higher =
            std::max(height(side, surface_.vertex(c)), height(side, surface_.vertex(mesh::next(c))));
        if (beyond.valid() && higher > in_plane_ && own.insert(mesh::face_of(beyond).value()).second) {
          fits = !tried.contains(mesh::face_of(beyond).value());
          faces.push_back(mesh::face_of(beyond));
        }
      }
    }
    tried.insert(own.begin(), own.end());
    return fits && goes(side, {faces.begin(), faces.end()}) ? faces : std::vector<FaceId>();
  }

  bool cut_off(const Side& side, FaceId start, std::set<std::uint32_t>& tried) {
    const std::vector<FaceId> faces = what_stands_out(side, start, tried);
    if (faces.empty()) {
      return false;
    }
    const std::size_t points = all_.points.size();
    Cut cut;
    for (const FaceId f : faces) {
      divide(side, f, cut);
    }
    Caps caps;
    if (!cap(side, cut, caps)) {
      all_.points.resize(points);
      return false;
    }
    rests_.insert(rests_.end(), cut.rests.begin(), cut.rests.end());
    caps_.insert(caps_.end(), caps.begin(), caps.end());
    for (const FaceId f : faces) {
      done_[f.value()] = true;
    }
    return true;
  }

  /// Whether there is so much to fold as it takes.
  [[nodiscard]] bool goes(const Side& side, const std::set<FaceId>& faces) const {
    if (!limits_.busy_only) {
      return true;
    }
    std::size_t edges = 0;
    std::size_t brief = 0;
    for (const FaceId f : faces) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        if (std::abs(height(side, surface_.vertex(c))) > in_plane_ ||
            std::abs(height(side, surface_.vertex(mesh::next(c)))) > in_plane_) {
          ++edges;
          brief += surface_.length(surface_.edge(c)) < short_edge_ ? 1U : 0U;
        }
      }
    }
    return faces.size() >= busy_faces &&
           static_cast<double>(brief) >= busy_share * static_cast<double>(edges);
  }

  struct Cut {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> crossing;  ///< of each edge: where the plane is
    Caps rests;                                                      ///< of faces that were cut
    std::vector<std::array<std::uint32_t, 2>> rim;  ///< in the plane, as what was cut off ran along it
  };

  std::uint32_t crossing(const Side& side, VertexId a, VertexId b, Cut& cut) {
    const std::array<std::uint32_t, 2> edge{std::min(a.value(), b.value()), std::max(a.value(), b.value())};
    const auto [at, is_new] = cut.crossing.try_emplace(edge, static_cast<std::uint32_t>(all_.points.size()));
    if (is_new) {
      const VertexId low(edge[0]);
      const VertexId high(edge[1]);
      const double t = height(side, low) / (height(side, low) - height(side, high));
      all_.points.push_back(surface_.point(low) + t * (surface_.point(high) - surface_.point(low)));
    }
    return at->second;
  }

  /// The part of a face behind the plane stays; the line between it and the other part, or the face's own
  /// side in the plane, is the rim.
  void divide(const Side& side, FaceId f, Cut& cut) {
    const auto corners = surface_.vertices(f);
    std::vector<std::uint32_t> above;
    std::vector<std::uint32_t> below;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = corners[k];
      const VertexId w = corners[(k + 1) % 3];
      const double here = height(side, v);
      const double there = height(side, w);
      if (here >= -in_plane_) {
        above.push_back(v.value());
      }
      if (here <= in_plane_) {
        below.push_back(v.value());
      }
      if (std::min(here, there) < -in_plane_ && std::max(here, there) > in_plane_) {
        const std::uint32_t p = crossing(side, v, w, cut);
        above.push_back(p);
        below.push_back(p);
      }
    }
    const auto is_in_plane = [&](std::uint32_t p) {
      return p >= surface_.vertex_count() || std::abs(height(side, VertexId(p))) <= in_plane_;
    };
    for (std::size_t i = 0; i < above.size(); ++i) {
      const std::uint32_t p = above[i];
      const std::uint32_t q = above[(i + 1) % above.size()];
      if (is_in_plane(p) && is_in_plane(q)) {
        cut.rim.push_back({p, q});
      }
    }
    for (std::size_t i = 2; i < below.size(); ++i) {
      cut.rests.push_back({{below[0], below[i - 1], below[i]}, f.value()});
    }
  }

  /// The wall goes on where something was cut off. False where its rim isn't closed.
  [[nodiscard]] bool cap(const Side& side, const Cut& cut, Caps& caps) const {
    std::map<std::uint32_t, std::uint32_t> index;
    std::map<std::uint32_t, int> balance;
    std::vector<std::uint32_t> vertices;
    std::vector<Vec2> flat;
    std::vector<std::array<std::uint32_t, 2>> sides;
    if (cut.rim.empty()) {
      return false;
    }
    const PlaneFrame frame(all_.points[cut.rim.front()[0]], side.wall->normal);
    for (const auto& [p, q] : cut.rim) {
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
    const std::size_t like = mesh::face_of(side.loop->sides.front()).value();
    for (const auto& [a, b, c] : *triangles) {
      caps.push_back({{vertices[a], vertices[b], vertices[c]}, like});
    }
    return true;
  }

  const mesh::Surface& surface_;
  mesh::LooseFaces all_;  ///< with points where edges cross a wall's plane
  Walls walls_;
  std::vector<WallLoop> loops_;
  double short_edge_;
  ReliefLimits limits_;
  double in_plane_;
  std::vector<bool> of_loop_;  ///< sides of walls
  std::vector<bool> done_;     ///< faces that are gone or replaced
  Caps rests_;
  Caps caps_;
};

}  // namespace

std::size_t trim_reliefs(mesh::Model& model, const SimplifyOptions& options, const ReliefLimits& limits,
                         const Context& context) {
  std::size_t all = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t count = ReliefTrimmer(model, options, limits).run(model);
    if (count == 0) {
      break;
    }
    remesh_panels(model, context);
    all += count;
  }
  return all;
}

}  // namespace ridgecraft::prepare
