// SPDX-License-Identifier: GPL-3.0-or-later
// The surface that nets made before were unfolded from, where the model had been simplified for them.
#pragma once

#include <optional>

#include "base/context.hpp"
#include "job/options.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::job {

struct ModelOfNets {
  mesh::Model model;                  ///< with the nets' faces, in the unit of the model's file
  prepare::SimplifyOptions simplify;  ///< what they were simplified by
};

/// How nets of our own were simplified, as their settings say; nothing where they are another program's, or
/// the model was kept as it is.
[[nodiscard]] std::optional<prepare::SimplifyOptions> simplified_by(const OldNets& old);

/// The model that nets of our own hold: they must bear the model's digest, and have other points than it has.
/// Its faces have neither materials nor texture. Nothing where there is no such model. O(n log n). Throws
/// Error(unreadable_input) for a file that can't be read.
[[nodiscard]] std::optional<ModelOfNets> model_of_nets(const OldNets& old, const mesh::Model& model,
                                                       const Context& context);

}  // namespace ridgecraft::job
