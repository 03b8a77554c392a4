// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the page of the studio, which web/bundle.cmake has made:
//   node studio.mjs FRAME.html MODULE_FOLDER SOURCE_FOLDER VERSION OUT.html
// with the module (gzip, base64), the worker's script, and the samples to begin with.
import {readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {gzipSync} from "node:zlib";

const [frame, build, source, version, out] = process.argv.slice(2);
/** Each with its materials; the page has their names in words (web/studio_words.js). */
const samples = ["whale", "house", "fox_head", "rocket"];

/** JSON inside a script element: nothing in it ends the element. */
const json = (value) => JSON.stringify(value).replaceAll("<", "\\u003c");

/** A script as the text of an element that no browser runs: nothing in it may end the element. */
function script(text) {
  if (/<\/script|<!--/i.test(text)) {
    throw new Error("the worker's script holds what ends a script element");
  }
  return text;
}

const text = (...path) => readFileSync(join(...path), "utf8");
const files = Object.fromEntries(samples.map((name) => [name, Object.fromEntries([`${name}.obj`, `${name}.mtl`]
  .map((file) => [file, text(source, "samples", file)]))]));
const module = gzipSync(readFileSync(join(build, "ridgecraft.wasm")), {level: 9}).toString("base64");
const data = [
  ["program", "text/plain", script(text(build, "ridgecraft.js") + text(source, "web", "worker.js"))],
  ["sample-files", "application/json", json(files)],
  // cli/jobs/studio_job.cpp puts a model here.
  ["start", "application/json", "{}"],
  ["module", "text/plain", module],
].map(([id, type, content]) => `<script type="${type}" id="${id}">${content}</script>\n`).join("");

const page = text(frame);
for (const place of ["@DATA@", "@PRODUCER@"]) {
  if (page.split(place).length !== 2) {
    throw new Error(`${frame} has no single ${place}`);
  }
}
writeFileSync(out, page.replace("@PRODUCER@", () => `Ridgecraft ${version}`).replace("@DATA@", () => data));
