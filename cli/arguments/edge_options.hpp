// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept together: --cuts, --keep, --from.
#pragma once

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::cli {

/// Adds the three options to a verb.
void add_edge_options(Verb& verb, EdgeArguments& edges);

/// Throws Error(usage) where edges are named of a model that is to be simplified to a number of faces: it
/// would have others.
void check_edge_options(const EdgeArguments& edges, const prepare::SimplifyOptions& simplify);

}  // namespace ridgecraft::cli
