// SPDX-License-Identifier: GPL-3.0-or-later
// What cutting divided too far is put together: crumbs, then neighbours by the merge pass or by the attempts
// of more effort (docs/design/segmentation.md, "Merge pass"), which cut parts into smaller pieces, by planes
// too, and put these together again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/division.hpp"
#include "segment/cutting/plane_cut.hpp"
#include "segment/hull/pockets.hpp"
#include "segment/joining/partition.hpp"
#include "segment/surface/scaled_surface.hpp"
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

// The crumbs of a damaged surface join the parts that they touch (docs/design/segmentation.md, "Damaged
// models").

/// Puts parts into one of them; false, and nothing is changed, where they can't be one.
using UniteParts = std::function<bool(std::span<const std::uint32_t> parts, std::uint32_t into)>;

/// Small components that touch a larger one at a vertex join its part there, if `unite` allows it; what had
/// joined the crumb before comes along. Of several parts that which has the smallest facet at such a vertex
/// is asked first. `components`: of the whole surface. `parts`: the facets of each. Asks once
/// for each crumb and part at its vertices, and again in each further pass, of which there are as many as the
/// longest chain of crumbs has links.
void absorb_crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
                   const UniteParts& unite, const Context& context);

/// What joining works with, on one thread.
struct JoiningTools {
  Measurer* measurer;
  const EdgeWeights* weights;
  Assembly* assembly;    ///< null: the merge pass is all
  ValleyCache* valleys;  ///< known ones; those that are found are added
};

/// Joins parts that are within the tolerance to fewer that are, too. A part that comes out as it went in
/// keeps its reason.
[[nodiscard]] std::vector<PartTask> join_parts(std::vector<MeasuredPart> parts, const JoiningTools& tools);

/// The same parts as tasks.
[[nodiscard]] std::vector<PartTask> leave_parts(std::vector<MeasuredPart> parts);

struct Rejoined {
  std::vector<MeasuredPart> kept;
  std::vector<PartTask> changed;  ///< within the tolerance from scratch, but not known how far
};

/// Joins parts of which the last measurement divided some (their depth is above 0): these with each other and
/// with their neighbours, where the union is within the tolerance from scratch.
[[nodiscard]] Rejoined rejoin_divided(std::vector<MeasuredPart> parts, const JoiningTools& tools);

}  // namespace ridgecraft::segment
