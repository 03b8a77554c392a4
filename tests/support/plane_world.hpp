// SPDX-License-Identifier: GPL-3.0-or-later
// Where bodies fall: what tests with Debian's Bullet have in common.
#pragma once

#include <btBulletDynamicsCommon.h>

namespace ridgecraft::test {

/// A world with gravity, m/s2 downwards along z, and nothing in it but the plane z = 0. Bodies that are added
/// must be removed before they end.
struct PlaneWorld {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btStaticPlaneShape plane{{0, 0, 1}, 0};
  btRigidBody ground{btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane)};

  PlaneWorld() {
    world.setGravity({0, 0, btScalar(-9.81)});
    world.addRigidBody(&ground);
  }
  PlaneWorld(const PlaneWorld&) = delete;
  PlaneWorld& operator=(const PlaneWorld&) = delete;
  ~PlaneWorld() { world.removeRigidBody(&ground); }
};

}  // namespace ridgecraft::test
