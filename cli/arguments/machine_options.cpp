// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/machine_options.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "base/sentence.hpp"
#include "cli/arguments/option_values.hpp"
#include "cli/files/formats.hpp"

namespace ridgecraft::cli {
namespace {

constexpr double hairline_mm = 0.01;
constexpr double widest_kerf_mm = 2.0;
constexpr std::uint64_t most_bridges = 50;
/// Between the cuts of neighbours there stays so much paper, mm.
constexpr double paper_between_mm = 0.5;

const Choices<paper::DxfKind> dxf_kinds{
    {"r2000", paper::DxfKind::r2000}, {"r12", paper::DxfKind::r12}, {"plain", paper::DxfKind::plain}};

constexpr std::array all_scores{paper::Scores::solid, paper::Scores::dashes, paper::Scores::perforate,
                                paper::Scores::ends, paper::Scores::none};

std::vector<std::string> preset_words() {
  std::vector<std::string> words{"print"};
  for (const paper::Preset& preset : paper::presets()) {
    words.emplace_back(preset.name);
  }
  return words;
}

paper::Preset preset_named(const std::string& name) {
  if (name.empty() || name == "print") {
    return {};
  }
  for (const paper::Preset& preset : paper::presets()) {
    if (name == preset.name) {
      return preset;
    }
  }
  refuse_choice("--preset", preset_words(), name);
}

std::string words_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, "|"));
}

std::string score_words() {
  std::string words;
  for (const paper::Scores scores : all_scores) {
    words += (words.empty() ? "" : "|") + std::string(word(scores));
  }
  return words;
}

std::vector<std::string> operation_words() {
  std::vector<std::string> words;
  for (int i = 0; i < paper::operation_count; ++i) {
    words.emplace_back(word(static_cast<paper::Operation>(i)));
  }
  return words;
}

/// "#ff8000"
paper::Color colour_or_refuse(const std::string& option, const std::string& text) {
  const auto is_digit = [](unsigned char c) { return std::isxdigit(c) != 0; };
  if (text.size() != 7 || text[0] != '#' || !std::all_of(text.begin() + 1, text.end(), is_digit)) {
    refuse(option + " takes colours such as #ff8000, not '" + text + "'");
  }
  const auto value = [&](std::size_t at) {
    return static_cast<std::uint8_t>(std::stoul(text.substr(at, 2), nullptr, 16));
  };
  return {value(1), value(3), value(5)};
}

bool names_machine_file(const std::vector<std::string>& outputs) {
  return std::ranges::any_of(outputs, [](const std::string& output) {
    const auto format = paper_format(suffix_of(output));
    return format && for_machines_alone(*format);
  });
}

/// Whether a run with these outputs, of which folders get what the preset names, writes a DXF.
bool writes_dxf(const std::vector<std::string>& outputs, const paper::Preset& preset) {
  const auto names_it = [&](const std::string& output) {
    const auto format = paper_format(suffix_of(output));
    return format ? *format == Format::dxf : preset.dxf;
  };
  return outputs.empty() ? preset.dxf : std::ranges::any_of(outputs, names_it);
}

/// A page for browsers links the nets of the surface to the sheets, and on those of board lie other nets.
void leave_page_out(PaperJob& job) {
  for (const std::string& output : job.outputs) {
    if (paper_format(suffix_of(output)) == Format::html) {
      refuse("-o " + output +
             " names a page, which shows nets of paper; with --thickness other nets lie on the sheets");
    }
  }
  job.page = false;
}

}  // namespace

void MachineTexts::add_to(Verb& verb) {
  verb.option("Machines", "--preset", preset, words_of(preset_words()),
              "Files as a machine or its program expects them, named after it: pieces alone, lines by "
              "operation (formats --presets shows them; print).");
  verb.option("Machines", "--dxf", dxf, "r2000|r12|plain",
              "Which DXF: r2000 tells the unit; r12 is for older machines; plain is single lines on one "
              "layer (r2000).");
  verb.option(
      "Machines", "--kerf", kerf, "LENGTH",
      "Width of the cut: outlines are moved outwards by half of it, holes inwards, so that pieces come "
      "out as large as drawn (laser, glowforge: 0.1mm; others: 0).");
  verb.flag("Machines", "--kerf-test", kerf_test,
            "Add a square of 20 mm with a hole of 10 mm, by which the kerf is measured.");
  verb.option(
      "Machines", "--score", score, score_words(),
      "What is done at folds: the whole line, dashes of 2 mm cut through, a perforation, lines of 4 mm "
      "beside the piece at their ends, or nothing (the preset's).");
  verb.option("Machines", "--bridges", bridges, "N",
              "Leave each outline uncut at N places, so that pieces stay in the sheet (0).");
  verb.option("Machines", "--thickness", thickness, "LENGTH",
              "Of the sheet: pieces become smaller or larger at their folds and seams, so that the model's "
              "outside is as large as asked when it is built of board; there is no NAME.html then (0).");
  verb.option(
      "Machines", "--hinge", hinge, "back|middle|front",
      "Where a fold of board turns: at its back where it is scored from the printed side, in the middle "
      "where it is creased or perforated, in front where it is grooved from behind (back where folds are "
      "whole lines, middle where they are dashes).");
  verb.option("Machines", "--bed", bed, "WxH", "The machine's work area, used to its edges (the preset's).");
  verb.option("Machines", "--engrave", engrave, "on|off",
              "Whether numbers and names are written on the pieces (the preset's).");
  verb.list("Machines", "--colour", colours, "OPERATION=#RRGGBB",
            "Colour of an operation's lines: " + listed(operation_words(), "or") +
                ". May be given for several (the preset's).");
  verb.list("Machines", "--spot", spots, "STEP=NAME",
            "Name of the ink of a step in a packaging shop's PDF: cut=CutContour, perforate=PerfCutContour, "
            "crease=Crease, glue=Glue. May be given for several.");
  verb.flag("Machines", "--print-and-cut", print_and_cut,
            "Two files for each sheet, in one place: a PDF with colours, numbers and registration marks, and "
            "what is cut.");
  verb.flag("Machines", "--hairline", hairline, "Lines 0.01 mm wide, for drivers that cut nothing wider.");
  verb.option("Machines", "--svg-px", svg_px, "96|72",
              "SVG in pixels, so many an inch, for programs that pass over millimetres.");
}

std::string MachineTexts::first_given() const {
  const std::array<std::pair<const char*, bool>, 10> given{{{"--kerf", !kerf.empty()},
                                                            {"--bed", !bed.empty()},
                                                            {"--spot", !spots.empty()},
                                                            {"--kerf-test", kerf_test},
                                                            {"--score", !score.empty()},
                                                            {"--bridges", !bridges.empty()},
                                                            {"--engrave", !engrave.empty()},
                                                            {"--colour", !colours.empty()},
                                                            {"--hairline", hairline},
                                                            {"--svg-px", !svg_px.empty()}}};
  const auto first = std::ranges::find_if(given, [](const auto& g) { return g.second; });
  return first == given.end() ? "" : first->first;
}

void MachineTexts::set_colours(paper::Preset& made) const {
  const std::vector<std::string> words = operation_words();
  for (const std::string& text : colours) {
    const std::size_t equals = text.find('=');
    const std::string operation = text.substr(0, equals);
    const auto found = std::ranges::find(words, operation);
    if (equals == std::string::npos || found == words.end()) {
      refuse("--colour takes OPERATION=#RRGGBB with " + listed(words, "or") + " for the operation, not '" +
             text + "'");
    }
    made.colors[static_cast<std::size_t>(found - words.begin())] =
        colour_or_refuse("--colour " + operation, text.substr(equals + 1));
  }
}

void MachineTexts::set_spots(PaperJob& job) const {
  constexpr std::size_t longest_name = 60;
  const std::vector<std::pair<std::string, std::string*>> steps{{"cut", &job.spots.cut},
                                                                {"perforate", &job.spots.perforation},
                                                                {"crease", &job.spots.crease},
                                                                {"glue", &job.spots.glue}};
  for (const std::string& text : spots) {
    const std::size_t equals = text.find('=');
    const auto found =
        std::ranges::find_if(steps, [&](const auto& step) { return step.first == text.substr(0, equals); });
    const std::string name = equals == std::string::npos ? "" : text.substr(equals + 1);
    const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
    if (found == steps.end() || name.empty() || name.size() > longest_name ||
        !std::ranges::all_of(name, is_plain)) {
      refuse(
          "--spot takes STEP=NAME with cut, perforate, crease or glue for the step, and letters, digits, - "
          "and _ for the name, not '" +
          text + "'");
    }
    *found->second = name;
  }
  if (!spots.empty() && !job.preset.pdf) {
    refuse("--spot is about a packaging shop's PDF: --preset packaging");
  }
}

void MachineTexts::set_board(PaperJob& job, paper::Preset& made) const {
  constexpr double thickest_mm = 20.0;
  constexpr double board_mm = 1.0;
  constexpr double bridge_of_board_mm = 0.25;  // stiffer than card
  if (!hinge.empty() && thickness.empty()) {
    refuse("--hinge is about thick sheets: give --thickness");
  }
  if (thickness.empty()) {
    return;
  }
  paper::Board& board = job.options.board;
  board.thickness_mm = length_or_refuse("--thickness", thickness, true);
  require_range("--thickness", thickness, board.thickness_mm, 0.0, thickest_mm, "0 to 20mm");
  if (board.thickness_mm > 0.0) {
    leave_page_out(job);
  }
  if (board.thickness_mm > board_mm) {
    made.paths.board = true;
    made.paths.bridges.width_mm = bridge_of_board_mm;
  }
  const bool whole_lines = made.paths.scores == paper::Scores::solid && !made.pdf;
  const paper::Hinge usual = whole_lines ? paper::Hinge::back : paper::Hinge::middle;
  board.hinge = hinge.empty() ? usual
                              : choice_or_refuse<paper::Hinge>("--hinge", hinge,
                                                               {{"back", paper::Hinge::back},
                                                                {"middle", paper::Hinge::middle},
                                                                {"front", paper::Hinge::front}});
}

void MachineTexts::set_print_and_cut(PaperJob& job, paper::Preset& made) const {
  job.print_and_cut = print_and_cut;
  if (!print_and_cut) {
    return;
  }
  if (!made.is_machine() || made.simulates) {
    refuse("--print-and-cut needs a machine that cuts: --preset silhouette or another");
  }
  if (made.own_marks) {
    refuse("--print-and-cut: " + std::string(made.name) +
           " adds registration marks of its own to what is printed");
  }
  if (!bed.empty()) {
    refuse("--print-and-cut is about a printer's sheet: --paper names it, --bed doesn't");
  }
  // Numbers are printed.
  made.paths.engraves = made.paths.engraves && !engrave.empty();
}

void MachineTexts::check_into(PaperJob& job) const {
  paper::Preset made = preset_named(preset);
  if (const std::string given = first_given();
      !given.empty() && !made.is_machine() && !names_machine_file(job.outputs)) {
    refuse(given + " is about files for machines: --preset names one, or -o such a file (NAME.dxf)");
  }
  if (const std::string given = thickness.empty() ? first_given() : "--thickness";
      made.simulates && !given.empty()) {
    refuse(given + " is about what is cut; a simulator of folding cuts nothing");
  }
  if (!dxf.empty()) {
    made.dxf_kind = choice_or_refuse<paper::DxfKind>("--dxf", dxf, dxf_kinds);
    if (!writes_dxf(job.outputs, made)) {
      refuse(
          "--dxf tells which DXF, and none is written: name one (-o NAME.dxf) or a preset with DXF (--preset "
          "laser)");
    }
  }
  if (!kerf.empty()) {
    made.paths.kerf_mm = length_or_refuse("--kerf", kerf, true);
    require_range("--kerf", kerf, made.paths.kerf_mm, 0.0, widest_kerf_mm, "0 to 2mm");
  }
  if (!score.empty()) {
    Choices<paper::Scores> choices;
    for (const paper::Scores scores : all_scores) {
      choices.emplace_back(word(scores), scores);
    }
    made.paths.scores = choice_or_refuse<paper::Scores>("--score", score, choices);
  }
  if (!bridges.empty()) {
    const std::uint64_t count = whole_number_or_refuse("--bridges", bridges, 0);
    if (count > most_bridges) {
      refuse(fmt::format("--bridges takes 0 to {}, not {}", most_bridges, bridges));
    }
    made.paths.bridges.count = static_cast<int>(count);
  }
  if (!engrave.empty()) {
    made.paths.engraves = choice_or_refuse<bool>("--engrave", engrave, {{"on", true}, {"off", false}});
  }
  set_colours(made);
  if (hairline) {
    made.width = hairline_mm;
  }
  if (!svg_px.empty()) {
    made.svg_units_per_inch = choice_or_refuse<double>("--svg-px", svg_px, {{"96", 96.0}, {"72", 72.0}});
  }
  set_board(job, made);
  set_print_and_cut(job, made);
  job.kerf_test = kerf_test;
  job.preset = made;
  set_spots(job);
}

void MachineTexts::require_back(const PaperJob& job) const {
  if (job.print_and_cut) {
    return;
  }
  if (job.preset.is_machine()) {
    refuse("--numbers back prints on the other side of the sheet, which files of --preset " +
           std::string(job.preset.name) + " don't have; without it numbers stand on the pieces");
  }
  if (names_machine_file(job.outputs)) {
    refuse(
        "--numbers back prints on the other side of the sheet, which DXF and other files for machines don't "
        "have");
  }
}

void MachineTexts::fit_paper(const PaperJob& job, bool paper_given, bool margin_given,
                             paper::Paper& paper) const {
  if (!bed.empty() && paper_given) {
    refuse("--bed and --paper both tell the sheet: give one of them");
  }
  if (!bed.empty()) {
    paper.size = paper::parse_paper(bed).size;
  } else if (!paper_given && !job.print_and_cut && job.preset.sheet.x > 0.0) {
    paper.size = job.preset.sheet;
  }
  if (!paper_given && !margin_given && !job.print_and_cut && (!bed.empty() || job.preset.sheet.x > 0.0)) {
    paper.margin = bed.empty() ? job.preset.margin : 0.0;
  }
  if (job.preset.is_machine() || !bed.empty()) {
    paper.foot = 0.0;
    paper.furniture = false;
  }
  if (job.print_and_cut) {
    paper::fit_registration(paper);
  }
  const double kerf_mm = job.preset.paths.kerf_mm;
  if (kerf_mm > 0.0) {
    // A mitre reaches a whole kerf out of a corner.
    paper.margin = std::max(paper.margin, kerf_mm);
    paper.gap = std::max(paper.gap, 2.0 * kerf_mm + paper_between_mm);
  }
}

}  // namespace ridgecraft::cli
