// SPDX-License-Identifier: GPL-3.0-or-later
// How files for machines are wanted: --preset, and what goes before it.
#pragma once

#include "cli/arguments/options.hpp"
#include "job/asked_options.hpp"

namespace ridgecraft::cli {

/// Sets the preset, with what options change of it, and how board folds. Throws Error(usage).
void set_machine(const job::AskedOptions& asked, PaperJob& job);

/// The sheet and margin where none were asked for by --paper and --margin: those of the machine. `paper`
/// has these already. Room for the beam, and none for furniture. Throws Error(usage).
void fit_to_machine(const job::AskedOptions& asked, const PaperJob& job, export_::Paper& paper);

}  // namespace ridgecraft::cli
