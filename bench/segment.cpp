// SPDX-License-Identifier: GPL-3.0-or-later
// Segments the models of an unpacked Princeton Segmentation Benchmark and prints a table per category.
#include "segment/segment.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "mesh/context.hpp"
#include "mesh/mesh.hpp"
#include "segment/agreement.hpp"
#include "segment/evaluate.hpp"

namespace {

using namespace ridgecraft;
namespace fs = std::filesystem;

struct Arguments {
  fs::path psb;
  fs::path json;
  segment::Options options;
  bool subset = false;
  double damage = 0.0;  ///< share of the faces to remove at random
  std::vector<int> models;
};

struct Row {
  int model = 0;
  std::string category;
  std::size_t faces = 0;
  double parts = 0.0;
  double volume = 0.0;
  double seconds = 0.0;  ///< CPU time of reading and segmenting
  double reading = 0.0;
  double rand = 0.0;
  double worst = 0.0;
};

const char* category_of(int model) {
  static const char* const names[] = {
      "Human", "Cup",  "Glasses", "Airplane", "Ant",       "Chair", "Octopus", "Table",   "Teddy", "Hand",
      "Plier", "Fish", "Bird",    "",         "Armadillo", "Bust",  "Mech",    "Bearing", "Vase",  "FourLeg"};
  return names[(model - 1) / 20];
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

template <class T>
T next_number(const char*& at, const char* end) {
  while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) {
    ++at;
  }
  T value{};
  at = std::from_chars(at, end, value).ptr;
  return value;
}

std::vector<std::uint32_t> read_labels(const fs::path& file) {
  const std::string text = read_text(file);
  const char* at = text.data();
  const char* end = text.data() + text.find_last_of("0123456789") + 1;
  std::vector<std::uint32_t> labels;
  while (at < end) {
    labels.push_back(next_number<std::uint32_t>(at, end));
  }
  return labels;
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

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

Row run_damaged(int model, const Arguments& arguments, const mesh::Surface& whole) {
  Row row;
  row.model = model;
  row.category = category_of(model);
  const Context context;
  const mesh::Surface surface = damaged(whole, arguments.damage);
  const double start = cpu_seconds();
  const segment::Segmentation result = segment::segment(surface, {}, arguments.options, context);
  row.seconds = cpu_seconds() - start;
  row.faces = surface.face_count();
  row.parts = static_cast<double>(result.parts.size());
  row.worst = result.max_concavity();
  return row;
}

Row run_model(int model, const Arguments& arguments) {
  Row row;
  row.model = model;
  row.category = category_of(model);
  const Context context;
  const double start = cpu_seconds();
  mesh::ReadOptions read_options;
  read_options.collapse_flat_faces = false;
  const mesh::Model read =
      mesh::read(arguments.psb / "off" / (std::to_string(model) + ".off"), read_options, context);
  const mesh::Surface& surface = read.surface;
  row.reading = cpu_seconds() - start;
  if (arguments.damage > 0.0) {
    return run_damaged(model, arguments, surface);
  }
  const segment::Segmentation result =
      segment::segment(surface, read.polygon.items(), arguments.options, context);
  row.seconds = cpu_seconds() - start;
  row.faces = surface.face_count();
  row.parts = static_cast<double>(result.parts.size());
  row.worst = result.max_concavity();
  std::vector<std::uint32_t> labels;
  for (const PartId p : result.part) {
    labels.push_back(p.value());
  }
  // In the file's order, as people's labels are; a face that repair dropped is a part of its own.
  std::vector<std::uint32_t> of_polygon(read.polygon_count, static_cast<std::uint32_t>(result.parts.size()));
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (read.polygon[f] < of_polygon.size()) {
      of_polygon[read.polygon[f]] = labels[f.value()];
    }
  }
  row.volume = segment::hull_volume_ratio(surface, labels, 128, context);
  int people = 0;
  const fs::path folder = arguments.psb / "seg" / std::to_string(model);
  if (fs::is_directory(folder)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      const auto person = read_labels(file);
      if (person.size() == of_polygon.size()) {
        row.rand += segment::rand_error(of_polygon, person);
        ++people;
      }
    }
  }
  row.rand = people > 0 ? row.rand / people : 0.0;
  return row;
}

Row mean_of(const std::vector<Row>& rows) {
  Row mean;
  for (const Row& r : rows) {
    mean.parts += r.parts;
    mean.volume += r.volume;
    mean.seconds += r.seconds;
    mean.reading += r.reading;
    mean.rand += r.rand;
    mean.worst = std::max(mean.worst, r.worst);
  }
  const auto n = static_cast<double>(std::max<std::size_t>(1, rows.size()));
  mean.parts /= n;
  mean.volume /= n;
  mean.seconds /= n;
  mean.reading /= n;
  mean.rand /= n;
  return mean;
}

void print_row(const std::string& name, const Row& r) {
  std::printf("%-10s %7.2f %7.3f %8.4f %8.4f %8.4f %8.4f\n", name.c_str(), r.parts, r.volume, r.seconds,
              r.reading, r.rand, r.worst);
}

void write_json(const fs::path& file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << "[\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& r = rows[i];
    out << "{\"model\": " << r.model << ", \"category\": \"" << r.category << "\", \"faces\": " << r.faces
        << ", \"parts\": " << r.parts << ", \"volume\": " << r.volume << ", \"seconds\": " << r.seconds
        << ", \"reading\": " << r.reading << ", \"rand\": " << r.rand << ", \"worst\": " << r.worst << "}"
        << (i + 1 < rows.size() ? ",\n" : "\n");
  }
  out << "]\n";
}

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--subset") {
      arguments.subset = true;
      continue;
    }
    if (option == "--planes") {
      arguments.options.planes = true;
      continue;
    }
    if (option == "--pockets") {
      arguments.options.pockets = true;
      continue;
    }
    if (i + 1 >= argc) {
      return false;
    }
    const std::string value = argv[++i];
    if (option == "--psb") {
      arguments.psb = value;
    } else if (option == "--json") {
      arguments.json = value;
    } else if (option == "--concavity") {
      arguments.options.concavity = std::stod(value);
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
    } else if (option == "--model") {
      arguments.models.push_back(std::stoi(value));
    } else {
      return false;
    }
  }
  return !arguments.psb.empty();
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fprintf(stderr,
                 "usage: bench_segment --psb DIR [--json FILE] [--subset] [--model N]... [--concavity T] "
                 "[--effort 1..3] [--reading literal|a|b] [--volume-weight W] [--planes] [--pockets] "
                 "[--damage SHARE]\n");
    return 2;
  }
  std::vector<int> models = arguments.models;
  if (models.empty()) {
    for (int m = 1; m <= 400; ++m) {
      const bool chosen = !arguments.subset || (m - 1) % 20 == 0 || (m - 1) % 20 == 8;
      if (chosen && fs::exists(arguments.psb / "off" / (std::to_string(m) + ".off"))) {
        models.push_back(m);
      }
    }
  }
  std::vector<Row> rows;
  std::map<int, std::vector<Row>> categories;
  for (const int m : models) {
    rows.push_back(run_model(m, arguments));
    categories[(m - 1) / 20].push_back(rows.back());
    if (!arguments.models.empty()) {
      print_row(std::to_string(m), rows.back());
    }
  }
  std::printf("category     parts  volume  seconds  reading   1-Rand    worst\n");
  for (const auto& [number, list] : categories) {
    print_row(list.front().category, mean_of(list));
  }
  print_row("mean", mean_of(rows));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("models %zu, peak memory %.0f MiB\n", rows.size(),
              static_cast<double>(usage.ru_maxrss) / 1024.0);
  if (!arguments.json.empty()) {
    write_json(arguments.json, rows);
  }
  return 0;
}
