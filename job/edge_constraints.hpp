// SPDX-License-Identifier: GPL-3.0-or-later
// From the edges that a user names, or that nets made before fold and cut, to constraints for edges of the
// surface that is unfolded.
#pragma once

#include <string>
#include <vector>

#include "base/context.hpp"
#include "job/options.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/edge_constraints.hpp"

namespace ridgecraft::job {

/// Edges that a user names, or that the model's file marks, are those of the model as it is in its file: it
/// isn't simplified unless that was asked for with a number, or nets made before were simplified and no edge
/// is named. Marks are dropped where nets made before decide,
/// and where they stand at most of the edges: such a file means something else by them. Notes say what wasn't
/// asked for. Throws Error(unreadable_input) where an edge is named by a point that the model doesn't have.
void apply_edge_requests(const EdgeRequests& edges, mesh::Model& model, prepare::SimplifyOptions& simplify,
                         std::vector<std::string>& notes);

/// Edges that are named belong to one size: where the user asked for none it is that of nets made before, or
/// the usual one.
void use_size_of_nets(const EdgeRequests& edges, const mesh::Model& model, prepare::SizeOptions& size);

/// Whether bodies are to be united: as nets made before say, where there are any.
[[nodiscard]] prepare::Bodies bodies_for(const EdgeRequests& edges, prepare::Bodies wanted);
/// Whether what stands on flat faces is parted from them, the same way.
[[nodiscard]] bool parts_standing_for(const EdgeRequests& edges, bool wanted);
/// What becomes of thin walls, the same way.
[[nodiscard]] prepare::Skins skins_for(const EdgeRequests& edges, prepare::Skins wanted);

/// What is wanted of each edge of the prepared surface; empty where nothing is. What couldn't be matched is
/// noted. Throws Error(unreadable_input) for nets that can't be read, Error(unusable_mesh) for nets of
/// another model.
[[nodiscard]] unfold::EdgeConstraints constraints_of(const EdgeRequests& edges,
                                                     const prepare::Prepared& prepared,
                                                     const Context& context, std::vector<std::string>& notes);

}  // namespace ridgecraft::job
