// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the program gives the same bytes as itself in WebAssembly:
//   node same_bytes.mjs WASM_BUILD PROGRAM SOURCE_FOLDER SHARED_FOLDER [NAME...]
// Exit code 77, which means skipped, where it wasn't built for WebAssembly (wasm/build.sh). RIDGECRAFT_KEEP keeps the files.
import {execFile} from "node:child_process";
import {existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync} from "node:fs";
import {availableParallelism, tmpdir} from "node:os";
import {basename, dirname, join, parse} from "node:path";
import {fileURLToPath} from "node:url";

const [build, program, source, shared, ...wanted] = process.argv.slice(2);
if (!existsSync(join(build, "ridgecraft.wasm"))) {
  console.log(`skipped: there is no ${join(build, "ridgecraft.wasm")}; wasm/build.sh makes it`);
  process.exit(77);
}
const here = dirname(fileURLToPath(import.meta.url));
const suffixes = [".fold", ".svg", ".pdf", "-guide.pdf", ".dxf", ".html", ".png"];

/** Models of a folder that a page would be given. */
const modelsOf = (folder) => (existsSync(folder) ? readdirSync(folder).filter((name) => /\.(obj|stl|ply|off|glb|3mf)$/.test(name))
  .sort().map((name) => join(folder, name)) : []);

/** Its exit code, and what it says. */
const run = (command, words) => new Promise((done) => {
  execFile(command, words, {encoding: "utf8", maxBuffer: 2 ** 26}, (error, _, said) => done({code: error ? error.code : 0, said}));
});

// All of them take seven minutes of a processor, so it is every fourth one where none is named.
const models = [...modelsOf(join(source, "samples")), ...modelsOf(join(shared, "models/makers"))]
  .filter((file, i) => wanted.length === 0 ? i % 4 === 0 : wanted.some((name) => file.includes(name)));
if (!existsSync(join(shared, "models/makers"))) {
  console.log("without the models of makers, which aren't here");
}
const scratch = mkdtempSync(join(tmpdir(), "ridgecraft-wasm-"));
let different = 0;
let compared = 0;

async function compare(model, i) {
  const {name} = parse(model);
  const [native, foreign] = ["native", "wasm"].map((kind) => join(scratch, `${i}-${kind}`));
  mkdirSync(native);
  mkdirSync(foreign);
  // No options, and others: sizes, few pieces.
  const options = i % 2 === 0 ? [] : ["--size", "180mm", "--pieces", "few"];
  const outputs = suffixes.filter((suffix) => suffix.startsWith(".")).flatMap((suffix) => ["-o", join(native, `${name}${suffix}`)]);
  const own = await run(program, [model, "--quiet", "--threads", "1", ...options, ...outputs]);
  const there = await run(process.execPath, [join(here, "program.mjs"), build, model, foreign, suffixes.join(","), ...options]);
  // The program names the file by its path, and the module by its name.
  const lastOf = (said) => (said.trim().split("\n").pop() ?? "").replaceAll(dirname(model) + "/", "");
  if (own.code !== there.code || (own.code !== 0 && lastOf(own.said) !== lastOf(there.said))) {
    return `exit codes ${own.code} and ${there.code}: ${own.said} | ${there.said}`;
  }
  const [files, others] = [native, foreign].map((folder) => readdirSync(folder).sort());
  compared += files.length;
  if (files.join() !== others.join()) {
    return `files ${files} and ${others}`;
  }
  return files.filter((file) => !readFileSync(join(native, file)).equals(readFileSync(join(foreign, file)))).join(", ");
}

async function work(queue) {
  for (let next = queue.shift(); next; next = queue.shift()) {
    const [i, model] = next;
    const fault = await compare(model, i);
    different += fault === "" ? 0 : 1;
    console.log(`${fault === "" ? "same" : "DIFFERENT"} ${basename(model)} ${fault}`);
  }
}

try {
  const queue = [...models.entries()];
  await Promise.all(Array.from({length: availableParallelism()}, () => work(queue)));
} finally {
  if (process.env.RIDGECRAFT_KEEP) {
    console.log(`kept ${scratch}`);
  } else {
    rmSync(scratch, {recursive: true});
  }
}
console.log(`${models.length} models, ${compared} files, ${different} models different`);
process.exit(different === 0 && models.length > 0 ? 0 : 1);
