// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/relations/relations.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "verify/file/json_text.hpp"

namespace ridgecraft::verify {
namespace {

void relate_faces(const File& file, Relations& relations) {
  const Index faces = file.faces.faces();
  relations.uses.assign(file.model.faces.faces(), 0);
  relations.net_face.assign(file.model.faces.faces(), none);
  relations.corners_match.assign(faces, false);
  for (Index f = 0; f < faces; ++f) {
    const Index m = file.face_model[f];
    relations.corners_match[f] = file.faces.size(f) == file.model.faces.size(m);
    ++relations.uses[m];
    relations.net_face[m] = relations.uses[m] == 1 && relations.corners_match[f] ? f : none;
  }
}

void sort_sides_by_edge(const File& file, Relations& relations) {
  relations.edge_first.assign(file.edges.size() + 1, 0);
  for (const Index edge : file.side_edge) {
    ++relations.edge_first[edge + 1];
  }
  for (std::size_t e = 0; e < file.edges.size(); ++e) {
    relations.edge_first[e + 1] += relations.edge_first[e];
  }
  relations.edge_sides.resize(file.side_edge.size());
  std::vector<Index> at(relations.edge_first.begin(), relations.edge_first.end() - 1);
  for (Index s = 0; s < file.faces.sides(); ++s) {
    relations.edge_sides[at[file.side_edge[s]]++] = s;
  }
}

EdgeFlaw flaw_of(const File& file, const Edge& edge, std::span<const Index> sides) {
  const bool fold = edge.assignment != Assignment::cut;
  if (sides.size() > 2) {
    return EdgeFlaw::many_faces;
  }
  if (sides.size() == 1) {
    return fold ? EdgeFlaw::fold_with_one_face : EdgeFlaw::sound;
  }
  if (file.faces.tail(sides[0]) == file.faces.tail(sides[1])) {
    return EdgeFlaw::same_direction;
  }
  if (!fold) {
    return EdgeFlaw::cut_with_two_faces;
  }
  const Index a = file.face_piece[file.faces.face(sides[0])];
  const Index b = file.face_piece[file.faces.face(sides[1])];
  return a == b ? EdgeFlaw::sound : EdgeFlaw::fold_between_pieces;
}

void relate_folds(const File& file, Relations& relations) {
  relations.fold_twin.assign(file.faces.sides(), none);
  for (Index e = 0; e < file.edges.size(); ++e) {
    const std::span<const Index> sides = relations.sides_of(e);
    relations.flaw.push_back(flaw_of(file, file.edges[e], sides));
    if (relations.flaw.back() == EdgeFlaw::sound && sides.size() == 2) {
      relations.fold_twin[sides[0]] = sides[1];
      relations.fold_twin[sides[1]] = sides[0];
    }
  }
}

/// Newell's sum gives area and mean normal of a polygon that isn't quite plane.
void measure_model(const Model& model, Relations& relations) {
  for (Index f = 0; f < model.faces.faces(); ++f) {
    const std::span<const Index> corners = model.faces.vertices(f);
    const Vec3 origin = model.points[corners[0]];
    Vec3 sum;
    for (std::size_t k = 2; k < corners.size(); ++k) {
      sum += cross(model.points[corners[k - 1]] - origin, model.points[corners[k]] - origin);
    }
    relations.area.push_back(0.5 * length(sum));
    relations.normal.push_back(normalized(sum));
  }
}

}  // namespace

Index target_of_slit(const File& file, const Relations& relations, Index tab) {
  const Tab& own = file.tabs[tab];
  if (!own.slit || own.numbers.empty()) {
    return none;
  }
  for (const Join& join : file.joins) {
    if (join.number != own.numbers.front()) {
      continue;
    }
    for (const std::size_t k : {0U, 1U}) {
      const auto sides = relations.sides_of(join.edges[1 - k]);
      if (join.edges[k] == own.edge && !sides.empty()) {
        return sides.front();
      }
    }
  }
  return none;
}

Relations relate(const File& file) {
  Relations relations;
  relate_faces(file, relations);
  sort_sides_by_edge(file, relations);
  relate_folds(file, relations);
  measure_model(file.model, relations);
  return relations;
}

std::string piece_name(const File& file, Index piece) {
  return fmt::format("piece {}", quote(file.pieces[piece].name));
}

std::string face_name(const File& file, Index face) {
  return fmt::format("face {} ({})", face, piece_name(file, file.face_piece[face]));
}

std::string edge_name(const File& file, const Relations& relations, Index edge) {
  return fmt::format("edge {} of {}", edge,
                     face_name(file, file.faces.face(relations.sides_of(edge).front())));
}

std::string join_name(const File& file, Index join) {
  return fmt::format("join {} (number {})", join, file.joins[join].number);
}

std::string tab_name(const File& file, Index tab) {
  constexpr std::size_t most = 4;
  const std::vector<std::int64_t>& numbers = file.tabs[tab].numbers;
  return fmt::format(
      "tab {} (number{} {}{})", tab, numbers.size() > 1 ? "s" : "",
      fmt::join(numbers.begin(),
                numbers.begin() + static_cast<std::ptrdiff_t>(std::min(most, numbers.size())), ", "),
      numbers.size() > most ? ", ..." : "");
}

}  // namespace ridgecraft::verify
