// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that differ from those that were printed are told, and only these.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {test} from "node:test";

import {readNets} from "../../../web/nets.js";
import {changedSheets, sheetKeys} from "../../../web/printed.js";

const text = readFileSync(new URL("../../golden/files/house.fold", import.meta.url), "utf8");
const keys = () => sheetKeys(readNets(text), "");

test("the same sheets are the same", () => {
  assert.equal(new Set(keys()).size, keys().length);
  assert.deepEqual(changedSheets(keys(), keys()), []);
  // Wherever among all sheets they come.
  assert.deepEqual(changedSheets(keys(), [...keys()].reverse()), []);
});

test("a piece that moves or has another name changes its sheet alone", () => {
  const before = keys();
  const moved = readNets(text);
  const [v] = moved.faces.slice(3 * moved.pieces[0].faces[0], 3 * moved.pieces[0].faces[0] + 1);
  moved.points[2 * v] += 1;
  assert.deepEqual(changedSheets(sheetKeys(moved, ""), before), [moved.pieces[0].page + 1]);
  const named = readNets(text);
  named.pieces[0].name = "C.1";
  assert.deepEqual(changedSheets(sheetKeys(named, ""), before), [named.pieces[0].page + 1]);
});

test("numbers of a sheet count, how many sheets there are doesn't", () => {
  const nets = readNets(text);
  const sheets = (number, pages) => JSON.stringify({pages: nets.pages.map(() => ({groups: [{id: "piece-A", texts: [[0, number, 1, 1, 3, 0]]}, {id: "page", texts: [[2, pages, 1, 1, 3, 0]]}]}))});
  const before = sheetKeys(nets, sheets("7", "1 / 3"));
  assert.deepEqual(changedSheets(sheetKeys(nets, sheets("7", "1 / 4")), before), []);
  assert.equal(changedSheets(sheetKeys(nets, sheets("8", "1 / 3")), before).length, nets.pages.length);
});
