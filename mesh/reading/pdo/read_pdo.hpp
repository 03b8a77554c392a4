// SPDX-License-Identifier: GPL-3.0-or-later
// The cuts and folds of nets that another program made and kept in its file of the model.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"

namespace ridgecraft::mesh {

/// Edges by their ends, in the file's unit.
struct FileSeams {
  std::vector<Vec3> points;               ///< of the model that the nets are of
  std::vector<std::array<Vec3, 2>> cut;   ///< between two faces that the nets lay apart
  std::vector<std::array<Vec3, 2>> keep;  ///< folded, or flat
};

/// True for a file that read_seams() knows: PDO, of Pepakura Designer.
[[nodiscard]] bool may_have_seams(std::string_view bytes);

/// What the nets in such a file cut and fold, by where they lay its faces: an edge is folded where two faces
/// of one piece lie at it in the same place. Edges of one face, and those at faces that no piece has, are in
/// neither list. Throws Error(unreadable_input) with a sentence that begins with the name, also where there
/// are no nets. O(n log n).
[[nodiscard]] FileSeams read_seams(std::string_view bytes, std::string_view file_name,
                                   const Context& context);

}  // namespace ridgecraft::mesh
