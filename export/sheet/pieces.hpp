// SPDX-License-Identifier: GPL-3.0-or-later
// What sheets say of pieces: which are equal, which objects of the model they are of, and which others they
// are glued to, by which numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/model/surface.hpp"
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

/// A piece that another one is glued to.
struct Neighbour {
  PieceId piece;
  std::vector<std::uint32_t> numbers;  ///< of the joins with it, as printed; ascending, each once
};

/// For each piece the other pieces that it is glued to, ascending. O(joins log joins).
[[nodiscard]] IdVector<PieceId, std::vector<Neighbour>> find_neighbours(const mesh::Surface& surface,
                                                                        const unfold::Nets& nets);

/// "1-3, 7, 8": rows of three and more by their ends.
[[nodiscard]] std::string number_ranges(const std::vector<std::uint32_t>& numbers);

}  // namespace ridgecraft::export_
