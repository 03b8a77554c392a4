// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "support/benchmark_models.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {

TEST_CASE("Volume ratio of hulls") {
  const mesh::Surface l = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2);
  CHECK(segment::enclosed_volume(l) == Approx(3.0));
  const std::vector<std::uint32_t> whole(l.face_count(), 0);
  CHECK(segment::hull_volume_ratio(l, whole, 512, Context{}) == Approx(3.5 / 3.0).margin(0.02));
  std::vector<std::uint32_t> halves;
  for (const FaceId f : ids<FaceId>(l.face_count())) {
    double x = 0.0;
    for (const VertexId v : l.vertices(f)) {
      x += l.point(v).x / 3.0;
    }
    halves.push_back(x < 1.0 + 1e-9 ? 0 : 1);
  }
  CHECK(segment::hull_volume_ratio(l, halves, 512, Context{}) == Approx(1.0).margin(0.02));
}

TEST_CASE("The smallest ball holds all points and is held by few of them") {
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3> points;
    const std::uint32_t n = 1 + random.below(40);
    for (std::uint32_t i = 0; i < n; ++i) {
      points.push_back({random.unit(), random.unit() * (round % 3), random.unit() * (round % 2)});
    }
    const segment::Ball ball = segment::smallest_enclosing_ball(points);
    // Smallest: no ball with its centre a little to any side is smaller.
    for (int k = 0; k < 27; ++k) {
      const Vec3 moved = ball.center + 1e-4 * Vec3{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
      double radius = 0.0;
      for (const Vec3 p : points) {
        radius = std::max(radius, length(p - moved));
      }
      CHECK(radius >= ball.radius - 1e-11);
      if (k == 13) {
        CHECK(radius <= ball.radius + 1e-11);
      }
    }
  }
}

namespace {

using Labels = std::vector<std::uint32_t>;

/// `n` unit squares in a row, two triangles each: faces 2i and 2i + 1 are square i.
mesh::Surface strip(std::uint32_t n) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> faces;
  for (std::uint32_t i = 0; i <= n; ++i) {
    points.push_back({static_cast<double>(i), 0.0, 0.0});
    points.push_back({static_cast<double>(i), 1.0, 0.0});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t v = 2 * i;
    faces.push_back({VertexId(v), VertexId(v + 2), VertexId(v + 1)});
    faces.push_back({VertexId(v + 1), VertexId(v + 2), VertexId(v + 3)});
  }
  return {points, faces};
}

Labels squares(std::uint32_t n) {
  Labels polygon;
  for (std::uint32_t f = 0; f < 2 * n; ++f) {
    polygon.push_back(f / 2);
  }
  return polygon;
}

}  // namespace

TEST_CASE("Rand error of hand-counted labelings") {
  const std::vector<std::uint32_t> one{0, 0, 0, 0};
  const std::vector<std::uint32_t> two{0, 0, 1, 1};
  const std::vector<std::uint32_t> four{0, 1, 2, 3};
  const std::vector<std::uint32_t> renamed{7, 7, 3, 3};
  CHECK(segment::rand_error(two, renamed) == 0.0);
  CHECK(segment::rand_error(one, four) == Approx(1.0));
  CHECK(segment::rand_error(one, two) == Approx(4.0 / 6.0));
  CHECK(segment::rand_error(two, four) == Approx(2.0 / 6.0));
  CHECK(segment::rand_error(std::vector<std::uint32_t>{0, 1, 0, 1}, two) == Approx(4.0 / 6.0));
}

TEST_CASE("Hamming distance and consistency errors of hand-counted labelings") {
  const mesh::Surface s = strip(4);
  const Labels polygon = squares(4);
  const Labels halves{0, 0, 1, 1};
  const Labels one{5, 5, 5, 5};
  const Labels quarter{0, 1, 1, 1};
  const Labels crossed{0, 1, 0, 1};

  const auto same = segment::compare(s, polygon, halves, Labels{9, 9, 2, 2});
  CHECK(same.rand_error == 0.0);
  CHECK(same.hamming == 0.0);
  CHECK(same.global_consistency == 0.0);
  CHECK(same.local_consistency == 0.0);
  CHECK(same.cut_discrepancy == 0.0);

  // One part against two halves: a half is left over one way round, nothing the other; one refines the other.
  const auto refined = segment::compare(s, polygon, halves, one);
  CHECK(refined.hamming == Approx(0.25));
  CHECK(refined.global_consistency == Approx(0.0).margin(1e-12));
  CHECK(refined.local_consistency == Approx(0.0).margin(1e-12));
  CHECK_FALSE(refined.cut_discrepancy.has_value());

  // Halves AABB against ABBB: shares A/A 1, A/B 1, B/B 2 of 4.
  const auto moved = segment::compare(s, polygon, halves, quarter);
  CHECK(moved.hamming == Approx(0.5 * (1.0 / 4.0 + 1.0 / 4.0)));
  // Halves' shares outside quarter's parts: 1/2 + 1/2 + 0 + 0; quarter's outside halves': 0 + 2/3 + 1/3 +
  // 1/3.
  CHECK(moved.global_consistency == Approx(1.0 / 4.0));
  // Item by item the better one: 0 for the first, 1/2 for the second, 0 for the last two.
  CHECK(moved.local_consistency == Approx(0.5 / 4.0));

  const auto against = segment::compare(s, polygon, halves, crossed);
  CHECK(against.hamming == Approx(0.5));
  CHECK(against.global_consistency == Approx(0.5));
  CHECK(against.local_consistency == Approx(0.5));
}

TEST_CASE("Cut discrepancy of a moved cut") {
  const std::uint32_t n = 6;
  const mesh::Surface s = strip(n);
  const auto result = segment::compare(s, squares(n), Labels{0, 0, 1, 1, 1, 1}, Labels{0, 0, 0, 1, 1, 1});
  double radius = 0.0;
  for (std::uint32_t f = 0; f < 2 * n; ++f) {
    const double x = f / 2 + (f % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0);
    const double y = f % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
    radius += std::hypot(x - n / 2.0, y - 0.5) / (2.0 * n);
  }
  REQUIRE(result.cut_discrepancy.has_value());
  CHECK(*result.cut_discrepancy == Approx(1.0 / radius));
}

TEST_CASE("Disagreement is symmetric and blind to the names of parts") {
  const mesh::Surface s = test::sphere(12, 9);
  Labels polygon;
  for (std::uint32_t f = 0; f < s.face_count(); ++f) {
    polygon.push_back(f);
  }
  Random random(4);
  for (int round = 0; round < 30; ++round) {
    Labels a;
    Labels b;
    Labels fine;
    for (std::uint32_t f = 0; f < s.face_count(); ++f) {
      a.push_back(random.below(4));
      b.push_back(random.below(5));
      fine.push_back(4 * a.back() + random.below(3));
    }
    Labels renamed = a;
    for (std::uint32_t& label : renamed) {
      label = 100 - 7 * label;
    }
    const auto ab = segment::compare(s, polygon, a, b);
    const auto ba = segment::compare(s, polygon, b, renamed);
    CHECK(ab.rand_error == Approx(ba.rand_error));
    CHECK(ab.hamming == Approx(ba.hamming));
    CHECK(ab.global_consistency == Approx(ba.global_consistency));
    CHECK(ab.local_consistency == Approx(ba.local_consistency));
    CHECK(*ab.cut_discrepancy == Approx(*ba.cut_discrepancy));
    CHECK(ab.local_consistency <= ab.global_consistency + 1e-12);
    const auto refinement = segment::compare(s, polygon, a, fine);
    CHECK(refinement.global_consistency == Approx(0.0).margin(1e-12));
    CHECK(refinement.rand_error > 0.0);
  }
}

TEST_CASE("People agree with people as the benchmark's table says", "[slow]") {
  // Category Octopus, models 121, 123 ... 139; the table's row was computed by others with another program.
  const test::TemporaryFolder folder;
  std::vector<std::string> members;
  for (int m = 121; m < 140; m += 2) {
    members.push_back("off/" + std::to_string(m) + ".off");
    members.push_back("seg/" + std::to_string(m));
  }
  if (!test::unpack_benchmark(members, folder.path())) {
    return;
  }
  segment::Disagreement mean;
  double discrepancy = 0.0;
  for (int m = 121; m < 140; m += 2) {
    mesh::ReadOptions options;
    options.collapse_flat_faces = false;
    const mesh::Model model =
        mesh::read(folder.path() / "off" / (std::to_string(m) + ".off"), options, Context{});
    std::vector<Labels> people;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "seg" / std::to_string(m))) {
      people.push_back(test::read_labels(entry.path()));
    }
    const auto pairs = static_cast<double>(people.size() * (people.size() - 1) / 2);
    for (std::size_t i = 0; i < people.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto d = segment::compare(model.surface, model.polygon.items(), people[i], people[j]);
        mean.rand_error += d.rand_error / pairs / 10.0;
        mean.hamming += d.hamming / pairs / 10.0;
        mean.global_consistency += d.global_consistency / pairs / 10.0;
        mean.local_consistency += d.local_consistency / pairs / 10.0;
        discrepancy += d.cut_discrepancy.value() / pairs / 10.0;
      }
    }
  }
  CHECK(mean.rand_error == Approx(0.0252).margin(0.00006));
  CHECK(mean.global_consistency == Approx(0.0309).margin(0.00006));
  CHECK(mean.local_consistency == Approx(0.0213).margin(0.00006));
  CHECK(mean.hamming == Approx(0.0434).margin(0.00006));
  CHECK(discrepancy == Approx(0.0685).margin(0.00006));
}

TEST_CASE("People agree with people in every category as often as the benchmark's table says", "[slow]") {
  const test::TemporaryFolder folder;
  if (!test::unpack_benchmark({"seg"}, folder.path())) {
    return;
  }
  // Rows after the heading: category, models, segmentations, mean_parts, rand_error, ...; the last one is the
  // mean. Categories are in the order of their models, 20 numbers each, of which 261 to 280 aren't there.
  std::ifstream table(std::filesystem::path(RIDGECRAFT_SHARED_DIR) / "models" / "psb" / "people.csv");
  std::string row;
  std::getline(table, row);
  const std::vector<std::string> categories{
      "Human", "Cup",  "Glasses", "Airplane", "Ant",       "Chair", "Octopus", "Table",   "Teddy", "Hand",
      "Plier", "Fish", "Bird",    "",         "Armadillo", "Bust",  "Mech",    "Bearing", "Vase",  "FourLeg"};
  for (int first = 1; first < 400; first += 20) {
    const std::string& category = categories.at(static_cast<std::size_t>(first / 20));
    if (category.empty()) {
      continue;
    }
    REQUIRE(std::getline(table, row));
    CAPTURE(row);
    std::istringstream columns(row);
    std::vector<std::string> column(5);
    for (std::string& text : column) {
      std::getline(columns, text, ',');
    }
    double rand_error = 0.0;
    double parts = 0.0;
    int segmentations = 0;
    int models = 0;
    for (int m = first; m < first + 20; m += 2) {
      std::vector<Labels> people;
      double parts_of_model = 0.0;
      for (const auto& entry :
           std::filesystem::directory_iterator(folder.path() / "seg" / std::to_string(m))) {
        people.push_back(test::read_labels(entry.path()));
        parts_of_model += static_cast<double>(std::set(people.back().begin(), people.back().end()).size());
        ++segmentations;
      }
      double sum = 0.0;
      for (std::size_t i = 0; i < people.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          sum += segment::rand_error(people[i], people[j]);
        }
      }
      parts += parts_of_model / static_cast<double>(people.size());
      rand_error += sum / static_cast<double>(people.size() * (people.size() - 1) / 2);
      ++models;
    }
    CHECK(category == column[0]);
    CHECK(models == std::stoi(column[1]));
    CHECK(segmentations == std::stoi(column[2]));
    CHECK(parts / models == Approx(std::stod(column[3])).margin(0.00006));
    CHECK(rand_error / models == Approx(std::stod(column[4])).margin(0.00006));
  }
}

}  // namespace ridgecraft
