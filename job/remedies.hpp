// SPDX-License-Identifier: GPL-3.0-or-later
// What would make an evening's work of a model that is none. Private to job/.
#pragma once

#include <functional>
#include <vector>

#include "job/options.hpp"
#include "job/remark.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {

/// A model as a job prepares it with these options.
using Preparation = std::function<prepare::Prepared(mesh::Model model, const UsedOptions& used)>;

/// Whether a person can't fold it, it is more work than it should be, or it has many bodies.
[[nodiscard]] bool needs_remedies(const prepare::Prepared& prepared, const UsedOptions& used);

/// Options with which the model needs none, each tried alone: a number of faces, the finest of three; and the
/// first of three names to leave out, those of most faces first, none of more than two fifths of the area.
/// Before them, where it can't be folded, the smallest size at which it can. Empty where nothing helps.
/// `used`: with what `model` was prepared. Seven preparations at most. Throws what `prepare` throws, but for
/// Error(no_nets) and Error(out_of_time).
[[nodiscard]] std::vector<Remedy> find_remedies(const mesh::Model& model, const prepare::Prepared& prepared,
                                                const UsedOptions& used, const Preparation& prepare);

}  // namespace ridgecraft::job
