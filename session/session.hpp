// SPDX-License-Identifier: GPL-3.0-or-later
// A project in memory: a finished job, and what a person did to its nets by hand since. Read this header
// first. No files, no pages in a browser: whoever shows a project calls these.
//
//   Paper --open--> Project --apply--> Project or Refusal      Project --undo, redo--> Project
//   Project::now.fold is how a project is saved; Paper + these bytes --reopen--> Project or Refusal
//
// A project is a value and each function gives a new one, so what is refused or throws leaves nothing behind.
// Every state has passed the check of its FOLD file (verify/), as every job has. Equal jobs and equal edits
// give equal bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "job/job.hpp"
#include "session/edit.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::session {

/// Edits that are undone together, and the nets that they left.
struct Step {
  std::vector<Edit> edits;
  std::shared_ptr<const unfold::Nets> nets;  ///< never null; without joins and tabs, which follow from them
};

/// A job and its edits. Memory grows by some 100 bytes a face with each step; copies share them.
struct Project {
  std::shared_ptr<const job::Paper> start;  ///< never null; before the first edit
  std::vector<Step> steps;                  ///< those that were done, then those that were undone
  std::size_t done = 0;                     ///< how many of the steps
  job::Paper now;                           ///< with all that was done

  [[nodiscard]] bool can_undo() const { return done > 0; }
  [[nodiscard]] bool can_redo() const { return done < steps.size(); }
};

/// Why something isn't done.
struct Refusal {
  std::size_t edit = 0;       ///< which of those that were to be done together, from 0
  std::string why;            ///< a sentence for people, without its full stop
  std::vector<FaceId> faces;  ///< of the prepared surface, where to look; none where the edge isn't there
};

using Answer = std::variant<Project, Refusal>;

/// A project with steps that were done elsewhere before, and those that couldn't be done here.
struct Repeated {
  Project project;
  std::vector<std::size_t> left_out;  ///< which of the steps, from 0
};

/// A project without edits.
[[nodiscard]] Project open(job::Paper made);

/// Does all of the edits or none, as one step; what had been undone is forgotten. Throws Error(no_nets) where
/// the paper doesn't hold what comes out, Error(interrupted), and Error(internal) where the result fails its
/// check. Takes the time of unfold/changed_folds.hpp for each, and once that of tabs, layout and drawing.
[[nodiscard]] Answer apply(const Project& project, std::span<const Edit> edits, const Context& context);

/// Why apply() would refuse, but for tabs, whose room is known when they are made; none where it wouldn't.
/// Takes the time of unfold/changed_folds.hpp for each.
[[nodiscard]] std::optional<Refusal> why_not(const Project& project, std::span<const Edit> edits,
                                             const Context& context);

/// The project one step back or forth, with the bytes that it had there; as it is where there is no such
/// step. Takes the time of tabs, layout and drawing; there is nothing to draw where undo comes back to the
/// start.
[[nodiscard]] Project undo(const Project& project, const Context& context);
[[nodiscard]] Project redo(const Project& project, const Context& context);

/// The same job again with the edits that its saved FOLD file tells (setting `edits`), each step a step
/// again. Refused where the file tells of another model or other settings than the job. Throws
/// Error(unreadable_input) where the bytes are no such file or tell edits that aren't in form.
[[nodiscard]] Answer reopen(job::Paper made, const std::string& fold_file, const Context& context);

/// Another job with such steps, one after the other: perhaps the same model with other options. Steps that
/// would be refused are left out. Throws as apply(), and takes its time once for all.
[[nodiscard]] Repeated repeat(job::Paper made, std::span<const std::vector<Edit>> steps,
                              const Context& context);

}  // namespace ridgecraft::session
