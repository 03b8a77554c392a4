// SPDX-License-Identifier: GPL-3.0-or-later
// nets.fold: FOLD 1.2 (Demaine, Ku, Lang) with our own keys under "ridgecraft:". docs/reference/formats.md
// has every key.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "export/assembly/assembly.hpp"
#include "export/formats/net_frame.hpp"
#include "export/formats/write.hpp"
#include "export/view/camera.hpp"
#include "unfold/net/chains.hpp"

namespace ridgecraft::export_ {
namespace {

using mesh::Surface;
using unfold::Nets;

/// Folds of less are written as flat, degrees: the contract's limit.
constexpr double flat_fold_degrees = 1e-4;

/// Tabs and joins by the numbers they get in the file: slits in flat regions have neither.
struct Gluing {
  std::vector<JoinId> joins;
  std::vector<TabId> tabs;  ///< of joins
  std::vector<TabId> more;  ///< all others
  IdVector<TabId, std::uint32_t> tab_number;
};

Gluing gluing(const Surface& surface, const Nets& nets, const NetFrame& frame) {
  Gluing result;
  result.tab_number.resize(nets.tabs.size());
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    if (!frame.is_slit(surface, nets.joins[j].edge)) {
      result.joins.push_back(j);
    }
  }
  for (const TabId t : ids<TabId>(nets.tabs.size())) {
    if (is_additional(nets, t)) {
      result.more.push_back(t);
    } else if (!frame.is_slit(surface, surface.edge(nets.tabs[t].side))) {
      result.tab_number[t] = static_cast<std::uint32_t>(result.tabs.size());
      result.tabs.push_back(t);
    }
  }
  return result;
}

void write_edges(JsonText& json, const prepare::Prepared& model, const NetFrame& frame) {
  const Surface& surface = model.model.surface;
  const auto degrees = [&](std::size_t i) {
    const NetFrame::Edge& edge = frame.edges[i];
    const double angle =
        edge.fold ? surface.fold_angle(surface.edge(edge.side)) * 180.0 / std::numbers::pi : 0.0;
    return std::abs(angle) < flat_fold_degrees ? 0.0 : angle;
  };
  json.list("edges_vertices", frame.edges.size(), [&](std::size_t i) {
    json.raw("[");
    json.number(frame.edges[i].vertices[0]);
    json.raw(",");
    json.number(frame.edges[i].vertices[1]);
    json.raw("]");
  });
  json.list("edges_assignment", frame.edges.size(), [&](std::size_t i) {
    const double angle = degrees(i);
    json.raw(!frame.edges[i].fold ? "\"B\"" : angle < 0.0 ? "\"M\"" : angle > 0.0 ? "\"V\"" : "\"F\"");
  });
  json.list("edges_foldAngle", frame.edges.size(), [&](std::size_t i) { json.number(degrees(i)); });
  if (!model.rolls.rolls.empty()) {
    json.list("edges_ridgecraft:bent", frame.edges.size(), [&](std::size_t i) {
      json.raw(model.rolls.bends(surface.edge(frame.edges[i].side)) ? "true" : "false");
    });
  }
}

void write_triangle(JsonText& json, const std::array<std::uint32_t, 3>& corners) {
  json.raw("[");
  json.number(corners[0]);
  json.raw(",");
  json.number(corners[1]);
  json.raw(",");
  json.number(corners[2]);
  json.raw("]");
}

/// Parts are numbers; a face without one has -1.
std::int64_t number_of(PartId part) {
  return part.valid() ? std::int64_t{part.value()} : -1;
}

void write_pieces(JsonText& json, const Nets& nets, const NetFrame& frame) {
  json.list("ridgecraft:pieces", nets.pieces.size(), [&](std::size_t i) {
    const unfold::Piece& piece = nets.pieces[PieceId(i)];
    json.raw("\n{\"name\":");
    json.string(piece.name);
    json.raw(",\"part\":");
    piece.parts.size() == 1 ? json.number(number_of(piece.parts.front())) : json.raw("null");
    json.raw(",\"parts\":[");
    for (std::size_t k = 0; k < piece.parts.size(); ++k) {
      json.raw(k == 0 ? "" : ",");
      json.number(number_of(piece.parts[k]));
    }
    json.raw("],\"page\":");
    json.number(frame.page[PieceId(i)].value());
    json.raw(",\"holes\":");
    json.number(piece.holes);
    json.raw(",\"reason\":");
    json.string(unfold::name(piece.reason));
    json.raw("}");
  });
}

/// Per piece: lists of edges that are folded together, in order. Flat folds aren't in them.
void write_fold_order(JsonText& json, const Nets& nets, const NetFrame& frame) {
  json.list("ridgecraft:fold_order", nets.pieces.size(), [&](std::size_t i) {
    json.raw("[");
    const auto& steps = nets.pieces[PieceId(i)].folding.steps;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      json.raw(s == 0 ? "[" : ",[");
      for (std::size_t k = 0; k < steps[s].size(); ++k) {
        json.raw(k == 0 ? "" : ",");
        json.number(frame.edge[steps[s][k]]);
      }
      json.raw("]");
    }
    json.raw("]");
  });
}

void write_equal_pieces(JsonText& json, const Nets& nets) {
  json.list("ridgecraft:equal_pieces", nets.equal.size(), [&](std::size_t i) {
    const std::vector<unfold::EqualPiece>& kind = nets.equal[i];
    for (std::size_t k = 0; k < kind.size(); ++k) {
      json.raw(k == 0 ? "\n[{\"piece\":" : ",{\"piece\":");
      json.number(kind[k].piece.value());
      json.raw(kind[k].mirrored ? ",\"mirrored\":true" : ",\"mirrored\":false");
      json.raw(kind[k].other_tabs ? ",\"other_tabs\":true}" : "}");
    }
    json.raw("]");
  });
}

/// Joins by their numbers. Those that are slits in flat regions aren't in the file.
void write_assembly(JsonText& json, const Surface& surface, const Nets& nets, const NetFrame& frame,
                    const Assembly& assembly) {
  json.list("ridgecraft:assembly", assembly.steps.size(), [&](std::size_t i) {
    const AssemblyStep& step = assembly.steps[i];
    const char* separator = "\n{\"pieces\":[";
    for (const PieceId piece : step.pieces) {
      json.raw(separator);
      json.number(piece.value());
      separator = ",";
    }
    std::set<std::uint32_t> numbers;
    for (const auto* joins : {&step.own, &step.joins}) {
      for (const JoinId join : *joins) {
        if (!frame.is_slit(surface, nets.joins[join].edge)) {
          numbers.insert(nets.joins[join].number);
        }
      }
    }
    json.raw("],\"joins\":[");
    separator = "";
    for (const std::uint32_t number : numbers) {
      json.raw(separator);
      json.number(number);
      separator = ",";
    }
    json.raw("]}");
  });
}

void write_pages(JsonText& json, const NetFrame& frame, const Pages* pages) {
  json.list("ridgecraft:pages", frame.origins.size(), [&](std::size_t i) {
    json.raw("\n{\"origin\":");
    json.point(frame.origins[i]);
    json.raw(",\"size\":");
    if (pages == nullptr) {
      json.raw("null}");
      return;
    }
    json.point(pages->paper.size);
    json.raw(",\"margins\":[");
    for (const std::string_view separator : {"", ",", ",", ","}) {
      json.raw(separator);
      json.number(pages->paper.margin);
    }
    json.raw("]}");
  });
}

void write_joins(JsonText& json, const Surface& surface, const Nets& nets, const NetFrame& frame,
                 const Gluing& glue) {
  json.list("ridgecraft:joins", glue.joins.size(), [&](std::size_t i) {
    const unfold::Join& join = nets.joins[glue.joins[i]];
    const auto [c, d] = surface.sides(join.edge);
    json.raw("\n{\"number\":");
    json.number(join.number);
    json.raw(",\"edges\":[");
    json.number(frame.edge[c]);
    json.raw(",");
    json.number(frame.edge[d]);
    json.raw("],\"tab\":");
    if (join.tab.valid()) {
      json.number(glue.tab_number[join.tab]);
    } else {
      json.raw("null,\"why\":");
      json.string(unfold::name(join.no_tab));
    }
    json.raw("}");
  });
  const auto write_tab = [&](const unfold::Tab& tab) {
    json.raw("\n{\"edge\":");
    json.number(frame.edge[tab.side]);
    json.raw(",\"polygon\":[");
    for (std::size_t k = 0; k < tab.polygon.size(); ++k) {
      json.raw(k == 0 ? "" : ",");
      json.point(frame.place(nets.piece[mesh::face_of(tab.side)], tab.polygon[k]));
    }
    json.raw("],\"joins\":[");
    if (tab.join.valid()) {
      json.number(nets.joins[tab.join].number);
    }
    json.raw("]");
    if (tab.slit) {
      const PieceId target = nets.piece[mesh::face_of(surface.twin(tab.side))];
      json.raw(",\"slit\":[");
      json.point(frame.place(target, (*tab.slit)[0]));
      json.raw(",");
      json.point(frame.place(target, (*tab.slit)[1]));
      json.raw("]");
    }
    json.raw(tab.of_base ? ",\"foot\":true}" : "}");
  };
  json.list("ridgecraft:tabs", glue.tabs.size(), [&](std::size_t i) { write_tab(nets.tabs[glue.tabs[i]]); });
  if (!glue.more.empty()) {
    json.list("ridgecraft:more_tabs", glue.more.size(),
              [&](std::size_t i) { write_tab(nets.tabs[glue.more[i]]); });
  }
}

/// The chains of the joins that are in the file.
void write_chains(JsonText& json, const Surface& surface, const Nets& nets, const Gluing& glue) {
  IdVector<JoinId, std::uint32_t> join_number(nets.joins.size(), 0);
  IdVector<JoinId, bool> written(nets.joins.size());
  for (std::uint32_t i = 0; i < glue.joins.size(); ++i) {
    join_number[glue.joins[i]] = i;
    written[glue.joins[i]] = true;
  }
  std::vector<unfold::Chain> chains = unfold::chains_of(surface, nets);
  // A slit in a flat region is a chain of its own.
  std::erase_if(chains, [&](const unfold::Chain& chain) { return !written[chain.joins.front()]; });
  json.list("ridgecraft:chains", chains.size(), [&](std::size_t i) {
    json.raw("\n{\"number\":");
    json.number(chains[i].number);
    const char* separator = ",\"joins\":[";
    for (const JoinId join : chains[i].joins) {
      json.raw(separator);
      json.number(join_number[join]);
      separator = ",";
    }
    json.raw("]}");
  });
}

void write_glue(JsonText& json, const NetFrame& frame, const std::vector<GlueOutline>& glue_outlines) {
  if (glue_outlines.empty()) {
    return;
  }
  json.list("ridgecraft:glue", glue_outlines.size(), [&](std::size_t i) {
    const GlueOutline& glued = glue_outlines[i];
    json.raw("\n{\"piece\":");
    json.number(glued.piece.value());
    json.raw(",\"other\":");
    json.number(glued.other.value());
    json.raw(",\"outlines\":[");
    for (std::size_t k = 0; k < glued.outlines.size(); ++k) {
      const char* separator = k == 0 ? "[" : ",[";
      for (const Vec2 p : glued.outlines[k]) {
        json.raw(separator);
        json.point(frame.place(glued.piece, p));
        separator = ",";
      }
      json.raw("]");
    }
    json.raw("]}");
  });
}

void write_model(JsonText& json, const Surface& surface, const IdVector<FaceId, PartId>& part) {
  json.key("file_frames");
  json.raw("[{");
  json.key("frame_classes");
  json.raw("[\"foldedForm\"]");
  json.key("frame_attributes");
  json.raw("[\"3D\",\"manifold\",\"orientable\"]");
  json.key("frame_inherit");
  json.raw("false");
  json.key("frame_unit");
  json.raw("\"mm\"");
  json.list("vertices_coords", surface.vertex_count(),
            [&](std::size_t i) { json.point(surface.point(VertexId(i))); });
  json.list("faces_vertices", surface.face_count(), [&](std::size_t i) {
    const auto [a, b, c] = surface.vertices(FaceId(i));
    write_triangle(json, {a.value(), b.value(), c.value()});
  });
  json.list("ridgecraft:faces_part", part.size(),
            [&](std::size_t i) { json.number(number_of(part[FaceId(i)])); });
  json.raw("\n}]");
}

void write_head(JsonText& json, const Mark& mark) {
  json.key("file_spec");
  json.raw("1.2");
  json.key("file_creator");
  json.string(mark.producer);
  json.key("file_title");
  json.string(mark.title);
  json.key("file_classes");
  json.raw("[\"multiModel\"]");
  json.key("frame_classes");
  json.raw("[\"creasePattern\"]");
  json.key("frame_attributes");
  json.raw("[\"2D\"]");
  json.key("frame_unit");
  json.raw("\"mm\"");
  json.key(mark_key);
  json.string(mark.digest);
  json.key("ridgecraft:settings");
  json.raw(settings_json(mark.settings));
}

}  // namespace

std::string write_fold(const FoldContents& contents, const Mark& mark) {
  const auto& [model, part, nets, assembly, pages, glue_outlines, up] = contents;
  const Surface& surface = model.model.surface;
  RIDGECRAFT_ASSERT(part.size() == surface.face_count());
  const NetFrame frame = net_frame(surface, nets, pages);
  const Gluing glue = gluing(surface, nets, frame);
  JsonText json;
  json.raw("{");
  write_head(json, mark);
  json.key("ridgecraft:up");
  json.string(mesh::axis_name(up.value_or(up_axis_of(model.model))));
  json.list("vertices_coords", frame.points.size(), [&](std::size_t i) { json.point(frame.points[i]); });
  write_edges(json, model, frame);
  json.list("faces_vertices", frame.faces.size(),
            [&](std::size_t i) { write_triangle(json, frame.faces[i]); });
  json.list("ridgecraft:faces_model", frame.faces.size(), [&](std::size_t i) { json.number(i); });
  json.list("ridgecraft:faces_piece", frame.faces.size(),
            [&](std::size_t i) { json.number(contents.nets.piece[FaceId(i)].value()); });
  write_pieces(json, nets, frame);
  write_fold_order(json, nets, frame);
  write_equal_pieces(json, nets);
  write_assembly(json, surface, nets, frame, assembly);
  write_pages(json, frame, pages);
  write_joins(json, surface, nets, frame, glue);
  write_chains(json, surface, nets, glue);
  write_glue(json, frame, glue_outlines);
  write_model(json, surface, part);
  json.raw("\n}\n");
  return std::move(json).take();
}

}  // namespace ridgecraft::export_
