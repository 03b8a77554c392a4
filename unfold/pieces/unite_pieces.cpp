// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/unite_pieces.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/piece_borders.hpp"
#include "unfold/search/one_piece.hpp"

namespace ridgecraft::unfold {
namespace {

/// Faces times iterations of all unions that are tried: about a second.
constexpr std::uint64_t unions_cost = 4'000'000;
/// Larger unions take too long for an attempt.
constexpr std::size_t most_united_faces = 2000;

using Faces = std::vector<std::uint32_t>;

}  // namespace

Folds unite_pieces(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                   std::uint64_t seed, const Context& context) {
  Folds result = folds;
  Random random(seed);
  std::set<Faces> failed;
  OnePieceSearch search;
  search.tolerance = tolerance;
  std::uint64_t cost = 0;
  for (bool again = true; again;) {
    again = false;
    const Layout layout = lay_out(patch, result);
    for (const PieceBorder& border : piece_borders(patch, layout.piece)) {
      if (cost >= unions_cost || context.out_of_time()) {
        return result;
      }
      Faces faces = layout.faces[border.a];
      faces.insert(faces.end(), layout.faces[border.b].begin(), layout.faces[border.b].end());
      std::sort(faces.begin(), faces.end());
      if (faces.size() > most_united_faces || failed.contains(faces)) {
        continue;
      }
      const Patch both = sub_patch(patch, faces);
      if (least_pieces(both, room) == 1) {
        const OnePieceFound found = find_one_piece(both, room, search, random.next(), context);
        cost += found.cost;
        if (found.tree) {
          put_back(patch, faces, *found.tree, result);
          again = true;
          break;
        }
      }
      failed.insert(std::move(faces));
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
