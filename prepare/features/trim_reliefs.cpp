// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/trim_reliefs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "prepare/features/plane_cuts.hpp"
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
        walls_(find_walls(surface_, find_panels(surface_), options.short_edge_mm, Slats::are_none)),
        loops_(loops_within(surface_, walls_)),
        short_edge_(options.short_edge_mm),
        limits_(limits),
        in_plane_(in_plane * options.short_edge_mm),
        of_loop_(surface_.corner_count(), false),
        cuts_(model, in_plane_) {}

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
    return count > 0 && cuts_.finish(model) ? count : 0;
  }

 private:
  /// One side of a wall's plane, and what is near a loop in it.
  struct Side {
    PlaneSide plane;
    const WallLoop* loop;
  };

  [[nodiscard]] Side side_of(const WallLoop& loop, double sign) const {
    return {{walls_.walls[loop.wall], sign}, &loop};
  }

  [[nodiscard]] double height(const Side& side, VertexId v) const {
    return side.plane.height(surface_.point(v));
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
    const Side front = side_of(loop, 1.0);
    const Side behind = side_of(loop, -1.0);
    while (!next.empty()) {
      const FaceId f = next.back();
      next.pop_back();
      const auto corners = surface_.vertices(f);
      if (cuts_.is_gone(f) || !std::all_of(corners.begin(), corners.end(), [&](VertexId v) {
            return is_shallow(front, v) && is_shallow(behind, v);
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
    PlaneCut cut;
    if (inside.empty() || !goes(front, inside) || !close_loop(surface_, walls_, loop, cut.caps)) {
      return false;
    }
    cut.faces.assign(inside.begin(), inside.end());
    cuts_.make(cut);
    return true;
  }

  /// Cuts off what is shallow on one side of the wall; returns how many places.
  std::size_t trim(const WallLoop& loop, double sign) {
    const Side side = side_of(loop, sign);
    std::size_t count = 0;
    std::set<std::uint32_t> tried;
    for (const CornerId c : loop.sides) {
      const CornerId beyond = surface_.twin(c);
      if (beyond.valid() && !tried.contains(mesh::face_of(beyond).value()) &&
          cuts_.stands_out(side.plane, mesh::face_of(beyond))) {
        count += cut_off(side, mesh::face_of(beyond), tried) ? 1U : 0U;
      }
    }
    return count;
  }

  bool cut_off(const Side& side, FaceId start, std::set<std::uint32_t>& tried) {
    const std::vector<FaceId> faces = cuts_.in_front(
        side.plane, start, [&](VertexId v) { return is_shallow(side, v); }, tried);
    if (faces.empty() || !goes(side, {faces.begin(), faces.end()})) {
      return false;
    }
    const std::optional<PlaneCut> cut =
        cuts_.look_at(side.plane, faces, mesh::face_of(side.loop->sides.front()));
    if (cut) {
      cuts_.make(*cut);
    }
    return cut.has_value();
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

  const mesh::Surface& surface_;
  Walls walls_;
  std::vector<WallLoop> loops_;
  double short_edge_;
  ReliefLimits limits_;
  double in_plane_;
  std::vector<bool> of_loop_;  ///< sides of walls
  PlaneCuts cuts_;
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
