// SPDX-License-Identifier: GPL-3.0-or-later
// Where the program lies that reads formats by Assimp.
#pragma once

#include <filesystem>

namespace ridgecraft::cli {

/// ridgecraft-import beside the running program, or in ../libexec/ridgecraft from there; empty where it isn't
/// installed.
[[nodiscard]] std::filesystem::path importer_program();

}  // namespace ridgecraft::cli
