// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 3: every model face is one net face, and every piece has the parts that it states.
#include <algorithm>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"

namespace ridgecraft::verify {
namespace {

void check_model_faces(const Case& given, Findings& findings) {
  Figures& figures = findings.figures();
  for (Index face = 0; face < given.file.model.faces.faces(); ++face) {
    const Index uses = given.relations.uses[face];
    if (uses == 0) {
      ++figures.missing_faces;
      findings.add(Promise::coverage, {{"model_face", face}},
                   [&] { return fmt::format("model face {} is on no piece", face); });
    } else if (uses > 1) {
      ++figures.double_faces;
      findings.add(Promise::coverage, {{"model_face", face}},
                   [&] { return fmt::format("model face {} is {} faces of the nets", face, uses); });
    }
  }
}

/// The parts of the faces of each piece, each once, in order.
std::vector<std::vector<std::int64_t>> parts_of_pieces(const File& file) {
  std::vector<std::vector<std::int64_t>> parts(file.pieces.size());
  for (Index face = 0; face < file.faces.faces(); ++face) {
    parts[file.face_piece[face]].push_back(file.model.face_part[file.face_model[face]]);
  }
  for (std::vector<std::int64_t>& list : parts) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return parts;
}

}  // namespace

void check_coverage(const Case& given, Findings& findings) {
  check_model_faces(given, findings);
  const File& file = given.file;
  const std::vector<std::vector<std::int64_t>> parts = parts_of_pieces(file);
  for (Index p = 0; p < file.pieces.size(); ++p) {
    const Piece& piece = file.pieces[p];
    std::vector<std::int64_t> stated = piece.parts;
    std::sort(stated.begin(), stated.end());
    const bool part_fits = parts[p].size() == 1 ? piece.part == parts[p].front() : !piece.part.has_value();
    if (parts[p].empty()) {
      findings.add(Promise::coverage, {{"piece", p}},
                   [&] { return fmt::format("{} has no face", piece_name(file, p)); });
    } else if (stated != parts[p]) {
      findings.add(Promise::coverage, {{"piece", p}}, [&] {
        return fmt::format("{} doesn't state the parts that its faces have, each once", piece_name(file, p));
      });
    } else if (!part_fits) {
      findings.add(Promise::coverage, {{"piece", p}}, [&] {
        return fmt::format("\"part\" of {} doesn't go with the {} part{} of its faces", piece_name(file, p),
                           parts[p].size(), parts[p].size() == 1 ? "" : "s");
      });
    }
  }
}

}  // namespace ridgecraft::verify
