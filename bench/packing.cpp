// SPDX-License-Identifier: GPL-3.0-or-later
// The heart of the packer beside the best that is published: pieces of the classic sets on a strip that is to
// be as short as possible, touching each other, in the turns that each set allows.
//
//   bench_packing FOLDER [SECONDS...] [--seed N] [--set NAME]
//
// FOLDER has the sets as JSON and table.csv with the lengths that others reach (../shared/peers/nesting). For
// each set, after so many seconds of one thread (1, 10, 60): length, density, and its share of the published
// median.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/partition_2.h>
#include <nlohmann/json.hpp>

#include "base/elementary.hpp"
#include "base/polygon.hpp"
#include "export/packing/packing_exact.hpp"

using namespace ridgecraft;
using namespace ridgecraft::paper;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Partition_traits_2<Kernel>;

/// Without corners that lie in a line or twice, which partitions can't do with.
std::vector<Vec2> cleaned(std::vector<Vec2> outline) {
  for (bool changed = true; changed && outline.size() > 3;) {
    changed = false;
    for (std::size_t i = 0; i < outline.size() && outline.size() > 3; ++i) {
      const Vec2 before = outline[(i + outline.size() - 1) % outline.size()];
      const Vec2 after = outline[(i + 1) % outline.size()];
      if (length(outline[i] - before) < 1e-9 ||
          std::abs(cross(outline[i] - before, after - outline[i])) < 1e-12) {
        outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
      }
    }
  }
  if (doubled_area(outline) < 0.0) {
    std::reverse(outline.begin(), outline.end());
  }
  return outline;
}

std::vector<std::vector<Vec2>> convex_parts(const std::vector<Vec2>& outline) {
  Traits::Polygon_2 polygon;
  for (const Vec2 p : outline) {
    polygon.push_back(Kernel::Point_2(p.x, p.y));
  }
  std::vector<Traits::Polygon_2> parts;
  CGAL::optimal_convex_partition_2(polygon.vertices_begin(), polygon.vertices_end(),
                                   std::back_inserter(parts));
  std::vector<std::vector<Vec2>> convex;
  for (const Traits::Polygon_2& part : parts) {
    std::vector<Vec2>& points = convex.emplace_back();
    for (const auto& p : part) {
      points.push_back({p.x(), p.y()});
    }
  }
  return convex;
}

struct Strip {
  PackingTask task;
  std::vector<std::vector<Turn>> turns;
  double height = 0.0;
  double area = 0.0;
};

Strip read(const std::filesystem::path& file) {
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in);
  Strip strip;
  // Lengths in shares of the height times 200, so that tolerances in mm mean what they do on paper.
  const double unit = 200.0 / json.at("strip_height").get<double>();
  strip.height = 200.0;
  for (const auto& item : json.at("items")) {
    std::vector<Vec2> outline;
    for (const auto& p : item.at("shape").at("data")) {
      outline.push_back(unit * Vec2{p[0].get<double>(), p[1].get<double>()});
    }
    const PackingShape shape = packing_shape(convex_parts(cleaned(outline)));
    std::vector<Turn> turns;
    for (const auto& degrees : item.at("allowed_orientations")) {
      const double angle = degrees.get<double>() * std::numbers::pi / 180.0;
      turns.push_back({std::round(1e12 * elementary::cos(angle)) / 1e12,
                       std::round(1e12 * elementary::sin(angle)) / 1e12});
    }
    for (int i = 0; i < item.at("demand").get<int>(); ++i) {
      strip.task.shapes.push_back(shape);
      strip.task.group.push_back(0);
      strip.turns.push_back(turns);
      strip.area += shape.area;
    }
  }
  strip.task.area = {strip.area / strip.height * 2.0, strip.height};
  return strip;
}

/// Seconds of this thread.
double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The shortest length that is found after each of these times.
std::vector<double> pack_strip(const Strip& strip, const std::vector<double>& times, std::uint64_t seed) {
  Random random(seed);
  const Context context;
  const double begin = seconds();
  ExactSeparation separation(strip.task, strip.turns, random, context);
  const auto count = static_cast<std::uint32_t>(strip.task.shapes.size());
  double length = strip.area / strip.height / 0.6;
  std::vector<ExactPlace> places(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    places[i].turn = random.below(static_cast<std::uint32_t>(strip.turns[i].size()));
    places[i].at = {random.unit() * length, random.unit() * strip.height};
  }
  std::vector<ExactPlace> best;
  double best_length = INFINITY;
  double least = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) {
    double narrowest = INFINITY;
    for (std::uint32_t t = 0; t < separation.turn_count(i); ++t) {
      narrowest = std::min(narrowest, separation.size(i, t).x);
    }
    least = std::max(least, narrowest);
  }
  const std::uint64_t slice = 300'000;
  const std::uint64_t patience = 40'000ULL * count * 10;
  double shrink = 0.03;
  std::vector<double> result;
  std::uint64_t begun = separation.work();
  while (result.size() < times.size()) {
    const bool apart = separation.run(places, 1, {length, strip.height}, slice);
    if (seconds() - begin > times[result.size()]) {
      result.push_back(best_length);
    }
    if (apart) {
      double used = 0.0;
      for (std::uint32_t i = 0; i < count; ++i) {
        used = std::max(used, places[i].at.x + separation.size(i, places[i].turn).x);
      }
      best_length = std::min(best_length, used);
      best = places;
      length = std::max(least, used * (1.0 - shrink));
    } else if (separation.work() - begun > patience && !best.empty()) {
      // Another way: two shapes of the best change places.
      shrink = std::max(0.001, 0.5 * shrink);
      length = std::max(least, best_length * (1.0 - shrink));
      places = best;
      const std::uint32_t a = random.below(count);
      const std::uint32_t b = random.below(count);
      std::swap(places[a].at, places[b].at);
      separation.forget();
    } else {
      continue;
    }
    begun = separation.work();
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder;
  std::vector<double> times;
  std::uint64_t seed = 1;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seed" && i + 1 < argc) {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--set" && i + 1 < argc) {
      only = argv[++i];
    } else if (folder.empty()) {
      folder = word;
    } else {
      times.push_back(std::atof(argv[i]));
    }
  }
  if (folder.empty()) {
    std::puts("usage: bench_packing FOLDER [SECONDS...] [--seed N] [--set NAME]");
    return 2;
  }
  if (times.empty()) {
    times = {1.0, 10.0, 60.0};
  }
  std::ifstream table(folder / "table.csv");
  std::string line;
  std::getline(table, line);
  std::vector<double> sums(times.size());
  int sets = 0;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; std::getline(fields, field, ',');) {
      row.push_back(field);
    }
    if (!only.empty() && row[0] != only) {
      continue;
    }
    const Strip strip = read(folder / (row[0] + ".json"));
    const double published = std::atof(row[6].c_str()) / 100.0;
    std::printf("%-10s %3zu", row[0].c_str(), strip.task.shapes.size());
    const std::vector<double> lengths = pack_strip(strip, times, seed);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double density = strip.area / (lengths[i] * strip.height);
      std::printf("   %5.1f s %.4f = %.3f", times[i], density, density / published);
      sums[i] += density / published;
    }
    std::printf("   (published %.4f)\n", published);
    std::fflush(stdout);
    ++sets;
  }
  std::printf("mean over %d sets:", sets);
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::printf("   %5.1f s %.3f", times[i], sums[i] / sets);
  }
  std::puts("");
  return 0;
}
