// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/net_picture.hpp"

#include <array>
#include <cmath>

#include "export/guide/picture.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft::export_ {
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
          std::abs(surface.fold_angle(edge)) >= guide.hidden_fold_angle) {
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
