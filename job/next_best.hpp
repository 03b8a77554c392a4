// SPDX-License-Identifier: GPL-3.0-or-later
// What takes the place of a result that fails its own check. Private to job/.
#pragma once

#include <functional>

#include "base/context.hpp"
#include "job/options.hpp"
#include "job/result.hpp"

namespace ridgecraft::job {

/// One run with these options.
using Attempt = std::function<Result(const Options& options, const Context& context)>;

/// The result of the first attempt that is sound: as the options say; with another seed; with the bodies of
/// the file, too; with a piece for each flat region, too; without tabs, too. A note of the result says which.
/// Throws what the first attempt throws, where that is no Error(internal) or where no attempt is sound.
[[nodiscard]] Result next_best(const Options& options, const Context& context, const Attempt& attempt);

}  // namespace ridgecraft::job
