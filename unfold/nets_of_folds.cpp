// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/nets_of_folds.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "unfold/net/nets.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {
namespace {

/// A piece before it has its place in the order of all.
struct Draft {
  std::vector<std::uint32_t> faces;
  PartId part;  ///< most of its area belongs to
  double area = 0.0;
  PieceReason reason = PieceReason::part;
};

/// Share of these faces that a step cut off.
double share_cut_off(const Causes& causes, const std::vector<std::uint32_t>& faces) {
  const auto cut = std::count_if(faces.begin(), faces.end(),
                                 [&](std::uint32_t f) { return causes[f].reason != PieceReason::part; });
  return static_cast<double>(cut) / static_cast<double>(faces.size());
}

/// The pieces that are more than their parts, by their numbers. The largest piece of each part stands for it.
/// Where borders have moved, a part may have no piece that is mostly its own: then another one stands for it,
/// those that least was cut off of.
std::vector<std::size_t> extra_pieces(const Causes& causes, const IdVector<FaceId, PartId>& part,
                                      const std::vector<Draft>& drafts) {
  const std::set<PartId> parts(part.begin(), part.end());
  std::vector<std::size_t> others;
  for (std::size_t i = 1; i < drafts.size(); ++i) {
    if (drafts[i].part == drafts[i - 1].part) {
      others.push_back(i);
    }
  }
  const std::size_t parts_without = parts.size() - (drafts.size() - others.size());
  std::stable_sort(others.begin(), others.end(), [&](std::size_t i, std::size_t j) {
    return share_cut_off(causes, drafts[i].faces) < share_cut_off(causes, drafts[j].faces);
  });
  others.erase(others.begin(),
               others.begin() + static_cast<std::ptrdiff_t>(std::min(parts_without, others.size())));
  return others;
}

/// What most faces of a part were cut off for; where none was, of all faces; its
/// shape where nothing was.
PieceReason most_common_reason(const Causes& causes, const IdVector<FaceId, PartId>& part, PartId of) {
  std::map<PieceReason, std::size_t> own;
  std::map<PieceReason, std::size_t> any;
  for (const FaceId f : ids<FaceId>(part.size())) {
    if (const PieceReason reason = causes[f.value()].reason; reason != PieceReason::part) {
      ++any[reason];
      own[reason] += part[f] == of ? 1U : 0U;
    }
  }
  const auto less = [&](const auto& a, const auto& b) {
    return std::pair(own[a.first], a.second) < std::pair(own[b.first], b.second);
  };
  const auto most = std::max_element(any.begin(), any.end(), less);
  return most == any.end() ? PieceReason::shape : most->first;
}

/// Why is each extra piece there? What was cut off in one piece is the reason for one: for the one that has
/// most of its faces now, and where that has another reason, for any that has none.
void find_reasons(const Causes& causes, const IdVector<FaceId, PartId>& part, std::vector<Draft>& drafts) {
  std::vector<std::size_t> extra = extra_pieces(causes, part, drafts);
  std::map<Cause, PartId> open;  // causes that no piece has been found for
  std::map<std::pair<std::size_t, Cause>, std::size_t> shared;
  for (const FaceId f : ids<FaceId>(part.size())) {
    if (causes[f.value()].reason != PieceReason::part) {
      open.try_emplace(causes[f.value()], part[f]);
    }
  }
  for (const std::size_t i : extra) {
    for (const std::uint32_t f : drafts[i].faces) {
      if (causes[f].reason != PieceReason::part) {
        ++shared[{i, causes[f]}];
      }
    }
  }
  std::vector<std::pair<std::size_t, std::pair<std::size_t, Cause>>> by_size;
  for (const auto& [pair, faces] : shared) {
    by_size.emplace_back(faces, pair);
  }
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto give = [&](std::size_t i, const Cause& cause) {
    drafts[i].reason = cause.reason;
    open.erase(cause);
    std::erase(extra, i);
  };
  for (const auto& [faces, pair] : by_size) {
    if (open.contains(pair.second) && std::find(extra.begin(), extra.end(), pair.first) != extra.end()) {
      give(pair.first, pair.second);
    }
  }
  while (!extra.empty() && !open.empty()) {
    const std::size_t i = extra.front();
    const auto own = std::find_if(open.begin(), open.end(),
                                  [&](const auto& cause) { return cause.second == drafts[i].part; });
    give(i, (own == open.end() ? open.begin() : own)->first);
  }
  // What one step cut off in one piece is two where a later step took away what lay between; and where other
  // steps put its faces to other pieces, none of its own tell why it is there: then those of its part do.
  for (const auto& [faces, pair] : by_size) {
    if (drafts[pair.first].reason == PieceReason::part) {
      drafts[pair.first].reason = pair.second.reason;
    }
  }
  for (const std::size_t i : extra) {
    if (drafts[i].reason == PieceReason::part) {
      drafts[i].reason = most_common_reason(causes, part, drafts[i].part);
    }
  }
}

/// Pieces by part, large ones first.
std::vector<Draft> order_pieces(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                                const Layout& layout) {
  std::vector<Draft> drafts;
  for (const auto& faces : layout.faces) {
    Draft& draft = drafts.emplace_back();
    draft.faces = faces;
    std::sort(draft.faces.begin(), draft.faces.end());
    std::map<PartId, double> area;
    for (const std::uint32_t f : draft.faces) {
      area[part[FaceId(f)]] += surface.area(FaceId(f));
      draft.area += surface.area(FaceId(f));
    }
    draft.part = std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  }
  std::stable_sort(drafts.begin(), drafts.end(), [](const Draft& a, const Draft& b) {
    return a.part != b.part ? a.part < b.part : a.area > b.area;
  });
  return drafts;
}

IdVector<EdgeId, EdgeUse> uses_of(const mesh::Surface& surface, const Folds& folds) {
  IdVector<EdgeId, EdgeUse> use(surface.edge_count(), EdgeUse::cut);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      use[e] = EdgeUse::border;
    } else if (folds[surface.sides(e)[0].value()] != 0) {
      use[e] = EdgeUse::fold;
    }
  }
  return use;
}

/// The parts that these faces belong to, ascending.
std::vector<PartId> parts_of(const IdVector<FaceId, PartId>& part, const std::vector<FaceId>& faces) {
  std::vector<PartId> parts;
  for (const FaceId f : faces) {
    parts.push_back(part[f]);
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

}  // namespace

Nets nets_of_folds(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part, const Patch& patch,
                   const Folds& folds, const Causes& causes) {
  const Layout layout = lay_out(patch, folds);
  std::vector<Draft> drafts = order_pieces(surface, part, layout);
  find_reasons(causes, part, drafts);
  Nets nets;
  nets.use = uses_of(surface, folds);
  nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
  nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(surface.face_count());
  for (const Draft& draft : drafts) {
    const PieceId id(nets.pieces.size());
    Piece piece;
    piece.name = piece_name(nets.pieces.size());
    piece.reason = draft.reason;
    for (const std::uint32_t f : draft.faces) {
      piece.faces.emplace_back(f);
      nets.piece[FaceId(f)] = id;
      nets.flat[FaceId(f)] = layout.flat[f];
    }
    piece.parts = parts_of(part, piece.faces);
    nets.pieces.push_back(std::move(piece));
  }
  return nets;
}

std::size_t blame(const Patch& patch, const Folds& before, const Folds& after, PieceReason reason,
                  Causes& causes) {
  const Layout given = lay_out(patch, before);
  const Layout split = lay_out(patch, after);
  std::vector<std::uint32_t> largest(given.faces.size(), nothing);
  for (std::uint32_t piece = 0; piece < split.faces.size(); ++piece) {
    std::uint32_t& other = largest[given.piece[split.faces[piece].front()]];
    if (other == nothing || area_of(patch, split.faces[piece]) > area_of(patch, split.faces[other])) {
      other = piece;
    }
  }
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    if (largest[given.piece[f]] != split.piece[f]) {
      causes[f] = {reason, split.faces[split.piece[f]].front()};
    }
  }
  return split.faces.size() - given.faces.size();
}

}  // namespace ridgecraft::unfold
