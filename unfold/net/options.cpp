// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/options.hpp"

#include <algorithm>
#include <array>

namespace ridgecraft::unfold {
namespace {

struct Term {
  std::string_view name;
  double Weights::*weight;
};
constexpr std::array terms{Term{"seam", &Weights::seam},       Term{"bare", &Weights::bare},
                           Term{"slits", &Weights::slits},     Term{"mirror", &Weights::mirror},
                           Term{"open", &Weights::open},       Term{"borders", &Weights::borders},
                           Term{"compact", &Weights::compact}, Term{"outline", &Weights::outline},
                           Term{"thin", &Weights::thin},       Term{"pieces", &Weights::pieces},
                           Term{"parts", &Weights::parts},     Term{"small", &Weights::small},
                           Term{"panels", &Weights::panels}};

}  // namespace

PieceRules rules_of(PieceMode mode) {
  PieceRules rules;
  rules.mode = mode;
  switch (mode) {
    case PieceMode::few:
      rules.weights.pieces = 10000.0;
      rules.weights.parts = 0.0;
      rules.weights.panels = 0.0;
      // With a price of 20 a piece is worth so many overlaps that the search forgets where it began.
      rules.first_overlap_price = 2500.0;
      rules.trials_per_face = 2000.0;
      break;
    case PieceMode::parts:
      rules.max_panels = 80;
      break;
    case PieceMode::small:
      rules.max_panels = 24;
      rules.weights.pieces = 300.0;
      rules.weights.small = 800.0;
      break;
  }
  return rules;
}

PieceRules rules_of_single_parts() {
  PieceRules rules = rules_of(PieceMode::few);
  // However large the model is, nothing is worth a piece, nor a piece of two parts.
  rules.weights.pieces = 1e9;
  rules.weights.parts = 1e12;
  rules.first_overlap_price = 0.25 * rules.weights.pieces;
  return rules;
}

Options with_prices(const Options& options) {
  Options priced = options;
  if (options.tabs.on_all_edges()) {
    // 18 mm without a tab weigh as much as a piece: cuts for the rest then part fewer.
    constexpr double bare_with_all_tabs = 20.0;
    double& bare = priced.pieces.weights.bare;
    bare = std::max(bare, bare_with_all_tabs);
  }
  return priced;
}

double* weight_named(Weights& weights, std::string_view name) {
  const auto* const term =
      std::find_if(terms.begin(), terms.end(), [&](const Term& t) { return t.name == name; });
  return term == terms.end() ? nullptr : &(weights.*(term->weight));
}

std::span<const std::string_view> term_names() {
  static constexpr auto names = [] {
    std::array<std::string_view, terms.size()> all;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      all[i] = terms[i].name;
    }
    return all;
  }();
  return names;
}

}  // namespace ridgecraft::unfold
