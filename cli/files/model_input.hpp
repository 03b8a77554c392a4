// SPDX-License-Identifier: GPL-3.0-or-later
// The MODEL of a command line: a file, or "-" for what comes through standard input.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/mesh.hpp"

namespace ridgecraft::cli {

/// ridgecraft-import beside the running program, or in ../libexec/ridgecraft from there; empty where it isn't
/// installed.
[[nodiscard]] std::filesystem::path importer_program();

/// What sentences call it: "whale.obj", "standard input".
[[nodiscard]] std::string shown_name(const std::string& model);

/// What results without a name of their own are named after: "whale"; "model" for standard input.
[[nodiscard]] std::string results_name(const std::string& model);

/// mesh::read() of either. Nothing lies beside standard input: materials of a model from there are names
/// only. A folder, a terminal, a device, or nothing at all behind standard input throws
/// Error(unreadable_input).
[[nodiscard]] mesh::Model read_model(const std::string& model, const mesh::ReadOptions& options,
                                     const Context& context);

}  // namespace ridgecraft::cli
