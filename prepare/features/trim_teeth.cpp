// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/trim_teeth.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "prepare/features/plane_cuts.hpp"
#include "prepare/features/wall_loops.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// The ground between teeth is a wall of a model with folds of this share of the short edge.
constexpr double ground = 0.5;
/// What is no farther from the ground than this share of the short edge lies in its plane.
constexpr double at_ground = 0.01;
/// The top of a tooth is parallel to its ground, but for this angle, ...
const double level = elementary::cos(15.0 * std::numbers::pi / 180.0);
/// ... for this share of what it covers.
constexpr double level_share = 0.5;
/// Of a tooth's faces this share may be left, in parts, with what takes its place.
constexpr double left_share = 0.5;
/// The share of all triangles that go at least.
constexpr double worth_teeth = 0.1;
/// Where one tooth stood, there may be the ground of others.
constexpr int teeth_rounds = 4;
/// Whoever goes round a tooth asks no more corners than this.
constexpr std::size_t most_corners = 1000;
/// What has more faces has other details than teeth.
constexpr std::size_t too_many_to_trim = 100000;

class TeethTrimmer {
 public:
  TeethTrimmer(const mesh::Model& model, const SimplifyOptions& options, double height_mm)
      : surface_(model.surface),
        walls_(find_walls(surface_, find_panels(surface_), ground * options.short_edge_mm, Slats::are_none)),
        height_mm_(height_mm),
        cuts_(model, at_ground * options.short_edge_mm) {}

  std::size_t run(mesh::Model& model, const Context& context) {
    std::size_t count = 0;
    for (const WallLoop& outline : outlines(surface_, walls_)) {
      context.check();
      std::set<std::uint32_t> tried;
      const PlaneSide side{walls_.walls[outline.wall], 1.0};
      for (const CornerId c : outline.sides) {
        const CornerId beyond = surface_.twin(c);
        if (beyond.valid() && !tried.contains(mesh::face_of(beyond).value()) &&
            cuts_.stands_out(side, mesh::face_of(beyond))) {
          count += cut_off(side, c, tried) ? 1U : 0U;
        }
      }
    }
    return count > 0 && cuts_.finish(model) ? count : 0;
  }

 private:
  bool cut_off(const PlaneSide& side, CornerId beside, std::set<std::uint32_t>& tried) {
    std::size_t asked = 0;
    const std::vector<FaceId> faces = cuts_.in_front(
        side, mesh::face_of(surface_.twin(beside)),
        [&](VertexId v) { return ++asked <= most_corners && side.height(surface_.point(v)) <= height_mm_; },
        tried);
    if (faces.empty()) {
      return false;
    }
    const std::optional<PlaneCut> cut = cuts_.look_at(side, faces, mesh::face_of(beside));
    if (!cut) {
      return false;
    }
    const bool goes = static_cast<double>(cut->rests.size() + cut->caps.size()) <=
                          left_share * static_cast<double>(faces.size()) &&
                      is_level(side, *cut);
    if (goes) {
      cuts_.make(*cut);
    } else {
      cuts_.drop(*cut);
    }
    return goes;
  }

  [[nodiscard]] bool is_level(const PlaneSide& side, const PlaneCut& cut) const {
    double top = 0.0;
    for (const FaceId f : cut.faces) {
      top += dot(surface_.normal(f), side.plane.normal) >= level ? surface_.area(f) : 0.0;
    }
    return top >= level_share * cuts_.covered(cut);
  }

  const mesh::Surface& surface_;
  Walls walls_;
  double height_mm_;
  PlaneCuts cuts_;
};

}  // namespace

std::size_t trim_teeth(mesh::Model& model, const SimplifyOptions& options, double height_mm,
                       const Context& context) {
  if (model.surface.face_count() > too_many_to_trim) {
    return 0;
  }
  mesh::Model trimmed = model;
  std::size_t all = 0;
  for (int round = 0; round < teeth_rounds; ++round) {
    context.check();
    const std::size_t count = TeethTrimmer(trimmed, options, height_mm).run(trimmed, context);
    if (count == 0) {
      break;
    }
    remesh_panels(trimmed, context);
    all += count;
  }
  const auto before = static_cast<double>(model.surface.face_count());
  if (static_cast<double>(trimmed.surface.face_count()) > (1.0 - worth_teeth) * before) {
    return 0;
  }
  model = std::move(trimmed);
  return all;
}

}  // namespace ridgecraft::prepare
