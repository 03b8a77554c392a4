// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/bucket_queue.hpp"

#include <algorithm>

namespace ridgecraft::segment {

void BucketQueue::start(float base, float width) {
  for (std::uint32_t i = current_; i <= last_ && i < buckets_.size(); ++i) {
    buckets_[i].clear();
  }
  heap_.clear();
  base_ = base;
  inverse_width_ = 1.0F / width;
  current_ = 0;
  last_ = 0;
}

void BucketQueue::push_heap(Entry e) {
  std::size_t i = heap_.size();
  heap_.push_back(e);
  while (i > 0) {
    const std::size_t up = (i - 1) / 2;
    if (heap_[up] <= e) {
      break;
    }
    heap_[i] = heap_[up];
    i = up;
  }
  heap_[i] = e;
}

void BucketQueue::sift_down(std::size_t i, Entry e) {
  const std::size_t n = heap_.size();
  for (std::size_t child = 2 * i + 1; child < n; child = 2 * i + 1) {
    child += static_cast<std::size_t>(child + 1 < n && heap_[child + 1] < heap_[child]);
    if (heap_[child] >= e) {
      break;
    }
    heap_[i] = heap_[child];
    i = child;
  }
  heap_[i] = e;
}

bool BucketQueue::pop(Entry& first) {
  while (heap_.empty()) {
    if (current_ >= last_) {
      return false;
    }
    ++current_;
    heap_.swap(buckets_[current_]);
    for (std::size_t i = heap_.size() / 2; i-- > 0;) {
      sift_down(i, heap_[i]);
    }
  }
  first = heap_.front();
  const Entry e = heap_.back();
  heap_.pop_back();
  if (!heap_.empty()) {
    sift_down(0, e);
  }
  return true;
}

}  // namespace ridgecraft::segment
