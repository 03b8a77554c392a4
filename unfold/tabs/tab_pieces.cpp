// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/tab_pieces.hpp"

#include <algorithm>

#include "unfold/check.hpp"
#include "unfold/search/layout.hpp"
#include "unfold/search/sub_patch.hpp"
#include "unfold/tabs/tab_search.hpp"

namespace ridgecraft::unfold {

namespace {

/// Below this there is no other tree worth looking at.
constexpr std::size_t smallest_piece = 4;
/// Faces beyond these bring no more trials.
constexpr double most_faces = 2000.0;

}  // namespace

Folds improve_tabs(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch,
                   const Folds& folds, const Room& room, const TabOptions& options, double tolerance,
                   std::uint64_t seed, const Context& context) {
  Folds result = folds;
  Random random(seed);
  for (std::vector<std::uint32_t>& faces : lay_out(patch, folds).faces) {
    const std::uint64_t own_seed = random.next();
    if (faces.size() < smallest_piece || context.out_of_time()) {
      continue;
    }
    std::sort(faces.begin(), faces.end());
    const Patch piece = sub_patch(patch, faces);
    Folds tree(3 * faces.size());
    for (std::size_t side = 0; side < tree.size(); ++side) {
      tree[side] = folds[3 * faces[side / 3] + side % 3];
    }
    TabSearch search;
    search.tolerance = tolerance;
    search.trials = static_cast<std::uint64_t>(options.trials_per_face *
                                               std::min(most_faces, static_cast<double>(faces.size())));
    if (room.sheet && all_fit(piece, tree, room)) {
      search.allowed = [&](const Folds& changed) { return all_fit(piece, changed, room); };
    }
    const TabSearchResult found =
        search_tabs(surface, panels, piece, tree, options, search, own_seed, context);
    // As everywhere: the search counts by small steps, only a fresh layout may call a net clean.
    if (found.tabs <= found.tabs_before || !find_overlaps(lay_out(piece, found.folds), tolerance).empty()) {
      continue;
    }
    for (std::size_t side = 0; side < tree.size(); ++side) {
      result[3 * faces[side / 3] + side % 3] = found.folds[side];
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
