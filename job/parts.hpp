// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces are unfolded together.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "job/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::job {

/// Nearly convex parts that end at the borders of flat regions, or one part per component, as the options
/// say. Where segmentation takes more than half of the time that is left until the context's deadline, each
/// component is one part, and a note says so. Throws Error(interrupted).
[[nodiscard]] IdVector<FaceId, PartId> find_parts(const prepare::Prepared& prepared, const Options& options,
                                                  const Context& context, std::vector<std::string>& notes);

/// Linear.
[[nodiscard]] std::size_t count_parts(const IdVector<FaceId, PartId>& part);

}  // namespace ridgecraft::job
