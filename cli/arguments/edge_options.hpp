// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept together: --cuts, --keep, --from, and those that the file itself marks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"
#include "cli/files/targets.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "unfold/net/edge_wishes.hpp"

namespace ridgecraft::cli {

/// Adds the three options to a verb.
void add_edge_options(Verb& verb, EdgeArguments& edges);

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

/// Edges that the user names, or that the file itself marks, are those of the model as it is in its file: it
/// isn't simplified unless that was asked for with a number. Marks are dropped where nets made before decide,
/// and where they stand at most of the edges: such a file means something else by them. Notes say what wasn't
/// asked for.
void heed_edges(const EdgeArguments& edges, mesh::Model& model, SizeArguments& size,
                std::vector<std::string>& notes);

/// What is wanted of each edge of the prepared surface; empty where nothing is. What couldn't be matched is
/// noted. Throws Error(unreadable_input) for files that can't be read, Error(unusable_mesh) for nets of
/// another model.
[[nodiscard]] unfold::EdgeWishes wishes_of(const EdgeFiles& edges, const prepare::Prepared& prepared,
                                           const Context& context, std::vector<std::string>& notes);

}  // namespace ridgecraft::cli
