// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a person could build what comes out, in one sentence.
#pragma once

#include <string>

#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {

/// Whether what is told of a larger size was tried with the same bodies that a job has there: where bodies
/// were left out, thinned or moved for this size, others are at another one.
[[nodiscard]] bool larger_size_is_sure(const prepare::CleanupReport& cleanup,
                                       const prepare::SkinReport& skin);

/// "can't be built at 150 mm: 38 % of the folds are shorter than 3 mm; at 380 mm it can", or "it may" where
/// that isn't sure; empty for a model that can be folded.
[[nodiscard]] std::string verdict(const prepare::Prepared& prepared, const prepare::SimplifyOptions& simplify,
                                  bool larger_is_sure);

}  // namespace ridgecraft::job
