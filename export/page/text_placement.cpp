// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/text_placement.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "export/page/closing_edges.hpp"
#include "export/page/glue_spots.hpp"
#include "export/page/name_placement.hpp"
#include "export/page/number_placer.hpp"

namespace ridgecraft::paper {
namespace {

/// Those without a place after each attempt.
template <class Place>
std::vector<Wanted> without_place(const std::vector<Wanted>& all, Place place) {
  std::vector<Wanted> rest;
  std::ranges::copy_if(all, std::back_inserter(rest), [&](const Wanted& wanted) { return !place(wanted); });
  return rest;
}

/// Whether nobody misses the number.
bool needs_none(const Wanted& wanted) {
  const PieceDrawing& piece = *wanted.piece;
  const auto own = static_cast<std::size_t>(wanted.seam - piece.seams.data());
  return std::ranges::any_of(piece.rims, [&](const std::vector<std::size_t>& rim) {
    const auto at = std::ranges::find(rim, own);
    return at != rim.end() && closes_by_itself(piece, rim, static_cast<std::size_t>(at - rim.begin()));
  });
}

}  // namespace

void place_texts(std::vector<PieceDrawing>& pieces, Vec2 page_size, const Box2& area, const Style& style,
                 DrawReport& report, const Context& context) {
  const auto in_time = [&context] { return !context.out_of_grace(); };
  NumberPlacer placer(page_size, area, style);
  for (const PieceDrawing& piece : pieces) {
    placer.add_lines(piece);
  }
  for (PieceDrawing& piece : pieces) {
    place_spot_names(piece, area, placer.obstacles());
  }
  const bool outside = style.numbers == Numbers::tabs || style.numbers == Numbers::outside;
  std::vector<Wanted> wanted;
  for (PieceDrawing& piece : pieces) {
    for (Seam& seam : piece.seams) {
      const bool on_tab =
          !seam.tab.empty() && style.numbers != Numbers::outside && placer.place_on_tab(piece, seam);
      wanted.push_back({&piece, &seam, on_tab});
    }
  }
  // Short edges have the least choice.
  std::ranges::stable_sort(wanted, {},
                           [](const Wanted& w) { return length(w.seam->edge.b - w.seam->edge.a); });
  if (style.numbers == Numbers::tabs) {
    std::erase_if(wanted, [](const Wanted& w) { return w.on_tab; });
  }
  if (outside) {
    wanted = without_place(wanted, [&](const Wanted& w) { return placer.place_near(w, Beside::outside); });
    wanted = without_place(
        wanted, [&](const Wanted& w) { return in_time() && placer.place_with_leader(w, Beside::outside); });
  }
  wanted = without_place(wanted, [&](const Wanted& w) { return placer.place_near(w); });
  for (PieceDrawing& piece : pieces) {
    if (!place_name(piece, placer.obstacles(), area, !in_time())) {
      ++report.names_left_out;
    }
  }
  wanted = without_place(wanted, [&](const Wanted& w) { return in_time() && placer.place_inside(w); });
  std::erase_if(wanted, [](const Wanted& w) { return w.on_tab; });
  std::ranges::stable_partition(wanted, [](const Wanted& w) { return !needs_none(w); });
  wanted = without_place(
      wanted, [&](const Wanted& w) { return in_time() && placer.place_with_leader(w, Beside::inside); });
  if (!outside) {
    const std::size_t before = wanted.size();
    wanted = without_place(
        wanted, [&](const Wanted& w) { return in_time() && placer.place_with_leader(w, Beside::outside); });
    report.labels_outside += before - wanted.size();
  }
  placer.name_partners();
  for (PieceDrawing& piece : pieces) {
    std::ranges::for_each(piece.seams, [](Seam& seam) { seam.told = NumberAt::edge; });
  }
  for (const Wanted& w : wanted) {
    w.seam->told = NumberAt::list;
  }
  std::ranges::for_each(pieces, leave_out_closing);
}

}  // namespace ridgecraft::paper
