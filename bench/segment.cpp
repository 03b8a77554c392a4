// SPDX-License-Identifier: GPL-3.0-or-later
// Segments the models of an unpacked Princeton Segmentation Benchmark and prints a table per category; with
// several tolerances, what each gives and what the best for each category and each model would give.
#include "segment/segment.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>

#include <sys/resource.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "psb.hpp"

namespace {

using namespace ridgecraft;
using bench::Figures;
namespace fs = std::filesystem;

struct Arguments {
  fs::path psb;
  fs::path json;
  fs::path labels;  ///< folder for NUMBER.seg: part of each face, as the benchmark writes people's
  segment::Options options;
  std::vector<double> sweep;  ///< tolerances
  bool subset = false;
  unsigned threads = 1;     ///< several: seconds are those of the clock, not of the processor
  bool only_speed = false;  ///< no comparison with people and hulls: parts, seconds and a sum of the labels
  double damage = 0.0;      ///< share of the faces to remove at random
  std::vector<int> models;
};

/// The surface with each face removed at a probability: the paper's figure 15.
mesh::Surface damaged(const mesh::Surface& whole, double share) {
  Random random(1);
  std::vector<std::array<VertexId, 3>> corners;
  for (const FaceId f : ids<FaceId>(whole.face_count())) {
    if (random.unit() >= share) {
      corners.push_back(whole.vertices(f));
    }
  }
  return {{whole.points().begin(), whole.points().end()}, std::move(corners)};
}

/// Equal for equal results: shows whether a faster program still does the same.
struct Sum {
  std::uint64_t value = 0;
  void add(std::uint32_t label) { value = Random(value ^ label).next(); }
};

Figures run_damaged(const bench::BenchmarkModel& model, double share, const segment::Options& options) {
  const mesh::Surface surface = damaged(model.read.surface, share);
  const double start = bench::cpu_seconds();
  const segment::Segmentation result = segment::segment(surface, {}, options, Context{});
  Figures row;
  row.model = model.number;
  row.category = bench::category_of(model.number);
  row.faces = surface.face_count();
  row.parts = static_cast<double>(result.parts.size());
  row.seconds = bench::cpu_seconds() - start;
  row.worst = result.max_concavity();
  return row;
}

void write_labels(const fs::path& file, const segment::Segmentation& result) {
  std::ofstream out(file);
  for (const PartId p : result.part) {
    out << p.value() << '\n';
  }
  out.close();
  if (!out) {
    throw Error(ErrorKind::cant_write, "can't write " + file.string());
  }
}

Figures run_whole(const bench::BenchmarkModel& model, const segment::Options& options,
                  const fs::path& labels_folder, bool checks_hulls) {
  const Context context;
  const double start = bench::cpu_seconds();
  const segment::Segmentation result =
      segment::segment(model.read.surface, model.read.polygon.items(), options, context);
  const double seconds = bench::cpu_seconds() - start;
  if (!labels_folder.empty()) {
    write_labels(labels_folder / (std::to_string(model.number) + ".seg"), result);
  }
  std::vector<std::uint32_t> labels;
  for (const PartId p : result.part) {
    labels.push_back(p.value());
  }
  Figures row = bench::judge(model, labels, context);
  row.seconds = model.seconds + seconds;
  row.reading = model.seconds;
  row.worst = result.max_concavity();
  if (checks_hulls) {
    row.outside = bench::outside_hulls(model.read.surface, result);
  }
  return row;
}

/// The least of three times: other work on the machine only ever adds.
Figures run_speed(const bench::BenchmarkModel& model, const segment::Options& options, unsigned threads,
                  Sum& labels) {
  constexpr int runs = 3;
  Context context;
  context.threads = threads;
  const auto now = [&] {
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now().time_since_epoch();
    return threads > 1 ? clock.count() : bench::cpu_seconds();
  };
  Figures row;
  row.model = model.number;
  row.category = bench::category_of(model.number);
  row.faces = model.read.surface.face_count();
  row.reading = model.seconds;
  double seconds = INFINITY;
  for (int run = 0; run < runs; ++run) {
    const double start = now();
    const segment::Segmentation result =
        segment::segment(model.read.surface, model.read.polygon.items(), options, context);
    seconds = std::min(seconds, now() - start);
    row.parts = static_cast<double>(result.parts.size());
    row.worst = result.max_concavity();
    for (const PartId p : result.part) {
      labels.add(p.value());
    }
  }
  row.seconds = row.reading + seconds;
  return row;
}

void print_row(const std::string& name, const Figures& r) {
  std::printf("%-10s %7.2f %7.3f %8.4f %8.4f %8.4f %8.4f\n", name.c_str(), r.parts, r.volume, r.seconds,
              r.reading, r.rand, r.worst);
}

/// In the benchmark's order: by number of the category.
using Categories = std::map<int, std::vector<Figures>>;

Categories by_category(const std::vector<Figures>& rows) {
  Categories categories;
  for (const Figures& r : rows) {
    categories[bench::category_number(r.model)].push_back(r);
  }
  return categories;
}

void print_table(const std::vector<Figures>& rows) {
  std::printf("category     parts  volume  seconds  reading   1-Rand    worst\n");
  for (const auto& [number, list] : by_category(rows)) {
    print_row(list.front().category, bench::mean_of(list));
  }
  print_row("mean", bench::mean_of(rows));
  std::printf("vertices outside a hull of theirs: %zu\n", bench::mean_of(rows).outside);
}

/// `runs`: for each tolerance all models in the same order. The best tolerance of a category or a model is
/// the one that people agree with most: fitted to the very figures that are printed.
void print_sweep(const std::vector<double>& tolerances, const std::vector<std::vector<Figures>>& runs) {
  std::printf("tolerance    parts  volume  seconds  reading   1-Rand    worst\n");
  std::vector<Figures> best_of_model = runs[0];
  std::map<int, std::size_t> best_of_category;
  std::vector<Categories> categories;
  for (std::size_t t = 0; t < runs.size(); ++t) {
    std::ostringstream name;
    name << tolerances[t];
    print_row(name.str(), bench::mean_of(runs[t]));
    categories.push_back(by_category(runs[t]));
    for (std::size_t i = 0; i < runs[t].size(); ++i) {
      if (runs[t][i].rand < best_of_model[i].rand) {
        best_of_model[i] = runs[t][i];
      }
    }
    for (const auto& [category, rows] : categories[t]) {
      std::size_t& best = best_of_category.try_emplace(category, t).first->second;
      if (bench::mean_of(rows).rand < bench::mean_of(categories[best].at(category)).rand) {
        best = t;
      }
    }
  }
  std::vector<Figures> of_category;
  std::printf("\nbest tolerance of each category (fitted)\n");
  for (const auto& [category, t] : best_of_category) {
    const std::vector<Figures>& rows = categories[t].at(category);
    of_category.insert(of_category.end(), rows.begin(), rows.end());
    std::printf("%-9g ", tolerances[t]);
    print_row(rows.front().category, bench::mean_of(rows));
  }
  print_row("mean", bench::mean_of(of_category));
  std::printf("\nbest tolerance of each model (fitted)\n");
  print_row("mean", bench::mean_of(best_of_model));
}

bool parse_switch(const std::string& option, Arguments& arguments) {
  if (option == "--subset") {
    arguments.subset = true;
  } else if (option == "--only-speed") {
    arguments.only_speed = true;
  } else if (option == "--planes") {
    arguments.options.planes = true;
  } else if (option == "--pockets") {
    arguments.options.pockets = true;
  } else {
    return false;
  }
  return true;
}

bool parse_value(const std::string& option, const std::string& value, Arguments& arguments) {
  if (option == "--psb") {
    arguments.psb = value;
  } else if (option == "--json") {
    arguments.json = value;
  } else if (option == "--labels") {
    arguments.labels = value;
  } else if (option == "--concavity") {
    arguments.options.concavity = std::stod(value);
  } else if (option == "--sweep") {
    std::istringstream list(value);
    for (std::string one; std::getline(list, one, ',');) {
      arguments.sweep.push_back(std::stod(one));
    }
  } else if (option == "--damage") {
    arguments.damage = std::stod(value);
  } else if (option == "--effort") {
    arguments.options.effort = std::stoi(value);
  } else if (option == "--reading") {
    using segment::Reading;
    arguments.options.reading = value == "literal" ? Reading::literal
                                : value == "a"     ? Reading::a
                                                   : Reading::b;
  } else if (option == "--volume-weight") {
    arguments.options.volume_weight = std::stod(value);
  } else if (option == "--threads") {
    arguments.threads = static_cast<unsigned>(std::stoul(value));
  } else if (option == "--model") {
    arguments.models.push_back(std::stoi(value));
  } else {
    return false;
  }
  return true;
}

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    if (parse_switch(argv[i], arguments)) {
      continue;
    }
    if (i + 1 >= argc || !parse_value(argv[i], argv[i + 1], arguments)) {
      return false;
    }
    ++i;
  }
  if (arguments.sweep.empty()) {
    arguments.sweep.push_back(arguments.options.concavity);
  }
  return !arguments.psb.empty();
}

/// What is wrong with arguments that go with each other badly, or can't be served; nothing when all is well.
std::string fault_of(const Arguments& arguments) {
  if (!fs::is_directory(arguments.psb)) {
    return "there is no folder " + arguments.psb.string();
  }
  if (arguments.labels.empty()) {
    return {};
  }
  if (arguments.only_speed || arguments.damage > 0.0 || arguments.sweep.size() > 1) {
    return "--labels goes with neither --only-speed nor --damage nor --sweep: one file of labels a model";
  }
  if (!fs::is_directory(arguments.labels)) {
    return "there is no folder " + arguments.labels.string() + " to write labels into";
  }
  return {};
}

int run(const Arguments& arguments) {
  const std::vector<int> models =
      arguments.models.empty() ? bench::models_in(arguments.psb, arguments.subset) : arguments.models;
  std::ofstream json(arguments.json);
  if (!arguments.json.empty() && !json) {
    throw Error(ErrorKind::cant_write, "can't write " + arguments.json.string());
  }
  std::vector<std::vector<Figures>> runs(arguments.sweep.size());
  Sum labels;
  for (const int m : models) {
    bench::BenchmarkModel model = bench::read_model(arguments.psb, m, Context{});
    if (arguments.only_speed) {
      for (int again = 0; again < 2; ++again) {
        model.seconds = std::min(model.seconds, bench::read_model(arguments.psb, m, Context{}).seconds);
      }
    }
    for (std::size_t t = 0; t < runs.size(); ++t) {
      segment::Options options = arguments.options;
      options.concavity = arguments.sweep[t];
      runs[t].push_back(arguments.damage > 0.0 ? run_damaged(model, arguments.damage, options)
                        : arguments.only_speed
                            ? run_speed(model, options, arguments.threads, labels)
                            : run_whole(model, options, arguments.labels, runs.size() == 1));
      runs[t].back().tolerance = options.concavity;
      json << bench::json_line(runs[t].back()) << std::endl;  // a long run can be watched
      if (!arguments.models.empty()) {
        print_row(std::to_string(m), runs[t].back());
      }
    }
  }
  if (runs.size() > 1) {
    print_sweep(arguments.sweep, runs);
  } else {
    print_table(runs[0]);
  }
  if (arguments.only_speed) {
    std::printf("sum of labels %016llx\n", static_cast<unsigned long long>(labels.value));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("models %zu, peak memory %.0f MiB\n", models.size(),
              static_cast<double>(usage.ru_maxrss) / 1024.0);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fprintf(
        stderr,
        "usage: bench_segment --psb DIR [--json FILE] [--labels DIR] [--subset] [--model N]... [--concavity "
        "T | "
        "--sweep T,T,...] [--effort 1..3] [--reading literal|a|b] [--volume-weight W] [--planes] [--pockets] "
        "[--damage SHARE] [--only-speed [--threads N]]\n");
    return 2;
  }
  if (const std::string fault = fault_of(arguments); !fault.empty()) {
    std::fprintf(stderr, "bench_segment: %s\n", fault.c_str());
    return 2;
  }
  try {
    return run(arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_segment: %s\n", e.what());
    return 1;
  }
}
