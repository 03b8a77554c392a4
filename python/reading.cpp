// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/reading.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "mesh/reading/read_soup.hpp"
#include "python/background.hpp"
#include "python/polygons.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

/// The number of corners that every polygon has; none where they differ, or there are no polygons.
std::optional<std::size_t> common_corners(const mesh::Soup& soup) {
  std::optional<std::size_t> corners;
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    if (corners && *corners != soup.polygon(i).size()) {
      return std::nullopt;
    }
    corners = soup.polygon(i).size();
  }
  return corners;
}

/// m x k integers where all polygons have k corners, else a list of lists.
py::object faces_of(const mesh::Soup& soup) {
  if (const std::optional<std::size_t> corners = common_corners(soup)) {
    return filled<std::int32_t>(
        std::array{soup.polygon_count(), *corners},
        [&](std::size_t face, std::size_t corner) { return soup.polygon(face)[corner]; });
  }
  py::list faces;
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    py::list face;
    for (const std::uint32_t corner : soup.polygon(i)) {
      face.append(corner);
    }
    faces.append(face);
  }
  return faces;
}

py::tuple read(const std::string& file) {
  const mesh::Soup soup = result_in_background(
      [file](const Context& context) { return mesh::read_soup(std::filesystem::path(file), context); },
      {1, 1, std::nullopt, py::none()});
  return py::make_tuple(array_of(soup.points), faces_of(soup));
}

}  // namespace

void add_reading(py::module_& module) {
  using namespace py::literals;
  module.def("read", &read, "file"_a);
}

}  // namespace ridgecraft::python
