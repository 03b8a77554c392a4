// SPDX-License-Identifier: GPL-3.0-or-later
// From finished paper to the bytes of each file that is made of it: printed, cut by a machine, built by its
// guide, or shown in a browser.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/files/targets.hpp"
#include "export/export.hpp"
#include "job/job.hpp"

namespace ridgecraft::cli {

/// What files are made of.
struct Sheets {
  const job::Paper& made;
  std::vector<paper::Drawing> drawings;  ///< of all pages, as they are drawn for the user's printer
  paper::Mark mark;
  std::vector<paper::Drawing>
      for_machine;  ///< of the pages with pieces; empty where no target is for a machine
};

/// `made` must outlive it.
[[nodiscard]] Sheets sheets_for(std::span<const Target> targets, const job::Paper& made, const PaperJob& job);

/// Pages of this kind; formats with a file per page have as many files.
[[nodiscard]] std::size_t page_count(const Target& target, const Sheets& sheets);

/// The bytes of file i of the target (files_of). `sheets` must be for this target, too.
[[nodiscard]] std::string file_bytes(const Target& target, std::size_t i, const Sheets& sheets,
                                     const PaperJob& job);

}  // namespace ridgecraft::cli
