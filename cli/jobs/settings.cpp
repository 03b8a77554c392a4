// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/settings.hpp"

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/digest.hpp"
#include "unfold/net/piece_rules.hpp"

namespace ridgecraft::cli {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump();
}
std::string number(double value) {
  return fmt::format("{}", value);
}
std::string degrees(double radians) {
  return fmt::format("{:.10g}", radians * 180.0 / std::numbers::pi);
}

void add_size(const SizeArguments& size, paper::Settings& settings) {
  if (size.size.mm_per_unit) {
    settings["mm_per_unit"] = number(*size.size.mm_per_unit);
  } else {
    settings["size_mm"] = number(size.size.largest_extent_mm);
  }
  settings["faces"] = size.simplify.mode == prepare::Simplification::automatic ? quoted("auto")
                      : size.simplify.mode == prepare::Simplification::keep
                          ? quoted("keep")
                          : std::to_string(size.simplify.faces);
}

void add_tabs(const unfold::TabOptions& tabs, paper::Settings& settings) {
  settings["tabs"] = tabs.wanted ? "true" : "false";
  settings["tab_height_mm"] = number(tabs.height_mm);
  settings["tab_angle_deg"] = degrees(tabs.angle);
  if (tabs.wanted && tabs.split_pieces) {
    settings["all_tabs"] = "true";
  }
}

void add_edges(const EdgeFiles& edges, paper::Settings& settings) {
  const auto add = [&](const char* key, const std::optional<EdgeFile>& file) {
    if (file) {
      settings[key] = quoted(digest(file->bytes));
    }
  };
  add("cuts", edges.cuts);
  add("keep", edges.keep);
  add("from", edges.from);
}

/// What both jobs that make nets are told.
template <class Job>
paper::Settings shared_settings(const Job& job, const SizeArguments& size, const EdgeFiles& edges) {
  paper::Settings settings;
  add_size(size, settings);
  add_tabs(job.tabs, settings);
  add_edges(edges, settings);
  settings["seed"] = std::to_string(job.common.seed);
  settings["concavity"] = number(job.concavity);
  return settings;
}

}  // namespace

paper::Settings settings_of(const PaperJob& job, const SizeArguments& size, const EdgeFiles& edges) {
  paper::Settings settings = shared_settings(job, size, edges);
  settings["paper_mm"] = fmt::format("[{},{}]", job.paper.size.x, job.paper.size.y);
  settings["margin_mm"] = number(job.paper.margin);
  settings["gap_mm"] = number(job.paper.gap);
  settings["pieces"] = quoted(job.pieces_asked);
  settings["max_faces"] = std::to_string(job.pieces.max_panels);
  unfold::Weights weights = job.pieces.weights;
  for (const std::string_view term : unfold::term_names()) {
    settings["weigh_" + std::string(term)] = number(*unfold::weight_named(weights, term));
  }
  settings["hide_folds_deg"] = degrees(job.style.hidden_fold_angle);
  return settings;
}

paper::Settings settings_of(const UnfoldJob& job, const SizeArguments& size, const EdgeFiles& edges) {
  paper::Settings settings = shared_settings(job, size, edges);
  settings["whole"] = job.whole ? "true" : "false";
  return settings;
}

}  // namespace ridgecraft::cli
