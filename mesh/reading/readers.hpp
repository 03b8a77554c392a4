// SPDX-License-Identifier: GPL-3.0-or-later
// One reader per format.
#pragma once

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

// Each takes bytes that detect_format() found to be of its format and fills the whole soup.
[[nodiscard]] Soup read_obj(const Source& source);
[[nodiscard]] Soup read_stl_ascii(const Source& source);
[[nodiscard]] Soup read_stl_binary(const Source& source);
[[nodiscard]] Soup read_ply(const Source& source);
[[nodiscard]] Soup read_off(const Source& source);
[[nodiscard]] Soup read_gltf(const Source& source);
[[nodiscard]] Soup read_glb(const Source& source);
[[nodiscard]] Soup read_3mf(const Source& source);
[[nodiscard]] Soup read_pdo(const Source& source);
/// Formats that Assimp reads: by Source::importer.
[[nodiscard]] Soup read_imported(FileFormat format, const Source& source);

}  // namespace ridgecraft::mesh
