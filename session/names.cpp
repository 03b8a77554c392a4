// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/names.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "base/id.hpp"
#include "unfold/net/keep_numbers.hpp"

namespace ridgecraft::session {
namespace {

using unfold::Nets;

/// The old piece that most of a piece's area comes from; the first of several.
PieceId origin_of(const mesh::Surface& surface, const Nets& before, const unfold::Piece& piece) {
  std::map<PieceId, double> area;
  for (const FaceId f : piece.faces) {
    area[before.piece[f]] += surface.area(f);
  }
  return std::max_element(area.begin(), area.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// "C" of "C.2"
std::string root_of(const std::string& name) {
  return name.substr(0, name.find('.'));
}

/// The name of a piece with these faces; empty where there is none.
std::string name_in(const Nets& nets, const unfold::Piece& piece) {
  const unfold::Piece& other = nets.pieces[nets.piece[piece.faces.front()]];
  return other.faces == piece.faces ? other.name : std::string();
}

void name_pieces(const mesh::Surface& surface, const Nets& first, const Nets& before, Nets& after) {
  std::set<std::string> taken;
  for (const unfold::Piece& piece : before.pieces) {
    taken.insert(piece.name);
  }
  for (unfold::Piece& piece : after.pieces) {
    piece.name = name_in(before, piece);
    if (!piece.name.empty()) {
      continue;
    }
    piece.name = name_in(first, piece);
    const std::string root = root_of(before.pieces[origin_of(surface, before, piece)].name);
    for (std::size_t i = 1; piece.name.empty() || taken.contains(piece.name); ++i) {
      piece.name = root + "." + std::to_string(i);
    }
    taken.insert(piece.name);
  }
}

}  // namespace

void keep_names(const mesh::Surface& surface, const Nets& first, const Nets& before, Nets& after) {
  name_pieces(surface, first, before, after);
  unfold::keep_numbers(surface, before.joins, after);
}

}  // namespace ridgecraft::session
