// SPDX-License-Identifier: GPL-3.0-or-later
// PDF of the guide: pictures below, lines and words over them, no layers to be switched.
#include <string>

#include "base/error.hpp"
#include "export/formats/cairo_page.hpp"
#include "export/formats/layer_order.hpp"
#include "export/formats/pdf_file.hpp"
#include "export/formats/write.hpp"

namespace ridgecraft::paper {

std::string write_guide_pdf(std::span<const Drawing> pages, const Mark& mark) {
  try {
    const std::string painted = cairo_pdf(pages, [](cairo_t* cairo, const Drawing& page) {
      paint_layer(cairo, page, Layer::paint, points_per_mm);
      paint_layer(cairo, page, Layer::picture, points_per_mm);
      for (const Layer layer : layer_order) {
        if (layer != Layer::paint) {
          paint_layer(cairo, page, layer, points_per_mm);
        }
      }
    });
    QPDF pdf;
    pdf.processMemoryFile("guide", painted.data(), painted.size());
    add_viewer_preferences(pdf);
    Mark own = mark;
    own.title += ": how to build it";
    add_information(pdf, own);
    // Whoever checks pages of nets knows by this that there are none here.
    pdf.getTrailer().getKey("/Info").replaceKey("/Subject", QPDFObjectHandle::newString("guide"));
    return pdf_bytes(pdf);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {  // qpdf throws several kinds
    throw Error(ErrorKind::internal, std::string("putting the guide together failed: ") + failure.what());
  }
}

}  // namespace ridgecraft::paper
