// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/draft.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/option_table.hpp"
#include "export/layout_around.hpp"
#include "job/page_layout.hpp"
#include "job/unfold_options.hpp"
#include "session/names.hpp"
#include "unfold/edits.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/tab_requests.hpp"

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

struct PieceOfNets {
  const Nets& nets;
  const unfold::TabsOfPiece& tabs;
  PieceId piece;
};

/// Whether a piece covers just what an old one covered, tabs included.
bool looks_alike(const PieceOfNets& old, const PieceOfNets& now) {
  const auto& faces = now.nets.pieces[now.piece].faces;
  const auto& old_tabs = old.tabs[old.piece];
  const auto& tabs = now.tabs[now.piece];
  return old.nets.pieces[old.piece].faces == faces &&
         std::all_of(faces.begin(), faces.end(),
                     [&](FaceId f) { return old.nets.flat[f] == now.nets.flat[f]; }) &&
         std::equal(old_tabs.begin(), old_tabs.end(), tabs.begin(), tabs.end(),
                    [&](TabId a, TabId b) { return old.nets.tabs[a].polygon == now.nets.tabs[b].polygon; });
}

/// Lays a face as it is asked for.
export_::Placement placement_of(const Nets& nets, const Place& place) {
  const std::array<Vec2, 3>& corners = nets.flat[place.face];
  const Vec2 side = corners[1] - corners[0];
  const double angle = place.degrees * std::numbers::pi / 180.0;
  const Vec2 wanted{elementary::cos(angle), elementary::sin(angle)};
  export_::Placement at;
  at.page = PageId(place.page);
  at.cosine = dot(side, wanted) / length(side);
  at.sine = cross(side, wanted) / length(side);
  at.shift = place.at - at.turn(corners[0]);
  return at;
}

}  // namespace

Places::Places(const job::Result& made, const State& before, const State& after)
    : made_(made), after_(after), kept_(after.nets->pieces.size()) {
  const unfold::TabsOfPiece old_tabs = unfold::tabs_of_pieces(*before.nets);
  const unfold::TabsOfPiece tabs = unfold::tabs_of_pieces(*after.nets);
  const IdVector<PieceId, PieceId> old = predecessors(*before.nets, *after.nets);
  for (const PieceId p : ids<PieceId>(kept_.size())) {
    if (old[p].valid()) {
      const bool alike = looks_alike({*before.nets, old_tabs, old[p]}, {*after.nets, tabs, p});
      kept_[p] =
          export_::KeptPlace{before.pages->placements[old[p]], alike                ? export_::Hold::lying
                                                               : after.is_pinned(p) ? export_::Hold::laid
                                                                                    : export_::Hold::changed};
    }
  }
}

void Places::lay(std::size_t edit, const Place& place) {
  const PieceId piece = after_.nets->piece[place.face];
  kept_[piece] = export_::KeptPlace{placement_of(*after_.nets, place), export_::Hold::laid};
  laid_[piece] = edit;
}

void Places::release_all() {
  for (const PieceId p : ids<PieceId>(kept_.size())) {
    if (!after_.is_pinned(p)) {
      kept_[p].reset();
    }
  }
}

std::variant<export_::Pages, Refusal> Places::pages(const Context& context) const {
  if (std::none_of(kept_.begin(), kept_.end(), [](const auto& kept) { return kept.has_value(); })) {
    return job::laid_out(made_.prepared, made_.options, *after_.nets, context);
  }
  auto pages = job::laid_around(made_.prepared, made_.options, *after_.nets, kept_, context);
  if (const auto* const none = std::get_if<export_::NoPlace>(&pages)) {
    return refusal_of(*none);
  }
  return std::get<export_::Pages>(std::move(pages));
}

std::optional<Place> place_near(const State& state, const Place& asked, double reach_mm) {
  const export_::Placement held = placement_of(*state.nets, asked);
  const auto found =
      export_::nearest_place(*state.nets, *state.pages, state.nets->piece[asked.face], held, reach_mm);
  if (!found) {
    return std::nullopt;
  }
  Place place = asked;
  place.at += found->shift - held.shift;
  return place;
}

Refusal Places::refusal_of(const export_::NoPlace& none) const {
  const auto& pieces = after_.nets->pieces;
  const std::string& name = pieces[none.piece].name;
  std::vector<FaceId> faces = pieces[none.piece].faces;
  if (none.other.valid()) {
    const auto& more = pieces[none.other].faces;
    faces.insert(faces.end(), more.begin(), more.end());
  }
  const auto laid = laid_.find(none.piece);
  if (laid == laid_.end()) {
    return {0, Message("no_room_when_pinned", {{"a", name}}), std::move(faces)};
  }
  switch (none.why) {
    case export_::NoPlace::Why::beyond_sheet:
      return {laid->second, Message("beyond_sheet", {{"a", name}}), std::move(faces)};
    case export_::NoPlace::Why::other_sort:
      return {laid->second, Message("different_pages", {{"a", name}, {"b", pieces[none.other].name}}),
              std::move(faces)};
    case export_::NoPlace::Why::too_near:
      break;
  }
  return {laid->second,
          Message("too_near", {{"a", name},
                               {"b", pieces[none.other].name},
                               {"n", fmt::format("{:g}", made_.options.paper->gap)}}),
          std::move(faces)};
}

namespace {

/// None where the surface has no such edge.
std::optional<EdgeId> edge_of(const mesh::Surface& surface, const Edge& edge) {
  if (edge.from.value() >= surface.vertex_count()) {
    return std::nullopt;
  }
  for (const CornerId c : surface.corners_at(edge.from)) {
    if (surface.vertex(mesh::next(c)) == edge.to) {
      return surface.edge(c);
    }
    if (surface.vertex(mesh::previous(c)) == edge.to) {
      return surface.edge(mesh::previous(c));
    }
  }
  return std::nullopt;
}

Context without_deadline(Context context) {
  context.deadline.reset();
  context.give_up.reset();
  return context;
}

Refusal refusal(Message why, std::vector<FaceId> faces) {
  return {0, std::move(why), std::move(faces)};
}

Refusal no_such_edge() {
  return refusal(Message("no_such_edge"), {});
}

/// Whether the tabs of a piece that has the faces of one before, as they lay, aren't those that it had.
bool other_tabs_change(const Nets& before, const Nets& after) {
  const unfold::TabsOfPiece old_tabs = unfold::tabs_of_pieces(before);
  const unfold::TabsOfPiece tabs = unfold::tabs_of_pieces(after);
  const auto ids_of_pieces = ids<PieceId>(after.pieces.size());
  return std::any_of(ids_of_pieces.begin(), ids_of_pieces.end(), [&](PieceId p) {
    const std::vector<FaceId>& faces = after.pieces[p].faces;
    const PieceId old = before.piece[faces.front()];
    return before.pieces[old].faces == faces &&
           std::all_of(faces.begin(), faces.end(),
                       [&](FaceId f) { return before.flat[f] == after.flat[f]; }) &&
           !looks_alike({before, old_tabs, old}, {after, tabs, p});
  });
}

/// The tabs that joins had before, where they are joins still: the same sides, or none.
std::vector<unfold::TabAt> tabs_as_before(const Nets& before, const Nets& after,
                                          const mesh::Surface& surface) {
  std::vector<unfold::TabAt> tabs;
  for (const unfold::Join& join : before.joins) {
    if (after.use[join.edge] == unfold::EdgeUse::cut) {
      unfold::TabAt tab;
      tab.edge = join.edge;
      tab.wanted = join.tab.valid();
      if (tab.wanted) {
        // Rather none than one on the other side, which would be another piece's.
        tab.no_other_side = true;
        const CornerId side = before.tabs[join.tab].side;
        tab.side = static_cast<std::uint8_t>(surface.sides(join.edge)[0] == side ? 0 : 1);
      }
      tabs.push_back(tab);
    }
  }
  return tabs;
}

/// Whether paper of another colour begins at an edge.
bool parts_colours(const mesh::Surface& surface, const job::PageLabels& labels, EdgeId edge) {
  const auto [c, d] = surface.sides(edge);
  return labels.any() && d.valid() && labels.of_face[mesh::face_of(c)] != labels.of_face[mesh::face_of(d)];
}

}  // namespace

Draft::Draft(const job::Result& made, const State& before, const Context& context)
    : made_(made),
      surface_(made.prepared.model.surface),
      before_(before),
      context_(without_deadline(context)),
      options_(job::unfold_options(made.options, made.prepared, made.constraints)),
      labels_(job::page_labels(made.prepared.model, made.options.page_by)),
      pinned_(before.pinned) {}

std::optional<Refusal> Draft::change(std::span<const Edit> edits) {
  for (edit_ = 0; edit_ < edits.size(); ++edit_) {
    if (Change refused = std::visit([&](const auto& edit) { return change(edit); }, edits[edit_])) {
      refused->edit = edit_;
      return refused;
    }
  }
  return std::nullopt;
}

bool Draft::is_pinned(PieceId piece) const {
  return std::any_of(pinned_.begin(), pinned_.end(), [&](FaceId f) { return nets().piece[f] == piece; });
}

Refusal Draft::pinned_refusal(PieceId piece) const {
  return refusal(Message("pinned", {{"a", nets().pieces[piece].name}}), nets().pieces[piece].faces);
}

Draft::Change Draft::check_face(FaceId face) const {
  if (face.value() >= surface_.face_count()) {
    return refusal(Message("no_such_face"), {});
  }
  return std::nullopt;
}

std::vector<FaceId> Draft::faces_at(EdgeId edge) const {
  const auto [c, d] = surface_.sides(edge);
  std::vector<FaceId> faces{mesh::face_of(c)};
  if (d.valid()) {
    faces.push_back(mesh::face_of(d));
  }
  return faces;
}

Draft::Change Draft::pinned_beside(EdgeId edge) const {
  for (const FaceId face : faces_at(edge)) {
    if (is_pinned(nets().piece[face])) {
      return pinned_refusal(nets().piece[face]);
    }
  }
  return std::nullopt;
}

Draft::Change Draft::take(unfold::ChangedNets changed) {
  if (auto* const why = std::get_if<unfold::Refusal>(&changed)) {
    return refusal(std::move(why->why), std::move(why->faces));
  }
  nets_ = std::get<unfold::Nets>(std::move(changed));
  return std::nullopt;
}

Draft::Change Draft::change(const Cut& cut) {
  const std::optional<EdgeId> edge = edge_of(surface_, cut.edge);
  if (!edge) {
    return no_such_edge();
  }
  if (nets().use[*edge] == unfold::EdgeUse::fold) {
    if (Change pinned = pinned_beside(*edge)) {
      return pinned;
    }
  }
  return take(unfold::cut_fold(problem(), nets(), *edge, context_));
}

Draft::Change Draft::change(const Join& join) {
  const std::optional<EdgeId> edge = edge_of(surface_, join.edge);
  if (!edge) {
    return no_such_edge();
  }
  if (parts_colours(surface_, labels_, *edge)) {
    return refusal(Message("pages_differ"), faces_at(*edge));
  }
  if (nets().use[*edge] == unfold::EdgeUse::cut) {
    if (Change pinned = pinned_beside(*edge)) {
      return pinned;
    }
  }
  return take(unfold::join_cut(problem(), nets(), *edge, context_));
}

Draft::Change Draft::ask_for_tab(const Edge& named, unfold::TabAt tab) {
  const std::optional<EdgeId> edge = edge_of(surface_, named);
  if (!edge) {
    return no_such_edge();
  }
  if (!made_.options.tabs.wanted) {
    return refusal(Message("made_without_tabs"), faces_at(*edge));
  }
  if (nets().use[*edge] != unfold::EdgeUse::cut) {
    return refusal(Message("only_glued_edges"), faces_at(*edge));
  }
  tab.edge = *edge;
  tab.side = static_cast<std::uint8_t>(surface_.vertex(surface_.sides(*edge)[0]) == named.from ? 0 : 1);
  tabs_.push_back({edit_, tab});
  new_tabs_ = true;
  return std::nullopt;
}

Draft::Change Draft::change(const TabFrom& tab) {
  return ask_for_tab(tab.edge, {});
}

Draft::Change Draft::change(const NoTab& tab) {
  unfold::TabAt none;
  none.wanted = false;
  return ask_for_tab(tab.edge, none);
}

Draft::Change Draft::change(const TabShape& shape) {
  const Option& height = option_row("tab-height");
  const Option& angle = option_row("tab-angle");
  unfold::TabAt tab;
  tab.height_mm = std::clamp(shape.height_mm, height.low, height.high);
  tab.angle = std::clamp(shape.degrees, angle.low, angle.high) * std::numbers::pi / 180.0;
  return ask_for_tab(shape.edge, tab);
}

Draft::Change Draft::change(const BothTabs& both) {
  unfold::TabAt tab;
  tab.both = true;
  return ask_for_tab(both.edge, tab);
}

Draft::Change Draft::change(const Place& place) {
  if (Change none = check_face(place.face)) {
    return none;
  }
  const PieceId piece = nets().piece[place.face];
  if (!before_.pages) {
    return refusal(Message(made_.options.paper ? "pages_of_board" : "no_pages"), nets().pieces[piece].faces);
  }
  if (place.page > before_.pages->count) {
    return refusal(Message("no_such_page"), nets().pieces[piece].faces);
  }
  if (is_pinned(piece)) {
    return pinned_refusal(piece);
  }
  laid_.push_back({edit_, place});
  return std::nullopt;
}

Draft::Change Draft::change(const Pin& pin) {
  if (Change none = check_face(pin.face)) {
    return none;
  }
  if (is_pinned(nets().piece[pin.face])) {
    return refusal(Message("pinned_already", {{"a", nets().pieces[nets().piece[pin.face]].name}}),
                   nets().pieces[nets().piece[pin.face]].faces);
  }
  pinned_.insert(pin.face);
  return std::nullopt;
}

Draft::Change Draft::change(const Unpin& unpin) {
  if (Change none = check_face(unpin.face)) {
    return none;
  }
  const PieceId piece = nets().piece[unpin.face];
  if (std::erase_if(pinned_, [&](FaceId f) { return nets().piece[f] == piece; }) == 0) {
    return refusal(Message("not_pinned", {{"a", nets().pieces[piece].name}}), nets().pieces[piece].faces);
  }
  return std::nullopt;
}

Draft::Change Draft::change(const Retry& retry) {
  if (Change none = check_face(retry.face)) {
    return none;
  }
  const PieceId piece = nets().piece[retry.face];
  if (is_pinned(piece)) {
    return pinned_refusal(piece);
  }
  Context seeded = context_;
  seeded.seed = retry.seed;
  return take(unfold::retry_pieces(problem(), nets(), {&piece, 1}, seeded));
}

Draft::Change Draft::change(const Number& /*edit*/) {
  if (!nets_) {
    nets_ = *before_.nets;
  }
  for (const PieceId p : ids<PieceId>(nets_->pieces.size())) {
    nets_->pieces[p].name = unfold::piece_name(p.value());
  }
  numbered_ = true;
  return std::nullopt;
}

Draft::Change Draft::change(const Pack& pack) {
  for (const FaceId face : pack.faces) {
    if (Change none = check_face(face)) {
      return none;
    }
    if (const PieceId piece = nets().piece[face]; is_pinned(piece)) {
      return pinned_refusal(piece);
    }
  }
  all_packed_ = all_packed_ || pack.faces.empty();
  packed_.insert(packed_.end(), pack.faces.begin(), pack.faces.end());
  return std::nullopt;
}

/// Which edit asked for a tab for which there is no room; none where all got theirs.
Draft::Change Draft::missing_tab(const unfold::Nets& finished) const {
  for (const auto& [edit, tab] : tabs_) {
    const auto join = std::find_if(finished.joins.begin(), finished.joins.end(),
                                   [edge = tab.edge](const unfold::Join& j) { return j.edge == edge; });
    const CornerId side = surface_.sides(tab.edge)[tab.side.value()];
    if (tab.wanted && join != finished.joins.end() &&
        (!join->tab.valid() || finished.tabs[join->tab].side != side)) {
      return Refusal{edit, Message("no_room_for_tab"), {mesh::face_of(side)}};
    }
  }
  return std::nullopt;
}

unfold::Nets Draft::with_tabs(std::vector<unfold::TabAt> as_before,
                              const std::vector<unfold::TabAt>& asked) const {
  unfold::TabChoice choice = made_.options.tab_choice;
  // Numbers are those of the nets before all edits.
  std::vector<unfold::TabAt> at = unfold::by_edges(surface_, made_.nets, choice.edges);
  choice.edges.clear();
  at.insert(at.end(), choice.at.begin(), choice.at.end());
  at.insert(at.end(), as_before.begin(), as_before.end());
  at.insert(at.end(), asked.begin(), asked.end());
  choice.at = std::move(at);
  return job::tabbed(made_, nets(), choice, context_);
}

std::variant<State, Refusal> Draft::finish() const {
  State state = before_;
  state.pinned = pinned_;
  for (const TabEdit& asked : tabs_) {
    state.tabs.push_back(asked.tab);
  }
  if (!nets_stay()) {
    unfold::Nets finished = with_tabs({}, state.tabs);
    if (!numbered_ && other_tabs_change(*before_.nets, finished)) {
      finished = with_tabs(tabs_as_before(*before_.nets, finished, surface_), state.tabs);
    }
    if (Change missing = missing_tab(finished)) {
      return *std::move(missing);
    }
    if (!numbered_) {
      keep_names(surface_, made_.nets, *before_.nets, finished);
    }
    state.nets = std::make_shared<const unfold::Nets>(std::move(finished));
  }
  return placed(std::move(state));
}

std::variant<State, Refusal> Draft::placed(State state) const {
  const bool nothing_moves = nets_stay() && laid_.empty() && packed_.empty() && !all_packed_;
  if (!state.pages || nothing_moves) {
    return state;
  }
  Places places(made_, before_, state);
  for (const auto& [edit, place] : laid_) {
    places.lay(edit, place);
  }
  if (all_packed_) {
    places.release_all();
  }
  for (const FaceId face : packed_) {
    places.release(face);
  }
  auto pages = places.pages(context_);
  if (auto* const refused = std::get_if<Refusal>(&pages)) {
    return std::move(*refused);
  }
  state.pages = std::make_shared<const export_::Pages>(std::get<export_::Pages>(std::move(pages)));
  return state;
}

}  // namespace ridgecraft::session
