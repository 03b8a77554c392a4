// SPDX-License-Identifier: GPL-3.0-or-later
// What every search over the pieces of a surface has to know.
#pragma once

#include <span>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {

/// A surface whose faces are to become pieces. It refers to what it was made of, which must outlive it.
struct NetProblem {
  const mesh::Surface& surface;
  const prepare::Panels& panels;  ///< flat regions that a search keeps whole
  const Patch& patch;             ///< all faces of the surface, each with its own number
  std::span<const PartId> part;   ///< of each face
  const Options& options;
  const Room& room;  ///< that every piece has to fit

  [[nodiscard]] const Weights& weights() const { return options.pieces.weights; }
  /// How deep faces of one piece may overlap, mm.
  [[nodiscard]] double tolerance() const { return net_tolerance(patch.extent); }
  /// The same faces with other neighbours.
  [[nodiscard]] NetProblem with(const Patch& other) const {
    return {surface, panels, other, part, options, room};
  }
};

}  // namespace ridgecraft::unfold
