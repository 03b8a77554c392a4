// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/partition.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "base/no_index.hpp"
#include "base/random.hpp"

namespace ridgecraft::segment {

void HullUnion::start(bool with_rays) {
  slabs_.assign(with_rays ? ray_count : 0, {});
}

void HullUnion::add(std::uint32_t group, std::span<const RaySpan> rays) {
  for (const RaySpan& span : rays) {
    slabs_[span.ray].push_back({group, span});
  }
}

void HullUnion::unite(std::uint32_t g, std::uint32_t h, std::span<const RaySpan> rays) {
  // Rays that miss the new hull miss those of the two groups, too.
  for (const RaySpan& span : rays) {
    auto& slabs = slabs_[span.ray];
    std::erase_if(slabs, [&](const Slab& slab) { return slab.group == g || slab.group == h; });
    slabs.push_back({g, span});
  }
}

double HullUnion::length() const {
  double sum = 0.0;
  std::vector<RaySpan> spans;
  for (const std::vector<Slab>& ray : slabs_) {
    spans.clear();
    for (const Slab& slab : ray) {
      spans.push_back(slab.span);
    }
    sum += union_length(spans);
  }
  return sum;
}

double HullUnion::added_length(std::uint32_t g, std::uint32_t h, std::span<const RaySpan> rays) const {
  double added = 0.0;
  std::vector<RaySpan> before;
  std::vector<RaySpan> after;
  for (const RaySpan& span : rays) {
    before.clear();
    after.assign(1, span);
    for (const Slab& slab : slabs_[span.ray]) {
      before.push_back(slab.span);
      if (slab.group != g && slab.group != h) {
        after.push_back(slab.span);
      }
    }
    added += union_length(after) - union_length(before);
  }
  return added;
}

PieceSets::PieceSets(Measurer& measurer, const PieceTest& test, std::vector<Facets> pieces)
    : measurer_(&measurer),
      test_(test),
      pieces_(std::move(pieces)),
      hulls_(measurer.graph().surface().points) {
  for (const Facets& piece : pieces_) {
    facet_count_ += piece.size();
  }
}

void PieceSets::describe(const Hull& hull, PieceSet& set) const {
  set.feasible = true;
  set.hull_vertices = hull.vertices;
  if (test_.wants_rays) {
    set.rays = cast_rays(hull, measurer_->graph().surface().points);
  }
}

std::uint32_t PieceSets::single(std::uint32_t piece) {
  const auto [at, fresh] = number_.try_emplace({piece}, static_cast<std::uint32_t>(sets_.size()));
  if (fresh) {
    PieceSet& set = sets_.emplace_back();
    set.pieces = {piece};
    const ScaledSurface& s = measurer_->graph().surface();
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t f : pieces_[piece]) {
      vertices.insert(vertices.end(), s.corners[f].begin(), s.corners[f].end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Hull hull;
    hulls_.build(vertices, hull, flat_face_lift);
    describe(hull, set);
  }
  return at->second;
}

std::uint32_t PieceSets::united(std::uint32_t one, std::uint32_t other) {
  const PieceSet& a = sets_[one];
  const PieceSet& b = sets_[other];
  std::vector<std::uint32_t> pieces;
  std::merge(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(), std::back_inserter(pieces));
  const auto [at, fresh] = number_.try_emplace(pieces, static_cast<std::uint32_t>(sets_.size()));
  if (!fresh) {
    return at->second;
  }
  std::vector<std::uint32_t> hull_points;
  if (!test_.from_scratch) {
    std::set_union(a.hull_vertices.begin(), a.hull_vertices.end(), b.hull_vertices.begin(),
                   b.hull_vertices.end(), std::back_inserter(hull_points));
  }
  PieceSet& set = sets_.emplace_back();
  set.pieces = std::move(pieces);
  const Facets together = facets(at->second);
  measured_facets_ += together.size();
  measurer_->measure(together, hull_points, {.stop_at_first = true, .from_scratch = test_.from_scratch},
                     measurement_);
  if (!measurement_.stopped && (test_.pockets == nullptr || !test_.pockets->has_pocket(measurement_.hull))) {
    describe(measurement_.hull, set);
  }
  return at->second;
}

Facets PieceSets::facets(std::uint32_t set) const {
  Facets facets;
  for (const std::uint32_t p : sets_[set].pieces) {
    facets.insert(facets.end(), pieces_[p].begin(), pieces_[p].end());
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

namespace {

/// Parts that one round tears up at most.
constexpr std::size_t most_torn = 4;
/// Rounds end early when this many times the facets of the surface have been measured, all measured sets of
/// pieces together: vessels of a hundred thin pieces would take minutes; others need less than a tenth of it.
constexpr double most_work = 400.0;

}  // namespace

Partition::Partition(PieceSets& sets, const EdgeWeights& weights, const PartitionCost& cost)
    : sets_(&sets), weights_(&weights), cost_(cost) {
  find_borders();
}

void Partition::find_borders() {
  const ScaledSurface& s = sets_->surface();
  std::vector<std::uint32_t> piece_of(s.facet_count(), no_index);
  for (std::uint32_t p = 0; p < sets_->piece_count(); ++p) {
    for (const std::uint32_t f : sets_->piece(p)) {
      piece_of[f] = p;
    }
  }
  beside_.assign(sets_->piece_count(), {});
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g != no_index && piece_of[f] != no_index && piece_of[g] != no_index && piece_of[f] != piece_of[g]) {
        beside_[piece_of[f]][piece_of[g]].add_side(s, *weights_, std::size_t{3} * f + k);
      }
    }
  }
}

double Partition::cost_of(const Groups& groups) const {
  double sum = 0.0;
  for (const Group& g : groups) {
    if (g.set == no_index) {
      continue;
    }
    sum += 1.0;
    for (const auto& [other, border] : g.beside) {
      sum += 0.5 * cost_.border * border.smoothness;
    }
  }
  return sum + cost_.volume * hulls_.length() * volume_per_length() / cost_.unit_volume;
}

/// What the partition costs less when two groups become one.
double Partition::gain_of(const Groups& groups, const Pair& pair, std::uint32_t united) const {
  const auto [g, h] = pair;
  double gain = 1.0 + cost_.border * groups[g].beside.at(h).smoothness;
  if (cost_.volume > 0.0) {
    const double added = hulls_.added_length(g, h, (*sets_)[united].rays) * volume_per_length();
    gain -= cost_.volume * added / cost_.unit_volume;
  }
  return gain;
}

Partition::Groups Partition::groups_of(const std::vector<std::uint32_t>& sets) const {
  Groups groups(sets.size());
  std::vector<std::uint32_t> group_of(sets_->piece_count(), no_index);
  for (std::uint32_t g = 0; g < sets.size(); ++g) {
    groups[g].set = sets[g];
    for (const std::uint32_t p : (*sets_)[sets[g]].pieces) {
      group_of[p] = g;
    }
  }
  for (std::uint32_t g = 0; g < sets.size(); ++g) {
    for (const std::uint32_t p : (*sets_)[sets[g]].pieces) {
      for (const auto& [q, border] : beside_[p]) {
        if (const std::uint32_t h = group_of[q]; h != g) {
          groups[g].beside[h].add(border);
        }
      }
    }
  }
  return groups;
}

/// Pair: g, h; h goes into g.
void Partition::unite(Groups& groups, const Pair& pair, std::uint32_t united) {
  const auto [g, h] = pair;
  hulls_.unite(g, h, (*sets_)[united].rays);
  groups[g].set = united;
  groups[h].set = no_index;
  groups[g].beside.erase(h);
  for (const auto& [other, border] : std::exchange(groups[h].beside, {})) {
    if (other != g) {
      Border& b = groups[g].beside[other];
      b.add(border);
      groups[other].beside[g] = b;
      groups[other].beside.erase(h);
    }
  }
}

void Partition::join(Groups& groups, const Joining& joining) {
  PairQueue<double> waiting;  // the most convex borders first
  const auto consider = [&](std::uint32_t g, std::uint32_t h) {
    const double noise = joining.noise > 0.0 ? joining.noise * joining.random->unit() : 0.0;
    waiting.put(std::minmax(g, h), -(groups[g].beside.at(h).mean() + noise));
  };
  hulls_.start(cost_.volume > 0.0);
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    hulls_.add(g, (*sets_)[groups[g].set].rays);
    for (const auto& [h, border] : groups[g].beside) {
      if (g < h) {
        consider(g, h);
      }
    }
  }
  while (!waiting.empty()) {
    sets_->context().check();
    const Pair pair = waiting.take();
    const auto [g, h] = pair;
    const std::uint32_t united = sets_->united(groups[g].set, groups[h].set);
    if (!(*sets_)[united].feasible || !(joining.at_any_cost || gain_of(groups, pair, united) > 0.0)) {
      continue;
    }
    for (const auto& [other, border] : groups[h].beside) {
      waiting.drop(std::minmax(other, h));
    }
    unite(groups, pair, united);
    for (const auto& [other, border] : groups[g].beside) {
      consider(std::min(g, other), std::max(g, other));
    }
  }
}

/// The parts, of which some that lie together are torn into their pieces.
std::vector<std::uint32_t> Partition::torn(const std::vector<std::uint32_t>& parts, Random& random) {
  const auto below = [&](std::size_t n) { return random.below(static_cast<std::uint32_t>(n)); };
  const Groups now = groups_of(parts);
  std::vector<std::uint32_t> chosen{below(parts.size())};
  const std::size_t wanted = 2 + below(most_torn - 1);
  std::vector<bool> is_torn(parts.size(), false);
  is_torn[chosen[0]] = true;
  for (std::size_t i = 0; i < chosen.size() && chosen.size() < wanted; ++i) {
    std::vector<std::uint32_t> around;
    for (const auto& [h, border] : now[chosen[i]].beside) {
      around.push_back(h);
    }
    for (std::size_t j = around.size(); j > 1; --j) {
      std::swap(around[j - 1], around[below(j)]);
    }
    for (const std::uint32_t h : around) {
      if (!is_torn[h] && chosen.size() < wanted) {
        is_torn[h] = true;
        chosen.push_back(h);
      }
    }
  }
  std::vector<std::uint32_t> sets;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    if (!is_torn[g]) {
      sets.push_back(parts[g]);
      continue;
    }
    for (const std::uint32_t p : (*sets_)[parts[g]].pieces) {
      sets.push_back(sets_->single(p));
    }
  }
  return sets;
}

std::vector<std::uint32_t> Partition::sets_of(const Groups& groups) {
  std::vector<std::uint32_t> sets;
  for (const Group& g : groups) {
    if (g.set != no_index) {
      sets.push_back(g.set);
    }
  }
  return sets;
}

std::vector<std::uint32_t> Partition::single_pieces() {
  std::vector<std::uint32_t> sets;
  for (std::uint32_t p = 0; p < sets_->piece_count(); ++p) {
    sets.push_back(sets_->single(p));
  }
  return sets;
}

std::vector<AssembledPart> Partition::parts_of(const std::vector<std::uint32_t>& sets) const {
  std::vector<AssembledPart> parts;
  for (const std::uint32_t set : sets) {
    parts.push_back({sets_->facets(set), (*sets_)[set].pieces.size() > 1});
  }
  std::sort(parts.begin(), parts.end(), [](const AssembledPart& a, const AssembledPart& b) {
    return a.facets.front() < b.facets.front();
  });
  return parts;
}

Assembled Partition::join_pieces(bool at_any_cost) {
  Groups groups = groups_of(single_pieces());
  join(groups, {.at_any_cost = at_any_cost});
  return {parts_of(sets_of(groups)), cost_of(groups)};
}

Assembled Partition::search(unsigned rounds, double noise, Random& random) {
  Groups groups = groups_of(single_pieces());
  join(groups, {});
  std::vector<std::uint32_t> best = sets_of(groups);
  double least = cost_of(groups);
  for (unsigned round = 0; round < rounds && best.size() > 1 && sets_->work() < most_work; ++round) {
    Groups tried = groups_of(torn(best, random));
    join(tried, {.noise = noise, .random = &random});
    if (const double found = cost_of(tried); found <= least) {
      least = found;
      best = sets_of(tried);
    }
  }
  return {parts_of(best), least};
}

}  // namespace ridgecraft::segment
