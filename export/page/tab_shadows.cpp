// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/tab_shadows.hpp"

#include <algorithm>
#include <vector>

#include "export/page/gaps.hpp"

namespace ridgecraft::export_ {
namespace {

/// The tab as it lies behind the face at the other side of its edge, in the plane of that face's piece.
std::vector<Vec2> glued(const mesh::Surface& surface, const unfold::Nets& nets, const unfold::Tab& tab) {
  const auto corner = [&](CornerId c) { return nets.flat[mesh::face_of(c)][c.value() % 3]; };
  const auto unit = [](Vec2 d) { return length(d) > 0.0 ? d / length(d) : Vec2{1.0, 0.0}; };
  // Along the edge it runs the same way on both sides; it grows out of its own face and into the other one.
  const Vec2 from = corner(mesh::next(tab.side));
  const Vec2 along = unit(corner(tab.side) - from);
  const CornerId twin = surface.twin(tab.side);
  const Vec2 to = corner(twin);
  const Vec2 there = unit(corner(mesh::next(twin)) - to);
  std::vector<Vec2> polygon;
  for (const Vec2 p : tab.polygon) {
    polygon.push_back(to + dot(p - from, along) * there + cross(along, p - from) * perpendicular(there));
  }
  return polygon;
}

}  // namespace

void add_tab_shadows(const mesh::Surface& surface, const unfold::Nets& nets, PieceId piece,
                     const PieceContents& contents, const Placement& placement, PieceDrawing& drawing) {
  const auto has_second = [&](const unfold::Join& join) {
    return std::ranges::any_of(contents.tabs, [&](TabId tab) {
      return nets.tabs[tab].side == surface.twin(nets.tabs[join.tab].side);
    });
  };
  for (const JoinId id : contents.joins) {
    const unfold::Join& join = nets.joins[id];
    if (!join.tab.valid()) {
      continue;
    }
    const unfold::Tab& tab = nets.tabs[join.tab];
    if (tab.slit || nets.piece[mesh::face_of(surface.twin(tab.side))] != piece || has_second(join)) {
      continue;
    }
    std::vector<Vec2> polygon = glued(surface, nets, tab);
    std::ranges::transform(polygon, polygon.begin(), placement);
    for (std::size_t i = 1; i < polygon.size(); ++i) {
      for (const Segment2& part :
           beside_texts({polygon[i], polygon[(i + 1) % polygon.size()]}, drawing.group.texts)) {
        drawing.group.lines.push_back({Layer::shadow, {part.a, part.b}, false, Fold::none});
      }
    }
  }
}

}  // namespace ridgecraft::export_
