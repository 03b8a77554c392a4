// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a person could build what comes out, in one sentence.
#pragma once

#include <string>

#include "job/job.hpp"

namespace ridgecraft::job {

/// "can't be built at 150 mm: 38 % of the folds are shorter than 3 mm; at 380 mm it can"; empty
/// for a model that can be folded. "It may" where bodies were left out, thinned or moved for this size: at
/// another one others are.
[[nodiscard]] std::string verdict(const Paper& made);

/// Whether what is told of a larger size was tried with the same bodies that the job has there.
[[nodiscard]] bool larger_size_is_sure(const Paper& made);

}  // namespace ridgecraft::job
