// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/partition.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace ridgecraft::segment {
namespace {

/// Parts that one round tears up at most.
constexpr std::size_t most_torn = 4;
/// Rounds end when the sets that were measured have so many facets together, times the surface's: vessels of
/// a hundred thin pieces would take minutes, others need less than a tenth of it.
constexpr std::size_t most_work = 400;

}  // namespace

Partition::Partition(Measurer& measurer, const EdgeWeights& weights, const PartitionCost& cost,
                     PocketTest* pockets, MeasureMode mode, std::vector<Facets> pieces)
    : measurer_(&measurer),
      weights_(&weights),
      cost_(cost),
      pockets_(pockets),
      mode_(mode),
      pieces_(std::move(pieces)),
      hulls_(measurer.graph().surface().points) {
  for (const Facets& piece : pieces_) {
    facet_count_ += piece.size();
  }
  find_borders();
}

void Partition::find_borders() {
  const ScaledSurface& s = measurer_->graph().surface();
  std::vector<std::uint32_t> piece_of(s.facet_count(), none);
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    for (const std::uint32_t f : pieces_[p]) {
      piece_of[f] = p;
    }
  }
  beside_.assign(pieces_.size(), {});
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == none || piece_of[f] == none || piece_of[g] == none || piece_of[f] == piece_of[g]) {
        continue;
      }
      Border& b = beside_[piece_of[f]][piece_of[g]];
      b.length += weights_->length[3 * f + k];
      b.smoothness += weights_->smoothness[3 * f + k] * weights_->length[3 * f + k];
    }
  }
}

void Partition::gather(const Key& key) {
  facets_.clear();
  for (const std::uint32_t p : key) {
    facets_.insert(facets_.end(), pieces_[p].begin(), pieces_[p].end());
  }
  std::sort(facets_.begin(), facets_.end());
}

void Partition::describe(const Hull& hull, PieceSet& set) const {
  set.feasible = true;
  set.hull_vertices = hull.vertices;
  if (cost_.volume > 0.0) {
    set.rays = cast_rays(hull, measurer_->graph().surface().points);
  }
}

/// A single piece, or a set that was measured.
PieceSet& Partition::set_of(const Key& key) {
  const auto [at, fresh] = known_.try_emplace(key);
  if (fresh) {
    RIDGECRAFT_ASSERT(key.size() == 1);
    const ScaledSurface& s = measurer_->graph().surface();
    std::vector<std::uint32_t> ids;
    for (const std::uint32_t f : pieces_[key[0]]) {
      ids.insert(ids.end(), s.corners[f].begin(), s.corners[f].end());
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    hulls_.build(ids, hull_, flat_face_lift);
    describe(hull_, at->second);
  }
  return at->second;
}

/// The set that unites two feasible ones, measured when that wasn't done yet.
PieceSet& Partition::measured(const Key& key, const PieceSet& a, const PieceSet& b) {
  const auto [at, fresh] = known_.try_emplace(key);
  if (!fresh) {
    return at->second;
  }
  std::vector<std::uint32_t> ids;
  if (mode_ != MeasureMode::test_scratch) {
    std::set_union(a.hull_vertices.begin(), a.hull_vertices.end(), b.hull_vertices.begin(),
                   b.hull_vertices.end(), std::back_inserter(ids));
  }
  gather(key);
  work_ += facets_.size();
  measurer_->measure(facets_, ids, mode_, measurement_);
  if (!measurement_.stopped && (pockets_ == nullptr || !pockets_->has_pocket(measurement_.hull))) {
    describe(measurement_.hull, at->second);
  }
  return at->second;
}

double Partition::cost_of(const Groups& groups) const {
  double sum = 0.0;
  for (const Group& g : groups) {
    if (g.pieces.empty()) {
      continue;
    }
    sum += 1.0;
    for (const auto& [other, border] : g.beside) {
      sum += 0.5 * cost_.border * border.smoothness;
    }
  }
  double covered = 0.0;
  std::vector<RaySpan> spans;
  for (const std::vector<Slab>& ray : cover_) {
    spans.clear();
    for (const Slab& slab : ray) {
      spans.push_back(slab.span);
    }
    covered += union_length(spans);
  }
  return sum + cost_.volume * covered * volume_per_length() / cost_.unit_volume;
}

void Partition::fill_cover(const Groups& groups) {
  cover_.assign(cost_.volume > 0.0 ? ray_count : 0, {});
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    for (const RaySpan& span : groups[g].set->rays) {
      cover_[span.ray].push_back({g, span});
    }
  }
}

/// By how much the union of all hulls grows when two groups become one set.
double Partition::added_volume(const PieceSet& set, std::uint32_t g, std::uint32_t h) const {
  double added = 0.0;
  std::vector<RaySpan> before;
  std::vector<RaySpan> after;
  for (const RaySpan& span : set.rays) {
    before.clear();
    after.assign(1, span);
    for (const Slab& slab : cover_[span.ray]) {
      before.push_back(slab.span);
      if (slab.group != g && slab.group != h) {
        after.push_back(slab.span);
      }
    }
    added += union_length(after) - union_length(before);
  }
  return added * volume_per_length();
}

Partition::Groups Partition::groups_of(const std::vector<Key>& keys) {
  Groups groups(keys.size());
  std::vector<std::uint32_t> group_of(pieces_.size(), none);
  for (std::uint32_t g = 0; g < keys.size(); ++g) {
    groups[g].pieces = keys[g];
    groups[g].set = &set_of(keys[g]);
    for (const std::uint32_t p : keys[g]) {
      group_of[p] = g;
    }
  }
  for (std::uint32_t g = 0; g < keys.size(); ++g) {
    for (const std::uint32_t p : keys[g]) {
      for (const auto& [q, border] : beside_[p]) {
        const std::uint32_t h = group_of[q];
        if (h != g) {
          groups[g].beside[h].length += border.length;
          groups[g].beside[h].smoothness += border.smoothness;
        }
      }
    }
  }
  return groups;
}

Partition::Key Partition::united(const Key& a, const Key& b) {
  Key key;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(key));
  return key;
}

void Partition::unite(Groups& groups, std::uint32_t g, std::uint32_t h, Key key, PieceSet& set) {
  if (!cover_.empty()) {
    for (const RaySpan& span : set.rays) {
      auto& slabs = cover_[span.ray];
      std::erase_if(slabs, [&](const Slab& slab) { return slab.group == g || slab.group == h; });
      slabs.push_back({g, span});
    }
  }
  groups[g].pieces = std::move(key);
  groups[g].set = &set;
  groups[h].pieces.clear();
  groups[g].beside.erase(h);
  for (const auto& [other, border] : groups[h].beside) {
    if (other != g) {
      Border& b = groups[g].beside[other];
      b.length += border.length;
      b.smoothness += border.smoothness;
      groups[other].beside[g] = b;
      groups[other].beside.erase(h);
    }
  }
  groups[h].beside.clear();
}

void Partition::join(Groups& groups, double noise, Random& random) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> open;
  const auto consider = [&](std::uint32_t g, std::uint32_t h) {
    const Border& b = groups[g].beside.at(h);
    const double mean = b.length > 0.0 ? b.smoothness / b.length : 0.0;
    open[std::minmax(g, h)] = mean + (noise > 0.0 ? noise * random.unit() : 0.0);
  };
  fill_cover(groups);
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    for (const auto& [h, border] : groups[g].beside) {
      if (g < h) {
        consider(g, h);
      }
    }
  }
  while (!open.empty()) {
    measurer_->context().check();
    const auto best = std::max_element(open.begin(), open.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto [g, h] = best->first;
    open.erase(best);
    Key key = united(groups[g].pieces, groups[h].pieces);
    PieceSet& set = measured(key, *groups[g].set, *groups[h].set);
    if (!set.feasible) {
      continue;
    }
    double gain = at_any_cost_ ? std::numeric_limits<double>::infinity()
                               : 1.0 + cost_.border * groups[g].beside.at(h).smoothness;
    if (!at_any_cost_ && cost_.volume > 0.0) {
      gain -= cost_.volume * added_volume(set, g, h) / cost_.unit_volume;
    }
    if (gain <= 0.0) {
      continue;
    }
    for (const auto& [other, border] : groups[h].beside) {
      open.erase(std::minmax(other, h));
    }
    unite(groups, g, h, std::move(key), set);
    for (const auto& [other, border] : groups[g].beside) {
      consider(std::min(g, other), std::max(g, other));
    }
  }
}

/// The parts, of which some that lie together are torn into their pieces.
std::vector<Partition::Key> Partition::torn(const std::vector<Key>& parts, Random& random) {
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
  std::vector<Key> keys;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    if (!is_torn[g]) {
      keys.push_back(parts[g]);
      continue;
    }
    for (const std::uint32_t p : parts[g]) {
      keys.push_back({p});
    }
  }
  return keys;
}

std::vector<Partition::Key> Partition::keys_of(const Groups& groups) {
  std::vector<Key> keys;
  for (const Group& g : groups) {
    if (!g.pieces.empty()) {
      keys.push_back(g.pieces);
    }
  }
  return keys;
}

std::vector<Partition::Key> Partition::single_pieces() const {
  std::vector<Key> keys;
  for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
    keys.push_back({p});
  }
  return keys;
}

std::vector<AssembledPart> Partition::parts_of(const std::vector<Key>& keys) {
  std::vector<AssembledPart> parts;
  for (const Key& key : keys) {
    gather(key);
    parts.push_back({facets_, key.size() > 1});
  }
  std::sort(parts.begin(), parts.end(), [](const AssembledPart& a, const AssembledPart& b) {
    return a.facets.front() < b.facets.front();
  });
  return parts;
}

std::vector<AssembledPart> Partition::join_all() {
  Random unused(1);
  Groups groups = groups_of(single_pieces());
  at_any_cost_ = true;
  join(groups, 0.0, unused);
  at_any_cost_ = false;
  least_ = cost_of(groups);
  return parts_of(keys_of(groups));
}

std::vector<AssembledPart> Partition::run(unsigned rounds, double noise, Random& random) {
  Groups groups = groups_of(single_pieces());
  join(groups, 0.0, random);
  std::vector<Key> best = keys_of(groups);
  least_ = cost_of(groups);
  for (unsigned round = 0; round < rounds && best.size() > 1 && work_ < most_work * facet_count_; ++round) {
    Groups tried = groups_of(torn(best, random));
    join(tried, noise, random);
    const double found = cost_of(tried);
    if (found <= least_) {
      least_ = found;
      best = keys_of(tried);
    }
  }
  return parts_of(best);
}

}  // namespace ridgecraft::segment
