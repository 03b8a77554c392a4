// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that overlap on too few pages are moved until none do: what finds room where filling pages one shape
// after the other has none left.
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "export/packing/packing_fill.hpp"

namespace ridgecraft::paper {

/// Guided local search over overlaps (Egeblad, Nielsen and Odgaard 2007; Umetani et al. 2009): a shape that
/// overlaps others goes where it overlaps least, over all pages and turns; pairs that stay in each other's
/// way weigh more and more. Places are sampled and then improved step by step.
class PackingSeparation {
 public:
  PackingSeparation(const PackingFill& fill, Random& random, const Context& context);

  /// Moves the shapes, all of which lie on `pages` pages, until no two are too near each other, or the work
  /// (runs of cells looked at) is used up; whether it succeeded.
  [[nodiscard]] bool run(std::vector<Place>& places, std::uint32_t pages, std::uint64_t most_work);

 private:
  struct Candidate {
    Place place;
    std::int64_t cost = INT64_MAX;
  };
  void weigh(std::uint32_t shape, const std::vector<Place>& places);
  [[nodiscard]] std::int64_t cost(const Raster& raster, const Place& place, std::size_t runs,
                                  std::int64_t limit);
  [[nodiscard]] Place random_place(std::uint32_t shape, std::uint32_t pages);
  void improve(std::uint32_t shape, Candidate& candidate);
  void relocate(std::uint32_t shape, std::vector<Place>& places, std::uint32_t pages);
  [[nodiscard]] std::uint32_t overlap(std::uint32_t a, std::uint32_t b, const std::vector<Place>& places);
  [[nodiscard]] bool measure(const std::vector<Place>& places);
  void raise_weights();
  [[nodiscard]] std::uint64_t allowed(std::uint64_t most_work) const;
  [[nodiscard]] const std::vector<std::uint32_t>& padded_rows(std::uint32_t shape, std::uint32_t turn);
  [[nodiscard]] Spot last_spot(const Raster& raster) const;

  const PackingFill& fill_;
  Random& random_;
  const Context& context_;
  std::uint64_t work_ = 0;
  std::uint64_t least_overlap_ = 0;  ///< met so far, cells
  std::size_t count_;
  std::vector<std::uint32_t> weight_;               ///< of each pair of shapes
  std::vector<std::uint32_t> overlap_;              ///< of each pair, cells
  std::vector<std::vector<std::int32_t>> covered_;  ///< of each page, row by row: weights left of a column
  std::vector<std::vector<std::vector<std::uint32_t>>> padded_rows_;  ///< where rows begin, by shape and turn
};

}  // namespace ridgecraft::paper
