// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the page of the studio, which web/bundle.cmake has made:
//   node studio.mjs FRAME.html MODULE_FOLDER SOURCE_FOLDER VERSION OUT.html
// with the worker's script, the samples to begin with and the module, all in one stream of LZMA, and what unpacks it.
import {execFileSync} from "node:child_process";
import {readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";

import {lettersOf} from "./letters.mjs";

const [frame, build, source, version, out] = process.argv.slice(2);
/** Each with its materials; the page has their names in words (web/studio_words.js). */
const samples = ["whale", "house", "fox_head", "rocket"];

/** Of LZMA: how many bits of the byte before a literal, and of the place of a literal and of others, are heeded. Code is what
 * these suit best; what unpacks is compiled for them. */
const [lc, lp, pb] = [4, 0, 0];

const text = (...path) => readFileSync(join(...path), "utf8");
const files = Object.fromEntries(samples.map((name) => [name, Object.fromEntries([`${name}.obj`, `${name}.mtl`]
  .map((file) => [file, text(source, "samples", file)]))]));
const parts = [Buffer.from(text(build, "ridgecraft.js") + text(source, "web", "worker.js")), Buffer.from(JSON.stringify(files)),
  readFileSync(join(build, "ridgecraft.wasm"))];
const all = join(build, "studio.parts");
writeFileSync(all, Buffer.concat(parts));
const packed = execFileSync("xz", ["--format=raw", `--lzma1=preset=9e,lc=${lc},lp=${lp},pb=${pb}`, "--stdout", all], {maxBuffer: 2 ** 26});

const [object, unpacker] = ["unpack.o", "unpack.wasm"].map((name) => join(build, name));
execFileSync("emcc", ["-O2", `-DLC=${lc}`, `-DLP=${lp}`, `-DPB=${pb}`, "-c", join(source, "wasm", "unpack.c"), "-o", object]);
execFileSync("wasm-ld", ["--no-entry", "--strip-all", "-z", "stack-size=4096", object, "-o", unpacker]);
execFileSync("wasm-opt", ["-O2", unpacker, "-o", unpacker]);

const data = `<script type="text/plain" id="unpacker">${readFileSync(unpacker).toString("base64")}</script>
<script type="text/plain" id="packed" data-sizes="${parts.map(({length}) => length).join(" ")}">${lettersOf(packed)}</script>
<script type="application/json" id="start">{}</script>
`;

const page = text(frame);
for (const place of ["@DATA@", "@PRODUCER@"]) {
  if (page.split(place).length !== 2) {
    throw new Error(`${frame} has no single ${place}`);
  }
}
writeFileSync(out, page.replace("@PRODUCER@", () => `Ridgecraft ${version}`).replace("@DATA@", () => data));
