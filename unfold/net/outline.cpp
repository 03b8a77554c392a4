// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/outline.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "base/geometry.hpp"

namespace ridgecraft::unfold {

namespace {

/// Nearer corners of a chain are one corner, mm: rounding along a fold tree stays far below, true edges far
/// above.
constexpr double same_corner_mm = 1e-9;

Vec2 start(const Nets& nets, CornerId c) {
  return nets.flat[mesh::face_of(c)][c.value() % 3];
}

/// The boundary side that follows side c around the piece: through all folds of the fan at c's end.
CornerId next_boundary(const mesh::Surface& surface, const Nets& nets, CornerId c) {
  CornerId d = mesh::next(c);
  while (nets.use[surface.edge(d)] == EdgeUse::fold) {
    d = mesh::next(surface.twin(d));
  }
  return d;
}

/// Where the corners of a fan lie apart, as in nets of board, the chain goes over all of them; mm.
constexpr double apart_mm = 1e-6;

/// The corners of the fan at the end of side c, in the order of next_boundary(), but for the last one.
std::vector<Vec2> fan_corners(const mesh::Surface& surface, const Nets& nets, CornerId c) {
  std::vector<Vec2> corners;
  CornerId d = mesh::next(c);
  corners.push_back(start(nets, d));
  while (nets.use[surface.edge(d)] == EdgeUse::fold) {
    d = mesh::next(surface.twin(d));
    corners.push_back(start(nets, d));
  }
  const Vec2 last = corners.back();
  corners.pop_back();
  const bool together = std::ranges::all_of(corners, [&](Vec2 p) { return length(p - last) <= apart_mm; });
  return together ? std::vector<Vec2>() : corners;
}

void append(std::vector<Vec2>& loop, Vec2 p) {
  if (loop.empty() || length(p - loop.back()) > same_corner_mm) {
    loop.push_back(p);
  }
}

/// The tabs that grow from each side of a piece, in the order in which the outline comes to them: from the
/// start of the side to its end.
std::map<CornerId, std::vector<const Tab*>> tabs_of(const Nets& nets, PieceId piece) {
  std::map<CornerId, std::vector<const Tab*>> result;
  for (const Tab& tab : nets.tabs) {
    if (nets.piece[mesh::face_of(tab.side)] == piece) {
      result[tab.side].push_back(&tab);
    }
  }
  for (auto& [side, tabs] : result) {
    const Vec2 from = start(nets, side);
    std::ranges::sort(tabs, {}, [&](const Tab* tab) { return length(tab->polygon[1] - from); });
  }
  return result;
}

/// Slits in a piece that tabs are put through.
std::vector<std::vector<Vec2>> slits_in(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  std::vector<std::vector<Vec2>> slits;
  for (const Tab& tab : nets.tabs) {
    if (tab.slit && nets.piece[mesh::face_of(surface.twin(tab.side))] == piece) {
      slits.emplace_back(tab.slit->begin(), tab.slit->end());
    }
  }
  return slits;
}

}  // namespace

std::vector<std::vector<Vec2>> outline(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  const std::map<CornerId, std::vector<const Tab*>> tabs = tabs_of(nets, piece);
  const std::vector<FaceId>& faces = nets.pieces[piece].faces;
  std::map<CornerId, bool> done;
  std::vector<std::vector<Vec2>> loops;
  for (const FaceId f : faces) {
    for (unsigned k = 0; k < 3; ++k) {
      CornerId c = mesh::corner(f, k);
      if (nets.use[surface.edge(c)] == EdgeUse::fold || done[c]) {
        continue;
      }
      std::vector<Vec2> loop;
      for (; !done[c]; c = next_boundary(surface, nets, c)) {
        done[c] = true;
        append(loop, start(nets, c));
        if (const auto here = tabs.find(c); here != tabs.end()) {
          for (const Tab* tab : here->second) {
            // The tab runs counterclockwise and begins with its base, end first: so its way round the outside
            // is corners 1, 2, ..., 0.
            const std::vector<Vec2>& polygon = tab->polygon;
            for (std::size_t i = 1; i <= polygon.size(); ++i) {
              append(loop, polygon[i % polygon.size()]);
            }
          }
        }
        for (const Vec2 p : fan_corners(surface, nets, c)) {
          append(loop, p);
        }
      }
      while (loop.size() > 1 && length(loop.back() - loop.front()) <= same_corner_mm) {
        loop.pop_back();
      }
      loops.push_back(std::move(loop));
    }
  }
  // The outer loop is the one that encloses the others; holes run clockwise.
  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return std::abs(doubled_area(a)) > std::abs(doubled_area(b));
  });
  return loops;
}

CutLines cut_lines(const mesh::Surface& surface, const Nets& nets, PieceId piece) {
  CutLines lines = arrange_cuts(outline(surface, nets, piece), touch_tolerance_mm);
  for (std::vector<Vec2>& slit : slits_in(surface, nets, piece)) {
    lines.slits.push_back(std::move(slit));
  }
  return lines;
}

Box2 extent(const mesh::Surface& /*surface*/, const Nets& nets, PieceId piece) {
  Box2 box;
  for (const FaceId f : nets.pieces[piece].faces) {
    for (const Vec2 p : nets.flat[f]) {
      box.add(p);
    }
  }
  for (const Tab& tab : nets.tabs) {
    if (nets.piece[mesh::face_of(tab.side)] == piece) {
      for (const Vec2 p : tab.polygon) {
        box.add(p);
      }
    }
  }
  return box;
}

}  // namespace ridgecraft::unfold
