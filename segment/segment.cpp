// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/segment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "mesh/foundation/error.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/vertex_graph.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/edge_weights.hpp"
#include "segment/joining/assembly.hpp"
#include "segment/joining/merge.hpp"
#include "segment/recursion.hpp"
#include "segment/surface/component_ties.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segment/surface/virtual_facets.hpp"

namespace ridgecraft::segment {
namespace {

/// Share of the tolerance by which an arc across an edge may leave the straight line (vertex_graph.hpp).
constexpr double arc_sagitta_share = 0.25;
/// From this depth on parts are halved, so that no input makes the recursion linear (specification 11.3).
constexpr int deepest_cut = 60;
/// A component with at most this part of the largest one's facets is a crumb of a damaged surface.
constexpr std::size_t crumb_ratio = 20;

bool closes_holes(const mesh::Surface& surface, const Options& options) {
  return options.holes == Options::Holes::close ||
         (options.holes == Options::Holes::automatic && looks_damaged(surface));
}

ScaledSurface scaled_and_whole(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                               bool close, Options::Components components) {
  ScaledSurface scaled = scale_surface(surface, polygon, Numbering::along_curve);
  if (close) {
    close_holes(scaled);
  }
  if (components == Options::Components::tied) {
    tie_components(scaled);
  }
  return scaled;
}

struct Work {
  Facets facets;
  int depth = 0;
  PartReason reason = PartReason::component;
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
        measurer_(scaled_, graph_, options.concavity, context, rules_),
        cutter_(scaled_, weights_),
        context_(&context) {
    if (options.effort > 1 || volume_weight(options) > 0.0 || options.planes || options.pockets) {
      assembly_.emplace(scaled_, weights_, graph_, measurer_, cutter_, assembly_settings(options));
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
    const bool halves = work.depth >= deepest_cut;
    ++(halves ? recursion_.halvings : recursion_.splits);
    return cutter_.split(measurer_, measurement_, halves);
  }

  /// Takes a part off the stack that is too concave and puts its pieces there, the first one on top. False
  /// when it can't be divided.
  bool replace_by_pieces(Work& work) {
    PartReason reason = PartReason::ridge;
    std::vector<Facets> children = divide(work, reason);
    if (children.size() < 2) {
      return false;
    }
    recursion_.depth = std::max(recursion_.depth, work.depth + 1);
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
      if (!assembly_) {
        measurer_.keep_hull(measurement_);
      }
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
    if (rules_.merging) {
      merge_parts(measurer_, weights_, parts_, MeasureMode::test);
    }
    for (std::size_t i = parts_.size(); i-- > 0;) {
      if (!parts_[i].facets.empty()) {
        stack_.push_back(
            {std::move(parts_[i].facets), 0, parts_[i].merged ? PartReason::merged : reasons[i]});
      }
    }
    parts_.clear();
  }

  std::vector<Facets> take_parts() {
    std::vector<Facets> parts;
    for (MergePart& part : parts_) {
      parts.push_back(std::move(part.facets));
    }
    parts_.clear();
    return parts;
  }

  void assemble_all() {
    std::vector<AssembledPart> parts = assembly_->assemble(take_parts());
    for (std::size_t i = parts.size(); i-- > 0;) {
      stack_.push_back(
          {std::move(parts[i].facets), 0, parts[i].joined ? PartReason::merged : PartReason::ridge});
    }
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
    if (divided && rules_.merging) {
      merge_divided();
    }
  }

  void merge_divided() {
    if (assembly_) {
      final_.clear();
      for (AssembledPart& part : assembly_->join_from_scratch(take_parts())) {
        const Work work{std::move(part.facets), 0, part.joined ? PartReason::merged : PartReason::ridge};
        measurer_.measure(work.facets, {}, MeasureMode::scratch, measurement_);
        final_.push_back(describe(work));
      }
      return;
    }
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

  /// Small components that touch a larger one at a vertex join its part there, if that stays within the
  /// tolerance (13.3). The smallest face at such a vertex decides which part.
  void absorb_crumbs() {
    std::vector<std::uint32_t> part_of(scaled_.facet_count(), none);
    const auto note = [&](std::uint32_t p) {
      for (const FaceId f : final_[p].faces) {
        part_of[f.value()] = p;
      }
    };
    for (std::uint32_t p = 0; p < final_.size(); ++p) {
      note(p);
    }
    Facets all(scaled_.facet_count());
    std::iota(all.begin(), all.end(), 0U);
    const std::vector<std::uint32_t> together(scaled_.facet_count(), 0);
    std::vector<Facets> components = cutter_.components(all, together);
    std::vector<std::size_t> size_of(scaled_.facet_count(), 0);
    for (const Facets& component : components) {
      for (const std::uint32_t f : component) {
        size_of[f] = component.size();
      }
    }
    std::stable_sort(components.begin(), components.end(),
                     [](const Facets& a, const Facets& b) { return a.size() > b.size(); });
    // A crumb may touch none but others of its size: it follows them in a later pass.
    std::vector<bool> taken_in(scaled_.facet_count(), false);
    for (bool changed = true; changed;) {
      changed = false;
      for (const Facets& crumb : components) {
        context_->check();
        if (taken_in[crumb.front()] || crumb.size() * crumb_ratio > components.front().size()) {
          continue;
        }
        std::set<std::uint32_t> beside;
        for (const std::uint32_t f : crumb) {
          for (const std::uint32_t v : scaled_.corners[f]) {
            for (const std::uint32_t g : scaled_.facets_at(v)) {
              if (size_of[g] > size_of[f] || (taken_in[g] && part_of[g] != part_of[f])) {
                beside.insert(g);
              }
            }
          }
        }
        std::set<std::uint32_t> tried;
        for (const std::uint32_t g : beside) {
          const std::uint32_t into = part_of[g];
          if (tried.insert(into).second && take_in(crumb, into, part_of)) {
            note(into);
            for (const std::uint32_t f : crumb) {
              taken_in[f] = true;
            }
            changed = true;
            break;
          }
        }
      }
    }
    std::erase_if(final_, [](const Part& part) { return part.faces.empty(); });
  }

  /// Adds a crumb to a part; false, and nothing is changed, when the part would be too concave.
  bool take_in(const Facets& crumb, std::uint32_t into, const std::vector<std::uint32_t>& part_of) {
    Work work{crumb, 0, final_[into].reason};
    for (const FaceId f : final_[into].faces) {
      work.facets.push_back(f.value());
    }
    std::sort(work.facets.begin(), work.facets.end());
    measurer_.measure(work.facets, {}, MeasureMode::scratch, measurement_);
    if (measurement_.concavity > measurer_.tolerance()) {
      return false;
    }
    for (const std::uint32_t f : crumb) {
      final_[part_of[f]].faces.clear();
    }
    final_[into] = describe(work);
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
  Measurer measurer_;
  Cutter cutter_;
  std::optional<Assembly> assembly_;
  const Context* context_;
  Measurement measurement_;
  std::vector<Work> stack_;
  std::vector<MergePart> parts_;
  std::vector<PartReason> reasons_;
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
