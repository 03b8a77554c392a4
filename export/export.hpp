// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces become pages, pages become drawings, drawings become files. Read this header first.
// The namespace is ridgecraft::export_, since `export` is a C++ keyword.
//
//   Nets --layout--> Pages --draw--> Drawings --write--> bytes of PDF, SVG, PNG;   Nets + Pages --> bytes of
//   FOLD
//   Nets + Pages --draw_guide--> Drawings --write_guide_pdf--> bytes of PDF
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/context.hpp"
#include "export/formats/write.hpp"
#include "export/guide/guide.hpp"
#include "export/machine/marks.hpp"
#include "export/machine/thick_nets.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/mark.hpp"
#include "export/sheet/pages.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Packs the pieces by their true outlines, tabs included, with the gap between them (more where a page has
/// room), on as few pages as it can. Pieces of one part stay together where that costs no page and leaves no
/// page half empty; those of different `sort` never share a page, and pages come in the order of these.
/// Where the paper's grain matters, pieces lie with the directions of their folds (fold_directions())
/// within 15 degrees of it, those at least that fit so; equal ones don't lie in rows then.
/// Deterministic, unless the context's deadline passes: then the best so far is taken. Throws Error(no_nets)
/// naming a piece that fits no page.
[[nodiscard]] Pages layout(const unfold::Nets& nets, const Paper& paper, const Context& context,
                           const LayoutRules& rules = {});

/// The largest of a few sizes below the present one, as a share of it, at which these pieces would take a
/// page less, with a reserve of 4 %, since tabs don't shrink with the model and nets come out otherwise; none
/// where even the smallest of them wouldn't do. Ignores the grain. Takes a tenth of what layout() does.
[[nodiscard]] std::optional<double> scale_that_saves_a_page(const unfold::Nets& nets, const Pages& pages,
                                                            const Context& context);

/// Nets on their pages. Not copied: all that it names must outlive it.
struct PlacedNets {
  const prepare::Prepared& model;
  const unfold::Nets& nets;
  const Pages& pages;
};

/// Draws every page: outlines, folds, tabs, numbers on both sides of every cut, names, the index of what is
/// glued to what, legend, scale bar. When the context's deadline and grace have passed, numbers that have no
/// place near their edge are treated as if they had none at all: they stand in a list on their page, or on
/// pages at the end that have nothing else. `report` may come from an earlier drawing of the same surface:
/// its pictures are taken where nothing of them changes, which gives the same pages sooner. Throws
/// Error(interrupted).
[[nodiscard]] std::vector<Drawing> draw(const PlacedNets& placed, const Style& style,
                                        DrawReport* report = nullptr, const Context& context = {});

}  // namespace ridgecraft::export_
