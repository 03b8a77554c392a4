// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/parts/options.hpp"

namespace ridgecraft::segment {
namespace {

/// Of efforts above 1 and of planes; measured in docs/design/segmentation.md.
constexpr double default_weight = 5.0;

}  // namespace

double volume_weight(const Options& options) {
  return options.volume_weight.value_or(options.effort > 1 || options.planes ? default_weight : 0.0);
}

}  // namespace ridgecraft::segment
