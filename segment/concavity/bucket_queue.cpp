// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/bucket_queue.hpp"

namespace ridgecraft::segment {

void BucketQueue::start(float base, float width) {
  for (std::uint32_t i = current_; i <= last_ && i < buckets_.size(); ++i) {
    buckets_[i].clear();
  }
  base_ = base;
  inverse_width_ = 1.0F / width;
  current_ = 0;
  last_ = 0;
}

void BucketQueue::drain(std::vector<Entry>& left) {
  for (; current_ <= last_ && current_ < buckets_.size(); ++current_) {
    left.insert(left.end(), buckets_[current_].begin(), buckets_[current_].end());
    buckets_[current_].clear();
  }
  // All buckets in use are past; pop() looks at the next one.
  if (current_ >= buckets_.size()) {
    buckets_.resize(std::size_t{current_} + 1);
  }
}

bool BucketQueue::pop(Entry& entry) {
  while (buckets_[current_].empty()) {
    if (current_ >= last_) {
      return false;
    }
    ++current_;
  }
  entry = buckets_[current_].back();
  buckets_[current_].pop_back();
  return true;
}

}  // namespace ridgecraft::segment
