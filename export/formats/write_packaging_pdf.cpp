// SPDX-License-Identifier: GPL-3.0-or-later
// PDF for packaging shops: what is cut, creased and glued are lines in inks of their own that overprint
// (separation colours, ISO 32000-1, 8.6.6.4), each in a layer that says which step of processing it is (ISO
// 19593-1). Cairo writes neither such inks nor overprint, so the few operators that this takes are written
// here, and qpdf adds the objects.
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "base/error.hpp"
#include "export/formats/pdf_file.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::export_ {
namespace {

/// Of areas of glue, mm.
constexpr double hatching_mm = 2.0;

/// In the order in which they are painted.
enum class Step { glue, crease, perforate, cut, notes };
constexpr std::size_t step_count = 5;

struct StepRow {
  std::string_view layer;    ///< for people
  std::string_view process;  ///< of ISO 19593-1; none: not a step
  /// Cyan, magenta, yellow, black: how the ink is shown where it isn't printed.
  std::array<double, 4> shown;
};

constexpr std::array<StepRow, step_count> steps{{{"Glue", "Gluing", {0.0, 0.0, 1.0, 0.0}},
                                                 {"Crease", "Creasing", {1.0, 0.0, 0.0, 0.0}},
                                                 {"Perforate", "Perforating", {0.0, 1.0, 1.0, 0.0}},
                                                 {"Cut", "Cutting", {0.0, 1.0, 0.0, 0.0}},
                                                 {"Notes", "", {0.0, 0.0, 0.0, 1.0}}}};

QPDFObjectHandle numbers(std::span<const double> values) {
  QPDFObjectHandle array = QPDFObjectHandle::newArray();
  for (const double value : values) {
    array.appendItem(QPDFObjectHandle::newReal(value, 4));
  }
  return array;
}

class PackagingPdf {
 public:
  PackagingPdf(std::span<const Drawing> pages, const Mark& mark, const Preset& preset, const SpotNames& spots)
      : pages_(pages), mark_(mark), preset_(preset), spots_(spots) {
    pdf_.emptyPDF();
  }

  std::string write() {
    std::vector<std::array<std::string, step_count>> contents;
    for (const Drawing& page : pages_) {
      contents.push_back(content_of(page));
      for (std::size_t i = 0; i < step_count; ++i) {
        used_[i] = used_[i] || !contents.back()[i].empty();
      }
    }
    for (std::size_t i = 0; i < step_count; ++i) {
      if (used_[i]) {
        groups_[i] = layer(i);
      }
    }
    const QPDFObjectHandle resources = shared_resources();
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      add_page(pages_[i], contents[i], resources);
    }
    add_catalogue();
    add_viewer_preferences(pdf_);
    add_information(pdf_, mark_);
    return pdf_bytes(pdf_);
  }

 private:
  [[nodiscard]] Step step_of(Operation operation) const {
    switch (operation) {
      case Operation::cut_inner:
      case Operation::cut_outer:
        return Step::cut;
      case Operation::mountain:
      case Operation::valley:
      case Operation::tab_fold:
        return preset_.paths.scores == Scores::perforate ? Step::perforate : Step::crease;
      case Operation::engrave:
      case Operation::registration:
        break;
    }
    return Step::notes;
  }

  static void add_path(std::span<const Vec2> points, bool closed, std::string& out) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      append(out, "{} {} {} ", decimals(points[i].x), decimals(points[i].y), i == 0 ? "m" : "l");
    }
    out += closed ? "h S\n" : "S\n";
  }

  /// Numbers and names are always there: in a layer that isn't printed they serve whoever glues.
  [[nodiscard]] std::array<std::string, step_count> content_of(const Drawing& page) const {
    std::array<std::string, step_count> content;
    PathRules rules = preset_.paths;
    rules.engraves = true;
    if (rules.scores == Scores::perforate) {
      rules.scores = Scores::solid;  // the ink says what it is
    }
    for (const Path& path : machine_paths(page, rules)) {
      add_path(path.points, path.closed, content[static_cast<std::size_t>(step_of(path.operation))]);
    }
    for (const Group& group : page.groups) {
      for (const Area& area : group.areas) {
        if (area.layer == Layer::tab_fill) {
          for (const auto& line : hatching(area.outline, hatching_mm)) {
            add_path(line, false, content[static_cast<std::size_t>(Step::glue)]);
          }
        }
      }
    }
    return content;
  }

  QPDFObjectHandle layer(std::size_t step) {
    QPDFObjectHandle group = QPDFObjectHandle::newDictionary();
    group.replaceKey("/Type", QPDFObjectHandle::newName("/OCG"));
    group.replaceKey("/Name", QPDFObjectHandle::newUnicodeString(std::string(steps[step].layer)));
    if (steps[step].process.empty()) {
      // Seen on a screen, not on a print.
      group.replaceKey("/Usage", QPDFObjectHandle::parse("<< /Print << /Subtype /Print /PrintState /OFF >> "
                                                         "/View << /ViewState /ON >> >>"));
    } else {
      group.replaceKey("/GTS_Metadata", QPDFObjectHandle::parse(fmt::format(
                                            "<< /GTS_ProcStepsGroup /Structural /GTS_ProcStepsType /{} >>",
                                            steps[step].process)));
    }
    return pdf_.makeIndirectObject(group);
  }

  [[nodiscard]] const std::string& ink_name(Step step) const {
    switch (step) {
      case Step::glue:
        return spots_.glue;
      case Step::crease:
        return spots_.crease;
      case Step::perforate:
        return spots_.perforation;
      case Step::cut:
      case Step::notes:
        break;
    }
    return spots_.cut;
  }

  QPDFObjectHandle ink(std::size_t step) {
    QPDFObjectHandle tint = QPDFObjectHandle::parse("<< /FunctionType 2 /Domain [0 1] /C0 [0 0 0 0] /N 1 >>");
    tint.replaceKey("/C1", numbers(steps[step].shown));
    QPDFObjectHandle space = QPDFObjectHandle::newArray();
    space.appendItem(QPDFObjectHandle::newName("/Separation"));
    space.appendItem(QPDFObjectHandle::newName("/" + ink_name(static_cast<Step>(step))));
    space.appendItem(QPDFObjectHandle::newName("/DeviceCMYK"));
    space.appendItem(tint);
    return pdf_.makeIndirectObject(space);
  }

  QPDFObjectHandle shared_resources() {
    QPDFObjectHandle spaces = QPDFObjectHandle::newDictionary();
    QPDFObjectHandle properties = QPDFObjectHandle::newDictionary();
    for (std::size_t i = 0; i < step_count; ++i) {
      if (!used_[i]) {
        continue;
      }
      properties.replaceKey(fmt::format("/L{}", i), groups_[i]);
      if (static_cast<Step>(i) != Step::notes) {
        spaces.replaceKey(fmt::format("/S{}", i), ink(i));
      }
    }
    QPDFObjectHandle resources =
        QPDFObjectHandle::parse("<< /ExtGState << /GS << /Type /ExtGState /OP true /op true /OPM 1 >> >> >>");
    resources.replaceKey("/ColorSpace", spaces);
    resources.replaceKey("/Properties", properties);
    return pdf_.makeIndirectObject(resources);
  }

  void add_page(const Drawing& page, const std::array<std::string, step_count>& content,
                const QPDFObjectHandle& resources) {
    std::string out = fmt::format("/GS gs\n{0:.6f} 0 0 {0:.6f} 0 0 cm\n{1} w 1 J 1 j\n", points_per_mm,
                                  decimals(preset_.width));
    for (std::size_t i = 0; i < step_count; ++i) {
      if (content[i].empty()) {
        continue;
      }
      append(out, "/OC /L{} BDC\n", i);
      out += static_cast<Step>(i) == Step::notes ? "0 0 0 1 K\n" : fmt::format("/S{0} CS 1 SCN\n", i);
      out += content[i];
      out += "EMC\n";
    }
    const std::array<double, 4> box{0.0, 0.0, page.size.x * points_per_mm, page.size.y * points_per_mm};
    QPDFObjectHandle made = QPDFObjectHandle::newDictionary();
    made.replaceKey("/Type", QPDFObjectHandle::newName("/Page"));
    for (const char* name : {"/MediaBox", "/TrimBox", "/BleedBox"}) {
      made.replaceKey(name, numbers(box));
    }
    made.replaceKey("/Resources", resources);
    made.replaceKey("/Contents", pdf_.newStream(out));
    QPDFPageDocumentHelper(pdf_).addPage(QPDFPageObjectHelper(pdf_.makeIndirectObject(made)), false);
  }

  void add_catalogue() {
    QPDFObjectHandle order = QPDFObjectHandle::newArray();
    for (std::size_t i = 0; i < step_count; ++i) {
      if (used_[i]) {
        order.appendItem(groups_[i]);
      }
    }
    QPDFObjectHandle defaults = QPDFObjectHandle::newDictionary();
    defaults.replaceKey("/Name", QPDFObjectHandle::newString("Layers"));
    defaults.replaceKey("/Order", order);
    defaults.replaceKey("/ON", order);
    if (used_[static_cast<std::size_t>(Step::notes)]) {
      QPDFObjectHandle notes = QPDFObjectHandle::newArray();
      notes.appendItem(groups_[static_cast<std::size_t>(Step::notes)]);
      QPDFObjectHandle usage = QPDFObjectHandle::parse("<< /Event /Print /Category [/Print] >>");
      usage.replaceKey("/OCGs", notes);
      QPDFObjectHandle usages = QPDFObjectHandle::newArray();
      usages.appendItem(usage);
      defaults.replaceKey("/AS", usages);
    }
    QPDFObjectHandle properties = QPDFObjectHandle::newDictionary();
    properties.replaceKey("/OCGs", order);
    properties.replaceKey("/D", defaults);
    pdf_.getRoot().replaceKey("/OCProperties", properties);
  }

  std::span<const Drawing> pages_;
  const Mark& mark_;
  const Preset& preset_;
  const SpotNames& spots_;
  QPDF pdf_;
  std::array<bool, step_count> used_{};
  std::array<QPDFObjectHandle, step_count> groups_;
};

}  // namespace

std::string write_packaging_pdf(std::span<const Drawing> pages, const Mark& mark, const Preset& preset,
                                const SpotNames& spots) {
  for (const Drawing& page : pages) {
    check_pdf_size(page.size);
  }
  try {
    return PackagingPdf(pages, mark, preset, spots).write();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {  // qpdf throws several kinds
    throw Error(ErrorKind::internal, std::string("putting the PDF together failed: ") + failure.what());
  }
}

}  // namespace ridgecraft::export_
