// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of a model as a maker can build them: some left out, some plain, united where they meet.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {

struct OneSkin {
  mesh::Model model;
  prepare::CleanupReport cleanup;
  prepare::SkinReport skin;

  /// Whether anything was done to the model's bodies.
  [[nodiscard]] bool changed() const;
};

/// What is too small is judged at the size that is given. Throws Error(interrupted), Error(out_of_time).
[[nodiscard]] OneSkin one_skin(mesh::Model model, const prepare::SizeOptions& size,
                               const prepare::SimplifyOptions& simplify, const Context& context);

}  // namespace ridgecraft::job
