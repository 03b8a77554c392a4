// SPDX-License-Identifier: GPL-3.0-or-later
// How a model is divided into parts: the options of every verb that uses parts for something else than paper.
#pragma once

#include <string>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"

namespace ridgecraft::cli {

/// The options as typed.
struct PartTexts {
  segment::Options options;  ///< flags
  std::string concavity, count, effort, volume_weight, holes, components, reading;

  void add_to(Verb& verb);
  [[nodiscard]] PartArguments checked() const;
};

}  // namespace ridgecraft::cli
