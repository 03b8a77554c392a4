// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "segment/segment.hpp"

namespace ridgecraft::segment {

namespace {

/// Of efforts above 1 and of planes; measured in docs/segmentation.md.
constexpr double default_weight = 5.0;

}  // namespace

double volume_weight(const Options& options) {
  return options.volume_weight.value_or(options.effort > 1 || options.planes ? default_weight : 0.0);
}

std::string_view name(PartReason reason) {
  switch (reason) {
    case PartReason::component:
      return "component";
    case PartReason::ridge:
      return "ridge";
    case PartReason::split:
      return "split";
    case PartReason::merged:
      return "merged";
  }
  return "";
}

double Segmentation::max_concavity() const {
  double greatest = 0.0;
  for (const Part& p : parts) {
    greatest = std::max(greatest, p.concavity);
  }
  return greatest;
}

}  // namespace ridgecraft::segment
