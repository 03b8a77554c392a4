// SPDX-License-Identifier: GPL-3.0-or-later
// What a file calls its bodies, kept beyond simplification, which makes faces of no polygon. Private to
// prepare/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::prepare {

/// Where each named object of a model lies.
class BodyNames {
 public:
  /// Nothing is kept of models with less than two bodies or names. O(n log n).
  explicit BodyNames(const mesh::Model& model);

  /// For each component of a surface that has come of the model the name of the object that most of its faces
  /// lie near to; empty where that has none, or nothing was kept. O(n log n).
  [[nodiscard]] IdVector<ComponentId, std::string> of(const mesh::Surface& surface) const;

 private:
  std::vector<std::string> names_;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> name_;  ///< of each point
};

}  // namespace ridgecraft::prepare
