// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft hulls, cage, shell and deform
#include "base/option_values.hpp"
#include "cli/arguments/part_options.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"
#include "cli/files/formats.hpp"

namespace ridgecraft::cli {

Job build_hulls(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft hulls", "one convex hull per nearly convex part, for physics engines");
  verb.usage("ridgecraft hulls MODEL -o HULLS.obj [--max-vertices N] [options]");
  verb.example("ridgecraft hulls dinosaur.obj -o dinosaur-hulls.obj --max-vertices 64",
               "One object per hull; every hull encloses its part.");
  verb.example("ridgecraft hulls dinosaur.obj -o few.obj --effort 3 --planes --volume-weight 8",
               "Fewer hulls that lie closer, for about 25 times the work.");
  verb.example("ridgecraft hulls dinosaur.obj -o dinosaur.urdf --unit m",
               "A robot description with a collision element per hull, and the meshes that it names.");
  HullsJob job;
  job::AskedOptions asked;
  PartTexts parts;
  std::string vertices, unit, density;
  add_model(verb, job.model);
  verb.option("Output", "-o,--output", job.output, "FILE", ".obj, or .urdf with its meshes beside it.");
  verb.flag("Output", "--overwrite", job.overwrite, "Replace existing files.");
  verb.option(
      "Hulls", "--max-vertices", vertices, "N",
      "At most this many vertices a hull, 8 or more; it grows instead of leaving anything out: by about 4 % "
      "with 64, half with 16 (no limit).");
  verb.option("Hulls", "--unit", unit, "UNIT",
              "Unit of the file's numbers for .urdf: mm, cm, m, in, ft (what the file says, else mm).");
  verb.option("Hulls", "--density", density, "KG/M3", "For mass and inertia in .urdf (1000).");
  parts.add_to(verb);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to make hulls of", "ridgecraft hulls");
    require(job.output, "say with -o where the hulls go", "ridgecraft hulls");
    job.common = common_of(asked);
    job.parts = parts.checked();
    if (!vertices.empty()) {
      job.max_vertices = whole_number_or_refuse("--max-vertices", vertices, 8);
    }
    if ((!unit.empty() || !density.empty()) && suffix_of(job.output) != ".urdf") {
      refuse("--unit and --density tell a .urdf's metres and masses; with -o " + job.output +
             " they have no effect");
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
