// SPDX-License-Identifier: GPL-3.0-or-later
// Where the values of options stand in job::Options: what is read into them, and noted of them in nets.
#pragma once

#include "export/export.hpp"
#include "job/asked_options.hpp"
#include "job/options.hpp"

namespace ridgecraft::job {

/// `usual`, with what was asked; without pages where `usual` has no paper. Files that options name aren't
/// read. Throws Error(usage).
[[nodiscard]] Options options_of(AskedOptions asked, Options usual);

/// Adds the settings of options whose value stands in one place; those of others are settings_of()'s.
void note_fields(Options& options, export_::Settings& settings);

}  // namespace ridgecraft::job
