// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of one subject each share: their arguments, what they find wrong, and their end.
//   node SUBJECT.mjs --browser chromium|firefox --web FOLDER --program FILE --samples FOLDER --tools FOLDER --out FOLDER
import {mkdirSync} from "node:fs";
import {parseArgs} from "node:util";

import {toolsIn} from "./browsers.mjs";

/** The arguments as `values`, npm's tools, the folder for what is made, and a list of faults that `check` adds to. */
export function subject() {
  const string = {type: "string"};
  const {values} = parseArgs({options: {browser: {...string, default: "chromium"}, web: string, program: string, samples: string, tools: string, out: string}});
  const require = toolsIn(values.tools);
  mkdirSync(values.out, {recursive: true});
  /** @type {string[]} */
  const faults = [];
  return {values, require, out: values.out, faults, check: (holds, words) => holds || faults.push(words)};
}

/** Runs one after the other, each with contexts of its own; what it throws is a fault. */
export async function runAll(browser, runs, faults) {
  for (const run of runs) {
    try {
      await run();
    } catch (error) {
      faults.push(`${run.name}: ${error.stack ?? error}`);
    }
    await Promise.all(browser.contexts().map((context) => context.close()));
  }
}

/** Prints what was found and ends the program. */
export async function end(browser, faults) {
  await browser.close();
  console.log(faults.length === 0 ? "passed" : `FAILED\n    ${faults.join("\n    ")}`);
  process.exit(faults.length === 0 ? 0 : 1);
}
