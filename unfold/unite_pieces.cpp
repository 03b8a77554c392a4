// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/unite_pieces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "unfold/layout.hpp"
#include "unfold/one_piece.hpp"
#include "unfold/sub_patch.hpp"

namespace ridgecraft::unfold {
namespace {

/// Faces times iterations of all unions that are tried: about a second.
constexpr std::uint64_t unions_cost = 4'000'000;
/// Larger unions take too long for an attempt.
constexpr std::size_t most_faces = 2000;

using Faces = std::vector<std::uint32_t>;

double area_of(const Patch& patch, const Faces& faces) {
  double area = 0.0;
  for (const std::uint32_t f : faces) {
    const Triangle& t = patch.shape[f];
    area += 0.5 * cross(t[1] - t[0], t[2] - t[0]);
  }
  return area;
}

struct Pair {
  double area = 0.0;  ///< of the smaller piece
  double border = 0.0;
  Faces faces;  ///< of both
};

/// Neighbouring pieces, those with the smallest piece first.
std::vector<Pair> neighbours(const Patch& patch, const Folds& folds) {
  const Layout layout = lay_out(patch, folds);
  std::vector<double> area;
  for (const Faces& faces : layout.faces) {
    area.push_back(area_of(patch, faces));
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> border;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] == nothing) {
      continue;
    }
    const std::uint32_t a = layout.piece[side / 3];
    const std::uint32_t b = layout.piece[patch.twin[side] / 3];
    if (a < b) {
      border[{a, b}] += patch.length[side];
    }
  }
  std::vector<Pair> pairs;
  for (const auto& [ends, length] : border) {
    const auto [a, b] = ends;
    Pair pair{std::min(area[a], area[b]), length, layout.faces[a]};
    pair.faces.insert(pair.faces.end(), layout.faces[b].begin(), layout.faces[b].end());
    std::sort(pair.faces.begin(), pair.faces.end());
    pairs.push_back(std::move(pair));
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.area != b.area ? a.area < b.area : a.border > b.border;
  });
  return pairs;
}

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
    for (Pair& pair : neighbours(patch, result)) {
      if (cost >= unions_cost || context.out_of_time()) {
        return result;
      }
      if (pair.faces.size() > most_faces || failed.contains(pair.faces)) {
        continue;
      }
      const Patch both = sub_patch(patch, pair.faces);
      if (!too_large_for_one(both, room)) {
        const OnePieceFound found = find_one_piece(both, room, search, random.next(), context);
        cost += found.cost;
        if (found.tree) {
          put_back(patch, pair.faces, *found.tree, result);
          again = true;
          break;
        }
      }
      failed.insert(std::move(pair.faces));
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
