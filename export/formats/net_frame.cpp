// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/net_frame.hpp"

#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace ridgecraft::export_ {
namespace {

using mesh::face_of;
using mesh::next;
using mesh::Surface;
using unfold::EdgeUse;
using unfold::Nets;

/// Between pages, and between pieces without pages, in the plane of all nets, mm: enough to see that they are
/// apart.
constexpr double apart = 10.0;

/// Sets of corners that are one net vertex (union-find with path halving; the smallest corner stands for its
/// set, so the numbers don't depend on the order of unions).
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t c) {
    while (parent_[c] != c) {
      parent_[c] = parent_[parent_[c]];
      c = parent_[c];
    }
    return c;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

void number_vertices(const Surface& surface, const Nets& nets, NetFrame& frame) {
  CornerSets sets(surface.corner_count());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[e] == EdgeUse::fold) {
      const auto [c, d] = surface.sides(e);
      sets.join(c.value(), next(d).value());
      sets.join(next(c).value(), d.value());
    }
  }
  std::vector<std::uint32_t> number(surface.corner_count());
  frame.faces.resize(surface.face_count());
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    const std::uint32_t first = sets.find(c.value());
    if (first == c.value()) {
      number[first] = static_cast<std::uint32_t>(frame.points.size());
      frame.points.push_back(frame.place(nets.piece[face_of(c)], nets.flat[face_of(c)][c.value() % 3]));
    }
    frame.faces[face_of(c).value()][c.value() % 3] = number[first];
  }
}

void number_edges(const Surface& surface, const Nets& nets, NetFrame& frame) {
  frame.edge.resize(surface.corner_count());
  const auto vertex = [&](CornerId c) { return frame.faces[face_of(c).value()][c.value() % 3]; };
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    const CornerId twin = surface.twin(c);
    const EdgeId e = surface.edge(c);
    const bool fold = nets.use[e] == EdgeUse::fold || frame.is_slit(surface, e);
    if (fold && twin < c) {
      frame.edge[c] = frame.edge[twin];
      continue;
    }
    frame.edge[c] = static_cast<std::uint32_t>(frame.edges.size());
    frame.edges.push_back({{vertex(c), vertex(next(c))}, c, fold});
  }
}

void place_without_pages(const Nets& nets, NetFrame& frame) {
  double x = 0.0;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    Box2 box;
    for (const FaceId f : nets.pieces[p].faces) {
      for (const Vec2 corner : nets.flat[f]) {
        box.add(corner);
      }
    }
    Placement placement;
    placement.shift = -box.low;
    frame.placements_[p] = placement;
    frame.page[p] = PageId(p.value());
    frame.origins.push_back({x, 0.0});
    // Whole millimetres, so that the origins stay short in the file.
    x += std::ceil(box.size().x) + apart;
  }
}

}  // namespace

bool NetFrame::is_slit(const Surface& surface, EdgeId e) const {
  const auto [c, d] = surface.sides(e);
  if (!d.valid()) {
    return false;
  }
  const auto vertex = [&](CornerId at) { return faces[face_of(at).value()][at.value() % 3]; };
  return vertex(c) == vertex(next(d)) && vertex(next(c)) == vertex(d);
}

NetFrame net_frame(const Surface& surface, const Nets& nets, const Pages* pages) {
  RIDGECRAFT_ASSERT(nets.flat.size() == surface.face_count() && nets.use.size() == surface.edge_count());
  NetFrame frame;
  frame.placements_.resize(nets.pieces.size());
  frame.page.resize(nets.pieces.size());
  if (pages == nullptr) {
    place_without_pages(nets, frame);
  } else {
    for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
      frame.placements_[p] = pages->placements[p];
      frame.page[p] = pages->placements[p].page;
    }
    for (std::size_t page = 0; page < pages->count; ++page) {
      frame.origins.push_back({static_cast<double>(page) * (pages->paper.size.x + apart), 0.0});
    }
  }
  number_vertices(surface, nets, frame);
  number_edges(surface, nets, frame);
  return frame;
}

}  // namespace ridgecraft::export_
