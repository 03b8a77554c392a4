// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/formats/pdf_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "base/text.hpp"
#include "export/formats/pdf_file.hpp"
#include "export/formats/text_file.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

/// Codes that Latin-1 has no letters for.
constexpr std::array<std::array<unsigned, 2>, 2> free_codes{{{0x01, 0x1f}, {0x80, 0x9f}}};

QPDFObjectHandle name(const std::string& text) {
  return QPDFObjectHandle::newName(text);
}
QPDFObjectHandle whole(std::size_t number) {
  return QPDFObjectHandle::newInteger(static_cast<long long>(number));
}
QPDFObjectHandle numbers(const std::vector<double>& values) {
  QPDFObjectHandle list = QPDFObjectHandle::newArray();
  for (const double value : values) {
    list.appendItem(QPDFObjectHandle::newReal(value, 4));
  }
  return list;
}

/// From one letter to the next, in thousandths of the height of capitals.
double advance(char32_t letter) {
  std::string once;
  append_utf8(once, letter);
  return 1000.0 * (text_width(once + once, 1.0) - text_width(once, 1.0));
}

/// Which letter a code is, for programs that search (ISO 32000-1, 9.10.3).
std::string letters_by_code(const std::map<unsigned char, char32_t>& letters) {
  std::string out =
      "/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n"
      "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
      "/CMapName /Adobe-Identity-UCS def /CMapType 2 def\n"
      "1 begincodespacerange <00> <ff> endcodespacerange\n";
  constexpr std::size_t most_in_block = 100;
  std::size_t left = letters.size();
  std::size_t in_block = 0;
  for (const auto& [code, letter] : letters) {
    if (in_block == 0) {
      append(out, "{} beginbfchar\n", std::min(left, most_in_block));
    }
    append(out, "<{:02x}> <", code);
    if (letter < 0x10000) {
      append(out, "{:04x}>\n", static_cast<unsigned>(letter));
    } else {
      const auto beyond = static_cast<unsigned>(letter) - 0x10000U;
      append(out, "{:04x}{:04x}>\n", 0xd800U + (beyond >> 10U), 0xdc00U + (beyond & 0x3ffU));
    }
    --left;
    if (++in_block == most_in_block || left == 0) {
      out += "endbfchar\n";
      in_block = 0;
    }
  }
  return out + "endcmap CMapName currentdict /CMap defineresource pop end end\n";
}

}  // namespace

unsigned char PdfWords::code_of(char32_t letter) {
  if (const auto known = others_.find(letter); known != others_.end()) {
    return known->second;
  }
  auto code = static_cast<unsigned char>('?');
  if ((letter >= 0x20 && letter < 0x7f) || (letter >= 0xa0 && letter < 0x100)) {
    code = static_cast<unsigned char>(letter);
  } else {
    for (const auto& [first, last] : free_codes) {
      for (unsigned free = first; code == '?' && free <= last; ++free) {
        code = used_[free] ? code : static_cast<unsigned char>(free);
      }
    }
    others_.emplace(letter, code);
  }
  used_[code] = true;
  return code;
}

std::string PdfWords::show(const Text& text) {
  // Level, whichever way the letters run: programs that search put together words of level letters alone.
  const Vec2 start =
      points_per_mm * (text.centre - 0.5 * Vec2{text_width(text.text, text.height), text.height});
  std::string out = "BT 3 Tr /Words ";
  append(out, "{} Tf 1 0 0 1 {} {} Tm <", decimals(points_per_mm * text.height), decimals(start.x),
         decimals(start.y));
  for (const char32_t letter : code_points(printable_utf8(text.text))) {
    append(out, "{:02x}", code_of(letter));
  }
  return out + "> Tj ET\n";
}

QPDFObjectHandle PdfWords::font(QPDF& pdf) const {
  std::map<unsigned char, char32_t> letters;
  for (unsigned code = 0; code < used_.size(); ++code) {
    if (used_[code]) {
      letters.emplace(static_cast<unsigned char>(code), static_cast<char32_t>(code));
    }
  }
  for (const auto& [letter, code] : others_) {
    if (code != '?') {
      letters[code] = letter;
    }
  }
  QPDFObjectHandle shapes = QPDFObjectHandle::newDictionary();
  QPDFObjectHandle differences = QPDFObjectHandle::newArray();
  std::vector<double> widths(letters.empty() ? 0 : letters.rbegin()->first - letters.begin()->first + 1U);
  for (const auto& [code, letter] : letters) {
    const std::string shape = fmt::format("/u{:04X}", static_cast<unsigned>(letter));
    const double width = advance(letter);
    shapes.replaceKey(shape, pdf.newStream(fmt::format("{:.4f} 0 d0\n", width)));
    differences.appendItem(whole(code));
    differences.appendItem(name(shape));
    widths[code - letters.begin()->first] = width;
  }
  QPDFObjectHandle encoding = QPDFObjectHandle::newDictionary();
  encoding.replaceKey("/Type", name("/Encoding"));
  encoding.replaceKey("/Differences", differences);
  QPDFObjectHandle font = QPDFObjectHandle::newDictionary();
  font.replaceKey("/Type", name("/Font"));
  font.replaceKey("/Subtype", name("/Type3"));
  font.replaceKey("/Name", name("/Words"));
  font.replaceKey("/FontBBox", numbers({0.0, -300.0, 1000.0, 1000.0}));
  font.replaceKey("/FontMatrix", numbers({0.001, 0.0, 0.0, 0.001, 0.0, 0.0}));
  font.replaceKey("/CharProcs", shapes);
  font.replaceKey("/Encoding", encoding);
  font.replaceKey("/FirstChar", whole(letters.empty() ? 0 : letters.begin()->first));
  font.replaceKey("/LastChar", whole(letters.empty() ? 0 : letters.rbegin()->first));
  font.replaceKey("/Widths", numbers(widths));
  font.replaceKey("/Resources", QPDFObjectHandle::newDictionary());
  font.replaceKey("/ToUnicode", pdf.newStream(letters_by_code(letters)));
  return pdf.makeIndirectObject(font);
}

namespace {

/// Whether a text continues what was said before it: on the same row, or as the next row of one paragraph.
bool continues(const Text& before, const Text& text) {
  if (before.heading != text.heading) {
    return false;
  }
  const auto low = [](const Text& t) {
    return t.centre - 0.5 * Vec2{text_width(t.text, t.height), t.height};
  };
  const Vec2 step = low(text) - low(before);
  constexpr double same_mm = 0.01;
  constexpr double row_step = 2.5;  // of the height; rows are 1.5 apart
  const bool same_row = std::abs(step.y) < same_mm && step.x > 0.0;
  const bool next_row = std::abs(step.x) < same_mm && step.y < 0.0 && -step.y < row_step * text.height;
  return same_row || (next_row && !before.text.ends_with('.'));
}

class TaggedPages {
 public:
  explicit TaggedPages(QPDF& pdf) : pdf_(pdf) {
    root_ = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
    document_ = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
    document_.replaceKey("/Type", name("/StructElem"));
    document_.replaceKey("/S", name("/Document"));
    document_.replaceKey("/P", root_);
    document_.replaceKey("/K", QPDFObjectHandle::newArray());
  }

  void add(QPDFPageObjectHelper page, const Drawing& drawing) {
    page_ = page.getObjectHandle();
    marked_ = QPDFObjectHandle::newArray();
    content_ = "Q\nEMC\n";  // what was painted leaves its own unit behind
    for (const Group& group : drawing.groups) {
      if (group.id == "page") {
        add_foot(group);
      } else {
        add_group(group);
      }
    }
    page.addPageContents(pdf_.newStream("/Artifact BMC\nq\n"), true);
    page.addPageContents(pdf_.newStream(content_), false);
    page_.replaceKey("/StructParents", whole(pages_.size()));
    page_.replaceKey("/Tabs", name("/S"));
    pages_.push_back(page_);
    parents_.appendItem(whole(pages_.size() - 1));
    parents_.appendItem(marked_);
  }

  void finish() {
    const QPDFObjectHandle font = words_.font(pdf_);
    for (QPDFObjectHandle& page : pages_) {
      QPDFObjectHandle resources = QPDFPageObjectHelper(page).getAttribute("/Resources", true);
      QPDFObjectHandle fonts = resources.getKey("/Font");
      fonts = fonts.isDictionary() ? fonts.shallowCopy() : QPDFObjectHandle::newDictionary();
      fonts.replaceKey("/Words", font);
      resources.replaceKey("/Font", fonts);
    }
    QPDFObjectHandle tree = QPDFObjectHandle::newDictionary();
    tree.replaceKey("/Nums", parents_);
    root_.replaceKey("/Type", name("/StructTreeRoot"));
    root_.replaceKey("/K", document_);
    root_.replaceKey("/ParentTree", pdf_.makeIndirectObject(tree));
    root_.replaceKey("/ParentTreeNextKey", whole(pages_.size()));
    QPDFObjectHandle info = QPDFObjectHandle::newDictionary();
    info.replaceKey("/Marked", QPDFObjectHandle::newBool(true));
    pdf_.getRoot().replaceKey("/MarkInfo", info);
    pdf_.getRoot().replaceKey("/StructTreeRoot", root_);
  }

 private:
  void add_group(const Group& group) {
    const Text* before = nullptr;
    auto figure = group.figures.begin();
    for (std::size_t i = 0; i <= group.texts.size(); ++i) {
      for (; figure != group.figures.end() && figure->texts_before == i; ++figure) {
        add_figure(*figure);
        before = nullptr;
      }
      if (i == group.texts.size()) {
        break;
      }
      const Text& text = group.texts[i];
      if (before == nullptr || !continues(*before, text)) {
        begin(text.heading == 0 ? "/P" : fmt::format("/H{}", text.heading));
      }
      mark(words_.show(text));
      before = &text;
    }
  }

  /// The same on each page.
  void add_foot(const Group& group) {
    content_ += "/Artifact <</Type /Pagination>> BDC\n";
    for (const Text& text : group.texts) {
      content_ += words_.show(text);
    }
    content_ += "EMC\n";
  }

  void add_figure(const Figure& figure) {
    begin("/Figure");
    element_.replaceKey("/Alt", QPDFObjectHandle::newUnicodeString(printable_utf8(figure.words)));
    QPDFObjectHandle layout = QPDFObjectHandle::newDictionary();
    layout.replaceKey("/O", name("/Layout"));
    layout.replaceKey("/Placement", name("/Block"));
    const Vec2 low = points_per_mm * figure.place.low;
    const Vec2 high = points_per_mm * figure.place.high;
    layout.replaceKey("/BBox", numbers({low.x, low.y, high.x, high.y}));
    element_.replaceKey("/A", layout);
    mark("");
  }

  void begin(const std::string& kind) {
    kind_ = kind;
    element_ = pdf_.makeIndirectObject(QPDFObjectHandle::newDictionary());
    element_.replaceKey("/Type", name("/StructElem"));
    element_.replaceKey("/S", name(kind));
    element_.replaceKey("/P", document_);
    element_.replaceKey("/Pg", page_);
    element_.replaceKey("/K", QPDFObjectHandle::newArray());
    document_.getKey("/K").appendItem(element_);
  }

  /// The next content of the element.
  void mark(const std::string& content) {
    const auto number = static_cast<std::size_t>(marked_.getArrayNItems());
    append(content_, "{} <</MCID {}>> BDC\n{}EMC\n", kind_, number, content);
    element_.getKey("/K").appendItem(whole(number));
    marked_.appendItem(element_);
  }

  QPDF& pdf_;
  PdfWords words_;
  QPDFObjectHandle root_, document_;
  QPDFObjectHandle parents_ = QPDFObjectHandle::newArray();  ///< numbers of pages, each with its elements
  std::vector<QPDFObjectHandle> pages_;
  QPDFObjectHandle page_;
  QPDFObjectHandle marked_;   ///< the elements of the page's marked contents
  QPDFObjectHandle element_;  ///< that is being filled
  std::string kind_;
  std::string content_;
};

}  // namespace

void add_tagged_words(QPDF& pdf, std::span<const Drawing> pages) {
  TaggedPages tagged(pdf);
  const std::vector<QPDFPageObjectHelper> sheets = QPDFPageDocumentHelper(pdf).getAllPages();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    tagged.add(sheets[i], pages[i]);
  }
  tagged.finish();
}

}  // namespace ridgecraft::export_
