// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace ridgecraft::mesh {

/// What repair does where the jobs differ.
struct ReadOptions {
  /// Collapse faces without area. Paper can't hold them; segmentation keeps them, since dropping them opens
  /// closed surfaces.
  bool collapse_flat_faces = true;
  bool keep_points = false;  ///< fill Model::file_points
  /// The program that reads formats by Assimp (import/); empty: they are refused.
  std::filesystem::path importer = {};
};

}  // namespace ridgecraft::mesh
