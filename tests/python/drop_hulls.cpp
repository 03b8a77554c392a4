// SPDX-License-Identifier: GPL-3.0-or-later
// drop_hulls < HULLS: a body of convex hulls as Debian's Bullet loads it. Read are numbers: how many hulls
// there are, then of each how many points and these; how many points of the model there are, and these.
// Printed are the number of shapes, the points of the model that lie outside all of them, and the speed of
// the body after it was dropped on a plane.
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btConvexPolyhedron.h>
#include <btBulletDynamicsCommon.h>

#include "support/plane_world.hpp"

namespace {

std::vector<btVector3> read_points() {
  std::size_t count = 0;
  std::cin >> count;
  std::vector<btVector3> points(count);
  for (btVector3& point : points) {
    double x = 0.0, y = 0.0, z = 0.0;
    std::cin >> x >> y >> z;
    point = btVector3(btScalar(x), btScalar(y), btScalar(z));
  }
  return points;
}

/// Bullet finds the faces of a hull on a grid of ten thousand steps: a point may be so far outside, as a
/// share of the model's extent.
constexpr btScalar slack = btScalar(3e-4);

bool holds(const btConvexPolyhedron& body, const btVector3& point, btScalar extent) {
  for (int face = 0; face < body.m_faces.size(); ++face) {
    const btScalar* const plane = body.m_faces[face].m_plane;
    if (btVector3(plane[0], plane[1], plane[2]).dot(point) + plane[3] > slack * extent) {
      return false;
    }
  }
  return body.m_faces.size() > 0;
}

}  // namespace

int main() {
  std::size_t count = 0;
  std::cin >> count;
  btCompoundShape compound;
  std::vector<std::unique_ptr<btConvexHullShape>> shapes;
  btScalar lowest = BT_LARGE_FLOAT, extent = 0;
  for (std::size_t hull = 0; hull < count; ++hull) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (const btVector3& point : read_points()) {
      shape->addPoint(point, false);
      lowest = std::min(lowest, point.z());
      extent = std::max(extent, point.length());
    }
    shape->recalcLocalAabb();
    shape->setMargin(slack * extent);
    shape->initializePolyhedralFeatures();
    compound.addChildShape(btTransform::getIdentity(), shape.get());
    shapes.push_back(std::move(shape));
  }
  const std::vector<btVector3> model = read_points();
  if (!std::cin) {
    std::cerr << "the numbers end too early\n";
    return 1;
  }
  const auto outside = std::count_if(model.begin(), model.end(), [&](const btVector3& point) {
    return std::none_of(shapes.begin(), shapes.end(), [&](const auto& shape) {
      return holds(*shape->getConvexPolyhedron(), point, extent);
    });
  });

  ridgecraft::test::PlaneWorld fall;
  btDefaultMotionState state(
      btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.05) * extent - lowest)));
  btVector3 inertia;
  compound.calculateLocalInertia(1, inertia);
  btRigidBody::btRigidBodyConstructionInfo about(1, &state, &compound, inertia);
  about.m_angularDamping = about.m_linearDamping = btScalar(0.2);
  btRigidBody body(about);
  body.setFriction(1);
  body.setRollingFriction(btScalar(0.05));
  fall.ground.setFriction(1);
  fall.ground.setRollingFriction(1);
  fall.world.addRigidBody(&body);
  constexpr int steps = 240 * 20;
  for (int step = 0; step < steps; ++step) {
    fall.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  }
  std::cout << shapes.size() << ' ' << outside << ' ' << body.getLinearVelocity().length() << ' '
            << body.getWorldTransform().getOrigin().z() << '\n';
  fall.world.removeRigidBody(&body);
}
