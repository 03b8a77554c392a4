// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/turn_powers.hpp"

#include <utility>

#include "unfold/pieces/unit_images.hpp"

namespace ridgecraft::unfold {
namespace {

IdVector<EdgeId, EdgeId> inverse(const IdVector<EdgeId, EdgeId>& images) {
  IdVector<EdgeId, EdgeId> result(images.size());
  for (const EdgeId e : ids<EdgeId>(images.size())) {
    if (images[e].valid()) {
      result[images[e]] = e;
    }
  }
  return result;
}

}  // namespace

IdVector<EdgeId, EdgeId> repeated(const IdVector<EdgeId, EdgeId>& images, unsigned times) {
  IdVector<EdgeId, EdgeId> result(images.size());
  for (const EdgeId e : ids<EdgeId>(images.size())) {
    EdgeId at = e;
    for (unsigned i = 0; i < times && at.valid(); ++i) {
      at = images[at];
    }
    result[e] = at;
  }
  return result;
}

std::vector<TurnPower> powers_of(const prepare::PartialRotation& turn, const mesh::Surface& surface,
                                 const Patch& patch, std::span<const std::uint32_t> unit) {
  std::vector<TurnPower> powers;
  for (unsigned order = turn.order; order >= 2; --order) {
    if (turn.order % order == 0) {
      IdVector<EdgeId, EdgeId> edge = repeated(turn.edge, turn.order / order);
      std::vector<std::uint32_t> images = unit_images(surface, patch, unit, edge);
      IdVector<EdgeId, EdgeId> from = inverse(edge);
      powers.push_back({order, std::move(edge), std::move(from), std::move(images)});
    }
  }
  return powers;
}

}  // namespace ridgecraft::unfold
