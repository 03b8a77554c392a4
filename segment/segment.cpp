// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/segment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/vertex_graph.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/edge_weights.hpp"
#include "segment/joining/assembly.hpp"
#include "segment/joining/crumbs.hpp"
#include "segment/joining/merge.hpp"
#include "segment/part_tasks.hpp"
#include "segment/recursion.hpp"
#include "segment/surface/component_ties.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segment/surface/virtual_facets.hpp"

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

/// A part that is within the tolerance, or can't be divided.
struct DonePart {
  PartTask task;  ///< without its hull
  double concavity = 0.0;
  Hull hull;
};

/// Everything one run needs, and its stages in order.
class Run {
 public:
  Run(const mesh::Surface& surface, std::span<const std::uint32_t> polygon, const Options& options,
      const Context& context)
      : closed_(closes_holes(surface, options)),
        real_facets_(surface.face_count()),
        scaled_(scaled_and_whole(surface, polygon, closed_, options.components)),
        rules_(rules_of(options.reading)),
        weights_(weigh_edges(scaled_, rules_)),
        graph_(build_vertex_graph(scaled_, arc_sagitta_share * options.concavity)),
        workers_(scaled_, graph_, weights_, options.concavity, context, rules_),
        context_(&context) {
    if (options.effort > 1 || volume_weight(options) > 0.0 || options.planes || options.pockets) {
      assembly_.emplace(scaled_, weights_, graph_, measurer(), cutter(), assembly_settings(options));
    }
  }

  Segmentation run() {
    cut_all();
    if (assembly_) {
      assemble_all();
    } else {
      merge_all();
    }
    measure_all();
    if (closed_) {
      absorb_crumbs();
    }
    return result();
  }
  [[nodiscard]] const Recursion& recursion() const { return recursion_; }

 private:
  [[nodiscard]] Measurer& measurer() { return workers_.first().measurer; }
  [[nodiscard]] Cutter& cutter() { return workers_.first().cutter; }

  /// Measures and divides these parts and all that come of them, round by round. What is done, by smallest
  /// facet. `from`, `to`: shares of the whole work.
  std::vector<DonePart> divide_all(std::vector<PartTask> tasks, MeasureMode mode, double from, double to) {
    const auto total = static_cast<double>(std::max<std::size_t>(1, scaled_.facet_count()));
    double facets_done = 0.0;
    std::vector<DonePart> done;
    while (!tasks.empty()) {
      double round = 0.0;
      std::vector<TaskOutcome> outcomes = workers_.run(tasks, mode, valleys_, [&](double facets) {
        round = facets;
        context_->report("segment", from + (to - from) * std::min(1.0, (facets_done + facets) / total));
      });
      facets_done += round;
      std::vector<PartTask> pieces;
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        TaskOutcome& outcome = outcomes[i];
        if (outcome.pieces.empty()) {
          done.push_back({std::move(tasks[i]), outcome.concavity, std::move(outcome.hull)});
          continue;
        }
        const int depth = tasks[i].depth + 1;
        recursion_.depth = std::max(recursion_.depth, depth);
        if (!outcome.cut) {
          ++(outcome.halved ? recursion_.halvings : recursion_.splits);
        }
        for (Facets& piece : outcome.pieces) {
          pieces.push_back({std::move(piece), depth, outcome.cut ? PartReason::ridge : PartReason::split});
        }
      }
      tasks = std::move(pieces);
    }
    std::sort(done.begin(), done.end(), [](const DonePart& a, const DonePart& b) {
      return a.task.facets.front() < b.task.facets.front();
    });
    return done;
  }

  void cut_all() {
    Facets all(scaled_.facet_count());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<PartTask> tasks;
    for (Facets& component : cutter().components(all)) {
      tasks.push_back({std::move(component)});
    }
    parts_ = divide_all(std::move(tasks), MeasureMode::split, 0.0, 0.7);
  }

  void merge_all() {
    std::vector<MergePart> parts;
    for (DonePart& part : parts_) {
      parts.push_back({std::move(part.task.facets), part.hull.vertices, false, true});
    }
    if (rules_.merging) {
      join(parts, MeasureMode::test);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].facets.empty()) {
        continue;
      }
      PartTask task{std::move(parts[i].facets), 0, parts_[i].task.reason};
      if (parts[i].merged) {
        task.reason = PartReason::merged;
      } else {
        task.hull = std::move(parts_[i].hull);
      }
      tasks_.push_back(std::move(task));
    }
    parts_.clear();
  }

  /// The merge pass, which goes on with the valleys that are known and leaves its own among them.
  void join(std::vector<MergePart>& parts, MeasureMode mode) {
    measurer().use_valleys(std::move(valleys_), nullptr);
    merge_parts(measurer(), weights_, parts, mode);
    valleys_ = measurer().take_valleys();
  }

  /// What the assembly makes of the parts, with the valleys that are known. A part that comes out as it went
  /// in keeps its reason.
  template <class Assemble>
  std::vector<PartTask> assembled(const Assemble& assemble) {
    std::vector<Facets> before;
    std::vector<PartReason> reasons;
    for (DonePart& part : parts_) {
      before.push_back(std::move(part.task.facets));
      reasons.push_back(part.task.reason);
    }
    parts_.clear();
    measurer().use_valleys(std::move(valleys_), nullptr);
    std::vector<PartTask> tasks;
    for (AssembledPart& part : assemble(before)) {
      // Parts ascend by smallest facet, so as wholes, too.
      const auto same = std::lower_bound(before.begin(), before.end(), part.facets);
      const bool kept = same != before.end() && *same == part.facets;
      const PartReason cut = part.joined ? PartReason::merged : PartReason::ridge;
      tasks.push_back(
          {std::move(part.facets), 0, kept ? reasons[static_cast<std::size_t>(same - before.begin())] : cut});
    }
    valleys_ = measurer().take_valleys();
    return tasks;
  }

  void assemble_all() {
    tasks_ = assembled([&](const std::vector<Facets>& parts) { return assembly_->assemble(parts); });
  }

  /// What is reported is measured from scratch; a part that turns out too concave is divided once more
  /// (12.6), and its pieces join each other and their neighbours where that holds from scratch, too.
  void measure_all() {
    parts_ = divide_all(std::move(tasks_), MeasureMode::scratch, 0.8, 1.0);
    const bool divided =
        std::any_of(parts_.begin(), parts_.end(), [](const DonePart& p) { return p.task.depth > 0; });
    if (divided && rules_.merging) {
      merge_divided();
    }
    for (DonePart& part : parts_) {
      final_.push_back(describe(std::move(part)));
    }
    parts_.clear();
  }

  void merge_divided() {
    std::vector<PartTask> changed;
    std::vector<DonePart> remaining;
    if (assembly_) {
      changed =
          assembled([&](const std::vector<Facets>& parts) { return assembly_->join_from_scratch(parts); });
    } else {
      std::vector<MergePart> parts;
      for (DonePart& part : parts_) {
        parts.push_back({part.task.facets, {}, false, part.task.depth > 0});
      }
      join(parts, MeasureMode::test_scratch);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].merged) {
          changed.push_back({std::move(parts[i].facets), 0, PartReason::merged});
        } else if (!parts[i].facets.empty()) {
          remaining.push_back(std::move(parts_[i]));
        }
      }
    }
    // Their unions were within the tolerance from scratch, so none of them is divided here.
    for (DonePart& part : divide_all(std::move(changed), MeasureMode::scratch, 1.0, 1.0)) {
      remaining.push_back(std::move(part));
    }
    parts_ = std::move(remaining);
  }

  /// By value: the hull, which is larger than what is kept of it, goes with the argument.
  Part describe(DonePart done) const {
    Part part;
    part.faces.reserve(done.task.facets.size());
    for (const std::uint32_t f : done.task.facets) {
      part.faces.emplace_back(f);
    }
    part.concavity = done.concavity;
    for (const std::uint32_t v : done.hull.vertices) {
      part.hull_vertices.emplace_back(v);
    }
    part.hull_volume = done.hull.volume(scaled_.points) * scaled_.unit * scaled_.unit * scaled_.unit;
    part.reason = done.task.reason;
    return part;
  }

  void absorb_crumbs() {
    Facets all(scaled_.facet_count());
    std::iota(all.begin(), all.end(), 0U);
    const std::vector<std::uint32_t> together(scaled_.facet_count(), 0);
    std::vector<Facets> before(final_.size());
    for (std::size_t p = 0; p < final_.size(); ++p) {
      for (const FaceId f : final_[p].faces) {
        before[p].push_back(f.value());
      }
    }
    segment::absorb_crumbs(
        scaled_, cutter().components(all, together), std::move(before),
        [&](std::span<const std::uint32_t> parts, std::uint32_t into) { return unite(parts, into); },
        *context_);
    std::erase_if(final_, [](const Part& part) { return part.faces.empty(); });
  }

  /// Puts these parts into one of them, if what comes out is within the tolerance from scratch.
  bool unite(std::span<const std::uint32_t> parts, std::uint32_t into) {
    PartTask task{{}, 0, final_[into].reason};
    for (const std::uint32_t p : parts) {
      for (const FaceId f : final_[p].faces) {
        task.facets.push_back(f.value());
      }
    }
    std::sort(task.facets.begin(), task.facets.end());
    Measurement& measurement = workers_.first().measurement;
    measurer().use_valleys(ValleyCache(), nullptr);
    measurer().measure(task.facets, {}, MeasureMode::test_scratch, measurement);
    if (measurement.stopped) {
      return false;
    }
    for (const std::uint32_t p : parts) {
      final_[p].faces.clear();
    }
    final_[into] = describe({std::move(task), measurement.concavity, measurement.hull});
    return true;
  }

  /// Virtual facets leave their parts; parts of nothing else are none.
  void drop_virtual_facets() {
    for (Part& part : final_) {
      std::erase_if(part.faces, [&](FaceId f) { return f.value() >= real_facets_; });
    }
    std::erase_if(final_, [](const Part& part) { return part.faces.empty(); });
  }

  /// Faces and vertices get the numbers that they have in the surface.
  void number_as_given() {
    if (scaled_.face_of.empty()) {
      return;
    }
    for (Part& part : final_) {
      for (FaceId& f : part.faces) {
        f = FaceId(scaled_.face_of[f.value()]);
      }
      for (VertexId& v : part.hull_vertices) {
        v = VertexId(scaled_.vertex_of[v.value()]);
      }
      std::sort(part.faces.begin(), part.faces.end());
      std::sort(part.hull_vertices.begin(), part.hull_vertices.end());
    }
  }

  Segmentation result() {
    drop_virtual_facets();
    number_as_given();
    std::sort(final_.begin(), final_.end(),
              [](const Part& a, const Part& b) { return a.faces.front() < b.faces.front(); });
    Segmentation s;
    s.part.resize(real_facets_);
    for (Part& part : final_) {
      const PartId id(s.parts.size());
      for (const FaceId f : part.faces) {
        s.part[f] = id;
      }
      s.parts.push_back(std::move(part));
    }
    return s;
  }

  bool closed_;  ///< holes were closed: facets from real_facets_ on are virtual
  std::size_t real_facets_;
  ScaledSurface scaled_;
  Rules rules_;
  EdgeWeights weights_;
  VertexGraph graph_;
  PartWorkers workers_;
  std::optional<Assembly> assembly_;
  const Context* context_;
  ValleyCache valleys_;  ///< known to all; with a worker while that works alone
  std::vector<PartTask> tasks_;
  std::vector<DonePart> parts_;
  std::vector<Part> final_;
  Recursion recursion_;
};

}  // namespace

Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                     const Options& options, const Context& context) {
  Recursion unused;
  return segment(surface, polygon, options, context, unused);
}

Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                     const Options& options, const Context& context, Recursion& recursion) {
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
  context.check();
  if (surface.face_count() == 0) {
    return {};
  }
  Run run(surface, polygon, options, context);
  Segmentation result = run.run();
  recursion = run.recursion();
  return result;
}

}  // namespace ridgecraft::segment
