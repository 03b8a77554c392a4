// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of simple shapes for tests of what is drawn: nets without a search, tabs where they fit, pieces in
// rows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "export/export.hpp"

namespace ridgecraft::test {

struct SamplePages {
  prepare::Prepared model;
  unfold::Nets nets;
  export_::Pages pages;
};

/// The surface times `scale`, unfolded, with tabs of `tab_height` mm where they lie over nothing (none if it
/// is 0), placed in rows on sheets of the paper. Pieces are turned by `turn` radians first.
[[nodiscard]] SamplePages sample_pages(const mesh::Surface& surface, double scale, double tab_height,
                                       std::span<const EdgeId> cuts = {}, const std::string& name = "Sample",
                                       const export_::Paper& paper = {}, double turn = 0.0);

/// What the sheets of these pages are drawn with, by default settings.
[[nodiscard]] std::vector<export_::Drawing> drawings(const SamplePages& sample);

/// The mark of a program and a model that files for tests bear.
inline const export_::Mark mark{"ridgecraft test", "Cube", "0123456789abcdef"};

/// "12" of "B:12": the number in the text of a join, without the piece that it leads to.
[[nodiscard]] std::string number_in(const std::string& text);

/// Every edge that is folded, as cuts for sample_pages: each panel becomes a piece.
[[nodiscard]] std::vector<EdgeId> all_edges(const mesh::Surface& surface);

}  // namespace ridgecraft::test
