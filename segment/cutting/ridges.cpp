// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/ridges.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ridgecraft::segment {
namespace {

/// Union-find over hull vertices in which enemies never meet.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n), enemies_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void make_enemies(std::uint32_t a, std::uint32_t b) {
    enemies_[a].push_back(b);
    enemies_[b].push_back(a);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = root(a);
    std::uint32_t y = root(b);
    if (x == y) {
      return;
    }
    if (enemies_[x].size() < enemies_[y].size()) {
      std::swap(x, y);
    }
    // Enmity goes both ways, so the shorter list tells.
    for (const std::uint32_t enemy : enemies_[y]) {
      if (root(enemy) == x) {
        return;
      }
    }
    parent_[y] = x;
    enemies_[x].insert(enemies_[x].end(), enemies_[y].begin(), enemies_[y].end());
    enemies_[y].clear();
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::vector<std::uint32_t>> enemies_;
};

}  // namespace

std::vector<Ridge> find_ridges(const Measurement& m, std::span<const Vec3> points) {
  const auto& hull = m.hull.vertices;
  const auto local = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(hull.begin(), hull.end(), v) - hull.begin());
  };
  Sets sets(hull.size());
  std::vector<double> reach(hull.size(), -1.0);
  std::vector<std::pair<double, std::uint32_t>> low;  // length of the valley, number
  for (std::uint32_t i = 0; i < m.bridges.size(); ++i) {
    const Bridge& b = m.bridges[i];
    if (!b.high) {
      low.emplace_back(b.length, i);
      continue;
    }
    const std::uint32_t a = local(b.a);
    const std::uint32_t c = local(b.b);
    sets.make_enemies(a, c);
    const auto [from_a, from_b] = sub_valleys(b, m.bridges);
    reach[a] = std::max(reach[a], from_a);
    reach[c] = std::max(reach[c], from_b);
  }
  std::sort(low.begin(), low.end());
  for (const auto& [length, i] : low) {
    sets.join(local(m.bridges[i].a), local(m.bridges[i].b));
  }
  // Hull vertices ascend, so ridges are numbered by their smallest one.
  std::vector<std::uint32_t> number(hull.size(), none);
  std::vector<Ridge> all;
  for (std::uint32_t v = 0; v < hull.size(); ++v) {
    std::uint32_t& n = number[sets.root(v)];
    if (n == none) {
      n = static_cast<std::uint32_t>(all.size());
      all.emplace_back();
    }
    all[n].vertices.push_back(hull[v]);
    if (reach[v] >= 0.0) {
      all[n].ends.push_back({hull[v], reach[v]});
    }
  }
  std::erase_if(all, [](const Ridge& r) { return r.ends.empty(); });
  for (Ridge& r : all) {
    Box3 box;
    for (const std::uint32_t v : r.vertices) {
      box.add(points[v]);
    }
    r.diagonal = box.diagonal();
  }
  return all;
}

}  // namespace ridgecraft::segment
