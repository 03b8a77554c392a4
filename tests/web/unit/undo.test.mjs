// SPDX-License-Identifier: GPL-3.0-or-later
// Edits, undo and redo of a project, behind a worker that answers whatever it is asked.
import assert from "node:assert/strict";
import {test} from "node:test";

/** What all workers were asked, and how many there were. */
const asked = [];
let workers = 0;
let refusing = false;
let silent = false;
let leftOut = [];
globalThis.Worker = class {
  constructor() {
    ++workers;
  }
  postMessage({id, ...message}) {
    asked.push(message);
    const answer = refusing && message.call === "apply" ? {id, refused: {why: {code: "no_such_page", values: {}, text: ""}, faces: [3]}}
      : {id, fold: "{}", sheets: "", summary: {}, left_out: message.call === "repeat" ? leftOut : []};
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
  assert.deepEqual(backend.project.steps, ["cut 1 2", "cut 3 4"]);
  assert.deepEqual(lines(), ["cut 1 2", "cut 3 4"], "what is shown again isn't made again");
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
  assert.deepEqual(asked.at(-1), {call: "repeat", steps: ["cut 1 2"]});
  const before = workers;
  silent = true;
  const lost = backend.set({size: "30cm"});
  await new Promise((go) => setTimeout(go));
  silent = false;
  backend.cancel();
  await assert.rejects(lost, Cancelled);
  await backend.apply(cut(3, 4));
  assert.ok(workers > before);
  const made = asked.filter(({call}) => call === "make").at(-1);
  assert.deepEqual(made.words, ["cube.obj", "--size", "20cm"]);
  assert.deepEqual(asked.filter(({call}) => call === "repeat").at(-1).steps, ["cut 1 2"]);
  assert.deepEqual(backend.project.steps, ["cut 1 2", "cut 3 4"]);
});

test("options and edits are one history, and the program comes after", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  await backend.set({size: "151"});
  await backend.apply(cut(3, 4));
  await backend.apply(cut(5, 6));
  assert.deepEqual(backend.history.moments.map(({what}) => what.kind), ["open", "edits", "options", "edits", "edits"]);
  asked.length = 0;

  // Two edits back: the worker undoes them together.
  const two = await backend.go(2);
  assert.deepEqual([two.options, backend.project.steps], [{size: "151"}, ["cut 1 2"]]);
  assert.equal(asked.length, 0);
  await backend.catchUp();
  assert.deepEqual(asked, [{call: "undo", count: 2}]);

  // Over the change of an option: it makes the paper again, with the steps of then.
  const one = await backend.go(1);
  assert.deepEqual(one.options, {});
  await backend.catchUp();
  assert.deepEqual([asked.at(-2).words, asked.at(-1)], [["cube.obj"], {call: "repeat", steps: ["cut 1 2"]}]);

  // And forward to the end, in one go.
  await backend.go(4);
  await backend.catchUp();
  assert.deepEqual(asked.at(-1), {call: "repeat", steps: ["cut 1 2", "cut 3 4", "cut 5 6"]});
});

test("steps that options don't allow stay in the project, and come back with other options", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  await backend.apply(cut(3, 4));
  leftOut = [0];
  const {left} = await backend.set({size: "151"});
  leftOut = [];
  assert.deepEqual(left, ["cut 1 2"]);
  assert.deepEqual(backend.project.steps, ["cut 1 2", "cut 3 4"]);
  assert.deepEqual((await backend.set({size: ""})).left, []);
  assert.deepEqual(asked.at(-1).steps, ["cut 1 2", "cut 3 4"]);
});

test("a project that is restored goes on where it was", async () => {
  const backend = await opened();
  await backend.apply(cut(1, 2));
  await backend.set({size: "151"});
  await backend.undo();
  const saved = structuredClone(backend.saved());
  const other = await opened();
  const state = await other.restore(saved);
  assert.deepEqual([state.options, state.canUndo, state.canRedo, other.project.steps], [{}, true, true, ["cut 1 2"]]);
  assert.deepEqual((await other.redo()).options, {size: "151"});
  assert.deepEqual((await other.go(0)).canUndo, false);
  assert.deepEqual(other.project.steps, []);
});

test("a refusal that is about an edge outlines no pieces", () => {
  assert.deepEqual(Refusal.of({code: "closes_loop", values: {a: "A"}, text: ""}, [1, 2, 3]).faces, []);
  assert.deepEqual(Refusal.of({code: "would_overlap", values: {a: "A", b: "B"}, text: ""}, [1, 2, 3]).faces, [1, 2, 3]);
});
