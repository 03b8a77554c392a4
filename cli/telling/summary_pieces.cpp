// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/summary_pieces.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "export/page/neighbours.hpp"

namespace ridgecraft::cli {
namespace {

std::vector<PieceId> pieces_with_care(const unfold::Nets& nets) {
  std::vector<PieceId> found;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    if (nets.pieces[p].folding.way == unfold::FoldWay::with_care) {
      found.push_back(p);
    }
  }
  return found;
}

/// unfold::sentence(reason), with the option that the user can change it by.
std::string sentence_of_one(unfold::PieceReason reason) {
  return std::string(unfold::sentence(reason)) +
         (reason == unfold::PieceReason::faces ? " (--max-faces)" : "");
}

/// The same for several pieces.
std::string sentence_of_several(unfold::PieceReason reason) {
  using unfold::PieceReason;
  switch (reason) {
    case PieceReason::page:
      return "their parts don't fit the paper in one piece";
    case PieceReason::overlap:
      return "their parts would overlap themselves in one piece";
    case PieceReason::tabs:
      return "their parts have no room for tabs in one piece";
    case PieceReason::faces:
      return "their parts have more faces than one piece may have (--max-faces)";
    case PieceReason::component:
      return "their parts aren't connected";
    case PieceReason::part:
    case PieceReason::time:
    case PieceReason::request:
      return sentence_of_one(reason);
  }
  return "";
}

}  // namespace

std::string piece_names(const unfold::Nets& nets, const std::vector<PieceId>& pieces) {
  constexpr std::size_t most = 6;  // before the rest is only counted
  const auto name = [&](PieceId p) { return nets.pieces[p].name; };
  const bool in_a_row = pieces.back().value() - pieces.front().value() + 1 == pieces.size();
  if (in_a_row && pieces.size() > 2) {
    return name(pieces.front()) + " to " + name(pieces.back());
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(pieces.size(), most); ++i) {
    text += (i == 0 ? "" : ", ") + name(pieces[i]);
  }
  return pieces.size() <= most ? text : text + " and " + std::to_string(pieces.size() - most) + " more";
}

std::string extra_pieces_text(const unfold::Nets& nets) {
  std::map<unfold::PieceReason, std::vector<PieceId>> names;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    if (nets.pieces[p].reason != unfold::PieceReason::part) {
      names[nets.pieces[p].reason].push_back(p);
    }
  }
  std::string text;
  for (const auto& [reason, list] : names) {
    text += fmt::format("  {:<11} {}: {}\n", list.size() == 1 ? "piece" : "pieces", piece_names(nets, list),
                        list.size() == 1 ? sentence_of_one(reason) : sentence_of_several(reason));
  }
  return text;
}

Json extra_pieces_json(const unfold::Nets& nets) {
  Json list = Json::array();
  for (const unfold::Piece& piece : nets.pieces) {
    if (piece.reason != unfold::PieceReason::part) {
      list.push_back({{"name", piece.name},
                      {"reason", unfold::name(piece.reason)},
                      {"why", sentence_of_one(piece.reason)}});
    }
  }
  return list;
}

std::string reasons_text(const unfold::Nets& nets) {
  std::map<std::string, std::size_t> reasons;
  for (const unfold::Piece& piece : nets.pieces) {
    if (piece.reason != unfold::PieceReason::part) {
      ++reasons[std::string(unfold::name(piece.reason))];
    }
  }
  std::string text;
  for (const auto& [reason, count] : reasons) {
    text += fmt::format("{}{} because of {}", text.empty() ? " (" : ", ", count, reason);
  }
  return text.empty() ? text : text + ")";
}

std::string bodies_text(const unfold::Nets& nets, const std::vector<paper::Body>& bodies) {
  constexpr std::size_t most = 8;
  if (bodies.empty()) {
    return {};
  }
  std::string text = fmt::format("  bodies      {} that no join connects: ", bodies.size());
  for (std::size_t i = 0; i < std::min(most, bodies.size()); ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "" : "; ", i + 1, piece_names(nets, bodies[i].pieces));
    if (bodies[i].beside.valid() && i > 0) {
      text += " at " + nets.pieces[bodies[i].beside].name;
    }
  }
  return text + (bodies.size() > most ? fmt::format("; {} more\n", bodies.size() - most) : "\n");
}

Json bodies_json(const unfold::Nets& nets, const std::vector<paper::Body>& bodies) {
  Json list = Json::array();
  for (const paper::Body& body : bodies) {
    Json pieces = Json::array();
    for (const PieceId piece : body.pieces) {
      pieces.push_back(nets.pieces[piece].name);
    }
    Json item{{"pieces", pieces}};
    if (body.beside.valid()) {
      item["beside"] = nets.pieces[body.beside].name;
      item["distance_mm"] = rounded(body.distance_mm);
    }
    list.push_back(item);
  }
  return list;
}

Json index_json(const mesh::Surface& surface, const unfold::Nets& nets, const paper::Pages& pages) {
  const auto neighbours = paper::find_neighbours(surface, nets);
  Json list = Json::array();
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    Json joins = Json::array();
    for (const paper::Neighbour& neighbour : neighbours[p]) {
      joins.push_back({{"piece", nets.pieces[neighbour.piece].name}, {"numbers", neighbour.numbers}});
    }
    list.push_back(
        {{"piece", nets.pieces[p].name}, {"page", pages.placements[p].page.value() + 1}, {"joins", joins}});
  }
  return list;
}

std::string numbers_text(const paper::DrawReport& drawn) {
  constexpr std::size_t most = 10;
  std::vector<paper::DrawReport::Number> lost = drawn.labels_left_out;
  std::sort(lost.begin(), lost.end());
  if (lost.empty() && drawn.labels_outside + drawn.names_left_out == 0) {
    return {};
  }
  std::string text = fmt::format("  numbers     {} beside their piece, {} without a place",
                                 drawn.labels_outside, lost.size());
  for (std::size_t i = 0; i < std::min(most, lost.size()); ++i) {
    const bool same_piece = i > 0 && lost[i].piece == lost[i - 1].piece;
    text += same_piece ? ", " : (i == 0 ? ": " : "; ") + lost[i].piece + " ";
    text += std::to_string(lost[i].number);
  }
  text += lost.size() > most ? fmt::format(" and {} more", lost.size() - most) : "";
  return text + (drawn.names_left_out > 0
                     ? fmt::format("; {} without a place\n", counted(drawn.names_left_out, "name"))
                     : "\n");
}

Json numbers_json(const paper::DrawReport& drawn) {
  Json list = Json::array();
  for (const auto& [piece, number] : drawn.labels_left_out) {
    list.push_back({{"piece", piece}, {"number", number}});
  }
  return list;
}

std::string folding_text(const unfold::Nets& nets) {
  const std::vector<PieceId> pieces = pieces_with_care(nets);
  return pieces.empty()
             ? ""
             : fmt::format("  folding     {}: faces are in each other's way and have to be bent aside\n",
                           piece_names(nets, pieces));
}

Json folding_json(const unfold::Nets& nets) {
  Json list = Json::array();
  for (const PieceId p : pieces_with_care(nets)) {
    list.push_back(nets.pieces[p].name);
  }
  return list;
}

std::string colours_text(const mesh::Model& model) {
  const bool coloured =
      std::any_of(model.materials.begin(), model.materials.end(), [](const mesh::Material& m) {
        return !m.texture_file.empty() || (m.colour && *m.colour != mesh::Colour{1.0, 1.0, 1.0});
      });
  return coloured ? "  colours     of the model aren't printed: pages show lines only\n" : "";
}

}  // namespace ridgecraft::cli
