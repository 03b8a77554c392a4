// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/tab_options.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include "cli/arguments/option_values.hpp"

namespace ridgecraft::cli {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180.0;

enum class Sides : std::uint8_t { best, one_side, alternate, both, slots, none };

double height_or_refuse(const std::string& text) {
  const double mm = length_or_refuse("--tab-height", text);
  require_range("--tab-height", text, mm, unfold::lowest_asked_mm, unfold::highest_asked_mm, "1.5mm to 50mm");
  return mm;
}

double angle_or_refuse(const std::string& text) {
  return number_or_refuse("--tab-angle", text, 15.0, 90.0) * radians_per_degree;
}

/// "4mm,20mm:5mm,60mm:8mm": the value of short edges, then lengths of edges from which on another one counts.
template <class Read>
std::vector<unfold::FromLength> steps_or_refuse(const std::string& option, std::string_view text, Read read) {
  std::vector<unfold::FromLength> steps;
  while (true) {
    const std::string_view step = text.substr(0, text.find(','));
    const std::size_t colon = step.find(':');
    const double from =
        colon == std::string_view::npos ? 0.0 : length_or_refuse(option, std::string(step.substr(0, colon)));
    steps.push_back({from, read(std::string(step.substr(colon == std::string_view::npos ? 0 : colon + 1)))});
    const bool first = steps.size() == 1;
    if (first != (colon == std::string_view::npos) ||
        (!first && !(from > steps[steps.size() - 2].length_mm))) {
      refuse(option +
             " takes a value for short edges, then lengths of edges from which on others count, such as " +
             (option == "--tab-angle" ? "60,20mm:45" : "4mm,20mm:5mm,60mm:8mm"));
    }
    if (step.size() == text.size()) {
      return steps;
    }
    text.remove_prefix(step.size() + 1);
  }
}

}  // namespace

void TabTexts::add_to(Verb& verb, PaperJob& job) {
  verb.option(
      "Tabs and lines", "--tabs", sides, "auto|one-side|alternate|both|slots|none",
      "Which side of a cut gets the glue tab: that with more room behind it; along a seam of two pieces "
      "always the same piece, or one after the other, as far as there is room; both, to be glued to each "
      "other; arrows that go into slits of the neighbour, without glue, where there is room for them; "
      "neither (auto).");
  verb.option("Tabs and lines", "--tab-height", height, "LENGTH",
              "Height of the glue tabs (5mm); also by length of edge: 4mm,20mm:5mm,60mm:8mm is 4 mm, from 20 "
              "mm on 5, from 60 mm on 8.");
  verb.option("Tabs and lines", "--tab-angle", angle, "DEGREES",
              "Side angle of the glue tabs, 90 for rectangles; steeper where an edge is short (45). By "
              "length of edge in "
              "the same way: 60,20mm:45.");
  verb.flag("Tabs and lines", "--border-tabs", borders,
            "Tabs also at borders of open models, which are glued to nothing of the model.");
  verb.option("Tabs and lines", "--tab-file", job.tab_file, "FILE",
              "Tabs edge by edge: a number of an edge a line, then none, both, height=7mm, angle=60 or the "
              "name of the "
              "piece that gives the tab.");
  verb.flag("Tabs and lines", "--tab-shadow", shadows,
            "Thin lines on the faces behind which tabs come to lie.");
  verb.flag("Tabs and lines", "--all-tabs", all,
            "Split pieces further until every edge with a face wide enough behind it has a glue tab.");
  verb.flag("Tabs and lines", "--no-tabs", none, "Draw no glue tabs: the same as --tabs none.");
}

void TabTexts::check_into(PaperJob& job) const {
  const Choices<Sides> words{{"auto", Sides::best},           {"one-side", Sides::one_side},
                             {"alternate", Sides::alternate}, {"both", Sides::both},
                             {"slots", Sides::slots},         {"none", Sides::none}};
  const Sides chosen = choice_or_refuse<Sides>("--tabs", sides, words);
  if (none && !sides.empty() && chosen != Sides::none) {
    refuse("--no-tabs and --tabs " + sides + " exclude each other");
  }
  const bool without = none || chosen == Sides::none;
  const std::string option = none ? "--no-tabs" : "--tabs none";
  if (without && all) {
    refuse("--all-tabs and " + option + " exclude each other");
  }
  if (without && (!height.empty() || !angle.empty())) {
    refuse("--tab-height and --tab-angle tell the shape of tabs; with " + option + " they have no effect");
  }
  if (without && (borders || shadows || !job.tab_file.empty())) {
    refuse("--border-tabs, --tab-shadow and --tab-file are about tabs; with " + option + " there are none");
  }
  if (chosen == Sides::slots && (!height.empty() || !angle.empty())) {
    refuse(
        "--tab-height and --tab-angle tell the shape of glue tabs; with --tabs slots tabs have the shape "
        "that "
        "holds in their slits");
  }
  if (chosen == Sides::slots && job.options.board.thickness_mm > 0.0) {
    refuse("--tabs slots is for paper and card, whose tabs bend through a slit; with --thickness they don't");
  }
  unfold::TabOptions& tabs = job.options.tabs;
  unfold::TabChoice& choice = job.options.tab_choice;
  tabs.wanted = !without;
  tabs.split_pieces = all;
  choice.sides = chosen == Sides::one_side    ? unfold::TabSides::one_side
                 : chosen == Sides::alternate ? unfold::TabSides::alternate
                 : chosen == Sides::both      ? unfold::TabSides::both
                 : chosen == Sides::slots     ? unfold::TabSides::slots
                                              : unfold::TabSides::best;
  choice.borders = borders;
  job.options.style.tab_shadows = shadows;
  if (!height.empty()) {
    choice.heights_mm = steps_or_refuse("--tab-height", height, height_or_refuse);
    tabs.height_mm = choice.heights_mm.front().value;
  }
  if (!angle.empty()) {
    choice.angles = steps_or_refuse("--tab-angle", angle, angle_or_refuse);
    tabs.angle = choice.angles.front().value;
  }
  tabs.steepest_angle = std::max(tabs.steepest_angle, tabs.angle);
  // One value for all edges is what nets are searched with, too.
  for (auto* steps : {&choice.heights_mm, &choice.angles}) {
    if (steps->size() == 1) {
      steps->clear();
    }
  }
}

}  // namespace ridgecraft::cli
