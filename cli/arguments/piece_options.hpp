// SPDX-License-Identifier: GPL-3.0-or-later
// How the pieces are wanted: --pieces, --max-faces, --weigh.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/verb.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::cli {

/// The values as typed; `rules` after they were checked.
struct PieceTexts {
  std::string mode = "parts";
  std::string max_faces;
  std::vector<std::string> weights;

  void add_to(Verb& verb);
  /// Throws Error(usage).
  [[nodiscard]] unfold::PieceRules rules() const;
};

}  // namespace ridgecraft::cli
