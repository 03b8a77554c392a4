// SPDX-License-Identifier: GPL-3.0-or-later
// Segments the models of an unpacked Princeton Segmentation Benchmark and prints a table per category.
#include "segment/segment.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "segment/evaluate.hpp"
#include "segment/hull/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::bench {
namespace {

struct BenchmarkModel {
  int number = 0;
  mesh::Model read;
  std::vector<std::vector<std::uint32_t>> people;  ///< part of each polygon, by each person
  double seconds = 0.0;                            ///< CPU time of reading and repairing
};

/// Figures of one segmentation, or means of several.
struct Figures {
  int model = 0;
  std::string category;
  std::size_t faces = 0;
  double tolerance = 0.0;
  double parts = 0.0;
  double volume = 0.0;   ///< of the union of the parts' hulls over that of the model
  double seconds = 0.0;  ///< CPU time of reading and segmenting
  double reading = 0.0;
  double rand = 0.0;        ///< 1 - Rand index, mean over the people
  double worst = 0.0;       ///< greatest concavity of a part
  std::size_t outside = 0;  ///< vertices outside a hull that must hold them
};

[[nodiscard]] int category_number(int model);  ///< from 0 on
[[nodiscard]] std::string category_of(int model);
/// Numbers of the models in the folder; `subset`: only the first and the ninth of each category.
[[nodiscard]] std::vector<int> models_in(const std::filesystem::path& psb, bool subset);
/// Reads `off/NUMBER.off` and, where they are, the files of `seg/NUMBER`.
[[nodiscard]] BenchmarkModel read_model(const std::filesystem::path& psb, int number, const Context& context);
/// One line for machines.
[[nodiscard]] std::string json_line(const Figures& figures);
/// CPU time of this process.
[[nodiscard]] double cpu_seconds();

namespace fs = std::filesystem;

/// Rays a side of the grid on which hulls are united: 512 give the same within 0.001.
constexpr unsigned rays_a_side = 128;
/// Models of a category have consecutive numbers, this many.
constexpr int category_size = 20;
constexpr int last_model = 400;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

std::vector<std::uint32_t> read_labels(const fs::path& file) {
  const std::string text = read_text(file);
  const char* at = text.data();
  const char* end = text.data() + text.find_last_of("0123456789") + 1;
  std::vector<std::uint32_t> labels;
  while (at < end) {
    while (*at < '0' || *at > '9') {
      ++at;
    }
    std::uint32_t value = 0;
    at = std::from_chars(at, end, value).ptr;
    labels.push_back(value);
  }
  return labels;
}

int category_number(int model) {
  return (model - 1) / category_size;
}

std::string category_of(int model) {
  static const char* const names[] = {
      "Human", "Cup",  "Glasses", "Airplane", "Ant",       "Chair", "Octopus", "Table",   "Teddy", "Hand",
      "Plier", "Fish", "Bird",    "",         "Armadillo", "Bust",  "Mech",    "Bearing", "Vase",  "FourLeg"};
  return names[category_number(model)];
}

std::vector<int> models_in(const fs::path& psb, bool subset) {
  std::vector<int> models;
  for (int m = 1; m <= last_model; ++m) {
    const bool chosen = !subset || (m - 1) % category_size == 0 || (m - 1) % category_size == 8;
    if (chosen && fs::exists(psb / "off" / (std::to_string(m) + ".off"))) {
      models.push_back(m);
    }
  }
  return models;
}

BenchmarkModel read_model(const fs::path& psb, int number, const Context& context) {
  BenchmarkModel model;
  model.number = number;
  const double start = cpu_seconds();
  mesh::ReadOptions options;
  options.collapse_flat_faces = false;
  model.read = mesh::read(psb / "off" / (std::to_string(number) + ".off"), options, context);
  model.seconds = cpu_seconds() - start;
  const fs::path folder = psb / "seg" / std::to_string(number);
  if (fs::is_directory(folder)) {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files.insert(entry.path());
    }
    for (const fs::path& file : files) {
      std::vector<std::uint32_t> labels = read_labels(file);
      if (labels.size() == model.read.polygon_count) {
        model.people.push_back(std::move(labels));
      }
    }
  }
  return model;
}

/// Parts, volume and agreement of a labeling of the faces; the rest stays 0.
Figures judge(const BenchmarkModel& model, std::span<const std::uint32_t> part_of_face,
              const Context& context) {
  const mesh::Surface& surface = model.read.surface;
  Figures figures;
  figures.model = model.number;
  figures.category = category_of(model.number);
  figures.faces = surface.face_count();
  const std::set<std::uint32_t> parts(part_of_face.begin(), part_of_face.end());
  figures.parts = static_cast<double>(parts.size());
  figures.volume = segment::hull_volume_ratio(surface, part_of_face, rays_a_side, context);
  // In the file's order, as people's labels are; a face that repair dropped is a part of its own.
  std::vector<std::uint32_t> of_polygon(model.read.polygon_count, *parts.rbegin() + 1);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (model.read.polygon[f] < of_polygon.size()) {
      of_polygon[model.read.polygon[f]] = part_of_face[f.value()];
    }
  }
  for (const auto& person : model.people) {
    figures.rand += segment::rand_error(of_polygon, person) / static_cast<double>(model.people.size());
  }
  return figures;
}

/// How many vertices lie outside the hull of a part with a face of theirs, in exact arithmetic on the grid of
/// segment/surface/scaled_surface.hpp (2^-40 of the model's radius). Hulls are those of the reported hull
/// vertices.
std::size_t outside_hulls(const mesh::Surface& surface, const segment::Segmentation& segmentation) {
  /// So far below a triangle's plane no rounding matters: the exact sign isn't needed.
  constexpr double surely_below = 1e-9;
  const segment::ScaledSurface scaled = segment::scale_surface(surface, {});
  const std::vector<Vec3>& points = scaled.points;
  segment::HullBuilder builder(points);
  segment::Hull hull;
  std::size_t outside = 0;
  for (const segment::Part& part : segmentation.parts) {
    std::vector<std::uint32_t> hull_vertices;
    for (const VertexId v : part.hull_vertices) {
      hull_vertices.push_back(v.value());
    }
    builder.build(hull_vertices, hull);
    std::set<std::uint32_t> vertices;
    for (const FaceId f : part.faces) {
      vertices.insert(scaled.corners[f.value()].begin(), scaled.corners[f.value()].end());
    }
    std::vector<Vec3> inside;
    for (const std::uint32_t v : vertices) {
      inside.push_back(points[v]);
    }
    for (const auto& [a, b, c] : hull.triangles) {
      const Vec3 normal = normalized(cross(points[b] - points[a], points[c] - points[a]));
      const double limit = dot(normal, points[a]) - surely_below;
      std::size_t near = 0;
      for (const Vec3 p : inside) {
        near += dot(normal, p) > limit ? 1U : 0U;
      }
      if (near == 0) {
        continue;
      }
      outside += std::erase_if(inside, [&](Vec3 p) {
        return dot(normal, p) > limit && segment::exact_orientation(points[a], points[b], points[c], p) > 0;
      });
    }
  }
  return outside;
}

/// Means; `worst` is the greatest, `outside` the sum, model and category are the first's.
Figures mean_of(std::span<const Figures> rows) {
  Figures mean;
  const auto n = static_cast<double>(std::max<std::size_t>(1, rows.size()));
  for (const Figures& r : rows) {
    mean.parts += r.parts / n;
    mean.volume += r.volume / n;
    mean.seconds += r.seconds / n;
    mean.reading += r.reading / n;
    mean.rand += r.rand / n;
    mean.worst = std::max(mean.worst, r.worst);
    mean.outside += r.outside;
  }
  if (!rows.empty()) {
    mean.model = rows.front().model;
    mean.category = rows.front().category;
  }
  return mean;
}

std::string json_line(const Figures& r) {
  std::ostringstream out;
  out << "{\"model\": " << r.model << ", \"category\": \"" << r.category << "\", \"faces\": " << r.faces
      << ", \"tolerance\": " << r.tolerance << ", \"parts\": " << r.parts << ", \"volume\": " << r.volume
      << ", \"seconds\": " << r.seconds << ", \"reading\": " << r.reading << ", \"rand\": " << r.rand
      << ", \"worst\": " << r.worst << ", \"outside\": " << r.outside << "}";
  return out.str();
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

}  // namespace ridgecraft::bench

namespace {

// Segments the models of an unpacked Princeton Segmentation Benchmark and prints a table per category; with
// several tolerances, what each gives and what the best for each category and each model would give.

using namespace ridgecraft;
using bench::Figures;
namespace fs = std::filesystem;

struct Arguments {
  fs::path psb;
  fs::path json;
  segment::Options options;
  bool subset = false;
  unsigned threads = 1;     ///< several: seconds are those of the clock, not of the processor
  bool only_speed = false;  ///< no comparison with people and hulls: parts, seconds and a sum of the labels
  std::vector<int> models;
};

/// Equal for equal results: shows whether a faster program still does the same.
struct Sum {
  std::uint64_t value = 0;
  void add(std::uint32_t label) { value = Random(value ^ label).next(); }
};

Figures run_whole(const bench::BenchmarkModel& model, const segment::Options& options) {
  const Context context;
  const double start = bench::cpu_seconds();
  const segment::Segmentation result =
      segment::segment(model.read.surface, model.read.polygon.items(), options, context);
  const double seconds = bench::cpu_seconds() - start;
  std::vector<std::uint32_t> labels;
  for (const PartId p : result.part) {
    labels.push_back(p.value());
  }
  Figures row = bench::judge(model, labels, context);
  row.seconds = model.seconds + seconds;
  row.reading = model.seconds;
  row.worst = result.max_concavity();
  row.outside = bench::outside_hulls(model.read.surface, result);
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
  } else if (option == "--concavity") {
    arguments.options.concavity = std::stod(value);
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
  return !arguments.psb.empty();
}

int run(const Arguments& arguments) {
  const std::vector<int> models =
      arguments.models.empty() ? bench::models_in(arguments.psb, arguments.subset) : arguments.models;
  std::ofstream json(arguments.json);
  if (!arguments.json.empty() && !json) {
    throw Error(ErrorKind::cant_write, "can't write " + arguments.json.string());
  }
  std::vector<Figures> rows;
  Sum labels;
  for (const int m : models) {
    bench::BenchmarkModel model = bench::read_model(arguments.psb, m, Context{});
    if (arguments.only_speed) {
      for (int again = 0; again < 2; ++again) {
        model.seconds = std::min(model.seconds, bench::read_model(arguments.psb, m, Context{}).seconds);
      }
    }
    rows.push_back(arguments.only_speed ? run_speed(model, arguments.options, arguments.threads, labels)
                                        : run_whole(model, arguments.options));
    rows.back().tolerance = arguments.options.concavity;
    json << bench::json_line(rows.back()) << '\n' << std::flush;  // a long run can be watched
    if (!arguments.models.empty()) {
      print_row(std::to_string(m), rows.back());
    }
  }
  print_table(rows);
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
        "usage: bench_segment --psb DIR [--json FILE] [--subset] [--model N]... [--concavity T] [--effort "
        "1..3] "
        "[--reading literal|a|b] [--volume-weight W] [--planes] [--pockets] [--only-speed [--threads N]]\n");
    return 2;
  }
  try {
    return run(arguments);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_segment: %s\n", e.what());
    return 1;
  }
}
