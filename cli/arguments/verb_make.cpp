// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/option_values.hpp"
#include "base/version.hpp"
#include "cli/arguments/options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"
#include "cli/files/formats.hpp"
#include "job/asked_options.hpp"
#include "session/project_file.hpp"

namespace ridgecraft::cli {
namespace {

// How files for machines are wanted: --preset, and what goes before it.

constexpr double hairline_mm = 0.01;
/// Between the cuts of neighbours there stays so much paper, mm.
constexpr double paper_between_mm = 0.5;

/// Of files for machines alone.
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
    refuse(Message("option_colours", {{"option", option}, {"text", text}}));
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
void leave_page_out(MakeJob& job) {
  for (const std::string& output : job.outputs) {
    if (paper_format(suffix_of(output)) == Format::html) {
      refuse(Message("page_of_board", {{"file", output}}));
    }
  }
  job.page = false;
}

/// Refuses what has no effect on the files that are written.
void check_effect(const job::AskedOptions& asked, const MakeJob& job, const export_::Preset& made) {
  const auto* const first =
      std::ranges::find_if(machine_only, [&](const char* name) { return asked.given(name); });
  const std::string given = first == machine_only.end() ? "" : asked.called(*first);
  if (!given.empty() && !made.is_machine() && !names_machine_file(job.outputs)) {
    refuse(Message("for_machines_only", {{"option", given}}));
  }
  if (made.simulates && (!given.empty() || asked.given("thickness"))) {
    refuse(Message("simulator_cuts_nothing",
                   {{"option", asked.given("thickness") ? asked.called("thickness") : given}}));
  }
}

void set_colours(const job::AskedOptions& asked, export_::Preset& made) {
  const std::vector<std::string> words = operation_words();
  for (const std::string& text : asked.texts("colour")) {
    const std::size_t equals = text.find('=');
    const std::string operation = text.substr(0, equals);
    const auto found = std::ranges::find(words, operation);
    if (equals == std::string::npos || found == words.end()) {
      refuse(Message("option_colour",
                     {{"option", asked.called("colour")}, {"words", plain_items(words)}, {"text", text}}));
    }
    made.colors[static_cast<std::size_t>(found - words.begin())] =
        colour_or_refuse("--colour " + operation, text.substr(equals + 1));
  }
}

void set_spots(const job::AskedOptions& asked, MakeJob& job) {
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
      refuse(Message("option_spot", {{"option", asked.called("spot")}, {"text", text}}));
    }
    *found->second = name;
  }
}

void set_board(const job::AskedOptions& asked, MakeJob& job, export_::Preset& made) {
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

void set_print_and_cut(const job::AskedOptions& asked, MakeJob& job, export_::Preset& made) {
  job.print_and_cut = asked.flag("print-and-cut");
  if (!job.print_and_cut) {
    return;
  }
  if (!made.is_machine() || made.simulates) {
    refuse(Message("print_and_cut_needs_machine",
                   {{"option", asked.called("print-and-cut")}, option_value("try", "preset", "silhouette")}));
  }
  if (made.own_marks) {
    refuse(Message("own_marks",
                   {{"option", asked.called("print-and-cut")}, {"preset", std::string(made.name)}}));
  }
  // Numbers are printed.
  made.paths.engraves = made.paths.engraves && asked.given("engrave");
}

/// Numbers on the back need files that have one.
void check_back(const MakeJob& job) {
  if (job.options.style.numbers != export_::Numbers::back || job.print_and_cut) {
    return;
  }
  if (job.preset.is_machine()) {
    refuse(Message("back_of_machine_file", {option_value("option", "numbers", "back"),
                                            option_value("preset", "preset", job.preset.name)}));
  }
  if (names_machine_file(job.outputs)) {
    refuse(Message("back_of_dxf", {option_value("option", "numbers", "back")}));
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

/// Sets the preset, with what options change of it, and how board folds. Throws Error(usage).
void set_machine(const job::AskedOptions& asked, MakeJob& job) {
  static_cast<void>(asked.choice("preset"));
  export_::Preset made = preset_named(asked.text("preset"));
  check_effect(asked, job, made);
  if (asked.given("dxf")) {
    made.dxf_kind = asked.choice_as<export_::DxfKind>("dxf");
    if (!writes_dxf(job.outputs, made)) {
      refuse(Message("no_dxf_written",
                     {{"option", asked.called("dxf")}, option_value("try", "preset", "laser")}));
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

/// The sheet and margin where none were asked for by --paper and --margin: those of the machine. `paper`
/// has these already. Room for the beam, and none for furniture. Throws Error(usage).
void fit_to_machine(const job::AskedOptions& asked, const MakeJob& job, export_::Paper& paper) {
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

// ridgecraft MODEL: the main job.

ManualSection verbs_section() {
  return {"Verbs for single steps",
          {{"info MODEL", "What a file holds, and what had to be repaired."},
           {"segment MODEL", "Cut a model into nearly convex parts; coloured mesh and labels."},
           {"unfold MODEL", "Nets without pages, as a FOLD file."},
           {"verify FILE.fold", "Check a file of nets: lengths, overlaps, pages, joins, refolding."},
           {"hulls MODEL", "Convex hulls for physics engines, in their formats."},
           {"cage MODEL", "A coarse closed mesh around a model."},
           {"shell MODEL", "A watertight mesh around a broken model."},
           {"deform MODEL", "Move a model as the cage around it is moved."},
           {"batch VERB LIST", "One verb for many models, each in a process of its own, and a report."},
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
           {"9", "With --strict: it can't be built by hand at this size."},
           {"130", "Interrupted."}}};
}

void set_paper(const job::AskedOptions& asked, MakeJob& job) {
  export_::Paper& sheet = *job.options.paper;
  const Vec2 named = sheet.size;
  fit_to_machine(asked, job, sheet);
  job.paper_name =
      sheet.size == named ? asked.text("paper") : fmt::format("{:g}x{:g}mm", sheet.size.x, sheet.size.y);
  const Vec2 area = export_::piece_area(sheet);
  if (!(area.x >= 20.0 && area.y >= 20.0)) {
    refuse(Message("paper_full", {{"width", fmt::format("{:g}", sheet.size.x)},
                                  {"height", fmt::format("{:g}", sheet.size.y)},
                                  {"margin", fmt::format("{:g}", sheet.margin)}}));
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
      refuse(Message("option_calibrate", {{"option", "--calibrate"}, {"text", text}}));
    }
    return *mm;
  };
  const double across = measured(text.substr(0, at));
  return Vec2{across, measured(text.substr(at + 1))};
}

void set_ink(const job::AskedOptions& asked, MakeJob& job) {
  // What a machine cuts out bears no colours, unless the user says that it is printed before.
  if (!asked.given("details") && job.preset.is_machine() && !job.print_and_cut) {
    job.options.style.details = export_::Details::none;
  }
  if (!asked.given("ink") && job.preset.is_machine() && !job.print_and_cut) {
    job.options.style.ink = export_::Ink::lines;
    if (asked.given("dpi")) {
      refuse(Message("preset_has_no_pictures", {{"option", asked.called("dpi")}}));
    }
  }
}

/// A name without its folder.
std::string bare_name(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

std::vector<std::string> words_of(const job::AskedOptions& asked) {
  std::vector<std::string> words;
  for (const Option& row : option_table()) {
    if (!asked.given(row.name) || session::is_of_run(row.name)) {
      continue;
    }
    const std::string word = "--" + std::string(row.name);
    if (row.kind == OptionKind::flag) {
      words.push_back(word);
    } else if (row.kind == OptionKind::list) {
      std::ranges::transform(asked.texts(row.name), std::back_inserter(words),
                             [&](const std::string& text) { return word + "=" + text; });
    } else {
      const std::string text = asked.text(row.name);
      words.push_back(word + "=" + (row.kind == OptionKind::file ? bare_name(text) : text));
    }
  }
  return words;
}

MakeJob job_of(const job::AskedOptions& asked, std::string model) {
  require(model, "name the model to turn into paper", "ridgecraft");
  MakeJob job;
  job.model = std::move(model);
  job.common = common_of(asked);
  job.outputs = asked.texts("output");
  job.overwrite = asked.flag("overwrite");
  job.page = !asked.flag("no-page");
  job.tab_file = asked.text("tab-file");
  job.words = words_of(asked);
  job.options.guide = !asked.flag("no-guide");
  job.options.size.adapts = true;
  job.options = job::options_of(asked, std::move(job.options));
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

Job build_make(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft",
            "turns 3D models into paper: parts, nets without overlap, pages to print, cut, fold and glue");
  verb.usage("ridgecraft MODEL [options]").usage("ridgecraft VERB ... (ridgecraft VERB --help says more)");
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
