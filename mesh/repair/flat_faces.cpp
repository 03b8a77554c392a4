// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/flat_faces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace ridgecraft::mesh {
namespace {

/// Where flat faces share an edge with a fan of others, each divides each: no more than this many times the
/// triangles that there were. A surface without such edges gains less than one for each flat face.
constexpr std::size_t most_growth = 4;

struct Sides {
  std::array<double, 3> length;  ///< of the side from corner k to corner k + 1
  unsigned longest;
  unsigned shortest;
};

Sides sides_of(const TriangleList& list, const Triangle& t) {
  Sides s{};
  for (unsigned k = 0; k < 3; ++k) {
    s.length[k] = length(list.points[t.points[(k + 1) % 3]] - list.points[t.points[k]]);
    s.longest = s.length[k] > s.length[s.longest] ? k : s.longest;
    s.shortest = s.length[k] < s.length[s.shortest] ? k : s.shortest;
  }
  return s;
}

bool has_no_area(const TriangleList& list, const Triangle& t) {
  return is_flat(list.points[t.points[0]], list.points[t.points[1]], list.points[t.points[2]]);
}

/// Joins the ends of sides that are nothing beside the others. True when it did.
bool join_short_sides(TriangleList& list, const std::vector<std::size_t>& flat) {
  DisjointSets joined(list.points.size());
  bool any = false;
  for (const std::size_t i : flat) {
    const Triangle& t = list.triangles[i];
    const Sides s = sides_of(list, t);
    if (s.length[s.shortest] <= no_height * s.length[s.longest]) {
      any = joined.join(t.points[s.shortest], t.points[(s.shortest + 1) % 3]) || any;
    }
  }
  if (any) {
    for (Triangle& t : list.triangles) {
      for (std::uint32_t& p : t.points) {
        p = joined.find(p);
      }
    }
    std::erase_if(list.triangles, [](const Triangle& t) {
      return t.points[0] == t.points[1] || t.points[1] == t.points[2] || t.points[2] == t.points[0];
    });
  }
  return any;
}

/// Takes flat triangles away, the one with the longest side first, and divides the others at that side. The
/// sum of the flat triangles' longest sides falls with each step, so it ends. Once there are very many, the
/// others stay whole, and a seam without width opens.
class Divider {
 public:
  explicit Divider(TriangleList& list)
      : list_(list), gone_(list.triangles.size(), false), most_(most_growth * list.triangles.size()) {}

  void run(const Context& context) {
    for (std::size_t i = 0; i < list_.triangles.size(); ++i) {
      enter(i);
    }
    for (std::size_t steps = 0; !queue_.empty(); ++steps) {
      if (steps % 1024 == 0) {
        context.check();
      }
      const std::size_t i = std::prev(queue_.end())->second;
      step(i);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list_.triangles.size(); ++i) {
      if (!gone_[i]) {
        list_.triangles[kept++] = list_.triangles[i];
      }
    }
    list_.triangles.resize(kept);
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  static Edge edge(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

  void enter(std::size_t i) {
    const Triangle& t = list_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      uses_[edge(t.points[k], t.points[(k + 1) % 3])].insert(i);
    }
    if (has_no_area(list_, t)) {
      const Sides s = sides_of(list_, t);
      queue_.insert({s.length[s.longest], i});
    }
  }

  void leave(std::size_t i) {
    const Triangle& t = list_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      uses_[edge(t.points[k], t.points[(k + 1) % 3])].erase(i);
    }
    const Sides s = sides_of(list_, t);
    queue_.erase({s.length[s.longest], i});
    gone_[i] = true;
  }

  void step(std::size_t i) {
    const Triangle flat = list_.triangles[i];
    const unsigned k = sides_of(list_, flat).longest;
    const std::uint32_t a = flat.points[k];
    const std::uint32_t b = flat.points[(k + 1) % 3];
    const std::uint32_t middle = flat.points[(k + 2) % 3];
    leave(i);
    if (list_.triangles.size() > most_) {
      return;
    }
    const std::set<std::size_t> beyond = uses_[edge(a, b)];
    for (const std::size_t j : beyond) {
      const Triangle t = list_.triangles[j];
      leave(j);
      unsigned side = 0;
      while (edge(t.points[side], t.points[(side + 1) % 3]) != edge(a, b)) {
        ++side;
      }
      if (t.points[(side + 2) % 3] == middle) {
        continue;  // the same place again: nothing is left of it
      }
      for (const unsigned half : {0U, 1U}) {
        Triangle part = t;
        const unsigned moved = (side + 1 - half) % 3;
        part.points[moved] = middle;
        list_.triangles.push_back(part);
        gone_.push_back(false);
        enter(list_.triangles.size() - 1);
      }
    }
  }

  TriangleList& list_;
  std::vector<bool> gone_;
  std::size_t most_;  ///< triangles, those that are gone included
  std::map<Edge, std::set<std::size_t>> uses_;
  std::set<std::pair<double, std::size_t>> queue_;
};

}  // namespace

bool is_flat(Vec3 a, Vec3 b, Vec3 c) {
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  return !(length(cross(b - a, c - a)) > no_height * longest * longest);
}

std::size_t collapse_flat_triangles(TriangleList& list, const Context& context) {
  std::vector<std::size_t> flat;
  for (std::size_t i = 0; i < list.triangles.size(); ++i) {
    if (has_no_area(list, list.triangles[i])) {
      flat.push_back(i);
    }
  }
  const std::size_t count = flat.size();
  while (!flat.empty() && join_short_sides(list, flat)) {
    context.check();
    flat.clear();
    for (std::size_t i = 0; i < list.triangles.size(); ++i) {
      if (has_no_area(list, list.triangles[i])) {
        flat.push_back(i);
      }
    }
  }
  if (!flat.empty()) {
    Divider(list).run(context);
  }
  return count;
}

}  // namespace ridgecraft::mesh
