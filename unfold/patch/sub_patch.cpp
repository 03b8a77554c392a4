// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/sub_patch.hpp"

#include <algorithm>

namespace ridgecraft::unfold {
namespace {

/// Number of a face among ascending ones; nothing where it isn't there.
std::uint32_t place_among(std::span<const std::uint32_t> faces, std::uint32_t f) {
  const auto at = std::lower_bound(faces.begin(), faces.end(), f);
  return at != faces.end() && *at == f ? static_cast<std::uint32_t>(at - faces.begin()) : nothing;
}

}  // namespace

Patch sub_patch(const Patch& patch, std::span<const std::uint32_t> faces) {
  Patch sub;
  sub.extent = patch.extent;
  const std::size_t n = faces.size();
  sub.face.reserve(n);
  sub.shape.reserve(n);
  sub.twin.reserve(3 * n);
  sub.frozen.reserve(3 * n);
  sub.across.reserve(3 * n);
  sub.length.reserve(3 * n);
  sub.fold_angle.reserve(3 * n);
  sub.labels_meet.reserve(3 * n);
  for (const std::uint32_t f : faces) {
    sub.face.push_back(patch.face[f]);
    sub.shape.push_back(patch.shape[f]);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const std::uint32_t twin = patch.twin[side];
      const std::uint32_t g = twin == nothing ? nothing : place_among(faces, twin / 3);
      sub.twin.push_back(g == nothing ? nothing : 3 * g + twin % 3);
      sub.frozen.push_back(g == nothing ? std::uint8_t{0} : patch.frozen[side]);
      sub.across.push_back(patch.across[side]);
      sub.length.push_back(patch.length[side]);
      sub.fold_angle.push_back(patch.fold_angle[side]);
      sub.labels_meet.push_back(patch.labels_meet[side]);
    }
  }
  return sub;
}

Folds sub_folds(const Patch& patch, const Folds& folds, std::span<const std::uint32_t> faces) {
  Folds sub(3 * faces.size(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * faces[i] + k;
      if (folds[side] != 0 && place_among(faces, patch.twin[side] / 3) != nothing) {
        sub[3 * i + k] = 1;
      }
    }
  }
  return sub;
}

void put_back(const Patch& patch, std::span<const std::uint32_t> faces, const Folds& sub, Folds& folds) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * faces[i] + k;
      if (patch.twin[side] != nothing && place_among(faces, patch.twin[side] / 3) != nothing) {
        folds[side] = sub[3 * i + k];
      }
    }
  }
}

}  // namespace ridgecraft::unfold
