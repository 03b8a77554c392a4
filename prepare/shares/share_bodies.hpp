// SPDX-License-Identifier: GPL-3.0-or-later
// A share of a model component by component, since each may need another treatment. Private to prepare/.
#pragma once

#include <vector>

#include "prepare/shares/share.hpp"

namespace ridgecraft::prepare {

/// One share for each component that is in the share, in the order of the components' numbers; complete in
/// themselves, each with its own copies. O(n log n).
[[nodiscard]] std::vector<SymmetricShare> divided(const SymmetricShare& share);

/// The share of all that they are shares of. They must have the same planes. O(n).
[[nodiscard]] SymmetricShare joined(const std::vector<SymmetricShare>& shares);

}  // namespace ridgecraft::prepare
