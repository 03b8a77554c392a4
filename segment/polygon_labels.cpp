// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/polygon_labels.hpp"

namespace ridgecraft::segment {

std::vector<std::uint32_t> polygon_labels(const mesh::Model& model, const Segmentation& segmentation) {
  std::vector<std::uint32_t> labels(model.polygon_count, no_part);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    if (model.polygon[f] < labels.size()) {
      labels[model.polygon[f]] = segmentation.part[f].value();
    }
  }
  return labels;
}

}  // namespace ridgecraft::segment
