// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces on the desk are laid as soon as there is room for them, however they came there.
import assert from "node:assert/strict";
import {test} from "node:test";

import {Desk, movedPlace} from "../../../web/desk.js";

/** A shelf with places 0 to 9, each for one piece. */
function shelf(lying) {
  const now = new Map(lying);
  return {
    now,
    fits: async (places) => {
      const after = new Map([...now, ...places.map(({face, at: [x]}) => [face, x])]);
      return [...after.values()].every((x) => x >= 0 && x <= 9) && new Set(after.values()).size === after.size;
    },
    lay: (places) => places.forEach(({face, at: [x]}) => now.set(face, x)),
  };
}
const place = (face, x) => ({kind: "place", face, page: 1, at: [x, 0], degrees: 0});

/** Lets go of a piece as the studio does. */
async function letGo(desk, {fits, lay}, one) {
  const all = await desk.laid([one], fits);
  if (all) {
    lay(all);
    all.forEach(({face}) => desk.places.delete(face));
  } else {
    desk.leave([one], 0);
  }
}

test("two pieces on a full sheet change places", async () => {
  const desk = new Desk();
  const full = shelf(Array.from({length: 10}, (_, k) => [k, k]));
  await letGo(desk, full, place(0, 3));
  assert.deepEqual([...desk.places.keys()], [0]);
  await letGo(desk, full, place(3, 0));
  assert.equal(desk.places.size, 0);
  assert.deepEqual([full.now.get(0), full.now.get(3)], [3, 0]);
});

test("three go around, and what is beside the sheet waits", async () => {
  const desk = new Desk();
  const full = shelf(Array.from({length: 10}, (_, k) => [k, k]));
  await letGo(desk, full, place(7, 12));
  await letGo(desk, full, place(0, 1));
  await letGo(desk, full, place(1, 2));
  assert.equal(desk.places.size, 3);
  await letGo(desk, full, place(2, 0));
  assert.deepEqual([...desk.places.keys()], [7, 0, 1, 2], "with one beside the sheet a round of three isn't tried");
  await letGo(desk, full, place(7, 7));
  assert.deepEqual([...desk.places.keys()], []);
  assert.deepEqual([0, 1, 2, 7].map((face) => full.now.get(face)), [1, 2, 0, 7]);
});

test("random moves never lay two pieces on one place, and end when all have room", async () => {
  let seed = 7;
  const random = (n) => (seed = (seed * 48271) % 2147483647) % n;
  const desk = new Desk();
  const sheet = shelf([[0, 0], [1, 1], [2, 2], [3, 3], [4, 4], [5, 5]]);
  for (let k = 0; k < 400; ++k) {
    await letGo(desk, sheet, place(random(6), random(12) - 1));
    assert.equal(new Set(sheet.now.values()).size, 6);
  }
  for (let face = 0; face < 6; ++face) {
    await letGo(desk, sheet, place(face, 9 - face));
  }
  assert.equal(desk.places.size, 0);
  assert.deepEqual([...sheet.now.entries()].sort(([a], [b]) => a - b), Array.from({length: 6}, (_, face) => [face, 9 - face]));
});

test("the last one that was left is taken back first", () => {
  const desk = new Desk();
  desk.leave([place(1, 20)], 0);
  desk.leave([place(2, 20)], 0);
  desk.leave([place(1, 30)], 0);
  assert.ok(desk.takeBack());
  assert.deepEqual([...desk.places.keys()], [2]);
  assert.ok(desk.takeBack());
  assert.ok(!desk.takeBack());
});

test("places turn about a point, and come back", () => {
  let at = {...place(0, 10), at: [10, 20], degrees: 5};
  for (let k = 0; k < 4; ++k) {
    at = movedPlace(at, [30, 40], 0, 0, 90);
  }
  assert.deepEqual([at.at, at.degrees], [[10, 20], 365]);
  assert.deepEqual(movedPlace(at, [10, 0], 1, 2, 90).at, [-9, 2]);
});
