// SPDX-License-Identifier: GPL-3.0-or-later
// What studio.html takes: until it takes models, until the program is ready, until a model
// that is dropped is shown, and from a click to the core's answer of an edit, and to the new picture. No test: seconds are
// not promised. Each is taken by the clock and, behind it, by the processors of all the browser's processes, which counts
// where other programs run at the same time.
//   node measure.mjs --browser chromium --page FILE --tools FOLDER [--edits N] [--option KEY=VALUE]... MODEL...
import {readdirSync, readFileSync} from "node:fs";
import {basename} from "node:path";
import {pathToFileURL} from "node:url";
import {parseArgs} from "node:util";

import {launch, toolsIn} from "./browsers.mjs";

const {values, positionals} = parseArgs({allowPositionals: true, options: {browser: {type: "string", default: "chromium"},
  page: {type: "string"}, tools: {type: "string"}, edits: {type: "string", default: "20"}, option: {type: "string", multiple: true, default: []}}});
const browser = await launch(toolsIn(values.tools), values.browser, true);

/** Processors' milliseconds of all processes that this one has started, those that have ended left out; and their memory, MB. */
function used() {
  const parents = new Map();
  const stats = new Map();
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${id}/stat`, "latin1").replace(/^.*\) /s, "").split(" ");
      parents.set(Number(id), Number(fields[1]));
      stats.set(Number(id), {ms: 10 * (Number(fields[11]) + Number(fields[12])), mb: Number(fields[21]) * 4096 / 1e6});
    } catch {
      // It has ended meanwhile.
    }
  }
  const sum = {ms: 0, mb: 0};
  for (const [id, {ms, mb}] of stats) {
    let above = parents.get(id);
    while (above > 1 && above !== process.pid) {
      above = parents.get(above);
    }
    if (above === process.pid) {
      sum.ms += ms;
      sum.mb = Math.max(sum.mb, mb);
    }
  }
  return sum;
}

/** The clock's milliseconds and the processors'. */
async function timed(work) {
  const [before, begin] = [used().ms, performance.now()];
  const result = await work();
  return {result, wall: performance.now() - begin, cpu: used().ms - before};
}

const say = (about, {wall, cpu}) => console.log(`${about}: ${wall.toFixed(0)} ms, of processors ${cpu.toFixed(0)} ms`);
const at = (all, share) => [...all].sort((a, b) => a - b)[Math.floor(share * (all.length - 1))].toFixed(0);

console.log(`${(readFileSync(values.page).length / 1e6).toFixed(2)} MB`);
for (const model of positionals) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, reducedMotion: "reduce", locale: "en-GB"});
  const page = await context.newPage();
  page.setDefaultTimeout(600000);
  // When the core was asked last, and when it answered: what is left of an edit's time is drawing.
  // When the page's own script had run, and models could be dropped: the program may still be unpacked then.
  await page.addInitScript(() => {
    globalThis.asked = globalThis.answered = globalThis.dropped = globalThis.usable = 0;
    let studio;
    Object.defineProperty(globalThis, "ridgecraft", {get: () => studio, set: (value) => {
      studio = value;
      globalThis.usable = performance.now();
    }});
    globalThis.Worker = class extends Worker {
      constructor(...words) {
        super(...words);
        this.addEventListener("message", ({data}) => (globalThis.answered = "id" in data ? performance.now() : globalThis.answered));
      }
      postMessage(...words) {
        globalThis.asked = performance.now();
        super.postMessage(...words);
      }
    };
  });
  const inspect = (about) => page.evaluate((a) => globalThis.ridgecraft.inspect(a), about);
  const idle = async () => {
    await page.waitForFunction(() => !globalThis.ridgecraft.inspect().busy);
    return inspect();
  };
  const opened = await timed(async () => {
    await page.goto(pathToFileURL(values.page).href);
    await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  });
  console.log(`takes models after ${(await page.evaluate(() => globalThis.usable)).toFixed(0)} ms`);
  say("ready", {...opened, wall: (await inspect()).ready});
  const name = basename(model);
  const shown = await timed(async () => {
    await page.evaluate(([file, base64]) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], file));
      globalThis.dropped = performance.now();
      document.dispatchEvent(new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true}));
    }, [name, readFileSync(model).toString("base64")]);
    await page.waitForFunction(() => globalThis.ridgecraft.inspect().figures);
    return idle();
  });
  say(`${name} shown`, shown);
  console.log(`the core's answer after ${(await page.evaluate(() => globalThis.answered - globalThis.dropped)).toFixed(0)} ms`);
  for (const option of values.option) {
    const [key, value] = option.split("=");
    say(`${key} ${value}`, await timed(async () => {
      await page.evaluate(([k, v]) => {
        const control = document.getElementById(`option-${k}`);
        control.value = v;
        control.dispatchEvent(new Event("change", {bubbles: true}));
      }, [key, value]);
      await page.waitForFunction(([k, v]) => globalThis.ridgecraft.inspect().options[k] === v, [key, value]);
      await idle();
    }));
  }
  console.log(`largest process ${used().mb.toFixed(0)} MB`);

  // Cuts at folds all over the sheets, each taken back: from the click to the new sheets.
  const walls = [], processors = [], answers = [], backs = [];
  let tried = 0;
  for (; walls.length < Number(values.edits) && tried < 4 * Number(values.edits); ++tried) {
    const {folds, pieces} = await inspect();
    const edge = folds[Math.floor((((tried + 0.5) * 0.618) % 1) * folds.length)];
    await page.keyboard.press("Escape");
    const [x, y] = (await inspect({edge})).places.sheet;
    await page.mouse.click(x, y);
    const offered = await page.waitForFunction(() => globalThis.ridgecraft.inspect().offer?.edits[0]?.kind === "cut", null, {timeout: 5000}).catch(() => null);
    if (!offered) {
      continue;
    }
    const cut = await timed(async () => {
      await page.evaluate(() => document.querySelector("#edit button").click());
      return idle();
    });
    if (cut.result.pieces === pieces) {
      continue;
    }
    walls.push(cut.wall);
    answers.push(await page.evaluate(() => globalThis.answered - globalThis.asked));
    processors.push(cut.cpu);
    backs.push((await timed(async () => {
      await page.evaluate(() => document.getElementById("undo").click());
      await idle();
    })).cpu);
  }
  if (walls.length > 0) {
    console.log(`${walls.length} cuts of ${tried}: p50 ${at(walls, 0.5)}, p95 ${at(walls, 0.95)} ms, the core's answer ${at(answers, 0.5)} / ${at(answers, 0.95)} ms, of processors ${at(processors, 0.5)} / ${at(processors, 0.95)} ms; undo ${at(backs, 0.5)} / ${at(backs, 0.95)} ms of processors`);
  }
  await context.close();
}
await browser.close();
