// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/spiky_bodies.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/random.hpp"
#include "base/vector.hpp"

namespace ridgecraft::bench {
namespace {

struct Shape {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

Shape icosahedron() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  Shape shape;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      shape.points.insert(shape.points.end(), {{a, b, 0.0}, {0.0, a, b}, {b, 0.0, a}});
    }
  }
  // Its faces are the triples of corners that lie at the distance of an edge from each other.
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    return std::abs(length(shape.points[i] - shape.points[j]) - 2.0) < 1e-9;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (near(i, j) && near(j, k) && near(i, k)) {
          const Vec3 p = shape.points[i];
          const bool outward = dot(cross(shape.points[j] - p, shape.points[k] - p), p) > 0.0;
          shape.faces.push_back(outward ? std::array{i, j, k} : std::array{i, k, j});
        }
      }
    }
  }
  return shape;
}

Vec3 onto_sphere(Vec3 p) {
  return (1.0 / length(p)) * p;
}

Shape divided_in_four(const Shape& shape) {
  Shape result{shape.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [at, made] =
        middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(result.points.size()));
    if (made) {
      result.points.push_back(onto_sphere(shape.points[i] + shape.points[j]));
    }
    return at->second;
  };
  for (const auto& [i, j, k] : shape.faces) {
    const std::uint32_t a = middle(i, j), b = middle(j, k), c = middle(k, i);
    result.faces.insert(result.faces.end(), {{i, a, c}, {a, j, b}, {c, b, k}, {a, b, c}});
  }
  return result;
}

Shape box(std::array<int, 3> size) {
  Shape shape;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto number = [&](const std::array<int, 3>& at) {
    const auto [place, made] = numbers.try_emplace(at, static_cast<std::uint32_t>(shape.points.size()));
    if (made) {
      shape.points.push_back(
          {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      for (int i = 0; i < size[u]; ++i) {
        for (int j = 0; j < size[v]; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = far ? size[axis] : 0;
            at[u] = i + (far ? di : dj);
            at[v] = j + (far ? dj : di);
            return number(at);
          };
          const std::uint32_t p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          shape.faces.insert(shape.faces.end(), {{p, q, r}, {p, r, s}});
        }
      }
    }
  }
  return shape;
}

mesh::Surface spiked(Shape shape, std::size_t spikes, double height, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> order(shape.faces.size());
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = 0; i < spikes; ++i) {
    std::swap(order[i], order[i + random.below(static_cast<std::uint32_t>(order.size() - i))]);
  }
  for (std::size_t i = 0; i < spikes; ++i) {
    const auto [a, b, c] = shape.faces[order[i]];
    const Vec3 p = shape.points[a], q = shape.points[b], r = shape.points[c];
    const Vec3 across = cross(q - p, r - p);  // as long as twice the area
    const double twice_area = length(across);
    const auto top = static_cast<std::uint32_t>(shape.points.size());
    shape.points.push_back((1.0 / 3.0) * (p + q + r) +
                           (height * std::sqrt(twice_area) / twice_area) * across);
    shape.faces[order[i]] = {a, b, top};
    shape.faces.push_back({b, c, top});
    shape.faces.push_back({c, a, top});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const auto& [a, b, c] : shape.faces) {
    faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
  }
  for (Vec3& p : shape.points) {
    p = 20.0 * p;
  }
  return {std::move(shape.points), std::move(faces)};
}

}  // namespace

mesh::Surface spiky_ball(int divisions, std::size_t spikes, double height, std::uint64_t seed) {
  Shape shape = icosahedron();
  for (Vec3& p : shape.points) {
    p = onto_sphere(p);
  }
  for (int i = 0; i < divisions; ++i) {
    shape = divided_in_four(shape);
  }
  return spiked(std::move(shape), spikes, height, seed);
}

mesh::Surface spiky_box(int a, int b, int c, std::size_t spikes, double height, std::uint64_t seed) {
  return spiked(box({a, b, c}), spikes, height, seed);
}

std::vector<SpikyBody> spiky_family() {
  std::vector<SpikyBody> family;
  for (const std::uint64_t seed : {1U, 2U}) {
    family.push_back({"ball 208", spiky_ball(1, 64, 2.5, seed)});
    family.push_back({"box 346", spiky_box(3, 3, 4, 107, 2.75, seed)});
    family.push_back({"ball 576", spiky_ball(2, 128, 3.0, seed)});
  }
  return family;
}

}  // namespace ridgecraft::bench
