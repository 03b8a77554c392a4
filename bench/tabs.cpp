// SPDX-License-Identifier: GPL-3.0-or-later
// How many cut edges of whole models get a usable tab:
//
//   bench_tabs [--seeds N] [--effort TRIALS] [--faces N] [--rule strict|weak] [--phase off|on|split]
//   [--each] [--every K] [--psb FOLDER] MODEL...
//
// Each model is made 150 mm large and unfolded into one net, with 5 mm tabs, without and with the second
// phase; TRIALS (20) are for each face. In a third run ("split", strict rule only) pieces may be split until
// every edge that is wide enough has a tab. With the folder of the Princeton benchmark's meshes
// (1.off, 3.off,
// ...) the 3rd, 9th and 15th of each category (every K-th of them) are simplified to N faces (200 and 500).
// The strict rule is the library's; the weak one lets a tab show beyond the face behind which it is glued,
// and overlap by 0.01 mm. Shares are means over the models, and of these the median over the seeds. One
// thread, CPU seconds.
#include "unfold/tabs.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/tab_bound.hpp"
#include "mesh/foundation/error.hpp"
#include "mesh/mesh.hpp"
#include "unfold/tabs/tab_shapes.hpp"
#include "unfold/tabs/tab_sites.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;

namespace {

constexpr double model_size_mm = 150.0;
/// What the weak rule allows tabs to overlap, mm.
constexpr double weak_overlap_mm = 0.01;

struct Settings {
  int seeds = 3;
  double effort = 20.0;
  std::vector<std::size_t> faces{200, 500};
  bool strict = true;
  bool weak = true;
  std::vector<std::string> phases{"off", "on", "split"};
  bool each = false;
  int every = 1;
  std::string psb;
  std::vector<std::string> models;
};

struct Example {
  std::string name;
  mesh::Surface surface;
  mesh::Panels panels;
  bench::TabBound bound;
};

/// One net, or the sum over many.
struct Figures {
  double runs = 0.0;
  double pieces = 0.0;
  double cuts = 0.0;
  double usable = 0.0;  ///< share of the cuts
  double any = 0.0;
  double of_wide = 0.0;        ///< share of the cuts that are wide enough for a usable tab
  double usable_long = 0.0;    ///< share of those longer than bench::long_edge_mm
  double of_bound = 0.0;       ///< share of what geometry allows
  double of_long_bound = 0.0;  ///< the same of the long ones
  double collisions = 0.0;
};

unfold::ConvexShape face_shape(const unfold::Nets& nets, FaceId f) {
  return unfold::ConvexShape(std::span<const Vec2>(nets.flat[f]));
}

unfold::ConvexShape tab_shape(const unfold::Tab& tab) {
  return unfold::ConvexShape(std::span<const Vec2>(tab.polygon));
}

/// Pairs of a tab with a face or tab of its piece that overlap, all against all.
std::size_t count_collisions(const unfold::Nets& nets, double allowed_mm) {
  std::size_t count = 0;
  for (const unfold::Tab& tab : nets.tabs) {
    const unfold::ConvexShape shape = tab_shape(tab);
    const PieceId piece = nets.piece[mesh::face_of(tab.side)];
    for (const FaceId f : nets.pieces[piece].faces) {
      count += unfold::separation(shape, face_shape(nets, f)) < -allowed_mm ? 1U : 0U;
    }
    for (const unfold::Tab& other : nets.tabs) {
      count += &other < &tab && nets.piece[mesh::face_of(other.side)] == piece &&
                       unfold::separation(shape, tab_shape(other)) < -allowed_mm
                   ? 1U
                   : 0U;
    }
  }
  return count;
}

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : 1.0;
}

Figures figures_of(const Example& example, const unfold::Nets& nets, const unfold::TabOptions& options) {
  double usable = 0.0;
  double wide = 0.0;
  double long_cuts = 0.0;
  double long_usable = 0.0;
  for (const unfold::Join& join : nets.joins) {
    const bool is_long = example.surface.length(join.edge) > bench::long_edge_mm;
    const bool good = join.tab.valid() && unfold::is_usable(example.surface, nets, join.tab, options);
    usable += good ? 1.0 : 0.0;
    wide += join.too_narrow ? 0.0 : 1.0;
    long_cuts += is_long ? 1.0 : 0.0;
    long_usable += is_long && good ? 1.0 : 0.0;
  }
  const auto joins = static_cast<double>(nets.joins.size());
  Figures result;
  result.runs = 1.0;
  result.pieces = static_cast<double>(nets.pieces.size());
  result.cuts = joins;
  result.usable = share(usable, joins);
  result.any = share(static_cast<double>(nets.tabs.size()), joins);
  result.of_wide = share(usable, wide);
  result.usable_long = share(long_usable, long_cuts);
  result.of_bound = share(result.usable, example.bound.cuts);
  result.of_long_bound = share(result.usable_long, example.bound.long_cuts);
  result.collisions = static_cast<double>(
      count_collisions(nets, std::fmax(1e-6, options.inside_target ? 0.0 : 1.001 * weak_overlap_mm)));
  return result;
}

/// Every member, so that sums, means and medians need be written once.
constexpr double Figures::*members[] = {&Figures::runs,        &Figures::pieces,   &Figures::cuts,
                                        &Figures::usable,      &Figures::any,      &Figures::of_wide,
                                        &Figures::usable_long, &Figures::of_bound, &Figures::of_long_bound,
                                        &Figures::collisions};

Figures mean(const std::vector<Figures>& all) {
  Figures result;
  for (const auto member : members) {
    for (const Figures& one : all) {
      result.*member += one.*member / static_cast<double>(all.size());
    }
  }
  result.runs = static_cast<double>(all.size());
  result.collisions *= result.runs;
  return result;
}

double quantile(std::vector<double> values, double where) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0
                        : values[static_cast<std::size_t>(where * static_cast<double>(values.size() - 1))];
}

Figures median(const std::vector<Figures>& all) {
  Figures result;
  for (const auto member : members) {
    std::vector<double> values;
    for (const Figures& one : all) {
      values.push_back(one.*member);
    }
    result.*member = quantile(std::move(values), 0.5);
  }
  return result;
}

void print_head() {
  std::printf("%-7s %-6s %-6s %5s %7s %7s %8s %8s %8s %9s %9s %7s %6s %9s %8s\n", "faces", "rule", "phase",
              "nets", "pieces", "cuts", "usable", "any tab", "of wide", "of bound", "over 8mm", "of bnd",
              "colls", "median s", "90 % s");
}

void print(const std::string& faces, const std::string& rule, const std::string& phase, const Figures& row,
           const std::vector<double>& seconds) {
  std::printf(
      "%-7s %-6s %-6s %5.0f %7.2f %7.1f %7.1f%% %7.1f%% %7.2f%% %8.1f%% %8.1f%% %6.1f%% %6.0f %9.3f %8.3f\n",
      faces.c_str(), rule.c_str(), phase.c_str(), row.runs, row.pieces, row.cuts, 100.0 * row.usable,
      100.0 * row.any, 100.0 * row.of_wide, 100.0 * row.of_bound, 100.0 * row.usable_long,
      100.0 * row.of_long_bound, row.collisions, quantile(seconds, 0.5), quantile(seconds, 0.9));
  std::fflush(stdout);
}

void run(const std::string& faces, const std::vector<Example>& examples, bool strict,
         const std::string& phase, const Settings& settings) {
  unfold::Options options;
  options.panel_cuts = unfold::PanelCuts::before_pieces;
  options.tabs.trials_per_face = phase == "off" ? 0.0 : settings.effort;
  options.tabs.split_pieces = phase == "split";
  options.tabs.inside_target = strict;
  options.tabs.clearance_mm = strict ? options.tabs.clearance_mm : -weak_overlap_mm;
  std::vector<Figures> of_seed;
  std::vector<double> seconds;
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    Context context;
    context.seed = static_cast<std::uint64_t>(seed);
    context.threads = 1;
    std::vector<Figures> of_model;
    for (const Example& example : examples) {
      const std::clock_t start = std::clock();
      const unfold::Nets nets =
          unfold::unfold(example.surface, example.panels,
                         IdVector<FaceId, PartId>(example.surface.face_count(), PartId(0)), options, context);
      seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      of_model.push_back(figures_of(example, nets, options.tabs));
      if (settings.each) {
        print(example.name, strict ? "strict" : "weak", phase, of_model.back(), {seconds.back()});
      }
    }
    of_seed.push_back(mean(of_model));
  }
  print(faces, strict ? "strict" : "weak", phase, median(of_seed), seconds);
}

void run_all(const std::string& faces, const std::vector<Example>& examples, const Settings& settings) {
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
          run(faces, examples, strict, phase, settings);
        }
      }
    }
  }
}

/// The model simplified to so many faces; nothing where it has fewer, can't be simplified so far or is
/// several.
std::optional<Example> example_of(const std::filesystem::path& file, std::optional<std::size_t> faces) {
  mesh::SimplifyOptions simplify;
  simplify.mode = faces ? mesh::Simplification::count : mesh::Simplification::keep;
  simplify.faces = faces.value_or(0);
  mesh::SizeOptions size;
  size.largest_extent_mm = model_size_mm;
  mesh::Prepared prepared = mesh::prepare(mesh::read(file, {}, {}), size, simplify, {1e6, 1e6}, {});
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
    print_head();
    std::vector<Example> given;
    for (const std::string& file : settings.models) {
      given.push_back(*example_of(file, {}));
    }
    run_all("given", given, settings);
    for (const std::size_t faces : settings.faces) {
      if (!settings.psb.empty()) {
        run_all(std::to_string(faces), benchmark(settings.psb, faces, settings.every), settings);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_tabs: %s\n", error.what());
    return 1;
  }
  return 0;
}
