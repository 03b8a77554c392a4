// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/shared_options.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <thread>

#include "base/length_text.hpp"
#include "base/sentence.hpp"
#include "cli/arguments/option_values.hpp"
#include "cli/arguments/units.hpp"
#include "mesh/model/file_format.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::cli {

std::string model_formats() {
  return listed(mesh::format_names(), "or");
}

void add_model(Verb& verb, std::string& model) {
  verb.option("Input", "MODEL", model, "MODEL", model_formats() + "; - reads standard input.");
}

void add_selection(Verb& verb, prepare::Selection& selection) {
  verb.list("Input", "--only", selection.only, "NAME",
            "Take nothing but objects and materials of this name; 'wheel*' takes all whose names begin so. "
            "May be given several times; info lists the names.");
  verb.list("Input", "--without", selection.without, "NAME", "Leave them out, in the same way.");
}

namespace {

double size_or_refuse(const std::string& option, const std::string& text) {
  std::string_view rest = text;
  if (const auto length = take_length(rest); length && rest.empty() && !(length->number > 0.0)) {
    refuse(option + " " + text + " is too small: it takes 1mm and more");
  }
  const double mm = length_or_refuse(option, text);
  require_range(option, text, mm, 1.0, 100000.0, "1mm to 100m");
  return mm;
}

}  // namespace

void CommonTexts::add_to(Verb& verb, TimeUp time_up) {
  verb.flag("Common", "--json", values.json,
            "Print one JSON object on standard output and nothing else there.")
      .flag("Common", "-q,--quiet", values.quiet,
            "Print no summary, notes or progress; errors only, and a result that goes into no file (info, "
            "formats).")
      .flag("Common", "-v,--verbose", values.verbose,
            "Print all figures, where a summary of five lines stands otherwise.")
      .option("Common", "--seed", seed, "N",
              "Seed of the random searches; the same seed gives the same bytes (1).")
      .option("Common", "--threads", threads, "N",
              "Threads to use; the result doesn't depend on it (one per core).")
      .option(
          "Common", "--time-limit", time_limit, "SECONDS",
          time_up == TimeUp::ends_searches
              ? "End after about this time: searches stop with the best they have, a stage that has nothing "
                "yet stops the program (no limit)."
              : "Stop after this time, with exit code 130 and nothing written, unless all is done by then "
                "(no limit).");
}

CommonOptions CommonTexts::checked() const {
  constexpr std::uint64_t most_threads = 256;
  CommonOptions out = values;
  out.seed = seed.empty() ? 1 : whole_number_or_refuse("--seed", seed, 0);
  out.threads =
      threads.empty()
          ? std::max(1U, std::thread::hardware_concurrency())
          : static_cast<unsigned>(std::min(whole_number_or_refuse("--threads", threads, 1), most_threads));
  if (!time_limit.empty()) {
    out.time_limit_s = number_or_refuse("--time-limit", time_limit, 0.001, 1e6);
  }
  return out;
}

void SizeTexts::add_to(Verb& verb, const std::string& default_faces) {
  faces = default_faces;
  adapts = default_faces == "auto";
  verb.option("Size", "--size", size, "LENGTH",
              default_faces == "auto"
                  ? "Largest extent of the finished model: 150mm, 20cm, 8in; a number alone means mm "
                    "(150mm, or what its folds and pages need between 100mm and 400mm)."
                  : "Largest extent of the finished model: 150mm, 20cm, 8in; a number "
                    "alone means mm (150mm).")
      .option("Size", "--height", height, "LENGTH",
              "Instead of --size: from the foot of the finished model to its top, as its guide shows it.")
      .option("Size", "--width", width, "LENGTH", "The same from its left to its right.")
      .option("Size", "--depth", depth, "LENGTH", "The same from its back to its front.")
      .option("Size", "--up", up, "x|y|z",
              "The axis of the file that points up, where the guide has the model lie (as the file says, or "
              "else as it stands best).")
      .option("Size", "--scale", scale, "FACTOR",
              "Instead of --size: 1:50, 0.5 or 30% of the size that the file's numbers give in --unit.")
      .option(
          "Size", "--unit", unit, "UNIT",
          "Unit of the file's numbers: mm, cm, m, in, ft (what the file says, else mm); used with --scale.")
      .option("Size", "--faces", faces, "N|auto|keep",
              default_faces == "auto"
                  ? "How many faces to keep: auto simplifies a model whose edges would be too short to fold, "
                    "keep never does, a number simplifies to that many (auto)."
                  : "How many faces to keep: auto, keep or a number (keep).");
}

void SizeTexts::check_into(job::Options& options, AskedSize& asked) const {
  struct Way {
    std::string option;
    const std::string& text;
    std::optional<job::ExtentKind> kind;
  };
  const Way ways[] = {{"--size", size, {}},
                      {"--width", width, job::ExtentKind::width},
                      {"--depth", depth, job::ExtentKind::depth},
                      {"--height", height, job::ExtentKind::height},
                      {"--scale", scale, {}}};
  const Way* chosen = nullptr;
  for (const Way& way : ways) {
    if (!way.text.empty()) {
      if (chosen != nullptr) {
        refuse(chosen->option + " and " + way.option + " exclude each other");
      }
      chosen = &way;
    }
  }
  if (!up.empty()) {
    options.up = choice_or_refuse<mesh::Axis>(
        "--up", up, {{"x", mesh::Axis::x}, {"y", mesh::Axis::y}, {"z", mesh::Axis::z}});
  }
  if (!unit.empty() && scale.empty()) {
    refuse("--unit tells what the file's numbers mean for --scale; with --size it has no effect");
  }
  if (!scale.empty()) {
    const auto factor = parse_scale(scale);
    if (!factor) {
      refuse("--scale takes a factor such as 1:50, 0.5 or 30%, not '" + scale + "'");
    }
    options.size.mm_per_unit = *factor * unit_or_refuse("--unit", unit);
    if (unit.empty()) {
      asked.scale = factor;
    }
    asked.words = "--scale " + scale + (unit.empty() ? "" : " --unit " + unit);
  } else {
    options.size.adapts = chosen == nullptr && adapts;
    const std::string option = chosen == nullptr ? "--size" : chosen->option;
    const std::string text = chosen == nullptr ? "150mm" : chosen->text;
    const double mm = size_or_refuse(option, text);
    options.size.largest_extent_mm = mm;
    if (chosen != nullptr && chosen->kind) {
      options.extent = job::Extent{*chosen->kind, mm};
    }
    std::string_view typed = text;
    const auto length = take_length(typed);
    asked.unit_assumed = length && !length->mm_per_unit;
    asked.words = option + " " + text;
  }
  if (faces == "auto") {
    options.simplify.mode = prepare::Simplification::automatic;
  } else if (faces == "keep") {
    options.simplify.mode = prepare::Simplification::keep;
  } else {
    options.simplify.mode = prepare::Simplification::count;
    options.simplify.faces = whole_number_or_refuse("--faces", faces, 4);
  }
}

}  // namespace ridgecraft::cli
