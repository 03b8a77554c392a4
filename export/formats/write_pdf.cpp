// SPDX-License-Identifier: GPL-3.0-or-later
// PDF of all pages. Cairo paints each layer as a file of its own; qpdf lays them over each other as optional
// content, so that a viewer can switch layers and a machine can pick one, and says that the pages are not to
// be scaled.
#include <algorithm>
#include <cmath>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "base/error.hpp"
#include "base/text.hpp"
#include "export/formats/cairo_page.hpp"
#include "export/formats/pdf_file.hpp"
#include "export/formats/pdf_words.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"
#include "export/style/line_style.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

/// One layer of all pages.
std::string layer_pdf(std::span<const Drawing> pages, Layer layer) {
  return cairo_pdf(pages, [layer](cairo_t* cairo, const Drawing& page) {
    paint_layer(cairo, page, layer, points_per_mm);
  });
}

/// The pages as they are printed: each with its back behind it, where any has one.
std::vector<Drawing> sides_of(std::span<const Drawing> pages) {
  std::vector<Drawing> sides;
  for (const Drawing& page : pages) {
    sides.push_back(page);
    sides.push_back(page);
    sides.back().groups = page.back;
  }
  return sides;
}

/// "1", "back of 1", "2" (ISO 32000-1, 12.4.2).
QPDFObjectHandle labels_of_sides(std::span<const Drawing> sides) {
  QPDFObjectHandle ranges = QPDFObjectHandle::newArray();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    QPDFObjectHandle label = QPDFObjectHandle::newDictionary();
    if (i % 2 == 1) {
      label.replaceKey("/P", QPDFObjectHandle::newString("back of "));
    }
    label.replaceKey("/S", QPDFObjectHandle::newName("/D"));
    label.replaceKey("/St", QPDFObjectHandle::newInteger(sides[i].page));
    ranges.appendItem(QPDFObjectHandle::newInteger(static_cast<long long>(i)));
    ranges.appendItem(label);
  }
  QPDFObjectHandle labels = QPDFObjectHandle::newDictionary();
  labels.replaceKey("/Nums", ranges);
  return labels;
}

class PdfAssembler {
 public:
  /// `duplex`: every other page is the back of the one before.
  PdfAssembler(std::span<const Drawing> pages, bool duplex, const Mark& mark)
      : pages_(pages), duplex_(duplex), mark_(mark) {
    pdf_.emptyPDF();
    words_resources_ = pdf_.makeIndirectObject(QPDFObjectHandle::newDictionary());
    contents_.resize(pages.size());
    for (std::size_t i = 0; i < pages.size(); ++i) {
      resources_.push_back(QPDFObjectHandle::newDictionary());
    }
  }

  std::string write() {
    for (const Layer layer : layer_order) {
      const bool any =
          std::ranges::any_of(pages_, [&](const Drawing& page) { return has_layer(page, layer); });
      if (!is_optional(layer) || any) {
        add_layer(layer);
      }
    }
    QPDFObjectHandle fonts = QPDFObjectHandle::newDictionary();
    fonts.replaceKey("/Words", words_.font(pdf_));
    words_resources_.replaceKey("/Font", fonts);
    add_pages();
    add_catalogue();
    add_information(pdf_, mark_);
    if (duplex_) {
      pdf_.getRoot().replaceKey("/PageLabels", labels_of_sides(pages_));
    }
    return pdf_bytes(pdf_);
  }

 private:
  /// A layer's own file.
  struct Source {
    std::string bytes;
    QPDF pdf;
  };

  void add_layer(Layer layer) {
    QPDFObjectHandle group = QPDFObjectHandle::newDictionary();
    group.replaceKey("/Type", QPDFObjectHandle::newName("/OCG"));
    group.replaceKey("/Name", QPDFObjectHandle::newUnicodeString(std::string(title(layer))));
    group = pdf_.makeIndirectObject(group);
    groups_.emplace_back(layer, group);
    Source& source = sources_.emplace_back();
    source.bytes = layer_pdf(pages_, layer);
    source.pdf.processMemoryFile(std::string(id(layer)).c_str(), source.bytes.data(), source.bytes.size());
    auto source_pages = QPDFPageDocumentHelper(source.pdf).getAllPages();
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      if (!has_layer(pages_[i], layer)) {
        continue;
      }
      QPDFObjectHandle form = form_of(source_pages[i]);
      form.getDict().replaceKey("/OC", group);
      const std::string name = fmt::format("/{}", id(layer));
      resources_[i].replaceKey(name, form);
      contents_[i] += name + " Do\n";
      if (layer != Layer::paint) {
        add_words(i, layer, group);
      }
    }
  }

  /// The words of a layer over their letters, but for those that are set in a font and words by themselves.
  void add_words(std::size_t page, Layer layer, const QPDFObjectHandle& group) {
    std::string content;
    for (const Group& part : pages_[page].groups) {
      for (const Text& text : part.texts) {
        if (text.layer == layer && stroke_font_covers(text.text)) {
          content += words_.show(text);
        }
      }
    }
    if (content.empty()) {
      return;
    }
    QPDFObjectHandle form = pdf_.newStream(content);
    QPDFObjectHandle dictionary = form.getDict();
    dictionary.replaceKey("/Type", QPDFObjectHandle::newName("/XObject"));
    dictionary.replaceKey("/Subtype", QPDFObjectHandle::newName("/Form"));
    dictionary.replaceKey("/BBox", box_of(page));
    dictionary.replaceKey("/Resources", words_resources_);
    dictionary.replaceKey("/OC", group);
    const std::string name = fmt::format("/{}-words", id(layer));
    resources_[page].replaceKey(name, form);
    contents_[page] += name + " Do\n";
  }

  [[nodiscard]] QPDFObjectHandle box_of(std::size_t page) const {
    const Vec2 size = points_per_mm * pages_[page].size;
    QPDFObjectHandle box = QPDFObjectHandle::newArray();
    for (const double value : {0.0, 0.0, size.x, size.y}) {
      box.appendItem(real(value));
    }
    return box;
  }

  /// A page of a layer's file as a form. Cairo's pages have one content stream: it is taken as it is,
  /// compressed, which halves the time against QPDFPageObjectHelper::getFormXObjectForPage (unpacks and packs
  /// it again).
  QPDFObjectHandle form_of(QPDFPageObjectHelper& page) {
    QPDFObjectHandle contents = page.getObjectHandle().getKey("/Contents");
    if (!contents.isStream()) {
      return pdf_.copyForeignObject(page.getFormXObjectForPage());
    }
    QPDFObjectHandle form = pdf_.copyForeignObject(contents);
    QPDFObjectHandle dictionary = form.getDict();
    dictionary.replaceKey("/Type", QPDFObjectHandle::newName("/XObject"));
    dictionary.replaceKey("/Subtype", QPDFObjectHandle::newName("/Form"));
    dictionary.replaceKey("/BBox", page.getMediaBox().shallowCopy());
    QPDFObjectHandle resources = page.getAttribute("/Resources", false);
    dictionary.replaceKey("/Resources", resources.isIndirect()
                                            ? pdf_.copyForeignObject(resources)
                                            : pdf_.copyForeignObject(source_indirect(page, resources)));
    return form;
  }
  /// qpdf copies indirect objects only.
  static QPDFObjectHandle source_indirect(QPDFPageObjectHelper& page, const QPDFObjectHandle& object) {
    return page.getObjectHandle().getOwningQPDF()->makeIndirectObject(object);
  }

  static QPDFObjectHandle real(double value) { return QPDFObjectHandle::newReal(value, 4); }

  void add_pages() {
    QPDFPageDocumentHelper document(pdf_);
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      const QPDFObjectHandle box = box_of(i);
      QPDFObjectHandle resources = QPDFObjectHandle::newDictionary();
      resources.replaceKey("/XObject", resources_[i]);
      QPDFObjectHandle page = QPDFObjectHandle::newDictionary();
      page.replaceKey("/Type", QPDFObjectHandle::newName("/Page"));
      page.replaceKey("/MediaBox", box);
      page.replaceKey("/TrimBox", box);
      page.replaceKey("/Resources", resources);
      page.replaceKey("/Contents", pdf_.newStream(contents_[i]));
      document.addPage(QPDFPageObjectHelper(pdf_.makeIndirectObject(page)), false);
    }
  }

  void add_catalogue() {
    const auto all = [](Layer) { return true; };
    const auto cuts = [](Layer layer) { return layer == Layer::cut; };
    const auto printed = [](Layer layer) { return layer != Layer::cut; };
    QPDFObjectHandle others = QPDFObjectHandle::newArray();
    others.appendItem(configuration("Print without cut lines", printed));
    others.appendItem(configuration("Cut lines only", cuts));
    QPDFObjectHandle properties = QPDFObjectHandle::newDictionary();
    properties.replaceKey("/OCGs", layers(all));
    properties.replaceKey("/D", configuration("All", all));
    properties.replaceKey("/Configs", others);
    pdf_.getRoot().replaceKey("/OCProperties", properties);
    add_viewer_preferences(pdf_);
  }

  template <class Wanted>
  [[nodiscard]] QPDFObjectHandle layers(Wanted wanted) const {
    QPDFObjectHandle list = QPDFObjectHandle::newArray();
    for (const auto& [layer, group] : groups_) {
      if (wanted(layer)) {
        list.appendItem(group);
      }
    }
    return list;
  }

  /// Which layers are seen, for one use of the file (ISO 32000-1, 8.11.4.3); without a base state, for
  /// readers that know the default one alone.
  template <class Wanted>
  QPDFObjectHandle configuration(const char* name, Wanted wanted) const {
    QPDFObjectHandle off = layers([&](Layer layer) { return !wanted(layer); });
    QPDFObjectHandle result = QPDFObjectHandle::newDictionary();
    result.replaceKey("/Name", QPDFObjectHandle::newString(name));
    result.replaceKey("/Creator", QPDFObjectHandle::newUnicodeString(printable_utf8(mark_.producer)));
    result.replaceKey("/Order", layers([](Layer) { return true; }));
    result.replaceKey("/ON", layers(wanted));
    if (off.getArrayNItems() > 0) {
      result.replaceKey("/OFF", off);
    }
    return result;
  }

  std::span<const Drawing> pages_;
  bool duplex_;
  const Mark& mark_;
  std::list<Source> sources_;  ///< before pdf_, which reads their streams when it is written
  QPDF pdf_;
  std::vector<std::pair<Layer, QPDFObjectHandle>> groups_;  ///< bottom to top
  std::vector<QPDFObjectHandle> resources_;
  std::vector<std::string> contents_;
  PdfWords words_;
  QPDFObjectHandle words_resources_;
};

}  // namespace

void check_pdf_size(Vec2 page) {
  if (std::max(page.x, page.y) > longest_pdf_side_mm) {
    throw Error(ErrorKind::usage,
                Message("paper_too_long_for_pdf", {{"width", fmt::format("{:g}", page.x)},
                                                   {"height", fmt::format("{:g}", page.y)},
                                                   {"most", fmt::format("{:g}", longest_pdf_side_mm)}}));
  }
}

std::string write_pdf(std::span<const Drawing> pages, const Mark& mark) {
  for (const Drawing& page : pages) {
    check_pdf_size(page.size);
  }
  try {
    const bool duplex = std::ranges::any_of(pages, [](const Drawing& page) { return !page.back.empty(); });
    const std::vector<Drawing> sides = duplex ? sides_of(pages) : std::vector<Drawing>();
    return duplex ? PdfAssembler(sides, true, mark).write() : PdfAssembler(pages, false, mark).write();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {  // qpdf throws several kinds
    throw Error(ErrorKind::internal, std::string("putting the PDF together failed: ") + failure.what());
  }
}

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
    add_tagged_words(pdf, pages);
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

std::string write_eps(const Drawing& page, const Mark& mark, const Preset& preset) {
  std::string out = "%!PS-Adobe-3.0 EPSF-3.0\n";
  const Vec2 size = points_per_mm * page.size;
  append(out, "%%Creator: {}\n%%Title: page {} of {}\n%%Keywords: {}\n", printable_utf8(mark.producer),
         page.page, page.page_count, mark_word(mark));
  append(out, "%%BoundingBox: 0 0 {:.0f} {:.0f}\n%%HiResBoundingBox: 0 0 {} {}\n", std::ceil(size.x),
         std::ceil(size.y), decimals(size.x), decimals(size.y));
  out += "%%LanguageLevel: 2\n%%Pages: 1\n%%EndComments\n%%Page: 1 1\ngsave\n";
  // Points are written in mm: numbers stay those of the other formats.
  append(out, "{0:.9f} {0:.9f} scale\n{1} setlinewidth\n", points_per_mm, decimals(preset.width));
  std::optional<Operation> operation;
  for (const Path& path : machine_paths(page, preset.paths)) {
    if (operation != path.operation) {
      operation = path.operation;
      const Color c = preset.colors[static_cast<std::size_t>(path.operation)];
      append(out, "% {}\n{} {} {} setrgbcolor\n", word(path.operation), decimals(c.red / 255.0),
             decimals(c.green / 255.0), decimals(c.blue / 255.0));
    }
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      append(out, "{} {} {}\n", decimals(path.points[i].x), decimals(path.points[i].y),
             i == 0 ? "moveto" : "lineto");
    }
    out += path.closed ? "closepath stroke\n" : "stroke\n";
  }
  out += "grestore\nshowpage\n%%EOF\n";
  return out;
}

}  // namespace ridgecraft::export_
