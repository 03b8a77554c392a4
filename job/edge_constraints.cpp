// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/edge_constraints.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"
#include "job/model_of_nets.hpp"
#include "job/old_nets.hpp"
#include "job/same_place.hpp"
#include "mesh/reading/pdo/read_pdo.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::job {
namespace {

using unfold::EdgeConstraint;
using unfold::EdgeConstraints;
using unfold::Segment;
using unfold::SegmentCount;

/// A model may have changed since its nets were made; what shares fewer edges with them is another one.
constexpr double most_lost = 0.9;

struct Seams {
  std::vector<Segment> cut, keep;
};

/// The folds and cuts of nets of our own.
Seams seams_of_fold(const OldNets& old, const mesh::Surface& surface) {
  const verify::File nets = read_fold_file(old);
  const Similarity rescaled = same_place(nets.model.points, surface);
  const auto point = [&](verify::Index v) { return rescaled(nets.model.points[v]); };
  Seams seams;
  for (verify::Index side = 0; side < nets.faces.sides(); ++side) {
    const verify::Index face = nets.faces.face(side);
    const verify::Index there_side =
        nets.model.faces.first(nets.face_model[face]) + side - nets.faces.first(face);
    if (nets.model.twin[there_side] == verify::none) {
      continue;
    }
    const bool cut = nets.edges[nets.side_edge[side]].assignment == verify::Assignment::cut;
    (cut ? seams.cut : seams.keep)
        .push_back({point(nets.model.faces.tail(there_side)), point(nets.model.faces.head(there_side))});
  }
  return seams;
}

/// Largest extent of the model that nets of our own were made for, mm; none where they don't tell.
std::optional<double> size_of(const OldNets& old) {
  if (!is_fold_file(old)) {
    return std::nullopt;
  }
  const verify::File nets = read_fold_file(old);
  if (const auto size = nets.settings.number("size_mm")) {
    return size;
  }
  Box3 box;
  for (const Vec3 p : nets.model.points) {
    box.add(p);
  }
  return box.largest_extent() > 0.0 ? std::optional(box.largest_extent()) : std::nullopt;
}

/// At which size of the model nets of our own leave out what is too small; none where they don't tell.
std::optional<double> judged_at(const OldNets& old) {
  if (!is_fold_file(old)) {
    return std::nullopt;
  }
  const verify::File nets = read_fold_file(old);
  const auto judged = nets.settings.number("judged_at_mm");
  return judged ? judged : nets.settings.number("size_mm");
}

/// Those of nets that another program keeps with its model.
Seams seams_of_model_file(const OldNets& old, const mesh::Surface& surface, const Context& context) {
  const mesh::FileSeams file = mesh::read_seams(old.bytes, old.name, context);
  const Similarity rescaled = same_place(file.points, surface);
  Seams seams;
  for (const Segment& edge : file.cut) {
    seams.cut.push_back({rescaled(edge[0]), rescaled(edge[1])});
  }
  for (const Segment& edge : file.keep) {
    seams.keep.push_back({rescaled(edge[0]), rescaled(edge[1])});
  }
  return seams;
}

void note_count(const SegmentCount& count, std::string_view what, std::vector<std::string>& notes) {
  if (count.flat > 0) {
    notes.push_back(fmt::format("{} of {} edges {} lie inside flat regions, which stay whole", count.flat,
                                count.found + count.flat + count.lost, what));
  }
  if (count.lost > 0) {
    notes.push_back(fmt::format("{} of {} edges {} are no edges of the model on paper", count.lost,
                                count.found + count.flat + count.lost, what));
  }
}

/// Cuts and edges to be kept, matched each for itself so that contradictions show. Of these the cut counts:
/// it can always be made, and what is kept is a constraint that may fail for other reasons, too.
EdgeConstraints constraints_asked(const prepare::Prepared& prepared, const std::vector<Segment>& cut,
                                  const std::vector<Segment>& keep, const Context& context,
                                  std::vector<std::string>& notes) {
  SegmentCount cuts;
  SegmentCount keeps;
  SegmentCount none;
  const auto match = [&](const std::vector<Segment>& to_cut, const std::vector<Segment>& to_keep) {
    return unfold::match_segments(prepared.model.surface, prepared.panels, to_cut, to_keep,
                                  to_cut.empty() ? none : cuts, to_keep.empty() ? none : keeps, context);
  };
  EdgeConstraints constraints = match(cut, {});
  if (!keep.empty()) {
    const EdgeConstraints kept = match({}, keep);
    std::size_t both = 0;
    for (const EdgeId e : ids<EdgeId>(constraints.size())) {
      both += constraints[e] == EdgeConstraint::cut && kept[e] == EdgeConstraint::keep ? 1U : 0U;
      constraints[e] = constraints[e] == EdgeConstraint::none ? kept[e] : constraints[e];
    }
    if (both > 0) {
      notes.push_back(fmt::format("{} to be kept {} to be cut, too, and {} cut",
                                  std::to_string(both) + (both == 1 ? " edge" : " edges"),
                                  both == 1 ? "is" : "are", both == 1 ? "is" : "are"));
    }
  }
  note_count(cuts, "to be cut", notes);
  note_count(keeps, "to be kept", notes);
  return constraints;
}

EdgeConstraints constraints_from_nets(const OldNets& old, const prepare::Prepared& prepared,
                                      const Context& context, std::vector<std::string>& notes) {
  const mesh::Surface& surface = prepared.model.surface;
  const Seams seams =
      is_fold_file(old) ? seams_of_fold(old, surface) : seams_of_model_file(old, surface, context);
  SegmentCount cuts;
  SegmentCount keeps;
  EdgeConstraints constraints =
      unfold::match_segments(surface, prepared.panels, seams.cut, seams.keep, cuts, keeps, context);
  const std::size_t lost = cuts.lost + keeps.lost;
  const std::size_t all = seams.cut.size() + seams.keep.size();
  if (static_cast<double>(lost) > most_lost * static_cast<double>(all)) {
    throw Error(ErrorKind::unusable_mesh,
                fmt::format("{} holds nets of another model: {} of {} edges don't lie on an edge of this one",
                            old.name, lost, all),
                old.name);
  }
  if (lost > 0) {
    notes.push_back(
        fmt::format("{} of {} edges of {} are no edges of the model on paper", lost, all, old.name));
  }
  return constraints;
}

/// Edges by the numbers of their ends, at their places.
std::vector<Segment> segments_of(const std::optional<EdgeList>& list, const mesh::Model& model) {
  std::vector<Segment> segments;
  if (list) {
    for (const auto& [from, to] : list->edges) {
      segments.push_back({model.file_points.at(from), model.file_points.at(to)});
    }
  }
  return segments;
}

/// Before any work is done for edges that can't be found.
void require_points(const std::optional<EdgeList>& list, const mesh::Model& model) {
  if (!list) {
    return;
  }
  for (const auto& edge : list->edges) {
    const std::uint32_t last = std::max(edge[0], edge[1]);
    if (last >= model.file_points.size()) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("an edge is named by point {}, counted from 0, and the model was read with {}",
                              last, model.file_points.size()));
    }
  }
}

}  // namespace

void apply_edge_requests(const EdgeRequests& edges, mesh::Model& model, prepare::SimplifyOptions& simplify,
                         std::vector<std::string>& notes) {
  require_points(edges.cut, model);
  require_points(edges.keep, model);
  if (edges.from) {
    model.lines.clear();
  } else if (2 * model.lines.size() > model.surface.edge_count()) {
    notes.emplace_back("the file marks most of its edges, so they aren't taken for cuts");
    model.lines.clear();
  }
  if (simplify.mode != prepare::Simplification::automatic || (!edges.any() && model.lines.empty())) {
    return;
  }
  const bool of_points = edges.cut || edges.keep;
  if (edges.from && !of_points) {
    // A model that changed since its nets were made is simplified as it was for them.
    if (const auto before = simplified_by(*edges.from)) {
      simplify.mode = before->mode;
      simplify.faces = before->faces;
      return;
    }
  }
  simplify.mode = prepare::Simplification::keep;
  if (!edges.any()) {
    notes.emplace_back("the file marks edges to cut, so the model isn't simplified");
  }
}

void use_size_of_nets(const EdgeRequests& edges, const mesh::Model& model, prepare::SizeOptions& size) {
  if (edges.from) {
    size.judged_at_mm = judged_at(*edges.from);
  }
  if (!size.adapts || (!edges.any() && model.lines.empty())) {
    return;
  }
  size.adapts = false;
  if (edges.from) {
    size.largest_extent_mm = size_of(*edges.from).value_or(size.largest_extent_mm);
  }
}

prepare::Bodies bodies_for(const EdgeRequests& edges, prepare::Bodies wanted) {
  if (!edges.from) {
    return wanted;
  }
  if (!is_fold_file(*edges.from)) {
    return prepare::Bodies::keep;
  }
  return read_fold_file(*edges.from).settings.find("bodies") != nullptr ? prepare::Bodies::unite
                                                                        : prepare::Bodies::keep;
}

bool parts_standing_for(const EdgeRequests& edges, bool wanted) {
  if (!edges.from) {
    return wanted;
  }
  return is_fold_file(*edges.from) && read_fold_file(*edges.from).settings.find("standing") != nullptr;
}

prepare::Skins skins_for(const EdgeRequests& edges, prepare::Skins wanted) {
  if (!edges.from || !is_fold_file(*edges.from)) {
    return wanted;
  }
  const verify::File before = read_fold_file(*edges.from);
  const verify::Setting* const skins = before.settings.find("skins");
  if (skins == nullptr) {
    return prepare::Skins::outer;
  }
  return *skins == verify::Setting("middle") ? prepare::Skins::middle : prepare::Skins::both;
}

EdgeConstraints constraints_of(const EdgeRequests& edges, const prepare::Prepared& prepared,
                               const Context& context, std::vector<std::string>& notes) {
  EdgeConstraints constraints;
  if (edges.from) {
    constraints = constraints_from_nets(*edges.from, prepared, context, notes);
  }
  std::vector<Segment> cut = prepared.model.lines;
  const std::vector<Segment> named = segments_of(edges.cut, prepared.model);
  cut.insert(cut.end(), named.begin(), named.end());
  const std::vector<Segment> keep = segments_of(edges.keep, prepared.model);
  if (cut.empty() && keep.empty()) {
    return constraints;
  }
  EdgeConstraints asked = constraints_asked(prepared, cut, keep, context, notes);
  if (constraints.empty()) {
    return asked;
  }
  for (const EdgeId e : ids<EdgeId>(asked.size())) {
    constraints[e] = asked[e] != EdgeConstraint::none ? asked[e] : constraints[e];
  }
  return constraints;
}

}  // namespace ridgecraft::job
