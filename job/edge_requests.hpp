// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user names, and nets made before: which edges of the prepared surface are to be cut or kept,
// and what the stages before take over from those nets.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/context.hpp"
#include "base/message.hpp"
#include "job/options.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::job {

// The two kinds of files that nets made before come in.

/// Whether it is to be read as a FOLD file; else it is a model's file that holds nets.
[[nodiscard]] bool is_fold_file(const OldNets& old);

/// Throws Error(unreadable_input) with the file's name. O(n log n).
[[nodiscard]] verify::File read_fold_file(const OldNets& old);

/// Which names of their model the nets of a FOLD file were made of; all, where the bytes are no such file.
/// O(n).
[[nodiscard]] prepare::Selection selection_of(std::string_view fold_file);

// The surface that nets made before were unfolded from, where the model had been simplified for them.

struct ModelOfNets {
  mesh::Model model;                  ///< with the nets' faces, in the unit of the model's file
  prepare::SimplifyOptions simplify;  ///< what they were simplified by
};

/// How nets of our own were simplified, as their settings say; nothing where they are another program's, or
/// the model was kept as it is.
[[nodiscard]] std::optional<prepare::SimplifyOptions> simplified_by(const OldNets& old);

/// The model that nets of our own hold: they must bear the model's digest, and have other points than it has.
/// Its faces have neither materials nor texture. Nothing where there is no such model. O(n log n). Throws
/// Error(unreadable_input) for a file that can't be read.
[[nodiscard]] std::optional<ModelOfNets> model_of_nets(const OldNets& old, const mesh::Model& model,
                                                       const Context& context);

// From the edges that a user names, or that nets made before fold and cut, to constraints for edges of the
// surface that is unfolded.

/// Edges that a user names, or that the model's file marks, are those of the model as it is in its file: it
/// isn't simplified unless that was asked for with a number, or nets made before were simplified and no edge
/// is named. Marks are dropped where nets made before decide,
/// and where they stand at most of the edges: such a file means something else by them. Notes say what wasn't
/// asked for. Throws Error(unreadable_input) where an edge is named by a point that the model doesn't have.
void apply_edge_requests(const EdgeRequests& edges, mesh::Model& model, prepare::SimplifyOptions& simplify,
                         std::vector<Message>& notes);

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
                                                     const Context& context, std::vector<Message>& notes);

}  // namespace ridgecraft::job
