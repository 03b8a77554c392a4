// SPDX-License-Identifier: GPL-3.0-or-later
// Every weight that users can change changes the nets, and in the way that its name says.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/energy/tree_shape.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/pieces/symmetry.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Nets;
using unfold::Patch;
using unfold::Weights;

namespace {

/// A model with what the terms are about: its faces and parts.
struct Model {
  mesh::Surface surface;
  prepare::Panels panels;
  IdVector<FaceId, PartId> part;
  IdVector<FaceId, std::uint32_t> labels;  // of two colours
  double piece = 350.0;                    ///< what each piece costs
};

/// A lumpy ball, even about the plane y = 0, in parts: columns from pole to pole.
Model ball(double mm, int columns, std::uint32_t waves) {
  const mesh::Surface round = test::sphere(12, 8);
  std::vector<Vec3> points;
  for (const Vec3 p : round.points()) {
    const double wave = std::sin(waves * p.x + 1.0) * std::cos(2.0 * p.y) + 0.5 * std::sin(3.0 * p.z + p.x);
    points.push_back(mm * (1.0 + 0.25 * wave) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(round.face_count())) {
    faces.push_back(round.vertices(f));
  }
  Model model{mesh::Surface(std::move(points), std::move(faces)), {}, {}, {}};
  model.panels = test::no_panels(model.surface);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const auto [a, b, c] = round.vertices(f);
    const Vec3 middle = round.point(a) + round.point(b) + round.point(c);
    const double turn = std::atan2(middle.y, middle.x) / 6.283185307179586 + 0.5;
    model.part.push_back(
        PartId(static_cast<std::uint32_t>(turn * columns) % static_cast<std::uint32_t>(columns)));
    model.labels.push_back(middle.z > 0.5 ? 1 : 0);
  }
  return model;
}

/// A vase of walls that go round, pointed at both ends: flat ones would close circles of folds.
Model vase() {
  Model model{test::scaled(test::revolve({{0, -0.3}, {1, 0}, {1.3, 1}, {1, 2}, {1, 3}, {0, 3.3}}, 9), 22.0),
              {},
              {},
              {}};
  model.panels = test::flat_panels(model.surface);
  model.part = test::one_part(model.surface);
  model.labels = IdVector<FaceId, std::uint32_t>(model.surface.face_count(), 0);
  return model;
}

const std::vector<Model>& models() {
  static const std::vector<Model> all = [] {
    std::vector<Model> made;
    made.push_back(ball(45.0, 3, 2));
    made.push_back(ball(30.0, 12, 3));
    made.push_back(vase());
    // Where a piece costs less than a further part in another one, only small ones join others.
    made.push_back(ball(12.0, 6, 2));
    made.back().piece = 100.0;
    return made;
  }();
  return all;
}

Nets nets_of(const Model& model, std::string_view term, double factor) {
  unfold::Options options = test::on_sheet(190.0, 277.0);
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  options.pieces.max_panels = 0;  // a limit may keep pieces small that a weight makes larger
  options.pieces.trials_per_face = 250.0;
  options.pieces.weights.pieces = model.piece;
  if (term == "borders") {
    options.labels = model.labels;
  }
  *unfold::weight_named(options.pieces.weights, term) *= factor;
  return unfold::unfold(model.surface, model.panels, model.part, options, Context());
}

/// How much of what a term counts these nets have.
double measure(const Model& model, const Nets& nets, std::string_view term) {
  if (term == "bare") {
    double bare = 0.0;
    for (const unfold::Join& join : nets.joins) {
      bare += join.tab.valid() ? 0.0 : model.surface.length(join.edge);
    }
    return bare;
  }
  Weights weights;
  for (const std::string_view other : unfold::term_names()) {
    *unfold::weight_named(weights, other) = other == term ? 1.0 : 0.0;
  }
  Patch patch = test::whole_patch(model.surface, model.panels, model.labels.items());
  Folds folds(patch.twin.size(), 0);
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    const EdgeId edge = model.surface.edge(mesh::corner(patch.face[side / 3], side % 3));
    folds[side] = nets.use[edge] == unfold::EdgeUse::fold ? 1 : 0;
  }
  // What lies across a strip that stays one is no neck.
  const unfold::Symmetry symmetry = unfold::find_symmetry(model.surface, Weights(), Context());
  unfold::Options options;
  options.labels = model.labels;
  const unfold::EdgeConstraints strips =
      unfold::with_bands_kept({model.surface, model.panels, model.part, options}, symmetry);
  for (std::uint32_t side = 0; side < folds.size() && !strips.empty(); ++side) {
    const EdgeId edge = model.surface.edge(mesh::corner(patch.face[side / 3], side % 3));
    patch.frozen[side] = strips[edge] == unfold::EdgeConstraint::band && folds[side] != 0
                             ? unfold::frozen_in_band
                             : patch.frozen[side];
  }
  const std::vector<unfold::SideImages> images = images_of_sides(model.surface, patch, symmetry.images);
  unfold::CutFacts facts;
  facts.images = images;
  unfold::CutCosts cuts(patch, facts, weights);
  cuts.set_tree(folds);
  double sum = cuts.total();
  for (const std::string_view counted : {"seam", "open", "borders", "slits"}) {
    *unfold::weight_named(weights, counted) = 0.0;
  }
  for (const unfold::Piece& piece : nets.pieces) {
    std::vector<std::uint32_t> faces;
    for (const FaceId f : piece.faces) {
      faces.push_back(f.value());
    }
    const Patch own = sub_patch(patch, faces);
    std::vector<std::uint32_t> part;
    for (const std::uint32_t f : faces) {
      part.push_back(model.part[FaceId(f)].value());
    }
    unfold::Forest forest(own);
    forest.set_folds(sub_folds(patch, folds, faces));
    const unfold::Room anywhere;
    sum += unfold::TreeShape(own, part, anywhere, weights).measure(forest, forest.folds(), 0, nullptr).cost;
  }
  return sum;
}

/// Share of the seam of both that only one of them has.
double difference(const Model& model, const Nets& a, const Nets& b) {
  double all = 0.0;
  double differing = 0.0;
  for (const EdgeId e : ids<EdgeId>(model.surface.edge_count())) {
    const bool in_a = a.use[e] == unfold::EdgeUse::cut;
    const bool in_b = b.use[e] == unfold::EdgeUse::cut;
    all += in_a || in_b ? model.surface.length(e) : 0.0;
    differing += in_a != in_b ? model.surface.length(e) : 0.0;
  }
  return differing / all;
}

}  // namespace

TEST_CASE("each weight changes the nets, and what weighs more is less", "[energy][slow]") {
  for (const std::string_view term : unfold::term_names()) {
    double light = 0.0;
    double heavy = 0.0;
    double most_different = 0.0;
    for (const Model& model : models()) {
      const Nets little = nets_of(model, term, 0.05);
      const Nets much = nets_of(model, term, 20.0);
      light += measure(model, little, term);
      heavy += measure(model, much, term);
      most_different = std::max(most_different, difference(model, little, much));
    }
    CAPTURE(term, light, heavy, most_different);
    CHECK(heavy < light - 0.02 * std::abs(light));
    CHECK(most_different > 0.1);
  }
}
