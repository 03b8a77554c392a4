// SPDX-License-Identifier: GPL-3.0-or-later
// More effort: parts are cut into smaller pieces, by planes too, and the pieces put together again.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "segment/concavity/graph.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/division.hpp"
#include "segment/cutting/plane_cut.hpp"
#include "segment/hull/pockets.hpp"
#include "segment/joining/partition.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::segment {

/// One way to cut parts into pieces and to join these.
struct Attempt {
  /// Pieces are cut until they are within this share of the tolerance; 1 leaves the parts as they are.
  double fineness = 1.0;
  unsigned rounds = 0;       ///< of tearing some parts up and joining their pieces again
  bool planes = false;       ///< cut by planes where that saves more volume than the pieces are worth
  double plane_price = 1.0;  ///< times the price of volume while planes cut: more pieces to choose from
  bool at_any_cost = false;  ///< all joins that are possible: the merge pass
};

struct AssemblySettings {
  std::vector<Attempt> attempts;  ///< the cheapest result counts, the first of equal ones
  double volume_weight = 0.0;     ///< price of volume: as Options::volume_weight
  /// Price of borders: how many parts more may be spent to save border of the length of one ball radius along
  /// convex edges. Along concave edges, where borders belong, it counts for Theta (cutting/cut.hpp) of that.
  double border_weight = 0.0;
  double noise = 0.0;    ///< of the order in which pieces are joined, in shares of a part
  bool pockets = false;  ///< no part has a pocket (hull/pockets.hpp)
};

/// What more effort, planes and a price of volume buy; measured in docs/design/segmentation.md. Attempts with
/// planes come after those without.
[[nodiscard]] AssemblySettings assembly_settings(const Options& options);

/// Cuts and joins parts that are within the tolerance; what comes out is, too.
class Assembly {
 public:
  /// All must outlive this. Throws Error(unusable_mesh) when pockets are to be avoided and the surface has
  /// border edges: it encloses no solid.
  Assembly(const ScaledSurface& surface, const EdgeWeights& weights, const VertexGraph& graph,
           PartWorker& worker, const AssemblySettings& settings);

  /// Cuts parts into pieces and joins them. Parts ascend by smallest facet.
  [[nodiscard]] std::vector<AssembledPart> assemble(const std::vector<Facets>& parts);
  /// Joins parts where their union is within the tolerance when measured from scratch.
  [[nodiscard]] std::vector<AssembledPart> join_from_scratch(std::vector<Facets> parts);

 private:
  struct Piece {
    Facets facets;
    bool by_plane = false;
    int depth = 0;
  };

  [[nodiscard]] std::vector<std::vector<std::size_t>> overlapping(const std::vector<Facets>& parts);
  [[nodiscard]] bool is_hollow(std::span<const std::uint32_t> facets);
  [[nodiscard]] double piece_worth(const Attempt& attempt) const;
  [[nodiscard]] std::vector<Piece> cut_by_planes(std::vector<Facets> parts, const Attempt& attempt);
  void cut_further(std::vector<Piece> open, const Attempt& attempt, std::vector<Piece>& done);
  [[nodiscard]] std::vector<Facets> cut_finely(std::vector<Piece> pieces, double fineness);
  [[nodiscard]] PieceSets piece_sets(std::vector<Facets> pieces, bool from_scratch);
  [[nodiscard]] PartitionCost cost() const;

  const ScaledSurface* surface_;
  const EdgeWeights* weights_;
  const VertexGraph* graph_;
  Measurer* measurer_;
  Cutter* cutter_;
  AssemblySettings settings_;
  std::optional<PocketTest> pockets_;
  PlaneCutter planes_;
  double unit_volume_;  ///< that the surface encloses
  Measurement measurement_;
};

}  // namespace ridgecraft::segment
