// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/join_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "base/no_index.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/joining/partition.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

/// A component with at most this part of the largest one's facets is a crumb of a damaged surface.
constexpr std::size_t crumb_ratio = 20;

class Crumbs {
 public:
  Crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
         const UniteParts& unite)
      : surface_(&surface),
        components_(std::move(components)),
        facets_of_(std::move(parts)),
        part_of_(surface.facet_count(), no_index),
        unite_(&unite),
        size_of_(surface.facet_count(), 0),
        taken_in_(surface.facet_count(), false) {
    for (std::uint32_t p = 0; p < facets_of_.size(); ++p) {
      for (const std::uint32_t f : facets_of_[p]) {
        part_of_[f] = p;
      }
    }
    for (const Facets& component : components_) {
      for (const std::uint32_t f : component) {
        size_of_[f] = component.size();
      }
    }
    std::stable_sort(components_.begin(), components_.end(),
                     [](const Facets& a, const Facets& b) { return a.size() > b.size(); });
  }

  /// A crumb may touch none but others of its size: it follows them in a later pass. Whether some crumb
  /// joined a part.
  bool pass(const Context& context) {
    bool changed = false;
    for (const Facets& crumb : components_) {
      context.check();
      if (!taken_in_[crumb.front()] && crumb.size() * crumb_ratio <= components_.front().size()) {
        changed = absorb(crumb) || changed;
      }
    }
    return changed;
  }

 private:
  bool absorb(const Facets& crumb) {
    std::set<std::uint32_t> tried;
    for (const std::uint32_t g : facets_beside(crumb)) {
      const std::uint32_t into = part_of_[g];
      if (tried.insert(into).second && take_in(crumb, into)) {
        return true;
      }
    }
    return false;
  }

  /// Of larger components, or of such as have joined another part.
  [[nodiscard]] std::set<std::uint32_t> facets_beside(const Facets& crumb) const {
    std::set<std::uint32_t> beside;
    for (const std::uint32_t f : crumb) {
      for (const std::uint32_t v : surface_->corners[f]) {
        for (const std::uint32_t g : surface_->facets_at(v)) {
          if (size_of_[g] > size_of_[f] || (taken_in_[g] && part_of_[g] != part_of_[f])) {
            beside.insert(g);
          }
        }
      }
    }
    return beside;
  }

  /// False where the part would be too concave or has all of the crumb's already.
  bool take_in(const Facets& crumb, std::uint32_t into) {
    std::set<std::uint32_t> parts{into};
    for (const std::uint32_t f : crumb) {
      parts.insert(part_of_[f]);
    }
    const std::vector<std::uint32_t> united(parts.begin(), parts.end());
    if (united.size() == 1 || !(*unite_)(united, into)) {
      return false;
    }
    for (const std::uint32_t p : united) {
      if (p == into) {
        continue;
      }
      for (const std::uint32_t f : facets_of_[p]) {
        part_of_[f] = into;
        facets_of_[into].push_back(f);
      }
      facets_of_[p].clear();
    }
    for (const std::uint32_t f : crumb) {
      taken_in_[f] = true;
    }
    return true;
  }

  const ScaledSurface* surface_;
  std::vector<Facets> components_;  ///< largest first
  std::vector<Facets> facets_of_;   ///< of each part
  std::vector<std::uint32_t> part_of_;
  const UniteParts* unite_;
  std::vector<std::size_t> size_of_;  ///< of each facet's component
  std::vector<bool> taken_in_;
};

// The merge pass: neighbours whose union is within the tolerance become one part
// (docs/design/segmentation.md, "Merge pass").

/// A part on its way through the merge pass.
struct MergePart {
  Facets facets;
  std::vector<std::uint32_t> hull_vertices;  ///< not looked at from scratch
  bool merged = false;                       ///< made of several
  bool open = true;                          ///< pairs of which neither is open are left as they are
};

/// Borders between parts of which one at least is open.
BorderGraph<Border> borders_of(const std::vector<MergePart>& parts, const ScaledSurface& s,
                               const EdgeWeights& weights) {
  std::vector<std::uint32_t> part_of(s.facet_count(), no_index);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (const std::uint32_t f : parts[p].facets) {
      part_of[f] = p;
    }
  }
  BorderGraph<Border> borders(parts.size());
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == no_index || g < f || part_of[f] == part_of[g] || part_of[f] == no_index ||
          part_of[g] == no_index || !(parts[part_of[f]].open || parts[part_of[g]].open)) {
        continue;
      }
      borders.between(part_of[f], part_of[g]).add_side(s, weights, std::size_t{3} * f + k);
    }
  }
  return borders;
}

/// Joins pairs of parts with a common edge, convex borders first, until no union of two is within the
/// tolerance, measured from scratch or with the hull of the two parts' hull vertices and all that is known.
/// Parts that went into another are left without facets. At most n - 1 merges; a pair is tested again only
/// when one of the two has changed.
void merge_parts(Measurer& measurer, const EdgeWeights& weights, std::vector<MergePart>& parts,
                 bool from_scratch) {
  BorderGraph<Border> borders = borders_of(parts, measurer.graph().surface(), weights);
  PairQueue<double> waiting;  // the most convex borders first
  for (const auto& [pair, border] : borders.all()) {
    waiting.put(pair, -border.mean());
  }
  Measurement measurement;
  Facets facets;
  std::vector<std::uint32_t> hull_points;
  while (!waiting.empty()) {
    measurer.context().check();
    const auto [p, q] = waiting.take();
    MergePart& into = parts[p];
    MergePart& from = parts[q];
    facets.clear();
    std::merge(into.facets.begin(), into.facets.end(), from.facets.begin(), from.facets.end(),
               std::back_inserter(facets));
    hull_points.clear();
    if (!from_scratch) {
      std::set_union(into.hull_vertices.begin(), into.hull_vertices.end(), from.hull_vertices.begin(),
                     from.hull_vertices.end(), std::back_inserter(hull_points));
    }
    measurer.measure(facets, hull_points, {.stop_at_first = true, .from_scratch = from_scratch}, measurement);
    if (measurement.stopped) {
      continue;  // its turn comes again when one of the two has grown
    }
    into.facets.swap(facets);
    into.hull_vertices = measurement.hull.vertices;
    into.merged = true;
    into.open = true;
    from.facets.clear();
    borders.take_in(p, q, [&](const Pair& pair) { waiting.drop(pair); });
    for (const std::uint32_t other : borders.beside(p)) {
      waiting.put(std::minmax(p, other), -borders.between(p, other).mean());
    }
  }
}

/// Puts all parts through the merge pass, or with `from_scratch` only those that the last measurement divided
/// and their neighbours: no union may be more than what reporting would find. Takes the facets of the parts.
std::vector<MergePart> merged(std::vector<MeasuredPart>& parts, bool from_scratch,
                              const JoiningTools& tools) {
  std::vector<MergePart> merging;
  for (MeasuredPart& part : parts) {
    merging.push_back({std::move(part.facets), part.hull.vertices, false, !from_scratch || part.depth > 0});
  }
  const ValleyLoan loan(tools.measurer->valleys(), *tools.valleys);
  merge_parts(*tools.measurer, *tools.weights, merging, from_scratch);
  return merging;
}

/// What the assembly makes of the parts.
template <class Assemble>
std::vector<PartTask> assembled(std::vector<MeasuredPart> parts, const JoiningTools& tools,
                                const Assemble& assemble) {
  std::vector<Facets> before;
  std::vector<PartReason> reasons;
  for (MeasuredPart& part : parts) {
    before.push_back(std::move(part.facets));
    reasons.push_back(part.reason);
  }
  parts.clear();  // the hulls aren't needed any more, and are large
  const ValleyLoan loan(tools.measurer->valleys(), *tools.valleys);
  std::vector<PartTask> tasks;
  for (AssembledPart& part : assemble(before)) {
    // Parts ascend by smallest facet, so as wholes, too.
    const auto same = std::lower_bound(before.begin(), before.end(), part.facets);
    const bool kept = same != before.end() && *same == part.facets;
    const PartReason cut = part.joined ? PartReason::merged : PartReason::ridge;
    tasks.push_back(
        {std::move(part.facets), 0, kept ? reasons[static_cast<std::size_t>(same - before.begin())] : cut});
  }
  return tasks;
}

}  // namespace

void absorb_crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
                   const UniteParts& unite, const Context& context) {
  Crumbs crumbs(surface, std::move(components), std::move(parts), unite);
  while (crumbs.pass(context)) {
  }
}

std::vector<PartTask> leave_parts(std::vector<MeasuredPart> parts) {
  std::vector<PartTask> tasks;
  for (MeasuredPart& part : parts) {
    tasks.push_back({std::move(part.facets), 0, part.reason, std::move(part.hull)});
  }
  return tasks;
}

std::vector<PartTask> join_parts(std::vector<MeasuredPart> parts, const JoiningTools& tools) {
  if (tools.assembly != nullptr) {
    return assembled(std::move(parts), tools,
                     [&](const std::vector<Facets>& whole) { return tools.assembly->assemble(whole); });
  }
  std::vector<MergePart> merging = merged(parts, false, tools);
  std::vector<PartTask> tasks;
  for (std::size_t i = 0; i < merging.size(); ++i) {
    if (merging[i].facets.empty()) {
      continue;  // went into another one, perhaps with others that had gone into it
    }
    if (merging[i].merged) {
      tasks.push_back({std::move(merging[i].facets), 0, PartReason::merged});
    } else {
      tasks.push_back({std::move(merging[i].facets), 0, parts[i].reason, std::move(parts[i].hull)});
    }
  }
  return tasks;
}

Rejoined rejoin_divided(std::vector<MeasuredPart> parts, const JoiningTools& tools) {
  Rejoined result;
  if (tools.assembly != nullptr) {
    result.changed = assembled(std::move(parts), tools, [&](const std::vector<Facets>& whole) {
      return tools.assembly->join_from_scratch(whole);
    });
    return result;
  }
  std::vector<MergePart> merging = merged(parts, true, tools);
  for (std::size_t i = 0; i < merging.size(); ++i) {
    if (merging[i].facets.empty()) {
      continue;  // as above
    }
    if (merging[i].merged) {
      result.changed.push_back({std::move(merging[i].facets), 0, PartReason::merged});
    } else {
      parts[i].facets = std::move(merging[i].facets);
      result.kept.push_back(std::move(parts[i]));
    }
  }
  return result;
}

}  // namespace ridgecraft::segment
