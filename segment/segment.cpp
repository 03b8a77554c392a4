// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/segment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/division.hpp"
#include "segment/joining/join_parts.hpp"
#include "segment/surface/damage.hpp"
#include "segment/surface/redundant_points.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

/// Surfaces of so many faces don't fit into a processor's caches: numbers that are near in space save a fifth
/// of the time. Smaller ones gain 2 % and keep their numbers, by which ties are decided.
constexpr std::size_t renumbered_from = 100000;

bool closes_holes(const mesh::Surface& surface, const Options& options) {
  return options.holes == Options::Holes::close ||
         (options.holes == Options::Holes::automatic && looks_damaged(surface));
}

ScaledSurface scaled_and_whole(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                               bool close, Options::Components components) {
  const Numbering numbering =
      surface.face_count() < renumbered_from ? Numbering::kept : Numbering::along_curve;
  ScaledSurface scaled = scale_surface(surface, polygon, numbering);
  if (close) {
    close_holes(scaled);
  }
  if (components == Options::Components::tied) {
    tie_components(scaled);
  }
  return scaled;
}

/// What is taken from the surface.
struct Form {
  bool closed;
  std::size_t real_facets;
  ScaledSurface scaled;
};

Form form_of(const mesh::Surface& surface, std::span<const std::uint32_t> polygon, const Options& options) {
  const bool closed = closes_holes(surface, options);
  return {closed, surface.face_count(), scaled_and_whole(surface, polygon, closed, options.components)};
}

/// The surface in the forms that all phases look at and none changes.
struct Ground {
  Ground(Form form, const Options& options, std::span<const std::uint32_t> label)
      : closed(form.closed),
        real_facets(form.real_facets),
        scaled(std::move(form.scaled)),
        rules(rules_of(options.reading)),
        weights(weigh_edges(scaled, rules, label)),
        graph(build_vertex_graph(scaled, arc_sagitta_share * options.concavity)) {}
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  bool closed;  ///< holes were closed: facets from real_facets on are virtual
  std::size_t real_facets;
  ScaledSurface scaled;
  Rules rules;
  EdgeWeights weights;
  VertexGraph graph;
};

Facets all_facets(const Ground& ground) {
  Facets all(ground.scaled.facet_count());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

std::vector<PartTask> components_of(const Ground& ground, Cutter& cutter) {
  std::vector<PartTask> tasks;
  for (Facets& component : cutter.components(all_facets(ground))) {
    tasks.push_back({std::move(component)});
  }
  return tasks;
}

/// By value: the hull, which is larger than what is kept of it, goes with the argument.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
Part described(MeasuredPart measured, const ScaledSurface& scaled) {
  return part_of(scaled, measured.facets, measured.hull, measured.concavity, measured.reason);
}

/// Shares of the whole work that are done when phases end, as progress tells them.
constexpr double cut_share = 0.7;
constexpr double joined_share = 0.8;

/// Cuts, joins and measures: parts that are within the tolerance from scratch, but for single polygons.
std::vector<Part> find_parts(const Ground& ground, PartWorkers& workers, Assembly* assembly,
                             const Context& context) {
  ValleyCache valleys;  // found by all phases
  const auto divide = [&](std::vector<PartTask> tasks, const MeasureOptions& options, double from,
                          double to) {
    const auto progress = [&](double share) { context.report("segment", from + (to - from) * share); };
    return divide_all(workers, std::move(tasks), options, valleys, progress).parts;
  };
  const JoiningTools tools{&workers.first().measurer, &ground.weights, assembly, &valleys};
  const MeasureOptions from_scratch{.from_scratch = true};

  std::vector<MeasuredPart> parts = divide(components_of(ground, workers.first().cutter), {}, 0.0, cut_share);
  std::vector<PartTask> joined =
      ground.rules.merging ? join_parts(std::move(parts), tools) : leave_parts(std::move(parts));
  // What is reported is measured from scratch; a part that turns out too concave is divided once more.
  parts = divide(std::move(joined), from_scratch, joined_share, 1.0);
  const bool divided =
      std::any_of(parts.begin(), parts.end(), [](const MeasuredPart& part) { return part.depth > 0; });
  if (divided && ground.rules.merging) {
    Rejoined rejoined = rejoin_divided(std::move(parts), tools);
    parts = std::move(rejoined.kept);
    // Their unions were within the tolerance from scratch, so none of them is divided here.
    for (MeasuredPart& part : divide(std::move(rejoined.changed), from_scratch, 1.0, 1.0)) {
      parts.push_back(std::move(part));
    }
  }
  std::vector<Part> found;
  for (MeasuredPart& part : parts) {
    found.push_back(described(std::move(part), ground.scaled));
  }
  return found;
}

/// Puts these parts into one of them, if what comes out is within the tolerance from scratch.
bool unite(std::span<const std::uint32_t> united, std::uint32_t into, const ScaledSurface& scaled,
           PartWorker& worker, std::vector<Part>& parts) {
  MeasuredPart whole;
  whole.reason = parts[into].reason;
  for (const std::uint32_t p : united) {
    for (const FaceId f : parts[p].faces) {
      whole.facets.push_back(f.value());
    }
  }
  std::sort(whole.facets.begin(), whole.facets.end());
  ValleyCache unknown;
  const ValleyLoan loan(worker.measurer.valleys(), unknown);
  worker.measurer.measure(whole.facets, {}, {.stop_at_first = true, .from_scratch = true},
                          worker.measurement);
  if (worker.measurement.stopped) {
    return false;
  }
  whole.concavity = worker.measurement.concavity;
  whole.hull = worker.measurement.hull;
  for (const std::uint32_t p : united) {
    parts[p].faces.clear();
  }
  parts[into] = described(std::move(whole), scaled);
  return true;
}

/// The crumbs of a surface whose holes were closed join the parts that they touch.
void absorb_crumbs(const Ground& ground, PartWorker& worker, std::vector<Part>& parts,
                   const Context& context) {
  const std::vector<std::uint32_t> together(ground.scaled.facet_count(), 0);
  std::vector<Facets> before(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const FaceId f : parts[p].faces) {
      before[p].push_back(f.value());
    }
  }
  segment::absorb_crumbs(
      ground.scaled, worker.cutter.components(all_facets(ground), together), std::move(before),
      [&](std::span<const std::uint32_t> united, std::uint32_t into) {
        return unite(united, into, ground.scaled, worker, parts);
      },
      context);
}

/// Virtual facets leave their parts; parts of nothing else are none.
void drop_virtual_facets(std::size_t real_facets, std::vector<Part>& parts) {
  for (Part& part : parts) {
    std::erase_if(part.faces, [&](FaceId f) { return f.value() >= real_facets; });
  }
  std::erase_if(parts, [](const Part& part) { return part.faces.empty(); });
}

/// Faces and vertices get the numbers that they have in the surface.
void number_as_given(const ScaledSurface& scaled, std::vector<Part>& parts) {
  if (scaled.face_of.empty()) {
    return;
  }
  for (Part& part : parts) {
    for (FaceId& f : part.faces) {
      f = FaceId(scaled.face_of[f.value()]);
    }
    for (VertexId& v : part.hull_vertices) {
      v = VertexId(scaled.vertex_of[v.value()]);
    }
    std::sort(part.faces.begin(), part.faces.end());
    std::sort(part.hull_vertices.begin(), part.hull_vertices.end());
  }
}

Segmentation segmentation_of(std::vector<Part> parts, const Ground& ground) {
  drop_virtual_facets(ground.real_facets, parts);
  number_as_given(ground.scaled, parts);
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.faces.front() < b.faces.front(); });
  Segmentation s;
  s.part.resize(ground.real_facets);
  for (Part& part : parts) {
    const PartId id(s.parts.size());
    for (const FaceId f : part.faces) {
      s.part[f] = id;
    }
    s.parts.push_back(std::move(part));
  }
  return s;
}

void require_possible(const Options& options) {
  if (!std::isfinite(options.concavity) || !(options.concavity > 0.0)) {
    throw Error(ErrorKind::usage, "the concavity must be a number above 0");
  }
  if (const double weight = volume_weight(options); !std::isfinite(weight) || weight < 0.0) {
    throw Error(ErrorKind::usage, "the weight of volume must be a number from 0 on");
  }
  if (options.reading != Reading::b &&
      (options.effort > 1 || options.planes || options.pockets || options.volume_weight)) {
    throw Error(
        ErrorKind::usage,
        "the readings literal and a go with effort 1 alone: without planes, pockets and a weight of volume");
  }
}

std::vector<Part> parts_of(const Ground& ground, const Options& options, const Context& context) {
  PartWorkers workers(ground.scaled, ground.graph, ground.weights, {options.concavity, ground.rules},
                      context);
  PartWorker& worker = workers.first();
  std::optional<Assembly> assembly;
  if (options.effort > 1 || volume_weight(options) > 0.0 || options.planes || options.pockets) {
    assembly.emplace(ground.scaled, ground.weights, ground.graph, worker, assembly_settings(options));
  }
  std::vector<Part> parts = find_parts(ground, workers, assembly ? &*assembly : nullptr, context);
  if (ground.closed) {
    absorb_crumbs(ground, worker, parts, context);
  }
  return parts;
}

Segmentation segment_ground(const Ground& ground, const Options& options, const Context& context) {
  return segmentation_of(parts_of(ground, options, context), ground);
}

/// What is segmented, and whether it may be emptied when nothing is read from it any more.
struct Given {
  const mesh::Surface& surface;
  mesh::Surface* own = nullptr;

  void done() const {
    if (own != nullptr) {
      *own = mesh::Surface();
    }
  }
};

/// A surface as it is.
Segmentation segment_surface(const Given& given, std::span<const std::uint32_t> polygon,
                             const Options& options, std::span<const std::uint32_t> label,
                             const Context& context) {
  Form form = form_of(given.surface, polygon, options);
  given.done();
  return segment_ground(Ground(std::move(form), options, label), options, context);
}

/// Parts of a surface that another one stands for, with the numbers of that one: `to_given_numbers` changes a
/// part's.
template <class ToGivenNumbers>
Segmentation renumbered(Segmentation s, std::size_t face_count, const ToGivenNumbers& to_given_numbers) {
  s.part = {};
  s.part.resize(face_count);
  for (const PartId p : ids<PartId>(s.parts.size())) {
    to_given_numbers(s.parts[p]);
    for (const FaceId f : s.parts[p].faces) {
      s.part[f] = p;
    }
  }
  return s;
}

/// With points in the middle of lonely valleys.
Segmentation segment_with_valleys(const Given& given, std::span<const std::uint32_t> polygon,
                                  const Options& options, std::span<const std::uint32_t> label,
                                  const Context& context) {
  const std::size_t face_count = given.surface.face_count();
  DividedValleys divided = divide_valleys(given.surface, polygon, shortest_valley_share * options.concavity);
  if (!divided.any()) {
    return segment_surface(given, polygon, options, label, context);
  }
  given.done();
  std::vector<std::uint32_t> divided_label;
  if (!label.empty()) {
    for (const FaceId f : divided.face_of) {
      divided_label.push_back(label[f.value()]);
    }
  }
  Form form = form_of(divided.surface, divided.polygon, options);
  // All that follows looks at the form: of millions of faces this is a fifth of the memory.
  divided.surface = {};
  divided.polygon = {};
  const Ground ground(std::move(form), options, divided_label);
  return renumbered(segment_ground(ground, options, context), face_count,
                    [&](Part& part) { divided.to_given_numbers(part); });
}

Segmentation segment_given(const Given& given, std::span<const std::uint32_t> polygon, const Options& options,
                           const Context& context, std::span<const std::uint32_t> label) {
  const mesh::Surface& surface = given.surface;
  require_possible(options);
  context.check();
  if (surface.face_count() == 0) {
    return {};
  }
  // Where depth isn't capped by the hull, the ends of a valley tell it.
  if (!rules_of(options.reading).cap) {
    return segment_surface(given, polygon, options, label, context);
  }
  // Between components, and over holes, distances between points count: there all points stay.
  const bool points_count = options.components == Options::Components::tied || closes_holes(surface, options);
  const Undivided undivided = points_count ? Undivided() : undivide(surface, polygon, label);
  if (!undivided.any()) {
    return segment_with_valleys(given, polygon, options, label, context);
  }
  const std::size_t face_count = surface.face_count();
  given.done();
  return renumbered(
      segment_with_valleys({undivided.surface}, undivided.polygon, options, undivided.label, context),
      face_count, [&](Part& part) { undivided.to_given_numbers(part); });
}

}  // namespace

Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                     const Options& options, const Context& context, std::span<const std::uint32_t> label) {
  return segment_given({surface}, polygon, options, context, label);
}

// It is taken where nothing is read from it any more.
// NOLINTNEXTLINE(cppcoreguidelines-rvalue-reference-param-not-moved)
Segmentation segment(mesh::Surface&& surface, std::span<const std::uint32_t> polygon, const Options& options,
                     const Context& context, std::span<const std::uint32_t> label) {
  return segment_given({surface, &surface}, polygon, options, context, label);
}

double scale_of(const mesh::Surface& surface) {
  const Box3 box = surface.bounds();
  const double size = box.diagonal();
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    points.push_back((1.0 / size) * (p - box.low));
  }
  return size > 0.0 ? size * smallest_enclosing_ball(points).radius : 0.0;
}

}  // namespace ridgecraft::segment
