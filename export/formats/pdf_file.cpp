// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/pdf_file.hpp"

#include <string_view>

#include <cairo-pdf.h>
#include <fmt/format.h>
#include <qpdf/Buffer.hh>
#include <qpdf/QPDFWriter.hh>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "export/formats/cairo_page.hpp"

namespace ridgecraft::export_ {
namespace {

std::string xml_text(std::string_view text) {
  return xml_escaped(printable_utf8(text));
}

}  // namespace

std::string xmp_packet(const Mark& mark) {
  // The mark stands before anything that a user may have written: whoever looks for it finds the true one.
  std::string packet = fmt::format(
      "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
      "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
      "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\"\n"
      "    xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\"\n"
      "    xmlns:ridgecraft=\"urn:ridgecraft:\">\n"
      "<pdf:Keywords>{}</pdf:Keywords>\n"
      "<pdf:Producer>{}</pdf:Producer>\n"
      "<xmp:CreatorTool>{}</xmp:CreatorTool>\n"
      "<xmp:CreateDate>2000-01-01T00:00:00Z</xmp:CreateDate>\n"
      "<dc:format>application/pdf</dc:format>\n"
      "<dc:language><rdf:Bag><rdf:li>en</rdf:li></rdf:Bag></dc:language>\n"
      "<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">{}</rdf:li></rdf:Alt></dc:title>\n",
      xml_text(mark_word(mark)), xml_text(mark.producer), xml_text(mark.producer), xml_text(mark.title));
  if (!mark.settings.empty()) {
    packet += fmt::format("<ridgecraft:settings>{}</ridgecraft:settings>\n",
                          xml_text(settings_json(mark.settings)));
  }
  return packet + "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>\n";
}

namespace {

cairo_status_t append_bytes(void* out, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

QPDFObjectHandle xmp_stream(QPDF& pdf, const Mark& mark) {
  QPDFObjectHandle stream = pdf.newStream(xmp_packet(mark));
  stream.getDict().replaceKey("/Type", QPDFObjectHandle::newName("/Metadata"));
  stream.getDict().replaceKey("/Subtype", QPDFObjectHandle::newName("/XML"));
  return stream;
}

/// Page labels 1, 2, 3 (ISO 32000-1, 12.4.2).
QPDFObjectHandle numbers_from_one() {
  QPDFObjectHandle style = QPDFObjectHandle::newDictionary();
  style.replaceKey("/S", QPDFObjectHandle::newName("/D"));
  QPDFObjectHandle ranges = QPDFObjectHandle::newArray();
  ranges.appendItem(QPDFObjectHandle::newInteger(0));
  ranges.appendItem(style);
  QPDFObjectHandle labels = QPDFObjectHandle::newDictionary();
  labels.replaceKey("/Nums", ranges);
  return labels;
}

}  // namespace

std::string cairo_pdf(std::span<const Drawing> pages,
                      const std::function<void(cairo_t*, const Drawing&)>& paint) {
  std::string bytes;
  const CairoSurface surface(cairo_pdf_surface_create_for_stream(append_bytes, &bytes, 1.0, 1.0));
  check_cairo(cairo_surface_status(surface.get()));
  // Cairo would write the time of the run.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  {
    const CairoContext cairo(cairo_create(surface.get()));
    for (const Drawing& page : pages) {
      cairo_pdf_surface_set_size(surface.get(), page.size.x * points_per_mm, page.size.y * points_per_mm);
      paint(cairo.get(), page);
      cairo_show_page(cairo.get());
    }
    check_cairo(cairo_status(cairo.get()));
  }
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()));
  return bytes;
}

void add_viewer_preferences(QPDF& pdf) {
  QPDFObjectHandle preferences = QPDFObjectHandle::newDictionary();
  preferences.replaceKey("/PrintScaling", QPDFObjectHandle::newName("/None"));
  preferences.replaceKey("/DisplayDocTitle", QPDFObjectHandle::newBool(true));
  pdf.getRoot().replaceKey("/ViewerPreferences", preferences);
}

void add_information(QPDF& pdf, const Mark& mark) {
  QPDFObjectHandle info = QPDFObjectHandle::newDictionary();
  info.replaceKey("/Title", QPDFObjectHandle::newUnicodeString(printable_utf8(mark.title)));
  info.replaceKey("/Creator", QPDFObjectHandle::newUnicodeString(printable_utf8(mark.producer)));
  info.replaceKey("/Producer", QPDFObjectHandle::newUnicodeString(printable_utf8(mark.producer)));
  info.replaceKey("/Keywords", QPDFObjectHandle::newString(mark_word(mark)));
  if (!mark.preset.empty()) {
    info.replaceKey("/Subject", QPDFObjectHandle::newString("preset:" + mark.preset));
  }
  // Fixed, so that two runs give the same bytes.
  info.replaceKey("/CreationDate", QPDFObjectHandle::newString("D:20000101000000Z"));
  pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(info));
  QPDFObjectHandle root = pdf.getRoot();
  root.replaceKey("/Lang", QPDFObjectHandle::newString("en"));
  root.replaceKey("/Metadata", xmp_stream(pdf, mark));
  root.replaceKey("/PageLabels", numbers_from_one());
}

std::string pdf_bytes(QPDF& pdf) {
  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setDeterministicID(true);
  writer.setMinimumPDFVersion("1.6");          // PrintScaling
  writer.setObjectStreamMode(qpdf_o_disable);  // the mark stays readable without a PDF library
  writer.setStreamDataMode(qpdf_s_compress);
  writer.write();
  const auto buffer = writer.getBufferSharedPointer();
  return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

}  // namespace ridgecraft::export_
