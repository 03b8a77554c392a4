// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/text_placement.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "export/page/closing_edges.hpp"
#include "export/page/glue_spots.hpp"
#include "export/page/name_placement.hpp"
#include "export/page/number_placer.hpp"

namespace ridgecraft::export_ {
namespace {

/// The places, best first: each is tried for all numbers that have none yet, before the next one. These come
/// first where numbers are wanted beside the pieces.
constexpr std::array beside_pieces{NumberPlace::beside_piece, NumberPlace::leader_outside};
/// These where names of pieces have no place yet.
constexpr std::array before_names{NumberPlace::at_edge};
constexpr std::array after_names{NumberPlace::further_inside};
/// These for numbers that don't stand on a tab either.
constexpr std::array with_leaders{NumberPlace::leader_inside, NumberPlace::leader_outside};

/// Whether nobody misses the number.
bool needs_none(const Wanted& wanted) {
  const PieceDrawing& piece = *wanted.piece;
  const auto own = static_cast<std::size_t>(wanted.seam - piece.seams.data());
  return std::ranges::any_of(piece.rims, [&](const std::vector<std::size_t>& rim) {
    const auto at = std::ranges::find(rim, own);
    return at != rim.end() && closes_by_itself(piece, rim, static_cast<std::size_t>(at - rim.begin()));
  });
}

class TextPlacer {
 public:
  TextPlacer(std::vector<PieceDrawing>& pieces, const Paper& paper, const Style& style,
             const Context& context)
      : pieces_(pieces),
        area_(piece_box(paper)),
        style_(style),
        context_(context),
        placer_(paper.size, area_, style) {
    for (const PieceDrawing& piece : pieces) {
      placer_.add_lines(piece);
    }
  }

  void place(DrawReport& report) {
    for (PieceDrawing& piece : pieces_) {
      place_spot_names(piece, area_, placer_.obstacles());
    }
    place_on_tabs();
    if (is_outside()) {
      try_places(beside_pieces);
    }
    try_places(before_names);
    place_names(report);
    try_places(after_names);
    std::erase_if(wanted_, [](const Wanted& w) { return w.on_tab; });
    std::ranges::stable_partition(wanted_, [](const Wanted& w) { return !needs_none(w); });
    try_places(with_leaders);
    report.labels_outside += is_outside() ? 0 : led_outside_;
    placer_.name_partners();
    note_places();
  }

 private:
  [[nodiscard]] bool is_outside() const {
    return style_.numbers == Numbers::tabs || style_.numbers == Numbers::outside;
  }
  [[nodiscard]] bool in_time() const { return !context_.out_of_grace(); }

  /// Numbers on tabs; which ones are wanted on the pieces, those of short edges first, since these have the
  /// least choice.
  void place_on_tabs() {
    for (PieceDrawing& piece : pieces_) {
      for (Seam& seam : piece.seams) {
        const bool on_tab =
            !seam.tab.empty() && style_.numbers != Numbers::outside && placer_.place_on_tab(piece, seam);
        if (!on_tab || style_.numbers != Numbers::tabs) {
          wanted_.push_back({&piece, &seam, on_tab});
        }
      }
    }
    std::ranges::stable_sort(wanted_, {},
                             [](const Wanted& w) { return length(w.seam->edge.b - w.seam->edge.a); });
  }

  void try_places(std::span<const NumberPlace> places) {
    for (const NumberPlace place : places) {
      const bool quick = place == NumberPlace::at_edge || place == NumberPlace::beside_piece;
      const std::size_t placed = std::erase_if(
          wanted_, [&](const Wanted& w) { return (quick || in_time()) && placer_.place(w, place); });
      led_outside_ += place == NumberPlace::leader_outside ? placed : 0;
    }
  }

  void place_names(DrawReport& report) {
    for (PieceDrawing& piece : pieces_) {
      if (!place_name(piece, placer_.obstacles(), area_, !in_time())) {
        ++report.names_left_out;
      }
    }
  }

  void note_places() {
    for (PieceDrawing& piece : pieces_) {
      std::ranges::for_each(piece.seams, [](Seam& seam) { seam.at = NumberAt::edge; });
    }
    for (const Wanted& wanted : wanted_) {
      wanted.seam->at = NumberAt::list;
    }
    std::ranges::for_each(pieces_, leave_out_closing);
  }

  std::vector<PieceDrawing>& pieces_;
  Box2 area_;
  const Style& style_;
  const Context& context_;
  NumberPlacer placer_;
  std::vector<Wanted> wanted_;  ///< without a place on their piece
  std::size_t led_outside_ = 0;
};

}  // namespace

void place_texts(std::vector<PieceDrawing>& pieces, const Paper& paper, const Style& style,
                 DrawReport& report, const Context& context) {
  TextPlacer(pieces, paper, style, context).place(report);
}

}  // namespace ridgecraft::export_
