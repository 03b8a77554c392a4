// SPDX-License-Identifier: GPL-3.0-or-later
// From a model to the files of its nets: printed, cut by a machine, built by a guide, shown in a browser.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/files/pending_files.hpp"
#include "cli/files/targets.hpp"
#include "export/export.hpp"
#include "job/job.hpp"

namespace ridgecraft::cli {

/// What files are made of.
struct Sheets {
  const job::Result& made;
  std::vector<export_::Drawing> drawings;  ///< of all pages, as they are drawn for the user's printer
  export_::Mark mark;
  std::vector<export_::Drawing>
      for_machine;  ///< of the pages with pieces; empty where no target is for a machine
};

/// `made` must outlive it.
[[nodiscard]] Sheets sheets_for(std::span<const Target> targets, const job::Result& made, const MakeJob& job);

/// Pages of this kind; formats with a file per page have as many files.
[[nodiscard]] std::size_t page_count(const Target& target, const Sheets& sheets);

/// The bytes of file i of the target (files_of). `sheets` must be for this target, too.
[[nodiscard]] std::string file_bytes(const Target& target, std::size_t i, const Sheets& sheets,
                                     const MakeJob& job);

struct MakeResult {
  job::Result made;
  std::vector<std::string> files;       ///< that were written
  std::vector<Shows> shows;             ///< of each of these
  std::vector<std::string> file_notes;  ///< PendingFiles::commit
  job::StageSeconds seconds;            ///< reading and writing included
};

/// Whether the guide is one of the job's files: a machine needs none.
[[nodiscard]] bool wants_guide(const MakeJob& job);

/// Reads, makes the paper and writes. Files appear only when all of them are complete. Throws Error. The
/// listener is told what a user may want to stop for before the long work is done: hundreds of pages.
[[nodiscard]] MakeResult make_files(const MakeJob& job, const Context& context, PendingFiles& pending,
                                    const job::Listener& listener);

/// The same, but nothing is written (paper_files.hpp tells what the files would hold), and no guide is
/// drawn: job::guide_of() does that.
[[nodiscard]] MakeResult make_pages(const MakeJob& job, const Context& context,
                                    const job::Listener& listener);

/// The same without pages: one file of nets, or none.
[[nodiscard]] MakeResult make_nets(const UnfoldJob& job, const Context& context, PendingFiles& pending);

}  // namespace ridgecraft::cli
