// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft segment
#include "cli/option_values.hpp"
#include "cli/shared_options.hpp"
#include "cli/verbs.hpp"

namespace ridgecraft::cli {

Job build_segment(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft segment", "cuts a model, as it is, into nearly convex parts (CoRiSe)");
  verb.usage("ridgecraft segment MODEL [-o PARTS.ply] [--labels PARTS.seg] [options]");
  verb.example("ridgecraft segment ant.off -o ant-parts.ply",
               "The model with every part in a colour of its own.");
  verb.example("ridgecraft segment ant.off --labels ant.seg --json",
               "One part number per polygon of the input.");
  SegmentJob job;
  CommonTexts common;
  std::string concavity;
  verb.option("Input", "MODEL", job.model, "MODEL", "OBJ, STL, PLY or OFF.");
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
  verb.option(
      "Parts", "--concavity", concavity, "TOLERANCE",
      "Largest concavity of a part, in the scale where the smallest enclosing ball has radius 1 (0.1).");
  std::string parts;
  verb.option(
      "Parts", "--parts", parts, "N",
      "Give N parts: the finest parts joined, the least concave unions first. In place of "
      "--concavity, --effort, --volume-weight, --planes, --pockets, --holes, --components and --reading.");
  std::string effort;
  std::string volume_weight;
  verb.option(
      "Parts", "--effort", effort, "1|2|3",
      "How much work to spend: 2 and 3 also cut finer pieces and put them together anew, and keep the best "
      "attempt, for fewer parts with smaller hulls in about 4 and 15 times the time (1).");
  verb.option("Parts", "--volume-weight", volume_weight, "WEIGHT",
              "Parts to give for a volume ratio (hulls of the parts to the model) less by 1; 0 asks for the "
              "fewest parts whatever their hulls (0, with --effort 2 and 3: 5).");
  verb.flag("Parts", "--planes", job.options.planes,
            "Cut by planes, too, where that saves more volume than its pieces are worth by --volume-weight: "
            "cups and boxes without lid become sectors. For other uses than paper.");
  verb.flag(
      "Parts", "--pockets", job.options.pockets,
      "Leave no pocket: no air deeper than the tolerance under a part's hull. Cups and boxes without lid "
      "become sectors instead of one part; takes a closed model.");
  std::string holes;
  verb.option("Parts", "--holes", holes, "auto|keep|close",
              "close: small holes of a damaged model don't divide parts, and crumbs join the part that they "
              "touch; keep: holes are borders; auto: close where the model is full of holes (auto).");
  std::string components;
  verb.option("Parts", "--components", components, "apart|tied",
              "tied: components that lie apart or run through each other are one object, and a part may hold "
              "faces of several; apart: each for itself (apart).");
  std::string reading;
  verb.option(
      "Parts", "--reading", reading, "literal|a|b",
      "For research: how the paper is read. literal: to the letter; a: valleys cross the openings that "
      "cuts leave; b: and depth is the way out of the hull, parts that can be one are joined (b).");
  common.add_to(verb);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to segment", "ridgecraft segment");
    job.common = common.checked();
    job.options.concavity = concavity_or_refuse(concavity);
    using segment::Options;
    job.options.effort = choice_or_refuse<int>("--effort", effort, {{"1", 1}, {"2", 2}, {"3", 3}});
    job.options.holes = choice_or_refuse<Options::Holes>("--holes", holes,
                                                         {{"auto", Options::Holes::automatic},
                                                          {"keep", Options::Holes::keep},
                                                          {"close", Options::Holes::close}});
    job.options.components = choice_or_refuse<Options::Components>(
        "--components", components,
        {{"apart", Options::Components::apart}, {"tied", Options::Components::tied}});
    job.options.reading = choice_or_refuse<segment::Reading>(
        "--reading", reading,
        {{"b", segment::Reading::b}, {"a", segment::Reading::a}, {"literal", segment::Reading::literal}});
    if (!volume_weight.empty()) {
      job.options.volume_weight = number_or_refuse("--volume-weight", volume_weight, 0.0, 1000.0);
    }
    if (!parts.empty()) {
      if (!concavity.empty() || !effort.empty() || !volume_weight.empty() || !holes.empty() ||
          !components.empty() || !reading.empty() || job.options.pockets || job.options.planes) {
        refuse(
            "--parts goes with none of --concavity, --effort, --volume-weight, --planes, --pockets, --holes, "
            "--components and --reading");
      }
      job.parts = whole_number_or_refuse("--parts", parts, 1);
    }
    return job;
  });
}

}  // namespace ridgecraft::cli
