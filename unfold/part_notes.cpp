// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/part_notes.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/text.hpp"

namespace ridgecraft::unfold {
namespace {

/// More are only counted.
constexpr std::size_t most_names = 4;

/// The pieces that a part became, where each of them is of this part alone; else the piece of this face.
std::vector<PieceId> pieces_of_part(FaceId face, const Nets& nets) {
  const PieceId own = nets.piece[face];
  const std::vector<PartId>& parts = nets.pieces[own].parts;
  std::vector<PieceId> pieces;
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    const std::vector<PartId>& others = nets.pieces[piece].parts;
    if (piece == own || (parts.size() == 1 && others == parts)) {
      pieces.push_back(piece);
    }
  }
  return pieces;
}

/// "a part of A" (which has faces of others, too), "the part of A and C", "each of the parts of A and C; D":
/// parts by their pieces.
std::string names_of(std::vector<std::vector<PieceId>> parts, const Nets& nets) {
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  // A piece may have faces of several parts, and the fact is one part's.
  const bool is_one_of_several =
      parts.size() == 1 && parts[0].size() == 1 && nets.pieces[parts[0][0]].parts.size() > 1;
  std::string text = is_one_of_several   ? "a part of "
                     : parts.size() == 1 ? "the part of "
                                         : "each of the parts of ";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == most_names && parts.size() > most_names + 1) {
      return text + "; and " + std::to_string(parts.size() - most_names) + " more";
    }
    std::vector<std::string> names;
    for (const PieceId piece : parts[i]) {
      names.push_back(nets.pieces[piece].name);
    }
    text += (i == 0 ? "" : "; ") + listed(names, "and");
  }
  return text;
}

}  // namespace

std::vector<std::string> sentences(std::span<const PartNote> notes, const Nets& nets) {
  std::vector<std::pair<std::string, std::vector<std::vector<PieceId>>>> facts;
  for (const PartNote& note : notes) {
    const auto known =
        std::find_if(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == note.what; });
    std::vector<PieceId> pieces = pieces_of_part(note.face, nets);
    if (known != facts.end()) {
      known->second.push_back(std::move(pieces));
    } else {
      facts.push_back({note.what, {std::move(pieces)}});
    }
  }
  std::vector<std::string> result;
  for (const auto& [what, parts] : facts) {
    result.push_back(names_of(parts, nets) + ": " + what);
  }
  return result;
}

}  // namespace ridgecraft::unfold
