// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft MODEL: the main job.
#include <fmt/format.h>

#include "base/option_values.hpp"
#include "base/version.hpp"
#include "cli/arguments/machine_options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"
#include "job/option_fields.hpp"

namespace ridgecraft::cli {
namespace {

ManualSection verbs_section() {
  return {"Verbs for single steps",
          {{"info MODEL", "What a file holds, and what had to be repaired."},
           {"segment MODEL", "Cut a model into nearly convex parts; coloured mesh and labels."},
           {"unfold MODEL", "Nets without pages, as a FOLD file."},
           {"verify FILE.fold", "Check a file of nets: lengths, overlaps, pages, joins, refolding."},
           {"hulls MODEL", "One convex hull per part, as OBJ or URDF."},
           {"cage MODEL", "A coarse closed mesh around a model."},
           {"shell MODEL", "A watertight mesh around a broken model."},
           {"deform MODEL", "Move a model as the cage around it is moved."},
           {"studio [MODEL]", "A page in the browser that makes paper, with controls for all wishes."},
           {"formats", "The formats that are read and written."}}};
}

ManualSection exit_section() {
  return {"Exit codes",
          {{"0", "Done."},
           {"1", "A mistake of the program itself."},
           {"2", "Wrong option or argument."},
           {"3", "The input can't be read."},
           {"4", "The mesh can't be used."},
           {"5", "No nets of this model can be cut from this paper."},
           {"6", "verify found faults."},
           {"7", "A result can't be written."},
           {"8", "All files were written, but the summary can't be printed."},
           {"9", "With --strict: nobody could build it at this size."},
           {"130", "Interrupted."}}};
}

void set_paper(const job::AskedOptions& asked, PaperJob& job) {
  export_::Paper& sheet = *job.options.paper;
  const Vec2 named = sheet.size;
  fit_to_machine(asked, job, sheet);
  job.paper_name =
      sheet.size == named ? asked.text("paper") : fmt::format("{:g}x{:g}mm", sheet.size.x, sheet.size.y);
  const Vec2 area = export_::piece_area(sheet);
  if (!(area.x >= 20.0 && area.y >= 20.0)) {
    refuse("paper " + job.paper_name + " with a margin of " + fmt::format("{:g}", sheet.margin) +
           " mm leaves no room for pieces");
  }
}

std::optional<Vec2> calibration_of(const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  const std::size_t at = text.find('x');
  const auto measured = [&](const std::string& part) {
    const auto mm = parse_length_mm(part);
    if (at == std::string::npos || !mm || *mm < 95.0 || *mm > 105.0) {
      refuse(
          "--calibrate takes what 100 mm came out as, across and up, such as 100.4x99.6, each from 95 to "
          "105; "
          "not '" +
          text + "'");
    }
    return *mm;
  };
  const double across = measured(text.substr(0, at));
  return Vec2{across, measured(text.substr(at + 1))};
}

void set_ink(const job::AskedOptions& asked, PaperJob& job) {
  // What a machine cuts out bears no colours, unless somebody says that it is printed before.
  if (!asked.given("ink") && job.preset.is_machine() && !job.print_and_cut) {
    job.options.style.ink = export_::Ink::lines;
    if (asked.given("dpi")) {
      refuse("--dpi is about printed pictures; with a machine's preset there are none");
    }
  }
}

PaperJob job_of(const job::AskedOptions& asked, std::string model) {
  require(model, "name the model to turn into paper", "ridgecraft");
  PaperJob job;
  job.model = std::move(model);
  job.common = common_of(asked);
  job.outputs = asked.texts("output");
  job.overwrite = asked.flag("overwrite");
  job.page = !asked.flag("no-page");
  job.tab_file = asked.text("tab-file");
  job.options.guide = !asked.flag("no-guide");
  job.options.size.adapts = true;
  job.options = job::options_of(asked, std::move(job.options));
  job.options.style.hidden_fold_angle = asked.number("hide-folds");
  job.size_asked = size_of(asked);
  job.edges = edges_of(asked, job.options.simplify);
  job.most_pages = asked.whole("most-pages");
  job.calibration = calibration_of(asked.text("calibrate"));
  set_machine(asked, job);
  set_paper(asked, job);
  set_ink(asked, job);
  return job;
}

}  // namespace

Job build_paper(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft",
            "turns 3D models into paper: parts, nets without overlap, pages to print, cut, fold and glue");
  verb.usage("ridgecraft MODEL [options]").usage("ridgecraft VERB ... (ridgecraft VERB --help tells more)");
  verb.example(
      "ridgecraft whale.obj",
      "Pages for a whale of 150 mm, in this folder: whale.pdf with whale-guide.pdf, whale.html, whale.fold "
      "and whale.svg (also whale-1.svg and so on where there are several pages).");
  verb.example("ridgecraft penguin.obj --size 30cm --paper A3 -o out", "Larger, on A3, into the folder out.");
  verb.example("ridgecraft house.obj --scale 1:500 --unit m -o house.pdf",
               "A house drawn in metres, at a scale.");
  verb.example("ridgecraft fox_head.obj --pieces few", "As few pieces as the paper allows.");
  std::string model;
  verb.option("Input", "MODEL", model, "MODEL",
              model_formats() +
                  "; the content decides, not the suffix. - reads standard input; files whose "
                  "names begin with - follow --, which ends the options.");
  job::AskedOptions asked;
  for (const Option& row : option_table()) {
    verb.add(row, asked);
  }
  bool version = false;
  verb.flag("Common", "--version", version, "Print the program's version.");
  bool man = false;
  verb.flag("", "--man-page", man, "Print the manual page.");
  verb.section(verbs_section()).section(exit_section());
  return verb.finish(arguments, manual, [&]() -> Job {
    if (version) {
      return PrintJob{program_and_version() + "\n"};
    }
    if (man) {
      return PrintJob{man_page_wanted};
    }
    return job_of(asked, std::move(model));
  });
}

}  // namespace ridgecraft::cli
