// SPDX-License-Identifier: GPL-3.0-or-later
// What the summaries tell of single pieces: why they are there, how they fold, which bodies they make.
#pragma once

#include <string>
#include <vector>

#include "cli/telling/summary_blocks.hpp"
#include "export/export.hpp"
#include "mesh/model/model.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::cli {

/// "A to D", "A, C", "A, C and 7 more": names in the order of the pieces.
[[nodiscard]] std::string piece_names(const unfold::Nets& nets, const std::vector<PieceId>& pieces);

/// " (2 because of overlap)"; empty where every piece is a part.
[[nodiscard]] std::string reasons_text(const unfold::Nets& nets);
/// A line for each reason with the pieces that are there for it.
[[nodiscard]] std::string extra_pieces_text(const unfold::Nets& nets);
[[nodiscard]] Json extra_pieces_json(const unfold::Nets& nets);

/// Which pieces each piece is glued to, by which numbers, and the page that it is on.
[[nodiscard]] Json index_json(const mesh::Surface& surface, const unfold::Nets& nets,
                              const paper::Pages& pages);

/// A line about the numbers that don't stand where they should; empty where all do.
[[nodiscard]] std::string numbers_text(const paper::DrawReport& drawn);
/// Those without a place, by piece.
[[nodiscard]] Json numbers_json(const paper::DrawReport& drawn);

/// The pieces that have to be bent while they are folded.
[[nodiscard]] std::string folding_text(const unfold::Nets& nets);
[[nodiscard]] Json folding_json(const unfold::Nets& nets);

/// A line where the model has colours or pictures, since pages show none.
[[nodiscard]] std::string colours_text(const mesh::Model& model);

/// "1 A to C; 2 D at B": which pieces make each separate body, and beside which piece it belongs.
[[nodiscard]] std::string bodies_text(const unfold::Nets& nets, const std::vector<paper::Body>& bodies);
[[nodiscard]] Json bodies_json(const unfold::Nets& nets, const std::vector<paper::Body>& bodies);

}  // namespace ridgecraft::cli
