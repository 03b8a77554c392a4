// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices and faces of Python become points and polygons, and back.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/mesh.hpp"

namespace ridgecraft::python {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Polygons = std::vector<std::vector<std::uint32_t>>;

/// What a caller calls a mesh: n x 3 numbers, and faces that name their rows from 0: an m x k array of
/// integers, or a sequence of sequences of any lengths.
struct Mesh {
  std::vector<Vec3> points;
  std::variant<Triangles, Polygons> faces;
};

/// Throws Error(usage) for what is neither.
[[nodiscard]] Mesh mesh_of(const pybind11::object& vertices, const pybind11::object& faces);

/// Repairs it.
[[nodiscard]] mesh::Model model_of(const Mesh& mesh, const mesh::ReadOptions& options,
                                   const Context& context);

/// n x 3 doubles.
[[nodiscard]] pybind11::array_t<double> array_of(std::span<const Vec3> points);
/// m x 3 integers.
[[nodiscard]] pybind11::array_t<std::int32_t> array_of(
    std::span<const std::array<std::uint32_t, 3>> triangles);

/// An array of rows of one length, filled by at(row, column).
template <class Number, std::size_t Rank, class At>
[[nodiscard]] pybind11::array_t<Number> filled(std::array<std::size_t, Rank> shape, At at) {
  pybind11::array_t<Number> array(std::vector<pybind11::ssize_t>(shape.begin(), shape.end()));
  Number* out = array.mutable_data();
  std::size_t columns = 1;
  for (std::size_t k = 1; k < Rank; ++k) {
    columns *= shape[k];
  }
  for (std::size_t row = 0; row < shape[0]; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      *out++ = static_cast<Number>(at(row, column));
    }
  }
  return array;
}

}  // namespace ridgecraft::python
