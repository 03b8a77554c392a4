// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ridgecraft::mesh {

/// What repair does where the jobs differ.
struct ReadOptions {
  /// Collapse faces without area. Paper can't hold them; segmentation keeps them, since dropping them opens
  /// closed surfaces.
  bool collapse_flat_faces = true;
  bool keep_points = false;  ///< fill Model::file_points
};

}  // namespace ridgecraft::mesh
