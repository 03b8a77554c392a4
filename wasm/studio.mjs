// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the page of the studio, which web/bundle.sh has made:
//   node studio.mjs FRAME.html MODULE_FOLDER SOURCE_FOLDER VERSION OUT.html
// with the module, the worker's script, the languages and the samples to begin with, each packed as web/packed.js reads it.
import {execFileSync} from "node:child_process";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";
import {basename, join} from "node:path";

const [frame, build, source, version, out] = process.argv.slice(2);
/** Each with its materials; the page has their names in words (web/studio_words.js). */
const samples = ["whale", "house", "fox_head", "rocket"];

const text = (...path) => readFileSync(join(...path), "utf8");
const files = Object.fromEntries(samples.map((name) => [name, Object.fromEntries([`${name}.obj`, `${name}.mtl`]
  .map((file) => [file, text(source, "samples", file)]))]));
const folder = join(source, "web", "languages");
const languages = Object.fromEntries(readdirSync(folder).sort().map((file) => [basename(file, ".json"), JSON.parse(text(folder, file))]));
/** Zopfli takes half a minute for what zlib does in one second, and makes it a twentieth smaller. */
const deflated = (bytes) => {
  const file = join(build, "packed");
  writeFileSync(file, bytes);
  return execFileSync("zopfli", ["--zlib", "--i5", "-c", file], {maxBuffer: 2 ** 26});
};
/** Names of the top level stay: the module's glue is a function that the worker's script calls. */
const minified = (script) => execFileSync("esbuild", ["--minify", "--charset=utf8", "--log-level=warning"], {input: script, maxBuffer: 2 ** 26});
const packed = (id, bytes) => `<script type="text/plain" id="packed-${id}">${deflated(bytes).toString("base64")}</script>\n`;
const data = [packed("module", readFileSync(join(build, "ridgecraft.wasm"))),
  packed("program", minified(text(build, "ridgecraft.js") + text(source, "web", "worker.js"))),
  packed("languages", JSON.stringify(languages)), packed("samples", JSON.stringify(files)), '<script type="application/json" id="start">{}</script>'].join("");

const page = text(frame);
for (const place of ["@DATA@", "@PRODUCER@"]) {
  if (page.split(place).length !== 2) {
    throw new Error(`${frame} has no single ${place}`);
  }
}
writeFileSync(out, page.replace("@PRODUCER@", () => `Ridgecraft ${version}`).replace("@DATA@", () => data));
