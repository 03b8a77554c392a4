// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft segment
#include "cli/arguments/part_options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {

Job build_segment(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft segment", "cuts a model, as it is, into nearly convex parts (CoRiSe)");
  verb.usage("ridgecraft segment MODEL [-o PARTS.ply] [--labels PARTS.seg] [options]");
  verb.example("ridgecraft segment dinosaur.obj -o dinosaur-parts.ply",
               "The model with every part in a colour of its own.");
  verb.example("ridgecraft segment dinosaur.obj --labels dinosaur.seg --json",
               "One part number per polygon of the input.");
  SegmentJob job;
  job::AskedOptions asked;
  PartTexts parts;
  add_model(verb, job.model);
  verb.list("Output", "-o,--output", job.outputs, "FILE",
            "Coloured mesh, .ply or .off. May be given several times.");
  verb.option(
      "Output", "--labels", job.labels, "FILE.seg",
      "One line per polygon of the input, in its order: the part's number, from 0; -1 for a polygon that "
      "repair dropped.");
  verb.option("Output", "--hierarchy", job.hierarchy, "FILE.json",
              "The parts for all tolerances at once: the finest ones, one number per polygon, and which of "
              "them join at which concavity.");
  verb.list(
      "Output", "--compare", job.compare, "FILE.seg",
      "Another segmentation of the same polygons: how far ours disagrees with it (1 - Rand index, Hamming "
      "distance, consistency errors, cut discrepancy), and the volume of our parts' hulls. May be given "
      "several times.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace existing files.");
  parts.add_to(verb);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to segment", "ridgecraft segment");
    job.common = common_of(asked);
    job.parts = parts.checked();
    return job;
  });
}

}  // namespace ridgecraft::cli
