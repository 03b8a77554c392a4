// SPDX-License-Identifier: GPL-3.0-or-later
// What a .fold file states, once its form is known to be right: plain values, all indices within range.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"
#include "verify/face_list.hpp"

namespace ridgecraft::verify {

enum class Assignment : char { cut = 'B', mountain = 'M', valley = 'V', flat = 'F' };

struct Edge {
  std::array<Index, 2> ends{};
  Assignment assignment = Assignment::cut;
  double angle_deg = 0.0;
};

/// A page without a size has no bounds.
struct Page {
  bool bounded = false;
  Vec2 low, high;                      ///< the whole page
  Vec2 printable_low, printable_high;  ///< page less margins
};

struct Piece {
  std::string name;
  std::optional<std::int64_t> part;
  std::vector<std::int64_t> parts;
  Index page = 0;
  std::int64_t holes = 0;
};

struct Join {
  std::int64_t number = 1;
  std::array<Index, 2> edges{};
  Index tab = none;
  bool says_why = false;  ///< has a text that tells why there is no tab
};

struct Tab {
  Index edge = 0;
  std::vector<Index> edges;  ///< all that it grows from, `edge` among them
  std::vector<Vec2> polygon;
  std::vector<std::int64_t> numbers;  ///< of the joins that name it, as printed
};

/// The surface that was unfolded.
struct Model {
  std::vector<Vec3> points;
  FaceList faces;
  std::vector<Index> twin;  ///< per side: the side of the other face along it, or none at a border
  std::vector<std::int64_t> face_part;
  double size = 0.0;  ///< diagonal of the bounding box, mm
};

struct File {
  Model model;
  std::vector<Vec2> points;
  FaceList faces;
  std::vector<Edge> edges;
  std::vector<Index> side_edge;   ///< per side of a net face: its edge
  std::vector<Index> face_model;  ///< per net face: the model face it is
  std::vector<Index> face_piece;
  std::vector<Piece> pieces;
  std::vector<Page> pages;
  std::vector<Join> joins;
  std::vector<Tab> tabs;

  [[nodiscard]] std::vector<Vec2> polygon(Index face) const;
};

/// Why bytes are no file of the contract; thrown by the readers below and caught in verify().
struct NotInForm {
  std::string message;
};

/// Reads the bytes and checks the form: sections 1 to 3 of the contract, every key, type, length and index
/// range, edges listed once, a manifold model. Throws NotInForm. O(n log n).
[[nodiscard]] File read_file(std::string_view bytes);

}  // namespace ridgecraft::verify
