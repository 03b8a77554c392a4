// SPDX-License-Identifier: GPL-3.0-or-later
// How many cut edges of whole models get a usable tab:
//
//   bench_tabs [--seeds N] [--effort TRIALS] [--faces N] [--rule strict|weak] [--phase off|on|split]
//   [--each] [--every K] [--json FILE] [--psb FOLDER] MODEL...
//
// Each model is made 150 mm large and unfolded into one net, with 5 mm tabs, without and with the second
// phase; TRIALS (20) are for each face. In a third run ("split", strict rule only, a table of its own) pieces
// may be split until every edge that is wide enough has a tab: share of those that have one and how many are
// left, the same of all that geometry allows whatever the tab's shape ("of able"), pieces in all, more than
// one per model and the most of them. With the folder of the Princeton benchmark's meshes (1.off, 3.off, ...)
// the 3rd, 9th and 15th of each category (every K-th of them) are simplified to N faces (200 and 500). The
// strict rule is the library's; the weak one lets a tab show beyond the face behind which it is glued, and
// overlap by 0.01 mm. Shares are means over the models, and of these the median over the seeds; of tabs left
// out and collisions the sum over the models, and of these the worst seed. One thread, CPU seconds.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/tab_bound.hpp"
#include "bench/tab_figures.hpp"
#include "bench/tab_table.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;

namespace {

constexpr double model_size_mm = 150.0;

struct Settings {
  int seeds = 3;
  double effort = 20.0;
  std::vector<std::size_t> faces{200, 500};
  bool strict = true;
  bool weak = true;
  std::vector<std::string> phases{"off", "on", "split"};
  bool each = false;
  int every = 1;
  std::string json;
  std::string psb;
  std::vector<std::string> models;
};

struct Example {
  std::string name;
  mesh::Surface surface;
  prepare::Panels panels;
  bench::TabBound bound;
};

/// The row of all these models; prints one for each where that is asked for.
bench::TabRow run(const std::string& faces, const std::vector<Example>& examples, bool strict,
                  const std::string& phase, const Settings& settings) {
  unfold::Options options;
  options.panel_cuts = unfold::PanelCuts::before_pieces;
  options.pieces.trials_per_face = phase == "off" ? 0.0 : settings.effort;
  options.tabs.split_pieces = phase == "split";
  options.tabs.inside_target = strict;
  options.tabs.clearance_mm = strict ? options.tabs.clearance_mm : -bench::weak_overlap_mm;
  bench::TabRow row{faces, strict ? "strict" : "weak", phase, {}, {}};
  std::vector<bench::TabFigures> of_seed;
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    Context context;
    context.seed = static_cast<std::uint64_t>(seed);
    context.threads = 1;
    std::vector<bench::TabFigures> of_model;
    for (const Example& example : examples) {
      const std::clock_t start = std::clock();
      const unfold::Nets nets =
          unfold::unfold(example.surface, example.panels,
                         IdVector<FaceId, PartId>(example.surface.face_count(), PartId(0)), options, context);
      row.seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      of_model.push_back(bench::figures_of(example.surface, example.bound, nets, options.tabs));
      if (settings.each) {
        bench::print({example.name, row.rule, phase, of_model.back(), {row.seconds.back()}});
      }
    }
    of_seed.push_back(bench::mean_of_models(of_model));
  }
  row.figures = bench::median_of_seeds(of_seed);
  return row;
}

void run_all(const std::string& faces, const std::vector<Example>& examples, const Settings& settings,
             std::vector<bench::TabRow>& rows) {
  if (examples.empty()) {
    return;
  }
  bench::TabBound bound;
  for (const Example& example : examples) {
    const auto n = static_cast<double>(examples.size());
    bound.edges += example.bound.edges / n;
    bound.cuts += example.bound.cuts / n;
    bound.long_cuts += example.bound.long_cuts / n;
  }
  std::printf(
      "%-7s bounds: %.1f%% of all edges can have a usable tab; of the cuts of a net at most %.1f%%, of "
      "those over 8 mm at most %.1f%%\n",
      faces.c_str(), 100.0 * bound.edges, 100.0 * bound.cuts, 100.0 * bound.long_cuts);
  for (const bool strict : {true, false}) {
    if (strict ? settings.strict : settings.weak) {
      for (const std::string& phase : settings.phases) {
        if (strict || phase != "split") {
          if (rows.empty() || (rows.back().phase == "split") != (phase == "split")) {
            bench::print_head(phase);
          }
          rows.push_back(run(faces, examples, strict, phase, settings));
          bench::print(rows.back());
        }
      }
    }
  }
}

/// The model simplified to so many faces; nothing where it has fewer, can't be simplified so far or is
/// several.
std::optional<Example> example_of(const std::filesystem::path& file, std::optional<std::size_t> faces) {
  prepare::SimplifyOptions simplify;
  simplify.mode = faces ? prepare::Simplification::count : prepare::Simplification::keep;
  simplify.faces = faces.value_or(0);
  prepare::SizeOptions size;
  size.largest_extent_mm = model_size_mm;
  prepare::Prepared prepared = prepare::prepare(mesh::read(file, {}, {}), size, simplify, {1e6, 1e6}, {});
  const std::size_t got = prepared.model.surface.face_count();
  if (faces && (got <= *faces / 2 || got >= 2 * *faces || prepared.model.surface.component_count() != 1)) {
    return {};
  }
  const bench::TabBound bound = bench::tab_bound(prepared.model.surface, prepared.panels);
  return Example{file.stem().string(), std::move(prepared.model.surface), std::move(prepared.panels), bound};
}

std::vector<Example> benchmark(const std::string& folder, std::size_t faces, int every) {
  std::vector<Example> examples;
  int number = 0;
  for (int base = 0; base < 400; base += 20) {
    for (const int place : {3, 9, 15}) {
      const auto file = std::filesystem::path(folder) / (std::to_string(base + place) + ".off");
      if (std::filesystem::exists(file) && number++ % every == 0) {
        if (auto example = example_of(file, faces)) {
          examples.push_back(std::move(*example));
        }
      }
    }
  }
  return examples;
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--seeds" && has_value) {
      settings.seeds = std::stoi(argv[++i]);
    } else if (word == "--effort" && has_value) {
      settings.effort = std::stod(argv[++i]);
    } else if (word == "--faces" && has_value) {
      settings.faces = {std::stoul(argv[++i])};
    } else if (word == "--rule" && has_value) {
      const std::string rule = argv[++i];
      settings.strict = rule != "weak";
      settings.weak = rule != "strict";
    } else if (word == "--phase" && has_value) {
      settings.phases = {argv[++i]};
    } else if (word == "--each") {
      settings.each = true;
    } else if (word == "--every" && has_value) {
      settings.every = std::stoi(argv[++i]);
    } else if (word == "--json" && has_value) {
      settings.json = argv[++i];
    } else if (word == "--psb" && has_value) {
      settings.psb = argv[++i];
    } else {
      settings.models.push_back(word);
    }
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings settings = parse(argc, argv);
    std::vector<bench::TabRow> rows;
    std::vector<Example> given;
    for (const std::string& file : settings.models) {
      given.push_back(*example_of(file, {}));
    }
    run_all("given", given, settings, rows);
    for (const std::size_t faces : settings.faces) {
      if (!settings.psb.empty()) {
        run_all(std::to_string(faces), benchmark(settings.psb, faces, settings.every), settings, rows);
      }
    }
    if (!settings.json.empty()) {
      bench::write_json(settings.json, rows);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_tabs: %s\n", error.what());
    return 1;
  }
  return 0;
}
