// SPDX-License-Identifier: GPL-3.0-or-later
// From drawings and nets to the bytes of files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "export/assembly/assembly.hpp"
#include "export/machine/presets.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/mark.hpp"
#include "export/sheet/pages.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Longest side of a PDF's page, mm: 14,400 points (ISO 32000-1, annex C.2).
inline constexpr double longest_pdf_side_mm = 14400.0 / 72.0 * 25.4;
/// Throws Error(usage) for a page that is longer. (Its UserUnit would allow it, but programs that don't know
/// it would print the page too small.)
void check_pdf_size(Vec2 page_mm);

/// Bytes of a PDF of all pages. Same input, same bytes. Throws as check_pdf_size().
[[nodiscard]] std::string write_pdf(std::span<const Drawing> pages, const Mark& mark);
/// Bytes of a PDF of the guide's pages. Same input, same bytes.
[[nodiscard]] std::string write_guide_pdf(std::span<const Drawing> pages, const Mark& mark);
/// Bytes of the SVG of one page, in true millimetres, a layer for each class of line.
[[nodiscard]] std::string write_svg(const Drawing& page, const Mark& mark);
/// Bytes of the SVG of all pages side by side, as pages of Inkscape (from 1.2 on): a layer for each page, and
/// in it one for each class of line. There must be a page.
[[nodiscard]] std::string write_svg_of_all(std::span<const Drawing> pages, const Mark& mark);
/// Bytes of the SVG of one page's pieces as a machine's program expects it: in true millimetres, a colour and
/// a layer for each operation, in the order of work.
[[nodiscard]] std::string write_machine_svg(const Drawing& page, const Mark& mark, const Preset& preset);
/// Bytes of the SVG that Origami Simulator folds: the edges of the nets on one page, without tabs, each with
/// its angle. Pieces of a single face have nothing to fold and are left out. O(n) in all faces.
[[nodiscard]] std::string write_simulator_svg(const prepare::Prepared& model, const unfold::Nets& nets,
                                              const Pages& pages, PageId page, const Mark& mark);
/// Bytes of the DXF of one page's pieces, in true millimetres, y up: what a machine engraves, folds and cuts,
/// in that order, a layer for each. Same input, same bytes.
[[nodiscard]] std::string write_dxf(const Drawing& page, const Mark& mark, DxfKind kind = DxfKind::r2000,
                                    const PathRules& rules = {});
/// Bytes of a PDF of all pages' pieces for packaging shops: what is cut, creased or perforated, and where
/// glue goes, in separation colours of these names that overprint, a layer for each; numbers and names in a
/// layer that isn't printed. Throws as check_pdf_size().
[[nodiscard]] std::string write_packaging_pdf(std::span<const Drawing> pages, const Mark& mark,
                                              const Preset& preset, const SpotNames& spots);
/// Bytes of the LightBurn project of one page's pieces, in true millimetres, y up: a layer for each
/// operation, in the order of work, without power or speed.
[[nodiscard]] std::string write_lbrn(const Drawing& page, const Mark& mark, const PathRules& rules = {});
/// Bytes of the HPGL of one page's pieces for roll plotters, in units of 0.025 mm: pen 1 scores, pen 2 cuts,
/// pen 3 writes, in the order of work.
[[nodiscard]] std::string write_plt(const Drawing& page, const Mark& mark, const PathRules& rules = {});
/// Bytes of the EPS of one page's pieces, in true size, in the preset's colours and the order of work.
[[nodiscard]] std::string write_eps(const Drawing& page, const Mark& mark, const Preset& preset = {});
/// Bytes of a PNG of one page; coarser than asked where it would have more than 100 million pixels.
[[nodiscard]] std::string write_png(const Drawing& page, const Mark& mark, double dots_per_inch = 150.0);

/// What a file of nets tells. What it only names must outlive it.
struct FoldContents {
  const prepare::Prepared& model;
  const IdVector<FaceId, PartId>& part;
  const unfold::Nets& nets;
  const Assembly& assembly;
  const Pages* pages = nullptr;  ///< without them every piece gets an unbounded page of its own
  std::vector<GlueOutline> glue_outlines = {};  ///< those that the pages show
  std::optional<mesh::Axis> up =
      std::nullopt;  ///< the axis that points up, if not the model's (view/camera.hpp)
};

/// Bytes of nets.fold.
[[nodiscard]] std::string write_fold(const FoldContents& contents, const Mark& mark);

/// Of drawings what a page for browsers can't tell from the nets: texts, leaders, the foot of each page,
/// colours and pictures. The second document of docs/design/viewer.md. O(size).
[[nodiscard]] std::string write_sheets(std::span<const Drawing> pages);
/// Bytes of a page for browsers that shows a finished result (docs/design/viewer.md): the program of web/,
/// `fold`, which are bytes of write_fold() with pages, and write_sheets() of the drawings. It loads nothing
/// from elsewhere. Same input, same bytes. O(size).
[[nodiscard]] std::string write_html(std::string_view fold, std::span<const Drawing> pages, const Mark& mark);

}  // namespace ridgecraft::export_
