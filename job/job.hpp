// SPDX-License-Identifier: GPL-3.0-or-later
// A whole job as a function of values: a model goes in, its result comes out, without files or a terminal.
// Read this header first. The command line, other programs and tests all call this and nothing else.
//
//   Model + Options --run--> Result        Result + TabOptions --with_tabs--> Result (same folds and cuts)
//                                          Result + Nets       --tabbed, with_nets--> Result (same surface)
//                                          Result + Paper      --with_pages--> Result (same nets)
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/context.hpp"
#include "base/message.hpp"
#include "export/export.hpp"
#include "job/options.hpp"
#include "job/remark.hpp"
#include "job/result.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::job {

using prepare::sliver_mm;

/// In the words of session/edit.hpp.
inline constexpr std::string_view laid_out_anew = "pack";

/// Prepares, segments, unfolds, lays out, draws and checks. Deterministic for one seed, whatever the number
/// of threads. Where the context's deadline passes, searches end with the best they have, and where it passes
/// in the first half of segmentation's time, each component is one part (Result::parts_given_up). Throws
/// Error(unusable_mesh), Error(no_nets), Error(unreadable_input) for nets made before that aren't in form
/// and for edges named by points that the model doesn't have, Error(unbuildable) where Options::strict asks
/// for it, Error(out_of_time) where the deadline passes while there is nothing yet, Error(interrupted), and
/// Error(internal) where the result fails its check, and so do those that take its place: a note says where
/// one does (job/next_best.hpp). What takes time is named with each stage
/// (docs/design/architecture.md).
[[nodiscard]] Result run(mesh::Model model, const Options& options, const Context& context,
                         const Listener& listener = {});

/// The guide of a job with pages that was finished without it (Options::guide), for whoever may not need it:
/// drawing it takes longer than drawing all pages. Throws Error(interrupted).
[[nodiscard]] export_::Guide guide_of(const Result& made, const Context& context);

/// The same nets with other tabs; they stay as they are but for these, also where another shape would have
/// led the search to other folds, and no piece is split (TabOptions::split_pieces stays as it was). Their
/// pages are laid out anew, since tabs take room. What the nets were searched with stays in the settings of
/// the file (docs/reference/formats.md), whatever this context's seed.
[[nodiscard]] Result with_tabs(Result made, const unfold::TabOptions& tabs, const Context& context);

/// Other nets of the same surface, such as a person has made of these edge by edge
/// (unfold/edits.hpp), with joins, tabs as `choice` asks for them, kinds of equal pieces, and the
/// notes of the stages before. Throws Error(interrupted), and Error(unreadable_input) where the choice names
/// an edge that isn't there.
[[nodiscard]] unfold::Nets tabbed(const Result& made, unfold::Nets nets, const unfold::TabChoice& choice,
                                  const Context& context);

/// The job with these nets, which are finished: tabbed(), or others with all that they have. Assembly and all
/// that follows are made anew. `pages`: where the nets lie (job/page_layout.hpp); none: they are laid out,
/// too, and so are nets of board. `edits` tells what was done, one step a line; told nothing, nothing was.
/// Throws as run(), but for what concerns the model.
[[nodiscard]] Result with_nets(Result made, unfold::Nets nets, std::optional<export_::Pages> pages,
                               std::string edits, const Context& context);

/// The same nets on other paper, or drawn in another style; colours only where they were wanted (Style::ink)
/// when the job began. Throws Error(no_nets) where a piece is larger
/// than it.
[[nodiscard]] Result with_pages(Result made, const export_::Paper& paper, const export_::Style& style,
                                const Context& context);

}  // namespace ridgecraft::job
