// SPDX-License-Identifier: GPL-3.0-or-later
// The queue of shortest-path searches: vertices by key, smallest first, equal keys by smaller vertex.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgecraft::segment {

/// A priority queue for keys that hardly ever fall below the one taken last, as in Dijkstra's algorithm and
/// A*. Entries wait unordered in buckets by key; only those of the bucket at hand are in a heap, which stays
/// tiny. The order is that of one large heap. Many entries of a search are never taken: they cost a
/// push_back.
class BucketQueue {
 public:
  /// Key as bits of a float, then vertex: floats that aren't negative are ordered as their bits are.
  using Entry = std::uint64_t;
  [[nodiscard]] static Entry entry(float key, std::uint32_t v) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(key)} << 32U | v;
  }
  [[nodiscard]] static std::uint32_t vertex(Entry e) { return static_cast<std::uint32_t>(e & 0xffffffffU); }

  /// Empties it for keys from `base` on, at least 0. `width` of a bucket: best such that few entries share
  /// one.
  void start(float base, float width);
  void push(float key, std::uint32_t v) {
    const float place = (key - base_) * inverse_width_;
    const auto bucket = place < static_cast<float>(most_buckets - 1)
                            ? static_cast<std::uint32_t>(place > 0.0F ? place : 0.0F)
                            : most_buckets - 1;
    if (bucket <= current_) {
      push_heap(entry(key, v));
      return;
    }
    if (bucket >= buckets_.size()) {
      buckets_.resize(std::size_t{bucket} + 1);
    }
    last_ = bucket > last_ ? bucket : last_;
    buckets_[bucket].push_back(entry(key, v));
  }
  /// Takes the first entry; false when there is none.
  [[nodiscard]] bool pop(Entry& first);

 private:
  static constexpr std::uint32_t most_buckets = 4096;

  void push_heap(Entry e);
  void sift_down(std::size_t i, Entry e);

  float base_ = 0.0F;
  float inverse_width_ = 1.0F;
  std::uint32_t current_ = 0;  ///< bucket whose entries are in the heap
  std::uint32_t last_ = 0;     ///< last bucket in use
  std::vector<std::vector<Entry>> buckets_;
  std::vector<Entry> heap_;  ///< binary
};

}  // namespace ridgecraft::segment
