// SPDX-License-Identifier: GPL-3.0-or-later
// Models that aren't ours to ship; tests of them say so where the folder is missing.
#pragma once

#include <filesystem>

namespace ridgecraft::test {

/// The folder in which they lie.
inline const std::filesystem::path shared_models = std::filesystem::path(RIDGECRAFT_SHARED_DIR) / "models";

}  // namespace ridgecraft::test
