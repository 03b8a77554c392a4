// SPDX-License-Identifier: GPL-3.0-or-later
// The extension ridgecraft._core: what the package of Python around it calls.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "base/version.hpp"
#include "mesh/mesh.hpp"
#include "python/background.hpp"
#include "python/errors.hpp"
#include "python/nets.hpp"
#include "python/parts.hpp"
#include "python/polygons.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

/// The repaired surface of a file, in the file's unit.
py::tuple read(const std::string& file) {
  const mesh::Model model = result_in_background(
      [file](const Context& context) {
        return mesh::read(std::filesystem::path(file), {.collapse_flat_faces = false}, context);
      },
      {1, 1, std::nullopt, py::none()});
  const mesh::Surface& surface = model.surface;
  std::vector<Vec3> points(surface.points().begin(), surface.points().end());
  for (Vec3& p : points) {
    p = model.file_scale * p;
  }
  const auto faces = filled<std::int32_t>(
      std::array{surface.face_count(), std::size_t{3}}, [&](std::size_t face, std::size_t k) {
        return surface.vertex(mesh::corner(FaceId(face), static_cast<unsigned>(k))).value();
      });
  return py::make_tuple(array_of(points), faces);
}

}  // namespace
}  // namespace ridgecraft::python

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  using namespace py::literals;
  module.attr("__version__") = ridgecraft::version();
  ridgecraft::python::add_errors(module);
  ridgecraft::python::add_parts(module);
  ridgecraft::python::add_nets(module);
  module.def("read", &ridgecraft::python::read, "file"_a);
  ridgecraft::python::wait_for_left_work_at_exit();
}
