// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/retried_pieces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "unfold/nets_of_uses.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::unfold {
namespace {

/// One piece as a surface of its own.
struct Alone {
  prepare::PartOf from;
  prepare::Panels panels;
  IdVector<FaceId, PartId> part;
  Options options;
};

Alone alone(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
            const Piece& piece) {
  Alone one{prepare::part_of(surface, piece.faces), {}, {}, options};
  one.panels = prepare::panels_of(panels, one.from.face);
  one.part = IdVector<FaceId, PartId>(one.from.face.size(), PartId(0));
  // Tabs follow when all pieces are there.
  one.options.tabs.wanted = false;
  one.options.twins = {};
  one.options.labels = {};
  // What was joined by hand may have more than the rules allow to a search.
  if (std::size_t& most = one.options.pieces.max_panels; most > 0) {
    std::set<PanelId> own;
    for (const FaceId f : piece.faces) {
      own.insert(panels.panel[f]);
    }
    most = std::max(most, own.size());
  }
  one.options.wishes = EdgeWishes(one.from.edge.size(), EdgeWish::none);
  for (const EdgeId e : ids<EdgeId>(options.wishes.empty() ? 0 : one.from.edge.size())) {
    one.options.wishes[e] = options.wishes[one.from.edge[e]];
  }
  return one;
}

/// Whether the two fold the same edges.
bool is_same(const Alone& one, const Nets& before, const Nets& found) {
  const auto edges = ids<EdgeId>(found.use.size());
  return std::all_of(edges.begin(), edges.end(), [&](EdgeId e) {
    return (found.use[e] == EdgeUse::fold) == (before.use[one.from.edge[e]] == EdgeUse::fold);
  });
}

/// The folds between flat regions, all of which could be cuts.
std::vector<EdgeId> folds_of(const Alone& one, const Nets& before) {
  std::vector<EdgeId> folds;
  for (const EdgeId e : ids<EdgeId>(one.from.edge.size())) {
    const auto [c, d] = one.from.surface.sides(e);
    if (d.valid() && before.use[one.from.edge[e]] == EdgeUse::fold &&
        one.panels.panel[mesh::face_of(c)] != one.panels.panel[mesh::face_of(d)] &&
        one.options.wishes[e] == EdgeWish::none) {
      folds.push_back(e);
    }
  }
  return folds;
}

/// Another net of the piece; none where none was found.
std::optional<Nets> another_net(Alone one, const Nets& before, const Context& context) {
  constexpr std::size_t most_tries = 8;
  std::vector<EdgeId> folds = folds_of(one, before);
  const EdgeWishes asked = one.options.wishes;
  Random random(context.seed);
  for (std::size_t tries = 0; tries < most_tries; ++tries) {
    Nets found = unfold(one.from.surface, one.panels, one.part, one.options, context);
    if (found.pieces.size() == 1 && !is_same(one, before, found)) {
      return found;
    }
    if (folds.empty()) {
      return std::nullopt;
    }
    // One fold after the other, each alone, is not to be one.
    std::swap(folds[random.below(static_cast<std::uint32_t>(folds.size()))], folds.back());
    one.options.wishes = asked;
    one.options.wishes[folds.back()] = EdgeWish::cut;
    folds.pop_back();
  }
  return std::nullopt;
}

}  // namespace

ChangedNets retry_pieces(const mesh::Surface& surface, const prepare::Panels& panels,
                         const IdVector<FaceId, PartId>& part, const Options& options, const Nets& nets,
                         std::span<const PieceId> pieces, const Context& context) {
  Nets changed = nets;
  for (const PieceId p : pieces) {
    const Piece& piece = nets.pieces[p];
    const Alone one = alone(surface, panels, options, piece);
    const std::optional<Nets> found = another_net(one, nets, context);
    if (!found) {
      return Refusal{"no other net of piece " + piece.name + " was found", piece.faces};
    }
    for (const EdgeId e : ids<EdgeId>(one.from.edge.size())) {
      if (found->use[e] != EdgeUse::border) {
        changed.use[one.from.edge[e]] = found->use[e];
      }
    }
    for (const FaceId f : ids<FaceId>(one.from.face.size())) {
      changed.flat[one.from.face[f]] = found->flat[f];
    }
  }
  return nets_of_uses(surface, panels, part, options.wishes, nets, changed, causes_in(nets), context);
}

}  // namespace ridgecraft::unfold
