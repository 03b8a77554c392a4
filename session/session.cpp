// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/session.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "job/old_nets.hpp"
#include "job/page_labels.hpp"
#include "unfold/changed_folds.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::session {
namespace {

/// None where the surface has no such edge.
std::optional<EdgeId> edge_of(const mesh::Surface& surface, const Edge& edge) {
  if (edge.from.value() >= surface.vertex_count()) {
    return std::nullopt;
  }
  for (const CornerId c : surface.corners_at(edge.from)) {
    if (surface.vertex(mesh::next(c)) == edge.to) {
      return surface.edge(c);
    }
    if (surface.vertex(mesh::previous(c)) == edge.to) {
      return surface.edge(mesh::previous(c));
    }
  }
  return std::nullopt;
}

/// What a piece has to keep to.
unfold::Options rules_of(const job::Options& options) {
  unfold::Options rules;
  if (options.paper) {
    const Vec2 area = paper::piece_area(*options.paper);
    rules.sheet = unfold::Sheet{area.x, area.y};
  }
  rules.pieces = options.pieces;
  return rules;
}

/// One edit after the other on the nets of one job.
class Editor {
 public:
  Editor(const job::Paper& made, const Context& context)
      : made_(made),
        surface_(made.prepared.model.surface),
        rules_(rules_of(made.options)),
        labels_(job::page_labels(made.prepared.model, made.options.page_by)),
        context_(context) {}

  [[nodiscard]] unfold::ChangedNets changed(const unfold::Nets& nets, const Edit& edit) const {
    const std::optional<EdgeId> edge =
        edge_of(surface_, std::visit([](const auto& e) { return e.edge; }, edit));
    if (!edge) {
      return unfold::Refusal{"the model has no such edge", {}};
    }
    if (std::holds_alternative<TabFrom>(edit) || std::holds_alternative<NoTab>(edit)) {
      return with_tab(nets, *edge);
    }
    if (std::holds_alternative<Cut>(edit)) {
      return unfold::cut_fold(surface_, made_.prepared.panels, made_.part, nets, *edge, context_);
    }
    if (parts_colours(*edge)) {
      return unfold::Refusal{"the faces beside this edge belong on different pages", faces_at(*edge)};
    }
    return unfold::join_cut(surface_, made_.prepared.panels, made_.part, rules_, nets, *edge, context_);
  }

 private:
  /// The same nets, whose tab will follow, where there can be one.
  [[nodiscard]] unfold::ChangedNets with_tab(const unfold::Nets& nets, EdgeId edge) const {
    if (!made_.options.tabs.wanted) {
      return unfold::Refusal{"these nets are made without tabs", faces_at(edge)};
    }
    if (nets.use[edge] != unfold::EdgeUse::cut) {
      return unfold::Refusal{"only an edge that is glued has a tab", faces_at(edge)};
    }
    return nets;
  }

  [[nodiscard]] std::vector<FaceId> faces_at(EdgeId edge) const {
    const auto [c, d] = surface_.sides(edge);
    std::vector<FaceId> faces{mesh::face_of(c)};
    if (d.valid()) {
      faces.push_back(mesh::face_of(d));
    }
    return faces;
  }

  /// Whether paper of another colour begins at an edge.
  [[nodiscard]] bool parts_colours(EdgeId edge) const {
    const auto [c, d] = surface_.sides(edge);
    return labels_.any() && d.valid() &&
           labels_.of_face[mesh::face_of(c)] != labels_.of_face[mesh::face_of(d)];
  }

  const job::Paper& made_;
  const mesh::Surface& surface_;
  unfold::Options rules_;
  job::PageLabels labels_;
  const Context& context_;
};

/// The nets before the next step.
const unfold::Nets& nets_of(const Project& project) {
  return project.done == 0 ? project.start->nets : *project.steps[project.done - 1].nets;
}

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

/// What an edit asks of the tab at its edge; none where it asks nothing.
std::optional<unfold::TabAt> tab_of(const mesh::Surface& surface, const Edit& edit) {
  const auto* const from = std::get_if<TabFrom>(&edit);
  const auto* const none = std::get_if<NoTab>(&edit);
  if (from == nullptr && none == nullptr) {
    return std::nullopt;
  }
  const Edge& named = from == nullptr ? none->edge : from->edge;
  const EdgeId edge = edge_of(surface, named).value();
  const bool first = surface.vertex(surface.sides(edge)[0]) == named.from;
  return unfold::TabAt{edge, from != nullptr, static_cast<std::uint8_t>(first ? 0 : 1)};
}

/// The same steps with the paper that follows from those that are done.
Project with_paper(Project project, const Context& context) {
  if (project.done == 0) {
    project.now = *project.start;
    return project;
  }
  job::Paper before = *project.start;
  for (std::size_t i = 0; i < project.done; ++i) {
    for (const Edit& edit : project.steps[i].edits) {
      if (const auto tab = tab_of(before.prepared.model.surface, edit)) {
        before.options.tab_choice.at.push_back(*tab);
      }
    }
  }
  project.now = job::with_nets(std::move(before), nets_of(project), text_of_steps(project), context);
  project.now.options.tab_choice.at = project.start->options.tab_choice.at;
  return project;
}

/// Which edit of the last step asked for a tab for which there is no room; none where all got theirs.
std::optional<Refusal> missing_tab(const Project& project) {
  const mesh::Surface& surface = project.now.prepared.model.surface;
  const unfold::Nets& nets = project.now.nets;
  const std::vector<Edit>& edits = project.steps[project.done - 1].edits;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const auto tab = tab_of(surface, edits[i]);
    if (!tab || !tab->wanted) {
      continue;
    }
    const auto join = std::find_if(nets.joins.begin(), nets.joins.end(),
                                   [&](const unfold::Join& j) { return j.edge == tab->edge; });
    const CornerId side = surface.sides(tab->edge)[tab->side];
    if (join != nets.joins.end() && (!join->tab.valid() || nets.tabs[join->tab].side != side)) {
      return Refusal{i, "there is no room for a usable tab on this side", {mesh::face_of(side)}};
    }
  }
  return std::nullopt;
}

/// The nets that edits leave, or why not.
std::variant<unfold::Nets, Refusal> nets_after(const Project& project, std::span<const Edit> edits,
                                               const Context& context) {
  const Editor editor(*project.start, context);
  unfold::Nets nets = nets_of(project);
  for (std::size_t i = 0; i < edits.size(); ++i) {
    unfold::ChangedNets changed = editor.changed(nets, edits[i]);
    if (auto* const refusal = std::get_if<unfold::Refusal>(&changed)) {
      return Refusal{i, std::move(refusal->why), std::move(refusal->faces)};
    }
    nets = std::get<unfold::Nets>(std::move(changed));
  }
  return nets;
}

/// Does a step but for the paper that follows, or says why not.
std::optional<Refusal> add_step(Project& project, std::span<const Edit> edits, const Context& context) {
  std::variant<unfold::Nets, Refusal> after = nets_after(project, edits, context);
  if (auto* const refusal = std::get_if<Refusal>(&after)) {
    return std::move(*refusal);
  }
  project.steps.resize(project.done);
  project.steps.push_back({{edits.begin(), edits.end()},
                           std::make_shared<const unfold::Nets>(std::get<unfold::Nets>(std::move(after)))});
  ++project.done;
  return std::nullopt;
}

/// Its steps without the paper, which is made anew.
Project steps_alone(const Project& project) {
  return {project.start, project.steps, project.done, {}};
}

}  // namespace

Project open(job::Paper made) {
  Project project;
  project.start = std::make_shared<const job::Paper>(std::move(made));
  project.now = *project.start;
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
  changed = with_paper(std::move(changed), context);
  if (std::optional<Refusal> refusal = missing_tab(changed)) {
    return std::move(*refusal);
  }
  return changed;
}

std::optional<Refusal> why_not(const Project& project, std::span<const Edit> edits, const Context& context) {
  std::variant<unfold::Nets, Refusal> after = nets_after(project, edits, context);
  auto* const refusal = std::get_if<Refusal>(&after);
  return refusal == nullptr ? std::nullopt : std::optional(std::move(*refusal));
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
