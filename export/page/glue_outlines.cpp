// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/glue_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/geometry.hpp"
#include "export/page/lines.hpp"
#include "export/page/obstacles.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {
namespace {

/// Between a text and a line that ends before it, mm.
constexpr double gap_mm = 0.4;
/// Shorter stretches are specks, mm.
constexpr double shortest_mm = 0.6;

/// The share of a line, from 0 to 1, that lies in a box; empty (from > to) where none does.
Stretch within(const Segment2& line, const TurnedBox& box) {
  Stretch inside{0.0, 1.0};
  const Vec2 d = line.b - line.a;
  for (const auto& [axis, half] :
       {std::pair(box.along, box.half_width), std::pair(perpendicular(box.along), box.half_height)}) {
    const double at = dot(line.a - box.centre, axis);
    const double step = dot(d, axis);
    if (std::abs(step) > 0.0) {
      inside.from = std::max(inside.from, std::min((-half - at) / step, (half - at) / step));
      inside.to = std::min(inside.to, std::max((-half - at) / step, (half - at) / step));
    } else if (std::abs(at) > half) {
      return {1.0, 0.0};
    }
  }
  return inside;
}

/// The stretches of a line that keep away from all texts, those too short to be seen left out. O(texts).
std::vector<Segment2> beside_texts(const Segment2& line, const std::vector<Text>& texts) {
  std::vector<Stretch> covered;
  for (const Text& text : texts) {
    if (const Stretch inside = within(line, box_of(text).grown(gap_mm)); inside.from < inside.to) {
      covered.push_back(inside);
    }
  }
  std::ranges::sort(covered, {}, [](const Stretch& s) { return s.from; });
  covered.push_back({1.0, 1.0});
  std::vector<Segment2> parts;
  double at = 0.0;
  for (const Stretch& stretch : covered) {
    if ((stretch.from - at) * length(line.b - line.a) > shortest_mm) {
      parts.push_back({line.a + at * (line.b - line.a), line.a + stretch.from * (line.b - line.a)});
    }
    at = std::max(at, stretch.to);
  }
  return parts;
}

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

void add_glue_outlines(std::span<const GlueOutline> all, const PieceOnPage& piece, PieceDrawing& drawing) {
  const auto body = [&](const GlueOutline& glued) {
    return piece.surface().component(piece.nets.pieces[glued.other].faces.front());
  };
  const auto sides = [&](const GlueOutline& glued, const auto& use) {
    for (std::vector<Vec2> outline : glued.outlines) {
      std::ranges::transform(outline, outline.begin(), piece.placement);
      for (std::size_t i = 0; i < outline.size(); ++i) {
        use(Segment2{outline[i], outline[(i + 1) % outline.size()]});
      }
    }
  };
  DrawnLines drawn;
  for (const Line& line : drawing.group.lines) {
    for (const Segment2& segment : segments_of(line)) {
      drawn.add(segment);
    }
  }
  for (const GlueOutline& glued : all) {
    DrawnLines seams;
    for (const GlueOutline& other : all) {
      if (other.other != glued.other && body(other) == body(glued)) {
        sides(other, [&](const Segment2& side) { seams.add(side); });
      }
    }
    sides(glued, [&](const Segment2& side) {
      for (const Segment2& outer : seams.free_parts(side)) {
        for (const Segment2& part : drawn.free_parts(outer)) {
          drawn.add(part);
          drawing.group.lines.push_back({Layer::glue, {part.a, part.b}, false, Fold::none});
        }
      }
    });
    GlueMark spot{piece.nets.pieces[glued.other].name, {}, false};
    for (std::vector<Vec2> outline : glued.outlines) {
      std::ranges::transform(outline, outline.begin(), piece.placement);
      spot.outlines.push_back(std::move(outline));
    }
    drawing.spots.push_back(std::move(spot));
  }
}

void add_tab_shadows(const PieceOnPage& piece, PieceDrawing& drawing) {
  const mesh::Surface& surface = piece.surface();
  const unfold::Nets& nets = piece.nets;
  const auto has_second = [&](const unfold::Join& join) {
    return std::ranges::any_of(piece.contents.tabs, [&](TabId tab) {
      return nets.tabs[tab].side == surface.twin(nets.tabs[join.tab].side);
    });
  };
  for (const JoinId id : piece.contents.joins) {
    const unfold::Join& join = nets.joins[id];
    if (!join.tab.valid()) {
      continue;
    }
    const unfold::Tab& tab = nets.tabs[join.tab];
    if (tab.slit || nets.piece[mesh::face_of(surface.twin(tab.side))] != piece.piece || has_second(join)) {
      continue;
    }
    std::vector<Vec2> polygon = glued(surface, nets, tab);
    std::ranges::transform(polygon, polygon.begin(), piece.placement);
    for (std::size_t i = 1; i < polygon.size(); ++i) {
      for (const Segment2& part :
           beside_texts({polygon[i], polygon[(i + 1) % polygon.size()]}, drawing.group.texts)) {
        drawing.group.lines.push_back({Layer::shadow, {part.a, part.b}, false, Fold::none});
      }
    }
  }
}

}  // namespace ridgecraft::export_
