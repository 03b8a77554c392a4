// SPDX-License-Identifier: GPL-3.0-or-later
// The valleys of one part at a time: known ones where they surely hold there, else searched.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/part_graph.hpp"
#include "segment/concavity/valley_cache.hpp"
#include "segment/concavity/valley_search.hpp"

namespace ridgecraft::segment {

/// Finds valleys on the part that a graph shows, and remembers them for the parts of that part.
class Valleys {
 public:
  /// The graph must outlive this.
  explicit Valleys(const PartGraph& part);
  Valleys(const Valleys&) = delete;
  Valleys& operator=(const Valleys&) = delete;

  /// To be called when the graph shows another part. O(its facets).
  void select();

  /// The valley between two vertices; without steps where there is none. With `from_scratch` known ones serve
  /// only where they were searched on this very part; else also where they surely are still the shortest
  /// (docs/design/segmentation.md, "Known valleys"). `tolerance`: what counts as deep. Valid until the next
  /// call.
  [[nodiscard]] Valley find(std::uint32_t from, std::uint32_t to, double tolerance, bool from_scratch);

  /// Lengths along a valley of at least 3 vertices from its two ends to where it is cut
  /// (docs/design/segmentation.md, "Separators"). `capped`: concavity of each vertex with the cap.
  [[nodiscard]] std::array<double, 2> sub_valleys(const Valley& valley, std::span<const double> capped,
                                                  double tolerance);

  [[nodiscard]] ValleySearch& search() { return search_; }

 private:
  friend class ValleyLoan;

  [[nodiscard]] bool survives(const Valley& valley) const;
  void project(std::span<const Step> steps);

  const PartGraph* part_;
  ValleySearch search_;
  ValleyCache own_;
  ValleyCache* found_ = &own_;           ///< used and added to
  const ValleyCache* others_ = nullptr;  ///< used
  std::uint64_t signature_ = 0;          ///< of the part that the graph shows: a hash of its facets
  std::vector<Step> steps_;
  std::vector<Vec3> points_;
  std::vector<Vec2> chain_;
  std::vector<double> concavity_;
};

/// While this lives, valleys are found among those of `found`, which new ones are added to, and of `others`,
/// which may be null and isn't changed. Both must outlive it.
class ValleyLoan {
 public:
  ValleyLoan(Valleys& valleys, ValleyCache& found, const ValleyCache* others = nullptr)
      : valleys_(&valleys), found_before_(valleys.found_), others_before_(valleys.others_) {
    valleys.found_ = &found;
    valleys.others_ = others;
  }
  ~ValleyLoan() {
    valleys_->found_ = found_before_;
    valleys_->others_ = others_before_;
  }
  ValleyLoan(const ValleyLoan&) = delete;
  ValleyLoan& operator=(const ValleyLoan&) = delete;

 private:
  Valleys* valleys_;
  ValleyCache* found_before_;
  const ValleyCache* others_before_;
};

}  // namespace ridgecraft::segment
