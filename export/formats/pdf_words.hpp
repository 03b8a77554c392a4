// SPDX-License-Identifier: GPL-3.0-or-later
// Words of PDF files that people search and have read to them. Letters are drawn as lines; over them lies the
// same text, invisible (text rendering mode 3), in a font whose letters are as wide and have no shape.
#pragma once

#include <bitset>
#include <map>
#include <span>
#include <string>

#include <qpdf/QPDF.hh>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// The font of a document's invisible words. Latin-1 has its own codes, other letters get free ones as they
/// come (63 of them; what is beyond is a question mark).
class PdfWords {
 public:
  /// Operators that show the text around its centre.
  std::string show(const Text& text);
  /// The font with the letters that were shown, for the resources of what shows them ("/Words").
  [[nodiscard]] QPDFObjectHandle font(QPDF& pdf) const;

 private:
  unsigned char code_of(char32_t letter);

  std::bitset<256> used_;
  std::map<char32_t, unsigned char> others_;  ///< letters beyond Latin-1
};

/// What a guide says, in the order in which it is read: headings, paragraphs (rows that continue each other
/// are one), and pictures with what is to be seen on them. Everything that is drawn becomes an artifact
/// (ISO 32000-1, 14.7 and 14.8). Pages and drawings correspond.
void add_tagged_words(QPDF& pdf, std::span<const Drawing> pages);

}  // namespace ridgecraft::export_
