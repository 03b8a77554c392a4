// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/trim_reliefs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/delaunay.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"
#include "mesh/model/model.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/features/features.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

// Cutting off what stands out of a plane.

/// A plane of which one side is its front.
struct PlaneSide {
  Wall plane;
  double sign = 1.0;  ///< -1: what the normal looks away from is in front

  [[nodiscard]] double height(Vec3 p) const { return sign * plane.height(p); }
};

/// What becomes of faces that are cut along a plane.
struct PlaneCut {
  std::vector<FaceId> faces;  ///< that are gone
  Caps rests;                 ///< of them, behind the plane
  Caps caps;                  ///< the plane, where something was cut off
  std::size_t first_point = 0;
};

/// Cuts parts of a model off along planes, one after the other; no face is cut twice.
class PlaneCuts {
 public:
  /// What is no farther from a plane than `in_plane` lies in it. The model stays where it is.
  PlaneCuts(const mesh::Model& model, double in_plane);

  [[nodiscard]] bool is_gone(FaceId f) const { return gone_[f.value()]; }
  [[nodiscard]] bool stands_out(const PlaneSide& side, FaceId f) const;
  /// What hangs together with a face in front of the plane: faces, some of them only with a part. None where
  /// a corner in front of it may not go, or a face is gone. `tried`: faces that were looked at, which aren't
  /// looked at again. O(n log n) for n faces.
  [[nodiscard]] std::vector<FaceId> in_front(const PlaneSide& side, FaceId start,
                                             const std::function<bool(VertexId)>& may_go,
                                             std::set<std::uint32_t>& tried) const;
  /// The faces without what is in front; none where the line along which they are cut isn't closed. `like`:
  /// the face that the caps are like. Until it is made or dropped no other can be looked at.
  [[nodiscard]] std::optional<PlaneCut> look_at(const PlaneSide& side, const std::vector<FaceId>& faces,
                                                FaceId like);
  void make(const PlaneCut& cut);
  void drop(const PlaneCut& cut) { all_.points.resize(cut.first_point); }

  /// The model with all of that; false, and as it was, where it would be no surface any more.
  [[nodiscard]] bool finish(mesh::Model& model);

 private:
  struct Line {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> crossing;  ///< of each edge: where the plane is
    std::vector<std::array<std::uint32_t, 2>> sides;  ///< in the plane, as what is cut off runs along it
  };

  std::uint32_t crossing(const PlaneSide& side, VertexId a, VertexId b, Line& line);
  void divide(const PlaneSide& side, FaceId f, PlaneCut& cut, Line& line);
  [[nodiscard]] bool cap(const PlaneSide& side, const Line& line, std::size_t like, Caps& caps) const;

  const mesh::Surface& surface_;
  mesh::LooseFaces all_;  ///< with points where edges cross planes
  double in_plane_;
  std::vector<bool> gone_;
  Caps rests_;
  Caps caps_;
};

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

/// What is no farther from a wall than this share of the short edge lies in its plane.
constexpr double in_plane = 0.01;
/// What goes makes room for what is found after it: a panel within a panel.
constexpr int most_rounds = 4;
class ReliefTrimmer {
 public:
  ReliefTrimmer(const mesh::Model& model, const SimplifyOptions& options, double height_mm)
      : surface_(model.surface),
        walls_(find_walls(surface_, find_panels(surface_), options.short_edge_mm)),
        loops_(loops_within(surface_, walls_)),
        short_edge_(options.short_edge_mm),
        height_mm_(height_mm),
        in_plane_(in_plane * options.short_edge_mm),
        loop_at_(surface_.corner_count(), no_index),
        cuts_(model, in_plane_) {}

  std::size_t run(mesh::Model& model) {
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      for (const CornerId c : loops_[l].sides) {
        loop_at_[c.value()] = l;
      }
    }
    std::size_t count = 0;
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      const WallLoop& loop = loops_[l];
      if (loop.box.largest_extent() <= short_edge_ || loop.leaves_wall()) {
        count += close(l) ? 1U : trim(loop, 1.0) + trim(loop, -1.0);
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
    return height(side, v) <= height_mm_ && distance(side.loop->box, surface_.point(v)) <= height_mm_;
  }

  /// Whether a loop may be the end of a hole through a plate: no larger than a short edge, and so narrow that
  /// no place of it is far from what closes it.
  [[nodiscard]] bool is_narrow(const WallLoop& loop) const {
    const Vec3 size = loop.box.size();
    std::array<double, 3> extents{size.x, size.y, size.z};
    std::sort(extents.begin(), extents.end());
    return !loop.has_rims && extents[2] <= short_edge_ && extents[1] <= 2.0 * height_mm_;
  }

  /// Whether a place is near a loop, and near its wall.
  [[nodiscard]] bool is_near(const WallLoop& loop, VertexId v) const {
    return is_shallow(side_of(loop, 1.0), v) && is_shallow(side_of(loop, -1.0), v);
  }

  /// What is behind a loop, and the loops at which it comes out, this one among them.
  struct Behind {
    std::set<FaceId> faces;
    std::set<std::uint32_t> ends;
  };

  /// None where it leads farther than twice what is shallow.
  [[nodiscard]] std::optional<Behind> behind(std::uint32_t first) const {
    Behind found;
    std::vector<FaceId> next;
    const auto visit = [&](CornerId beyond) {
      if (beyond.valid() && found.faces.insert(mesh::face_of(beyond)).second) {
        next.push_back(mesh::face_of(beyond));
      }
    };
    const auto end_at = [&](std::uint32_t l) {
      if (found.ends.insert(l).second) {
        std::ranges::for_each(loops_[l].sides, [&](CornerId c) { visit(surface_.twin(c)); });
      }
    };
    end_at(first);
    while (!next.empty()) {
      const FaceId f = next.back();
      next.pop_back();
      if (cuts_.is_gone(f) || !std::ranges::all_of(surface_.vertices(f), [&](VertexId v) {
            return distance(loops_[first].box, surface_.point(v)) <= 2.0 * height_mm_;
          })) {
        return std::nullopt;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId beyond = surface_.twin(mesh::corner(f, k));
        if (beyond.valid() && loop_at_[beyond.value()] != no_index) {
          end_at(loop_at_[beyond.value()]);
        } else {
          visit(beyond);
        }
      }
    }
    return found;
  }

  /// Takes out all that is behind a loop, if all of it is shallow and comes out nowhere else, or is a narrow
  /// hole through a plate.
  bool close(std::uint32_t first) {
    const std::optional<Behind> found = behind(first);
    const auto is_narrow_end = [&](std::uint32_t l) { return is_narrow(loops_[l]); };
    if (!found || found->faces.empty() ||
        (found->ends.size() > 1 && !std::ranges::all_of(found->ends, is_narrow_end))) {
      return false;
    }
    const bool near = std::ranges::all_of(found->faces, [&](FaceId f) {
      return std::ranges::all_of(surface_.vertices(f), [&](VertexId v) {
        return std::ranges::any_of(found->ends, [&](std::uint32_t l) { return is_near(loops_[l], v); });
      });
    });
    PlaneCut cut;
    if (!near || !std::ranges::all_of(found->ends, [&](std::uint32_t l) {
          return close_loop(surface_, walls_, loops_[l], cut.caps);
        })) {
      return false;
    }
    cut.faces.assign(found->faces.begin(), found->faces.end());
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
    if (faces.empty()) {
      return false;
    }
    const std::optional<PlaneCut> cut =
        cuts_.look_at(side.plane, faces, mesh::face_of(side.loop->sides.front()));
    if (cut) {
      cuts_.make(*cut);
    }
    return cut.has_value();
  }

  const mesh::Surface& surface_;
  Walls walls_;
  std::vector<WallLoop> loops_;
  double short_edge_;
  double height_mm_;
  double in_plane_;
  std::vector<std::uint32_t> loop_at_;  ///< of each side of a wall: the loop that it is part of
  PlaneCuts cuts_;
};

}  // namespace

std::size_t trim_reliefs(mesh::Model& model, const SimplifyOptions& options, double height_mm,
                         const Context& context) {
  std::size_t all = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t count = ReliefTrimmer(model, options, height_mm).run(model);
    if (count == 0) {
      break;
    }
    remesh_panels(model, context);
    all += count;
  }
  return all;
}

}  // namespace ridgecraft::prepare
