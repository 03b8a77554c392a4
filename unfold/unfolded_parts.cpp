// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/unfolded_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/pieces/patch_nets.hpp"

namespace ridgecraft::unfold {
namespace {

/// More are only counted.
constexpr std::size_t most_names = 4;

/// The pieces that a part became, where each of them is of this part alone; else the piece of this face.
std::vector<PieceId> pieces_of_part(FaceId face, const Nets& nets) {
  const PieceId own = nets.piece[face];
  const std::vector<PartId>& parts = nets.pieces[own].parts;
  std::vector<PieceId> pieces;
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    const std::vector<PartId>& others = nets.pieces[piece].parts;
    if (piece == own || (parts.size() == 1 && others == parts)) {
      pieces.push_back(piece);
    }
  }
  return pieces;
}

/// "a part of A: ..." (which has faces of others, too), "the part of A and C: ...", "each of the parts of A
/// and C; D: ...": parts by their pieces.
Message note_of(const Message& what, std::vector<std::vector<PieceId>> parts, const Nets& nets) {
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  // A piece may have faces of several parts, and the fact is one part's.
  const bool is_one_of_several =
      parts.size() == 1 && parts[0].size() == 1 && nets.pieces[parts[0][0]].parts.size() > 1;
  const std::size_t named = parts.size() > most_names + 1 ? most_names : parts.size();
  std::vector<Message> pieces;
  for (std::size_t i = 0; i < named; ++i) {
    std::vector<std::string> names;
    for (const PieceId piece : parts[i]) {
      names.push_back(nets.pieces[piece].name);
    }
    pieces.push_back(Message("names", {{"names", plain_items(names)}}));
  }
  return Message(
      is_one_of_several       ? "one_part_of"
      : parts.size() == 1     ? "part_of"
      : named == parts.size() ? "parts_of"
                              : "parts_of_and_more",
      {{"pieces", std::move(pieces)}, {"more", parts.size() - named}, {"what", std::vector{what}}});
}

}  // namespace

std::vector<Message> messages(std::span<const PartNote> notes, const Nets& nets) {
  std::vector<std::pair<Message, std::vector<std::vector<PieceId>>>> facts;
  for (const PartNote& note : notes) {
    const auto known =
        std::find_if(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == note.what; });
    std::vector<PieceId> pieces = pieces_of_part(note.face, nets);
    if (known != facts.end()) {
      known->second.push_back(std::move(pieces));
    } else {
      facts.push_back({note.what, {std::move(pieces)}});
    }
  }
  std::vector<Message> result;
  for (const auto& [what, parts] : facts) {
    result.push_back(note_of(what, parts, nets));
  }
  return result;
}

namespace {

/// How far unfolding has come when all parts are: the rest is merging and better trees.
constexpr double share_of_parts = 0.7;

/// One connected patch of one group.
struct Task {
  PartId part;                             ///< of its first face
  PieceReason reason = PieceReason::part;  ///< why it isn't one with others of its group
  std::vector<FaceId> faces;
};

/// Why these faces are several patches. What hangs together at needles alone counts as not connected.
PieceReason why_apart(const UnfoldProblem& problem, const std::vector<FaceId>& faces) {
  const EdgeConstraints& constraints = problem.options.constraints;
  const bool connected_before = connected(problem.surface, faces).size() == 1;
  return connected_before && !constraints.empty() &&
                 connected(problem.surface, faces, constraints.items()).size() > 1
             ? PieceReason::request
             : PieceReason::component;
}

std::vector<Task> make_tasks(const UnfoldProblem& problem, const Plan& plan) {
  std::uint32_t groups = 0;
  for (const PartId g : plan.group) {
    groups = std::max(groups, g.value() + 1);
  }
  IdVector<PartId, std::vector<FaceId>> faces(groups);
  for (const FaceId f : ids<FaceId>(problem.surface.face_count())) {
    faces[plan.group[f]].push_back(f);
  }
  const EdgeConstraints& constraints = plan.possible_constraints;
  std::vector<Task> tasks;
  for (const PartId g : ids<PartId>(groups)) {
    const PieceReason beside_first = why_apart(problem, faces[g]);
    PieceReason reason = PieceReason::part;
    for (auto& patch : connected(problem.surface, faces[g], constraints.items())) {
      tasks.push_back({problem.part[patch.front()], reason, std::move(patch)});
      reason = beside_first;
    }
  }
  return tasks;
}

/// What a task came to: written to the faces of the surface that are its own.
void take_over(const Task& task, const Patch& patch, const PatchNets& nets, UnfoldedParts& result) {
  const Layout layout = lay_out(patch, nets.folds);
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    const std::uint32_t face = task.faces[f].value();
    const std::uint32_t piece = layout.piece[f];
    const PieceReason reason = nets.reason[piece] == PieceReason::part ? task.reason : nets.reason[piece];
    if (reason != PieceReason::part) {
      result.causes[face] = {reason, task.faces[layout.faces[piece].front()].value()};
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      result.folds[3 * face + k] = nets.folds[3 * f + k];
    }
  }
}

}  // namespace

Patch whole_patch(const UnfoldProblem& problem, const Plan& plan) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(problem.surface.face_count())) {
    faces.push_back(f);
  }
  return make_patch(problem.surface, plan.whole, faces, plan.possible_constraints.items(),
                    problem.options.labels.items());
}

UnfoldedParts unfold_parts(const UnfoldProblem& problem, const Plan& plan, const Context& context) {
  const std::vector<Task> tasks = make_tasks(problem, plan);
  UnfoldedParts result{Folds(problem.surface.corner_count(), 0), Causes(problem.surface.face_count()), {}};
  std::vector<std::vector<Message>> notes(tasks.size());
  do_in_parallel(
      tasks.size(), context,
      [&](std::size_t i, const Context& own) {
        const Patch patch = make_patch(problem.surface, plan.whole, tasks[i].faces,
                                       plan.possible_constraints.items(), problem.options.labels.items());
        const std::uint64_t seed = Random::stream(context.seed, i).next();
        PatchNets nets = unfold_patch(patch, plan.room, problem.options.panel_cuts,
                                      net_tolerance(patch.extent), seed, Effort::full, own);
        take_over(tasks[i], patch, nets, result);
        notes[i] = std::move(nets.notes);
      },
      [&](std::size_t done) {
        context.report("unfold",
                       share_of_parts * static_cast<double>(done) / static_cast<double>(tasks.size()));
      });
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (const Message& note : notes[t]) {
      result.notes.push_back({note, tasks[t].faces.front()});
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
