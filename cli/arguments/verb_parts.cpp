// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <string>

#include "base/option_values.hpp"
#include "cli/arguments/options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verb.hpp"
#include "cli/arguments/verbs.hpp"
#include "cli/files/formats.hpp"

namespace ridgecraft::cli {
namespace {

// How a model is divided into parts: the options of every verb that uses parts for something else than paper.

/// The options as typed.
struct PartTexts {
  segment::Options options;  ///< flags
  std::string concavity, count, effort, volume_weight, holes, components, reading;

  void add_to(Verb& verb);
  [[nodiscard]] PartArguments checked() const;
};

void PartTexts::add_to(Verb& verb) {
  verb.option(
      "Parts", "--concavity", concavity, "TOLERANCE",
      "Largest concavity of a part: a length such as 5mm, or a number in the scale where the smallest "
      "enclosing ball has radius 1 (0.1).");
  verb.option(
      "Parts", "--parts", count, "N",
      "Give N parts: the finest parts joined, the least concave unions first. In place of "
      "--concavity, --effort, --volume-weight, --planes, --pockets, --holes, --components and --reading.");
  verb.option(
      "Parts", "--effort", effort, "1|2|3",
      "How much work to spend: 2 and 3 also cut finer pieces and put them together again, and keep the best "
      "attempt, for fewer parts with smaller hulls in about 4 and 25 times the time (1).");
  verb.option("Parts", "--volume-weight", volume_weight, "WEIGHT",
              "Parts to give for a volume ratio (hulls of the parts to the model) less by 1; 0 asks for the "
              "fewest parts whatever their hulls (0; 5 with --effort 2 and 3 and with --planes).");
  verb.flag("Parts", "--planes", options.planes,
            "Cut by planes, too, where that saves more volume than its pieces are worth by --volume-weight; "
            "for openings see --pockets. For other uses than paper.");
  verb.flag(
      "Parts", "--pockets", options.pockets,
      "Leave no pocket: no air deeper than the tolerance under a part's hull. Cups and boxes without lid "
      "become sectors instead of one part; takes a closed model.");
  verb.option("Parts", "--holes", holes, "auto|keep|close",
              "close: small holes of a damaged model don't divide parts, and crumbs join the part that they "
              "touch; keep: holes are borders; auto: close where the model is full of holes (auto).");
  verb.option("Parts", "--components", components, "apart|tied",
              "tied: components that lie apart or run through each other are one object, and a part may hold "
              "faces of several; apart: each for itself (apart).");
  verb.option(
      "Parts", "--reading", reading, "literal|a|b",
      "For research: how the paper is read. literal: to the letter; a: valleys cross the openings that "
      "cuts leave; b: and depth is the way out of the hull, parts that can be one are joined (b).");
}

PartArguments PartTexts::checked() const {
  PartArguments out;
  out.options = options;
  if (!concavity.empty()) {
    if (std::isalpha(static_cast<unsigned char>(concavity.back())) != 0) {
      out.concavity_mm = length_or_refuse("--concavity", concavity, 1e-6, 1e9);
    } else {
      out.options.concavity = job::number_of(option_row("concavity"), "--concavity", concavity);
    }
  }
  using segment::Options;
  out.options.effort = choice_or_refuse<int>("--effort", effort, {{"1", 1}, {"2", 2}, {"3", 3}});
  out.options.holes = choice_or_refuse<Options::Holes>("--holes", holes,
                                                       {{"auto", Options::Holes::automatic},
                                                        {"keep", Options::Holes::keep},
                                                        {"close", Options::Holes::close}});
  out.options.components = choice_or_refuse<Options::Components>(
      "--components", components,
      {{"apart", Options::Components::apart}, {"tied", Options::Components::tied}});
  out.options.reading = choice_or_refuse<segment::Reading>(
      "--reading", reading,
      {{"b", segment::Reading::b}, {"a", segment::Reading::a}, {"literal", segment::Reading::literal}});
  if (!volume_weight.empty()) {
    out.options.volume_weight = number_or_refuse("--volume-weight", volume_weight, 0.0, 1000.0);
  }
  if (!count.empty()) {
    if (!concavity.empty() || !effort.empty() || !volume_weight.empty() || !holes.empty() ||
        !components.empty() || !reading.empty() || out.options.pockets || out.options.planes) {
      refuse(
          "--parts goes with none of --concavity, --effort, --volume-weight, --planes, --pockets, --holes, "
          "--components and --reading");
    }
    out.count = whole_number_or_refuse("--parts", count, 1);
  }
  return out;
}

}  // namespace

// ridgecraft segment

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
  verb.takes_several("--compare");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace existing files.");
  parts.add_to(verb);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    // Behind --compare the model is told from segmentations by its suffix.
    const auto model = std::find_if(job.compare.begin(), job.compare.end(),
                                    [](const std::string& file) { return !file.ends_with(".seg"); });
    if (job.model.empty() && model != job.compare.end()) {
      job.model = *model;
      job.compare.erase(model);
    }
    require(job.model, "name the model to segment", "ridgecraft segment");
    job.common = common_of(asked);
    job.parts = parts.checked();
    return job;
  });
}

// ridgecraft hulls, cage, shell and deform

Job build_hulls(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft hulls", "one convex hull per nearly convex part, for physics engines");
  verb.usage("ridgecraft hulls MODEL -o HULLS.obj [--max-vertices N] [options]");
  verb.example("ridgecraft hulls dinosaur.obj -o dinosaur-hulls.obj --max-vertices 64",
               "One object per hull; together they hold all that the model encloses.");
  verb.example("ridgecraft hulls dinosaur.obj -o near.obj --concavity 0.03 --max-hulls 32",
               "More hulls that lie closer.");
  verb.example("ridgecraft hulls dinosaur.obj -o dinosaur.urdf --unit m",
               "A robot description with a collision element per hull, and the meshes that it names.");
  HullsJob job;
  job::AskedOptions asked;
  PartTexts parts;
  std::string hulls, vertices, unit, density;
  add_model(verb, job.model);
  verb.option("Output", "-o,--output", job.output, "FILE",
              ".obj, one object a hull; .urdf (ROS), .xml (MuJoCo) or .sdf (Gazebo) with their meshes next "
              "to them; .usda "
              "(UsdPhysics) or .glb (KHR_physics_rigid_bodies).");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace existing files.");
  verb.option("Hulls", "--max-hulls", hulls, "N",
              "At most this many hulls: those whose joint hull adds least air are joined (no limit).");
  verb.option(
      "Hulls", "--max-vertices", vertices, "N",
      "At most this many vertices a hull, 8 or more; it grows instead of leaving anything out: by about 4 % "
      "with 64, half with 16 (no limit).");
  verb.option(
      "Hulls", "--unit", unit, "UNIT",
      "Unit of the file's numbers, for all but .obj: mm, cm, m, in, ft (what the file says, else mm).");
  verb.option("Hulls", "--density", density, "KG/M3", "For mass and inertia, in all but .obj (1000).");
  parts.add_to(verb);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to make hulls of", "ridgecraft hulls");
    require(job.output, "say with -o where the hulls go", "ridgecraft hulls");
    job.common = common_of(asked);
    job.parts = parts.checked();
    if (!vertices.empty()) {
      job.limits.max_vertices = whole_number_or_refuse("--max-vertices", vertices, 8);
    }
    if (!hulls.empty()) {
      job.limits.max_hulls = whole_number_or_refuse("--max-hulls", hulls, 1);
    }
    if ((!unit.empty() || !density.empty()) && suffix_of(job.output) == ".obj") {
      refuse("--unit and --density are for formats with metres and masses, such as .urdf; with -o " +
             job.output + " they have no effect");
    }
    if (!unit.empty()) {
      job.mm_per_unit = unit_or_refuse("--unit", unit);
    }
    if (!density.empty()) {
      job.density = number_or_refuse("--density", density, 1e-6, 1e6);
    }
    return job;
  });
}

Job build_cage(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft cage", "a coarse closed mesh around a model, to deform it with");
  verb.usage("ridgecraft cage MODEL -o CAGE.obj [--faces N] [options]");
  verb.example("ridgecraft cage penguin.obj -o penguin-cage.obj --faces 300",
               "Move the cage's vertices in any editor, then: ridgecraft deform.");
  CageJob job;
  job::AskedOptions asked;
  PartTexts parts;
  std::string faces;
  add_model(verb, job.model);
  verb.option("Output", "-o,--output", job.output, "FILE", ".obj, .ply or .off.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace an existing file.");
  verb.option("Cage", "--faces", faces, "N",
              "At most this many faces, 20 or more, where the shape allows it (500).");
  parts.add_to(verb);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to make a cage for", "ridgecraft cage");
    require(job.output, "say with -o where the cage goes", "ridgecraft cage");
    job.common = common_of(asked);
    job.parts = parts.checked();
    if (!faces.empty()) {
      job.faces = whole_number_or_refuse("--faces", faces, 20);
    }
    return job;
  });
}

Job build_shell(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft shell", "a watertight mesh around a broken one");
  verb.usage("ridgecraft shell MODEL -o SHELL.obj [--opening 5%] [options]");
  verb.example("ridgecraft shell vase.ply -o vase-shell.ply --opening 3%",
               "Holes and gaps narrower than 3 % of the diagonal are closed.");
  ShellJob job;
  job::AskedOptions asked;
  std::string opening, offset;
  add_model(verb, job.model);
  verb.option("Output", "-o,--output", job.output, "FILE", ".obj, .ply or .off.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace an existing file.");
  verb.option("Shell", "--opening", opening, "PERCENT",
              "Openings narrower than this share of the model's diagonal are closed (5%).");
  verb.option("Shell", "--offset", offset, "PERCENT",
              "Distance of the shell from the surface, as a share of the diagonal (0.2%).");
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to make a shell for", "ridgecraft shell");
    require(job.output, "say with -o where the shell goes", "ridgecraft shell");
    job.common = common_of(asked);
    job.opening = opening.empty() ? job.opening : percent_or_refuse("--opening", opening, 0.5, 100.0);
    job.offset = offset.empty() ? job.offset : percent_or_refuse("--offset", offset, 0.01, 10.0);
    return job;
  });
}

Job build_deform(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft deform", "moves a model as the cage around it is moved");
  verb.usage("ridgecraft deform MODEL --cage A.obj --to B.obj -o MOVED.obj");
  verb.example("ridgecraft deform penguin.obj --cage penguin-cage.obj --to moved-cage.obj -o moved.obj",
               "Both cages have the same triangles; what lies between follows smoothly.");
  DeformJob job;
  job::AskedOptions asked;
  add_model(verb, job.model);
  verb.option("Input", "--cage", job.cage, "FILE",
              "A closed mesh of triangles around the model; what lies outside it follows less well.");
  verb.option("Input", "--to", job.to, "FILE", "The same mesh with its points moved.");
  verb.option("Output", "-o,--output", job.output, "FILE", ".obj, .ply or .off.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace an existing file.");
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to deform", "ridgecraft deform");
    require(job.cage, "name the cage with --cage", "ridgecraft deform");
    require(job.to, "name the moved cage with --to", "ridgecraft deform");
    require(job.output, "say with -o where the result goes", "ridgecraft deform");
    job.common = common_of(asked);
    return job;
  });
}

}  // namespace ridgecraft::cli
