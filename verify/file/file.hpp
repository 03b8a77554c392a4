// SPDX-License-Identifier: GPL-3.0-or-later
// What a .fold file states, once its form is known to be right: plain values, all indices within range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

// Polygons over a common list of vertices, and how their sides meet: as plain as a file has them.

using Index = std::uint32_t;
constexpr Index none = std::numeric_limits<Index>::max();

/// Faces as one list of corners. Side s runs from corner s to the next corner of the same face, so sides and
/// corners have the same numbers.
class FaceList {
 public:
  void add(std::span<const Index> vertices);

  [[nodiscard]] Index faces() const { return static_cast<Index>(first_.size() - 1); }
  [[nodiscard]] Index sides() const { return static_cast<Index>(vertex_.size()); }
  [[nodiscard]] Index first(Index face) const { return first_[face]; }
  [[nodiscard]] Index size(Index face) const { return first_[face + 1] - first_[face]; }
  [[nodiscard]] Index face(Index side) const { return face_[side]; }
  [[nodiscard]] Index next(Index side) const {
    return side + 1 < first_[face_[side] + 1] ? side + 1 : first_[face_[side]];
  }
  /// Where the side begins, and where it ends.
  [[nodiscard]] Index tail(Index side) const { return vertex_[side]; }
  [[nodiscard]] Index head(Index side) const { return vertex_[next(side)]; }
  [[nodiscard]] std::span<const Index> vertices(Index face) const {
    return std::span<const Index>(vertex_).subspan(first_[face], size(face));
  }

 private:
  std::vector<Index> first_{0};
  std::vector<Index> vertex_;
  std::vector<Index> face_;
};

/// The two ends of an edge as one number, the same for both directions.
[[nodiscard]] constexpr std::uint64_t edge_key(Index a, Index b) {
  return a < b ? (std::uint64_t{a} << 32U) | b : (std::uint64_t{b} << 32U) | a;
}

/// Sorts the corners at each vertex into fans: corners that are connected around their vertex through sides
/// with a twin get the same label. twin[s] is the side that runs along s from head to tail, or none. O(n
/// α(n)).
[[nodiscard]] std::vector<Index> corner_fans(const FaceList& faces, std::span<const Index> twin);

enum class Assignment : char { cut = 'B', mountain = 'M', valley = 'V', flat = 'F' };

struct Edge {
  std::array<Index, 2> ends{};
  Assignment assignment = Assignment::cut;
  double angle_deg = 0.0;
  bool bent = false;  ///< the paper is rolled there; of cut edges: on either side
};

/// A page without a size has no bounds.
struct Page {
  bool bounded = false;
  Vec2 low, high;                      ///< the whole page
  Vec2 printable_low, printable_high;  ///< page less margins
  std::array<double, 4> margins{};     ///< left, bottom, right, top
};

struct Piece {
  std::string name;
  std::optional<std::int64_t> part;
  std::vector<std::int64_t> parts;
  Index page = 0;
  std::int64_t holes = 0;
  std::string reason;
};

/// A piece that is said to be equal to the first of its kind, turned over where it is its mirror image.
struct EqualPiece {
  Index piece = 0;
  bool mirrored = false;
  bool other_tabs = false;  ///< than the first of its kind
};

/// Pieces that are glued to those of the steps before.
struct AssemblyStep {
  std::vector<Index> pieces;        ///< at least one, ascending
  std::vector<std::int64_t> joins;  ///< numbers of what is glued, ascending
};

struct Join {
  std::int64_t number = 1;
  std::array<Index, 2> edges{};
  Index tab = none;
  std::string why;  ///< there is no tab
};

/// Joins that follow each other on both of their pieces.
struct Chain {
  std::int64_t number = 1;
  std::vector<Index> joins;
};

struct Tab {
  Index edge = 0;
  std::vector<Index> edges;  ///< all that it grows from, `edge` among them
  std::vector<Vec2> polygon;
  std::vector<std::int64_t> numbers;  ///< of the joins that name it, as printed
  /// A second tab of a join, which names its first one, or one at a border, which belongs to none.
  bool additional = false;
  /// Both ends of the cut in the neighbour that the tab is put through, instead of glued.
  std::optional<std::array<Vec2, 2>> slit = {};
  bool foot = false;  ///< at a border, and folded inwards under what stands there
};

/// Where on a piece another piece is glued that no join connects with it.
struct GlueOutline {
  Index piece = 0;                          ///< that has it printed
  Index other = 0;                          ///< that is glued there
  std::vector<std::vector<Vec2>> outlines;  ///< closed; holes of the spot among them
};

/// One of the options that shaped the result; nothing for what no option can be.
using Setting = std::variant<std::monostate, bool, double, std::string, std::vector<double>>;

struct Settings {
  std::vector<std::pair<std::string, Setting>> all;  ///< by name, ascending

  /// Null where there is none.
  [[nodiscard]] const Setting* find(std::string_view name) const;
  /// Nothing where there is none, or one that is no number.
  [[nodiscard]] std::optional<double> number(std::string_view name) const;
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
  std::string creator, title;
  std::string digest;  ///< of the model's bytes, or empty
  Settings settings;
  std::vector<std::string> remarks;  ///< keys under "ridgecraft:" that are unknown or missing, in words
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
  std::optional<std::vector<Chain>> chains;  ///< nothing where the file doesn't tell
  std::vector<Tab> tabs;
  std::vector<GlueOutline> glue;
  /// Per piece the folds in the order in which they are made, those of one list together; nothing where the
  /// file doesn't tell.
  std::optional<std::vector<std::vector<std::vector<Index>>>> fold_order;
  std::vector<std::vector<EqualPiece>> equal;  ///< kinds of two or more

  /// The order in which pieces are put together; nothing where the file doesn't tell.
  std::optional<std::vector<AssemblyStep>> assembly;

  [[nodiscard]] std::vector<Vec2> polygon(Index face) const;
  /// Whether this program says that it made the file; then all of our own keys have to be there.
  [[nodiscard]] bool is_ours() const { return creator.starts_with("ridgecraft "); }
};

/// Why bytes are no file of the contract; thrown by the readers below and caught in verify().
struct NotInForm {
  std::string message;
};

/// Reads the bytes and checks the form: sections 1 to 3 of the contract, every key, type, length and index
/// range, edges listed once, a manifold model. Throws NotInForm. O(n log n).
[[nodiscard]] File read_file(std::string_view bytes);

}  // namespace ridgecraft::verify
