// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces on their pages: a place that is written down is the place where a piece lies.
import assert from "node:assert/strict";
import {test} from "node:test";

import {faceOfPiece, piecesWith, placeOfPiece} from "../../../web/desk.js";

/** Two triangles, each a piece of its own, on two pages whose corners are elsewhere in the plane of all nets. */
const nets = {
  points: Float64Array.from([10, 20, 40, 20, 10, 60, 310, 120, 310, 150, 270, 120]),
  faces: Uint32Array.from([0, 1, 2, 3, 4, 5]),
  facePiece: [0, 1],
  modelFace: [7, 3],
  pages: [{x: 0, y: 0, width: 210, height: 297}, {x: 250, y: 100, width: 210, height: 297}],
  pieces: [{page: 0, faces: [0], box: [10, 20, 40, 60]}, {page: 1, faces: [1], box: [270, 120, 310, 150]}],
};

test("a piece that isn't moved lies where it lies", () => {
  assert.deepEqual(placeOfPiece(nets, 0, 0, 0, 0), {kind: "place", face: 7, page: 1, at: [10, 20], degrees: 0});
  assert.deepEqual(placeOfPiece(nets, 1, 0, 0, 0), {kind: "place", face: 3, page: 2, at: [60, 20], degrees: 90});
});

test("a piece is moved in mm, to the right and up", () => {
  assert.deepEqual(placeOfPiece(nets, 0, 5, -3, 0).at, [15, 17]);
  assert.equal(placeOfPiece(nets, 0, 5, -3, 0, 1).page, 2);
});

test("four quarter turns about a piece's middle lead back", () => {
  const middle = [25, 40];
  for (const turns of [1, 2, 3]) {
    const {at, degrees} = placeOfPiece(nets, 0, 0, 0, 90 * turns);
    const [x, y] = [10 - middle[0], 20 - middle[1]];
    const [c, s] = [[0, 1], [-1, 0], [0, -1]][turns - 1];
    assert.deepEqual(at, [middle[0] + c * x - s * y, middle[1] + s * x + c * y]);
    assert.equal(degrees, 90 * turns);
  }
  assert.deepEqual(placeOfPiece(nets, 0, 0, 0, 360).at, [10, 20]);
});

test("a piece is found again by its face of the model", () => {
  for (const index of [0, 1]) {
    assert.deepEqual(piecesWith(nets, [faceOfPiece(nets, index)]), [index]);
  }
  assert.deepEqual(piecesWith(nets, [99]), []);
});
