// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that there are several of: what they are called, and how that is told.
#pragma once

#include <string>
#include <vector>

#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Pieces that are alike: whoever builds the model makes the same thing several times.
struct PieceKind {
  std::vector<PieceId> pieces;    ///< ascending, mirrored ones left out
  std::vector<PieceId> mirrored;  ///< mirror images of these, ascending
  /// What the model's file calls what they are of: a name of objects that differ by their numbers alone, or
  /// of a material that nothing else has. Empty where there is none.
  std::string name;
  /// Some have other tabs than the rest on edges where they are glued to each other.
  bool tabs_differ = false;

  [[nodiscard]] std::size_t count() const { return pieces.size() + mirrored.size(); }
};

/// Those of Nets::equal. O(faces).
[[nodiscard]] std::vector<PieceKind> find_piece_kinds(const prepare::Prepared& model,
                                                      const unfold::Nets& nets);

/// What the model's file calls the object that all faces of a piece are of, such as "ear.L"; empty where
/// there is none, and for all pieces where all are of one. O(faces).
[[nodiscard]] IdVector<PieceId, std::string> find_piece_objects(const prepare::Prepared& model,
                                                                const unfold::Nets& nets);

/// "4 × wheel: C to F", "14 equal: A, C, E, ..., mirrored: B, D", "D and E are mirror images but for tabs
/// between them": at most `most` names of either.
[[nodiscard]] std::string kind_words(const unfold::Nets& nets, const PieceKind& kind, std::size_t most);

}  // namespace ridgecraft::export_
