// SPDX-License-Identifier: GPL-3.0-or-later
// The program's module under node, used like the program:
//   node program.mjs BUILD_FOLDER MODEL OUT_FOLDER SUFFIX[,SUFFIX...] [options]
// writes OUT_FOLDER/NAME.SUFFIX (NAME-N.svg and so on where there are several pages; the suffix -guide.pdf means the
// guide). Errors are printed and exited with as the program does it. Where RIDGECRAFT_TIMES is set, the processor's seconds
// of starting and of making paper are printed.
import {mkdirSync, readdirSync, readFileSync, statSync, writeFileSync} from "node:fs";
import {createRequire} from "node:module";
import {basename, dirname, join, parse, resolve} from "node:path";

const [build, model, out, suffixes, ...options] = process.argv.slice(2);
const require = createRequire(import.meta.url);
const start = require(resolve(build, "ridgecraft.js"));
const notes = [];
const seconds = () => process.cpuUsage().user / 1e6;
const core = await start({
  wasmBinary: readFileSync(join(build, "ridgecraft.wasm")),
  report: (kind, text) => kind === "note" && notes.push(text),
});
const started = seconds();

/** The model with the files that belong to it, as a page gets files that are dropped together. */
function put(file) {
  core.FS.mkdir("/project");
  core.FS.chdir("/project");
  core.FS.writeFile(basename(file), readFileSync(file));
  for (const name of readdirSync(dirname(file))) {
    const path = join(dirname(file), name);
    if (/\.(mtl|png|jpe?g)$/i.test(name) && statSync(path).isFile()) {
      core.FS.writeFile(name, readFileSync(path));
    }
  }
}

function answer() {
  const begin = core.ccall("ridgecraft_answer", "number", [], []);
  return Buffer.from(core.HEAPU8.subarray(begin, begin + core.ccall("ridgecraft_answer_size", "number", [], [])));
}

/** The answer of a call; where it fails, the program's sentence and exit code. */
function call(name, type, value) {
  const code = core.ccall(name, "number", [type], [value]);
  if (code !== 0) {
    console.error(`ridgecraft: ${answer().toString()}`);
    process.exit(code);
  }
  return answer();
}

put(model);
const code = core.ccall("ridgecraft_make", "number", ["string"], [JSON.stringify([basename(model), ...options])]);
for (const note of notes) {
  console.error(`note: ${note}`);
}
if (code !== 0) {
  console.error(`ridgecraft: ${answer().toString()}`);
  process.exit(code);
}
console.log(answer().toString());
if (process.env.RIDGECRAFT_TIMES) {
  console.error(`started ${started.toFixed(2)} s, made ${(seconds() - started).toFixed(2)} s`);
}
mkdirSync(out, {recursive: true});
for (const suffix of suffixes.split(",")) {
  const names = JSON.parse(call("ridgecraft_plan", "string", `${parse(model).name}${suffix}`).toString());
  for (const [i, name] of names.entries()) {
    writeFileSync(join(out, name), call("ridgecraft_write", "number", i));
  }
}
