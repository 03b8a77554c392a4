// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft verify tells.
#include <fmt/format.h>

#include "base/sentence.hpp"
#include "cli/telling/lengths.hpp"
#include "cli/telling/summary.hpp"

namespace ridgecraft::cli {
namespace {

/// What was looked at besides the nets themselves.
std::string beside_nets_text(const verify::Report& report) {
  std::string text;
  if (report.folding && !report.folding->with_care.empty()) {
    text += fmt::format("  with care   {} to be folded with care: {}\n",
                        counted(report.folding->with_care.size(), "piece"),
                        listed(report.folding->with_care, "and"));
  }
  if (report.model) {
    const verify::ModelFigures& m = *report.model;
    text += fmt::format("  model       at most {:.3g} mm apart{}, at {:.6g} mm per unit{}\n", m.deviation_mm,
                        m.allowed_mm ? fmt::format(" ({:.3g} mm allowed)", *m.allowed_mm) : "", m.mm_per_unit,
                        m.same_file.value_or(true) ? "" : "; the file isn't the one that the nets name");
  }
  if (report.printed) {
    const verify::PrintedFigures& p = *report.printed;
    text += fmt::format(
        "  printed     {}, lines at most {:.3g} mm beside their places{}\n", counted(p.pages, "page"),
        p.max_error_mm,
        p.pages_not_given == 0 ? "" : fmt::format("; {} not given", counted(p.pages_not_given, "page")));
  }
  return text;
}

}  // namespace

std::string summary(const VerifyJob& job, const verify::Report& report) {
  std::string text;
  if (report.figures) {
    const verify::Figures& f = *report.figures;
    text += fmt::format("{}: {}, {}, {}\n", job.file, counted(f.faces, "face"), counted(f.pieces, "piece"),
                        counted(f.pages, "page"));
    text += fmt::format("  lengths     largest error {:.3g} mm\n", f.max_length_error_mm);
    text += fmt::format("  overlaps    {} of faces, {} of tabs, deepest {:.3g} mm\n", f.overlaps,
                        f.tab_overlaps, f.max_penetration_mm);
    text += fmt::format("  coverage    {} missing, {} double\n", f.missing_faces, f.double_faces);
    text += fmt::format("  pages       {} outside\n", f.outside_page);
    text += fmt::format("  joins       {}, {} bad, {} without tab, {}\n", f.joins, f.bad_joins,
                        f.joins_without_tab, counted(f.tabs, "tab"));
    text += fmt::format("  refolding   largest error {:.3g} mm, folds {:.3g} degrees\n",
                        f.max_refold_error_mm, f.max_fold_error_deg);
    text += fmt::format("  lines       {} to cut, {} to fold\n", metres(f.cut_mm), metres(f.fold_mm));
    text += beside_nets_text(report);
  }
  if (!report.figures) {
    text += fmt::format("{}: not in the form of nets, so nothing else was checked\n", job.file);
  }
  for (const verify::Fault& fault : report.faults) {
    text += fmt::format("fault of promise {}: {}\n", static_cast<int>(fault.promise), fault.message);
  }
  if (report.sound()) {
    text += "no faults\n";
  }
  return text;
}

}  // namespace ridgecraft::cli
