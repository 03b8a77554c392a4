// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies in files that hold their meshes: USD and GLB.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/encodings.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Turns two axes so that the moment between them vanishes (Jacobi; Golub, Van Loan, "Matrix Computations",
/// section 8.5). `axes`: columns.
void turn(std::size_t p, std::size_t q, Matrix& moments, Matrix& axes) {
  const double between = moments[p][q];
  if (between == 0.0) {
    return;
  }
  const double tau = (moments[q][q] - moments[p][p]) / (2.0 * between);
  const double tangent = (tau < 0.0 ? -1.0 : 1.0) / (std::fabs(tau) + std::sqrt(1.0 + tau * tau));
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const double sine = tangent * cosine;
  const auto turned = [&](double& a, double& b) {
    const double first = cosine * a - sine * b;
    b = sine * a + cosine * b;
    a = first;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    turned(moments[k][p], moments[k][q]);
    turned(axes[k][p], axes[k][q]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    turned(moments[p][k], moments[q][k]);
  }
}

/// Of a rotation matrix whose columns are axes (Shepperd, "Quaternion from rotation matrix", Journal of
/// Guidance and Control 1, 1978).
std::array<double, 4> quaternion_of(const Matrix& m) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  const std::array<double, 4> size{trace, m[0][0], m[1][1], m[2][2]};
  const auto largest = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  std::array<double, 4> q{};
  if (largest == 0) {
    q = {1.0 + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
  } else {
    const std::size_t i = largest - 1;
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    q[0] = m[k][j] - m[j][k];
    q[1 + i] = 1.0 + m[i][i] - m[j][j] - m[k][k];
    q[1 + j] = m[j][i] + m[i][j];
    q[1 + k] = m[k][i] + m[i][k];
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) {
    x /= length;
  }
  return q;
}

/// USD's names are letters, digits and underscores.
std::string identifier(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    result += letter || (digit && !result.empty()) ? c : '_';
  }
  return result.empty() ? "body" : result;
}

std::string usd_mesh(const std::string& name, const Body& body, const char* schemas, const char* more) {
  std::string counts;
  std::string indices;
  std::string points;
  for (const auto& [a, b, c] : body.triangles) {
    const char* separator = counts.empty() ? "" : ", ";
    counts += fmt::format("{}3", separator);
    indices += fmt::format("{}{}, {}, {}", separator, a, b, c);
  }
  for (const Vec3 p : body.points) {
    points += fmt::format("{}({}, {}, {})", points.empty() ? "" : ", ", static_cast<float>(p.x),
                          static_cast<float>(p.y), static_cast<float>(p.z));
  }
  return fmt::format(
      "\n    def Mesh \"{}\"{}\n    {{\n        int[] faceVertexCounts = [{}]\n"
      "        int[] faceVertexIndices = [{}]\n        point3f[] points = [{}]\n"
      "        uniform token subdivisionScheme = \"none\"\n{}    }}\n",
      name, schemas, counts, indices, points, more);
}

/// What a GLB's binary part holds, and the lists that describe it.
class GlbMeshes {
 public:
  explicit GlbMeshes(double metres_per_unit) : scale_(metres_per_unit) {}

  /// Adds a mesh; its number.
  std::size_t add(const Body& body) {
    std::array<float, 3> low{INFINITY, INFINITY, INFINITY};
    std::array<float, 3> high{-INFINITY, -INFINITY, -INFINITY};
    const std::size_t points_at = bytes_.size();
    for (const Vec3 p : body.points) {
      const std::array<double, 3> coordinates{p.x, p.y, p.z};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto x = static_cast<float>(scale_ * coordinates[k]);
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
        std::uint32_t word = 0;
        std::memcpy(&word, &x, sizeof word);
        put(word);
      }
    }
    const std::size_t indices_at = bytes_.size();
    for (const auto& triangle : body.triangles) {
      for (const std::uint32_t i : triangle) {
        put(i);
      }
    }
    views_ += fmt::format(
        "{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":34962}},"
        "{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":34963}}",
        comma(), points_at, indices_at - points_at, indices_at, bytes_.size() - indices_at);
    accessors_ += fmt::format(
        "{}{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\",\"min\":[{},{},{}],"
        "\"max\":[{},{},{}]}},{{\"bufferView\":{},\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}",
        comma(), 2 * count_, body.points.size(), low[0], low[1], low[2], high[0], high[1], high[2],
        2 * count_ + 1, 3 * body.triangles.size());
    meshes_ += fmt::format("{}{{\"primitives\":[{{\"attributes\":{{\"POSITION\":{}}},\"indices\":{}}}]}}",
                           comma(), 2 * count_, 2 * count_ + 1);
    return count_++;
  }

  [[nodiscard]] std::string lists() const {
    return fmt::format(
        "\"meshes\":[{}],\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]",
        meshes_, accessors_, views_, bytes_.size());
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  [[nodiscard]] const char* comma() const { return count_ == 0 ? "" : ","; }
  void put(std::uint32_t word) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes_ += static_cast<char>((word >> shift) & 0xffU);
    }
  }

  double scale_;
  std::size_t count_ = 0;
  std::string bytes_;
  std::string views_;
  std::string accessors_;
  std::string meshes_;
};

std::string little_endian(std::size_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>((value >> shift) & 0xffU);
  }
  return bytes;
}

}  // namespace

PrincipalInertia principal_inertia(const std::array<double, 6>& inertia) {
  const auto& [xx, yy, zz, xy, xz, yz] = inertia;
  Matrix moments{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
  Matrix axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  constexpr int sweeps = 12;  // each squares what is off the diagonal: five are enough
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    turn(0, 1, moments, axes);
    turn(0, 2, moments, axes);
    turn(1, 2, moments, axes);
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return moments[a][a] < moments[b][b]; });
  PrincipalInertia result;
  Matrix sorted{};
  for (std::size_t i = 0; i < 3; ++i) {
    result.moments[i] = moments[order[i]][order[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      sorted[k][i] = axes[k][order[i]];
    }
  }
  // The third axis follows from the others, so that they are right-handed.
  for (std::size_t k = 0; k < 3; ++k) {
    sorted[k][2] =
        sorted[(k + 1) % 3][0] * sorted[(k + 2) % 3][1] - sorted[(k + 2) % 3][0] * sorted[(k + 1) % 3][1];
  }
  result.rotation = quaternion_of(sorted);
  return result;
}

std::string write_usd(const RigidBody& body, const Body& visual, const std::vector<Body>& hulls) {
  const double mass = body.density * elementary::pow(body.metres_per_unit, 3.0);
  const PrincipalInertia inertia = principal_inertia(body.mass.inertia);
  const auto& [w, x, y, z] = inertia.rotation;
  const std::string name = identifier(body.name);
  std::string text = fmt::format(
      "#usda 1.0\n(\n    doc = {}\n    defaultPrim = \"{}\"\n    kilogramsPerUnit = 1\n"
      "    metersPerUnit = {}\n    upAxis = \"Z\"\n)\n",
      json_string(body.comment), name, body.metres_per_unit);
  text += fmt::format(
      "\ndef Xform \"{}\" (\n    prepend apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]\n)\n{{\n"
      "    point3f physics:centerOfMass = ({}, {}, {})\n    float3 physics:diagonalInertia = ({}, {}, {})\n"
      "    float physics:mass = {}\n    quatf physics:principalAxes = ({}, {}, {}, {})\n",
      name, body.mass.center.x, body.mass.center.y, body.mass.center.z, mass * inertia.moments[0],
      mass * inertia.moments[1], mass * inertia.moments[2], mass * body.mass.volume, w, x, y, z);
  text += usd_mesh("visual", visual, "", "");
  std::size_t number = 0;
  for (const Body& hull : hulls) {
    text += usd_mesh(fmt::format("hull_{}", ++number), hull,
                     " (\n        prepend apiSchemas = [\"PhysicsCollisionAPI\", "
                     "\"PhysicsMeshCollisionAPI\"]\n    )",
                     "        uniform token physics:approximation = \"convexHull\"\n"
                     "        uniform token purpose = \"guide\"\n");
  }
  return text + "}\n";
}

std::string write_glb(const RigidBody& body, const Body& visual, const std::vector<Body>& hulls) {
  const double scale = body.metres_per_unit;
  const double per_unit = body.density * elementary::pow(scale, 3.0);
  const PrincipalInertia inertia = principal_inertia(body.mass.inertia);
  const auto& [w, x, y, z] = inertia.rotation;
  const auto moment = [&](std::size_t i) { return per_unit * scale * scale * inertia.moments[i]; };
  GlbMeshes meshes(scale);
  // Nodes: the body, what is seen of it, the colliders, and their meshes, which are in no scene.
  std::string children = "1";
  std::string colliders;
  std::string shapes;
  meshes.add(visual);
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    const std::size_t shape = 2 + hulls.size() + i;
    children += fmt::format(",{}", 2 + i);
    colliders += fmt::format(
        ",{{\"name\":\"hull_{}\",\"extensions\":{{\"KHR_physics_rigid_bodies\":{{\"collider\":{{\"geometry\":"
        "{{"
        "\"node\":{},\"convexHull\":true}}}}}}}}}}",
        i + 1, shape);
    shapes += fmt::format(",{{\"name\":\"hull_{}_mesh\",\"mesh\":{}}}", i + 1, meshes.add(hulls[i]));
  }
  std::string json = fmt::format(
      "{{\"asset\":{{\"generator\":{},\"version\":\"2.0\"}},\"extensionsUsed\":[\"KHR_physics_rigid_bodies\"]"
      ","
      "\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"name\":{},\"children\":[{}],\"extensions\":{"
      "{"
      "\"KHR_physics_rigid_bodies\":{{\"motion\":{{\"mass\":{},\"centerOfMass\":[{},{},{}],"
      "\"inertiaDiagonal\":[{},{},{}],\"inertiaOrientation\":[{},{},{},{}]}}}}}}}},"
      "{{\"name\":\"visual\",\"mesh\":0}}{}{}],{}}}",
      json_string(body.comment), json_string(body.name), children, per_unit * body.mass.volume,
      scale * body.mass.center.x, scale * body.mass.center.y, scale * body.mass.center.z, moment(0),
      moment(1), moment(2), x, y, z, w, colliders, shapes, meshes.lists());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return "glTF" + little_endian(2) + little_endian(28 + json.size() + meshes.bytes().size()) +
         little_endian(json.size()) + "JSON" + json + little_endian(meshes.bytes().size()) +
         std::string("BIN\0", 4) + meshes.bytes();
}

}  // namespace ridgecraft::solid
