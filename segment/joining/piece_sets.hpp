// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of pieces, and which of them may be one part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "segment/concavity/measure.hpp"
#include "segment/hull/hull_rays.hpp"
#include "segment/hull/pocket_test.hpp"

namespace ridgecraft::segment {

/// A set of pieces that was measured.
struct PieceSet {
  std::vector<std::uint32_t> pieces;  ///< ascending
  bool feasible = false;              ///< may be one part; else nothing more is known
  std::vector<std::uint32_t> hull_vertices;
  std::vector<RaySpan> rays;  ///< through its hull, where they are wanted
};

/// What decides whether a set may be one part.
struct PieceTest {
  PocketTest* pockets = nullptr;  ///< parts mustn't have any; null: they may
  bool from_scratch = false;      ///< how sets are measured (measure.hpp)
  bool wants_rays = false;
};

/// Pieces and all sets of them that were measured: known from then on, so many orders of joining share their
/// tests.
class PieceSets {
 public:
  /// The measurer and the test's pockets must outlive this. Each piece is connected, feasible, ascending.
  PieceSets(Measurer& measurer, const PieceTest& test, std::vector<Facets> pieces);

  [[nodiscard]] std::size_t piece_count() const { return pieces_.size(); }
  [[nodiscard]] const Facets& piece(std::uint32_t piece) const { return pieces_[piece]; }
  /// Of all sets; references hold as long as this lives.
  [[nodiscard]] const PieceSet& operator[](std::uint32_t set) const { return sets_[set]; }

  /// Number of the set of a single piece.
  [[nodiscard]] std::uint32_t single(std::uint32_t piece);
  /// Number of the set that unites two feasible ones without a common piece. Measured when that wasn't done
  /// yet.
  [[nodiscard]] std::uint32_t united(std::uint32_t one, std::uint32_t other);
  /// Facets of a set, ascending.
  [[nodiscard]] Facets facets(std::uint32_t set) const;

  /// Facets of all sets that were measured, as a share of those of all pieces.
  [[nodiscard]] double work() const {
    return static_cast<double>(measured_facets_) / static_cast<double>(facet_count_);
  }
  [[nodiscard]] const ScaledSurface& surface() const { return measurer_->graph().surface(); }
  [[nodiscard]] const Context& context() const { return measurer_->context(); }

 private:
  void describe(const Hull& hull, PieceSet& set) const;

  Measurer* measurer_;
  PieceTest test_;
  std::vector<Facets> pieces_;
  std::deque<PieceSet> sets_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> number_;  ///< of the set of these pieces
  HullBuilder hulls_;
  Measurement measurement_;
  std::size_t facet_count_ = 0;  ///< of all pieces
  std::size_t measured_facets_ = 0;
};

}  // namespace ridgecraft::segment
