// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/symmetry/seen_edges.hpp"

#include <cmath>

namespace ridgecraft::prepare {
namespace {

/// 0.1 degrees, as in prepare/prepared/panels.hpp.
constexpr double unseen_fold = 0.0017453;

}  // namespace

IdVector<EdgeId, double> seen_lengths(const mesh::Surface& surface) {
  IdVector<EdgeId, double> seen(surface.edge_count(), 0.0);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    seen[e] = std::abs(surface.fold_angle(e)) > unseen_fold ? surface.length(e) : 0.0;
  }
  return seen;
}

double length_with_image(const IdVector<EdgeId, double>& seen, const IdVector<EdgeId, EdgeId>& images) {
  double length = 0.0;
  for (const EdgeId e : ids<EdgeId>(seen.size())) {
    length += images[e].valid() ? seen[e] : 0.0;
  }
  return length;
}

}  // namespace ridgecraft::prepare
