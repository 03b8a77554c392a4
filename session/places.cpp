// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/places.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "export/nearest_place.hpp"
#include "job/page_layout.hpp"
#include "unfold/tabs/place/fit.hpp"

namespace ridgecraft::session {
namespace {

using unfold::Nets;

/// Of each piece the old one that most of its faces lay in as they lie now; none where none did.
IdVector<PieceId, PieceId> predecessors(const Nets& before, const Nets& after) {
  IdVector<PieceId, PieceId> found(after.pieces.size());
  for (const PieceId p : ids<PieceId>(after.pieces.size())) {
    std::map<PieceId, std::size_t> faces;
    for (const FaceId f : after.pieces[p].faces) {
      if (before.flat[f] == after.flat[f]) {
        ++faces[before.piece[f]];
      }
    }
    std::size_t most = 0;
    for (const auto& [old, count] : faces) {
      if (count > most) {
        most = count;
        found[p] = old;
      }
    }
  }
  return found;
}

/// Whether a piece covers just what an old one covered, tabs included.
bool looks_alike(const Nets& before, const unfold::TabsOfPiece& old_tabs, PieceId old, const Nets& after,
                 const unfold::TabsOfPiece& tabs, PieceId piece) {
  const auto& faces = after.pieces[piece].faces;
  return before.pieces[old].faces == faces &&
         std::all_of(faces.begin(), faces.end(), [&](FaceId f) { return before.flat[f] == after.flat[f]; }) &&
         std::equal(old_tabs[old].begin(), old_tabs[old].end(), tabs[piece].begin(), tabs[piece].end(),
                    [&](TabId a, TabId b) { return before.tabs[a].polygon == after.tabs[b].polygon; });
}

/// Lays a face as it is asked for.
paper::Placement placement_of(const Nets& nets, const Place& place) {
  const std::array<Vec2, 3>& corners = nets.flat[place.face];
  const Vec2 side = corners[1] - corners[0];
  const double angle = place.degrees * std::numbers::pi / 180.0;
  const Vec2 wanted{elementary::cos(angle), elementary::sin(angle)};
  paper::Placement at;
  at.page = PageId(place.page);
  at.cosine = dot(side, wanted) / length(side);
  at.sine = cross(side, wanted) / length(side);
  at.shift = place.at - at.turn(corners[0]);
  return at;
}

}  // namespace

Places::Places(const job::Paper& made, const State& before, const State& after)
    : made_(made), after_(after), kept_(after.nets->pieces.size()) {
  const unfold::TabsOfPiece old_tabs = unfold::tabs_of_pieces(*before.nets);
  const unfold::TabsOfPiece tabs = unfold::tabs_of_pieces(*after.nets);
  const IdVector<PieceId, PieceId> old = predecessors(*before.nets, *after.nets);
  for (const PieceId p : ids<PieceId>(kept_.size())) {
    if (old[p].valid()) {
      const bool alike = looks_alike(*before.nets, old_tabs, old[p], *after.nets, tabs, p);
      kept_[p] =
          paper::KeptPlace{before.pages->placements[old[p]], alike                ? paper::Hold::lying
                                                             : after.is_pinned(p) ? paper::Hold::laid
                                                                                  : paper::Hold::changed};
    }
  }
}

void Places::lay(std::size_t edit, const Place& place) {
  const PieceId piece = after_.nets->piece[place.face];
  kept_[piece] = paper::KeptPlace{placement_of(*after_.nets, place), paper::Hold::laid};
  laid_[piece] = edit;
}

void Places::release_all() {
  for (const PieceId p : ids<PieceId>(kept_.size())) {
    if (!after_.is_pinned(p)) {
      kept_[p].reset();
    }
  }
}

std::variant<paper::Pages, Refusal> Places::pages(const Context& context) const {
  if (std::none_of(kept_.begin(), kept_.end(), [](const auto& kept) { return kept.has_value(); })) {
    return job::laid_out(made_.prepared, made_.options, *after_.nets, context);
  }
  auto pages = job::laid_around(made_.prepared, made_.options, *after_.nets, kept_, context);
  if (const auto* const none = std::get_if<paper::NoPlace>(&pages)) {
    return refusal_of(*none);
  }
  return std::get<paper::Pages>(std::move(pages));
}

std::optional<Place> place_near(const State& state, const Place& asked, double reach_mm) {
  const paper::Placement held = placement_of(*state.nets, asked);
  const auto found =
      paper::nearest_place(*state.nets, *state.pages, state.nets->piece[asked.face], held, reach_mm);
  if (!found) {
    return std::nullopt;
  }
  Place place = asked;
  place.at += found->shift - held.shift;
  return place;
}

Refusal Places::refusal_of(const paper::NoPlace& none) const {
  const auto& pieces = after_.nets->pieces;
  const std::string& name = pieces[none.piece].name;
  std::vector<FaceId> faces = pieces[none.piece].faces;
  if (none.other.valid()) {
    const auto& more = pieces[none.other].faces;
    faces.insert(faces.end(), more.begin(), more.end());
  }
  const auto laid = laid_.find(none.piece);
  if (laid == laid_.end()) {
    return {0,
            fmt::format("piece {} is pinned, and with the tabs that it would get it has no room there", name),
            std::move(faces)};
  }
  switch (none.why) {
    case paper::NoPlace::Why::beyond_sheet:
      return {laid->second, fmt::format("piece {} would leave the part of the page that is for pieces", name),
              std::move(faces)};
    case paper::NoPlace::Why::other_sort:
      return {laid->second,
              fmt::format("pieces {} and {} belong on different pages", name, pieces[none.other].name),
              std::move(faces)};
    case paper::NoPlace::Why::too_near:
      break;
  }
  return {laid->second,
          fmt::format("there piece {} would lie on piece {}, or nearer to it than {:g} mm", name,
                      pieces[none.other].name, made_.options.paper->gap),
          std::move(faces)};
}

}  // namespace ridgecraft::session
