// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the studio with what stands in its page: the program, samples, and perhaps a model to begin with.

import {bytesOf, unpacked, unpackedText} from "./packed.js";
import {byId, tellBroken} from "./panel.js";
import {Studio} from "./studio.js";
import {optionsIn, optionsOf} from "./options.js";
import {addLanguage} from "./words.js";
import {WorkerBackend} from "./worker_backend.js";

/** @param {string} id */
const embedded = (id) => byId(id).textContent ?? "";

async function startStudio() {
  const version = document.querySelector("meta[name=generator]")?.getAttribute("content") ?? "";
  // The module is compiled while it is being unpacked.
  const module = WebAssembly.compileStreaming(new Response(unpacked(embedded("packed-module")), {headers: {"content-type": "application/wasm"}}));
  const [languages, program, samples] = await Promise.all(["languages", "program", "samples"].map((id) => unpackedText(embedded(`packed-${id}`))));
  Object.entries(JSON.parse(languages)).forEach(([code, language]) => addLanguage(code, language));
  const backend = new WorkerBackend(program, module, version);
  const studio = new Studio(backend, JSON.parse(samples));
  Object.assign(globalThis, {ridgecraft: {inspect: (/** @type {any} */ about) => studio.inspect(about),
    export: (/** @type {string} */ format) => backend.export(format)}});
  studio.linked = optionsIn(location.hash);
  const start = JSON.parse(embedded("start"));
  if (start.name) {
    const beside = Object.fromEntries(Object.entries(start.files).map(([name, bytes]) => [name, bytesOf(String(bytes))]));
    const {[start.name]: model, ...others} = beside;
    const {options, rest} = optionsOf(start.words ?? []);
    studio.open(start.name, model, others, options, rest);
  }
}

startStudio().catch((error) => {
  tellBroken(error);
  throw error;
});
