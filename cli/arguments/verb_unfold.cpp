// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft unfold
#include "base/option_values.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"
#include "job/option_fields.hpp"

namespace ridgecraft::cli {
namespace {

/// Trials for tabs where they are what was asked for: 1 to 2 s for 500 faces.
constexpr double patient_trials_per_face = 4000.0;

job::Options usual_options() {
  job::Options usual;
  usual.paper = std::nullopt;
  usual.bodies = prepare::Bodies::keep;
  usual.simplify.mode = prepare::Simplification::keep;
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
              "Where the nets go; without it, only what is told of them is printed.");
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
      refuse("--concavity tells how to cut the model into parts; with --whole it has no effect");
    }
    if (whole) {
      job.options.parts = job::PartsFrom::components;
      job.options.panel_cuts = unfold::PanelCuts::before_pieces;
    }
    return job;
  });
}

}  // namespace ridgecraft::cli
