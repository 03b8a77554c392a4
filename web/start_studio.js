// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the studio with what stands in its page: the program, samples, and perhaps a model to begin with.

import {byId} from "./panel.js";
import {Studio} from "./studio.js";
import {wishesOf} from "./wishes.js";
import {WorkerBackend} from "./worker_backend.js";

/** @param {string} base64 */
function bytesOf(base64) {
  return Uint8Array.from(atob(base64.trim()), (letter) => letter.charCodeAt(0));
}

/** @param {string} id */
const embedded = (id) => byId(id).textContent ?? "";

/** @returns {Promise<WebAssembly.Module>} */
async function unpackModule() {
  const packed = new Blob([bytesOf(embedded("module"))]).stream();
  const bytes = await new Response(packed.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  return WebAssembly.compile(bytes);
}

function startStudio() {
  const version = document.querySelector("meta[name=generator]")?.getAttribute("content") ?? "";
  const backend = new WorkerBackend(embedded("program"), unpackModule(), version);
  const studio = new Studio(backend, JSON.parse(embedded("sample-files")));
  Object.assign(globalThis, {ridgecraft: {inspect: (/** @type {any} */ about) => studio.inspect(about),
    export: (/** @type {string} */ format) => backend.export(format)}});
  const start = JSON.parse(embedded("start"));
  if (start.name) {
    const beside = Object.fromEntries(Object.entries(start.files).map(([name, bytes]) => [name, bytesOf(String(bytes))]));
    const {[start.name]: model, ...others} = beside;
    const {options, rest} = wishesOf(start.words ?? []);
    studio.open(start.name, model, others, options, rest);
  }
}

startStudio();
