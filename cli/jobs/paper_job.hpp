// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft MODEL, and ridgecraft unfold: files in, files out, around job/.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/files/pending_files.hpp"
#include "cli/files/targets.hpp"
#include "job/job.hpp"

namespace ridgecraft::cli {

struct PaperResult {
  job::Paper made;
  std::vector<std::string> files;       ///< that were written
  std::vector<Shows> shows;             ///< of each of these
  std::vector<std::string> file_notes;  ///< PendingFiles::commit
  job::StageSeconds seconds;            ///< reading and writing included
};

/// Whether the guide is one of the job's files: a machine needs none.
[[nodiscard]] bool wants_guide(const PaperJob& job);

/// Reads, makes the paper and writes. Files appear only when all of them are complete. Throws Error. The
/// listener is told what a user may want to stop for before the long work is done: hundreds of pages.
[[nodiscard]] PaperResult make_paper(const PaperJob& job, const Context& context, PendingFiles& pending,
                                     const job::Listener& listener);

/// The same, but nothing is written (paper_files.hpp tells what the files would hold), and no guide is
/// drawn: job::guide_of() does that.
[[nodiscard]] PaperResult make_pages(const PaperJob& job, const Context& context,
                                     const job::Listener& listener);

/// The same without pages: one file of nets, or none.
[[nodiscard]] PaperResult make_nets(const UnfoldJob& job, const Context& context, PendingFiles& pending);

}  // namespace ridgecraft::cli
