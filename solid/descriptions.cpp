// SPDX-License-Identifier: GPL-3.0-or-later
// Descriptions of rigid bodies, as simulators read them.
#include <string>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/encodings.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

/// "--" ends an XML comment.
std::string in_comment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
    text.replace(at, 2, "- -");
  }
  return text;
}

/// In kilograms and metres.
MassProperties in_metres(const RigidBody& body) {
  const double scale = body.metres_per_unit;
  MassProperties mass = body.mass;
  mass.volume *= body.density * elementary::pow(scale, 3.0);
  mass.center = scale * mass.center;
  for (double& i : mass.inertia) {
    i *= body.density * elementary::pow(scale, 5.0);
  }
  return mass;
}

std::string urdf_geometry(const std::string& file, double scale) {
  return fmt::format("      <geometry><mesh filename=\"{}\" scale=\"{} {} {}\"/></geometry>\n",
                     xml_escaped(file), scale, scale, scale);
}

}  // namespace

std::string write_urdf(const RigidBody& body) {
  const double scale = body.metres_per_unit;
  const MassProperties mass = in_metres(body);
  const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
  const std::string name = xml_escaped(body.name);
  std::string text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {} -->\n<robot name=\"{}\">\n",
                  in_comment(body.comment), name);
  text += fmt::format("  <link name=\"{}\">\n", name);
  text += fmt::format("    <inertial>\n      <origin xyz=\"{} {} {}\"/>\n      <mass value=\"{}\"/>\n",
                      mass.center.x, mass.center.y, mass.center.z, mass.volume);
  text += fmt::format(
      "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n    </inertial>\n",
      xx, xy, xz, yy, yz, zz);
  text += "    <visual>\n" + urdf_geometry(body.visual_file, scale) + "    </visual>\n";
  for (const std::string& file : body.mesh_files) {
    text += "    <collision>\n" + urdf_geometry(file, scale) + "    </collision>\n";
  }
  return text + "  </link>\n</robot>\n";
}

std::string write_mjcf(const RigidBody& body) {
  const double scale = body.metres_per_unit;
  const MassProperties mass = in_metres(body);
  const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
  const std::string name = xml_escaped(body.name);
  const auto mesh = [&](const std::string& called, const std::string& file, const char* more) {
    return fmt::format("    <mesh name=\"{}\" file=\"{}\" scale=\"{} {} {}\"{}/>\n", called,
                       xml_escaped(file), scale, scale, scale, more);
  };
  std::string assets = mesh("visual", body.visual_file, " inertia=\"shell\"");
  std::string geoms = "      <geom class=\"visual\" mesh=\"visual\"/>\n";
  std::size_t number = 0;
  for (const std::string& file : body.mesh_files) {
    const std::string hull = fmt::format("hull_{}", ++number);
    assets += mesh(hull, file, "");
    geoms += fmt::format("      <geom class=\"collision\" name=\"{}\" mesh=\"{}\"/>\n", hull, hull);
  }
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {} -->\n<mujoco model=\"{}\">\n"
             // Without it two meshes touch in one point, and piles topple.
             "  <option><flag multiccd=\"enable\"/></option>\n"
             "  <default>\n"
             "    <default class=\"visual\"><geom type=\"mesh\" contype=\"0\" conaffinity=\"0\" group=\"2\" "
             "mass=\"0\"/></default>\n"
             "    <default class=\"collision\"><geom type=\"mesh\" group=\"3\"/></default>\n"
             "  </default>\n",
             in_comment(body.comment), name) +
         "  <asset>\n" + assets + "  </asset>\n  <worldbody>\n" +
         fmt::format("    <body name=\"{}\">\n      <freejoint/>\n", name) +
         fmt::format("      <inertial pos=\"{} {} {}\" mass=\"{}\" fullinertia=\"{} {} {} {} {} {}\"/>\n",
                     mass.center.x, mass.center.y, mass.center.z, mass.volume, xx, yy, zz, xy, xz, yz) +
         geoms + "    </body>\n  </worldbody>\n</mujoco>\n";
}

std::string write_sdf(const RigidBody& body) {
  const double scale = body.metres_per_unit;
  const MassProperties mass = in_metres(body);
  const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
  const std::string name = xml_escaped(body.name);
  const auto element = [&](const char* kind, const std::string& called, const std::string& file) {
    return fmt::format(
        "      <{} name=\"{}\">\n        <geometry><mesh><uri>{}</uri><scale>{} {} "
        "{}</scale></mesh></geometry>\n"
        "      </{}>\n",
        kind, called, xml_escaped(file), scale, scale, scale, kind);
  };
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {} -->\n<sdf version=\"1.9\">\n"
      "  <model name=\"{}\">\n    <link name=\"link\">\n",
      in_comment(body.comment), name);
  text += fmt::format(
      "      <inertial>\n        <pose>{} {} {} 0 0 0</pose>\n        <mass>{}</mass>\n        <inertia>"
      "<ixx>{}</ixx><ixy>{}</ixy><ixz>{}</ixz><iyy>{}</iyy><iyz>{}</iyz><izz>{}</izz></inertia>\n"
      "      </inertial>\n",
      mass.center.x, mass.center.y, mass.center.z, mass.volume, xx, xy, xz, yy, yz, zz);
  text += element("visual", "visual", body.visual_file);
  std::size_t number = 0;
  for (const std::string& file : body.mesh_files) {
    text += element("collision", fmt::format("hull_{}", ++number), file);
  }
  return text + "    </link>\n  </model>\n</sdf>\n";
}

}  // namespace ridgecraft::solid
