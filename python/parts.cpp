// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/parts.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.hpp"
#include "base/no_index.hpp"
#include "python/background.hpp"
#include "python/polygons.hpp"
#include "segment/hierarchy.hpp"
#include "segment/segment.hpp"
#include "segment/surface/segmentation.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

/// How a caller wants the parts.
struct PartsAsked {
  segment::Options options;
  std::optional<std::size_t> count;  ///< that many
};

segment::Options options_of(double concavity, int effort, std::optional<double> volume_weight, bool planes,
                            bool pockets, const std::string& holes, const std::string& components) {
  segment::Options options{.concavity = concavity,
                           .effort = effort,
                           .volume_weight = volume_weight,
                           .planes = planes,
                           .pockets = pockets};
  if (holes == "keep") {
    options.holes = segment::Options::Holes::keep;
  } else if (holes == "close") {
    options.holes = segment::Options::Holes::close;
  } else if (holes != "automatic") {
    throw Error(ErrorKind::usage, "holes is 'automatic', 'keep' or 'close', not '" + holes + "'");
  }
  if (components == "tied") {
    options.components = segment::Options::Components::tied;
  } else if (components != "apart") {
    throw Error(ErrorKind::usage, "components is 'apart' or 'tied', not '" + components + "'");
  }
  if (effort < 1 || effort > 3) {
    throw Error(ErrorKind::usage, fmt::format("effort is 1, 2 or 3, not {}", effort));
  }
  return options;
}

segment::Segmentation parts_of_count(const mesh::Model& model, std::size_t count, const Context& context) {
  const segment::Hierarchy hierarchy =
      segment::find_hierarchy(model.surface, model.polygon.items(), count, context);
  if (count < hierarchy.fewest() || count > hierarchy.leaves) {
    throw Error(ErrorKind::usage, fmt::format("this model can be divided into {} to {} parts, not into {}",
                                              hierarchy.fewest(), hierarchy.leaves, count));
  }
  return hierarchy.parts(count);
}

segment::Segmentation find_parts(const mesh::Model& model, const PartsAsked& asked, const Context& context) {
  if (asked.count) {
    return parts_of_count(model, *asked.count, context);
  }
  return segment::segment(model.surface, model.polygon.items(), asked.options, context);
}

py::array_t<std::int32_t> labels_of(const std::vector<std::uint32_t>& labels) {
  return filled<std::int32_t>(std::array{labels.size()}, [&](std::size_t row, std::size_t /*column*/) {
    return labels[row] == no_index ? std::int64_t{-1} : std::int64_t{labels[row]};
  });
}

py::array_t<std::int32_t> segment_mesh(const py::object& vertices, const py::object& faces, double concavity,
                                       int effort, std::optional<std::size_t> parts,
                                       std::optional<double> volume_weight, bool planes, bool pockets,
                                       const std::string& holes, const std::string& components,
                                       const py::tuple& run) {
  const PartsAsked asked{options_of(concavity, effort, volume_weight, planes, pockets, holes, components),
                         parts};
  const auto mesh = std::make_shared<const Mesh>(mesh_of(vertices, faces));
  return labels_of(result_in_background(
      [mesh, asked](const Context& patient) {
        const Context context = until_deadline(patient);
        const mesh::Model model = model_of(*mesh, {.collapse_flat_faces = false}, context);
        return segment::polygon_labels(model, find_parts(model, asked, context));
      },
      run_settings(run)));
}

py::tuple hulls_of_mesh(const py::object& vertices, const py::object& faces, double concavity, int effort,
                        std::optional<std::size_t> parts, std::size_t max_hulls, std::size_t max_vertices,
                        std::optional<double> volume_weight, bool planes, bool pockets,
                        const std::string& holes, const std::string& components, const py::tuple& run) {
  constexpr std::size_t fewest_vertices = 8;
  if (max_vertices > 0 && max_vertices < fewest_vertices) {
    throw Error(ErrorKind::usage,
                fmt::format("max_vertices is 0 for any number, or at least 8, not {}", max_vertices));
  }
  const PartsAsked asked{options_of(concavity, effort, volume_weight, planes, pockets, holes, components),
                         parts};
  const auto mesh = std::make_shared<const Mesh>(mesh_of(vertices, faces));
  const solid::HullSet set = result_in_background(
      [mesh, asked, max_vertices, max_hulls](const Context& patient) {
        const Context context = until_deadline(patient);
        const mesh::Model model = model_of(*mesh, {.collapse_flat_faces = false}, context);
        solid::HullSet found =
            solid::model_hulls(model.surface, find_parts(model, asked, context),
                               {.max_vertices = max_vertices, .max_hulls = max_hulls}, context);
        for (solid::Body& body : found.bodies) {
          for (Vec3& p : body.points) {
            p = model.file_scale * p;
          }
        }
        return found;
      },
      run_settings(run));
  py::list hulls;
  for (const solid::Body& body : set.bodies) {
    hulls.append(py::make_tuple(array_of(body.points), array_of(body.triangles)));
  }
  if (set.fit.solid_volume == 0.0) {
    return py::make_tuple(hulls, py::none(), py::none());
  }
  return py::make_tuple(hulls, set.fit.union_volume / set.fit.solid_volume, set.fit.uncovered);
}

}  // namespace

void add_parts(py::module_& module) {
  using namespace py::literals;
  module.def("segment", &segment_mesh, "vertices"_a, "faces"_a, py::kw_only(), "concavity"_a, "effort"_a,
             "parts"_a, "volume_weight"_a, "planes"_a, "pockets"_a, "holes"_a, "components"_a, "run"_a);
  module.def("hulls", &hulls_of_mesh, "vertices"_a, "faces"_a, py::kw_only(), "concavity"_a, "effort"_a,
             "parts"_a, "max_hulls"_a, "max_vertices"_a, "volume_weight"_a, "planes"_a, "pockets"_a,
             "holes"_a, "components"_a, "run"_a);
}

}  // namespace ridgecraft::python
