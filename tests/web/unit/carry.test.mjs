// SPDX-License-Identifier: GPL-3.0-or-later
// Steps by hand mean the same place of a model after its size or its faces have changed.
import assert from "node:assert/strict";
import {test} from "node:test";

import {Carrier, isSameSurface} from "../../../web/carry.js";

/** A flat grid of n by n squares, two triangles each, of this size; `order` says how its points are numbered. */
function grid(n, size, order = (v) => v) {
  const points = new Float64Array(3 * (n + 1) ** 2);
  const at = (i, j) => order(i * (n + 1) + j, (n + 1) ** 2);
  for (let i = 0; i <= n; ++i) {
    for (let j = 0; j <= n; ++j) {
      points.set([(size * j) / n, (size * i) / n, 0], 3 * at(i, j));
    }
  }
  const faces = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      faces.push(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return {points, faces: Uint32Array.from(faces), at};
}
const place = (surface, v) => [...surface.points.subarray(3 * v, 3 * v + 3)];

test("the same surface at another size has the same names", () => {
  assert.ok(isSameSurface(grid(4, 150), grid(4, 151)));
  assert.ok(!isSameSurface(grid(4, 150), grid(5, 150)));
  assert.ok(!isSameSurface(grid(4, 150), {...grid(4, 150), points: grid(4, 150, (v, n) => n - 1 - v).points}));
});

test("edges are found by their place, whatever their points' numbers", () => {
  const [from, to] = [grid(4, 150), grid(4, 300, (v, n) => (7 * v) % n)];
  const carrier = new Carrier(from, to);
  for (const [a, b] of [[0, 1], [6, 7], [12, 18], [8, 13]]) {
    const [, p, q] = carrier.line(`cut ${a} ${b}`).split(" ").map(Number);
    assert.deepEqual([place(to, p), place(to, q)], [a, b].map((v) => place(from, v).map((x) => 2 * x)));
  }
  assert.equal(carrier.line("join 0 1; tab-from 6 7").split("; ").length, 2);
});

test("an edge that isn't there any more is carried nowhere", () => {
  assert.equal(new Carrier(grid(4, 150), grid(2, 150)).line("cut 6 7"), null);
  assert.equal(new Carrier(grid(4, 150), grid(2, 150)).line("cut 0 1; pin 0"), null);
});

test("a place keeps the piece where it lies, though another face tells where", () => {
  const [from, to] = [grid(4, 100), grid(4, 100, (v, n) => n - 1 - v)];
  // The first corner of face 0 at (50, 60), its first side turned by 30 degrees.
  const [verb, face, page, x, y, degrees] = new Carrier(from, to).line("place 0 2 50 60 30").split(" ");
  assert.deepEqual([verb, page], ["place", "2"]);
  const [c, d] = [0, 1].map((k) => place(to, to.faces[3 * face + k]));
  const [cos, sin] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
  assert.ok(Math.abs(Number(x) - (50 + cos * c[0] - sin * c[1])) < 1e-9 && Math.abs(Number(y) - (60 + sin * c[0] + cos * c[1])) < 1e-9);
  const turned = Math.atan2(d[1] - c[1], d[0] - c[0]) + Math.PI / 6;
  assert.ok(Math.abs(Math.cos((Number(degrees) * Math.PI) / 180) - Math.cos(turned)) < 1e-9);
});

test("verbs without places stay as they are", () => {
  assert.equal(new Carrier(grid(2, 1), grid(2, 2)).line("pack; number"), "pack; number");
});
