// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept together: --cuts, --keep, --from, and the lines of an OBJ file.
#pragma once

#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cli/verb.hpp"
#include "mesh/mesh.hpp"
#include "unfold/edge_wishes.hpp"

namespace ridgecraft::cli {

/// Adds the three options to a verb.
void add_edge_options(Verb& verb, EdgeArguments& edges);

/// Wishes name edges of the model as it is in its file, so it isn't simplified unless that was asked for with
/// a number.
void keep_faces_for_wishes(const EdgeArguments& edges, SizeArguments& size);

/// The same for edges that the file itself marks; a file that marks most of its edges means none, and they
/// are dropped. Notes say what was done.
void heed_lines(const EdgeArguments& edges, mesh::Model& model, SizeArguments& size,
                std::vector<std::string>& notes);

/// What is wanted of each edge of the prepared surface; empty where nothing is. What couldn't be matched is
/// noted. Throws Error(unreadable_input) for files that can't be read, Error(unusable_mesh) for nets of
/// another model.
[[nodiscard]] unfold::EdgeWishes wishes_of(const EdgeArguments& edges, const std::string& model_file,
                                           const mesh::Prepared& prepared, const Context& context,
                                           std::vector<std::string>& notes);

}  // namespace ridgecraft::cli
