// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/twin_pieces.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "prepare/symmetry/twins.hpp"
#include "unfold/energy/piece_cost.hpp"
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {
namespace {

/// Where no fold of a piece could be anywhere else it has one net in any case.
bool has_choices(const Patch& patch, const std::vector<std::uint32_t>& faces) {
  return std::any_of(faces.begin(), faces.end(),
                     [&](std::uint32_t f) {
                       return std::any_of(patch.frozen.begin() + 3 * f, patch.frozen.begin() + 3 * f + 3,
                                          [](std::uint8_t frozen) { return frozen == 0; });
                     }) &&
         faces.size() > 2;
}

/// A pair keeps equal by its mirror plane, if at all, and its borders may move together.
constexpr std::size_t fewest_kept_apart = 3;
/// In larger models equal pieces aren't looked for: nobody builds them, and there are thousands.
constexpr std::size_t most_faces_of_twins = 20'000;

/// Costs that differ by less than this share are equal but for rounding.
constexpr double same_cost = 1e-9;

/// Edges of the first of its kind where labels meet within this piece, ascending. Around it everything is cut
/// in any case, and within flat regions nothing is.
std::vector<EdgeId> borders_of(const mesh::Surface& surface, const Patch& patch, const TwinPiece& piece) {
  std::vector<EdgeId> own;
  for (const std::uint32_t f : piece.faces) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t twin = patch.twin[3 * f + k];
      if (twin != nothing && is_border_of_labels(patch, 3 * f + k) &&
          std::binary_search(piece.faces.begin(), piece.faces.end(), twin / 3)) {
        own.push_back(surface.edge(mesh::corner(patch.face[f], k)));
      }
    }
  }
  std::sort(own.begin(), own.end());
  std::vector<EdgeId> result;
  for (const auto& [original, edge] : piece.edges) {
    if (std::binary_search(own.begin(), own.end(), edge)) {
      result.push_back(original);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Twins that the model's author has divided in different ways, by colours or names, are of different kinds:
/// what is a good cut on one is none on the other. Edges are those of the first of each kind then; it may lie
/// as far from the others as two twins, which find_equal_pieces() judges at the end.
TwinPieces by_borders(const mesh::Surface& surface, const Patch& patch, std::vector<TwinPiece> kind) {
  std::map<std::vector<EdgeId>, std::vector<TwinPiece>> kinds;
  for (TwinPiece& piece : kind) {
    kinds[borders_of(surface, patch, piece)].push_back(std::move(piece));
  }
  TwinPieces result;
  for (auto& [borders, pieces] : kinds) {
    if (pieces.size() < 2) {
      continue;
    }
    std::map<EdgeId, EdgeId> to_first;
    for (const auto& [original, edge] : pieces[0].edges) {
      to_first[original] = edge;
    }
    for (TwinPiece& piece : pieces) {
      std::vector<std::pair<EdgeId, EdgeId>> edges;
      for (const auto& [original, edge] : piece.edges) {
        if (const auto found = to_first.find(original); found != to_first.end()) {
          edges.emplace_back(found->second, edge);
        }
      }
      piece.edges = std::move(edges);
    }
    result.push_back(std::move(pieces));
  }
  return result;
}

bool is_clean(const Patch& patch, const Folds& folds, const Room& room) {
  return all_fit(patch, folds, room) &&
         find_overlaps(lay_out(patch, folds), net_tolerance(patch.extent)).empty();
}

/// Carries trees over by the edges of twins; one table serves all of them.
class EdgeImages {
 public:
  explicit EdgeImages(const mesh::Surface& surface) : surface_(surface), image_(surface.edge_count()) {}

  [[nodiscard]] std::optional<Folds> carried_over_to(const Patch& first, const Folds& tree, const Patch& own,
                                                     const TwinPiece& twin) {
    for (const auto& [original, edge] : twin.edges) {
      image_[edge] = original;
    }
    std::optional<Folds> result = carried_over(surface_, first, tree, own, image_);
    for (const auto& [original, edge] : twin.edges) {
      image_[edge] = EdgeId();
    }
    return result;
  }
  [[nodiscard]] std::optional<Folds> carried_over_back(const Patch& own, const Folds& tree,
                                                       const Patch& first, const TwinPiece& twin) {
    for (const auto& [original, edge] : twin.edges) {
      image_[original] = edge;
    }
    std::optional<Folds> result = carried_over(surface_, own, tree, first, image_);
    for (const auto& [original, edge] : twin.edges) {
      image_[original] = EdgeId();
    }
    return result;
  }

 private:
  const mesh::Surface& surface_;
  IdVector<EdgeId, EdgeId> image_;
};

}  // namespace

TwinPieces find_twin_pieces(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                            const Context& context) {
  if (patch.size() > most_faces_of_twins) {
    return {};
  }
  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;
  std::erase_if(pieces, [&](const auto& faces) { return !has_choices(patch, faces); });
  std::vector<std::vector<FaceId>> bodies;
  for (std::vector<std::uint32_t>& faces : pieces) {
    std::sort(faces.begin(), faces.end());
    std::vector<FaceId>& body = bodies.emplace_back();
    for (const std::uint32_t f : faces) {
      body.push_back(patch.face[f]);
    }
  }
  TwinPieces result;
  for (std::vector<prepare::Twin>& kind : prepare::find_twins(surface, bodies, context)) {
    std::erase_if(kind, [](const prepare::Twin& twin) { return twin.deviation > equal_pieces_mm; });
    if (kind.size() < 2) {
      continue;
    }
    std::vector<TwinPiece> twins;
    for (prepare::Twin& twin : kind) {
      twins.push_back({std::move(pieces[twin.body]), std::move(twin.edges)});
    }
    for (std::vector<TwinPiece>& alike : by_borders(surface, patch, std::move(twins))) {
      result.push_back(std::move(alike));
    }
  }
  return result;
}

Patch with_twins_apart(const Patch& patch, const Folds& folds, const TwinPieces& twins) {
  Patch result = patch;
  const std::vector<std::uint32_t> piece = lay_out(patch, folds).piece;
  for (const std::vector<TwinPiece>& kind : twins) {
    if (kind.size() < fewest_kept_apart) {
      continue;
    }
    for (const TwinPiece& twin : kind) {
      for (const std::uint32_t f : twin.faces) {
        for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
          const std::uint32_t other = patch.twin[side];
          if (other != nothing && piece[other / 3] != piece[f]) {
            result.twin[side] = result.twin[other] = nothing;
          }
        }
      }
    }
  }
  return result;
}

Folds with_equal_twins(const NetProblem& problem, const Folds& folds, const TwinPieces& twins) {
  const Patch& patch = problem.patch;
  const Room& room = problem.room;
  const Weights& weights = problem.weights();
  Folds result = folds;
  if (twins.empty()) {
    return result;
  }
  EdgeImages images(problem.surface);
  for (const std::vector<TwinPiece>& kind : twins) {
    // Trees are laid on the first piece, where the best one is chosen, and from there on all others.
    const Patch first = sub_patch(patch, kind[0].faces);
    Folds best = sub_folds(patch, folds, kind[0].faces);
    double least = cost_of_piece(first, best, 1, weights);
    for (std::size_t i = 1; i < kind.size(); ++i) {
      const Folds tree = sub_folds(patch, folds, kind[i].faces);
      std::optional<Folds> copy =
          images.carried_over_back(sub_patch(patch, kind[i].faces), tree, first, kind[i]);
      if (copy && is_clean(first, *copy, room)) {
        if (const double cost = cost_of_piece(first, *copy, 1, weights); cost < (1.0 - same_cost) * least) {
          least = cost;
          best = std::move(*copy);
        }
      }
    }
    put_back(patch, kind[0].faces, best, result);
    for (std::size_t i = 1; i < kind.size(); ++i) {
      const Patch own = sub_patch(patch, kind[i].faces);
      const std::optional<Folds> copy = images.carried_over_to(first, best, own, kind[i]);
      if (copy && is_clean(own, *copy, room)) {
        put_back(patch, kind[i].faces, *copy, result);
      }
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
