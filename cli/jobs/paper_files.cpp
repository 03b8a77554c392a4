// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/paper_files.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "export/sheet/calibration.hpp"

namespace ridgecraft::cli {
namespace {

void calibrate(std::vector<paper::Drawing>& pages, const PaperJob& job) {
  if (job.calibration) {
    std::ranges::transform(pages, pages.begin(), [&](paper::Drawing& page) {
      return paper::calibrated(std::move(page), *job.calibration);
    });
  }
}

/// Lists of numbers at the end have pages of their own, which no machine needs.
std::vector<paper::Drawing> machine_pages(const job::Paper& made, const PaperJob& job) {
  std::vector<paper::Drawing> pages(made.drawings.begin(),
                                    made.drawings.begin() + static_cast<std::ptrdiff_t>(made.pages.count));
  if (job.kerf_test) {
    paper::add_kerf_test(pages, made.pages.paper);
  }
  // Kerfs are measured on what comes out of the machine, like everything else.
  calibrate(pages, job);
  if (job.print_and_cut) {
    for (paper::Drawing& page : pages) {
      page.groups.push_back(paper::registration_marks(page.size));
    }
  }
  return pages;
}

std::string svg_of(const Sheets& sheets, std::size_t page, const PaperJob& job) {
  const job::Paper& made = sheets.made;
  if (!job.preset.is_machine()) {
    return page == sheets.drawings.size() ? paper::write_svg_of_all(sheets.drawings, sheets.mark)
                                          : paper::write_svg(sheets.drawings[page], sheets.mark);
  }
  return job.preset.simulates
             ? paper::write_simulator_svg(made.prepared, made.nets, made.pages, PageId(page), made.mark)
             : paper::write_machine_svg(sheets.for_machine[page], sheets.mark, job.preset);
}

std::string pdf_of(const Target& target, const Sheets& sheets, const PaperJob& job) {
  if (target.shows == Shows::guide) {
    return paper::write_guide_pdf(sheets.made.guide.pages, sheets.made.mark);
  }
  if (target.shows == Shows::cut) {
    return paper::write_packaging_pdf(sheets.for_machine, sheets.mark, job.preset, job.spots);
  }
  if (target.shows != Shows::print) {
    return paper::write_pdf(sheets.drawings, sheets.mark);
  }
  std::vector<paper::Drawing> pages;
  std::ranges::transform(sheets.drawings, std::back_inserter(pages), paper::printed_page);
  return paper::write_pdf(pages, sheets.mark);
}

}  // namespace

Sheets sheets_for(std::span<const Target> targets, const job::Paper& made, const PaperJob& job) {
  Sheets sheets{made, made.drawings, made.mark, {}};
  sheets.mark.preset = job.preset.name;
  calibrate(sheets.drawings, job);
  if (job.calibration) {
    sheets.mark.settings["calibrate"] = fmt::format("[{},{}]", job.calibration->x, job.calibration->y);
  }
  if (std::any_of(targets.begin(), targets.end(),
                  [](const Target& target) { return target.shows == Shows::cut; })) {
    sheets.for_machine = machine_pages(made, job);
  }
  return sheets;
}

std::size_t page_count(const Target& target, const Sheets& sheets) {
  return target.shows == Shows::cut ? sheets.for_machine.size() : sheets.drawings.size();
}

std::string file_bytes(const Target& target, std::size_t i, const Sheets& sheets, const PaperJob& job) {
  switch (target.format) {
    case Format::pdf:
      return pdf_of(target, sheets, job);
    case Format::svg:
      return svg_of(sheets, i, job);
    case Format::png:
      return paper::write_png(sheets.drawings[i], sheets.mark);
    case Format::dxf:
      return paper::write_dxf(sheets.for_machine[i], sheets.mark, job.preset.dxf_kind, job.preset.paths);
    case Format::lbrn:
      return paper::write_lbrn(sheets.for_machine[i], sheets.mark, job.preset.paths);
    case Format::eps:
      return paper::write_eps(sheets.for_machine[i], sheets.mark, job.preset);
    case Format::plt:
      return paper::write_plt(sheets.for_machine[i], sheets.mark, job.preset.paths);
    case Format::fold:
      return sheets.made.fold;
    case Format::html:
      return paper::write_html(sheets.made.fold, sheets.made.drawings, sheets.made.mark);
  }
  RIDGECRAFT_ASSERT(false);
  return {};
}

}  // namespace ridgecraft::cli
