// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces become pages, pages become drawings, drawings become files. Read this header first.
// The namespace is ridgecraft::paper, since `export` is a C++ keyword.
//
//   Nets --layout--> Pages --draw--> Drawings --write--> bytes of PDF, SVG, PNG;   Nets + Pages --> bytes of
//   FOLD
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/bodies.hpp"
#include "export/drawing.hpp"
#include "export/formats/mark.hpp"
#include "export/paper.hpp"
#include "mesh/foundation/context.hpp"
#include "mesh/mesh.hpp"
#include "unfold/nets.hpp"

namespace ridgecraft::paper {

/// Where a piece lies: turned counterclockwise by the angle whose cosine and sine are given, then moved.
struct Placement {
  PageId page;
  double cosine = 1.0;
  double sine = 0.0;
  Vec2 shift;

  /// From the piece's plane to the page (origin: lower left corner of the sheet, y up).
  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return {cosine * p.x - sine * p.y + shift.x, sine * p.x + cosine * p.y + shift.y};
  }
};

struct Pages {
  Paper paper;
  std::size_t count = 0;
  IdVector<PieceId, Placement> placements;
};

/// Packs the pieces by their true outlines, tabs included, with the gap between them (more where a page has
/// room), on as few pages as it can. Pieces of one part stay together where that costs no page and leaves no
/// page half empty. Deterministic, unless the context's deadline passes: then the best so far is taken.
/// Throws Error(no_nets) naming a piece that fits no page.
[[nodiscard]] Pages layout(const unfold::Nets& nets, const Paper& paper, const Context& context);

/// The largest of a few sizes below the present one, as a share of it, at which these pieces would take a
/// page less; none where even the smallest of them wouldn't do. About, since tabs don't shrink with the model
/// and nets may come out otherwise. Takes a tenth of what layout() does.
[[nodiscard]] std::optional<double> share_that_saves_a_page(const unfold::Nets& nets, const Pages& pages,
                                                            const Context& context);

struct Style {
  double hidden_fold_angle = 3.0 * 3.14159265358979323846 / 180.0;  ///< smaller folds get no line, radians
  double label_height = 2.5;                                        ///< mm
  double smallest_label_height = 1.6;                               ///< mm
};

/// What is drawn, beside the pages themselves.
struct DrawReport {
  struct Number {
    std::string piece;
    std::uint32_t number = 0;
    friend auto operator<=>(const Number&, const Number&) = default;
  };
  /// Numbers that found no place even at the smallest height, page by page.
  std::vector<Number> labels_left_out;
  std::size_t labels_outside = 0;  ///< numbers that stand beside their piece, with a leader
  std::size_t names_left_out = 0;  ///< pieces whose name found no place
  std::vector<Body> bodies;        ///< separate ones, if there are several (export/bodies.hpp)
};

/// Draws every page: outlines, folds, tabs, numbers on both sides of every cut, names, the index of what is
/// glued to what, legend, scale bar.
[[nodiscard]] std::vector<Drawing> draw(const mesh::Prepared& model, const unfold::Nets& nets,
                                        const Pages& pages, const Style& style, DrawReport* report = nullptr);

/// Longest side of a PDF's page, mm: 14,400 points (ISO 32000-1, annex C.2).
inline constexpr double longest_pdf_side_mm = 14400.0 / 72.0 * 25.4;
/// Throws Error(usage) for a page that is longer. (Its UserUnit would allow it, but programs that don't know
/// it would print the page too small.)
void check_pdf_size(Vec2 page_mm);

/// Bytes of a PDF of all pages. Same input, same bytes. Throws as check_pdf_size().
[[nodiscard]] std::string write_pdf(std::span<const Drawing> pages, const Mark& mark);
/// Bytes of the SVG of one page, in true millimetres, a layer for each class of line.
[[nodiscard]] std::string write_svg(const Drawing& page, const Mark& mark);
/// Bytes of a PNG of one page; coarser than asked where it would have more than 100 million pixels.
[[nodiscard]] std::string write_png(const Drawing& page, const Mark& mark, double dots_per_inch = 150.0);

/// Options that shaped the result, for ridgecraft:settings; values are JSON texts (numbers, strings in
/// quotes).
using Settings = std::map<std::string, std::string>;

/// Bytes of nets.fold. Without pages every piece gets an unbounded page of its own.
[[nodiscard]] std::string write_fold(const mesh::Prepared& model, const IdVector<FaceId, PartId>& part,
                                     const unfold::Nets& nets, const Pages* pages, const Mark& mark,
                                     const Settings& settings);

}  // namespace ridgecraft::paper
