// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 5, the nets by themselves: edges have the faces that their assignment says, and each piece is one
// disc, with as many round holes as it states.
#include <cstdint>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"

namespace ridgecraft::verify {
namespace {

const char* words_for(EdgeFlaw flaw) {
  switch (flaw) {
    case EdgeFlaw::many_faces:
      return "has more than two faces";
    case EdgeFlaw::same_direction:
      return "has two faces that run along it in the same direction";
    case EdgeFlaw::cut_with_two_faces:
      return "is a cut (\"B\"), but has two faces";
    case EdgeFlaw::fold_with_one_face:
      return "is a fold, but has one face";
    case EdgeFlaw::fold_between_pieces:
      return "is a fold between two pieces";
    case EdgeFlaw::sound:
      break;
  }
  return "is sound";
}

void check_edges(const Case& given, Findings& findings) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  for (Index e = 0; e < file.edges.size(); ++e) {
    if (relations.flaw[e] != EdgeFlaw::sound) {
      ++findings.figures().bad_joins;
      findings.add(Promise::joins, {{"edge", e}}, [&] {
        return fmt::format("{} {}", edge_name(file, relations, e), words_for(relations.flaw[e]));
      });
    }
    if (file.edges[e].assignment == Assignment::cut && file.edges[e].angle_deg != 0.0) {
      ++findings.figures().bad_joins;
      findings.add(Promise::joins, {{"edge", e}}, [&] {
        return fmt::format("{} is a cut (\"B\"), but has the fold angle {:.6g}",
                           edge_name(file, relations, e), file.edges[e].angle_deg);
      });
    }
  }
}

/// Corners that folds don't join around their vertex have to be vertices of their own.
void check_vertices(const Case& given, const std::vector<Index>& fan, Findings& findings) {
  const File& file = given.file;
  std::vector<Index> first_fan(file.points.size(), none);
  std::vector<bool> told(file.points.size(), false);
  for (Index s = 0; s < file.faces.sides(); ++s) {
    const Index v = file.faces.tail(s);
    if (first_fan[v] == none) {
      first_fan[v] = fan[s];
    } else if (first_fan[v] != fan[s] && !told[v]) {
      told[v] = true;
      findings.add(Promise::joins, {{"vertex", v}, {"face", file.faces.face(s)}}, [&] {
        return fmt::format(
            "vertex {} belongs to {} and to faces that no chain of folds around it joins with that one", v,
            face_name(file, file.faces.face(s)));
      });
    }
  }
}

/// What decides about the shape of a piece.
struct Patch {
  std::int64_t faces = 0, corners = 0, edges = 0;
  std::int64_t components = 0;
  std::int64_t borders = 0;  ///< closed loops of cut edges

  [[nodiscard]] std::int64_t euler() const { return corners - edges + faces; }
};

/// Follows each loop of sides without a fold; all its sides belong to one piece.
void count_borders(const File& file, const std::vector<Index>& twin, std::vector<Patch>& patches) {
  std::vector<bool> seen(file.faces.sides(), false);
  for (Index first = 0; first < file.faces.sides(); ++first) {
    if (twin[first] != none || seen[first]) {
      continue;
    }
    ++patches[file.face_piece[file.faces.face(first)]].borders;
    for (Index side = first; !seen[side];) {
      seen[side] = true;
      side = file.faces.next(side);
      while (twin[side] != none) {
        side = file.faces.next(twin[side]);
      }
    }
  }
}

std::vector<Patch> measure_patches(const Case& given, const std::vector<Index>& fan) {
  const File& file = given.file;
  const std::vector<Index>& twin = given.relations.fold_twin;
  std::vector<Patch> patches(file.pieces.size());
  DisjointSets joined(file.faces.faces());
  for (Index s = 0; s < file.faces.sides(); ++s) {
    Patch& patch = patches[file.face_piece[file.faces.face(s)]];
    patch.corners += fan[s] == s ? 1 : 0;
    // Of the two sides of a fold the one with the smaller number counts.
    patch.edges += twin[s] == none || s < twin[s] ? 1 : 0;
    if (twin[s] != none) {
      joined.join(file.faces.face(s), file.faces.face(twin[s]));
    }
  }
  for (Index f = 0; f < file.faces.faces(); ++f) {
    Patch& patch = patches[file.face_piece[f]];
    ++patch.faces;
    patch.components += joined.find(f) == f ? 1 : 0;
  }
  count_borders(file, twin, patches);
  return patches;
}

void check_patch(const File& file, Index p, const Patch& patch, Findings& findings) {
  if (patch.faces == 0) {
    return;
  }
  if (patch.components > 1) {
    findings.add(Promise::joins, {{"piece", p}}, [&] {
      return fmt::format("{} falls into {} parts that no fold joins", piece_name(file, p), patch.components);
    });
  } else if (patch.borders == 0 || patch.euler() != 2 - patch.borders) {
    findings.add(Promise::joins, {{"piece", p}}, [&] {
      return fmt::format(
          "{} is no patch of the plane: its folds close it up (Euler characteristic {}, {} borders)",
          piece_name(file, p), patch.euler(), patch.borders);
    });
  } else if (patch.borders - 1 != file.pieces[p].holes) {
    findings.add(Promise::joins, {{"piece", p}}, [&] {
      return fmt::format("{} has {} holes and states {}", piece_name(file, p), patch.borders - 1,
                         file.pieces[p].holes);
    });
  }
}

}  // namespace

void check_patches(const Case& given, Findings& findings) {
  check_edges(given, findings);
  const std::vector<Index> fan = corner_fans(given.file.faces, given.relations.fold_twin);
  check_vertices(given, fan, findings);
  given.context.check();
  const std::vector<Patch> patches = measure_patches(given, fan);
  for (Index p = 0; p < patches.size(); ++p) {
    check_patch(given.file, p, patches[p], findings);
  }
}

}  // namespace ridgecraft::verify
