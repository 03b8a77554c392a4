// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a person could build what comes out, in one sentence.
#pragma once

#include <string>

#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {

/// "can't be built at 150 mm: 38 % of the folds are shorter than 3 mm; at 380 mm it can"; empty
/// for a model that can be folded.
[[nodiscard]] std::string verdict(const prepare::Prepared& prepared,
                                  const prepare::SimplifyOptions& simplify);

}  // namespace ridgecraft::job
