// SPDX-License-Identifier: GPL-3.0-or-later
// Strong indices: the number of a face can't be passed as the number of an edge.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace ridgecraft {

/// A zero-based index that knows what it counts. The default value is "none".
template <class Tag>
class Id {
 public:
  static constexpr std::uint32_t none_value = 0xffffffffU;

  constexpr Id() = default;
  template <std::integral Int>
  constexpr explicit Id(Int value) : value_(static_cast<std::uint32_t>(value)) {}

  [[nodiscard]] constexpr std::uint32_t value() const { return value_; }
  [[nodiscard]] constexpr bool valid() const { return value_ != none_value; }
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  std::uint32_t value_ = none_value;
};

using VertexId = Id<struct VertexTag>;
using FaceId = Id<struct FaceTag>;  ///< a triangle of a Surface
using EdgeId = Id<struct EdgeTag>;  ///< an undirected edge of a Surface
using CornerId =
    Id<struct CornerTag>;  ///< corner k of face f is 3 f + k; also names the side from corner k to k + 1
using ComponentId = Id<struct ComponentTag>;  ///< faces connected over edges
using PanelId = Id<struct PanelTag>;          ///< a flat region of a Surface
using RollId = Id<struct RollTag>;            ///< a band that is rolled (prepare)
using PartId = Id<struct PartTag>;            ///< a nearly convex part (segment)
using PieceId = Id<struct PieceTag>;          ///< a connected net (unfold)
using JoinId = Id<struct JoinTag>;            ///< two cut edges that are glued together (unfold)
using TabId = Id<struct TabTag>;              ///< a glue tab (unfold)
using PageId = Id<struct PageTag>;            ///< a sheet of paper (export)

/// A vector that is indexed by one kind of Id only.
template <class I, class T>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t size, const T& value = T()) : items_(size, value) {}
  explicit IdVector(std::vector<T> items) : items_(std::move(items)) {}

  [[nodiscard]] decltype(auto) operator[](I id) { return items_[id.value()]; }
  [[nodiscard]] decltype(auto) operator[](I id) const { return items_[id.value()]; }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] bool empty() const { return items_.empty(); }
  I push_back(T item) {
    items_.push_back(std::move(item));
    return I(items_.size() - 1);
  }
  void resize(std::size_t size, const T& value = T()) { items_.resize(size, value); }
  void reserve(std::size_t size) { items_.reserve(size); }
  [[nodiscard]] auto begin() { return items_.begin(); }
  [[nodiscard]] auto end() { return items_.end(); }
  [[nodiscard]] auto begin() const { return items_.begin(); }
  [[nodiscard]] auto end() const { return items_.end(); }
  [[nodiscard]] std::vector<T>& items() { return items_; }
  [[nodiscard]] const std::vector<T>& items() const { return items_; }
  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  std::vector<T> items_;
};

/// The range that ids() gives: forward only, each id made as it is asked for. Written out, since clang 14
/// can't compile the views of this standard library.
template <class I>
class IdRange {
 public:
  /// Counts up; an index has no address, so it gives values.
  class Iterator {
   public:
    using value_type = I;
    using difference_type = std::ptrdiff_t;
    using reference = I;
    using pointer = const I*;
    using iterator_category = std::forward_iterator_tag;

    constexpr Iterator() = default;
    constexpr explicit Iterator(std::uint32_t value) : value_(value) {}
    constexpr I operator*() const { return I(value_); }
    constexpr Iterator& operator++() {
      ++value_;
      return *this;
    }
    constexpr Iterator operator++(int) { return Iterator(value_++); }
    friend constexpr bool operator==(Iterator, Iterator) = default;

   private:
    std::uint32_t value_ = 0;
  };

  constexpr explicit IdRange(std::size_t count) : count_(static_cast<std::uint32_t>(count)) {}
  [[nodiscard]] constexpr Iterator begin() const { return Iterator(0); }
  [[nodiscard]] constexpr Iterator end() const { return Iterator(count_); }
  [[nodiscard]] constexpr std::size_t size() const { return count_; }

 private:
  std::uint32_t count_;
};

/// The ids 0 .. count-1, for range-based loops: for (FaceId f : ids<FaceId>(surface.face_count())).
template <class I>
[[nodiscard]] constexpr IdRange<I> ids(std::size_t count) {
  return IdRange<I>(count);
}

}  // namespace ridgecraft
