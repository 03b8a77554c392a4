// SPDX-License-Identifier: GPL-3.0-or-later
// What else is where a component of a surface is. Private to prepare/.
#pragma once

#include <functional>
#include <vector>

#include "base/boxes.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// A component by its faces.
using ComponentFaces = std::vector<FaceId>;

class Neighbours {
 public:
  /// `surface` stays where it is. O(n log n).
  explicit Neighbours(const mesh::Surface& surface);

  /// Do faces of two other components, or of more, come as near as `reach`, as their boxes tell? Only those
  /// count that `counts` says so of, if it is given. O(log n) a face.
  [[nodiscard]] bool are_several(const ComponentFaces& faces, double reach,
                                 const std::function<bool(ComponentId)>& counts = {}) const;

 private:
  const mesh::Surface& surface_;
  BoxTree<Box3> tree_;
};

}  // namespace ridgecraft::prepare
