// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of nets: pieces and why they are there, tabs, how they fold, which bodies they make.
#pragma once

#include <string>
#include <vector>

#include "cli/report/figures.hpp"
#include "export/sheet/pages.hpp"
#include "job/job.hpp"
#include "mesh/model/model.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::cli {

/// "A to D", "A, C", "A, C and 7 more": names in the order of the pieces, of which there is one.
[[nodiscard]] std::string piece_names(const unfold::Nets& nets, const std::vector<PieceId>& pieces);
/// The same within a sentence: "piece A", "pieces A and C", "pieces A to D".
[[nodiscard]] std::string pieces_text(const unfold::Nets& nets, const std::vector<PieceId>& pieces);

/// " (2 because of overlap)"; empty where every piece is a part.
[[nodiscard]] std::string reasons_text(const unfold::Nets& nets);

/// The pieces that aren't there because of a part alone. `max_faces`: most flat faces of a piece.
void add_extra_pieces(Summary& summary, const unfold::Nets& nets, std::size_t max_faces);

/// The pieces that there are several of, kind by kind.
void add_equal_pieces(Summary& summary, const unfold::Nets& nets,
                      const std::vector<export_::PieceKind>& kinds);

/// Joins and tabs, counted.
struct TabFigures {
  std::size_t tabs = 0;        ///< those of joins
  std::size_t additional = 0;  ///< second tabs of joins, those at borders, further ones for slits
  std::size_t usable = 0;
  std::size_t without = 0;     ///< joins without a tab
  std::size_t too_narrow = 0;  ///< joins that could have no usable tab however the model is cut
  std::size_t slots = 0;       ///< joins whose tab goes into a slit
};
[[nodiscard]] TabFigures tab_figures(const mesh::Surface& surface, const unfold::Nets& nets,
                                     const unfold::TabOptions& options);
/// What has to be glued, mm of seam.
struct GlueFigures {
  double all_mm = 0.0;
  double without_tab_mm = 0.0;
  double weak_mm = 0.0;  ///< with a tab that isn't usable (unfold::is_usable)
};
[[nodiscard]] GlueFigures glue_figures(const mesh::Surface& surface, const unfold::Nets& nets,
                                       const unfold::TabOptions& options);
/// A line: how many tabs, how many of them are usable where not all are, how many are lower than asked where
/// that isn't the default, which joins have none and why.
[[nodiscard]] std::string tabs_text(const TabFigures& figures, const unfold::Nets& nets,
                                    const unfold::TabOptions& options);

/// Which pieces each piece is glued to, by which numbers, and the page that it is on.
[[nodiscard]] Value index_value(const mesh::Surface& surface, const unfold::Nets& nets,
                                const export_::Pages& pages, const export_::DrawReport& drawn);

/// Numbers and names that stand elsewhere than they should, or nowhere.
void add_numbers(Summary& summary, const export_::DrawReport& drawn);

/// The pieces that have to be bent while they are folded.
[[nodiscard]] std::vector<PieceId> pieces_with_care(const unfold::Nets& nets);
void add_folding(Summary& summary, const unfold::Nets& nets);

/// Whether the model has colours other than white, or pictures.
[[nodiscard]] bool has_colours(const mesh::Model& model);
/// Says whether pages show them, where there are any.
void say_colours(Summary& summary, const job::Result& made);
void say_lost_edges(Summary& summary, const job::Result& made);

/// Which pieces make each separate body, and beside which piece it belongs.
void add_bodies(Summary& summary, const unfold::Nets& nets, const std::vector<export_::Body>& bodies);

}  // namespace ridgecraft::cli
