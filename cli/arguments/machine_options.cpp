// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/machine_options.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "base/option_values.hpp"
#include "base/text.hpp"
#include "cli/files/formats.hpp"

namespace ridgecraft::cli {
namespace {

constexpr double hairline_mm = 0.01;
/// Between the cuts of neighbours there stays so much paper, mm.
constexpr double paper_between_mm = 0.5;

/// Only machines heed these.
constexpr std::array machine_only{"kerf",    "bed",     "spot",   "kerf-test", "score",
                                  "bridges", "engrave", "colour", "hairline",  "svg-px"};

export_::Preset preset_named(const std::string& name) {
  for (const export_::Preset& preset : export_::presets()) {
    if (name == preset.name) {
      return preset;
    }
  }
  return {};
}

std::vector<std::string> operation_words() {
  std::vector<std::string> words;
  for (int i = 0; i < export_::operation_count; ++i) {
    words.emplace_back(word(static_cast<export_::Operation>(i)));
  }
  return words;
}

/// "#ff8000"
export_::Color colour_or_refuse(const std::string& option, const std::string& text) {
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
bool writes_dxf(const std::vector<std::string>& outputs, const export_::Preset& preset) {
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

/// Refuses what has no effect on the files that are written.
void check_effect(const job::AskedOptions& asked, const PaperJob& job, const export_::Preset& made) {
  const auto* const first =
      std::ranges::find_if(machine_only, [&](const char* name) { return asked.given(name); });
  const std::string given = first == machine_only.end() ? "" : asked.called(*first);
  if (!given.empty() && !made.is_machine() && !names_machine_file(job.outputs)) {
    refuse(given + " is about files for machines: --preset names one, or -o such a file (NAME.dxf)");
  }
  if (made.simulates && (!given.empty() || asked.given("thickness"))) {
    refuse((asked.given("thickness") ? "--thickness" : given) +
           " is about what is cut; a simulator of folding cuts nothing");
  }
}

void set_colours(const job::AskedOptions& asked, export_::Preset& made) {
  const std::vector<std::string> words = operation_words();
  for (const std::string& text : asked.texts("colour")) {
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

void set_spots(const job::AskedOptions& asked, PaperJob& job) {
  constexpr std::size_t longest_name = 60;
  const std::vector<std::pair<std::string, std::string*>> steps{{"cut", &job.spots.cut},
                                                                {"perforate", &job.spots.perforation},
                                                                {"crease", &job.spots.crease},
                                                                {"glue", &job.spots.glue}};
  for (const std::string& text : asked.texts("spot")) {
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
}

void set_board(const job::AskedOptions& asked, PaperJob& job, export_::Preset& made) {
  constexpr double board_mm = 1.0;
  constexpr double bridge_of_board_mm = 0.25;  // stiffer than card
  export_::Board& board = job.options.board;
  if (board.thickness_mm > 0.0) {
    leave_page_out(job);
  }
  if (board.thickness_mm > board_mm) {
    made.paths.board = true;
    made.paths.bridges.width_mm = bridge_of_board_mm;
  }
  const bool whole_lines = made.paths.scores == export_::Scores::solid && !made.pdf;
  if (asked.given("thickness") && !asked.given("hinge")) {
    board.hinge = whole_lines ? export_::Hinge::back : export_::Hinge::middle;
  }
}

void set_print_and_cut(const job::AskedOptions& asked, PaperJob& job, export_::Preset& made) {
  job.print_and_cut = asked.flag("print-and-cut");
  if (!job.print_and_cut) {
    return;
  }
  if (!made.is_machine() || made.simulates) {
    refuse("--print-and-cut needs a machine that cuts: --preset silhouette or another");
  }
  if (made.own_marks) {
    refuse("--print-and-cut: " + std::string(made.name) +
           " adds registration marks of its own to what is printed");
  }
  // Numbers are printed.
  made.paths.engraves = made.paths.engraves && asked.given("engrave");
}

/// Numbers on the back need files that have one.
void check_back(const PaperJob& job) {
  if (job.options.style.numbers != export_::Numbers::back || job.print_and_cut) {
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

/// What options change of a preset.
void change_preset(const job::AskedOptions& asked, export_::Preset& made) {
  if (asked.given("kerf")) {
    made.paths.kerf_mm = asked.number("kerf");
  }
  if (asked.given("score")) {
    made.paths.scores = asked.choice_as<export_::Scores>("score");
  }
  if (asked.given("bridges")) {
    made.paths.bridges.count = static_cast<int>(asked.whole("bridges"));
  }
  if (asked.given("engrave")) {
    made.paths.engraves = asked.choice("engrave") == 0;
  }
  if (asked.flag("hairline")) {
    made.width = hairline_mm;
  }
  if (asked.given("svg-px")) {
    made.svg_units_per_inch = asked.choice("svg-px") == 0 ? 96.0 : 72.0;
  }
  set_colours(asked, made);
}

}  // namespace

void set_machine(const job::AskedOptions& asked, PaperJob& job) {
  static_cast<void>(asked.choice("preset"));
  export_::Preset made = preset_named(asked.text("preset"));
  check_effect(asked, job, made);
  if (asked.given("dxf")) {
    made.dxf_kind = asked.choice_as<export_::DxfKind>("dxf");
    if (!writes_dxf(job.outputs, made)) {
      refuse(
          "--dxf tells which DXF, and none is written: name one (-o NAME.dxf) or a preset with DXF (--preset "
          "laser)");
    }
  }
  change_preset(asked, made);
  set_board(asked, job, made);
  set_print_and_cut(asked, job, made);
  job.kerf_test = asked.flag("kerf-test");
  job.preset = made;
  set_spots(asked, job);
  check_back(job);
}

void fit_to_machine(const job::AskedOptions& asked, const PaperJob& job, export_::Paper& paper) {
  const bool paper_given = asked.given("paper");
  const bool bed_given = asked.given("bed");
  if (bed_given) {
    paper.size = export_::parse_paper(asked.text("bed")).size;
  } else if (!paper_given && !job.print_and_cut && job.preset.sheet.x > 0.0) {
    paper.size = job.preset.sheet;
  }
  if (!paper_given && !asked.given("margin") && !job.print_and_cut &&
      (bed_given || job.preset.sheet.x > 0.0)) {
    paper.margin = bed_given ? 0.0 : job.preset.margin;
  }
  if (job.preset.is_machine() || bed_given) {
    paper.foot = 0.0;
    paper.furniture = false;
  }
  if (job.print_and_cut) {
    export_::fit_registration(paper);
  }
  const double kerf_mm = job.preset.paths.kerf_mm;
  if (kerf_mm > 0.0) {
    // A mitre reaches a whole kerf out of a corner.
    paper.margin = std::max(paper.margin, kerf_mm);
    paper.gap = std::max(paper.gap, 2.0 * kerf_mm + paper_between_mm);
  }
}

}  // namespace ridgecraft::cli
