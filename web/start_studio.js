// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the studio with what stands in its page: the program, samples, and perhaps a model to begin with.

import {byId, tellBroken} from "./panel.js";
import {Studio} from "./studio.js";
import {Unpacker} from "./unpacker.js";
import {wishesOf} from "./wishes.js";
import {WorkerBackend} from "./worker_backend.js";

/** @param {string} base64 */
function bytesOf(base64) {
  const letters = atob(base64.trim());
  const bytes = new Uint8Array(letters.length);
  // A function for each letter of a model of some megabytes would take half a second.
  for (let i = 0; i < letters.length; ++i) {
    bytes[i] = letters.charCodeAt(i);
  }
  return bytes;
}

/** @param {string} id */
const embedded = (id) => byId(id).textContent ?? "";

async function startStudio() {
  const version = document.querySelector("meta[name=generator]")?.getAttribute("content") ?? "";
  const sizes = (byId("packed").dataset.sizes ?? "").split(" ").map(Number);
  const unpacker = await Unpacker.started(bytesOf(embedded("unpacker")), embedded("packed"), sizes.reduce((a, b) => a + b));
  const [program, samples] = sizes.slice(0, 2).map((size) => unpacker.text(size));
  // What is unpacked is compiled while the rest is being unpacked.
  const module = WebAssembly.compileStreaming(new Response(unpacker.rest(), {headers: {"content-type": "application/wasm"}}));
  const backend = new WorkerBackend(program, module, version);
  const studio = new Studio(backend, JSON.parse(samples));
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

startStudio().catch((error) => {
  tellBroken(error);
  throw error;
});
