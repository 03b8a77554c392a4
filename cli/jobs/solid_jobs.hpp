// SPDX-License-Identifier: GPL-3.0-or-later
// The jobs of the verbs hulls, cage, shell and deform.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/files/pending_files.hpp"
#include "job/stage_clock.hpp"
#include "mesh/mesh.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::cli {

struct SolidResult {
  mesh::Model model;
  std::size_t parts = 0;            ///< 0 where nothing was segmented
  std::vector<solid::Body> bodies;  ///< what was written
  std::optional<solid::Fit> fit;    ///< of hulls
  std::vector<Message> notes;
  std::vector<std::string> files;
  std::vector<std::string> file_notes;  ///< PendingFiles::commit
  job::StageClock clock;
};

// Each reads, computes, checks and writes; files appear only when all are complete. Throw Error.

[[nodiscard]] SolidResult make_hulls(const HullsJob& job, const Context& context, PendingFiles& pending);
[[nodiscard]] SolidResult make_cage(const CageJob& job, const Context& context, PendingFiles& pending);
[[nodiscard]] SolidResult make_shell(const ShellJob& job, const Context& context, PendingFiles& pending);
[[nodiscard]] SolidResult make_deformed(const DeformJob& job, const Context& context, PendingFiles& pending);

}  // namespace ridgecraft::cli
