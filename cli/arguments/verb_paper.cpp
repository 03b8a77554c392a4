// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft MODEL: the main job.
#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "base/version.hpp"
#include "cli/arguments/edge_options.hpp"
#include "cli/arguments/machine_options.hpp"
#include "cli/arguments/option_values.hpp"
#include "cli/arguments/piece_options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/tab_options.hpp"
#include "cli/arguments/units.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

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

/// What is typed after the options that this verb alone has.
struct PaperTexts {
  std::string paper;
  std::string margin, calibrate, concavity, most_pages;
  TabTexts tabs;
  std::string hide = "3";
  std::string numbers, duplex;
  std::string ink, dpi;
  bool keep_bodies = false;
  std::string skins = "outer";
  std::string page_by = "any";
  std::string pack = "fast";
  std::string grain = "any";

  void add_to(Verb& verb, PaperJob& job) {
    verb.option("Paper", "--paper", paper, "NAME|WxH",
                "A0 to A7, B0 to B6, letter, legal, tabloid and others, -landscape added to turn it, or a "
                "size such as 300x200mm (A4).");
    verb.option("Paper", "--margin", margin, "LENGTH",
                "What the printer can't reach, on all four sides (10mm).");
    verb.option(
        "Paper", "--calibrate", calibrate, "WxH",
        "What comes out where 100 mm were printed, across the sheet and up it, such as 100.4x99.6: twice "
        "the length of the bar of 50 mm. Pages are drawn so that the next ones have the right size.");
    verb.option("Paper", "--most-pages", most_pages, "N",
                "A model that would take more pages is refused before the long work, with a size that takes "
                "few (300).");
    verb.option(
        "Paper", "--page-by", page_by, "material|object",
        "Only pieces of one material, or of one object, on a page, for paper in several colours: cuts "
        "run along the borders between them (any).");
    verb.option("Paper", "--pack", pack, "fast|good",
                "How long a search for fewer sheets takes: hundredths of a second, or tenths (fast).");
    verb.option(
        "Paper", "--grain", grain, "any|long|short",
        "Lay pieces so that most of their folds run along the sheet's long or short side, as the paper's "
        "grain does: folds across it crack. Takes more sheets at times (any).");
    tabs.add_to(verb, job);
    verb.option("Tabs and lines", "--hide-folds", hide, "DEGREES",
                "Draw no line where the surface is folded by less than this (3).");
    verb.option("Tabs and lines", "--numbers", numbers, "inside|tabs|outside|back",
                "Where the numbers of edges stand: on the pieces and their tabs; on tabs, and beside the "
                "piece at edges "
                "without one; beside the pieces; on the back of the paper, which the PDF gets pages for "
                "(inside).");
    verb.option("Tabs and lines", "--duplex", duplex, "long|short",
                "With --numbers back: over which edge the printer turns the sheets (long).");
    verb.option(
        "Colours", "--ink", ink, "colour|pale|lines",
        "Print the model's colours and pictures, print them as light tints, or print lines alone (colour; "
        "lines with a machine's preset).");
    verb.option("Colours", "--dpi", dpi, "DOTS", "Dots an inch of printed pictures (300).");
    verb.flag(
        "Parts", "--keep-bodies", keep_bodies,
        "Leave bodies that touch or run into each other as they are, hidden faces and all; without it they "
        "become one outer skin.");
    verb.option(
        "Parts", "--skins", skins, "outer|middle|both",
        "Walls thinner than 3 mm become a sheet: their outer skin, or one in the middle of the wall; both "
        "leaves inside and outside (outer).");
    verb.option("Parts", "--concavity", concavity, "TOLERANCE",
                "How far a part may be from convex, as a share of the radius of the model's bounding sphere "
                "(0.1).");
  }

  /// Throws Error(usage).
  void check_into(PaperJob& job, const MachineTexts& machines) const {
    check_paper(job, machines);
    check_calibration(job);
    if (!most_pages.empty()) {
      job.most_pages = whole_number_or_refuse("--most-pages", most_pages, 1);
    }
    job.options.bodies = keep_bodies ? prepare::Bodies::keep : prepare::Bodies::unite;
    const Choices<prepare::Skins> skin_choices{
        {"outer", prepare::Skins::outer}, {"middle", prepare::Skins::middle}, {"both", prepare::Skins::both}};
    job.options.simplify.skins = choice_or_refuse<prepare::Skins>("--skins", skins, skin_choices);
    job.options.concavity = concavity_or_refuse(concavity);
    const Choices<job::PageBy> page_choices{
        {"any", job::PageBy::any}, {"material", job::PageBy::material}, {"object", job::PageBy::object}};
    job.options.page_by = choice_or_refuse<job::PageBy>("--page-by", page_by, page_choices);
    tabs.check_into(job);
    if (tabs.height.empty()) {
      job.options.tabs.height_mm +=
          job.options.board.thickness_mm;  // which a tab loses to the board behind it
    }
    job.options.style.hidden_fold_angle = number_or_refuse("--hide-folds", hide, 0.0, 180.0) * degree;
    check_numbers(job);
    if (job.options.style.numbers == paper::Numbers::back) {
      machines.require_back(job);
    }
    check_ink(job);
  }

 private:
  void check_numbers(PaperJob& job) const {
    paper::Style& style = job.options.style;
    const Choices<paper::Numbers> places{{"inside", paper::Numbers::inside},
                                         {"tabs", paper::Numbers::tabs},
                                         {"outside", paper::Numbers::outside},
                                         {"back", paper::Numbers::back}};
    style.numbers = choice_or_refuse<paper::Numbers>("--numbers", numbers, places);
    if (style.numbers == paper::Numbers::tabs && !job.options.tabs.wanted) {
      refuse("--numbers tabs needs tabs, and there are none");
    }
    const Choices<paper::TurnedOver> turns{{"long", paper::TurnedOver::long_edge},
                                           {"short", paper::TurnedOver::short_edge}};
    style.turned_over = choice_or_refuse<paper::TurnedOver>("--duplex", duplex, turns);
    if (!duplex.empty() && style.numbers != paper::Numbers::back) {
      refuse("--duplex tells how sheets are turned over; it goes with --numbers back");
    }
  }

  void check_ink(PaperJob& job) const {
    const Choices<paper::Ink> inks{
        {"colour", paper::Ink::colour}, {"pale", paper::Ink::pale}, {"lines", paper::Ink::lines}};
    // What a machine cuts out bears no colours, unless somebody says that it is printed before.
    job.options.style.ink = !ink.empty() ? choice_or_refuse<paper::Ink>("--ink", ink, inks)
                            : job.preset.is_machine() && !job.print_and_cut ? paper::Ink::lines
                                                                            : paper::Ink::colour;
    if (!dpi.empty()) {
      if (job.options.style.ink == paper::Ink::lines) {
        refuse("--dpi is about printed pictures; with --ink lines or a machine's preset there are none");
      }
      job.options.style.dots_per_inch = number_or_refuse("--dpi", dpi, 36.0, 1200.0);
    }
  }

  void check_paper(PaperJob& job, const MachineTexts& machines) const {
    const std::string standard = "A4";
    paper::Paper sheet = paper::parse_paper(paper.empty() ? standard : paper);
    const Vec2 asked = sheet.size;
    if (!margin.empty()) {
      sheet.margin = length_or_refuse("--margin", margin, true);
    }
    sheet.packing = choice_or_refuse<paper::PackingEffort>("--pack", pack,
                                                           {{"fast", paper::PackingEffort::fast},
                                                            {"good", paper::PackingEffort::good},
                                                            {"best", paper::PackingEffort::good}});
    sheet.grain = choice_or_refuse<paper::Grain>(
        "--grain", grain,
        {{"any", paper::Grain::any}, {"long", paper::Grain::long_side}, {"short", paper::Grain::short_side}});
    machines.fit_paper(job, !paper.empty(), !margin.empty(), sheet);
    job.options.paper = sheet;
    job.paper_name = sheet.size == asked ? (paper.empty() ? standard : paper)
                                         : fmt::format("{:g}x{:g}mm", sheet.size.x, sheet.size.y);
    const Vec2 area = paper::piece_area(*job.options.paper);
    if (!(area.x >= 20.0 && area.y >= 20.0)) {
      refuse("paper " + job.paper_name + " with a margin of " +
             fmt::format("{:g}", job.options.paper->margin) + " mm leaves no room for pieces");
    }
  }

  void check_calibration(PaperJob& job) const {
    if (calibrate.empty()) {
      return;
    }
    const std::size_t at = calibrate.find('x');
    const auto measured = [&](std::string_view part) {
      const auto mm = parse_length_mm(part);
      if (at == std::string::npos || !mm || *mm < 95.0 || *mm > 105.0) {
        refuse(
            "--calibrate takes what 100 mm came out as, across and up, such as 100.4x99.6, each from 95 to "
            "105; "
            "not '" +
            calibrate + "'");
      }
      return *mm;
    };
    const std::string_view text = calibrate;
    job.calibration = {measured(text.substr(0, at)),
                       measured(at == std::string::npos ? "" : text.substr(at + 1))};
  }
};

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
  PaperJob job;
  CommonTexts common;
  SizeTexts size;
  PaperTexts texts;
  MachineTexts machines;
  PieceTexts pieces;
  bool fold_linear = false;
  verb.option("Input", "MODEL", job.model, "MODEL",
              model_formats() +
                  "; the content decides, not the suffix. - reads standard input; files whose "
                  "names begin with - follow --, which ends the options.");
  add_selection(verb, job.options.selection);
  verb.list(
      "Output", "-o,--output", job.outputs, "WHERE",
      "A folder gets all default formats (PDF, SVG, FOLD, HTML); a file's suffix names its format (.pdf, "
      ".svg, .fold, .html, .png, .dxf, .lbrn2, .eps, .plt). May be given several times (the current "
      "folder).");
  bool no_guide = false;
  verb.flag("Output", "--no-guide", no_guide,
            "Write no NAME-guide.pdf beside NAME.pdf: pictures of where each piece goes, step by step.");
  bool no_page = false;
  verb.flag(
      "Output", "--no-page", no_page,
      "Write no NAME.html: the model and its sheets side by side in any browser, folding and step by step.");
  verb.flag("Output", "--overwrite", job.overwrite,
            "Replace existing files, also those that weren't made from this model.");
  size.add_to(verb, "auto");
  verb.flag("Size", "--strict", job.options.strict,
            "Write nothing, with exit code 9, where nobody could fold the model at this size.");
  texts.add_to(verb, job);
  machines.add_to(verb);
  pieces.add_to(verb);
  verb.flag("Pieces", "--fold-linear", fold_linear, std::string(fold_linear_text));
  add_edge_options(verb, job.edges);
  common.add_to(verb, TimeUp::ends_searches);
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
    require(job.model, "name the model to turn into paper", "ridgecraft");
    job.options.guide = !no_guide;
    job.page = !no_page;
    job.common = common.checked();
    machines.check_into(job);
    size.check_into(job.options, job.size_asked);
    check_edge_options(job.edges, job.options.simplify);
    texts.check_into(job, machines);
    job.options.pieces = pieces.rules();
    job.options.pieces.fold_linear = fold_linear;
    return job;
  });
}

}  // namespace ridgecraft::cli
