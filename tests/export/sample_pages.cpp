// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_pages.hpp"

#include <algorithm>
#include <cmath>

#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "support/simple_nets.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft::test {
namespace {

/// Convex polygons share more than a border (separating axes).
bool overlap(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  for (const auto* one : {&a, &b}) {
    for (std::size_t i = 0; i < one->size(); ++i) {
      const Vec2 from = (*one)[i];
      const Vec2 out = -perpendicular((*one)[(i + 1) % one->size()] - from);
      const auto beyond = [&](Vec2 p) { return dot(p - from, out) >= -1e-6 * length(out); };
      if (std::ranges::all_of(one == &a ? b : a, beyond)) {
        return false;
      }
    }
  }
  return true;
}

void add_tabs(const mesh::Surface& surface, unfold::Nets& nets, double height) {
  IdVector<PieceId, std::vector<std::vector<Vec2>>> taken(nets.pieces.size());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    taken[nets.piece[f]].emplace_back(nets.flat[f].begin(), nets.flat[f].end());
  }
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    for (const CornerId c : surface.sides(nets.joins[j].edge)) {
      const FaceId f = mesh::face_of(c);
      const Vec2 b = nets.flat[f][c.value() % 3];
      const Vec2 a = nets.flat[f][mesh::next(c).value() % 3];
      const double size = length(b - a);
      const Vec2 u = (b - a) / size;
      const Vec2 n = perpendicular(u);
      const double h = std::min(height, size / 3.0);
      const std::vector<Vec2> tab{a, b, b - h * u + h * n, a + h * u + h * n};
      auto& others = taken[nets.piece[f]];
      if (std::ranges::none_of(others, [&](const auto& other) { return overlap(tab, other); })) {
        others.push_back(tab);
        nets.joins[j].tab = nets.tabs.push_back({c, j, tab});
        nets.joins[j].no_tab = unfold::NoTab::has_tab;
        break;
      }
    }
  }
}

}  // namespace

std::vector<export_::Drawing> drawings(const SamplePages& sample) {
  return export_::draw({sample.model, sample.nets, sample.pages}, {});
}

std::vector<EdgeId> all_edges(const mesh::Surface& surface) {
  std::vector<EdgeId> edges;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (!surface.is_border(e) && std::abs(surface.fold_angle(e)) > 1e-6) {
      edges.push_back(e);
    }
  }
  return edges;
}

SamplePages sample_pages(const mesh::Surface& surface, double scale, double tab_height,
                         std::span<const EdgeId> cuts, const std::string& name, const export_::Paper& paper,
                         double turn) {
  SamplePages sample;
  sample.model.model.surface = scaled(surface, scale);
  sample.model.model.name = name;
  sample.model.model.digest = "0123456789abcdef";
  sample.model.panels = flat_panels(sample.model.model.surface);
  const mesh::Surface& model = sample.model.model.surface;
  sample.nets = simple_nets(model, cuts);
  if (tab_height > 0.0) {
    add_tabs(model, sample.nets, tab_height);
  }
  sample.pages.paper = paper;
  const Box2 area = export_::piece_box(paper);
  Vec2 at = area.low;
  double row = 0.0;
  sample.pages.count = 1;
  for (const PieceId piece : ids<PieceId>(sample.nets.pieces.size())) {
    Box2 box;
    export_::Placement place{{std::cos(turn), std::sin(turn), {}}, PageId(sample.pages.count - 1)};
    for (const auto& outline : unfold::outline(model, sample.nets, piece)) {
      for (const Vec2 p : outline) {
        box.add(place(p));
      }
    }
    if (at.x + box.size().x > area.high.x && at.x > area.low.x) {
      at = {area.low.x, at.y + row + paper.gap};
      row = 0.0;
    }
    if (at.y + box.size().y > area.high.y && at.y > area.low.y) {
      at = area.low;
      row = 0.0;
      place.page = PageId(sample.pages.count++);
    }
    place.shift = at - box.low;
    sample.pages.placements.push_back(place);
    at.x += box.size().x + paper.gap;
    row = std::max(row, box.size().y);
  }
  return sample;
}

std::string number_in(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? text : text.substr(colon + 1);
}

}  // namespace ridgecraft::test
