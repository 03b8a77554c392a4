// SPDX-License-Identifier: GPL-3.0-or-later
// Files that name edges to be cut or kept: pairs of points, or nets made before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/files/edge_arguments.hpp"
#include "cli/files/targets.hpp"
#include "job/options.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::cli {

/// A file that was asked for, read whole: it may be a pipe, and its digest is a setting.
struct EdgeFile {
  std::string name;
  std::string bytes;
};
struct EdgeFiles {
  std::optional<EdgeFile> cuts, keep, from;
};
/// Reads what was asked for, before the long work. Throws Error(unreadable_input).
[[nodiscard]] EdgeFiles read_edge_files(const EdgeArguments& edges);

/// Their names, so that no result replaces them.
[[nodiscard]] std::vector<InputFile> input_files(const EdgeArguments& edges);

/// What they ask of this model, which was read with its points kept. Files of pairs have two numbers a line,
/// counted as the format of the model's file does; empty lines and what follows a # say nothing. Throws
/// Error(unreadable_input) for a line that names no two points.
[[nodiscard]] job::EdgeRequests requests_of(const EdgeFiles& files, const mesh::Model& model);

}  // namespace ridgecraft::cli
