// SPDX-License-Identifier: GPL-3.0-or-later
// SVG of one page's nets for Origami Simulator (Ghassaei, Demaine, Gershenfeld: Fast, interactive origami
// simulation using GPU computation, 2018): nothing but edges, a path of two points each. Colours tell what an
// edge is, opacity by how much it is folded.
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/utf8.hpp"
#include "base/xml_text.hpp"
#include "export/formats/net_frame.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"

namespace ridgecraft::paper {
namespace {

/// The simulator joins points that are nearer than three units.
constexpr double units_per_mm = 100.0;
/// As in the FOLD file: a smaller angle is a flat facet.
constexpr double flat_degrees = 1e-6;

struct Look {
  std::string_view color;
  double opacity;
};

Look look_of(bool is_fold, double degrees) {
  if (!is_fold) {
    return {"#000000", 1.0};
  }
  if (std::abs(degrees) < flat_degrees) {
    return {"#ffff00", 1.0};
  }
  return {degrees < 0.0 ? "#ff0000" : "#0000ff", std::abs(degrees) / 180.0};
}

}  // namespace

std::string write_simulator_svg(const prepare::Prepared& model, const unfold::Nets& nets, const Pages& pages,
                                PageId page, const Mark& mark) {
  const mesh::Surface& surface = model.model.surface;
  const NetFrame frame = net_frame(surface, nets, &pages);
  IdVector<PieceId, std::size_t> faces;
  faces.resize(nets.pieces.size());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    ++faces[nets.piece[f]];
  }
  std::string out;
  const Vec2 size = pages.paper.size;
  append(out,
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"\n"
         "     width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\">\n",
         decimals(size.x), decimals(size.y), decimals(units_per_mm * size.x),
         decimals(units_per_mm * size.y));
  append(out, "  <metadata id=\"metadata\">{} preset:origami-simulator {}</metadata>\n",
         xml_escaped(printable_utf8(mark.producer)), xml_escaped(printable_utf8(mark_word(mark))));
  const auto x = [&](Vec2 p) { return decimals(units_per_mm * p.x); };
  const auto y = [&](Vec2 p) { return decimals(units_per_mm * (size.y - p.y)); };
  for (const NetFrame::Edge& edge : frame.edges) {
    const PieceId piece = nets.piece[mesh::face_of(edge.side)];
    if (frame.page[piece] != page || faces[piece] < 2) {
      continue;
    }
    const double degrees = surface.fold_angle(surface.edge(edge.side)) * 180.0 / std::numbers::pi;
    const Look look = look_of(edge.fold, degrees);
    const Vec2 from = frame.points[edge.vertices[0]] - frame.origins[page.value()];
    const Vec2 to = frame.points[edge.vertices[1]] - frame.origins[page.value()];
    append(out,
           "  <path fill=\"none\" stroke=\"{}\" stroke-width=\"10\" opacity=\"1\" stroke-opacity=\"{:.6f}\" "
           "d=\"M{},{} L{},{}\"/>\n",
           look.color, look.opacity, x(from), y(from), x(to), y(to));
  }
  append(out, "</svg>\n");
  return out;
}

}  // namespace ridgecraft::paper
