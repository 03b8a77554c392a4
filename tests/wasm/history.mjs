// SPDX-License-Identifier: GPL-3.0-or-later
// Random edits and changes of options, undone to the beginning, and saved and opened on the way: the bytes of before. The page's
// side of the program (web/worker_backend.js) with its module, under node.
//   node history.mjs BUILD_FOLDER SOURCE_FOLDER COUNT MODEL...
// Exit code 77, which means skipped, where the module wasn't built (wasm/build.sh).
import assert from "node:assert/strict";
import {existsSync, readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {basename, join, resolve} from "node:path";

const [build, source, countText, ...models] = process.argv.slice(2);
if (!existsSync(join(build, "ridgecraft.wasm"))) {
  console.log(`skipped: there is no ${join(build, "ridgecraft.wasm")}; wasm/build.sh makes it`);
  process.exit(77);
}
const glue = createRequire(import.meta.url)(resolve(build, "ridgecraft.js"));
const workerSource = readFileSync(join(source, "web", "worker.js"), "utf8");

/** A worker in this thread: what it is told and what it answers are copied, as between threads. */
globalThis.Worker = class {
  constructor() {
    const self = {ridgecraft: glue, postMessage: (data) => setImmediate(() => this.ended || this.onmessage({data: structuredClone(data)}))};
    new Function("self", workerSource)(self);
    this.self = self;
  }
  postMessage(data) {
    const copy = data.module ? data : structuredClone(data);
    setImmediate(() => this.ended || this.self.onmessage({data: copy}));
  }
  terminate() {
    this.ended = true;
  }
};
const {faceOfPiece, placeOfPiece} = await import(join(source, "web/desk.js"));
const {modelEnds, readNets} = await import(join(source, "web/nets.js"));
const {optionsOf} = await import(join(source, "web/options.js"));
const {readProject} = await import(join(source, "web/project.js"));
const {Refusal, WorkerBackend} = await import(join(source, "web/worker_backend.js"));

const module = new WebAssembly.Module(readFileSync(join(build, "ridgecraft.wasm")));
let seed = 1;
const random = (below) => {
  seed = (Math.imul(seed, 1103515245) + 12345) >>> 0;
  return Math.floor((seed / 2 ** 32) * below);
};
const text = async (backend) => new TextDecoder().decode(await backend.export("fold"));

/** Something that a maker could do next. */
function change(backend, nets) {
  const kind = random(12);
  const edge = random(nets.edges.length);
  const piece = random(nets.pieces.length);
  const face = faceOfPiece(nets, piece);
  const edges = {0: "cut", 1: "cut", 2: "join", 3: "join", 4: "tab-from", 5: "no-tab"};
  if (edges[kind]) {
    return backend.apply([{kind: edges[kind], edge: modelEnds(nets, edge)}]);
  }
  return kind === 6 ? backend.apply([placeOfPiece(nets, piece, random(30) - 15, random(30) - 15, random(8) * 45)])
    : kind === 7 ? backend.apply([{kind: "retry", face, seed: random(100)}])
      : kind === 8 ? backend.apply([{kind: "pack", faces: [face]}])
        : kind === 9 ? backend.apply([{kind: "number"}])
          : kind === 10 ? backend.set({size: ["", "140", "150", "151", "160"][random(5)]})
            : backend.set([{paper: "A3"}, {paper: "A4"}, {ink: "lines"}, {ink: "colour"}, {tab_height: "4"}, {tab_height: "5"}][random(6)]);
}

async function test(model) {
  const beside = {};
  const mtl = model.replace(/\.\w+$/, ".mtl");
  if (existsSync(mtl)) {
    beside[basename(mtl)] = readFileSync(mtl);
  }
  const backend = new WorkerBackend("", Promise.resolve(module), "test");
  backend.address = "";
  let state = await backend.open(basename(model), readFileSync(model), beside);
  const first = await text(backend);
  const seen = [first];
  let refused = 0;
  let opened = 0;
  const count = Number(countText);
  for (let i = 0; i < count; ++i) {
    try {
      state = await change(backend, readNets(state.fold));
      seen.push(null);
      if (i % Math.ceil(count / 20) === 0) {
        seen[seen.length - 1] = await text(backend);
        const {name, files, words, steps} = await readProject({name: "x.ridgecraft", bytes: await backend.export("ridgecraft")});
        const other = new WorkerBackend("", Promise.resolve(module), "test");
        const {options, rest} = optionsOf(words);
        await other.open(name, files[name], files, options, rest, steps);
        assert.equal(await text(other), seen.at(-1), `${model}, ${i}: opened, other bytes`);
        ++opened;
      }
    } catch (error) {
      if (!(error instanceof Refusal)) {
        throw error;
      }
      ++refused;
    }
  }
  assert.equal(backend.history.moments.length, seen.length);
  for (let i = seen.length - 1; i >= 0; --i) {
    if (seen[i] !== null) {
      await backend.go(i);
      assert.equal(await text(backend), seen[i], `${model}: undone to step ${i}, other bytes`);
    }
  }
  const left = backend.history.moments.filter(({left: out}) => (out?.length ?? 0) > 0).length;
  console.log(`${basename(model)}: ${seen.length - 1} changes, ${refused} refused, ${opened} times saved and opened, ${left} moments with steps left out`);
}

const keep = setInterval(() => {}, 1000);
for (const model of models) {
  await test(model);
}
clearInterval(keep);
