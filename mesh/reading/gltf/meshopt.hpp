// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes that meshopt packs (EXT_meshopt_compression of glTF), by libmeshoptimizer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ridgecraft::mesh {

/// Whether the program was built with libmeshoptimizer.
[[nodiscard]] bool reads_meshopt();

/// What the file says of packed elements.
struct MeshoptElements {
  std::uint64_t count = 0;
  std::uint64_t stride = 0;  ///< bytes of one
  std::string mode;          ///< "ATTRIBUTES", "TRIANGLES" or "INDICES"
  std::string filter;        ///< "OCTAHEDRAL" and so on; may be empty
};

/// Nothing where the bytes are damaged, or the elements can't be theirs.
[[nodiscard]] std::optional<std::string> unpack_meshopt(const MeshoptElements& elements,
                                                        std::string_view packed);

}  // namespace ridgecraft::mesh
