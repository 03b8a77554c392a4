// SPDX-License-Identifier: GPL-3.0-or-later
// How surely and how fast models become one net:
//
//   bench_unfold [--seeds N] [--json FILE] [--check] [--spiky] [--psb FOLDER] MODEL...
//
// Each MODEL is unfolded as it is, panels loose; --spiky adds the family of bench/spiky_bodies.hpp. --psb
// names the folder of the Princeton benchmark's meshes (1.off, 3.off, ...): the 3rd, 9th and 15th of each
// category are simplified to 200, 500, 1000, 2000 and 5000 faces and unfolded. One thread; seconds are CPU
// time of one net from a surface, its final check included. --check tests every solved net again: all pairs
// of faces by exact rational arithmetic, lengths, and coverage.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <CGAL/Exact_rational.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "bench/spiky_bodies.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepare.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/net_search.hpp"

using namespace ridgecraft;
using namespace ridgecraft::bench;

namespace {

struct Runs {
  int seeds = 3;
  bool check = false;
};

/// All runs of one row of the table.
struct Row {
  std::string name;
  std::size_t faces = 0;
  std::size_t solved = 0;
  std::size_t checked = 0;
  std::size_t false_successes = 0;
  std::vector<double> seconds;
  std::vector<double> trials;
  std::vector<std::size_t> overlaps_left;  ///< per run that wasn't solved: pairs of faces
};

using Exact = CGAL::Exact_rational;
using Flat = std::array<Vec2, 3>;

struct ExactPoint {
  Exact x, y;
};
using ExactTriangle = std::array<ExactPoint, 3>;

ExactTriangle exact(const Flat& t) {
  ExactTriangle e;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = {Exact(t[k].x), Exact(t[k].y)};
  }
  return e;
}

/// Does an edge of a have all of b on its outer side, but for a depth of at most the tolerance? The rounded
/// coordinates are taken as they are; everything after that is exact, squares instead of roots.
bool separated(const ExactTriangle& a, const ExactTriangle& b, const Exact& tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactPoint& p = a[k];
    const ExactPoint& q = a[(k + 1) % 3];
    const Exact ux = q.x - p.x;
    const Exact uy = q.y - p.y;
    Exact deepest;  // times the edge's length
    for (std::size_t j = 0; j < 3; ++j) {
      const Exact depth = ux * (b[j].y - p.y) - uy * (b[j].x - p.x);
      if (j == 0 || depth > deepest) {
        deepest = depth;
      }
    }
    if (deepest <= 0 || deepest * deepest <= tolerance * tolerance * (ux * ux + uy * uy)) {
      return true;
    }
  }
  return false;
}

/// Lays the third corner over an edge from the lengths in space.
Vec2 third_corner(Vec2 from, Vec2 to, double along, double left, double right) {
  const double x = (along * along + left * left - right * right) / (2.0 * along);
  const double y = std::sqrt(std::fmax(0.0, left * left - x * x));
  const Vec2 way = (to - from) / length(to - from);
  return from + x * way + y * Vec2{-way.y, way.x};
}

/// Lays the net flat edge by edge from lengths alone; false when the folds are no tree over all faces.
bool lay_flat(const mesh::Surface& surface, const unfold::Patch& patch, const unfold::Folds& folds,
              std::vector<Flat>& flat) {
  const std::uint32_t n = patch.size();
  const auto side_length = [&](std::uint32_t side) {
    const auto v = surface.vertices(patch.face[side / 3]);
    return length(surface.point(v[(side % 3 + 1) % 3]) - surface.point(v[side % 3]));
  };
  std::vector<std::uint8_t> laid(n, 0);
  flat.assign(n, {});
  std::vector<std::uint32_t> open{0};
  laid[0] = 1;
  flat[0][0] = {0.0, 0.0};
  flat[0][1] = {side_length(0), 0.0};
  flat[0][2] = third_corner(flat[0][0], flat[0][1], side_length(0), side_length(2), side_length(1));
  std::size_t used = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::uint32_t f = open[i];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * f + k;
      if (folds[side] == 0) {
        continue;
      }
      ++used;
      const std::uint32_t twin = patch.twin[side];
      const std::uint32_t g = twin / 3;
      if (laid[g] != 0) {
        continue;
      }
      laid[g] = 1;
      const std::uint32_t j = twin % 3;
      Flat& t = flat[g];
      t[j] = flat[f][(k + 1) % 3];
      t[(j + 1) % 3] = flat[f][k];
      t[(j + 2) % 3] = third_corner(t[j], t[(j + 1) % 3], side_length(twin), side_length(3 * g + (j + 2) % 3),
                                    side_length(3 * g + (j + 1) % 3));
      open.push_back(g);
    }
  }
  return open.size() == n && used == 2 * (std::size_t{n} - 1);
}

/// The oracle: what a net is, said with other words than the search's. One tree over all faces, each
/// congruent to itself, and no pair of faces deeper in each other than the tolerance: every pair, by exact
/// rational arithmetic. Shares nothing with the search but the patch's twins.
bool is_net(const mesh::Surface& surface, const unfold::Patch& patch, const unfold::Folds& folds,
            double tolerance) {
  std::vector<Flat> flat;
  if (!lay_flat(surface, patch, folds, flat)) {
    return false;
  }
  // Lengths carry an error of about 1e-12 of the model along the chain of folds: far below the tolerance.
  const Exact allowed(1.01 * tolerance);
  std::vector<ExactTriangle> triangles;
  std::vector<std::pair<Vec2, Vec2>> boxes;
  for (const Flat& t : flat) {
    triangles.push_back(exact(t));
    boxes.push_back(
        {{std::fmin(t[0].x, std::fmin(t[1].x, t[2].x)), std::fmin(t[0].y, std::fmin(t[1].y, t[2].y))},
         {std::fmax(t[0].x, std::fmax(t[1].x, t[2].x)), std::fmax(t[0].y, std::fmax(t[1].y, t[2].y))}});
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      // Boxes of doubles that have no point in common are apart exactly.
      if (boxes[i].second.x < boxes[j].first.x || boxes[j].second.x < boxes[i].first.x ||
          boxes[i].second.y < boxes[j].first.y || boxes[j].second.y < boxes[i].first.y) {
        continue;
      }
      if (!separated(triangles[i], triangles[j], allowed) &&
          !separated(triangles[j], triangles[i], allowed)) {
        return false;
      }
    }
  }
  return true;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Searches a net with seeds 1 .. runs.seeds, panels loose, as long as the program does, and
/// adds the runs to the row.
void run(const mesh::Surface& surface, const Runs& runs, Row& row) {
  prepare::Panels panels;
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    panels.panel.push_back(PanelId(f.value()));
    faces.push_back(f);
  }
  for (int seed = 1; seed <= runs.seeds; ++seed) {
    const double start = cpu_seconds();
    const unfold::Patch patch = unfold::make_patch(surface, panels, faces);
    Random random(static_cast<std::uint64_t>(seed));
    const double tolerance = unfold::search_tolerance * patch.extent;
    const unfold::NetFound found =
        unfold::find_net(patch, unfold::start_tree(patch, random), tolerance, random.next(), Context());
    row.seconds.push_back(cpu_seconds() - start);
    row.trials.push_back(static_cast<double>(found.trials));
    if (found.overlaps > 0) {
      row.overlaps_left.push_back(found.overlaps);
      continue;
    }
    ++row.solved;
    if (runs.check) {
      ++row.checked;
      row.false_successes += is_net(surface, patch, found.folds, tolerance) ? 0U : 1U;
    }
  }
}

/// The value below which this share of the values lies; 0 when there are none.
double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

namespace fs = std::filesystem;

struct Settings {
  Runs runs;
  bool spiky = false;
  std::string json;
  std::string psb;
  std::vector<std::string> models;
};

void print(const Row& row) {
  std::printf("%-22s %6zu %6zu %6zu %10.5f %10.5f %10.4f %10.0f", row.name.c_str(), row.faces,
              row.seconds.size(), row.solved, quantile(row.seconds, 0.5), quantile(row.seconds, 0.9),
              quantile(row.seconds, 1.0), quantile(row.trials, 0.5));
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
    run(surface, settings.runs, row);
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
    run(body.surface, settings.runs, row);
    print(row);
    for (const std::size_t overlaps : row.overlaps_left) {
      std::printf("%-22s %zu overlaps are left\n", "", overlaps);
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
          run(surface, settings.runs, row);
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
        << ", \"median_trials\": " << quantile(row.trials, 0.5) << ", \"checked\": " << row.checked
        << ", \"false_successes\": " << row.false_successes << ", \"overlaps_of_unsolved\": [";
    for (std::size_t k = 0; k < row.overlaps_left.size(); ++k) {
      out << (k > 0 ? ", " : "") << row.overlaps_left[k];
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
                "90 % s", "max s", "trials");
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
