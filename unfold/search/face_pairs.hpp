// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of faces that overlap in the plane: those that there are, and those that a change would make.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {

/// A set of pairs, by their faces.
class FacePairSet {
 public:
  explicit FacePairSet(std::size_t face_count) : meets_(face_count), bad_at_(face_count, no_index) {}

  void clear();
  /// The pair must not be there. O(1).
  void add(std::uint32_t f, std::uint32_t g);
  /// The pair must be there. O(pairs of its faces).
  void remove(std::uint32_t f, std::uint32_t g);
  [[nodiscard]] std::uint64_t total() const { return total_; }
  /// Faces of any pair.
  [[nodiscard]] const std::vector<std::uint32_t>& bad_faces() const { return bad_; }
  [[nodiscard]] const std::vector<std::uint32_t>& met_by(std::uint32_t face) const { return meets_[face]; }

  /// Calls use(f, g) for each pair of a face f in an interval of a net or a forest and a face g outside it.
  /// O(smaller of the interval and the faces of pairs, and their pairs).
  template <class Net, class Use>
  void visit_across(const Net& net, const typename Net::Span& moved, Use use) const;
  /// Removes these pairs.
  template <class Net>
  void drop_across(const Net& net, const typename Net::Span& moved);

 private:
  void remove_from_list(std::uint32_t f, std::uint32_t g);

  std::vector<std::vector<std::uint32_t>> meets_;  ///< per face: faces that it makes a pair with
  std::vector<std::uint32_t> bad_;
  std::vector<std::uint32_t> bad_at_;  ///< place of each face in bad_
  std::uint64_t total_ = 0;
  FacePairs dropped_;  ///< space to work in
};

/// Faces of one plane, in an order, and the circles over it.
struct LaidFaces {
  std::span<const std::uint32_t> order;
  const CircleTree* circles = nullptr;
};

/// A cyclic interval of some faces that is carried onto others; those it is no part of, where they are the
/// same.
struct Carrying {
  LaidFaces from;
  std::uint32_t first = 0;  ///< position
  std::uint32_t count = 0;
  LaidFaces onto;
  Rigid motion;
};

/// Answers what faces would run into when they are carried.
class CarriedOverlaps {
 public:
  /// `flat`: per face, as it lies now; must outlive this. Overlap is penetration deeper than `tolerance`, mm.
  CarriedOverlaps(std::span<const EdgedTriangle> flat, double tolerance);

  /// How many pairs of a carried face and another one would overlap; `limit` where there are as many or more.
  std::uint32_t count(const Carrying& what, std::uint32_t limit);
  /// The pairs that the last count came upon; may be swapped away.
  [[nodiscard]] FacePairs& found() { return found_; }

 private:
  /// Two nodes of circle trees that come near each other when the first is carried to `centre`.
  struct Meeting {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Vec2 centre;
  };
  class Descent;

  std::span<const EdgedTriangle> flat_;
  double tolerance_;
  FacePairs found_;
  std::vector<Meeting> meetings_;        ///< space to work in
  std::vector<EdgedTriangle> moved_;     ///< per face: its corners when it is carried as was asked last
  std::vector<std::uint64_t> moved_in_;  ///< question that moved_ is of
  std::uint64_t question_ = 0;
};

template <class Net, class Use>
void FacePairSet::visit_across(const Net& net, const typename Net::Span& moved, Use use) const {
  const auto visit = [&](std::uint32_t f) {
    for (const std::uint32_t g : meets_[f]) {
      if (!net.in_span(moved, g)) {
        use(f, g);
      }
    }
  };
  if (bad_.size() < moved.count) {
    for (const std::uint32_t f : bad_) {
      if (net.in_span(moved, f)) {
        visit(f);
      }
    }
    return;
  }
  for (std::uint32_t i = 0; i < moved.count; ++i) {
    visit(net.face_in(moved, i));
  }
}

template <class Net>
void FacePairSet::drop_across(const Net& net, const typename Net::Span& moved) {
  dropped_.clear();
  visit_across(net, moved, [&](std::uint32_t f, std::uint32_t g) { dropped_.emplace_back(f, g); });
  for (const auto& [f, g] : dropped_) {
    remove(f, g);
  }
}

}  // namespace ridgecraft::unfold
