// SPDX-License-Identifier: GPL-3.0-or-later
// Nets end where materials meet, on every body that has several.
#include <cmath>
#include <cstdint>
#include <string>

#include <catch2/catch.hpp>

#include "job/job.hpp"
#include "job/unfold_options.hpp"
#include "mesh/mesh.hpp"

using namespace ridgecraft;

namespace {

constexpr int sides = 8;

/// A vase of walls that go round, at a place along x; its half behind the plane y = 0 is of another material
/// where that is wanted.
std::string vase(int number, bool two_materials) {
  constexpr double radius[] = {12.0, 20.0, 26.0, 18.0, 15.0};
  std::string text = "o vase" + std::to_string(number) + "\n";
  for (int ring = 0; ring < 5; ++ring) {
    for (int i = 0; i < sides; ++i) {
      const double turn = 6.283185307179586 * i / sides;
      text += "v " + std::to_string(100.0 * number + radius[ring] * std::cos(turn)) + " " +
              std::to_string(radius[ring] * std::sin(turn)) + " " + std::to_string(20.0 * ring) + "\n";
    }
  }
  const auto at = [&](int ring, int i) {
    return " " + std::to_string(1 + 5 * sides * number + sides * ring + i % sides);
  };
  for (int i = 0; i < sides; ++i) {
    text += two_materials && i >= sides / 2 ? "usemtl dark\n" : "usemtl light\n";
    for (int ring = 0; ring < 4; ++ring) {
      text += "f" + at(ring, i) + at(ring, i + 1) + at(ring + 1, i + 1) + at(ring + 1, i) + "\n";
    }
  }
  text += "usemtl light\nf";
  for (int i = 0; i < sides; ++i) {
    text += at(4, i);
  }
  text += "\nf";
  for (int i = sides; i-- > 0;) {
    text += at(0, i);
  }
  return text + "\n";
}

mesh::Model model_of(const std::string& text) {
  return mesh::read(mesh::ModelFile{text, "vase.obj", "vase", {}}, {}, {});
}

/// Length of the folds over which materials meet, mm.
double folded_over_borders(const std::string& text, double weight, std::uint64_t seed = 1) {
  job::Options options;
  options.simplify.mode = prepare::Simplification::keep;
  options.pieces.weights.borders = weight;
  options.pieces.weights.mirror = 0.0;  // images without borders would draw the other way
  Context context;
  context.seed = seed;
  const job::Result made = job::run(model_of(text), options, context);
  const mesh::Model& model = made.prepared.model;
  double folded = 0.0;
  for (const EdgeId e : ids<EdgeId>(model.surface.edge_count())) {
    const auto [c, d] = model.surface.sides(e);
    if (made.nets.use[e] == unfold::EdgeUse::fold &&
        model.material[mesh::face_of(c)] != model.material[mesh::face_of(d)]) {
      folded += model.surface.length(e);
    }
  }
  return folded;
}

}  // namespace

TEST_CASE("faces are told apart by object and material", "[job][labels]") {
  CHECK(job::author_labels(model_of(vase(0, false))).empty());
  const mesh::Model model = model_of(vase(0, true) + vase(1, true));
  const auto labels = job::author_labels(model);
  REQUIRE(labels.size() == model.surface.face_count());
  for (const FaceId f : ids<FaceId>(labels.size())) {
    for (const FaceId g : ids<FaceId>(labels.size())) {
      CHECK((labels[f] == labels[g]) ==
            (model.object[f] == model.object[g] && model.material[f] == model.material[g]));
    }
  }
}

TEST_CASE("folds where materials meet become cuts where they are dear", "[job][labels]") {
  const std::string text = vase(0, true);
  double free = 0.0;
  double dear = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    free += folded_over_borders(text, 0.0, seed);
    dear += folded_over_borders(text, 10.0, seed);
  }
  CHECK(free > 200.0);
  CHECK(dear < 0.5 * free);
}

TEST_CASE("a body of two materials doesn't get the nets of its twin of one", "[job][labels][slow]") {
  const std::string text = vase(0, false) + vase(1, true);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const double free = folded_over_borders(text, 0.0, seed);
    CHECK(free > 50.0);
    CHECK(folded_over_borders(text, 10.0, seed) < 0.5 * free);
  }
}
