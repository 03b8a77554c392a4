// SPDX-License-Identifier: GPL-3.0-or-later
// Opens pages that the program has written in a browser, and uses them: scenarios.mjs has what is done there.
//   node run.mjs --browser chromium|firefox [--no-webgl] --program FILE --samples FOLDER --tools FOLDER --out FOLDER [NAME...]
import {execFileSync} from "node:child_process";
import {mkdirSync} from "node:fs";
import {parseArgs} from "node:util";

import {launch, toolsIn} from "./browsers.mjs";
import {scenarios} from "./scenarios.mjs";

const {values, positionals} = parseArgs({allowPositionals: true, options: {
  browser: {type: "string", default: "chromium"}, "no-webgl": {type: "boolean", default: false}, program: {type: "string"},
  samples: {type: "string"}, tools: {type: "string"}, out: {type: "string"}}});
const require = toolsIn(values.tools);
const out = values.out;
mkdirSync(out, {recursive: true});
const pageOf = (model, ...options) => {
  const name = model.replace(/\.\w+$/, "");
  execFileSync(values.program, [`${values.samples}/${model}`, ...options, "--overwrite", "--quiet", "-o", `${out}/${name}.html`, "-o",
    `${out}/${name}.fold`], {stdio: ["ignore", "ignore", "inherit"]});
  return `${out}/${name}.html`;
};
const files = {whale: pageOf("whale.obj"), lighthouse: pageOf("lighthouse.obj"), house: pageOf("house.obj", "--paper", "A5")};

let failed = 0;
for (const {name, where, run} of scenarios) {
  const here = values["no-webgl"] ? "painter" : values.browser;
  if (!where.includes(here) || (positionals.length > 0 && !positionals.includes(name))) {
    continue;
  }
  const browser = await launch(require, values.browser, !values["no-webgl"]);
  const faults = [];
  const begin = performance.now();
  try {
    await run({browser, files, out, require, browserName: values.browser, here,
      check: (holds, words) => holds || faults.push(words)});
  } catch (error) {
    faults.push(error.stack ?? String(error));
  }
  console.log(`${faults.length === 0 ? "passed" : "FAILED"}  ${name} (${((performance.now() - begin) / 1000).toFixed(1)} s)`);
  for (const fault of faults.slice(0, 20)) {
    console.log(`    ${fault}`);
  }
  failed += faults.length > 0 ? 1 : 0;
  await browser.close();
}
process.exit(failed > 0 ? 1 : 0);
