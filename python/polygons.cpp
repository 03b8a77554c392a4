// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/polygons.hpp"

#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::vector<Vec3> points_of(const py::object& vertices) {
  const Numbers numbers = Numbers::ensure(vertices);
  if (!numbers) {
    PyErr_Clear();
    throw Error(ErrorKind::usage, "vertices must be an array of n x 3 numbers");
  }
  if (numbers.ndim() != 2 || numbers.shape(1) != 3) {
    throw Error(ErrorKind::usage, "vertices must be an array of n x 3 numbers, not of " +
                                      std::string(py::str(numbers.attr("shape"))));
  }
  std::vector<Vec3> points(static_cast<std::size_t>(numbers.shape(0)));
  const double* at = numbers.data();
  for (Vec3& p : points) {
    p = {at[0], at[1], at[2]};
    at += 3;
  }
  return points;
}

/// `face` is for the sentence.
std::uint32_t index_of(std::int64_t value, std::size_t face, std::size_t points) {
  if (value < 0 || static_cast<std::uint64_t>(value) >= points) {
    throw Error(ErrorKind::unusable_mesh,
                fmt::format("face {} names vertex {}, and there are {}", face, value, points));
  }
  return static_cast<std::uint32_t>(value);
}

[[noreturn]] void refuse_faces() {
  throw Error(ErrorKind::usage,
              "faces must be an array of m x k integers, or a sequence of sequences of integers");
}

Triangles triangles_of(const Indices& indices, std::size_t points) {
  Triangles triangles(static_cast<std::size_t>(indices.shape(0)));
  const std::int64_t* at = indices.data();
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::uint32_t& corner : triangles[f]) {
      corner = index_of(*at++, f, points);
    }
  }
  return triangles;
}

Polygons polygons_of(const Indices& indices, std::size_t points) {
  Polygons polygons(static_cast<std::size_t>(indices.shape(0)),
                    std::vector<std::uint32_t>(static_cast<std::size_t>(indices.shape(1))));
  const std::int64_t* at = indices.data();
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    for (std::uint32_t& corner : polygons[f]) {
      corner = index_of(*at++, f, points);
    }
  }
  return polygons;
}

Polygons polygons_of(const py::sequence& faces, std::size_t points) {
  Polygons polygons;
  for (const py::handle face : faces) {
    if (!py::isinstance<py::sequence>(face) || py::isinstance<py::str>(face)) {
      refuse_faces();
    }
    std::vector<std::uint32_t>& polygon = polygons.emplace_back();
    for (const py::handle corner : py::reinterpret_borrow<py::sequence>(face)) {
      if (PyIndex_Check(corner.ptr()) == 0) {
        refuse_faces();
      }
      const Py_ssize_t value = PyNumber_AsSsize_t(corner.ptr(), nullptr);
      polygon.push_back(index_of(value, polygons.size() - 1, points));
    }
  }
  return polygons;
}

}  // namespace

Mesh mesh_of(const py::object& vertices, const py::object& faces) {
  Mesh mesh;
  mesh.points = points_of(vertices);
  if (!py::isinstance<py::array>(faces)) {
    if (!py::isinstance<py::sequence>(faces) || py::isinstance<py::str>(faces)) {
      refuse_faces();
    }
    mesh.faces = polygons_of(py::reinterpret_borrow<py::sequence>(faces), mesh.points.size());
    return mesh;
  }
  const auto array = py::reinterpret_borrow<py::array>(faces);
  const char kind = array.dtype().kind();
  if ((kind != 'i' && kind != 'u') || array.ndim() != 2) {
    refuse_faces();
  }
  // Numbers beyond 63 bits would become negative ones, which no vertex has either.
  const Indices indices = Indices::ensure(array);
  if (indices.shape(1) == 3) {
    mesh.faces = triangles_of(indices, mesh.points.size());
  } else {
    mesh.faces = polygons_of(indices, mesh.points.size());
  }
  return mesh;
}

mesh::Model model_of(const Mesh& mesh, const mesh::ReadOptions& options, const Context& context) {
  return std::visit([&](const auto& faces) { return mesh::repair(mesh.points, faces, options, context); },
                    mesh.faces);
}

py::array_t<double> array_of(std::span<const Vec3> points) {
  return filled<double>(std::array{points.size(), std::size_t{3}}, [&](std::size_t row, std::size_t column) {
    return column == 0 ? points[row].x : column == 1 ? points[row].y : points[row].z;
  });
}

py::array_t<std::int32_t> array_of(std::span<const std::array<std::uint32_t, 3>> triangles) {
  return filled<std::int32_t>(std::array{triangles.size(), std::size_t{3}},
                              [&](std::size_t row, std::size_t column) { return triangles[row][column]; });
}

}  // namespace ridgecraft::python
