// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/error.hpp"

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
                   Measurer& measurer, Cutter& cutter, const AssemblySettings& settings)
    : surface_(&surface),
      weights_(&weights),
      graph_(&graph),
      measurer_(&measurer),
      cutter_(&cutter),
      settings_(settings),
      planes_(surface, weights),
      unit_volume_(enclosed(surface)) {
  if (settings_.pockets) {
    if (!PocketTest::encloses(surface)) {
      throw Error(ErrorKind::unusable_mesh,
                  "pockets can't be found: the surface has border edges and encloses no solid");
    }
    pockets_.emplace(surface, measurer.tolerance());
  }
}

std::vector<AssembledPart> Assembly::assemble(const std::vector<Facets>& parts) {
  std::vector<AssembledPart> best;
  double least = INFINITY;
  for (const Attempt& attempt : settings_.attempts) {
    std::vector<Piece> pieces = cut_by_planes(parts, attempt);
    const bool by_plane =
        std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.by_plane; });
    if (attempt.planes && !by_plane && !best.empty()) {
      continue;  // the same as without planes, which was tried
    }
    Partition joiner = partition(cut_finely(std::move(pieces), attempt.fineness), MeasureMode::test);
    Random random(1);
    std::vector<AssembledPart> found =
        attempt.at_any_cost ? joiner.join_all() : joiner.run(attempt.rounds, settings_.noise, random);
    if (best.empty() || joiner.cost() < least) {
      best = std::move(found);
      least = joiner.cost();
    }
  }
  return best;
}

std::vector<AssembledPart> Assembly::join_from_scratch(std::vector<Facets> parts) {
  Random random(1);
  return partition(std::move(parts), MeasureMode::test_scratch).run(0, 0.0, random);
}

/// Sets of parts whose hulls lie in each other.
std::vector<std::vector<std::size_t>> Assembly::overlapping(const std::vector<Facets>& parts) {
  std::vector<std::size_t> parent(parts.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) {
      i = parent[i];
    }
    return i;
  };
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
      if (root(i) == root(j)) {
        continue;
      }
      both.clear();
      std::set_union(hull[i].begin(), hull[i].end(), hull[j].begin(), hull[j].end(),
                     std::back_inserter(both));
      const double shared = volume[i] + volume[j] - planes_.volume_of(both);
      if (shared > overlap_share * std::min(volume[i], volume[j])) {
        const std::size_t x = root(i);
        const std::size_t y = root(j);
        parent[std::max(x, y)] = std::min(x, y);
      }
    }
  }
  std::vector<std::vector<std::size_t>> sets(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sets[root(i)].push_back(i);
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
        measurer_->measure(piece.facets, {}, MeasureMode::split, measurement_);
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
    fine.emplace(*surface_, *graph_, fineness * measurer_->tolerance(), measurer_->context());
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
    measurer.measure(piece.facets, {}, MeasureMode::split, measurement_);
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

Partition Assembly::partition(std::vector<Facets> pieces, MeasureMode mode) {
  std::sort(pieces.begin(), pieces.end(),
            [](const Facets& a, const Facets& b) { return a.front() < b.front(); });
  PartitionCost cost;
  cost.volume = settings_.volume_weight;
  cost.border = settings_.border_weight;
  cost.unit_volume = unit_volume_;
  return {*measurer_, *weights_, cost, pockets_ ? &*pockets_ : nullptr, mode, std::move(pieces)};
}

}  // namespace ridgecraft::segment
