// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout_promises.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "export/packing/packing_shape.hpp"

namespace ridgecraft::test {

using unfold::Nets;

namespace {

double segment_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p); };
  if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) {
    return 0.0;
  }
  const auto to = [](Vec2 p, Vec2 q, Vec2 r) {
    const double t = std::clamp(dot(p - q, r - q) / dot(r - q, r - q), 0.0, 1.0);
    return length(p - (q + t * (r - q)));
  };
  return std::min({to(a, c, d), to(b, c, d), to(c, a, b), to(d, a, b)});
}

bool inside(Vec2 p, const std::array<Vec2, 3>& t) {
  return cross(t[1] - t[0], p - t[0]) > 0.0 && cross(t[2] - t[1], p - t[1]) > 0.0 &&
         cross(t[0] - t[2], p - t[2]) > 0.0;
}

/// All pairs of faces and tabs of different pieces on one page, without any shortcut.
double least_distance(Nets nets, const export_::Pages& pages) {
  double least = INFINITY;
  for (const unfold::Tab& tab : nets.tabs) {  // a tab is two triangles more
    const PieceId piece = nets.piece[mesh::face_of(tab.side)];
    for (std::size_t k = 2; k < tab.polygon.size(); ++k) {
      nets.flat.push_back({tab.polygon[0], tab.polygon[k - 1], tab.polygon[k]});
      nets.piece.push_back(piece);
    }
  }
  std::vector<std::array<Vec2, 3>> at;
  for (const FaceId f : ids<FaceId>(nets.flat.size())) {
    auto t = nets.flat[f];
    for (Vec2& p : t) {
      p = pages.placements[nets.piece[f]](p);
    }
    at.push_back(t);
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      const PieceId p = nets.piece[FaceId(i)];
      const PieceId q = nets.piece[FaceId(j)];
      if (p == q || pages.placements[p].page != pages.placements[q].page) {
        continue;
      }
      for (std::size_t k = 0; k < 9; ++k) {
        least = std::min(
            least, segment_distance(at[i][k / 3], at[i][(k / 3 + 1) % 3], at[j][k % 3], at[j][(k + 1) % 3]));
      }
      if (inside(at[i][0], at[j]) || inside(at[j][0], at[i])) {
        least = 0.0;
      }
    }
  }
  return least;
}

}  // namespace

void check_promises(const Nets& nets, const export_::Pages& pages, bool all_pairs) {
  const Box2 box = export_::piece_box(pages.paper);
  REQUIRE(pages.placements.size() == nets.pieces.size());
  std::vector<bool> used(pages.count);
  bool in_box = true;
  for (const FaceId f : ids<FaceId>(nets.flat.size())) {
    const export_::Placement& placement = pages.placements[nets.piece[f]];
    CHECK(placement.cosine * placement.cosine + placement.sine * placement.sine ==
          Approx(1.0).epsilon(1e-14));
    REQUIRE(placement.page.value() < pages.count);
    used[placement.page.value()] = true;
    for (const Vec2 corner : nets.flat[f]) {
      const Vec2 p = placement(corner);
      in_box = in_box && p.x > box.low.x - 2e-4 && p.x < box.high.x + 2e-4 && p.y > box.low.y - 2e-4 &&
               p.y < box.high.y + 2e-4;
    }
  }
  for (const unfold::Tab& tab : nets.tabs) {
    for (const Vec2 corner : tab.polygon) {
      const Vec2 p = pages.placements[nets.piece[mesh::face_of(tab.side)]](corner);
      in_box = in_box && p.x > box.low.x - 2e-4 && p.x < box.high.x + 2e-4 && p.y > box.low.y - 2e-4 &&
               p.y < box.high.y + 2e-4;
    }
  }
  CHECK(in_box);
  CHECK(std::all_of(used.begin(), used.end(), [](bool is_used) { return is_used; }));
  if (all_pairs) {
    CHECK(least_distance(nets, pages) > pages.paper.gap - 1e-6);
  }
}

std::size_t shelf_pages(const Nets& nets, const export_::Paper& paper) {
  const Vec2 area = export_::piece_area(paper);
  std::vector<Vec2> sizes;
  for (const unfold::Piece& piece : nets.pieces) {
    std::vector<Vec2> points;
    for (const FaceId f : piece.faces) {
      points.insert(points.end(), nets.flat[f].begin(), nets.flat[f].end());
    }
    const auto hull = convex_hull(points);
    Vec2 best{INFINITY, INFINITY};
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
      const Vec2 size = export_::extent(hull, {side.x / length(side), -side.y / length(side)});
      if (size.x * size.y < best.x * best.y) {
        best = size;
      }
    }
    const Vec2 lying{std::max(best.x, best.y), std::min(best.x, best.y)};
    sizes.push_back(lying.x <= area.x ? lying : Vec2{lying.y, lying.x});
  }
  std::sort(sizes.begin(), sizes.end(), [](Vec2 a, Vec2 b) { return a.y > b.y; });
  struct Shelf {
    double used;
    double height;
  };
  struct Page {
    std::vector<Shelf> shelves;
    double top = 0.0;
  };
  std::vector<Page> pages;
  for (const Vec2 size : sizes) {
    const auto put = [&](Page& page) {
      for (Shelf& shelf : page.shelves) {
        if (shelf.height >= size.y && shelf.used + size.x <= area.x) {
          shelf.used += size.x + paper.gap;
          return true;
        }
      }
      if (page.top + size.y > area.y) {
        return false;
      }
      page.shelves.push_back({size.x + paper.gap, size.y});
      page.top += size.y + paper.gap;
      return true;
    };
    if (std::none_of(pages.begin(), pages.end(), put)) {
      pages.emplace_back();
      put(pages.back());
    }
  }
  return pages.size();
}

}  // namespace ridgecraft::test
