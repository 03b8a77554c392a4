// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/part_notes.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/sentence.hpp"

namespace ridgecraft::unfold {
namespace {

/// More are only counted.
constexpr std::size_t most_names = 4;

std::string names_of(std::vector<PieceId> pieces, const Nets& nets) {
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  std::vector<std::string> names;
  for (const PieceId piece : pieces) {
    if (names.size() == most_names && pieces.size() > most_names + 1) {
      names.push_back(std::to_string(pieces.size() - most_names) + " more");
      break;
    }
    names.push_back(nets.pieces[piece].name);
  }
  return (names.size() == 1 ? "the part of " : "the parts of ") + listed(names, "and");
}

}  // namespace

std::vector<std::string> sentences(std::span<const PartNote> notes, const Nets& nets) {
  std::vector<std::pair<std::string, std::vector<PieceId>>> facts;
  for (const PartNote& note : notes) {
    const auto known =
        std::find_if(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == note.what; });
    const PieceId piece = nets.piece[note.face];
    if (known != facts.end()) {
      known->second.push_back(piece);
    } else {
      facts.push_back({note.what, {piece}});
    }
  }
  std::vector<std::string> result;
  for (const auto& [what, pieces] : facts) {
    result.push_back(names_of(pieces, nets) + ": " + what);
  }
  return result;
}

}  // namespace ridgecraft::unfold
