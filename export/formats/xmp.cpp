// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/xmp.hpp"

#include <string_view>

#include <fmt/format.h>

#include "base/utf8.hpp"
#include "base/xml_text.hpp"

namespace ridgecraft::paper {
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

}  // namespace ridgecraft::paper
