// SPDX-License-Identifier: GPL-3.0-or-later
// A page of a drawing painted with Cairo, for the formats that Cairo makes.
#pragma once

#include <memory>

#include <cairo.h>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

struct CairoDeleter {
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using CairoContext = std::unique_ptr<cairo_t, CairoDeleter>;
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDeleter>;

/// Throws Error(internal) when Cairo has failed: its errors stick and are silent.
void check_cairo(cairo_status_t status);

/// Paints what belongs to one layer. One unit of the drawing (1 mm) becomes `units_per_mm` of the surface.
void paint_layer(cairo_t* cairo, const Drawing& page, Layer layer, double units_per_mm);

}  // namespace ridgecraft::export_
