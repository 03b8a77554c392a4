// SPDX-License-Identifier: GPL-3.0-or-later
// What doesn't depend on how a model is put: turned, scaled, with its points and faces numbered otherwise or
// mirrored, it becomes as many nets, of the same lengths and area, with every face in one of them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using test::faults_of;
using unfold::EdgeUse;
using unfold::Nets;
using unfold::Options;

namespace {

const std::vector<std::string> no_faults;

/// Lengths and areas are sums of up to a thousand numbers near 1e2, each with the rounding of one turn of
/// space: 1e-12 of the sum; a thousand times that is still far below what a wrong edge would make.
constexpr double relative_error = 1e-9;

enum class Change { none, turned, larger, smaller, renumbered, mirrored };

Vec3 moved(Vec3 p, Change change) {
  switch (change) {
    case Change::turned: {
      // About two axes, by angles whose cosines are 0.6 and 5/13.
      const Vec3 q{0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z};
      return {(5.0 * q.x + 12.0 * q.z) / 13.0 + 7.0, q.y - 3.0, (5.0 * q.z - 12.0 * q.x) / 13.0};
    }
    case Change::larger:
      return 3.0 * p;
    case Change::smaller:
      return 0.25 * p;
    case Change::mirrored:
      return {-p.x, p.y, p.z};
    default:
      return p;
  }
}

double scale_of(Change change) {
  return change == Change::larger ? 3.0 : change == Change::smaller ? 0.25 : 1.0;
}

struct PanelledModel {
  mesh::Surface surface;
  prepare::Panels panels;
};

/// The model with its panels, put otherwise.
PanelledModel changed(const PanelledModel& model, Change change) {
  const mesh::Surface& s = model.surface;
  Random random(11);
  std::vector<std::uint32_t> number(s.vertex_count());
  std::iota(number.begin(), number.end(), 0U);
  std::vector<FaceId> order;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    order.push_back(f);
  }
  if (change == Change::renumbered) {
    unfold::shuffle(number, random);
    unfold::shuffle(order, random);
  }
  std::vector<Vec3> points(number.size());
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    points[number[v]] = moved(s.point(VertexId(v)), change);
  }
  std::vector<std::array<VertexId, 3>> faces;
  PanelledModel result;
  result.panels.panel = IdVector<FaceId, PanelId>(order.size());
  result.panels.faces.resize(model.panels.faces.size());
  for (const FaceId f : order) {
    auto [a, b, c] = s.vertices(f);
    if (change == Change::mirrored) {
      std::swap(b, c);
    }
    const FaceId now(faces.size());
    const PanelId panel = model.panels.panel[f];
    result.panels.panel[now] = panel;
    result.panels.faces[panel].push_back(now);
    faces.push_back({VertexId(number[a.value()]), VertexId(number[b.value()]), VertexId(number[c.value()])});
  }
  result.surface = mesh::Surface(std::move(points), std::move(faces));
  return result;
}

struct Figures {
  std::size_t pieces = 0;
  std::size_t faces = 0;  ///< that lie in a piece
  double inner_mm = 0.0;  ///< folds and cuts: every edge with two faces is one of them
  double border_mm = 0.0;
  double paper_mm2 = 0.0;  ///< area of the flat faces
};

Figures figures_of(const mesh::Surface& surface, const Nets& nets) {
  Figures figures;
  figures.pieces = nets.pieces.size();
  for (const unfold::Piece& piece : nets.pieces) {
    figures.faces += piece.faces.size();
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (unsigned k = 0; k < 3; ++k) {
      // As it lies on the paper; inner edges lie there twice.
      const double mm = length(nets.flat[f][(k + 1) % 3] - nets.flat[f][k]);
      const bool border = nets.use[surface.edge(mesh::corner(f, k))] == EdgeUse::border;
      (border ? figures.border_mm : figures.inner_mm) += border ? mm : 0.5 * mm;
    }
  }
  for (const auto& [a, b, c] : nets.flat) {
    figures.paper_mm2 += 0.5 * cross(b - a, c - a);
  }
  return figures;
}

PanelledModel sample(const std::string& file) {
  prepare::SimplifyOptions keep;
  keep.mode = prepare::Simplification::keep;
  const std::string path = std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/" + file;
  prepare::Prepared prepared = prepare::prepare(mesh::read(path, {}, {}), {}, keep, {{190.0, 277.0}}, {});
  return {std::move(prepared.model.surface), std::move(prepared.panels)};
}

}  // namespace

TEST_CASE("turning, scaling, renumbering and mirroring keep success, lengths and coverage",
          "[invariance][slow]") {
  for (const std::string file : {"whale.obj", "star.obj", "vase.ply", "fox_head.obj"}) {
    const PanelledModel model = sample(file);
    Options whole;  // no sheet, so that scale is no obstacle
    whole.tabs.wanted = false;
    whole.panel_cuts = unfold::PanelCuts::before_pieces;
    Figures plain;
    for (const Change change : {Change::none, Change::turned, Change::larger, Change::smaller,
                                Change::renumbered, Change::mirrored}) {
      INFO(file << ", change " << static_cast<int>(change));
      const PanelledModel other = changed(model, change);
      const Nets nets = unfold::unfold(other.surface, other.panels, test::one_part(other.surface), whole, {});
      CHECK(faults_of(other.surface, nets, whole) == no_faults);
      const Figures figures = figures_of(other.surface, nets);
      CHECK(figures.faces == model.surface.face_count());
      if (change == Change::none) {
        plain = figures;
        CHECK(plain.pieces == model.surface.component_count());
        continue;
      }
      const double scale = scale_of(change);
      CHECK(figures.pieces == plain.pieces);
      CHECK(figures.inner_mm == Approx(scale * plain.inner_mm).epsilon(relative_error));
      CHECK(figures.border_mm == Approx(scale * plain.border_mm).epsilon(relative_error));
      CHECK(figures.paper_mm2 == Approx(scale * scale * plain.paper_mm2).epsilon(relative_error));
    }
  }
}

TEST_CASE("on paper a model put otherwise becomes nearly as many pieces, with nearly as many tabs",
          "[invariance][slow]") {
  // The search draws other random numbers for other faces, so pieces may differ by one in five or one, and
  // seam without a tab by a tenth of all seam.
  for (const std::string file : {"whale.obj"}) {
    const PanelledModel model = sample(file);
    Options options;
    options.sheet = unfold::Sheet{190.0, 277.0};
    options.pieces = unfold::rules_of(unfold::PieceMode::parts);
    const auto seam_mm = [](const mesh::Surface& surface, const Nets& nets, bool only_bare) {
      double sum = 0.0;
      for (const unfold::Join& join : nets.joins) {
        sum += only_bare && join.tab.valid() ? 0.0 : surface.length(join.edge);
      }
      return sum;
    };
    std::size_t pieces = 0;
    double without_tab = 0.0;
    for (const Change change : {Change::none, Change::turned, Change::renumbered, Change::mirrored}) {
      INFO(file << ", change " << static_cast<int>(change));
      const PanelledModel other = changed(model, change);
      const Nets nets =
          unfold::unfold(other.surface, other.panels, test::one_part(other.surface), options, {});
      CHECK(faults_of(other.surface, nets, options) == no_faults);
      if (change == Change::none) {
        pieces = nets.pieces.size();
        without_tab = seam_mm(other.surface, nets, true);
        continue;
      }
      const std::size_t more = std::max(pieces, nets.pieces.size());
      CHECK(more - std::min(pieces, nets.pieces.size()) <= std::max<std::size_t>(2, more / 5));
      CHECK(std::abs(seam_mm(other.surface, nets, true) - without_tab) <=
            seam_mm(other.surface, nets, false) / 10.0);
    }
  }
}
