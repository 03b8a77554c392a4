// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/edge_options.hpp"

#include <fmt/format.h>

#include "cli/arguments/option_values.hpp"

namespace ridgecraft::cli {

void add_edge_options(Verb& verb, EdgeArguments& edges) {
  verb.option("Pieces", "--cuts", edges.cuts, "FILE",
              "Edges to cut: two point numbers a line, counted as in the model's file (OBJ: from 1, others: "
              "from 0). Lines (l) of an OBJ and edges of a PLY file are cut, too.");
  verb.option("Pieces", "--keep", edges.keep, "FILE",
              "Edges not to cut, in the same way; an edge in both is cut.");
  verb.option(
      "Pieces", "--from", edges.from, "FILE",
      "Nets of the same model made before (.fold, or .pdo of Pepakura Designer), edited or not: their "
      "cuts and folds are kept. "
      "Results go elsewhere (-o), unless --overwrite lets them replace this file.");
}

void check_edge_options(const EdgeArguments& edges, const prepare::SimplifyOptions& simplify) {
  if ((!edges.cuts.empty() || !edges.keep.empty()) && simplify.mode == prepare::Simplification::count) {
    refuse(fmt::format(
        "{} names edges of the model as it is, and --faces {} would leave others: give one of the two",
        edges.cuts.empty() ? "--keep" : "--cuts", simplify.faces));
  }
}

}  // namespace ridgecraft::cli
