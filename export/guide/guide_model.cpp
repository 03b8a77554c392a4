// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/guide_model.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "export/guide/picture.hpp"
#include "export/guide/words.hpp"
#include "export/style/stroke_font.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft::export_ {

GuideSheet guide_sheet(const Paper& nets) {
  constexpr double inch = 25.4;
  const auto in_inches = [](double side) {
    // Halves of inches, as letter, legal and tabloid have them.
    const double halves = 2.0 * side / inch;
    return std::abs(halves - std::round(halves)) < 1e-3;
  };
  GuideSheet sheet;
  if (in_inches(nets.size.x) && in_inches(nets.size.y)) {
    sheet.size = {8.5 * inch, 11.0 * inch};
  }
  return sheet;
}

Line guide_rule(Vec2 from, Vec2 to) {
  Line line{Layer::mark, {from, to}};
  line.pen = Pen{0.12, {0xb0, 0xb0, 0xb0}};
  return line;
}

Text in_grey(Text text) {
  text.color = guide_grey;
  return text;
}

Group guide_foot(const GuideSheet& sheet, const std::string& title, std::size_t page, std::size_t count) {
  constexpr double height = 2.0;
  constexpr double rule_lift = 4.5;
  Group group;
  group.id = "page";
  const double left = sheet.margin;
  const double right = sheet.size.x - sheet.margin;
  const std::string number = fmt::format("page {} / {}", page, count);
  const double room = right - left - text_width(number, height) - 10.0;
  group.lines.push_back(guide_rule({left, sheet.margin + rule_lift}, {right, sheet.margin + rule_lift}));
  group.texts.push_back(
      words_from(shortened(title + ": how to build it", room, height), {left, sheet.margin}, height));
  group.texts.push_back(words_to(number, {right, sheet.margin}, height));
  return group;
}

const std::array<Viewpoint, 8>& guide_sides() {
  constexpr double degree = std::numbers::pi / 180.0;
  static constexpr std::array<Viewpoint, 8> sides{
      {{35.0 * degree, 22.0 * degree, "as on the first page"},
       {125.0 * degree, 22.0 * degree, "a quarter turn on"},
       {215.0 * degree, 22.0 * degree, "half a turn on"},
       {305.0 * degree, 22.0 * degree, "three quarters of a turn on"},
       {35.0 * degree, -28.0 * degree, "as on the first page, but from below"},
       {125.0 * degree, -28.0 * degree, "a quarter turn on, from below"},
       {215.0 * degree, -28.0 * degree, "half a turn on, from below"},
       {305.0 * degree, -28.0 * degree, "three quarters of a turn on, from below"}}};
  return sides;
}

namespace {

constexpr Color net_ink{0x44, 0x44, 0x48};
constexpr Color paper_white{0xff, 0xff, 0xff};
constexpr double net_cut_width = 0.14;
constexpr double net_fold_width = 0.06;

}  // namespace

Box2 add_net_picture(const GuideModel& guide, PieceId piece, const Box2& frame, Group& group) {
  const mesh::Surface& surface = guide.surface();
  const unfold::Nets& nets = *guide.nets;
  const Placement& placement = guide.pages->placements[piece];
  const Color hue = guide.looks[piece].face;
  const unfold::CutLines cuts = unfold::cut_lines(surface, nets, piece);
  Box2 box;
  for (const std::vector<Vec2>& loop : cuts.loops) {
    for (const Vec2 p : loop) {
      box.add(placement.turn(p));
    }
  }
  if (box.empty()) {
    return frame;
  }
  Fit fit = fit_into(box, frame);
  fit.shift.y += frame.high.y - fit(box.high).y;
  const auto at = [&](Vec2 p) { return fit(placement.turn(p)); };
  // Tabs are lighter than faces.
  for (const TabId tab : guide.contents[piece].tabs) {
    Area& area = group.areas.emplace_back(Area{Layer::picture, {}, mixed(hue, paper_white, 0.65)});
    for (const Vec2 p : nets.tabs[tab].polygon) {
      area.outline.push_back(at(p));
    }
  }
  const auto line = [&](std::vector<Vec2> points, bool closed, Pen pen) {
    for (Vec2& p : points) {
      p = at(p);
    }
    Line& drawn = group.lines.emplace_back(Line{Layer::picture, std::move(points), closed});
    drawn.pen = pen;
  };
  for (const FaceId face : nets.pieces[piece].faces) {
    const std::array<Vec2, 3>& flat = nets.flat[face];
    group.areas.push_back(
        {Layer::picture, {at(flat[0]), at(flat[1]), at(flat[2])}, mixed(hue, paper_white, 0.15)});
    for (const unsigned k : {0U, 1U, 2U}) {
      const CornerId side = mesh::corner(face, k);
      const EdgeId edge = surface.edge(side);
      if (nets.use[edge] == unfold::EdgeUse::fold && side < surface.twin(side) &&
          std::abs(surface.fold_angle(edge)) >= guide.hidden_fold_angle && !guide.model->rolls.bends(edge)) {
        line({flat[k], flat[(k + 1) % 3]}, false, {net_fold_width, net_ink});
      }
    }
  }
  for (const std::vector<Vec2>& loop : cuts.loops) {
    line(loop, true, {net_cut_width, net_ink});
  }
  for (const std::vector<Vec2>& slit : cuts.slits) {
    line(slit, false, {net_cut_width, net_ink});
  }
  return {fit(box.low), fit(box.high)};
}

}  // namespace ridgecraft::export_
