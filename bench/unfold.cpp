// SPDX-License-Identifier: GPL-3.0-or-later
// How surely and how fast whole models become one net:
//
//   bench_unfold [--seeds N] [--json FILE] [--psb FOLDER] MODEL...
//
// Each MODEL is unfolded as it is, panels loose. With the folder of the Princeton benchmark's meshes
// (1.off, 3.off, ...) the 3rd, 9th and 15th of each category are simplified to 200, 500, 1000, 2000 and 5000
// faces and unfolded. One thread; seconds are CPU time of one net from a surface, its final check included.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/error.hpp"
#include "mesh/mesh.hpp"
#include "unfold/net_search.hpp"
#include "unfold/tolerance.hpp"

using namespace ridgecraft;

namespace {

struct Settings {
  int seeds = 3;
  std::string json;
  std::string psb;
  std::vector<std::string> models;
};

/// All runs of one row of the table.
struct Row {
  std::string name;
  std::size_t faces = 0;
  std::size_t solved = 0;
  std::vector<double> seconds;
  std::vector<double> iterations;

  [[nodiscard]] double quantile(double share) const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0.0
                          : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
  [[nodiscard]] double median_iterations() const {
    std::vector<double> sorted = iterations;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  }
};

void run(const mesh::Surface& surface, int seeds, Row& row) {
  mesh::Panels panels;
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    panels.panel.push_back(PanelId(f.value()));
    faces.push_back(f);
  }
  for (int seed = 1; seed <= seeds; ++seed) {
    const std::clock_t start = std::clock();
    const unfold::Patch patch = unfold::make_patch(surface, panels, faces);
    unfold::NetSearch options;
    options.tolerance = unfold::search_tolerance * patch.extent;
    options.iterations = unfold::iteration_budget(patch.size());
    const unfold::NetFound found = unfold::find_net(patch, options, static_cast<std::uint64_t>(seed), {});
    row.seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    row.iterations.push_back(static_cast<double>(found.iterations));
    row.solved += found.overlaps == 0 ? 1U : 0U;
  }
}

void print(const Row& row) {
  std::printf("%-22s %6zu %6zu %6zu %10.5f %10.5f %10.4f %10.0f\n", row.name.c_str(), row.faces,
              row.seconds.size(), row.solved, row.quantile(0.5), row.quantile(0.9), row.quantile(1.0),
              row.median_iterations());
  std::fflush(stdout);
}

std::vector<Row> run_models(const Settings& settings) {
  std::vector<Row> rows;
  for (const std::string& file : settings.models) {
    Row row;
    row.name = std::filesystem::path(file).stem().string();
    const mesh::Surface surface = mesh::read(file, {}, {}).surface;
    row.faces = surface.face_count();
    run(surface, settings.seeds, row);
    print(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> run_benchmark(const Settings& settings) {
  std::vector<Row> rows;
  for (const std::size_t faces : {200U, 500U, 1000U, 2000U, 5000U}) {
    Row row;
    row.name = "psb";
    row.faces = faces;
    for (int base = 0; base < 400; base += 20) {
      for (const int place : {3, 9, 15}) {
        const auto file = std::filesystem::path(settings.psb) / (std::to_string(base + place) + ".off");
        if (!std::filesystem::exists(file)) {
          continue;
        }
        mesh::SimplifyOptions simplify;
        simplify.mode = mesh::Simplification::count;
        simplify.faces = faces;
        const mesh::Prepared prepared = mesh::prepare(mesh::read(file, {}, {}), {}, simplify, {1e6, 1e6}, {});
        // Some models have fewer faces than this to begin with, or can't be simplified so far.
        const std::size_t got = prepared.model.surface.face_count();
        if (got > faces / 2 && got < 2 * faces && prepared.model.surface.component_count() == 1) {
          run(prepared.model.surface, settings.seeds, row);
        }
      }
    }
    print(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Slope of log seconds over log faces, by least squares over the medians.
double exponent(const std::vector<Row>& rows) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const Row& row : rows) {
    if (row.quantile(0.5) > 0.0) {
      const double x = std::log(static_cast<double>(row.faces));
      const double y = std::log(row.quantile(0.5));
      n += 1.0;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  return n > 1.0 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : 0.0;
}

void write_json(const std::string& path, const std::vector<Row>& rows, double growth) {
  std::ofstream out(path);
  out << "{\"exponent\": " << growth << ", \"rows\": [";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    out << (i > 0 ? ",\n" : "\n") << "{\"name\": \"" << row.name << "\", \"faces\": " << row.faces
        << ", \"runs\": " << row.seconds.size() << ", \"solved\": " << row.solved
        << ", \"median_s\": " << row.quantile(0.5) << ", \"p90_s\": " << row.quantile(0.9)
        << ", \"max_s\": " << row.quantile(1.0) << ", \"median_iterations\": " << row.median_iterations()
        << "}";
  }
  out << "\n]}\n";
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--seeds" && has_value) {
      settings.seeds = std::stoi(argv[++i]);
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
    std::printf("%-22s %6s %6s %6s %10s %10s %10s %10s\n", "model", "faces", "runs", "solved", "median s",
                "90 % s", "max s", "iterations");
    std::vector<Row> rows = run_models(settings);
    double growth = 0.0;
    if (!settings.psb.empty()) {
      std::vector<Row> more = run_benchmark(settings);
      growth = exponent(more);
      std::printf("seconds grow as faces^%.2f\n", growth);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    if (!settings.json.empty()) {
      write_json(settings.json, rows, growth);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_unfold: %s\n", error.what());
    return 1;
  }
  return 0;
}
