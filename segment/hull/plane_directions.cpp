// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/plane_directions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/elementary.hpp"

namespace ridgecraft::segment {
namespace {

/// Finer cells would cost more to look at than they save, however many planes there are.
constexpr std::uint32_t most_squares = 32;

/// Number of the cell that a direction meets when each side of the cube has squares * squares.
std::uint32_t cell_of(Vec3 n, std::uint32_t squares) {
  const double x = std::abs(n.x);
  const double y = std::abs(n.y);
  const double z = std::abs(n.z);
  double main = n.x;
  double u = n.y;
  double v = n.z;
  std::uint32_t side = 0;
  if (y > x && y >= z) {
    main = n.y;
    u = n.z;
    v = n.x;
    side = 2;
  } else if (z > x) {
    main = n.z;
    u = n.x;
    v = n.y;
    side = 4;
  }
  side += main < 0.0 ? 1U : 0U;
  const auto square = [&](double w) {
    const double along = 0.5 * (w / std::abs(main) + 1.0) * squares;
    return std::min(squares - 1, static_cast<std::uint32_t>(std::max(0.0, along)));
  };
  return (side * squares + square(u)) * squares + square(v);
}

}  // namespace

void PlaneDirections::assign(std::span<const HullPlane> planes, Vec3 centre) {
  centre_ = centre;
  // 6 s^2 cells of n / (6 s^2) planes: about as many planes in a cell as cells at s = (n / 36)^(1/4).
  const double even = elementary::pow(static_cast<double>(planes.size()) / 36.0, 0.25);
  const std::uint32_t squares = std::min(most_squares, static_cast<std::uint32_t>(even) + 1);
  first_.assign(std::size_t{6} * squares * squares + 1, 0);
  place_.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    place_[i] = cell_of(planes[i].normal, squares);
    ++first_[place_[i] + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  cells_.resize(first_.size() - 1);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c] = Cell{};
    cells_[c].begin = cells_[c].end = first_[c];
  }
  planes_.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Cell& cell = cells_[place_[i]];
    planes_[cell.end++] = planes[i];
    cell.least_offset = std::min(cell.least_offset, planes[i].offset - dot(planes[i].normal, centre));
    cell.normals.add(planes[i].normal);
  }
  std::erase_if(cells_, [](const Cell& cell) { return cell.begin == cell.end; });
}

}  // namespace ridgecraft::segment
