// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft unfold
#include "cli/arguments/verbs.hpp"

#include <algorithm>
#include <utility>

#include "base/option_values.hpp"
#include "cli/arguments/shared_options.hpp"
#include "job/asked_options.hpp"

namespace ridgecraft::cli {
namespace {

/// Trials for tabs where they are what was asked for: 1 to 2 s for 500 faces.
constexpr double patient_trials_per_face = 10'000.0;

job::Options usual_options() {
  job::Options usual;
  usual.paper = std::nullopt;
  usual.bodies = prepare::Bodies::keep;
  usual.simplify.mode = prepare::Simplification::keep;
  usual.simplify.rolls.which = prepare::Rolled::never;  // no page says round what
  usual.tabs.wanted = false;
  usual.pieces.trials_per_face = patient_trials_per_face;
  return usual;
}

}  // namespace

Job build_unfold(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft unfold", "unfolds a model into nets without overlap, without pages");
  verb.usage("ridgecraft unfold MODEL [--whole] [-o NETS.fold] [options]");
  verb.example("ridgecraft unfold gem.stl --whole -o gem.fold",
               "The whole model as one net, if there is one.");
  UnfoldJob job;
  job::AskedOptions asked;
  bool whole = false;
  bool tabs = false;
  add_model(verb, job.model);
  add_options(verb, asked, {"only", "without"});
  verb.option("Output", "-o,--output", job.output, "FILE.fold",
              "Where the nets go; without it, only their figures are printed.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace an existing file.");
  verb.flag("Parts", "--whole", whole, "Don't cut the model into parts first.");
  verb.add(option_row("concavity"), asked, "Parts", "How far a part may be from convex (0.1).");
  verb.add(option_row("fold-linear"), asked, "Parts");
  add_options(verb, asked, {"cuts", "keep", "from"});
  verb.add(option_row("size"), asked, "",
           "Largest extent of the finished model: 150mm, 20cm, 8in; a number alone means mm (150mm).");
  add_options(verb, asked, {"height", "width", "depth", "up", "scale", "unit"});
  verb.add(option_row("faces"), asked, "", "How many faces to keep: auto, keep or a number (keep).");
  verb.flag("Tabs", "--tabs", tabs,
            "Search nets whose cut edges have room for 5 mm glue tabs, and draw these.");
  verb.add(option_row("all-tabs"), asked, "Tabs",
           "The same, and split pieces until every edge with a face wide enough behind it has a tab.");
  add_common(verb, asked, TimeUp::ends_searches);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to unfold", "ridgecraft unfold");
    job.common = common_of(asked);
    job.options = job::options_of(asked, usual_options());
    job.options.tabs.wanted = tabs || job.options.tabs.split_pieces;
    job.size_asked = size_of(asked);
    job.edges = edges_of(asked, job.options.simplify);
    if (whole && asked.given("concavity")) {
      refuse("--concavity says how to cut the model into parts; with --whole it has no effect");
    }
    if (whole) {
      job.options.parts = job::PartsFrom::components;
      job.options.panel_cuts = unfold::PanelCuts::before_pieces;
    }
    return job;
  });
}

// ridgecraft verify

Job build_verify(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft verify",
            "checks a file of nets: lengths, overlaps, coverage, pages, joins, refolding");
  verb.usage("ridgecraft verify FILE.fold [--model MODEL] [--pages FILE...] [--json]");
  verb.example("ridgecraft verify whale.fold",
               "The figures, and every fault; exit code 6 when there is one.");
  verb.example("ridgecraft verify whale.fold --model whale.obj --pages whale.pdf",
               "Also whether the nets are the model's, and what is printed the nets.");
  VerifyJob job;
  job::AskedOptions asked;
  verb.option(
      "Input", "FILE", job.file, "FILE",
      "A .fold file of ours or of another program in the same form. What isn't JSON can't be checked: exit "
      "code 3.");
  verb.option(
      "Input", "--model", job.model, "MODEL",
      "The model that the nets were made from: do they have its surface, at their scale, as near as the "
      "file's settings promise?");
  verb.list(
      "Input", "--pages", job.pages, "FILE",
      "What is printed, as PDF or SVG, one file or several: does it show the outlines, folds and bases of "
      "tabs of the nets, and no other, in true size?");
  verb.takes_several("--pages");
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    // Behind --pages the nets are told from pages by their suffix.
    const auto nets =
        std::ranges::find_if(job.pages, [](const std::string& page) { return page.ends_with(".fold"); });
    if (job.file.empty() && nets != job.pages.end()) {
      job.file = *nets;
      job.pages.erase(nets);
    }
    require(job.file, "name the .fold file to check", "ridgecraft verify");
    job.common = common_of(asked);
    return job;
  });
}

// ridgecraft info

Job build_info(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft info", "shows what a model file holds, and what had to be repaired");
  verb.usage("ridgecraft info MODEL [--json]");
  verb.example("ridgecraft info gem.stl", "Faces, components, borders, size, repairs.");
  InfoJob job;
  job::AskedOptions asked;
  add_model(verb, job.model);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to look at", "ridgecraft info");
    job.common = common_of(asked);
    return job;
  });
}

// ridgecraft formats

Job build_formats(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft formats",
            "lists the formats that are read and written, and the presets for machines");
  verb.usage("ridgecraft formats [--presets] [--json]");
  verb.example("ridgecraft formats", "The list.");
  verb.example("ridgecraft formats --presets", "What each machine's files are like.");
  FormatsJob job;
  verb.flag("Output", "--presets", job.presets,
            "The table of presets alone: what each machine's files are like.");
  job::AskedOptions asked;
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    job.common = common_of(asked);
    return job;
  });
}

namespace {

// ridgecraft studio

constexpr const char* no_browser_word = "--no-browser";

/// The words without the model's, which stands among them.
Arguments without_model(Arguments words, const std::string& model) {
  words.erase(std::find(words.begin(), words.end(), model));
  std::erase(words, "--");
  return words;
}

/// What the main job makes of the words tells whether they are right.
StudioJob checked(const Arguments& words) {
  StudioJob studio;
  if (words.empty()) {
    return studio;
  }
  const Job parsed = build_make(&words, nullptr);
  const auto* const job = std::get_if<MakeJob>(&parsed);
  if (job == nullptr) {
    refuse("ridgecraft studio takes a model and options about its paper: ridgecraft studio --help");
  }
  if (!job->outputs.empty() || job->edges.any() || !job->tab_file.empty()) {
    refuse("the studio saves and reads files itself: leave out -o, --cuts, --keep, --from and --tab-file");
  }
  if (job->model == "-") {
    refuse("the studio takes a model's file, not standard input");
  }
  studio.model = job->model;
  studio.words = without_model(words, job->model);
  return studio;
}

}  // namespace

Job build_studio(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft studio",
            "opens a page in the browser that makes paper of a model, with controls for all wishes");
  verb.usage("ridgecraft studio [MODEL] [options of the main job]");
  verb.example("ridgecraft studio", "An empty page: drop a model on it.");
  verb.example("ridgecraft studio whale.obj --size 20cm", "With this model, 20 cm long to begin with.");
  std::string model;
  bool no_browser = false;
  verb.option(
      "Input", "MODEL", model, "MODEL",
      "What the page begins with; the options of ridgecraft MODEL may follow. All work is done in the "
      "browser, which sends nothing anywhere.");
  verb.flag("Common", no_browser_word, no_browser, "Only write the page, and print where it lies.");
  const auto asks_for_help = [](const Arguments& words) {
    return std::find(words.begin(), words.end(), "--help") != words.end() ||
           std::find(words.begin(), words.end(), "-h") != words.end();
  };
  if (arguments == nullptr || asks_for_help(*arguments)) {
    return verb.finish(arguments, manual, [] { return StudioJob{}; });
  }
  Arguments words = *arguments;
  no_browser = std::erase(words, no_browser_word) > 0;
  StudioJob job = checked(words);
  job.no_browser = no_browser;
  return job;
}

}  // namespace ridgecraft::cli
