// SPDX-License-Identifier: GPL-3.0-or-later
// What lights up for what is pointed at and chosen.
import assert from "node:assert/strict";
import {test} from "node:test";

import {Selection} from "../../../web/selection.js";

/** Piece 0 is joined to piece 1 by the edges 0 and 1; edge 2 is a fold of piece 2. */
const nets = {edges: [{join: 0}, {join: 0}, {join: -1}], joins: [{pieces: [0, 1], edges: [0, 1]}]};
const nothing = {pieces: [], edges: []};
const litBy = (selection, otherwise = nothing) => {
  const {pieces, edges} = selection.lit(otherwise);
  return [[...pieces], edges];
};

test("a second click takes the choice back", () => {
  for (const spot of [{piece: 2, edge: 2}, {piece: 1, edge: -1}]) {
    const selection = new Selection(nets);
    selection.choose(spot, false);
    assert.deepEqual(selection.single, spot);
    selection.choose(spot, false);
    assert.equal(selection.chosen.size, 0);
    assert.equal(selection.single, null);
  }
});

test("pieces are added to the choice and taken from it", () => {
  const selection = new Selection(nets);
  for (const piece of [0, 1, 2, 1]) {
    selection.choose({piece, edge: -1}, true);
  }
  assert.deepEqual(litBy(selection), [[0, 2], []]);
});

test("a seam lights both of its pieces and edges", () => {
  const selection = new Selection(nets);
  selection.hovered = {piece: 1, edge: 1};
  assert.deepEqual(litBy(selection), [[0, 1], [0, 1]]);
});

test("the guide's seams go before the pointer, the pointer before the choice, the choice before the step", () => {
  const selection = new Selection(nets);
  const step = {pieces: [1], edges: [1]};
  assert.deepEqual(litBy(selection, step), [[1], [1]]);
  selection.set([0]);
  assert.deepEqual(litBy(selection, step), [[0], []]);
  selection.hovered = {piece: 2, edge: 2};
  assert.deepEqual(litBy(selection, step), [[2], [2]]);
  selection.pointed = [0];
  assert.deepEqual(litBy(selection, step), [[0, 1], [0, 1]]);
});
