// SPDX-License-Identifier: GPL-3.0-or-later
// What every PDF of this program has in common: pages painted by Cairo, words about the document, and bytes
// that don't change from run to run.
#pragma once

#include <functional>
#include <span>
#include <string>

#include <cairo.h>
#include <qpdf/QPDF.hh>

#include "export/sheet/drawing.hpp"
#include "export/sheet/mark.hpp"

namespace ridgecraft::export_ {

/// The packet: title, program and keywords as in the document's information, and the settings as one JSON
/// text under a name of our own. Its dates are fixed, so that two runs give the same bytes.
[[nodiscard]] std::string xmp_packet(const Mark& mark);

inline constexpr double points_per_mm = 72.0 / 25.4;

/// A PDF of pages of these sizes, each painted by `paint`; one unit of the context is a point, y down.
[[nodiscard]] std::string cairo_pdf(std::span<const Drawing> pages,
                                    const std::function<void(cairo_t*, const Drawing&)>& paint);

/// Asks viewers not to scale pages and to show the title.
void add_viewer_preferences(QPDF& pdf);
/// Title, program, mark and settings (as XMP, too), the language of all words, and numbers of pages as they
/// are printed.
void add_information(QPDF& pdf, const Mark& mark);
[[nodiscard]] std::string pdf_bytes(QPDF& pdf);

}  // namespace ridgecraft::export_
