// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the studio with what stands in its page: the program, samples, and perhaps a model to begin with.

import {byId} from "./panel.js";
import {Studio} from "./studio.js";
import {wishesOf} from "./wishes.js";
import {WorkerBackend} from "./worker_backend.js";

/** @param {string} base64 */
function bytesOf(base64) {
  const letters = atob(base64.trim());
  const bytes = new Uint8Array(letters.length);
  // A function for each of the module's three million letters would take half a second.
  for (let i = 0; i < letters.length; ++i) {
    bytes[i] = letters.charCodeAt(i);
  }
  return bytes;
}

/** @param {string} id */
const embedded = (id) => byId(id).textContent ?? "";

/** @returns {Promise<WebAssembly.Module>} */
async function unpackModule() {
  const packed = new Blob([bytesOf(embedded("module"))]).stream();
  // What is unpacked is compiled while the rest is being unpacked.
  return WebAssembly.compileStreaming(new Response(packed.pipeThrough(new DecompressionStream("gzip")),
    {headers: {"content-type": "application/wasm"}}));
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
