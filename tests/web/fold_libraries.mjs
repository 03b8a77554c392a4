// SPDX-License-Identifier: GPL-3.0-or-later
// What others read FOLD files with finds nothing wrong in those that the program writes: the library of the format's
// authors (fold) and the one of origami designers (rabbit-ear).
//   node fold_libraries.mjs TOOLS PROGRAM FOLDER MODEL...     tools: the folder that tools.sh made; folder: for the files
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync, readFileSync, rmSync} from "node:fs";
import {createRequire} from "node:module";
import {basename, extname, join} from "node:path";

const [tools, program, folder, ...models] = process.argv.slice(2);
if (!existsSync(join(tools, "complete"))) {
  console.log("skipped: tests/web/tools.sh hasn't fetched the libraries");
  process.exit(77);
}
const require = createRequire(join(tools, "package.json"));
const authors = require("fold");
const designers = (await import(require.resolve("rabbit-ear"))).default;
const faults = [];

function look(name, fold) {
  const check = (holds, words) => holds || faults.push(`${name}: ${words}`);
  const again = JSON.parse(authors.convert.toJSON(fold));
  for (const key of Object.keys(fold)) {
    check(JSON.stringify(again[key]) === JSON.stringify(fold[key]), `${key} is another one when it has been written again`);
  }
  const {file_frames, ...flat} = fold;
  const copy = structuredClone(flat);
  authors.convert.faces_vertices_to_faces_edges(copy);
  check(copy.faces_edges.length === fold.faces_vertices.length && copy.faces_edges.flat().every((edge) => edge >= 0),
    "a side of a face is no edge");
  const uses = new Array(fold.edges_vertices.length).fill(0);
  copy.faces_edges.flat().forEach((edge) => ++uses[edge]);
  fold.edges_assignment.forEach((letter, edge) => {
    const angle = fold.edges_foldAngle[edge];
    const fits = letter === "M" ? angle < 0 : letter === "V" ? angle > 0 : letter === "F" ? angle === 0 : true;
    check(fits, `edge ${edge} is ${letter} and folded by ${angle} degrees`);
    check(uses[edge] === (letter === "B" ? 1 : 2), `edge ${edge} is ${letter} and a side of ${uses[edge]} faces`);
  });
  const said = designers.graph.validate(flat);
  check(said.summary === "valid", `rabbit-ear says "${said.summary}"`);
}

rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
for (const model of models) {
  const name = basename(model, extname(model));
  const file = join(folder, `${name}.fold`);
  execFileSync(program, [model, "-o", file], {stdio: "ignore"});
  look(name, JSON.parse(readFileSync(file, "utf8")));
}
console.log(faults.length > 0 ? faults.slice(0, 20).join("\n") : `${models.length} files are as fold and rabbit-ear want them`);
process.exit(faults.length > 0 ? 1 : 0);
