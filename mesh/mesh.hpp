// SPDX-License-Identifier: GPL-3.0-or-later
// What a model is: reading and repair. Read this header first.
//
//   file --read--> Model (repaired, in the file's unit)
//
// Errors are ridgecraft::Error of kinds unreadable_input, unusable_mesh, interrupted.
#pragma once

#include <filesystem>
#include <string>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/read_options.hpp"

namespace ridgecraft::mesh {

/// A model file in memory, wherever its bytes came from.
struct ModelFile {
  std::string bytes;
  std::string name;   ///< what messages call it; its suffix helps where the content could be several formats
  std::string title;  ///< what results are named after: Model::name
  /// Where its material files and pictures are looked for; empty for nowhere: then materials are names only.
  std::filesystem::path folder;
};

/// Reads each format of format_names() (content decides, the suffix only helps) and repairs it: points
/// joined, polygons triangulated, duplicates dropped, faces oriented, edges and vertices made manifold. Every
/// change is counted in Model::repairs. Cost O(n log n). Throws unreadable_input or unusable_mesh with a
/// sentence that names the file.
[[nodiscard]] Model read(const std::filesystem::path& file, const ReadOptions& options,
                         const Context& context);
/// The same for bytes in memory.
[[nodiscard]] Model read(const ModelFile& file, const ReadOptions& options, const Context& context);

}  // namespace ridgecraft::mesh
