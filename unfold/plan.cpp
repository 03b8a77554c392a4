// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/plan.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"
#include "unfold/panel_parts.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/pieces/start_nets.hpp"

namespace ridgecraft::unfold {
namespace {

// Flat regions that are too large for the sheet, or that overlap themselves, are divided before anything else
// is done.

/// Every face in a panel of its own.
prepare::Panels single_faces(const mesh::Surface& surface) {
  prepare::Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    panels.panel[f] = PanelId(f.value());
  }
  return panels;
}

/// Whether a panel can lie flat, in one, on the sheet.
bool lies_whole(const mesh::Surface& surface, const prepare::Panels& panels, const std::vector<FaceId>& faces,
                const Room& room) {
  if (faces.size() == 1) {
    return true;  // a face that no sheet holds is refused elsewhere
  }
  const Patch patch = make_patch(surface, panels, faces);
  return lies_as_one(patch, 1, room, net_tolerance(patch.extent));
}

/// The same panels, but those that no piece could hold whole are divided into as few as possible that fit the
/// room; a note says how many there were. Each face alone must fit. O(n) but for the divided ones.
prepare::Panels fitting_panels(const mesh::Surface& surface, const prepare::Panels& panels, const Room& room,
                               const Context& context, std::vector<Message>& notes) {
  prepare::Panels fitting;
  fitting.panel = IdVector<FaceId, PanelId>(surface.face_count());
  const prepare::Panels single = single_faces(surface);
  const Room bits{room.sheet, room.strip, 0};
  std::size_t divided = 0;
  for (const std::vector<FaceId>& faces : panels.faces) {
    context.check();
    std::vector<std::vector<FaceId>> shares{faces};
    if (!lies_whole(surface, panels, faces, room)) {
      ++divided;
      shares.clear();
      for (const std::vector<FaceId>& component : connected(surface, faces)) {
        const Patch patch = make_patch(surface, single, component);
        const Folds folds = start_nets(patch, bits, {net_tolerance(patch.extent)}, 1, context);
        for (const auto& piece : lay_out(patch, folds).faces) {
          std::vector<FaceId>& share = shares.emplace_back();
          for (const std::uint32_t f : piece) {
            share.push_back(component[f]);
          }
          std::sort(share.begin(), share.end());
        }
      }
    }
    for (std::vector<FaceId>& share : shares) {
      const PanelId id(fitting.faces.size());
      for (const FaceId f : share) {
        fitting.panel[f] = id;
      }
      fitting.faces.push_back(std::move(share));
    }
  }
  if (divided > 0) {
    notes.push_back(Message("large_regions_cut", {{"n", divided}}));
  }
  return fitting;
}

Room room_of(const Options& options) {
  return {options.sheet, options.tabs.wanted ? options.tabs.height_mm : 0.0, options.pieces.max_panels};
}

/// Keeps what can be kept of what is to be kept, and together what that holds together.
void settle(const UnfoldProblem& problem, const Symmetry& symmetry, const Context& context, Plan& plan) {
  const PieceRules& rules = problem.options.pieces;
  const EdgeConstraints constraints =
      with_bands_kept({problem.surface, plan.whole, problem.part, problem.options}, symmetry);
  // Where it costs nothing that a piece has faces of several parts, the search begins without them.
  plan.group =
      rules.weights.parts > 0.0 ? problem.part : IdVector<FaceId, PartId>(problem.part.size(), PartId(0));
  const auto wanted = [](EdgeConstraint constraint) { return constraint != EdgeConstraint::none; };
  if (std::none_of(constraints.begin(), constraints.end(), wanted)) {
    return;
  }
  KeptEdges kept = settle_constraints(problem.surface, plan.whole, constraints, plan.room, context);
  plan.possible_constraints = std::move(kept.constraints);
  plan.group = parts_of_whole_panels(problem.surface, kept.groups, plan.group);
}

}  // namespace

void refuse_large_faces(const UnfoldProblem& problem) {
  const mesh::Surface& surface = problem.surface;
  const std::optional<Sheet>& sheet = problem.options.sheet;
  if (!sheet) {
    return;
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    const Triangle t = flat_shape(surface.point(a), surface.point(b), surface.point(c));
    if (!angle_to_fit(convex_hull({t.begin(), t.end()}), *sheet)) {
      throw Error(ErrorKind::no_nets, Message("face_too_large", {{"face", f.value()}}));
    }
  }
}

Plan make_plan(const UnfoldProblem& problem, const Symmetry& symmetry, const Context& context) {
  Plan plan;
  plan.room = room_of(problem.options);
  plan.whole = fitting_panels(problem.surface, problem.panels, plan.room, context, plan.notes);
  settle(problem, symmetry, context, plan);
  return plan;
}

Patch whole_patch(const UnfoldProblem& problem, const Plan& plan) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(problem.surface.face_count())) {
    faces.push_back(f);
  }
  return make_patch(problem.surface, plan.whole, faces, plan.possible_constraints.items(),
                    problem.options.labels.items());
}

}  // namespace ridgecraft::unfold
