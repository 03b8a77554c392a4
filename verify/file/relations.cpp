// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "verify/file/schema.hpp"
#include "verify/file/tolerance.hpp"

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

/// Whether each crease moves one further plate, and none that is nearer to the middle than one before.
bool grows_from(Index middle, std::span<const Crease* const> order) {
  std::map<Index, Index> depth{{middle, 0}};
  Index deepest = 0;
  for (const Crease* crease : order) {
    const auto first = depth.find(crease->first);
    const auto second = depth.find(crease->second);
    if ((first == depth.end()) == (second == depth.end())) {
      return false;
    }
    const Index now = (first != depth.end() ? first : second)->second + 1;
    if (now < deepest) {
      return false;
    }
    deepest = now;
    depth[first != depth.end() ? crease->second : crease->first] = now;
  }
  return true;
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

ModelFold model_fold(const File& file, const Relations& relations, Index model_side) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  const Model& model = file.model;
  const Index a = model.faces.face(model_side);
  const Index b = model.faces.face(model.twin[model_side]);
  const Vec3 along = model.points[model.faces.head(model_side)] - model.points[model.faces.tail(model_side)];
  const double sine = dot(cross(relations.normal[a], relations.normal[b]), normalized(along));
  ModelFold fold;
  fold.angle_deg = -elementary::atan2(sine, dot(relations.normal[a], relations.normal[b])) * degrees;
  // Faces without area have no normal: then every angle is within the tolerance.
  const double area = std::min(relations.area[a], relations.area[b]);
  fold.tolerance_deg =
      area > 0.0 ? angle_tolerance_deg + degrees * slender_fraction * model.size * length(along) / area
                 : std::numeric_limits<double>::infinity();
  return fold;
}

Plates find_plates(const File& file, const Relations& relations, double flat_deg) {
  DisjointSets sets(file.faces.faces());
  for (Index side = 0; side < file.faces.sides(); ++side) {
    const Index twin = relations.fold_twin[side];
    if (twin != none && std::abs(file.edges[file.side_edge[side]].angle_deg) < flat_deg) {
      sets.join(file.faces.face(side), file.faces.face(twin));
    }
  }
  Plates plates;
  std::vector<Index> number(file.faces.faces(), none);
  for (Index face = 0; face < file.faces.faces(); ++face) {
    Index& of_set = number[sets.find(face)];
    of_set = of_set == none ? plates.count++ : of_set;
    plates.plate.push_back(of_set);
  }
  return plates;
}

std::vector<std::vector<Crease>> find_creases(const File& file, const Relations& relations,
                                              const Plates& plates) {
  std::map<std::pair<Index, Index>, Crease> by_plates;
  for (Index side = 0; side < file.faces.sides(); ++side) {
    const Index twin = relations.fold_twin[side];
    if (twin == none || twin < side) {
      continue;
    }
    const auto [low, high] =
        std::minmax(plates.plate[file.faces.face(side)], plates.plate[file.faces.face(twin)]);
    if (low != high) {
      Crease& crease = by_plates[{low, high}];
      crease.first = low;
      crease.second = high;
      crease.edges.push_back(file.side_edge[side]);
    }
  }
  std::vector<std::vector<Crease>> creases(file.pieces.size());
  for (auto& [pair, crease] : by_plates) {
    creases[piece_of_edge(file, relations, crease.edges.front())].push_back(std::move(crease));
  }
  return creases;
}

bool goes_inwards(std::span<const Crease* const> order) {
  const std::vector<const Crease*> outwards(order.rbegin(), order.rend());
  return grows_from(outwards.front()->first, outwards) || grows_from(outwards.front()->second, outwards);
}

}  // namespace ridgecraft::verify
