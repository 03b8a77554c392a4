// SPDX-License-Identifier: GPL-3.0-or-later
// How the pieces are wanted: --pieces, --max-faces, --weigh, --fold-linear.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments/verb.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::cli {

/// What --fold-linear does, for --help.
inline constexpr std::string_view fold_linear_text =
    "For sheets that fold themselves: every piece folds up with all creases moving together and no face "
    "running through another; pieces are split where no net does.";

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
