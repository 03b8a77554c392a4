// SPDX-License-Identifier: GPL-3.0-or-later
// What is dragged snaps to lie flush with its neighbours, or at the distance that pieces keep.
import assert from "node:assert/strict";
import {test} from "node:test";

import {snapOf} from "../../../web/drag.js";

const other = [100, 100, 140, 160];

test("edges that nearly meet lie flush", () => {
  assert.deepEqual(snapOf([101, 170, 131, 190], [other], 2), {dx: -1, dy: 0, lines: [[100, 100, 100, 190]]});
  assert.equal(snapOf([109.5, 170, 139.5, 190], [other], 2).dx, 0.5);
});

test("a neighbour keeps its distance", () => {
  const {dx, dy} = snapOf([141, 99.5, 171, 120], [other], 2);
  assert.ok(Math.abs(dx - 1.1) < 1e-9);
  assert.equal(dy, 0.5);
});

test("what is farther away stays where it is", () => {
  assert.deepEqual(snapOf([150, 170, 180, 190], [other], 2), {dx: 0, dy: 0, lines: []});
  assert.deepEqual(snapOf([150, 170, 180, 190], [], 2), {dx: 0, dy: 0, lines: []});
});
