// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/segmentation.hpp"

#include <algorithm>
#include <array>

#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

/// Of efforts above 1 and of planes; measured in docs/design/segmentation.md.
constexpr double default_weight = 5.0;

}  // namespace

double volume_weight(const Options& options) {
  return options.volume_weight.value_or(options.effort > 1 || options.planes ? default_weight : 0.0);
}

std::string_view name(PartReason reason) {
  static constexpr std::array<std::string_view, 4> names{"component", "ridge", "split", "merged"};
  static_assert(names.size() == static_cast<std::size_t>(PartReason::merged) + 1);
  return names[static_cast<std::size_t>(reason)];
}

double Segmentation::max_concavity() const {
  double greatest = 0.0;
  for (const Part& p : parts) {
    greatest = std::max(greatest, p.concavity);
  }
  return greatest;
}

std::vector<std::uint32_t> polygon_labels(const mesh::Model& model, const Segmentation& segmentation) {
  std::vector<std::uint32_t> labels(model.polygon_count, no_index);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    if (model.polygon[f] < labels.size()) {
      labels[model.polygon[f]] = segmentation.part[f].value();
    }
  }
  return labels;
}

}  // namespace ridgecraft::segment
