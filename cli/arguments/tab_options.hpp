// SPDX-License-Identifier: GPL-3.0-or-later
// How the main job's glue tabs are chosen.
#pragma once

#include <string>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"

namespace ridgecraft::cli {

/// Options as typed.
struct TabTexts {
  std::string sides, height, angle;
  bool none = false;
  bool all = false;
  bool borders = false;
  bool shadows = false;

  void add_to(Verb& verb, PaperJob& job);
  /// Throws Error(usage).
  void check_into(PaperJob& job) const;
};

}  // namespace ridgecraft::cli
