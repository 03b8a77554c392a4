// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/parts/segmentation.hpp"

#include <algorithm>

namespace ridgecraft::segment {

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
