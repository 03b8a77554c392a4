// SPDX-License-Identifier: GPL-3.0-or-later
// The queue of shortest-path searches: vertices by key, nearly smallest first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgecraft::segment {

/// A priority queue that is as exact as its buckets are narrow: an entry taken may be behind others of its
/// bucket. Searches with it look at a vertex again when a shorter way to it turns up, so paths come out exact
/// all the same, and there is no heap to keep. Many entries of a search are never taken: they cost a
/// push_back.
class BucketQueue {
 public:
  struct Entry {
    float key;
    std::uint32_t vertex;
  };

  BucketQueue() : buckets_(1) {}
  /// Empties it for keys from `base` on, at least 0. `width` of a bucket: best such that few entries share
  /// one.
  void start(float base, float width);
  void push(float key, std::uint32_t v) {
    std::uint32_t bucket = bucket_of(key);
    bucket = bucket < current_ ? current_ : bucket;
    if (bucket >= buckets_.size()) {
      buckets_.resize(std::size_t{bucket} + 1);
    }
    last_ = bucket > last_ ? bucket : last_;
    buckets_[bucket].push_back({key, v});
  }
  /// Takes an entry of the first bucket that has one, the one that came last; false when there is none.
  [[nodiscard]] bool pop(Entry& entry);
  /// Takes all entries that are left, in order of their buckets. Their keys are past then, and it is empty.
  void drain(std::vector<Entry>& left);
  /// Whether all entries with keys up to this one have been taken.
  [[nodiscard]] bool is_past(float key) const { return bucket_of(key) < current_; }

 private:
  static constexpr std::uint32_t most_buckets = 4096;

  [[nodiscard]] std::uint32_t bucket_of(float key) const {
    const float place = (key - base_) * inverse_width_;
    return place < static_cast<float>(most_buckets - 1)
               ? static_cast<std::uint32_t>(place > 0.0F ? place : 0.0F)
               : most_buckets - 1;
  }

  float base_ = 0.0F;
  float inverse_width_ = 1.0F;
  std::uint32_t current_ = 0;  ///< bucket from which entries are taken
  std::uint32_t last_ = 0;     ///< last bucket in use
  std::vector<std::vector<Entry>> buckets_;
};

}  // namespace ridgecraft::segment
