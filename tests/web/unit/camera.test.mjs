// SPDX-License-Identifier: GPL-3.0-or-later
// The eye: what is to be seen is in the picture from every side, and zooming keeps the point under the pointer.
import assert from "node:assert/strict";
import {test} from "node:test";

import {Camera, roomBetween} from "../../../web/camera.js";

const room = {x: 30, z: -20, low: 0, high: 150, radius: 80, width: 160, depth: 160};

function cameraAt(azimuth, elevation, width, height) {
  const camera = new Camera();
  Object.assign(camera, {azimuth, elevation, width, height, room});
  camera.update();
  return camera;
}

/** Points of the room's cylinder. */
function* border() {
  for (let k = 0; k < 36; ++k) {
    const angle = (k * Math.PI) / 18;
    for (const y of [room.low, room.high]) {
      yield [room.x + room.radius * Math.cos(angle), y, room.z + room.radius * Math.sin(angle)];
    }
  }
}

test("the room is in view from all sides, in any window", () => {
  for (const [width, height] of [[800, 600], [300, 900], [1600, 300]]) {
    for (let azimuth = -3; azimuth <= 3; azimuth += 0.75) {
      for (const elevation of [-1.4, -0.5, 0, 0.32, 1.4]) {
        const camera = cameraAt(azimuth, elevation, width, height);
        for (const [x, y, z] of border()) {
          const [px, py] = camera.project(x, y, z);
          assert.ok(px >= -0.5 && px <= width + 0.5 && py >= -0.5 && py <= height + 0.5,
            `${[x, y, z]} is at ${[px, py]} of ${width} x ${height}, from ${azimuth}, ${elevation}`);
        }
      }
    }
  }
});

test("the room's middle stays under a pointer that zooms at it", () => {
  const camera = cameraAt(0.4, 0.3, 800, 600);
  const middle = [room.x, 0.5 * (room.low + room.high), room.z];
  const [x, y] = camera.project(...middle);
  camera.zoomAt(1.7, x, y);
  camera.update();
  const [nx, ny] = camera.project(...middle);
  assert.ok(Math.hypot(nx - x, ny - y) < 1, `${[x, y]} became ${[nx, ny]}`);
});

test("between two rooms are both ends", () => {
  const other = {x: 0, z: 0, low: -5, high: 5, radius: 10, width: 20, depth: 20};
  assert.deepEqual(roomBetween(room, other, 0), room);
  assert.deepEqual(roomBetween(room, other, 1), other);
});
