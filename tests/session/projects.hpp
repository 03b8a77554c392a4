// SPDX-License-Identifier: GPL-3.0-or-later
// Projects to be edited, and what tests ask of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "export/export.hpp"
#include "job/edge_requests.hpp"
#include "mesh/mesh.hpp"
#include "session/session.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::session_test {

inline job::Result sample(const std::string& name, const job::Options& options = {}) {
  return job::run(mesh::read(std::string(RIDGECRAFT_SOURCE_DIR) + "/samples/" + name, {}, {}), options, {});
}

/// A cube that A4 holds as one cross; of several pieces where none may have all six faces.
inline job::Result cube(std::size_t most_faces_of_a_piece = 0) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::vector<std::uint32_t>> faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  job::Options options;
  options.size.largest_extent_mm = 50.0;
  options.pieces.max_panels = most_faces_of_a_piece;
  return job::run(mesh::repair(points, faces, {}, {}), options, {});
}

/// Everything that a maker gets but the guide.
inline std::string bytes_of(const job::Result& made) {
  std::string text = made.fold;
  for (const export_::Drawing& page : made.drawings) {
    text += export_::write_svg(page, {});
  }
  return text;
}

inline const mesh::Surface& surface_of(const session::Project& project) {
  return project.now.prepared.model.surface;
}

inline session::Edge name_of(const mesh::Surface& surface, EdgeId edge) {
  const CornerId side = surface.sides(edge)[0];
  return {surface.vertex(side), surface.vertex(mesh::next(side))};
}

/// Edges between two flat regions that are used so now.
inline std::vector<session::Edge> edges_used(const session::Project& project, unfold::EdgeUse use) {
  const mesh::Surface& surface = surface_of(project);
  const auto& panel = project.now.prepared.panels.panel;
  std::vector<session::Edge> found;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (project.now.nets.use[e] == use && d.valid() && panel[mesh::face_of(c)] != panel[mesh::face_of(d)]) {
      found.push_back(name_of(surface, e));
    }
  }
  return found;
}

inline session::Project done(const session::Project& project, const std::vector<session::Edit>& edits) {
  session::Answer answer = session::apply(project, edits, {});
  if (const auto* const refusal = std::get_if<session::Refusal>(&answer)) {
    FAIL("refused: " << english(refusal->why));
  }
  return std::get<session::Project>(std::move(answer));
}

/// What the steps in its FOLD file make of this paper.
inline session::Project saved(const session::Project& project, job::Result start) {
  const verify::File file = job::read_fold_file({"the saved project", project.now.fold});
  const verify::Setting* const edits = file.settings.find("edits");
  REQUIRE(edits != nullptr);
  session::Repeated repeated =
      session::repeat(std::move(start), session::steps_of(std::get<std::string>(*edits)), {});
  CHECK(repeated.left_out.empty());
  return std::move(repeated.project);
}
inline session::Project saved(const session::Project& project) {
  return saved(project, *project.start);
}

inline session::Refusal refused(const session::Project& project, const std::vector<session::Edit>& edits) {
  const session::Answer answer = session::apply(project, edits, {});
  REQUIRE(std::holds_alternative<session::Refusal>(answer));
  return std::get<session::Refusal>(answer);
}

}  // namespace ridgecraft::session_test
