// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft unfold
#include "cli/arguments/edge_options.hpp"
#include "cli/arguments/option_values.hpp"
#include "cli/arguments/piece_options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {
namespace {

/// Trials for tabs where they are what was asked for: 1 to 2 s for 500 faces.
constexpr double patient_trials_per_face = 4000.0;

}  // namespace

Job build_unfold(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft unfold", "unfolds a model into nets without overlap, without pages");
  verb.usage("ridgecraft unfold MODEL [--whole] [-o NETS.fold] [options]");
  verb.example("ridgecraft unfold gem.stl --whole -o gem.fold",
               "The whole model as one net, if there is one.");
  UnfoldJob job;
  job.options.paper = std::nullopt;
  job.options.bodies = prepare::Bodies::keep;
  bool whole = false;
  job.options.tabs.wanted = false;
  job.options.pieces.trials_per_face = patient_trials_per_face;
  CommonTexts common;
  std::string concavity;
  SizeTexts size;
  add_model(verb, job.model);
  add_selection(verb, job.options.selection);
  verb.option("Output", "-o,--output", job.output, "FILE.fold",
              "Where the nets go; without it, only what is told of them is printed.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace an existing file.");
  verb.flag("Parts", "--whole", whole, "Don't cut the model into parts first.");
  verb.option("Parts", "--concavity", concavity, "TOLERANCE", "How far a part may be from convex (0.1).");
  verb.flag("Parts", "--fold-linear", job.options.pieces.fold_linear, std::string(fold_linear_text));
  add_edge_options(verb, job.edges);
  size.add_to(verb, "keep");
  verb.flag("Tabs", "--tabs", job.options.tabs.wanted,
            "Search nets whose cut edges have room for 5 mm glue tabs, and draw these.");
  verb.flag("Tabs", "--all-tabs", job.options.tabs.split_pieces,
            "The same, and split pieces until every edge with a face wide enough behind it has a tab.");
  common.add_to(verb, TimeUp::ends_searches);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to unfold", "ridgecraft unfold");
    job.common = common.checked();
    job.options.tabs.wanted = job.options.tabs.wanted || job.options.tabs.split_pieces;
    size.check_into(job.options, job.size_asked);
    check_edge_options(job.edges, job.options.simplify);
    if (whole && !concavity.empty()) {
      refuse("--concavity tells how to cut the model into parts; with --whole it has no effect");
    }
    job.options.concavity = concavity_or_refuse(concavity);
    if (whole) {
      job.options.parts = job::PartsFrom::components;
      job.options.panel_cuts = unfold::PanelCuts::before_pieces;
    }
    return job;
  });
}

}  // namespace ridgecraft::cli
