// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/assembly/seam_graph.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace ridgecraft::paper {
namespace {

void number_groups(SeamGraph& graph) {
  std::vector<bool> seen(graph.nodes.size(), false);
  for (const PieceId first : ids<PieceId>(graph.nodes.size())) {
    if (seen[first.value()]) {
      continue;
    }
    std::vector<PieceId> group{first};
    seen[first.value()] = true;
    for (std::size_t i = 0; i < group.size(); ++i) {
      SeamGraph::Node& node = graph.nodes[group[i]];
      node.group = static_cast<std::uint32_t>(graph.groups.size());
      for (const SeamGraph::Seam& seam : node.seams) {
        if (!seen[seam.other.value()]) {
          seen[seam.other.value()] = true;
          group.push_back(seam.other);
        }
      }
    }
    std::sort(group.begin(), group.end());
    graph.groups.push_back(std::move(group));
  }
}

}  // namespace

double SeamGraph::seam_between(PieceId a, PieceId b) const {
  const auto& seams = nodes[a].seams;
  const auto found = std::lower_bound(seams.begin(), seams.end(), b,
                                      [](const Seam& seam, PieceId piece) { return seam.other < piece; });
  return found != seams.end() && found->other == b ? found->length_mm : 0.0;
}

double SeamGraph::border_of(std::size_t group) const {
  double sum = 0.0;
  for (const PieceId piece : groups[group]) {
    sum += nodes[piece].border_mm;
  }
  return sum;
}

SeamGraph seam_graph(const mesh::Surface& surface, const unfold::Nets& nets) {
  SeamGraph graph;
  graph.nodes.resize(nets.pieces.size());
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    SeamGraph::Node& node = graph.nodes[nets.piece[face]];
    node.area_mm2 += surface.area(face);
    for (const unsigned k : {0U, 1U, 2U}) {
      const EdgeId edge = surface.edge(mesh::corner(face, k));
      node.border_mm += surface.is_border(edge) ? surface.length(edge) : 0.0;
    }
  }
  std::map<std::pair<PieceId, PieceId>, SeamGraph::Seam> seams;
  for (const unfold::Join& join : nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const PieceId a = nets.piece[mesh::face_of(c)];
    const PieceId b = nets.piece[mesh::face_of(d)];
    const double length = surface.length(join.edge);
    if (a == b) {
      graph.nodes[a].own_mm += length;
      ++graph.nodes[a].own_joins;
      continue;
    }
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      SeamGraph::Seam& seam = seams[{from, to}];
      seam.other = to;
      seam.length_mm += length;
      graph.nodes[from].seam_mm += length;
      ++graph.nodes[from].joins;
    }
  }
  for (const auto& [ends, seam] : seams) {
    graph.nodes[ends.first].seams.push_back(seam);
  }
  number_groups(graph);
  return graph;
}

}  // namespace ridgecraft::paper
