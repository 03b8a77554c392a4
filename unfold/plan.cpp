// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/plan.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "unfold/folded_flat.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/panel_parts.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/fitting_panels.hpp"
#include "unfold/pieces/kept_bands.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/pieces/needles.hpp"

namespace ridgecraft::unfold {
namespace {

/// Flat models of more faces aren't searched for fewer pieces: in their layers everything overlaps, so each
/// search would take all the time it may, some twenty seconds for 800 polygons, and nobody builds the result.
constexpr std::size_t most_flat_faces = 300;

Room room_of(const Options& options) {
  return {options.sheet, options.tabs.wanted ? options.tabs.height_mm : 0.0, options.pieces.max_panels};
}

/// Keeps what can be kept of what is to be kept, and together what that holds together.
void settle(const Asked& asked, const Context& context, Plan& plan) {
  EdgeWishes wishes = with_needles_kept(asked.surface, plan.whole, asked.options.wishes);
  const PieceRules& rules = asked.options.pieces;
  if (rules.merge && rules.mode != PieceMode::few) {
    wishes = with_bands_kept(asked.surface, plan.whole, asked.options.labels.items(), wishes, rules.weights);
  }
  if (wishes.empty()) {
    plan.group = asked.part;
    return;
  }
  const double tolerance = net_tolerance(asked.surface.bounds().largest_extent());
  KeptEdges kept = settle_wishes(asked.surface, plan.whole, wishes, plan.room, tolerance, context);
  plan.possible_wishes = std::move(kept.wishes);
  plan.group = parts_of_whole_panels(asked.surface, kept.groups, asked.part);
}

void look_for_flatness(const mesh::Surface& surface, Plan& plan) {
  if (!is_folded_flat(surface)) {
    return;
  }
  std::string note = "the model is flat: its faces lie on each other in one plane";
  if (surface.face_count() > most_flat_faces) {
    plan.in_a_hurry = true;
    note += ", so no time is spent on fewer pieces";
  }
  plan.notes.push_back(std::move(note));
}

}  // namespace

void refuse_large_faces(const Asked& asked) {
  const mesh::Surface& surface = asked.surface;
  const std::optional<Sheet>& sheet = asked.options.sheet;
  if (!sheet) {
    return;
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    const Triangle t = flat_shape(surface.point(a), surface.point(b), surface.point(c));
    if (!angle_to_fit(convex_hull({t.begin(), t.end()}), *sheet)) {
      throw Error(ErrorKind::no_nets,
                  "face " + std::to_string(f.value()) + " is larger than the printable area of the paper");
    }
  }
}

Plan make_plan(const Asked& asked, const Context& context) {
  Plan plan;
  plan.room = room_of(asked.options);
  plan.whole = fitting_panels(asked.surface, asked.panels, plan.room, context, plan.notes);
  settle(asked, context, plan);
  look_for_flatness(asked.surface, plan);
  return plan;
}

}  // namespace ridgecraft::unfold
