// SPDX-License-Identifier: GPL-3.0-or-later
// Edits, undo and redo of a project, behind a worker that answers whatever it is asked.
import assert from "node:assert/strict";
import {test} from "node:test";

/** What all workers were asked, and how many there were. */
const asked = [];
let workers = 0;
let refusing = false;
let silent = false;
globalThis.Worker = class {
  constructor() {
    ++workers;
  }
  postMessage({id, ...message}) {
    asked.push(message);
    const answer = refusing && message.call === "apply" ? {id, refused: {why: {code: "no_such_page", values: {}, text: ""}, faces: [3]}}
      : {id, fold: "{}", sheets: "", summary: {}};
    silent || setTimeout(() => this.ended || this.onmessage({data: answer}));
  }
  terminate() {
    this.ended = true;
  }
};
const {Cancelled, Refusal, WorkerBackend} = await import("../../../web/worker_backend.js");

async function opened() {
  const backend = new WorkerBackend("", Promise.resolve(null), "test");
  await backend.open("cube.obj", new Uint8Array(1));
  asked.length = 0;
  return backend;
}
const cut = (a, b) => [{kind: "cut", edge: [a, b]}];
const lines = () => asked.filter(({call}) => call === "apply").map(({line}) => line);

test("what is undone is done again, the last edit first", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  await backend.apply(cut(3, 4));
  await backend.undo();
  const {canUndo, canRedo} = await backend.undo();
  assert.deepEqual([canUndo, canRedo], [false, true]);
  await backend.redo();
  const state = await backend.redo();
  assert.deepEqual([state.canUndo, state.canRedo], [true, false]);
  assert.deepEqual(lines(), ["cut 1 2", "cut 3 4", "cut 1 2", "cut 3 4"]);
  assert.deepEqual(backend.project.steps, ["cut 1 2", "cut 3 4"]);
});

test("a new edit forgets what was undone", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  await backend.undo();
  assert.equal((await backend.apply(cut(5, 6))).canRedo, false);
  assert.deepEqual(backend.project.steps, ["cut 5 6"]);
});

test("a refused edit changes nothing", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  refusing = true;
  await assert.rejects(backend.apply(cut(3, 4)), (error) => error instanceof Refusal && error.faces[0] === 3);
  refusing = false;
  assert.deepEqual(backend.project.steps, ["cut 1 2"]);
});

test("options keep the edits, and so does a worker that is ended", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  await backend.set({size: "20cm"});
  assert.deepEqual(asked.at(-1).steps, ["cut 1 2"]);
  const before = workers;
  silent = true;
  const lost = backend.undo();
  await new Promise((go) => setTimeout(go));
  silent = false;
  backend.cancel();
  await assert.rejects(lost, Cancelled);
  await backend.apply(cut(3, 4));
  assert.ok(workers > before);
  const made = asked.filter(({call}) => call === "make").at(-1);
  assert.deepEqual([made.steps, made.words], [["cut 1 2"], ["cube.obj", "--size", "20cm"]]);
  assert.deepEqual(backend.project.steps, ["cut 1 2", "cut 3 4"]);
});
