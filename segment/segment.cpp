// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/segment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/error.hpp"
#include "segment/cut.hpp"
#include "segment/edge_weights.hpp"
#include "segment/measure.hpp"
#include "segment/merge.hpp"
#include "segment/scaled_surface.hpp"
#include "segment/vertex_graph.hpp"

namespace ridgecraft::segment {
namespace {

/// Share of the tolerance by which an arc across an edge may leave the straight line (vertex_graph.hpp).
constexpr double arc_sagitta_share = 0.25;
/// From this depth on parts are halved, so that no input makes the recursion linear (specification 11.3).
constexpr int deepest_cut = 60;

struct Work {
  Facets facets;
  int depth = 0;
  PartReason reason = PartReason::component;
};

/// Everything one run needs, and its stages in order.
class Run {
 public:
  Run(const mesh::Surface& surface, std::span<const std::uint32_t> polygon, double tolerance,
      const Context& context)
      : scaled_(scale_surface(surface, polygon)),
        weights_(weigh_edges(scaled_)),
        graph_(build_vertex_graph(scaled_, arc_sagitta_share * tolerance)),
        measurer_(scaled_, graph_, tolerance, context),
        cutter_(scaled_, weights_),
        context_(&context) {}

  Segmentation run() {
    cut_all();
    merge_all();
    measure_all();
    return result();
  }

 private:
  /// The pieces of a measured part that is too concave; a single one when it can't be divided.
  std::vector<Facets> divide(const Work& work, PartReason& reason) {
    if (work.depth < deepest_cut) {
      std::vector<Facets> children = cutter_.cut(measurer_, measurement_);
      if (children.size() > 1) {
        reason = PartReason::ridge;
        return children;
      }
    }
    reason = PartReason::split;
    return cutter_.split(measurer_, measurement_, work.depth >= deepest_cut);
  }

  /// Takes a part off the stack that is too concave and puts its pieces there, the first one on top. False
  /// when it can't be divided.
  bool replace_by_pieces(Work& work) {
    PartReason reason = PartReason::ridge;
    std::vector<Facets> children = divide(work, reason);
    if (children.size() < 2) {
      return false;
    }
    for (std::size_t i = children.size(); i-- > 0;) {
      stack_.push_back({std::move(children[i]), work.depth + 1, reason});
    }
    return true;
  }

  void cut_all() {
    Facets all(scaled_.facet_count());
    for (std::uint32_t f = 0; f < all.size(); ++f) {
      all[f] = f;
    }
    std::vector<Facets> components = cutter_.components(all);
    for (std::size_t i = components.size(); i-- > 0;) {
      stack_.push_back({std::move(components[i]), 0, PartReason::component});
    }
    std::size_t done = 0;
    while (!stack_.empty()) {
      context_->check();
      Work work = std::move(stack_.back());
      stack_.pop_back();
      measurer_.measure(work.facets, {}, MeasureMode::split, measurement_);
      if (measurement_.concavity > measurer_.tolerance() && replace_by_pieces(work)) {
        continue;
      }
      done += work.facets.size();
      context_->report("segment",
                       0.7 * static_cast<double>(done) / static_cast<double>(scaled_.facet_count()));
      parts_.push_back({std::move(work.facets), measurement_.hull.vertices, false, true});
      reasons_.push_back(work.reason);
    }
  }

  void merge_all() {
    // Parts in order of their smallest facet, whatever order the stack made them in.
    std::vector<std::size_t> order(parts_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return parts_[i].facets.front() < parts_[j].facets.front();
    });
    std::vector<MergePart> sorted;
    std::vector<PartReason> reasons;
    for (const std::size_t i : order) {
      sorted.push_back(std::move(parts_[i]));
      reasons.push_back(reasons_[i]);
    }
    parts_ = std::move(sorted);
    merge_parts(measurer_, weights_, parts_, MeasureMode::test);
    for (std::size_t i = parts_.size(); i-- > 0;) {
      if (!parts_[i].facets.empty()) {
        stack_.push_back(
            {std::move(parts_[i].facets), 0, parts_[i].merged ? PartReason::merged : reasons[i]});
      }
    }
    parts_.clear();
  }

  /// What is reported is measured from scratch; a part that turns out too concave is divided once more
  /// (12.6), and its pieces join each other and their neighbours where that holds from scratch, too.
  void measure_all() {
    const auto total = static_cast<double>(std::max<std::size_t>(1, scaled_.facet_count()));
    std::size_t done = 0;
    bool divided = false;
    while (!stack_.empty()) {
      context_->check();
      Work work = std::move(stack_.back());
      stack_.pop_back();
      measurer_.measure(work.facets, {}, MeasureMode::scratch, measurement_);
      if (measurement_.concavity > measurer_.tolerance() && replace_by_pieces(work)) {
        divided = true;
        continue;
      }
      done += work.facets.size();
      context_->report("segment", 0.8 + 0.2 * static_cast<double>(done) / total);
      final_.push_back(describe(work));
      parts_.push_back({std::move(work.facets), {}, false, work.depth > 0});
    }
    if (divided) {
      merge_divided();
    }
  }

  void merge_divided() {
    merge_parts(measurer_, weights_, parts_, MeasureMode::test_scratch);
    std::vector<Part> remaining;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].merged) {
        const Work work{parts_[i].facets, 0, PartReason::merged};
        measurer_.measure(work.facets, {}, MeasureMode::scratch, measurement_);
        final_[i] = describe(work);
      }
      if (!parts_[i].facets.empty()) {
        remaining.push_back(std::move(final_[i]));
      }
    }
    final_ = std::move(remaining);
  }

  Part describe(const Work& work) const {
    Part part;
    part.faces.reserve(work.facets.size());
    for (const std::uint32_t f : work.facets) {
      part.faces.emplace_back(f);
    }
    part.concavity = measurement_.concavity;
    for (const std::uint32_t v : measurement_.hull.vertices) {
      part.hull_vertices.emplace_back(v);
    }
    part.hull_volume = measurement_.hull.volume(scaled_.points) * scaled_.unit * scaled_.unit * scaled_.unit;
    part.reason = work.reason;
    return part;
  }

  Segmentation result() {
    std::sort(final_.begin(), final_.end(),
              [](const Part& a, const Part& b) { return a.faces.front() < b.faces.front(); });
    Segmentation s;
    s.part.resize(scaled_.facet_count());
    for (Part& part : final_) {
      const PartId id(s.parts.size());
      for (const FaceId f : part.faces) {
        s.part[f] = id;
      }
      s.parts.push_back(std::move(part));
    }
    return s;
  }

  ScaledSurface scaled_;
  EdgeWeights weights_;
  VertexGraph graph_;
  Measurer measurer_;
  Cutter cutter_;
  const Context* context_;
  Measurement measurement_;
  std::vector<Work> stack_;
  std::vector<MergePart> parts_;
  std::vector<PartReason> reasons_;
  std::vector<Part> final_;
};

}  // namespace

Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                     const Options& options, const Context& context) {
  if (!std::isfinite(options.concavity) || !(options.concavity > 0.0)) {
    throw Error(ErrorKind::usage, "the concavity must be a number above 0");
  }
  context.check();
  if (surface.face_count() == 0) {
    return {};
  }
  return Run(surface, polygon, options.concavity, context).run();
}

}  // namespace ridgecraft::segment
