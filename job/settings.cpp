// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/settings.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "base/digest.hpp"
#include "base/json_text.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::job {
namespace {

std::string number(double value) {
  return fmt::format("{}", value);
}
std::string degrees(double radians) {
  return fmt::format("{:.10g}", radians * 180.0 / std::numbers::pi);
}

void add_size(const Options& options, paper::Settings& settings) {
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
}

/// Names are one text, each on a line of its own.
void add_names(const std::vector<std::string>& names, const std::string& key, paper::Settings& settings) {
  if (!names.empty()) {
    settings[key] = json_string(fmt::format("{}", fmt::join(names, "\n")));
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

void add_choice(const unfold::TabChoice& choice, const std::string& file_digest, paper::Settings& settings) {
  if (choice.sides != unfold::TabSides::best) {
    settings["tab_sides"] = json_string(choice.sides == unfold::TabSides::one_side    ? "one-side"
                                        : choice.sides == unfold::TabSides::alternate ? "alternate"
                                        : choice.sides == unfold::TabSides::both      ? "both"
                                                                                      : "slots");
  }
  if (choice.borders) {
    settings["border_tabs"] = "true";
  }
  if (!choice.heights_mm.empty()) {
    settings["tab_heights"] = steps(choice.heights_mm, 1.0);
  }
  if (!choice.angles.empty()) {
    settings["tab_angles"] = steps(choice.angles, 180.0 / std::numbers::pi);
  }
  if (!file_digest.empty()) {
    settings["tab_file"] = json_string(file_digest);
  }
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
  return height;
}

void add_tabs(const Options& options, paper::Settings& settings) {
  const unfold::TabOptions& tabs = options.tabs;
  settings["tabs"] = tabs.wanted ? "true" : "false";
  settings["tab_height_mm"] = number(greatest_height(options));
  if (tabs.wanted) {
    add_choice(options.tab_choice, options.tab_file_digest, settings);
  }
  settings["tab_angle_deg"] = degrees(tabs.angle);
  if (tabs.wanted && tabs.split_pieces) {
    settings["all_tabs"] = "true";
  }
}

void add_edges(const EdgeRequests& edges, paper::Settings& settings) {
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

void add_pages(const Options& options, paper::Settings& settings) {
  settings["paper_mm"] = fmt::format("[{},{}]", options.paper->size.x, options.paper->size.y);
  settings["margin_mm"] = number(options.paper->margin);
  settings["gap_mm"] = number(options.paper->gap);
  settings["pieces"] = json_string(unfold::name(options.pieces.mode));
  settings["max_faces"] = std::to_string(options.pieces.max_panels);
  unfold::Weights weights = options.pieces.weights;
  for (const std::string_view term : unfold::term_names()) {
    settings["weigh_" + std::string(term)] = number(*unfold::weight_named(weights, term));
  }
  if (options.paper->packing != paper::PackingEffort::fast) {
    settings["pack"] = json_string(std::string(paper::word(options.paper->packing)));
  }
  if (options.paper->grain != paper::Grain::any) {
    settings["grain"] = json_string(std::string(paper::word(options.paper->grain)));
  }
  if (options.page_by != PageBy::any) {
    settings["page_by"] = json_string(options.page_by == PageBy::material ? "material" : "object");
  }
  settings["hide_folds_deg"] = degrees(options.style.hidden_fold_angle);
  if (options.board.thickness_mm > 0.0) {
    settings["thickness_mm"] = number(options.board.thickness_mm);
    settings["hinge"] = json_string(std::string(paper::word(options.board.hinge)));
  }
}

}  // namespace

paper::Settings settings_of(const Options& options, std::uint64_t seed) {
  paper::Settings settings;
  add_names(options.selection.only, "only", settings);
  add_names(options.selection.without, "without", settings);
  add_size(options, settings);
  if (options.bodies == prepare::Bodies::unite) {
    settings["bodies"] = json_string("united");
    if (options.simplify.skins != prepare::Skins::outer) {
      settings["skins"] = json_string(options.simplify.skins == prepare::Skins::both ? "both" : "middle");
    }
  }
  if (options.simplify.part_standing) {
    settings["standing"] = json_string("apart");
  }
  add_tabs(options, settings);
  add_edges(options.edges, settings);
  settings["seed"] = std::to_string(seed);
  settings["concavity"] = number(options.concavity);
  if (options.pieces.fold_linear) {
    settings["fold_linear"] = "true";
  }
  if (options.paper) {
    add_pages(options, settings);
  } else {
    settings["whole"] = options.parts == PartsFrom::components ? "true" : "false";
  }
  return settings;
}

paper::Settings with_searched(paper::Settings now, const paper::Settings& searched) {
  for (const auto& [name, value] : searched) {
    const auto found = now.find(name);
    if (found == now.end() || found->second != value) {
      now["searched_" + name] = value;
    }
  }
  return now;
}

}  // namespace ridgecraft::job
