// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/straight_chains.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace ridgecraft::prepare {
namespace {

class ChainStraightener {
 public:
  ChainStraightener(const mesh::Surface& surface, const PanelRegions& regions, double tolerance)
      : surface_(surface), regions_(regions), tolerance_(tolerance) {}

  std::vector<bool> choose(const std::vector<bool>& frozen) {
    const std::size_t n = surface_.vertex_count();
    keep_.assign(n, false);
    for (std::uint32_t v = 0; v < n; ++v) {
      keep_[v] = regions_.border_edges(v).size() != 2 && !regions_.border_edges(v).empty();
    }
    for (std::uint32_t r = 0; r < frozen.size(); ++r) {
      if (frozen[r]) {
        for (const std::uint32_t f : regions_.faces(r)) {
          for (const VertexId v : surface_.vertices(FaceId(f))) {
            keep_[v.value()] = true;
          }
        }
      }
    }
    follow_chains();
    keep_seams_apart();
    return std::move(keep_);
  }

 private:
  void follow_chains() {
    const std::vector<bool> corner = keep_;
    std::vector<bool> seen(surface_.edge_count(), false);
    const auto follow = [&](std::uint32_t v) {
      for (const std::uint32_t e : regions_.border_edges(v)) {
        if (!seen[e]) {
          chain(v, e, corner, seen);
        }
      }
    };
    for (std::uint32_t v = 0; v < corner.size(); ++v) {
      if (corner[v]) {
        follow(v);
      }
    }
    // What is left are closed chains without a corner.
    for (std::uint32_t v = 0; v < corner.size(); ++v) {
      follow(v);
    }
  }

  [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t v) const {
    const CornerId c = surface_.sides(EdgeId(edge))[0];
    const std::uint32_t a = surface_.vertex(c).value();
    return a == v ? surface_.vertex(mesh::next(c)).value() : a;
  }

  /// Chains that became the same straight side, as along an edge that was cut open, would grow together: they
  /// stay as they were.
  void keep_seams_apart() {
    struct Side {
      std::array<std::uint32_t, 2> ends;
      std::size_t chain;
      auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      std::uint32_t from = chains_[i].front();
      for (std::size_t k = 1; k < chains_[i].size(); ++k) {
        const std::uint32_t to = chains_[i][k];
        if (keep_[to]) {
          sides.push_back({{std::min(from, to), std::max(from, to)}, i});
          from = to;
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (sides[i].ends == sides[i - 1].ends) {
        keep_all(chains_[sides[i].chain]);
        keep_all(chains_[sides[i - 1].chain]);
      }
    }
  }

  void chain(std::uint32_t start, std::uint32_t edge, const std::vector<bool>& corner,
             std::vector<bool>& seen) {
    std::vector<std::uint32_t> line{start};
    for (;;) {
      seen[edge] = true;
      const std::uint32_t v = other_end(edge, line.back());
      line.push_back(v);
      if (v == start || corner[v]) {
        break;
      }
      const auto& edges = regions_.border_edges(v);
      edge = edges[0] == edge ? edges[1] : edges[0];
    }
    chains_.push_back(line);
    if (line.front() != line.back()) {
      straighten(line, 0, line.size() - 1);
      return;
    }
    keep_[start] = true;
    std::size_t far = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (length(place(line[i]) - place(start)) > length(place(line[far]) - place(start))) {
        far = i;
      }
    }
    if (far == 0 || line.size() <= 4) {  // a triangle, or all in one place: nothing can go
      keep_all(line);
      return;
    }
    keep_[line[far]] = true;
    straighten(line, 0, far);
    straighten(line, far, line.size() - 1);
    if (std::count_if(line.begin(), line.end() - 1, [&](std::uint32_t v) { return keep_[v]; }) < 3) {
      keep_all(line);
    }
  }

  void keep_all(const std::vector<std::uint32_t>& line) {
    for (const std::uint32_t v : line) {
      keep_[v] = true;
    }
  }

  [[nodiscard]] Vec3 place(std::uint32_t v) const { return surface_.point(VertexId(v)); }

  /// Douglas and Peucker's rule between two vertices that stay; with its own stack, since chains can be long.
  void straighten(const std::vector<std::uint32_t>& line, std::size_t from, std::size_t to) {
    std::vector<std::pair<std::size_t, std::size_t>> todo{{from, to}};
    while (!todo.empty()) {
      const auto [a, b] = todo.back();
      todo.pop_back();
      const Vec3 start = place(line[a]);
      const Vec3 along = normalized(place(line[b]) - start);
      const double reach = length(place(line[b]) - start);
      double worst = tolerance_;
      std::size_t at = a;
      for (std::size_t i = a + 1; i < b; ++i) {
        const Vec3 p = place(line[i]) - start;
        // Beyond the ends counts as off the line, too: there the chain turns back.
        const double t = std::clamp(dot(p, along), 0.0, reach);
        const double distance = length(p - t * along);
        if (distance > worst) {
          worst = distance;
          at = i;
        }
      }
      if (at != a) {
        keep_[line[at]] = true;
        todo.emplace_back(a, at);
        todo.emplace_back(at, b);
      }
    }
  }

  const mesh::Surface& surface_;
  const PanelRegions& regions_;
  double tolerance_;
  std::vector<std::vector<std::uint32_t>> chains_;
  std::vector<bool> keep_;  ///< of each vertex
};

}  // namespace

std::vector<bool> vertices_that_stay(const mesh::Surface& surface, const PanelRegions& regions,
                                     const std::vector<bool>& frozen, double tolerance) {
  return ChainStraightener(surface, regions, tolerance).choose(frozen);
}

}  // namespace ridgecraft::prepare
