// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/session.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "session/draft.hpp"

namespace ridgecraft::session {
namespace {

/// All steps, one a line, those first that the paper came with.
std::string text_of_steps(const Project& project) {
  std::string text = project.start->edits;
  for (const Step& step : project.steps) {
    text += (text.empty() ? "" : "\n") + text_of(step.edits);
  }
  return text;
}

/// The same steps with the paper that follows from them; pictures that its paper has are used
/// again.
Project with_paper(Project project, Context context) {
  if (project.steps.empty()) {
    project.now = *project.start;
    return project;
  }
  context.deadline.reset();
  context.give_up.reset();
  const State& state = project.state();
  job::Result start = *project.start;
  // The settings tell how high tabs are at most.
  std::vector<unfold::TabAt>& at = start.options.tab_choice.at;
  at.insert(at.end(), state.tabs.begin(), state.tabs.end());
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
  project.steps.push_back({{edits.begin(), edits.end()}, std::get<State>(std::move(after))});
  return std::nullopt;
}

/// Its steps without the paper, which is made anew, but for pictures.
Project steps_alone(const Project& project) {
  Project alone{project.start, project.first, project.steps, {}};
  alone.now.drawn.pictures = project.now.drawn.pictures;
  return alone;
}

}  // namespace

Project open(job::Result made) {
  Project project;
  project.start = std::make_shared<const job::Result>(std::move(made));
  const job::Result& start = *project.start;
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

std::optional<Place> nearby_place(const Project& project, const Place& held, const Context& context,
                                  double reach_mm) {
  const State& state = project.state();
  if (!state.pages || held.face.value() >= state.nets->piece.size() || held.page > state.pages->count) {
    return std::nullopt;
  }
  std::optional<Place> found = place_near(state, held, reach_mm);
  if (found) {
    const Edit edit = *found;
    // Pinned, or among pieces of another colour.
    if (why_not(project, {&edit, 1}, context)) {
      return std::nullopt;
    }
  }
  return found;
}

Project undo(const Project& project, const Context& context, std::size_t steps) {
  if (!project.can_undo() || steps == 0) {
    return project;
  }
  Project back = steps_alone(project);
  back.steps.resize(back.steps.size() - std::min(steps, back.steps.size()));
  return with_paper(std::move(back), context);
}

Repeated repeat(job::Result made, std::span<const std::vector<Edit>> steps, const Context& context) {
  Repeated repeated;
  Project project = open(std::move(made));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    std::vector<Edit> edits = steps[i];
    std::optional<Refusal> refusal = add_step(project, edits, context);
    if (const auto* const place = edits.size() == 1 ? std::get_if<Place>(&edits.front()) : nullptr;
        refusal && place != nullptr) {
      if (const auto nearby = nearby_place(project, *place, context)) {
        edits.front() = *nearby;
        refusal = add_step(project, edits, context);
      }
    }
    if (refusal) {
      repeated.left_out.push_back(i);
    }
  }
  repeated.project = with_paper(std::move(project), context);
  return repeated;
}

}  // namespace ridgecraft::session
