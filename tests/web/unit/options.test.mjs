// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the panel and words of a command line stand for each other.
import assert from "node:assert/strict";
import {test} from "node:test";

import {hashOf, optionsIn, optionsOf, optionTable, wordsOf} from "../../../web/options.js";

/** A value that isn't the usual one. */
function valueOf({kind, usual, choices}) {
  return kind === "flag" ? !usual : kind === "choice" ? choices.find((choice) => choice !== usual && choice !== "") : "12";
}

test("what options say to the program, they are read from again", () => {
  for (const option of optionTable) {
    const asked = {[option.key]: valueOf(option)};
    assert.deepEqual(optionsOf(wordsOf(asked)), {options: asked, rest: []}, option.key);
  }
  const all = Object.fromEntries(optionTable.map((option) => [option.key, valueOf(option)]));
  assert.deepEqual(optionsOf(wordsOf(all)).options, all);
});

test("usual values say nothing to the program", () => {
  assert.deepEqual(wordsOf({}), []);
  assert.deepEqual(wordsOf(Object.fromEntries(optionTable.map(({key, usual}) => [key, usual]))), []);
});

test("an option that stands for another is that one", () => {
  assert.deepEqual(optionsOf(["--no-tabs"]), {options: {tabs: "none"}, rest: []});
});

test("words that are no options are passed on, in their order", () => {
  assert.deepEqual(optionsOf(["--unknown", "--size=20cm", "x"]), {options: {size: "20cm"}, rest: ["--unknown", "x"]});
});

test("options are in an address and come out of it", () => {
  const options = {size: "180", paper: "A3", only: "roof; door", keep_bodies: true, tabs: "none"};
  const hash = hashOf(options);
  assert.ok(/^#o=[\w%.-]+$/.test(hash), hash);
  assert.deepEqual(optionsIn(hash), options);
  assert.deepEqual(optionsIn(""), {});
  assert.deepEqual(optionsIn("#o=--nonsense%0A--paper%3DA5"), {paper: "A5"});
});
