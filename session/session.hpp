// SPDX-License-Identifier: GPL-3.0-or-later
// A project in memory: a finished job, and what a person did to its nets by hand since. Read this header
// first. No files, no pages in a browser: whoever shows a project calls these.
//
//   Result --open--> Project --apply--> Project or Refusal      Project --undo--> Project
//   Project::now.fold is how a project is saved; Result + its edits --repeat--> Project
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
#include "job/job.hpp"
#include "session/edit.hpp"

namespace ridgecraft::session {

/// Edits that are undone together, and where they left the project.
struct Step {
  std::vector<Edit> edits;
  State after;
};

/// A job and its edits. Memory grows by some 300 bytes a face with each step; copies share them.
struct Project {
  std::shared_ptr<const job::Result> start;  ///< never null; before the first edit
  State first;                               ///< the same
  std::vector<Step> steps;
  job::Result now;  ///< after all steps

  [[nodiscard]] bool can_undo() const { return !steps.empty(); }
  /// Of `now`.
  [[nodiscard]] const State& state() const { return steps.empty() ? first : steps.back().after; }
};

using Answer = std::variant<Project, Refusal>;

/// A project with steps that were done elsewhere before, and those that couldn't be done here.
struct Repeated {
  Project project;
  std::vector<std::size_t> left_out;  ///< which of the steps, from 0
};

/// A project without edits.
[[nodiscard]] Project open(job::Result made);

/// Does all of the edits or none, as one step. Pieces that it doesn't
/// change stay where they lie; the others stay, too, where there is room, or are placed around them. Throws
/// Error(interrupted), and Error(internal) where the result fails its check. The context's deadline is
/// ignored, here and below. Takes the time of unfold/edits.hpp for each edit, and once that of tabs,
/// places and drawing; tabs are kept where only places change.
[[nodiscard]] Answer apply(const Project& project, std::span<const Edit> edits, const Context& context);

/// Why apply() would refuse; none where it wouldn't. Where nets or tabs change, room for tabs and on pages is
/// left out, which are known when they are made. Takes the time of apply() without tabs and drawing.
[[nodiscard]] std::optional<Refusal> why_not(const Project& project, std::span<const Edit> edits,
                                             const Context& context);

/// As far as anybody would take for what they meant.
inline constexpr double nearby_mm = 15.0;

/// Where a piece can be laid that somebody holds where apply() would refuse it, turned as it is held: the
/// nearest place on its page where it lies on the sheet and keeps its distance to the others; none within
/// `reach_mm`. Takes the time of why_not().
[[nodiscard]] std::optional<Place> nearby_place(const Project& project, const Place& held,
                                                const Context& context, double reach_mm = nearby_mm);

/// The project without its last steps, with the bytes that it had then; without any where it has fewer. Takes
/// the time of drawing; there is nothing to draw where it comes back to the start, or stays.
[[nodiscard]] Project undo(const Project& project, const Context& context, std::size_t steps = 1);

/// Another job with such steps, one after the other: the same job, whose saved FOLD file has the steps in its
/// setting `edits`, or the same model with other options. Steps that would be refused are left out, but a
/// piece without room where it was laid lies as near as it can, where that is within nearby_mm. Throws as
/// apply(), and takes its time but for drawing, which is done once.
[[nodiscard]] Repeated repeat(job::Result made, std::span<const std::vector<Edit>> steps,
                              const Context& context);

}  // namespace ridgecraft::session
