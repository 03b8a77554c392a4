// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/replace_tabs.hpp"

#include <optional>

#include "unfold/foot_tabs.hpp"
#include "unfold/give_tabs.hpp"
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/joins.hpp"
#include "unfold/one_of_each.hpp"
#include "unfold/plan.hpp"

namespace ridgecraft::unfold {

void replace_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                  Nets& nets, const Context& context, const TabChoice& choice) {
  IdVector<FaceId, PartId> part(surface.face_count());  // that each body has its own is all that counts
  for (const FaceId f : ids<FaceId>(part.size())) {
    part[f] = PartId(surface.component(f).value());
  }
  const Asked whole{surface, panels, part, options};
  const std::optional<OneOfEach> each = one_of_each(whole);
  // Equal bodies get equal tabs, unless some edge has a wish of its own, or tabs that copies don't know of.
  const bool alike = choice.edges.empty() && choice.at.empty() && !choice.borders &&
                     choice.sides != TabSides::both && choice.sides != TabSides::slots;
  std::optional<Nets> originals = each && alike ? without_copies(whole, *each, nets) : std::nullopt;
  if (originals) {
    give_tabs(each->kept.surface, each->panels, each->options, *originals, context, choice);
    number_joins(surface, nets);
    copy_tabs(whole, *each, *originals, nets);
  } else {
    give_tabs(surface, panels, options, nets, context, choice);
  }
  add_foot_tabs(surface, options, choice, nets, context);
  nets.equal = find_equal_pieces(surface, nets);
}

}  // namespace ridgecraft::unfold
