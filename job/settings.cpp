// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/settings.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/option_table.hpp"
#include "job/asked_options.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::job {
namespace {

std::string number(double value) {
  return fmt::format("{}", value);
}

void add_size(const Options& options, export_::Settings& settings) {
  if (options.size.mm_per_unit) {
    settings["mm_per_unit"] = number(*options.size.mm_per_unit);
  } else {
    settings["size_mm"] = number(options.size.largest_extent_mm);
  }
  if (options.up) {
    settings["up"] = json_string(mesh::axis_name(*options.up));
  }
  if (options.size.judged_at_mm) {
    settings["judged_at_mm"] = number(*options.size.judged_at_mm);
  }
  settings["faces"] = options.simplify.mode == prepare::Simplification::automatic ? json_string("auto")
                      : options.simplify.mode == prepare::Simplification::keep
                          ? json_string("keep")
                          : std::to_string(options.simplify.faces);
  if (options.simplify.mode != prepare::Simplification::automatic) {
    settings.erase("hours");
  }
}

/// "3, from 20 mm 5, from 60 mm 8"
std::string steps(const std::vector<unfold::FromLength>& values, double factor) {
  std::string text;
  for (const unfold::FromLength& step : values) {
    text += text.empty() ? "" : fmt::format(", from {} mm ", step.length_mm);
    text += fmt::format("{:.10g}", step.value * factor);
  }
  return json_string(text);
}

/// No tab is higher.
double greatest_height(const Options& options) {
  double height = options.tabs.height_mm;
  if (options.tab_choice.sides == unfold::TabSides::slots) {
    height = std::max(height, unfold::slot_tab_height_mm);
  }
  for (const unfold::FromLength& step : options.tab_choice.heights_mm) {
    height = std::max(height, step.value);
  }
  for (const unfold::EdgeTab& edge : options.tab_choice.edges) {
    height = std::max(height, edge.height_mm.value_or(0.0));
  }
  for (const unfold::TabAt& edge : options.tab_choice.at) {
    height = std::max(height, edge.height_mm.value_or(0.0));
  }
  return height;
}

void add_tabs(const Options& options, export_::Settings& settings) {
  settings["tabs"] = options.tabs.wanted ? "true" : "false";
  settings["tab_height_mm"] = number(greatest_height(options));
  if (!options.tabs.wanted) {
    for (const char* of_tabs : {"tab_sides", "border_tabs", "all_tabs"}) {
      settings.erase(of_tabs);
    }
    return;
  }
  const unfold::TabChoice& choice = options.tab_choice;
  if (!choice.heights_mm.empty()) {
    settings["tab_heights"] = steps(choice.heights_mm, 1.0);
  }
  if (!choice.angles.empty()) {
    settings["tab_angles"] = steps(choice.angles, 180.0 / std::numbers::pi);
  }
  if (!options.tab_file_digest.empty()) {
    settings["tab_file"] = json_string(options.tab_file_digest);
  }
}

void add_edges(const EdgeRequests& edges, export_::Settings& settings) {
  if (edges.cut) {
    settings["cuts"] = json_string(edges.cut->digest);
  }
  if (edges.keep) {
    settings["keep"] = json_string(edges.keep->digest);
  }
  if (edges.from) {
    settings["from"] = json_string(digest(edges.from->bytes));
  }
}

void add_pages(Options& options, export_::Settings& settings) {
  settings["paper_mm"] = fmt::format("[{},{}]", options.paper->size.x, options.paper->size.y);
  settings["gap_mm"] = number(options.paper->gap);
  settings["max_faces"] = std::to_string(options.pieces.max_panels);
  for (const std::string_view term : unfold::term_names()) {
    settings[std::string(option_row("weigh").setting) + std::string(term)] =
        number(*unfold::weight_named(options.pieces.weights, term));
  }
}

}  // namespace

export_::Settings settings_of(Options options, const UsedOptions& used, std::uint64_t seed) {
  options.bodies = used.bodies;
  options.size = used.size;
  options.simplify = used.simplify;
  export_::Settings settings;
  note_fields(options, settings);
  add_size(options, settings);
  if (options.bodies == prepare::Bodies::unite) {
    settings["bodies"] = json_string("united");
  } else {
    settings.erase("skins");
  }
  if (!options.paper || !(options.board.thickness_mm > 0.0)) {
    settings.erase("thickness_mm");
    settings.erase("hinge");
  }
  if (options.simplify.part_attached) {
    settings["standing"] = json_string("apart");
  }
  add_tabs(options, settings);
  add_edges(options.edges, settings);
  settings["seed"] = std::to_string(seed);
  if (options.paper) {
    add_pages(options, settings);
  } else {
    settings["whole"] = options.parts == PartsFrom::components ? "true" : "false";
  }
  return settings;
}

export_::Settings with_searched(export_::Settings now, const export_::Settings& searched) {
  for (const auto& [name, value] : searched) {
    const auto found = now.find(name);
    if (found == now.end() || found->second != value) {
      now["searched_" + name] = value;
    }
  }
  return now;
}

}  // namespace ridgecraft::job
