// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that a user wants cut or kept together: --cuts, --keep, --from.
#pragma once

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"

namespace ridgecraft::cli {

/// Adds the three options to a verb.
void add_edge_options(Verb& verb, EdgeArguments& edges);

}  // namespace ridgecraft::cli
