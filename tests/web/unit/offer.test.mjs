// SPDX-License-Identifier: GPL-3.0-or-later
// What is offered lies next to what was clicked, not on it.
import assert from "node:assert/strict";
import {test} from "node:test";

import {placeBeside} from "../../../web/edit.js";

const size = [200, 220];
const screen = [1280, 800];
const covers = ([left, top], [a, b, c, d]) => left < c && left + size[0] > a && top < d && top + size[1] > b;

test("a box is in the window and covers neither the piece on its sheet nor that on the model", () => {
  for (let x = 300; x < 1200; x += 90) {
    for (let y = 40; y < 760; y += 90) {
      const sheet = [x - 60, y - 50, x + 80, y + 70];
      const model = [420, 300, 560, 420];
      const [left, top] = placeBeside([x, y], size, screen, [sheet, model]);
      assert.ok(left >= 8 && top >= 8 && left + size[0] <= 1272 && top + size[1] <= 792);
      assert.ok(!covers([left, top], sheet), `at ${[x, y]} a box at ${[left, top]} covers the piece`);
      assert.ok(!covers([left, top], model), `at ${[x, y]} a box at ${[left, top]} covers the piece of the model`);
    }
  }
});

test("where all is covered it is in the window all the same", () => {
  const [left, top] = placeBeside([640, 400], size, screen, [[0, 0, 1280, 800]]);
  assert.ok(left >= 8 && top >= 8);
});
