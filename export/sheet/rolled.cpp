// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/rolled.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "base/message.hpp"

namespace ridgecraft::export_ {
namespace {

/// Rolled round a rod, paper opens to about a quarter more.
constexpr double rod_to_band = 0.8;
/// A rim is bent as the other one, for whoever does it by hand, from this share of its radius on.
constexpr double hardly_less = 0.85;
constexpr double thickest_pen_mm = 15.0;
constexpr double thickest_tube_mm = 120.0;

}  // namespace

std::vector<RolledPart> rolled_parts(const prepare::Prepared& model, const unfold::Nets& nets) {
  const mesh::Surface& surface = model.model.surface;
  std::vector<RolledPart> parts;
  for (const RollId id : ids<RollId>(model.rolls.rolls.size())) {
    const prepare::Roll& roll = model.rolls.rolls[id];
    const auto is_cut = [&](EdgeId e) { return nets.use[e] != unfold::EdgeUse::fold; };
    std::vector<EdgeId> rulings = roll.rulings;
    if (roll.closed) {
      std::rotate(rulings.begin(), std::find_if(rulings.begin(), rulings.end(), is_cut), rulings.end());
    }
    bool cut = true;
    for (const EdgeId e : rulings) {
      if (is_cut(e)) {
        cut = true;
        continue;
      }
      if (cut) {
        parts.push_back({nets.piece[mesh::face_of(surface.sides(e)[0])], id, {}});
      }
      parts.back().bends.push_back(e);
      cut = false;
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const RolledPart& a, const RolledPart& b) { return a.piece < b.piece; });
  return parts;
}

std::size_t count_rolled_folds(const prepare::Prepared& model, const unfold::Nets& nets,
                               double hidden_fold_angle) {
  const auto edges = ids<EdgeId>(model.model.surface.edge_count());
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](EdgeId e) {
    return model.rolls.bends(e) && nets.use[e] == unfold::EdgeUse::fold &&
           std::abs(model.model.surface.fold_angle(e)) >= hidden_fold_angle;
  }));
}

std::string roll_words(const prepare::Prepared& model, RollId id) {
  const prepare::Roll& roll = model.rolls.rolls[id];
  const auto mm = [](double radius) { return fmt::format("{:.0f}", radius); };
  const auto [less, more] = roll.radii_mm;
  const bool even = less > hardly_less * more;
  const std::string from = mm(less);
  const std::string to = mm(even ? 0.5 * (less + more) : more);
  const bool inside = model.model.surface.fold_angle(roll.rulings.front()) > 0.0;
  return english(even ? Message(inside ? "roll_inside" : "roll", {{"mm", to}})
                      : Message(inside ? "roll_cone_inside" : "roll_cone", {{"from", from}, {"to", to}}));
}

std::string round_words(const prepare::Roll& roll) {
  const double rod = rod_to_band * (roll.radii_mm[0] + roll.radii_mm[1]);
  return english(rod > thickest_tube_mm ? Message("round_edge")
                                        : Message(rod > thickest_pen_mm ? "round_tube" : "round_pen",
                                                  {{"mm", fmt::format("{:.0f}", rod)}}));
}

}  // namespace ridgecraft::export_
