// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/part_options.hpp"

#include "base/option_values.hpp"

namespace ridgecraft::cli {

void PartTexts::add_to(Verb& verb) {
  verb.option(
      "Parts", "--concavity", concavity, "TOLERANCE",
      "Largest concavity of a part, in the scale where the smallest enclosing ball has radius 1 (0.1).");
  verb.option(
      "Parts", "--parts", count, "N",
      "Give N parts: the finest parts joined, the least concave unions first. In place of "
      "--concavity, --effort, --volume-weight, --planes, --pockets, --holes, --components and --reading.");
  verb.option(
      "Parts", "--effort", effort, "1|2|3",
      "How much work to spend: 2 and 3 also cut finer pieces and put them together anew, and keep the best "
      "attempt, for fewer parts with smaller hulls in about 4 and 25 times the time (1).");
  verb.option("Parts", "--volume-weight", volume_weight, "WEIGHT",
              "Parts to give for a volume ratio (hulls of the parts to the model) less by 1; 0 asks for the "
              "fewest parts whatever their hulls (0; 5 with --effort 2 and 3 and with --planes).");
  verb.flag("Parts", "--planes", options.planes,
            "Cut by planes, too, where that saves more volume than its pieces are worth by --volume-weight: "
            "cups and boxes without lid become sectors. For other uses than paper.");
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
    out.options.concavity = job::number_of(option_row("concavity"), "--concavity", concavity);
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

}  // namespace ridgecraft::cli
