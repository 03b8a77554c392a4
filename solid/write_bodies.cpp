// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/write_bodies.hpp"

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/xml_text.hpp"

namespace ridgecraft::solid {
namespace {

/// "--" ends an XML comment.
std::string in_comment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
    text.replace(at, 2, "- -");
  }
  return text;
}

std::string geometry(const std::string& file, double scale) {
  return fmt::format("      <geometry><mesh filename=\"{}\" scale=\"{} {} {}\"/></geometry>\n",
                     xml_escaped(file), scale, scale, scale);
}

}  // namespace

std::string write_obj(const std::vector<Body>& bodies, std::string_view comment) {
  std::string text = fmt::format("# {}\n", comment);
  std::size_t first = 1;
  std::size_t number = 0;
  for (const Body& body : bodies) {
    text += fmt::format("o hull_{}\n", ++number);
    for (const Vec3 p : body.points) {
      text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : body.triangles) {
      text += fmt::format("f {} {} {}\n", first + a, first + b, first + c);
    }
    first += body.points.size();
  }
  return text;
}

std::string write_urdf(const std::vector<Body>& bodies, const UrdfOptions& options) {
  RIDGECRAFT_ASSERT(bodies.size() == options.mesh_files.size());
  const MassProperties of_units = mass_properties(bodies);
  const double scale = options.metres_per_unit;
  const double mass = options.density * of_units.volume * elementary::pow(scale, 3.0);
  const Vec3 center = scale * of_units.center;
  const double inertia_scale = options.density * elementary::pow(scale, 5.0);
  const auto inertia = [&](std::size_t i) { return inertia_scale * of_units.inertia[i]; };
  std::string text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {} -->\n<robot name=\"{}\">\n",
                  in_comment(options.comment), xml_escaped(options.name));
  text += fmt::format("  <link name=\"{}\">\n", xml_escaped(options.name));
  text += fmt::format("    <inertial>\n      <origin xyz=\"{} {} {}\"/>\n      <mass value=\"{}\"/>\n",
                      center.x, center.y, center.z, mass);
  text += fmt::format(
      "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n    </inertial>\n",
      inertia(0), inertia(3), inertia(4), inertia(1), inertia(5), inertia(2));
  text += "    <visual>\n" + geometry(options.visual_file, scale) + "    </visual>\n";
  for (const std::string& file : options.mesh_files) {
    text += "    <collision>\n" + geometry(file, scale) + "    </collision>\n";
  }
  return text + "  </link>\n</robot>\n";
}

}  // namespace ridgecraft::solid
