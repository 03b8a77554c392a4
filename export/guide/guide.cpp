// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/guide.hpp"

#include <utility>

#include "base/text.hpp"
#include "export/guide/cover.hpp"
#include "export/guide/guide_model.hpp"
#include "export/guide/overview.hpp"
#include "export/guide/picture.hpp"
#include "export/guide/step_pages.hpp"

namespace ridgecraft::export_ {

Guide draw_guide(const prepare::Prepared& model, const unfold::Nets& nets, const Pages& pages,
                 const Assembly& assembly, std::size_t sheets, std::span<const Body> bodies,
                 const Stance& stance, const Style& style, const Context& context) {
  GuideModel guide;
  guide.model = &model;
  guide.nets = &nets;
  guide.pages = &pages;
  guide.assembly = &assembly;
  guide.bodies = bodies;
  guide.sheets = sheets;
  guide.hidden_fold_angle = style.hidden_fold_angle;
  guide.title = printable_utf8(model.model.name);
  guide.sheet = guide_sheet(pages.paper);
  guide.stance = stance;
  guide.effort = effort_of(model.model.surface, nets, style.hidden_fold_angle);
  guide.scene = scene_of(model, nets, style.hidden_fold_angle);
  guide.in_colour = model.look != nullptr && style.ink != Ink::lines;
  guide.pale = pale_look();
  guide.contents = piece_contents(model.model.surface, nets);
  for (const Color hue : piece_hues(model.model.surface, nets)) {
    guide.looks.push_back(coloured_look(hue));
  }
  for (const PieceId piece : nets.piece) {
    guide.piece_of_face.push_back(piece.value());
  }
  guide.shown = turned_to_cover(guide);
  std::vector<Group> groups{cover(guide, context)};
  groups.push_back(overview(guide, context));
  for (Group& page : step_pages(guide, context)) {
    groups.push_back(std::move(page));
  }
  Guide result;
  result.steps = assembly.steps.size();
  result.effort = guide.effort;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Drawing& page = result.pages.emplace_back();
    page.size = guide.sheet.size;
    page.title = guide.title;
    page.page = static_cast<int>(i + 1);
    page.page_count = static_cast<int>(groups.size());
    page.groups.push_back(std::move(groups[i]));
    page.groups.push_back(guide_foot(guide.sheet, guide.title, i + 1, groups.size()));
  }
  return result;
}

}  // namespace ridgecraft::export_
