// SPDX-License-Identifier: GPL-3.0-or-later
// What is on the pages of a PDF file, as poppler sees it.
import {execFileSync} from "node:child_process";
import {mkdtempSync, readdirSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";

const dotsPerMm = 20;

/** Width and height of each page, mm. @param {string} file */
export function pageSizes(file) {
  const text = execFileSync("pdfinfo", ["-f", "1", "-l", "9999", file], {encoding: "utf8"});
  return [...text.matchAll(/^Page\s+\d+ size:\s+([\d.]+) x ([\d.]+) pts/gm)].map((found) =>
    [found[1], found[2]].map((points) => (Number(points) * 25.4) / 72));
}

/** Lengths of the dark lines that run across each page without a gap, the longest of each row of dots, mm. @param {string} file */
export function darkRows(file) {
  const folder = mkdtempSync(`${tmpdir()}/ridgecraft-pdf-`);
  try {
    execFileSync("pdftoppm", ["-r", String(dotsPerMm * 25.4), "-gray", file, `${folder}/page`]);
    return readdirSync(folder).sort().map((name) => rowsOf(readFileSync(`${folder}/${name}`)));
  } finally {
    rmSync(folder, {recursive: true});
  }
}

/** @param {Buffer} bytes of a PGM picture */
function rowsOf(bytes) {
  const head = bytes.subarray(0, 64).toString("latin1").match(/^P5\s+(\d+)\s+(\d+)\s+\d+\s/);
  if (!head) {
    throw new Error("no PGM picture");
  }
  const [width, height] = [Number(head[1]), Number(head[2])];
  const rows = [];
  for (let y = 0; y < height; ++y) {
    let longest = 0;
    let begin = -1;
    for (let x = 0; x <= width; ++x) {
      const dark = x < width && bytes[head[0].length + y * width + x] < 128;
      if (dark && begin < 0) {
        begin = x;
      } else if (!dark && begin >= 0) {
        longest = Math.max(longest, x - begin);
        begin = -1;
      }
    }
    rows.push(longest / dotsPerMm);
  }
  return rows;
}
