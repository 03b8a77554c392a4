// SPDX-License-Identifier: GPL-3.0-or-later
// How the two frames of a file go together: which side of a net is which side of the model, what its folds
// join, by how much the model is folded there, and which stiff plates move when a piece is folded.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::verify {

/// What is wrong with an edge before it is even compared with the model.
enum class EdgeFlaw : unsigned char {
  sound,
  many_faces,
  same_direction,
  cut_with_two_faces,
  fold_with_one_face,
  fold_between_pieces
};

struct Relations {
  std::vector<bool> corners_match;  ///< per net face: as many corners as its model face
  std::vector<Index> uses;          ///< per model face: how many net faces it is
  std::vector<Index> net_face;      ///< per model face: its only net face with matching corners, or none
  std::vector<Index> edge_first;    ///< per edge, and one more: where its sides begin in edge_sides
  std::vector<Index> edge_sides;    ///< sides of net faces, sorted by edge
  std::vector<EdgeFlaw> flaw;       ///< per edge
  std::vector<Index> fold_twin;     ///< per side: the side across a sound fold, or none
  std::vector<Vec3> normal;         ///< per model face: of its area; zero if it has none
  std::vector<double> area;         ///< per model face, mm²

  [[nodiscard]] std::span<const Index> sides_of(Index edge) const {
    return std::span<const Index>(edge_sides)
        .subspan(edge_first[edge], edge_first[edge + 1] - edge_first[edge]);
  }
};

/// O(n).
[[nodiscard]] Relations relate(const File& file);

/// The page that a piece, face or tab lies on.
[[nodiscard]] inline Index page_of_face(const File& file, Index face) {
  return file.pieces[file.face_piece[face]].page;
}
[[nodiscard]] inline Index piece_of_edge(const File& file, const Relations& relations, Index edge) {
  return file.face_piece[file.faces.face(relations.sides_of(edge).front())];
}
/// A tab belongs to the face of its edge.
[[nodiscard]] inline Index face_of_tab(const File& file, const Relations& relations, Index tab) {
  return file.faces.face(relations.sides_of(file.tabs[tab].edge).front());
}

/// The side of the model that an edge of the nets is, or none where their corners don't correspond.
[[nodiscard]] inline Index model_side_of(const File& file, const Relations& relations, Index edge) {
  const Index side = relations.sides_of(edge).front();
  const Index face = file.faces.face(side);
  return relations.corners_match[face]
             ? file.model.faces.first(file.face_model[face]) + (side - file.faces.first(face))
             : none;
}

/// The side at which the slit of a tab lies: that of the other edge of the tab's join. None where it has no
/// slit or no join. O(joins).
[[nodiscard]] Index target_of_slit(const File& file, const Relations& relations, Index tab);

/// Names for messages: `face 12 (piece "A3")`, `piece "A3"`, `tab 7 (joins 3, 4)`.
[[nodiscard]] std::string face_name(const File& file, Index face);
[[nodiscard]] std::string piece_name(const File& file, Index piece);
[[nodiscard]] std::string tab_name(const File& file, Index tab);
[[nodiscard]] std::string edge_name(const File& file, const Relations& relations, Index edge);
[[nodiscard]] std::string join_name(const File& file, Index join);

// A file that is checked, with all that the checks share.

/// What every check is given.
struct Case {
  const File& file;
  const Relations& relations;
  const Context& context;
};

// By how much the model is folded at an edge.

/// The fold that the model has between two faces: negative for mountains.
struct ModelFold {
  double angle_deg = 0.0;
  double tolerance_deg = 0.0;  ///< how well the angle is known: badly between slender faces
};

/// At a side of the model that has a twin. O(1).
[[nodiscard]] ModelFold model_fold(const File& file, const Relations& relations, Index model_side);

// The stiff plates of a piece and the creases between them: what moves when it is folded.

/// Faces of the nets that folds flatter than an angle join.
struct Plates {
  std::vector<Index> plate;  ///< per net face, numbered by their first faces
  Index count = 0;
};

/// Sound folds below `flat_deg` join faces. O(n α(n)).
[[nodiscard]] Plates find_plates(const File& file, const Relations& relations, double flat_deg);

/// All folds between two plates: they lie on one line, or the plates couldn't move.
struct Crease {
  Index first = 0, second = 0;  ///< plates, the smaller number first
  std::vector<Index> edges;
};

/// The creases of each piece. O(n log n).
[[nodiscard]] std::vector<std::vector<Crease>> find_creases(const File& file, const Relations& relations,
                                                            const Plates& plates);

/// Whether creases, in the order in which they are folded one at a time, come by their distance from some
/// plate, the farthest first. At least one crease; distances are counted in creases. O(n log n).
[[nodiscard]] bool goes_inwards(std::span<const Crease* const> order);

}  // namespace ridgecraft::verify
