// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls as a physics engine takes them: dropped on a plane, they come to rest on it.
#include <memory>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <catch2/catch.hpp>

#include "segment/segment.hpp"
#include "solid/solid.hpp"
#include "support/plane_world.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {

TEST_CASE("Hulls dropped on a plane come to rest on it") {
  // An L on its foot; as one convex body its middle would lie elsewhere and the notch would be filled.
  const mesh::Surface l = test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {0, 0, 2}}, 2);
  const auto parts = segment::segment(l, {}, {}, Context{});
  REQUIRE(parts.parts.size() == 2);
  const auto bodies = solid::part_hulls(l, parts, {.max_vertices = 64}, Context{});
  const solid::MassProperties mass = *solid::mass_properties(l, Context{});

  test::PlaneWorld fall;
  btCompoundShape compound;
  std::vector<std::unique_ptr<btConvexHullShape>> shapes;
  const auto shifted = [&](Vec3 p) {
    const Vec3 q = p - mass.center;
    return btVector3(btScalar(q.x), btScalar(q.y), btScalar(q.z));
  };
  for (const solid::Body& body : bodies) {
    shapes.push_back(std::make_unique<btConvexHullShape>());
    for (const Vec3 p : body.points) {
      shapes.back()->addPoint(shifted(p), false);
    }
    shapes.back()->recalcLocalAabb();
    shapes.back()->setMargin(btScalar(0.001));
    compound.addChildShape(btTransform::getIdentity(), shapes.back().get());
  }
  const double height = 0.5;
  btDefaultMotionState state(
      btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(mass.center.z + height))));
  btVector3 inertia;
  compound.calculateLocalInertia(btScalar(mass.volume), inertia);
  btRigidBody thing(
      btRigidBody::btRigidBodyConstructionInfo(btScalar(mass.volume), &state, &compound, inertia));
  fall.world.addRigidBody(&thing);
  for (int step = 0; step < 480; ++step) {
    fall.world.stepSimulation(btScalar(1.0 / 120.0), 0);
  }
  CHECK(thing.getLinearVelocity().length() < btScalar(0.01));
  // It stands as it was dropped: its lowest points on the plane.
  CHECK(thing.getWorldTransform().getOrigin().z() == Approx(mass.center.z).margin(0.02));
  CHECK(thing.getWorldTransform().getRotation().getAngleShortestPath() < btScalar(0.02));
  fall.world.removeRigidBody(&thing);
}

}  // namespace ridgecraft
