// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/piece_options.hpp"

#include <string_view>

#include "base/sentence.hpp"
#include "cli/arguments/option_values.hpp"
#include "unfold/net/piece_rules.hpp"

namespace ridgecraft::cli {
namespace {

std::string all_terms() {
  const auto names = unfold::term_names();
  return listed({names.begin(), names.end()}, "or");
}

}  // namespace

void PieceTexts::add_to(Verb& verb) {
  verb.option(
      "Pieces", "--pieces", mode, "few|parts|small",
      "few: as few pieces as paper and overlap allow; parts: those of the model, crumbs joined to their "
      "neighbours; small: small ones (parts).");
  verb.option("Pieces", "--max-faces", max_faces, "N|any",
              "Most flat faces of one piece (few: any, parts: 80, small: 24).");
  verb.list(
      "Pieces", "--weigh", weights, "TERM=WEIGHT",
      "How much a property of nets counts when the best ones are chosen, in mm of seam. May be given for "
      "several terms:\n"
      "seam=1: a mm of seam to glue;\n"
      "bare=2: a mm of seam without room for a tab;\n"
      "slits=2: a mm of seam that hardly opens;\n"
      "mirror=1.5: a mm of seam whose mirror image is none;\n"
      "bands=1: a mm of seam across a strip that goes round, beyond its first seam;\n"
      "open=0.1: a mm of seam on smooth places;\n"
      "borders=0.7: a mm of fold where colours, materials or objects of the model meet;\n"
      "compact=4: a cm2 inside a piece's hull that is no paper;\n"
      "outline=0.5: the square of a piece's outline, over 1000 mm;\n"
      "thin=0.5: a mm by which what hangs on a neck is wider than three times the neck;\n"
      "pieces=350: a piece;\n"
      "parts=200: a further part in a piece;\n"
      "small=1200: a piece under 30 mm;\n"
      "panels=800: the square of a piece's flat faces, over 80.");
}

unfold::PieceRules PieceTexts::rules() const {
  unfold::PieceRules rules;
  if (mode == "few") {
    rules = unfold::rules_of(unfold::PieceMode::few);
  } else if (mode == "parts") {
    rules = unfold::rules_of(unfold::PieceMode::parts);
  } else if (mode == "small") {
    rules = unfold::rules_of(unfold::PieceMode::small);
  } else {
    refuse("--pieces takes few, parts or small, not '" + mode + "'");
  }
  if (max_faces == "any") {
    rules.max_panels = 0;
  } else if (!max_faces.empty()) {
    rules.max_panels = whole_number_or_refuse("--max-faces", max_faces, 1);
  }
  for (const std::string& text : weights) {
    const std::size_t equals = text.find('=');
    double* const weight = unfold::weight_named(rules.weights, std::string_view(text).substr(0, equals));
    if (equals == std::string::npos || weight == nullptr) {
      refuse("--weigh takes a term and its weight, such as pieces=10; the terms are " + all_terms() +
             ", not '" + text + "'");
    }
    *weight = number_or_refuse("--weigh " + text.substr(0, equals), text.substr(equals + 1), 0.0, 1e6);
  }
  return rules;
}

}  // namespace ridgecraft::cli
