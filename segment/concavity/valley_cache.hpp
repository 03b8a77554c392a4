// SPDX-License-Identifier: GPL-3.0-or-later
// Valleys found earlier in the run (docs/design/segmentation.md, "Known valleys"): parts of a part often have
// the same ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/valley_search.hpp"

namespace ridgecraft::segment {

/// A valley with what doesn't depend on the part: its path, length and uncapped concavity.
struct Valley {
  std::span<const Step> steps;
  std::span<const double> concavity;  ///< of each step, without the cap
  double length = 0.0;
  double greatest = 0.0;   ///< of concavity
  std::uint64_t part = 0;  ///< signature of the part on which it was searched
};

/// Open addressing over flat pools. Spans are valid until the next store().
class ValleyCache {
 public:
  ValleyCache();
  /// Whether there is a valley between the two vertices; fills `out`.
  [[nodiscard]] bool find(std::uint32_t from, std::uint32_t to, Valley& out) const;
  /// Keeps a copy, in place of an earlier one between the same vertices.
  void store(std::uint32_t from, std::uint32_t to, const Valley& valley);
  /// Takes all valleys of another one over, in place of those between the same vertices.
  void absorb(const ValleyCache& other);

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::size_t first = 0;
    std::uint32_t count = 0;  ///< 0: free
    double length = 0.0;
    double greatest = 0.0;
    std::uint64_t part = 0;
  };

  [[nodiscard]] std::size_t slot(std::uint64_t key) const;
  void grow();

  std::vector<Entry> table_;
  std::size_t used_ = 0;
  std::vector<Step> steps_;
  std::vector<double> concavity_;
};

}  // namespace ridgecraft::segment
