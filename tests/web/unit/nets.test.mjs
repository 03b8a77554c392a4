// SPDX-License-Identifier: GPL-3.0-or-later
// Nets of a FOLD file fold back to the model, and faces are found where they lie on the sheets.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {test} from "node:test";

import {Folding} from "../../../web/folding.js";
import {faceOfPieceAt, readNets} from "../../../web/nets.js";
import {segmentDistance} from "../../../web/scene.js";

const nets = readNets(readFileSync(new URL("../../golden/files/house.fold", import.meta.url), "utf8"));

test("all pieces fold back to the model", () => {
  assert.ok(nets.pieces.length > 0);
  assert.ok(new Folding(nets).refoldError < 1e-4);
});

test("a face is found at its middle, and none outside of the pieces", () => {
  for (let f = 0; f < nets.facePiece.length; ++f) {
    const [x, y] = [0, 1].map((k) => [0, 1, 2].reduce((sum, c) => sum + nets.points[2 * nets.faces[3 * f + c] + k], 0) / 3);
    assert.equal(faceOfPieceAt(nets, nets.facePiece[f], x, y), f);
  }
  assert.equal(faceOfPieceAt(nets, 0, -1000, 0), -1);
});

test("each join has two edges of the same length", () => {
  for (const {edges: [a, b]} of nets.joins) {
    assert.ok(Math.abs(nets.edges[a].length - nets.edges[b].length) < 1e-6);
  }
});

test("the distance from a segment is to its nearest point", () => {
  assert.equal(segmentDistance(3, 4, [0, 0], [10, 0]), 4);
  assert.equal(segmentDistance(-3, 4, [0, 0], [10, 0]), 5);
  assert.equal(segmentDistance(3, 4, [0, 0], [0, 0]), 5);
});
