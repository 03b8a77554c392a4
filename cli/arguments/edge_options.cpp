// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/edge_options.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "cli/telling/sentence.hpp"
#include "mesh/reading/read_soup.hpp"
#include "verify/file.hpp"

namespace ridgecraft::cli {
namespace {

using unfold::EdgeWish;
using unfold::EdgeWishes;
using unfold::Segment;
using unfold::SegmentCount;

[[noreturn]] void refuse_line(const std::string& file, std::size_t line, std::string_view reason) {
  throw Error(ErrorKind::unreadable_input, fmt::format("{}, line {}: {}", file, line, reason), file);
}

/// The two numbers of a line; none where it is empty or a comment.
std::vector<std::uint32_t> numbers_of(std::string_view text, const std::string& file, std::size_t line) {
  constexpr std::string_view space = " \t\r,";
  std::vector<std::uint32_t> numbers;
  text = text.substr(0, text.find('#'));
  for (std::size_t begin = text.find_first_not_of(space); begin != std::string_view::npos;
       begin = text.find_first_not_of(space)) {
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(space));
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      refuse_line(file, line, fmt::format("'{}' is no number of a point", word));
    }
    numbers.push_back(value);
    text.remove_prefix(word.size());
  }
  if (!numbers.empty() && numbers.size() != 2) {
    refuse_line(file, line, "two numbers of points are needed");
  }
  return numbers;
}

/// Pairs of points, one pair a line, numbered as the format does that the model was read as.
std::vector<Segment> pairs_in(const EdgeFile& edges, const mesh::Model& model) {
  const std::uint32_t first = mesh::first_point_number(model.format);
  const std::string& file = edges.name;
  std::vector<Segment> segments;
  std::size_t line = 0;
  for (std::string_view rest = edges.bytes; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::vector<std::uint32_t> pair = numbers_of(rest.substr(0, end), file, ++line);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (pair.empty()) {
      continue;
    }
    for (const std::uint32_t number : pair) {
      if (number < first || number - first >= model.file_points.size()) {
        refuse_line(file, line,
                    fmt::format("the model has no point {} (its points are {} to {})", number, first,
                                model.file_points.size() - 1 + first));
      }
    }
    segments.push_back({model.file_points[pair[0] - first], model.file_points[pair[1] - first]});
  }
  return segments;
}

struct Seams {
  std::vector<Segment> cut, keep;
};

Box3 bounds_of(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3 p : points) {
    box.add(p);
  }
  return box;
}

/// The folds and cuts of nets made before, in the surface's frame whatever size they were made in.
Seams seams_in(const EdgeFile& file, const mesh::Surface& surface) {
  verify::File nets;
  try {
    nets = verify::read_file(file.bytes);
  } catch (const verify::NotInForm& reason) {
    throw Error(ErrorKind::unreadable_input, file.name + ": " + reason.message, file.name);
  }
  const Box3 there = bounds_of(nets.model.points);
  const double factor = surface.bounds().largest_extent() / there.largest_extent();
  const auto point = [&](verify::Index v) {
    return surface.bounds().low + factor * (nets.model.points[v] - there.low);
  };
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
/// it can always be made, and what is kept is a wish that may fail for other reasons, too.
EdgeWishes wishes_asked(const prepare::Prepared& prepared, const std::vector<Segment>& cut,
                        const std::vector<Segment>& keep, const Context& context,
                        std::vector<std::string>& notes) {
  SegmentCount cuts;
  SegmentCount keeps;
  SegmentCount none;
  const auto match = [&](const std::vector<Segment>& to_cut, const std::vector<Segment>& to_keep) {
    return unfold::match_segments(prepared.model.surface, prepared.panels, to_cut, to_keep,
                                  to_cut.empty() ? none : cuts, to_keep.empty() ? none : keeps, context);
  };
  EdgeWishes wishes = match(cut, {});
  if (!keep.empty()) {
    const EdgeWishes kept = match({}, keep);
    std::size_t both = 0;
    for (const EdgeId e : ids<EdgeId>(wishes.size())) {
      both += wishes[e] == EdgeWish::cut && kept[e] == EdgeWish::keep ? 1U : 0U;
      wishes[e] = wishes[e] == EdgeWish::none ? kept[e] : wishes[e];
    }
    if (both > 0) {
      notes.push_back(fmt::format("{} to be kept {} to be cut, too, and {} cut", counted(both, "edge"),
                                  both == 1 ? "is" : "are", both == 1 ? "is" : "are"));
    }
  }
  note_count(cuts, "to be cut", notes);
  note_count(keeps, "to be kept", notes);
  return wishes;
}

EdgeWishes wishes_from_nets(const EdgeFile& file, const prepare::Prepared& prepared, const Context& context,
                            std::vector<std::string>& notes) {
  const mesh::Surface& surface = prepared.model.surface;
  const Seams seams = seams_in(file, surface);
  SegmentCount cuts;
  SegmentCount keeps;
  EdgeWishes wishes =
      unfold::match_segments(surface, prepared.panels, seams.cut, seams.keep, cuts, keeps, context);
  const std::size_t lost = cuts.lost + keeps.lost;
  const std::size_t all = seams.cut.size() + seams.keep.size();
  if (2 * lost > all) {
    throw Error(ErrorKind::unusable_mesh,
                fmt::format("{} holds nets of another model, or of this one with other faces: {} of {} edges "
                            "don't lie on an edge of it",
                            file.name, lost, all),
                file.name);
  }
  if (lost > 0) {
    notes.push_back(
        fmt::format("{} of {} edges of {} are no edges of the model on paper", lost, all, file.name));
  }
  return wishes;
}

}  // namespace

void add_edge_options(Verb& verb, EdgeArguments& edges) {
  verb.option("Pieces", "--cuts", edges.cuts, "FILE",
              "Edges to cut: two point numbers a line, counted as in the model's file (OBJ: from 1, others: "
              "from 0). Lines (l) of an OBJ and edges of a PLY file are cut, too.");
  verb.option("Pieces", "--keep", edges.keep, "FILE",
              "Edges not to cut, in the same way; an edge in both is cut.");
  verb.option("Pieces", "--from", edges.from, "FILE.fold",
              "Nets of the same model made before, edited or not: their cuts and folds are kept. "
              "Results go elsewhere (-o), unless --overwrite lets them replace this file.");
}

EdgeFiles read_edge_files(const EdgeArguments& edges) {
  const auto read = [](const std::string& name) -> std::optional<EdgeFile> {
    if (name.empty()) {
      return std::nullopt;
    }
    // Read before the aggregate begins: g++ 12 destroys its members twice where one of them throws.
    std::string bytes = mesh::read_file(name);
    return EdgeFile{name, std::move(bytes)};
  };
  return {read(edges.cuts), read(edges.keep), read(edges.from)};
}

std::vector<InputFile> input_files(const EdgeArguments& edges) {
  return {{"--from", edges.from}, {"--cuts", edges.cuts}, {"--keep", edges.keep}};
}

void heed_edges(const EdgeArguments& edges, mesh::Model& model, SizeArguments& size,
                std::vector<std::string>& notes) {
  if (!edges.from.empty()) {
    model.lines.clear();
  } else if (2 * model.lines.size() > model.surface.edge_count()) {
    notes.emplace_back("the file marks most of its edges, so they aren't taken for cuts");
    model.lines.clear();
  }
  if (size.simplify.mode != prepare::Simplification::automatic || (!edges.any() && model.lines.empty())) {
    return;
  }
  size.simplify.mode = prepare::Simplification::keep;
  if (!edges.any()) {
    notes.emplace_back("the file marks edges to cut, so the model isn't simplified");
  }
}

EdgeWishes wishes_of(const EdgeFiles& edges, const prepare::Prepared& prepared, const Context& context,
                     std::vector<std::string>& notes) {
  EdgeWishes wishes;
  if (edges.from) {
    wishes = wishes_from_nets(*edges.from, prepared, context, notes);
  }
  std::vector<Segment> cut = prepared.model.lines;
  std::vector<Segment> keep;
  if (edges.cuts) {
    const std::vector<Segment> asked = pairs_in(*edges.cuts, prepared.model);
    cut.insert(cut.end(), asked.begin(), asked.end());
  }
  if (edges.keep) {
    keep = pairs_in(*edges.keep, prepared.model);
  }
  if (cut.empty() && keep.empty()) {
    return wishes;
  }
  const EdgeWishes asked = wishes_asked(prepared, cut, keep, context, notes);
  if (wishes.empty()) {
    return asked;
  }
  for (const EdgeId e : ids<EdgeId>(asked.size())) {
    wishes[e] = asked[e] != EdgeWish::none ? asked[e] : wishes[e];
  }
  return wishes;
}

}  // namespace ridgecraft::cli
