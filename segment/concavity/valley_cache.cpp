// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/valley_cache.hpp"

#include <utility>

namespace ridgecraft::segment {
namespace {

/// Small: each part that is measured for itself has a cache of its own.
constexpr std::size_t first_size = 64;

std::uint64_t key_of(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32U | to;
}

}  // namespace

ValleyCache::ValleyCache() : table_(first_size) {}

std::size_t ValleyCache::slot(std::uint64_t key) const {
  // Finaliser of splitmix64: neighbouring vertex numbers spread over the table.
  std::uint64_t z = key;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  std::size_t i = static_cast<std::size_t>(z ^ (z >> 31U)) & (table_.size() - 1);
  while (table_[i].count != 0 && table_[i].key != key) {
    i = (i + 1) & (table_.size() - 1);
  }
  return i;
}

bool ValleyCache::find(std::uint32_t from, std::uint32_t to, Valley& out) const {
  const Entry& e = table_[slot(key_of(from, to))];
  if (e.count == 0) {
    return false;
  }
  out.steps = {steps_.data() + e.first, e.count};
  out.concavity = {concavity_.data() + e.first, e.count};
  out.length = e.length;
  out.greatest = e.greatest;
  out.part = e.part;
  return true;
}

void ValleyCache::store(std::uint32_t from, std::uint32_t to, const Valley& valley) {
  if (2 * (used_ + 1) > table_.size()) {
    grow();
  }
  Entry& e = table_[slot(key_of(from, to))];
  used_ += e.count == 0 ? 1 : 0;
  e = {key_of(from, to), steps_.size(),   static_cast<std::uint32_t>(valley.steps.size()),
       valley.length,    valley.greatest, valley.part};
  steps_.insert(steps_.end(), valley.steps.begin(), valley.steps.end());
  concavity_.insert(concavity_.end(), valley.concavity.begin(), valley.concavity.end());
}

void ValleyCache::absorb(const ValleyCache& other) {
  for (const Entry& e : other.table_) {
    if (e.count != 0) {
      const auto from = static_cast<std::uint32_t>(e.key >> 32U);
      const auto to = static_cast<std::uint32_t>(e.key & 0xffffffffU);
      store(from, to,
            {{other.steps_.data() + e.first, e.count},
             {other.concavity_.data() + e.first, e.count},
             e.length,
             e.greatest,
             e.part});
    }
  }
}

void ValleyCache::grow() {
  const std::vector<Entry> old = std::exchange(table_, std::vector<Entry>(2 * table_.size()));
  for (const Entry& e : old) {
    if (e.count != 0) {
      table_[slot(e.key)] = e;
    }
  }
}

}  // namespace ridgecraft::segment
