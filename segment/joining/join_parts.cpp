// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/join_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/no_index.hpp"
#include "base/random.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/joining/partition.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

/// Volumes below this, in cubed radii, are no measure for hulls: thin sheets, inside-out surfaces.
constexpr double least_unit_volume = 0.005;
/// Where no price for volume is given but pockets are to be cut: parts for a volume ratio less by 1.
constexpr double default_price = 10.0;
/// A cut by planes must save this share of what its pieces are worth: joining finds better sets later.
constexpr double share_saved = 0.3;
/// Two hulls belong together for planes when they share this much of the smaller one: skins of one wall.
constexpr double overlap_share = 0.3;
/// More parts than this aren't compared in pairs.
constexpr std::size_t most_compared = 200;
/// How far borders may leave their plane for shorter or concave edges, in radii.
constexpr double border_reach = 0.02;
/// Cuts by planes, and fine cuts, that one part goes through at most.
constexpr int deepest_plane = 12;
constexpr int deepest_fine_cut = 16;

double enclosed(const ScaledSurface& s) {
  double sum = 0.0;
  for (const auto& [a, b, c] : s.corners) {
    sum += dot(s.points[a], cross(s.points[b], s.points[c]));
  }
  return std::max(sum / 6.0, least_unit_volume);
}

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

AssemblySettings assembly_settings(const Options& options) {
  AssemblySettings settings;
  settings.volume_weight = volume_weight(options);
  settings.pockets = options.pockets;
  if (options.effort == 1) {
    settings.attempts.push_back({.planes = options.planes});
    return settings;
  }
  settings.border_weight = 0.1;
  settings.noise = 0.6;
  settings.attempts.push_back({.at_any_cost = true});
  Attempt finer{.fineness = 0.5, .rounds = 40};
  Attempt by_planes{.fineness = 0.5, .rounds = 40, .planes = true};
  if (options.effort > 2) {
    finer = {.fineness = 0.25, .rounds = 150};
    by_planes = {.fineness = 0.5, .rounds = 60, .planes = true, .plane_price = 3.0};
  }
  settings.attempts.push_back(finer);
  if (options.planes) {
    settings.attempts.push_back(by_planes);
  }
  return settings;
}

Assembly::Assembly(const ScaledSurface& surface, const EdgeWeights& weights, const VertexGraph& graph,
                   PartWorker& worker, const AssemblySettings& settings)
    : surface_(&surface),
      weights_(&weights),
      graph_(&graph),
      measurer_(&worker.measurer),
      cutter_(&worker.cutter),
      settings_(settings),
      planes_(surface, weights),
      unit_volume_(enclosed(surface)) {
  if (settings_.pockets) {
    if (!PocketTest::encloses(surface)) {
      throw Error(ErrorKind::unusable_mesh,
                  "pockets can't be found: the surface has border edges and encloses no solid");
    }
    pockets_.emplace(surface, measurer_->tolerance());
  }
}

std::vector<AssembledPart> Assembly::assemble(const std::vector<Facets>& parts) {
  Assembled best;
  for (const Attempt& attempt : settings_.attempts) {
    std::vector<Piece> pieces = cut_by_planes(parts, attempt);
    const bool by_plane =
        std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.by_plane; });
    if (attempt.planes && !by_plane && !best.parts.empty()) {
      continue;  // the same as without planes, which was tried
    }
    PieceSets sets = piece_sets(cut_finely(std::move(pieces), attempt.fineness), false);
    Partition partition(sets, *weights_, cost());
    // Attempts begin with the same numbers, so that one more of them changes none of the others.
    Random random(measurer_->context().seed);
    Assembled found = attempt.at_any_cost ? partition.join_pieces(true)
                                          : partition.search(attempt.rounds, settings_.noise, random);
    if (best.parts.empty() || found.cost < best.cost) {
      best = std::move(found);
    }
  }
  return std::move(best.parts);
}

std::vector<AssembledPart> Assembly::join_from_scratch(std::vector<Facets> parts) {
  PieceSets sets = piece_sets(std::move(parts), true);
  return Partition(sets, *weights_, cost()).join_pieces(false).parts;
}

/// Sets of parts whose hulls lie in each other.
std::vector<std::vector<std::size_t>> Assembly::overlapping(const std::vector<Facets>& parts) {
  DisjointSets together(parts.size());
  const auto set_of = [&](std::size_t i) { return together.find(static_cast<std::uint32_t>(i)); };
  std::vector<std::vector<std::uint32_t>> hull;
  std::vector<double> volume;
  for (const Facets& facets : parts) {
    volume.push_back(planes_.hull_volume(facets));
    hull.emplace_back(planes_.hull_vertices().begin(), planes_.hull_vertices().end());
  }
  std::vector<std::uint32_t> both;
  for (std::size_t i = 0; i < parts.size() && parts.size() <= most_compared; ++i) {
    measurer_->context().check();
    for (std::size_t j = 0; j < i; ++j) {
      if (set_of(i) == set_of(j)) {
        continue;
      }
      both.clear();
      std::set_union(hull[i].begin(), hull[i].end(), hull[j].begin(), hull[j].end(),
                     std::back_inserter(both));
      const double shared = volume[i] + volume[j] - planes_.volume_of(both);
      if (shared > overlap_share * std::min(volume[i], volume[j])) {
        together.join(set_of(i), set_of(j));
      }
    }
  }
  std::vector<std::vector<std::size_t>> sets(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sets[set_of(i)].push_back(i);
  }
  std::erase_if(sets, [](const auto& set) { return set.empty(); });
  return sets;
}

bool Assembly::is_hollow(std::span<const std::uint32_t> facets) {
  if (!pockets_) {
    return false;
  }
  (void)planes_.hull_volume(facets);
  return pockets_->has_pocket(planes_.hull());
}

/// The volume that a cut by planes must save for each piece that it makes.
double Assembly::piece_worth(const Attempt& attempt) const {
  const double price = settings_.volume_weight > 0.0 ? settings_.volume_weight : default_price;
  return unit_volume_ / (price * attempt.plane_price);
}

std::vector<Assembly::Piece> Assembly::cut_by_planes(std::vector<Facets> parts, const Attempt& attempt) {
  std::vector<Piece> done;
  if (!attempt.planes && !pockets_) {
    for (Facets& facets : parts) {
      done.push_back({std::move(facets)});
    }
    return done;
  }
  const double worth = piece_worth(attempt);
  for (const auto& set : overlapping(parts)) {
    Facets all;
    bool hollow = false;
    for (const std::size_t i : set) {
      all.insert(all.end(), parts[i].begin(), parts[i].end());
      hollow = hollow || is_hollow(parts[i]);
    }
    std::sort(all.begin(), all.end());
    std::vector<Facets> pieces;
    const double excess = planes_.hull_volume(all) - planes_.closed_volume(all);
    if ((attempt.planes && excess > worth) || hollow) {
      pieces = planes_.cut(*cutter_, all, hollow ? 0.0 : share_saved * worth, border_reach, true);
    }
    std::vector<Piece> open;
    if (pieces.size() > 1) {
      for (Facets& facets : pieces) {
        open.push_back({std::move(facets), true, 1});
      }
    } else {
      for (const std::size_t i : set) {
        open.push_back({std::move(parts[i]), false, 0});
      }
    }
    cut_further(std::move(open), attempt, done);
  }
  return done;
}

/// Goes on with single planes where a piece has a pocket, or a plane saves enough in a piece that planes
/// made.
void Assembly::cut_further(std::vector<Piece> open, const Attempt& attempt, std::vector<Piece>& done) {
  const double worth = piece_worth(attempt);
  while (!open.empty()) {
    measurer_->context().check();
    Piece piece = std::move(open.back());
    open.pop_back();
    std::vector<Facets> children;
    if (is_hollow(piece.facets)) {
      children = planes_.cut(*cutter_, piece.facets, 0.0, border_reach, false);
      if (children.size() < 2) {
        measurer_->measure(piece.facets, {}, {}, measurement_);
        children = cutter_->split(*measurer_, measurement_, true);
      }
    } else if (attempt.planes && piece.by_plane && piece.depth < deepest_plane &&
               planes_.hull_volume(piece.facets) - planes_.closed_volume(piece.facets) > worth) {
      children = planes_.cut(*cutter_, piece.facets, share_saved * worth, border_reach, false);
    }
    if (children.size() < 2) {
      done.push_back(std::move(piece));
      continue;
    }
    for (std::size_t i = children.size(); i-- > 0;) {
      open.push_back({std::move(children[i]), true, piece.depth + 1});
    }
  }
}

/// Cuts pieces between their ridges until they are within the finer tolerance; those that planes made, and so
/// are in shape, within the tolerance itself.
std::vector<Facets> Assembly::cut_finely(std::vector<Piece> pieces, double fineness) {
  std::optional<Measurer> fine;
  if (fineness < 1.0) {
    fine.emplace(*surface_, *graph_, MeasureRules{fineness * measurer_->tolerance()}, measurer_->context());
  }
  std::vector<Facets> done;
  for (Piece& piece : pieces) {
    piece.depth = 0;
  }
  while (!pieces.empty()) {
    measurer_->context().check();
    Piece piece = std::move(pieces.back());
    pieces.pop_back();
    if (!fine && !piece.by_plane) {
      done.push_back(std::move(piece.facets));
      continue;
    }
    Measurer& measurer = piece.by_plane ? *measurer_ : *fine;
    measurer.measure(piece.facets, {}, {}, measurement_);
    if (measurement_.concavity > measurer.tolerance()) {
      std::vector<Facets> children;
      if (piece.depth < deepest_fine_cut) {
        children = cutter_->cut(measurer, measurement_);
      }
      if (children.size() < 2 && piece.by_plane) {
        children = cutter_->split(measurer, measurement_, true);
      }
      if (children.size() > 1) {
        for (Facets& facets : children) {
          pieces.push_back({std::move(facets), piece.by_plane, piece.depth + 1});
        }
        continue;
      }
    }
    done.push_back(std::move(piece.facets));
  }
  return done;
}

PieceSets Assembly::piece_sets(std::vector<Facets> pieces, bool from_scratch) {
  std::sort(pieces.begin(), pieces.end(),
            [](const Facets& a, const Facets& b) { return a.front() < b.front(); });
  const PieceTest test{.pockets = pockets_ ? &*pockets_ : nullptr,
                       .from_scratch = from_scratch,
                       .wants_rays = settings_.volume_weight > 0.0};
  return {*measurer_, test, std::move(pieces)};
}

PartitionCost Assembly::cost() const {
  return {.volume = settings_.volume_weight, .border = settings_.border_weight, .unit_volume = unit_volume_};
}

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
