// SPDX-License-Identifier: GPL-3.0-or-later
// How surely and how fast models become one net:
//
//   bench_unfold [--seeds N] [--json FILE] [--check] [--spiky] [--psb FOLDER] [--parts FOLDER]
//   [--limit SECONDS] MODEL...
//
// Each MODEL is unfolded as it is, panels loose; --spiky adds the family of bench/spiky_bodies.hpp. --psb
// names the folder of the Princeton benchmark's meshes (1.off, 3.off, ...): the 3rd, 9th and 15th of each
// category are simplified to 200, 500, 1000, 2000 and 5000 faces and unfolded. --parts names it too: the 3rd
// of each category is segmented as it is, and its parts with 2000 to 7000 faces are unfolded within --limit
// seconds (10). One thread; seconds are CPU time of one net from a surface, its final check included; the
// wall clock is looked at for the limit alone. --check tests every solved net again: all pairs of faces by
// exact rational arithmetic, lengths, and coverage.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/spiky_bodies.hpp"
#include "bench/unfold_runs.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "segment/segment.hpp"

using namespace ridgecraft;
using namespace ridgecraft::bench;

namespace {

namespace fs = std::filesystem;

struct Settings {
  Runs runs;
  bool spiky = false;
  std::string json;
  std::string psb;
  std::string parts;
  double limit = 10.0;
  std::vector<std::string> models;
};

void print(const Row& row) {
  std::printf("%-22s %6zu %6zu %6zu %10.5f %10.5f %10.4f %10.0f", row.name.c_str(), row.faces,
              row.seconds.size(), row.solved, quantile(row.seconds, 0.5), quantile(row.seconds, 0.9),
              quantile(row.seconds, 1.0), quantile(row.iterations, 0.5));
  std::printf(row.false_successes > 0 ? "  %zu FALSE\n" : "\n", row.false_successes);
  std::fflush(stdout);
}

std::vector<Row> run_models(const Settings& settings) {
  std::vector<Row> rows;
  for (const std::string& file : settings.models) {
    Row row;
    row.name = fs::path(file).stem().string();
    const mesh::Surface surface = mesh::read(file, {}, {}).surface;
    row.faces = surface.face_count();
    run(surface, all_faces(surface), settings.runs, row);
    print(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> run_spiky(const Settings& settings) {
  std::vector<Row> rows;
  for (const SpikyBody& body : spiky_family()) {
    Row row;
    row.name = "spiky " + body.name;
    row.faces = body.surface.face_count();
    run(body.surface, all_faces(body.surface), settings.runs, row);
    print(row);
    for (const std::size_t pieces : row.pieces_left) {
      std::printf("%-22s becomes %zu pieces\n", "", pieces);
    }
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
        const auto file = fs::path(settings.psb) / (std::to_string(base + place) + ".off");
        if (!fs::exists(file)) {
          continue;
        }
        prepare::SimplifyOptions simplify;
        simplify.mode = prepare::Simplification::count;
        simplify.faces = faces;
        const prepare::Prepared prepared =
            prepare::prepare(mesh::read(file, {}, {}), {}, simplify, {1e6, 1e6}, {});
        // Some models have fewer faces than this to begin with, or can't be simplified so far.
        const mesh::Surface& surface = prepared.model.surface;
        if (surface.face_count() > faces / 2 && surface.face_count() < 2 * faces &&
            surface.component_count() == 1) {
          run(surface, all_faces(surface), settings.runs, row);
        }
      }
    }
    print(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The parts of our own segmentation of unsimplified models, 2000 to 7000 faces each: dense and smooth.
Row run_parts(const Settings& settings) {
  Runs runs = settings.runs;
  runs.limit = settings.limit;
  Row all;
  all.name = "parts";
  for (int base = 0; base < 400; base += 20) {
    const auto file = fs::path(settings.parts) / (std::to_string(base + 3) + ".off");
    if (!fs::exists(file)) {
      continue;
    }
    const mesh::Model model = mesh::read(file, {}, {});
    const segment::Segmentation segmentation = segment::segment(model.surface, {}, {}, {});
    for (const segment::Part& part : segmentation.parts) {
      if (part.faces.size() < 2000 || part.faces.size() > 7000) {
        continue;
      }
      for (const std::vector<FaceId>& faces : unfold::connected(model.surface, part.faces)) {
        Row row;
        row.name = "part of " + std::to_string(base + 3);
        row.faces = faces.size();
        run(model.surface, faces, runs, row);
        print(row);
        for (const std::size_t pieces : row.pieces_left) {
          std::printf("%-22s becomes %zu pieces\n", "", pieces);
        }
        add(row, all);
      }
    }
  }
  all.faces = all.seconds.empty() ? 0 : all.faces / all.seconds.size() * static_cast<std::size_t>(runs.seeds);
  print(all);
  return all;
}

/// Slope of log seconds over log faces, by least squares over the medians.
double exponent(const std::vector<Row>& rows) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const Row& row : rows) {
    const double median = quantile(row.seconds, 0.5);
    if (median > 0.0) {
      const double x = std::log(static_cast<double>(row.faces));
      const double y = std::log(median);
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
        << ", \"median_s\": " << quantile(row.seconds, 0.5) << ", \"p90_s\": " << quantile(row.seconds, 0.9)
        << ", \"max_s\": " << quantile(row.seconds, 1.0)
        << ", \"median_iterations\": " << quantile(row.iterations, 0.5) << ", \"checked\": " << row.checked
        << ", \"false_successes\": " << row.false_successes << ", \"pieces_of_unsolved\": [";
    for (std::size_t k = 0; k < row.pieces_left.size(); ++k) {
      out << (k > 0 ? ", " : "") << row.pieces_left[k];
    }
    out << "]}";
  }
  out << "\n]}\n";
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--check") {
      settings.runs.check = true;
    } else if (word == "--spiky") {
      settings.spiky = true;
    } else if (word == "--seeds" && has_value) {
      settings.runs.seeds = std::stoi(argv[++i]);
    } else if (word == "--json" && has_value) {
      settings.json = argv[++i];
    } else if (word == "--psb" && has_value) {
      settings.psb = argv[++i];
    } else if (word == "--parts" && has_value) {
      settings.parts = argv[++i];
    } else if (word == "--limit" && has_value) {
      settings.limit = std::stod(argv[++i]);
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
    if (settings.spiky) {
      const std::vector<Row> more = run_spiky(settings);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    if (!settings.psb.empty()) {
      std::vector<Row> more = run_benchmark(settings);
      growth = exponent(more);
      std::printf("seconds grow as faces^%.2f\n", growth);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    if (!settings.parts.empty()) {
      rows.push_back(run_parts(settings));
    }
    if (!settings.json.empty()) {
      write_json(settings.json, rows, growth);
    }
    for (const Row& row : rows) {
      if (row.false_successes > 0) {
        return 1;
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_unfold: %s\n", error.what());
    return 1;
  }
  return 0;
}
