// SPDX-License-Identifier: GPL-3.0-or-later
// What a maker has done is never lost: it is kept, asked for and undone step by step. The program is played (played.mjs).
import {readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";

import {launch} from "./browsers.mjs";
import {playedPage} from "./played.mjs";
import {end, runAll, subject} from "./subject.mjs";

const {values, require, out, faults, check} = subject();
const file = await playedPage(values);
const browser = await launch(require, values.browser, true);

/** A page of the studio: in a context, several see what the first one kept. */
async function pageIn(context, before = () => {}) {
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  const heard = [];
  page.on("pageerror", (error) => /style-src-elem/.test(error.message) || heard.push(error.message));
  await page.addInitScript(before);
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  const inspect = () => page.evaluate(() => globalThis.ridgecraft.inspect());
  const idle = async () => {
    await page.waitForFunction(() => !globalThis.ridgecraft.inspect().busy);
    return inspect();
  };
  const sample = async () => {
    await page.click("#samples button");
    await page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
    return idle();
  };
  const drop = (files) => page.evaluate((list) => {
    const data = new DataTransfer();
    for (const [name, base64] of list) {
      data.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
    }
    document.dispatchEvent(new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true}));
  }, files.map(([name, bytes]) => [name, bytes.toString("base64")]));
  /** So many turns of a piece, each a step. */
  const turn = async (count) => {
    await page.focus('[data-piece="0"]');
    for (let i = 0; i < count; ++i) {
      await page.keyboard.press("r");
      await idle();
    }
    return inspect();
  };
  const kept = () => page.waitForFunction(() => globalThis.ridgecraft.inspect().kept, null, {timeout: 2000 + 3000});
  const made = async () => (await inspect()).notes.map(({text}) => text).filter((text) => text.startsWith("make: ")).at(-1) ?? "";
  const shot = (name) => page.screenshot({path: `${out}/${values.browser}-${name}.png`});
  return {page, heard, inspect, idle, sample, drop, turn, kept, made, shot};
}
const contextWith = (options) => browser.newContext({viewport: {width: 1280, height: 800}, reducedMotion: "reduce", locale: "en-GB", ...options});

async function keepsEachStep() {
  const context = await contextWith();
  const first = await pageIn(context);
  check(await first.page.isHidden("#recent"), "a browser that kept nothing shows projects");
  await first.sample();
  await first.turn(3);
  await first.page.fill("#option-size", "180");
  await first.page.waitForFunction(() => globalThis.ridgecraft.inspect().options.size === "180");
  await first.turn(1);
  await first.kept();
  check((await first.page.textContent("#kept")).startsWith("Kept in this browser"), "nothing says that the work is kept");
  check((await first.inspect()).history.join() === "open,edits,edits,edits,options,edits", `the history is ${(await first.inspect()).history}`);
  await first.page.click("#history summary");
  check((await first.page.locator("#history li").allTextContents()).join() === "Opened,Moved,Moved,Moved,Largest side: 180,Moved", `the steps are listed as ${await first.page.locator("#history li").allTextContents()}`);
  await first.shot("steps");

  // Somebody presses F5: nothing asks, and the start page has it.
  await first.page.reload();
  await first.page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  await first.page.waitForSelector("#recent-list button");
  await first.shot("recent");
  check(/whale\.obj.*5 steps/.test(await first.page.textContent("#recent-list button")), `the start page offers "${await first.page.textContent("#recent-list button")}"`);
  await first.page.click("#recent-list button");
  await first.page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
  const back = await first.idle();
  check(back.options.size === "180" && back.history.length === 6 && back.moment === 5, `after a reload there is ${JSON.stringify([back.options, back.history, back.moment])}`);
  check(/^make: whale\.obj --size 180mm \| place .* \| place .* \| place .* \| place /.test(await first.made()), `it is made of ${await first.made()}`);
  await first.page.keyboard.press("Control+z");
  await first.page.keyboard.press("Control+z");
  check((await first.idle()).options.size === undefined, "a reload forgets what can be undone");
  check(first.heard.length === 0, `the page says ${first.heard.slice(0, 3)}`);

  // The last step before another model comes is kept, too.
  await first.turn(1);
  const {history: {length: before}} = await first.inspect();
  await first.drop([["next.obj", readFileSync(`${values.samples}/house.obj`)]]);
  await first.page.click('#ask [data-choice="leave"]');
  await first.page.waitForFunction(() => globalThis.ridgecraft.inspect().project === "next.obj");
  await first.kept();
  await first.page.reload();
  await first.page.waitForSelector("#recent-list button:nth-child(2)");
  const texts = await first.page.locator("#recent-list button").allTextContents();
  check(texts.length === 2 && texts[1].includes(`${before - 1} steps`), `after another model came there are ${texts}, and there were ${before - 1} steps`);

  // Five are kept, and all are cleared.
  for (let i = 0; i < 6; ++i) {
    const more = await pageIn(context);
    await more.sample();
    await more.kept();
    await more.page.close();
  }
  const last = await pageIn(context);
  await last.page.waitForSelector("#recent-list button");
  check(await last.page.locator("#recent-list button").count() === 5, `${await last.page.locator("#recent-list button").count()} projects are kept`);
  await last.page.click("#forget");
  await last.page.waitForSelector("#recent", {state: "hidden"});
  await last.page.reload();
  await last.page.waitForTimeout(300);
  check(await last.page.isHidden("#recent"), "what was cleared comes back");
  await context.close();
}

/** The page goes at any moment: at most two seconds are lost, and what is kept opens. */
async function survivesItsEnd() {
  const context = await contextWith();
  for (const wait of [0, 100, 350, 700]) {
    const page = await pageIn(context);
    await page.sample();
    await page.turn(2);
    await page.kept();
    await page.turn(2);
    await page.page.waitForTimeout(wait);
    await page.page.close({runBeforeUnload: false});
    const next = await pageIn(context);
    await next.page.waitForSelector("#recent-list button");
    await next.page.click("#recent-list button");
    await next.page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
    const {history} = await next.idle();
    check(history.length >= 3 && history.length <= 5, `${wait} ms after the last step a page that ends keeps ${history.length - 1} of 4 steps`);
    await next.page.click("#open-other", {trial: true});
    await next.page.close();
  }
  await context.close();
}

async function undoesAllKeys() {
  const context = await contextWith();
  const {page, idle, sample, turn, inspect} = await pageIn(context);
  await sample();
  await turn(20);
  check((await inspect()).moment === 20, `twenty steps are ${(await inspect()).moment}`);
  // In one burst, faster than any answer.
  await page.evaluate(() => {
    for (let i = 0; i < 20; ++i) {
      document.body.dispatchEvent(new KeyboardEvent("keydown", {key: "z", ctrlKey: true, bubbles: true, cancelable: true}));
    }
  });
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().moment === 0, null, {timeout: 10000}).catch(() => {});
  check((await idle()).moment === 0, `twenty keystrokes undo ${20 - (await inspect()).moment} steps`);
  check(!(await inspect()).canUndo && (await inspect()).canRedo, "at the beginning more can be undone");
  await page.click("#history summary");
  await page.click("#history li:nth-child(8) button");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().moment === 7);
  await context.close();
}

async function asksBefore() {
  const context = await contextWith();
  const {page, idle, sample, turn, inspect, drop, kept, shot} = await pageIn(context);
  const other = [["other.obj", readFileSync(`${values.samples}/house.obj`)]];
  await sample();
  // Nothing was done: nothing is asked.
  await drop(other);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().project === "other.obj");
  await turn(1);
  await drop([["third.obj", other[0][1]]]);
  await page.waitForSelector("#ask[open]");
  await shot("ask");
  check(/other\.obj.*third\.obj/.test(await page.textContent("#ask p")), `it asks "${await page.textContent("#ask p")}"`);
  await page.click('#ask [data-choice="stay"]');
  check((await inspect()).project === "other.obj", "who stays gets the other model");
  // Escape means the same.
  await drop([["third.obj", other[0][1]]]);
  await page.waitForSelector("#ask[open]");
  await page.keyboard.press("Escape");
  check(await page.isHidden("#ask") && (await inspect()).project === "other.obj", "Escape doesn't stay");
  // Saved as a file, by Ctrl+S, it goes without a question.
  check((await inspect()).unsaved, "a step by hand is saved");
  const download = values.browser === "chromium" ? page.waitForEvent("download") : null;
  await page.keyboard.press("Control+s");
  if (download) {
    check((await download).suggestedFilename() === "other.ridgecraft", `a project is saved as ${(await download).suggestedFilename()}`);
  }
  await page.waitForFunction(() => !globalThis.ridgecraft.inspect().unsaved);
  await drop([["third.obj", other[0][1]]]);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().project === "third.obj");
  await turn(1);
  await drop(other);
  await page.click('#ask [data-choice="leave"]');
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().project === "other.obj");
  await turn(1);
  await kept();
  check(await leaves(page), "who leaves what is kept is asked");
  await context.close();

  // A browser that keeps nothing says so, and asks before it is left.
  const bare = await contextWith();
  const without = await pageIn(bare, () => Object.defineProperty(globalThis, "indexedDB", {value: undefined}));
  await without.sample();
  await without.turn(1);
  await without.page.waitForFunction(() => document.getElementById("kept").textContent.includes("keeps nothing"));
  check(!await leaves(without.page), "who leaves what nothing keeps isn't asked");
  await without.shot("not-kept");
  await idle().catch(() => {});
  await bare.close();
}

/** Whether the page may be left without a question. */
async function leaves(page) {
  return page.evaluate(() => {
    const event = new Event("beforeunload", {cancelable: true});
    return globalThis.dispatchEvent(event);
  });
}

async function opensWhatItWrote() {
  const context = await contextWith();
  const {page, idle, inspect, drop, made, shot} = await pageIn(context);
  const bytes = (suffix) => readFileSync(`${out}/whale.${suffix}`);
  for (const suffix of ["ridgecraft", "html"]) {
    await drop([[`mine.${suffix}`, bytes(suffix)]]);
    await page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
    check((await idle()).error === "" && /^make: whale\.obj --from=whale\.fold \|  \| whale\.fold,whale\.mtl,whale\.obj$/.test(await made()), `${suffix}: ${(await inspect()).error} ${await made()}`);
  }
  await drop([["whale.fold", bytes("fold")]]);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().notes.some(({text}) => text.includes("--from whale.fold")));
  check(/^make: whale\.obj --from whale\.fold .*--faces keep/.test(await made()), `nets alone: ${await made()}`);
  check(/nets without their model/.test(await page.textContent("#told")), "nets alone say nothing of their model");
  await drop([["whale.obj", readFileSync(`${values.samples}/whale.obj`)], ["whale.fold", bytes("fold")]]);
  await page.waitForFunction(() => !globalThis.ridgecraft.inspect().notes.some(({text}) => text.includes("--faces keep")));
  check(/^make: whale\.obj --from whale\.fold \|/.test(await made()), `nets with their model: ${await made()}`);

  // Materials that come later, and what is damaged.
  await drop([["whale.mtl", readFileSync(`${values.samples}/whale.mtl`)]]);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().notes.some(({text}) => text.endsWith("whale.fold,whale.mtl,whale.obj")));
  await drop([["mine.ridgecraft", bytes("ridgecraft").subarray(0, 900)]]);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().error !== "");
  check((await inspect()).error === "mine.ridgecraft is cut off or damaged.", `a damaged project: ${(await inspect()).error}`);
  await shot("damaged");
  await context.close();
}

/** What options don't allow is told, and comes back. */
async function tellsWhatIsLeftOut() {
  const context = await contextWith();
  const {page, idle, sample, inspect, made, shot} = await pageIn(context);
  const {folds} = await sample();
  const [x, y] = (await page.evaluate((edge) => globalThis.ridgecraft.inspect({edge}), folds[Math.floor(folds.length / 2)])).places.sheet;
  await page.mouse.click(x, y);
  await page.click("#edit button");
  await idle();
  await page.fill("#option-size", "151");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().left.length === 1);
  check(await page.isVisible("#go-back") && /1 change by hand isn't possible.*Cut/.test(await page.textContent("#told")), `what is left out is told as "${await page.textContent("#told")}"`);
  await shot("left-out");
  await page.fill("#option-size", "");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().left.length === 0);
  await idle();
  check(/^make: whale\.obj \| cut \d+ \d+ \|/.test(await made()), `with the old size it is made of ${await made()}`);
  await page.fill("#option-size", "151");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().left.length === 1);
  await page.click("#go-back");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().left.length === 0);
  check((await inspect()).canRedo, "going back isn't undo");
  await context.close();
}

/** Long names leave the controls where they are. */
async function holdsLongNames() {
  const context = await contextWith();
  const {page, idle, drop, shot} = await pageIn(context);
  await drop([[`${"a_very_long_name_".repeat(12)}final.obj`, readFileSync(`${values.samples}/house.obj`)]]);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
  await idle();
  await shot("long-name");
  const outside = await page.evaluate(() => [...document.querySelectorAll("button, select, input, h1, strong")].filter((element) => {
    const box = element.getBoundingClientRect();
    return box.width > 0 && (box.right > innerWidth + 1 || box.left < -1);
  }).map((element) => element.id || element.textContent));
  check(outside.length === 0, `a long name pushes out ${outside}`);
  check(/^a_very.*….*final\.obj$/.test(await page.textContent("#panel-name")), `a long name is shown as ${await page.textContent("#panel-name")}`);
  await context.close();
}

/** Whoever builds has room for the model, and what pops up leaves in sight what was clicked. */
async function leavesRoom() {
  for (const viewport of [{width: 1280, height: 800}, {width: 1024, height: 700}]) {
    const context = await contextWith({viewport});
    const {page, sample, idle, shot} = await pageIn(context);
    await sample();
    const covered = await page.evaluate(async () => {
      const faults = [];
      for (const piece of document.querySelectorAll("[data-piece] .faces")) {
        const index = piece.closest("[data-piece]").dataset.piece;
        const {left, top, width, height} = piece.getBoundingClientRect();
        const places = [...Array(81).keys()].map((k) => [left + ((1 + k % 9) * width) / 10, top + ((1 + Math.floor(k / 9)) * height) / 10].map(Math.round));
        const place = places.find(([x, y]) => {
          const {sheet} = globalThis.ridgecraft.inspect({x, y}).under;
          return sheet?.piece === Number(index) && sheet.edge < 0;
        });
        if (!place) {
          continue;
        }
        const [clientX, clientY] = place;
        const svg = document.getElementById("plan");
        svg.setPointerCapture = () => {};
        for (const type of ["pointerdown", "pointerup"]) {
          svg.dispatchEvent(new PointerEvent(type, {clientX, clientY, bubbles: true, pointerId: 9, button: 0, pointerType: "mouse", isPrimary: true}));
        }
        await new Promise((done) => setTimeout(done, 150));
        const box = document.getElementById("edit").getBoundingClientRect();
        const now = document.querySelector(`[data-piece="${index}"] .faces`).getBoundingClientRect();
        if (box.width > 0 && box.left < now.right && box.right > now.left && box.top < now.bottom && box.bottom > now.top) {
          faults.push(index);
        }
      }
      return faults;
    });
    check(covered.length === 0, `${viewport.width} px: what pops up lies on pieces ${covered}`);
    await shot(`offer-${viewport.width}`);
    await page.keyboard.press("Escape");
    await page.click("#build");
    await idle();
    await page.waitForTimeout(200);
    const {width} = await page.locator("#stage").boundingBox();
    check(width >= (viewport.width < 1100 ? 300 : 400), `at ${viewport.width} px building has ${Math.round(width)} px of model`);
    await shot(`build-${viewport.width}`);
    await page.click("#build");
    check(await page.isVisible("#options"), "the options don't come back after building");
    await context.close();
  }
}

/** For those who can't see, or use the keyboard alone, on each screen. */
async function isAccessible() {
  const axe = readFileSync(`${values.tools}/node_modules/axe-core/axe.min.js`, "utf8");
  for (const [name, options] of [["light", {}], ["dark", {colorScheme: "dark"}], ["phone", {viewport: {width: 400, height: 800}}], ["zoomed", {viewport: {width: 640, height: 400}, deviceScaleFactor: 2}]]) {
    const context = await contextWith({bypassCSP: true, ...options});
    const {page, sample, turn, drop, kept} = await pageIn(context);
    const findings = async (screen) => {
      await page.evaluate(axe);
      const {violations} = await page.evaluate(() => globalThis.axe.run(document, {runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]}));
      violations.forEach(({id, nodes}) => faults.push(`axe, ${name}, ${screen}: ${id} ${nodes.slice(0, 2).map(({html}) => html.slice(0, 160))}`));
      check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name}, ${screen}: wider than the screen`);
    };
    await sample();
    const wide = !["phone", "zoomed"].includes(name);
    if (wide) {
      await turn(1);
      await kept();
      check(await page.evaluate(() => document.activeElement !== document.body), `${name}: the focus is lost by an edit`);
    }
    await findings("edited");
    await page.click("#open-menu", {timeout: 5000}).catch(() => {});
    await findings("menu");
    await page.keyboard.press("Escape");
    if (wide) {
      await drop([["other.obj", readFileSync(`${values.samples}/house.obj`)]]);
      await page.waitForSelector("#ask[open]");
      await findings("question");
      await page.keyboard.press("Escape");
    }
    await page.reload();
    await page.waitForSelector("#recent-list button");
    await findings("start");
    await page.screenshot({path: `${out}/${values.browser}-start-${name}.png`});
    await context.close();
  }
}

await runAll(browser, [keepsEachStep, survivesItsEnd, undoesAllKeys, asksBefore, opensWhatItWrote, tellsWhatIsLeftOut, holdsLongNames, leavesRoom, isAccessible], faults);
await end(browser, faults);
