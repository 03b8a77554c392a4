// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/session.hpp"

#include <optional>
#include <utility>

#include "job/old_nets.hpp"
#include "session/draft.hpp"
#include "session/places.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::session {
namespace {

/// All steps that were done, one a line, those first that the paper came with.
std::string text_of_steps(const Project& project) {
  std::string text = project.start->edits;
  for (std::size_t i = 0; i < project.done; ++i) {
    text += (text.empty() ? "" : "\n") + text_of(project.steps[i].edits);
  }
  return text;
}

/// Whether two files tell of one job but for edits: the same model and the same settings give the same nets.
bool of_one_job(const verify::File& a, const verify::File& b) {
  const auto but_for_edits = [](const verify::File& file) {
    auto settings = file.settings.all;
    std::erase_if(settings, [](const auto& setting) { return setting.first == "edits"; });
    return settings;
  };
  return a.digest == b.digest && but_for_edits(a) == but_for_edits(b);
}

/// The same steps with the paper that follows from those that are done; pictures that its paper has are used
/// again.
Project with_paper(Project project, Context context) {
  if (project.done == 0) {
    project.now = *project.start;
    return project;
  }
  context.deadline.reset();
  context.give_up.reset();
  const State& state = project.state();
  job::Paper start = *project.start;
  if (project.now.drawn.pictures) {
    start.drawn.pictures = project.now.drawn.pictures;
  }
  project.now =
      job::with_nets(std::move(start), *state.nets, state.pages ? std::optional(*state.pages) : std::nullopt,
                     text_of_steps(project), context);
  return project;
}

/// Does a step but for the paper that follows, or says why not.
std::optional<Refusal> add_step(Project& project, std::span<const Edit> edits, const Context& context) {
  Draft draft(*project.start, project.state(), context);
  if (std::optional<Refusal> refused = draft.change(edits)) {
    return refused;
  }
  std::variant<State, Refusal> after = draft.finish();
  if (auto* const refused = std::get_if<Refusal>(&after)) {
    return std::move(*refused);
  }
  project.steps.resize(project.done);
  project.steps.push_back({{edits.begin(), edits.end()}, std::get<State>(std::move(after))});
  ++project.done;
  return std::nullopt;
}

/// Its steps without the paper, which is made anew, but for pictures.
Project steps_alone(const Project& project) {
  Project alone{project.start, project.first, project.steps, project.done, {}};
  alone.now.drawn.pictures = project.now.drawn.pictures;
  return alone;
}

}  // namespace

Project open(job::Paper made) {
  Project project;
  project.start = std::make_shared<const job::Paper>(std::move(made));
  const job::Paper& start = *project.start;
  project.first.nets = {project.start, &start.nets};
  if (start.options.paper && !start.nets_of_board) {
    project.first.pages = {project.start, &start.pages};
  }
  project.now = start;
  return project;
}

Answer apply(const Project& project, std::span<const Edit> edits, const Context& context) {
  if (edits.empty()) {
    return project;
  }
  Project changed = steps_alone(project);
  if (std::optional<Refusal> refusal = add_step(changed, edits, context)) {
    return std::move(*refusal);
  }
  return with_paper(std::move(changed), context);
}

std::optional<Refusal> why_not(const Project& project, std::span<const Edit> edits, const Context& context) {
  Draft draft(*project.start, project.state(), context);
  if (std::optional<Refusal> refused = draft.change(edits); refused || !draft.nets_stay()) {
    return refused;
  }
  std::variant<State, Refusal> after = draft.finish();
  auto* const refused = std::get_if<Refusal>(&after);
  return refused == nullptr ? std::nullopt : std::optional(std::move(*refused));
}

std::optional<Place> nearby_place(const Project& project, const Place& held, const Context& context) {
  const State& state = project.state();
  if (!state.pages || held.face.value() >= state.nets->piece.size() || held.page > state.pages->count) {
    return std::nullopt;
  }
  std::optional<Place> found = place_near(state, held, nearby_mm);
  if (found) {
    const Edit edit = *found;
    // Pinned, or among pieces of another colour.
    if (why_not(project, {&edit, 1}, context)) {
      return std::nullopt;
    }
  }
  return found;
}

Project undo(const Project& project, const Context& context) {
  if (!project.can_undo()) {
    return project;
  }
  Project back = steps_alone(project);
  --back.done;
  return with_paper(std::move(back), context);
}

Project redo(const Project& project, const Context& context) {
  if (!project.can_redo()) {
    return project;
  }
  Project forth = steps_alone(project);
  ++forth.done;
  return with_paper(std::move(forth), context);
}

Answer reopen(job::Paper made, const std::string& fold_file, const Context& context) {
  const verify::File saved = job::read_fold_file({"the saved project", fold_file});
  if (!of_one_job(saved, job::read_fold_file({"the job", made.fold}))) {
    return Refusal{0, "the file was saved from another model, or made with other options", {}};
  }
  const verify::Setting* const setting = saved.settings.find("edits");
  const auto* const text = setting == nullptr ? nullptr : std::get_if<std::string>(setting);
  Project project = open(std::move(made));
  for (const std::vector<Edit>& step : text == nullptr ? std::vector<std::vector<Edit>>{} : steps_of(*text)) {
    if (std::optional<Refusal> refusal = add_step(project, step, context)) {
      return std::move(*refusal);
    }
  }
  return with_paper(std::move(project), context);
}

Repeated repeat(job::Paper made, std::span<const std::vector<Edit>> steps, const Context& context) {
  Repeated repeated;
  Project project = open(std::move(made));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (add_step(project, steps[i], context)) {
      repeated.left_out.push_back(i);
    }
  }
  repeated.project = with_paper(std::move(project), context);
  return repeated;
}

}  // namespace ridgecraft::session
