// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that includes CLI11, which is slow to compile.
#include "cli/options.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/units.hpp"
#include "cli/version.hpp"
#include "mesh/error.hpp"
#include "mesh/nearest_word.hpp"

namespace ridgecraft::cli {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorKind::usage, sentence);
}

double length_or_refuse(const std::string& option, const std::string& text, bool zero_allowed = false) {
  if (const auto mm = parse_length_mm(text, zero_allowed)) {
    return *mm;
  }
  refuse(option + " takes a length such as 150mm, 15cm or 6in, not '" + text + "'");
}

double number_in_range(const std::string& option, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    refuse(fmt::format("{} takes a number from {} to {}, not {}", option, low, high, value));
  }
  return value;
}

std::uint64_t whole_number(const std::string& option, const std::string& text, std::uint64_t least) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least) {
    refuse(fmt::format("{} takes a whole number from {} on, not '{}'", option, least, text));
  }
  return value;
}

/// One verb: its CLI11 parser, the texts around it, and what turns parsed values into a job.
class Verb {
 public:
  Verb(std::string name, std::string purpose) {
    manual_.name = std::move(name);
    manual_.purpose = std::move(purpose);
    app_.set_help_flag();
  }

  Verb& usage(std::string line) {
    manual_.usage.push_back(std::move(line));
    return *this;
  }
  Verb& example(std::string command, std::string what) {
    manual_.examples.push_back({std::move(command), std::move(what)});
    return *this;
  }
  Verb& section(ManualSection section) {
    extra_sections_.push_back(std::move(section));
    return *this;
  }
  [[nodiscard]] CLI::App& app() { return app_; }

  template <class T>
  CLI::Option* option(const std::string& group, const std::string& names, T& value, const std::string& type,
                      const std::string& text) {
    CLI::Option* added = app_.add_option(names, value, text)->group(group)->type_name(type);
    // Given twice, the last one counts, so that a script can append what it wants differently.
    added->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    return added;
  }
  CLI::Option* flag(const std::string& group, const std::string& names, bool& value,
                    const std::string& text) {
    return app_.add_flag(names, value, text)->group(group);
  }

  /// Parses; true when --help was asked for.
  bool parse(std::vector<std::string> arguments) {
    bool help = false;
    flag("Common", "-h,--help", help, "Print this text.");
    std::reverse(arguments.begin(), arguments.end());
    try {
      app_.parse(arguments);
    } catch (const CLI::ExtrasError&) {
      refuse(unexpected(app_.remaining()));
    } catch (const CLI::ConversionError&) {
      refuse("a number is expected where none stands; see " + manual_.name + " --help");
    } catch (const CLI::ParseError& error) {
      if (!help) {
        refuse(std::string(error.what()));
      }
    }
    return help;
  }

  /// The manual, options included.
  [[nodiscard]] Manual manual() {
    Manual whole = manual_;
    for (const std::string& group : app_.get_groups()) {
      if (group.empty()) {
        continue;  // hidden options
      }
      ManualSection section{group, {}};
      for (const CLI::Option* o :
           app_.get_options([&](const CLI::Option* x) { return x->get_group() == group; })) {
        std::string term = o->get_positional() ? o->get_single_name() : o->get_name(false, true);
        for (std::size_t at = term.find(','); at != std::string::npos; at = term.find(',', at + 2)) {
          term.replace(at, 1, ", ");
        }
        if (!o->get_positional() && !o->get_type_name().empty() && o->get_expected_max() > 0) {
          term += " " + o->get_type_name();
        }
        section.entries.push_back({term, o->get_description()});
      }
      if (!section.entries.empty()) {
        whole.sections.push_back(std::move(section));
      }
    }
    whole.sections.insert(whole.sections.end(), extra_sections_.begin(), extra_sections_.end());
    return whole;
  }

 private:
  [[nodiscard]] std::string unexpected(const std::vector<std::string>& remaining) const {
    const std::string word = remaining.empty() ? "" : remaining.front();
    std::string sentence = word.starts_with("-") ? "there is no option '" + word + "'"
                                                 : "'" + word + "' is one argument too many";
    std::vector<std::string> known;
    for (const CLI::Option* o : app_.get_options()) {
      for (const std::string& name : o->get_lnames()) {
        known.push_back("--" + name);
      }
    }
    const std::string nearest =
        word.starts_with("--") ? nearest_word(word.substr(0, word.find('=')), known) : "";
    return sentence +
           (nearest.empty() ? "; see " + manual_.name + " --help" : ", did you mean '" + nearest + "'?");
  }

  Manual manual_;
  std::vector<ManualSection> extra_sections_;
  CLI::App app_;
};

/// Values as typed, before they are checked.
struct CommonTexts {
  CommonOptions values;
  double time_limit = 0.0;
  std::string seed;
  std::string threads;

  void add_to(Verb& verb) {
    verb.flag("Common", "--json", values.json,
              "Print one JSON object on standard output and nothing else there.");
    verb.flag("Common", "-q,--quiet", values.quiet, "Print no summary, notes or progress; errors only.");
    verb.option("Common", "--seed", seed, "N",
                "Seed of everything random; the same seed gives the same bytes (1).");
    verb.option("Common", "--threads", threads, "N",
                "Threads to use; the result doesn't depend on it (one per core).");
    verb.option("Common", "--time-limit", time_limit, "SECONDS",
                "After this time the search for nets ends with the best it has (no limit).");
  }
  [[nodiscard]] CommonOptions checked() const {
    CommonOptions out = values;
    out.seed = seed.empty() ? 1 : whole_number("--seed", seed, 0);
    out.threads =
        threads.empty()
            ? std::max(1U, std::thread::hardware_concurrency())
            : static_cast<unsigned>(std::min<std::uint64_t>(whole_number("--threads", threads, 1), 256));
    if (time_limit != 0.0) {
      out.time_limit_s = number_in_range("--time-limit", time_limit, 0.001, 1e6);
    }
    return out;
  }
};

struct SizeTexts {
  std::string size, scale, unit, faces;

  void add_to(Verb& verb, const std::string& default_faces) {
    faces = default_faces;
    verb.option("Size", "--size", size, "LENGTH",
                "Largest extent of the finished model: 150mm, 20cm, 8in (150mm).");
    verb.option("Size", "--scale", scale, "FACTOR",
                "Instead of --size: 1:50, 0.5 or 30% of the size that the file's numbers give in --unit.");
    verb.option("Size", "--unit", unit, "UNIT",
                "Unit of the file's numbers: mm, cm, m, in, ft (mm); used with --scale.");
    verb.option(
        "Size", "--faces", faces, "N|auto|keep",
        default_faces == "auto"
            ? "How many faces to keep: auto simplifies a model whose edges would be too short to fold, keep "
              "never does, a number simplifies to that many (auto)."
            : "How many faces to keep: auto, keep or a number (keep).");
  }
  [[nodiscard]] SizeArguments checked() const {
    SizeArguments out;
    if (!size.empty() && !scale.empty()) {
      refuse("--size and --scale exclude each other");
    }
    if (!unit.empty() && scale.empty()) {
      refuse("--unit tells what the file's numbers mean for --scale; with --size it has no effect");
    }
    if (!scale.empty()) {
      const auto factor = parse_scale(scale);
      if (!factor) {
        refuse("--scale takes a factor such as 1:50, 0.5 or 30%, not '" + scale + "'");
      }
      const auto mm = unit_mm(unit.empty() ? "mm" : unit);
      if (!mm) {
        refuse("--unit takes mm, cm, m, in or ft, not '" + unit + "'");
      }
      out.size.mm_per_unit = *factor * *mm;
      out.asked = "--scale " + scale + (unit.empty() ? "" : " --unit " + unit);
    } else {
      out.size.largest_extent_mm = size.empty() ? 150.0 : length_or_refuse("--size", size);
      if (out.size.largest_extent_mm < 1.0 || out.size.largest_extent_mm > 100000.0) {
        refuse("--size takes 1mm to 100m, not '" + size + "'");
      }
      out.asked = "--size " + (size.empty() ? std::string("150mm") : size);
    }
    if (faces == "auto") {
      out.simplify.mode = mesh::Simplification::automatic;
    } else if (faces == "keep") {
      out.simplify.mode = mesh::Simplification::keep;
    } else {
      out.simplify.mode = mesh::Simplification::count;
      out.simplify.faces = whole_number("--faces", faces, 4);
    }
    return out;
  }
};

double checked_concavity(double value) {
  return number_in_range("--concavity", value, 0.001, 2.0);
}

void require(const std::string& value, const std::string& what, const std::string& name) {
  if (value.empty()) {
    refuse(what + "; see " + name + " --help");
  }
}

using Arguments = std::vector<std::string>;
/// Builds a verb and either parses (arguments given) or only fills in its manual (none).
using Builder = std::function<Job(const Arguments*, Manual*)>;

Job finish(Verb& verb, const Arguments* arguments, Manual* manual, const std::function<Job()>& checked) {
  if (arguments == nullptr) {
    *manual = verb.manual();
    return PrintJob{};
  }
  if (verb.parse(*arguments)) {
    return PrintJob{help_text(verb.manual())};
  }
  return checked();
}

ManualSection verbs_section() {
  return {"Verbs for single steps",
          {{"info MODEL", "What a file holds, and what had to be repaired."},
           {"segment MODEL", "Cut a model into nearly convex parts; coloured mesh and labels."},
           {"unfold MODEL", "Nets without pages, as a FOLD file."},
           {"verify FILE.fold", "Check a file of nets: lengths, overlaps, pages, joins, refolding."},
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
           {"130", "Interrupted."}}};
}

Job build_paper(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft",
            "turns 3D models into paper: parts, nets without overlap, pages to print, cut, fold and glue");
  verb.usage("ridgecraft MODEL [options]").usage("ridgecraft VERB ... (ridgecraft VERB --help tells more)");
  verb.example("ridgecraft whale.obj",
               "Pages for a whale of 150 mm: whale.pdf, whale.svg and whale.fold in this folder.");
  verb.example("ridgecraft scan.stl --size 30cm --paper A3 -o out", "Larger, on A3, into the folder out.");
  verb.example("ridgecraft house.obj --scale 1:87 --unit m -o house.pdf",
               "A house built in metres, as model railways want it.");
  PaperJob job;
  CommonTexts common;
  SizeTexts size;
  std::string paper = "A4";
  std::string margin;
  std::string tab_height;
  double tab_angle = 45.0;
  double hide = 3.0;
  bool no_tabs = false;
  verb.option("Input", "MODEL", job.model, "MODEL",
              "OBJ, STL, PLY or OFF; the content decides, not the suffix.");
  verb.option(
          "Output", "-o,--output", job.outputs, "WHERE",
          "A folder gets all default formats (PDF, SVG, FOLD); a file's suffix names its format (.pdf, .svg, "
          ".fold, .png). May be given several times (the current folder).")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.flag("Output", "--overwrite", job.overwrite,
            "Replace existing files, also those that weren't made from this model.");
  size.add_to(verb, "auto");
  verb.option("Paper", "--paper", paper, "NAME|WxH",
              "A0 to A6, letter, legal, tabloid and others, -landscape added to turn it, or a size such as "
              "300x200mm (A4).");
  verb.option("Paper", "--margin", margin, "LENGTH",
              "What the printer can't reach, on all four sides (10mm).");
  verb.option("Tabs and lines", "--tab-height", tab_height, "LENGTH", "Height of the glue tabs (5mm).");
  verb.option("Tabs and lines", "--tab-angle", tab_angle, "DEGREES",
              "Side angle of the glue tabs; steeper where an edge is short (45).");
  verb.flag("Tabs and lines", "--no-tabs", no_tabs, "Draw no glue tabs.");
  verb.option("Tabs and lines", "--hide-folds", hide, "DEGREES",
              "Draw no line where the surface is folded by less than this (3).");
  verb.option(
      "Parts", "--concavity", job.concavity, "TOLERANCE",
      "How far a part may be from convex, as a share of the radius of the model's bounding sphere (0.1).");
  common.add_to(verb);
  bool version = false;
  verb.flag("Common", "--version", version, "Print the program's version.");
  bool man = false;
  verb.flag("", "--man-page", man, "Print the manual page.");
  verb.section(verbs_section()).section(exit_section());
  return finish(verb, arguments, manual, [&]() -> Job {
    if (version) {
      return PrintJob{program_and_version() + "\n"};
    }
    if (man) {
      return PrintJob{"man"};
    }
    require(job.model, "name the model to turn into paper", "ridgecraft");
    job.common = common.checked();
    job.size = size.checked();
    job.paper = paper::parse_paper(paper);
    job.paper_name = paper;
    if (!margin.empty()) {
      job.paper.margin = length_or_refuse("--margin", margin, true);
    }
    const Vec2 area = paper::piece_area(job.paper);
    if (!(area.x >= 20.0 && area.y >= 20.0)) {
      refuse("paper " + paper + " with a margin of " + fmt::format("{:g}", job.paper.margin) +
             " mm leaves no room for pieces");
    }
    job.concavity = checked_concavity(job.concavity);
    job.tabs.wanted = !no_tabs;
    if (!tab_height.empty()) {
      job.tabs.height_mm =
          number_in_range("--tab-height", length_or_refuse("--tab-height", tab_height), 1.5, 50.0);
    }
    job.tabs.angle = number_in_range("--tab-angle", tab_angle, 15.0, 85.0) * degree;
    job.tabs.steepest_angle = std::max(job.tabs.steepest_angle, job.tabs.angle);
    job.style.hidden_fold_angle = number_in_range("--hide-folds", hide, 0.0, 180.0) * degree;
    return job;
  });
}

Job build_info(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft info", "tells what a model file holds, and what had to be repaired");
  verb.usage("ridgecraft info MODEL [--json]");
  verb.example("ridgecraft info scan.stl", "Faces, components, borders, size, repairs.");
  InfoJob job;
  CommonTexts common;
  verb.option("Input", "MODEL", job.model, "MODEL", "OBJ, STL, PLY or OFF.");
  common.add_to(verb);
  return finish(verb, arguments, manual, [&]() -> Job {
    require(job.model, "name the model to look at", "ridgecraft info");
    job.common = common.checked();
    return job;
  });
}

Job build_segment(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft segment", "cuts a model, as it is, into nearly convex parts (CoRiSe)");
  verb.usage("ridgecraft segment MODEL [-o PARTS.ply] [--labels PARTS.seg] [options]");
  verb.example("ridgecraft segment ant.off -o ant-parts.ply",
               "The model with every part in a colour of its own.");
  verb.example("ridgecraft segment ant.off --labels ant.seg --json",
               "One part number per polygon of the input.");
  SegmentJob job;
  CommonTexts common;
  verb.option("Input", "MODEL", job.model, "MODEL", "OBJ, STL, PLY or OFF.");
  verb.option("Output", "-o,--output", job.outputs, "FILE",
              "Coloured mesh, .ply or .off. May be given several times.")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.option(
      "Output", "--labels", job.labels, "FILE.seg",
      "One line per polygon of the input, in its order: the part's number, from 0; -1 for a polygon that "
      "repair dropped.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace existing files.");
  verb.option(
      "Parts", "--concavity", job.concavity, "TOLERANCE",
      "Largest concavity of a part, in the scale where the smallest enclosing ball has radius 1 (0.1).");
  common.add_to(verb);
  return finish(verb, arguments, manual, [&]() -> Job {
    require(job.model, "name the model to segment", "ridgecraft segment");
    job.common = common.checked();
    job.concavity = checked_concavity(job.concavity);
    return job;
  });
}

Job build_unfold(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft unfold", "unfolds a model into nets without overlap, without pages and tabs");
  verb.usage("ridgecraft unfold MODEL [--whole] -o NETS.fold [options]");
  verb.example("ridgecraft unfold gem.off --whole -o gem.fold",
               "The whole model as one net, if there is one.");
  UnfoldJob job;
  CommonTexts common;
  SizeTexts size;
  verb.option("Input", "MODEL", job.model, "MODEL", "OBJ, STL, PLY or OFF.");
  verb.option("Output", "-o,--output", job.output, "FILE.fold", "Where the nets go.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace an existing file.");
  verb.flag("Parts", "--whole", job.whole, "Don't cut the model into parts first.");
  verb.option("Parts", "--concavity", job.concavity, "TOLERANCE", "How far a part may be from convex (0.1).");
  size.add_to(verb, "keep");
  common.add_to(verb);
  return finish(verb, arguments, manual, [&]() -> Job {
    require(job.model, "name the model to unfold", "ridgecraft unfold");
    job.common = common.checked();
    job.size = size.checked();
    job.concavity = checked_concavity(job.concavity);
    return job;
  });
}

Job build_verify(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft verify",
            "checks a file of nets: lengths, overlaps, coverage, pages, joins, refolding");
  verb.usage("ridgecraft verify FILE.fold [--json]");
  verb.example("ridgecraft verify whale.fold",
               "The figures, and every fault; exit code 6 when there is one.");
  VerifyJob job;
  CommonTexts common;
  verb.option("Input", "FILE", job.file, "FILE",
              "A .fold file of ours or of another program in the same form.");
  common.add_to(verb);
  return finish(verb, arguments, manual, [&]() -> Job {
    require(job.file, "name the .fold file to check", "ridgecraft verify");
    job.common = common.checked();
    return job;
  });
}

Job build_formats(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft formats", "lists the formats that are read and written");
  verb.usage("ridgecraft formats [--json]");
  verb.example("ridgecraft formats", "The list.");
  FormatsJob job;
  CommonTexts common;
  common.add_to(verb);
  return finish(verb, arguments, manual, [&]() -> Job {
    job.common = common.checked();
    return job;
  });
}

std::string whole_man_page() {
  Manual program;
  build_paper(nullptr, &program);
  std::vector<Manual> verbs(5);
  const Builder builders[] = {build_info, build_segment, build_unfold, build_verify, build_formats};
  for (std::size_t i = 0; i < 5; ++i) {
    builders[i](nullptr, &verbs[i]);
  }
  return man_page(program, verbs, program_and_version());
}

}  // namespace

std::string program_and_version() {
  return std::string("ridgecraft ") + RIDGECRAFT_VERSION;
}

Job parse_arguments(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    refuse(
        "name the model to turn into paper, as in: ridgecraft whale.obj; ridgecraft --help tells the rest");
  }
  const std::pair<std::string_view, Builder> verbs[] = {{"info", build_info},
                                                        {"segment", build_segment},
                                                        {"unfold", build_unfold},
                                                        {"verify", build_verify},
                                                        {"formats", build_formats}};
  std::vector<std::string> known;
  for (const auto& [name, build] : verbs) {
    known.emplace_back(name);
    if (arguments.front() == name) {
      const Arguments rest(arguments.begin() + 1, arguments.end());
      return build(&rest, nullptr);
    }
  }
  const std::string& first = arguments.front();
  if (first.find_first_of("./-") == std::string::npos && !std::filesystem::exists(first)) {
    if (const std::string verb = nearest_word(first, known); !verb.empty()) {
      refuse("there is no verb '" + first + "', did you mean '" + verb + "'?");
    }
  }
  if (arguments.front() == "help") {
    const Arguments help{"--help"};
    return build_paper(&help, nullptr);
  }
  Job job = build_paper(&arguments, nullptr);
  if (const auto* print = std::get_if<PrintJob>(&job); print != nullptr && print->text == "man") {
    return PrintJob{whole_man_page()};
  }
  return job;
}

}  // namespace ridgecraft::cli
