// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/hull_union.hpp"

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

}  // namespace ridgecraft::segment
