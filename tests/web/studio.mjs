// SPDX-License-Identifier: GPL-3.0-or-later
// Uses studio.html as its readers do: from the disk, without a network.
//   node studio.mjs --browser chromium|firefox --page FILE --program FILE --samples FOLDER --tools FOLDER --out FOLDER
// Exit code 77, which means skipped, where the page wasn't built (wasm/build.sh).
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync, readFileSync, writeFileSync} from "node:fs";
import {basename} from "node:path";
import {pathToFileURL} from "node:url";
import {parseArgs} from "node:util";

import {launch, skip, toolsIn} from "./browsers.mjs";

const {values} = parseArgs({options: {browser: {type: "string", default: "chromium"}, page: {type: "string"}, program: {type: "string"},
  samples: {type: "string"}, tools: {type: "string"}, out: {type: "string"}}});
if (!existsSync(values.page)) {
  skip(`there is no ${values.page}; wasm/build.sh makes it`);
}
const require = toolsIn(values.tools);
const {out} = values;
mkdirSync(out, {recursive: true});

const faults = [];
const check = (holds, words) => holds || faults.push(words);
const browser = await launch(require, values.browser, true);

/** What the program writes for a sample. */
function native(sample, suffix, ...options) {
  const file = `${out}/native-${sample}${suffix}`;
  execFileSync(values.program, [`${values.samples}/${sample}.obj`, ...options, "--overwrite", "--quiet", "-o", file], {stdio: ["ignore", "ignore", "inherit"]});
  return readFileSync(file);
}

async function open(file, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, reducedMotion: "reduce", locale: "en-GB",
    acceptDownloads: true, ...options});
  if (values.browser === "chromium") {
    await context.setOffline(true);
  }
  const page = await context.newPage();
  const heard = [];
  // What the graphics driver says of its speed; and in Firefox the style by which pictures of the page are taken.
  const ofTest = (text) => text.includes("GL Driver Message") || (values.browser === "firefox" && text.includes("style-src-elem"));
  page.on("console", (message) => ofTest(message.text()) || heard.push(message.text()));
  page.on("pageerror", (error) => ofTest(error.message) || heard.push(error.message));
  page.on("request", (request) => {
    if (!/^(blob|data):/.test(request.url()) && request.url() !== pathToFileURL(file).href) {
      heard.push(`asks for ${request.url()}`);
    }
  });
  await page.goto(pathToFileURL(file).href);
  const inspect = (about) => page.evaluate((a) => globalThis.ridgecraft.inspect(a), about);
  const idle = async () => {
    await page.waitForFunction(() => !globalThis.ridgecraft.inspect().busy, null, {timeout: 120000});
    return inspect();
  };
  const exported = async (format) => Buffer.from(await page.evaluate(async (f) => {
    const bytes = await globalThis.ridgecraft.export(f);
    let text = "";
    for (let i = 0; i < bytes.length; i += 32768) {
      text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    }
    return btoa(text);
  }, format), "base64");
  const drop = (files) => page.evaluate((list) => {
    const data = new DataTransfer();
    for (const [name, base64] of list) {
      data.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
    }
    document.dispatchEvent(new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true}));
  }, files.map(([name, bytes]) => [name, bytes.toString("base64")]));
  /** Where changes would be lost with what is dropped, it asks first. */
  const replace = async (files) => {
    await drop(files);
    await page.click('#ask [data-choice="leave"]');
  };
  const shot = (name) => page.screenshot({path: `${out}/${values.browser}-${name}.png`});
  return {context, page, heard, inspect, idle, exported, drop, replace, shot};
}

const sampleFiles = (name) => [".obj", ".mtl"].map((suffix) => [`${name}${suffix}`, readFileSync(`${values.samples}/${name}${suffix}`)]);

async function makesPaper() {
  const {context, page, heard, inspect, idle, exported, drop, replace, shot} = await open(values.page);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  console.log(`    ready ${(await inspect()).ready.toFixed(0)} ms after opening; ${(readFileSync(values.page).length / 1e6).toFixed(2)} MB`);
  await shot("welcome");

  // A sample by its button.
  const begin = performance.now();
  await page.click("#samples button");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().figures !== null && !globalThis.ridgecraft.inspect().busy, null, {timeout: 120000});
  console.log(`    the whale after ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  check((await inspect()).title === "whale", "the whale isn't shown");
  for (const format of ["fold", "pdf"]) {
    check((await exported(format)).equals(native("whale", `.${format}`)), `${format} of the whale: other bytes than the program's`);
  }
  await shot("whale");

  // A model that is dropped with its materials, and saved by the menu.
  await drop(sampleFiles("house"));
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().title === "house", null, {timeout: 120000});
  const house = await idle();
  check(house.error === "", `the house is refused: ${house.error}`);
  await page.click("#export");
  await shot("house-menu");
  if (values.browser === "chromium") {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#export-menu button")]);
    check(download.suggestedFilename() === "house.pdf", `the PDF is called ${download.suggestedFilename()}`);
    check(readFileSync(await download.path()).equals(native("house", ".pdf")), "the PDF of the house has other bytes than the program's");
  } else {
    // Firefox doesn't tell what drives it of downloads.
    await page.keyboard.press("Escape");
    check((await exported("pdf")).equals(native("house", ".pdf")), "the PDF of the house has other bytes than the program's");
  }

  // A option changes the sheets.
  await page.selectOption("#option-paper", "A3");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().options.paper === "A3", null, {timeout: 120000});
  await idle();
  check((await exported("fold")).equals(native("house", ".fold", "--paper", "A3")), "FOLD on A3: other bytes than the program's");
  const archive = await exported("svg");
  check(archive.subarray(0, 4).toString("latin1") === "PK\u0003\u0004" || archive.subarray(0, 5).toString() === "<?xml", "the SVG is neither a file nor an archive");

  // What can't be is refused, and the result before stays.
  await replace([["broken.obj", Buffer.from("v 0 0 0\nf 1 2 3\n")]]);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().error !== "", null, {timeout: 60000});
  const refused = await idle();
  check(/broken\.obj/.test(refused.error), `the broken model is refused with "${refused.error}"`);
  check(refused.title === "house", "the result before a refusal is gone");
  await shot("refused");

  // Cancelling leaves what there was, and the next model is made all the same.
  await page.click("#dismiss");
  // In the page, where nothing comes between the bar and the click, however fast the machine is.
  const clicked = page.evaluate(() => new Promise((done) => {
    const timer = setInterval(() => {
      if (!document.getElementById("busy").hidden) {
        clearInterval(timer);
        document.getElementById("cancel").click();
        done();
      }
    }, 10);
  }));
  await replace(sampleFiles("dinosaur"));
  await clicked;
  const cancelled = await idle();
  check(cancelled.title === "house" && cancelled.project === "house.obj", `after cancelling there is ${cancelled.title}`);
  check((await exported("fold")).equals(native("house", ".fold", "--paper", "A3")), "after cancelling: other bytes than before");
  await replace(sampleFiles("fox_head"));
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().title === "fox_head", null, {timeout: 120000});
  await idle();
  await shot("fox");
  check(heard.length === 0, `the page says or asks: ${heard.slice(0, 5)}`);
  await context.close();
}

/** The first of these for which something holds that has to be waited for. */
async function firstWithin(all, holds) {
  for (const one of all) {
    if (await holds(one)) return one;
  }
  return undefined;
}

/** Edges are cut and joined by hand, and it is undone and done again. */
async function editsByHand() {
  const {context, page, heard, inspect, idle, exported, shot} = await open(values.page, {locale: "de-DE"});
  await page.click("#samples button");
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().figures, null, {timeout: 120000});
  const start = await idle();
  const before = await exported("fold");
  /** Clicks an edge on one side, and waits for what is offered there. */
  const offered = async (edge, side) => {
    await page.keyboard.press("Escape");
    const [x, y] = (await inspect({edge})).places[side];
    await page.mouse.click(x, y);
    await page.waitForFunction(() => globalThis.ridgecraft.inspect().offer, null, {timeout: 20000});
    return (await idle()).offer;
  };
  /** Presses a button of what is offered. */
  const takes = async (n = 1) => {
    await page.click(`#edit button:nth-child(${n})`);
    return idle();
  };
  // The camera stays where somebody has turned it.
  await page.mouse.move(500, 400);
  await page.mouse.down();
  await page.mouse.move(560, 380, {steps: 3});
  await page.mouse.up();
  await page.mouse.wheel(0, -100);
  const {camera} = await inspect();
  check(camera.zoom > 1, "the wheel doesn't zoom");

  // The middle of a fold on the sheet, where nothing else is near it.
  const fold = start.folds[Math.floor(start.folds.length / 2)];
  const cut = await offered(fold, "sheet");
  await page.evaluate(() => (globalThis.firstStage = document.getElementById("stage")));
  check(cut.edits.map(({kind}) => kind).join() === "cut", `at a fold there is offered ${JSON.stringify(cut)}`);
  check(await page.textContent("#edit button") === "Hier schneiden", "the offer isn't German");
  check((await inspect()).error === "", `a sample that is opened at once is shown with "${(await inspect()).error}"`);
  await shot("edit-offer");
  const clicked = performance.now();
  const parted = await takes();
  console.log(`    a cut of the whale after ${(performance.now() - clicked).toFixed(0)} ms`);
  check(parted.error === "", `the cut is refused: ${parted.error}`);
  check(await page.evaluate(() => document.getElementById("stage") === globalThis.firstStage), "an edit takes another canvas, and another context of WebGL");
  check(parted.pieces === start.pieces + 1, `a cut makes ${parted.pieces} pieces of ${start.pieces}`);
  check(JSON.stringify(parted.camera) === JSON.stringify(camera), `the camera has moved: ${JSON.stringify(parted.camera)}`);
  check(parted.canUndo && !parted.canRedo, "a cut can't be undone");
  check(parted.marked.length === 2, "the new seam isn't lit");
  const after = await exported("fold");
  writeFileSync(`${out}/edited.fold`, after);
  execFileSync(values.program, ["verify", `${out}/edited.fold`, "--quiet"], {stdio: ["ignore", "ignore", "inherit"]});
  await shot("edit-cut");

  // Back and forth, by keys and by buttons, with the same bytes.
  await page.keyboard.press("Control+z");
  const back = await idle();
  check(back.pieces === start.pieces && !back.canUndo && back.canRedo, "Ctrl+Z doesn't take the cut back");
  check((await exported("fold")).equals(before), "after undo: other bytes than before");
  await page.keyboard.press("Control+Shift+Z");
  await idle();
  check((await exported("fold")).equals(after), "after redo: other bytes than those of the cut");
  await page.click("#undo");
  await idle();
  check((await exported("fold")).equals(before), "after undo by its button: other bytes than before");
  await page.click("#redo");
  const again = await idle();

  // Joined again where it was cut, on the model's side of the page or on the sheets.
  const [seam] = again.marked.length > 0 ? again.marked : parted.marked;
  const join = await offered(seam, "sheet");
  check(join.edits.map(({kind}) => kind).join() === "join,tab-from,no-tab,both-tabs", `at a seam there is offered ${JSON.stringify(join)}`);
  const joined = await takes();
  check(joined.pieces === start.pieces, `a join makes ${joined.pieces} pieces`);

  // The tab goes over to the other piece, is left out, and comes back.
  const pair = await firstWithin(joined.joins.filter(({pieces}) => pieces[0] !== pieces[1]).reverse(),
    async ({edges}) => (await offered(edges[0], "sheet")).edits[1]?.kind === "tab-from");
  const giver = async () => /Lasche an ([\w.]+)/.exec((await inspect()).foot)?.[1];
  await offered(pair.edges[0], "sheet");
  const gave = await giver();
  const to = (await page.textContent("#edit button:nth-child(2)")).replace("Lasche an Teil ", "");
  await shot("edit-tab");
  const over = await takes(2);
  if (over.error === "") {
    check(await giver() === to && to !== gave, `the tab of join ${pair.number} goes from ${gave} to ${await giver()}, not to ${to}`);
  } else {
    check(/kein Platz/.test(over.error), `a tab is refused: ${over.error}`);
    await page.click("#dismiss");
  }
  /** The joins of its seam, in their order there. */
  const alongSeam = ({joins}) => joins.filter(({number}) => number === pair.number);
  const seamOver = alongSeam(over)[alongSeam(joined).indexOf(pair)].edges[0];
  await offered(seamOver, "sheet");
  await takes(3);
  check(/ohne Lasche/.test((await inspect()).foot), `a tab that is taken off reads "${(await inspect()).foot}"`);
  await shot("edit-no-tab");
  writeFileSync(`${out}/edited.fold`, await exported("fold"));
  execFileSync(values.program, ["verify", `${out}/edited.fold`, "--quiet"], {stdio: ["ignore", "ignore", "inherit"]});
  await page.keyboard.press("Control+z");
  const given = await idle();
  check(given.pieces === joined.pieces, "Ctrl+Z doesn't give a tab back");

  // What can't be joined: a seam of a piece with itself.
  const own = given.joins.findLast(({pieces}) => pieces[0] === pieces[1]);
  const refused = await offered(own.edges[0], "sheet");
  check(!refused.edits.some(({kind}) => kind === "join") && /^Beide Seiten dieser Kante gehören zu Teil/.test(refused.words), `a loop is offered: ${JSON.stringify(refused)}`);
  await shot("edit-refused");
  check((await inspect()).pieces === joined.pieces, "a refusal changes the nets");

  // A change of the options keeps what was done by hand, where it can be, and so does a worker that was ended.
  await page.keyboard.press("Escape");
  await page.selectOption("#option-paper", "A3");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().options.paper === "A3", null, {timeout: 120000});
  const larger = await idle();
  check(larger.canUndo || larger.notes.some(({text}) => text.includes("von Hand")), "a option forgets what was done by hand, without a word");
  check(heard.length === 0, `the page says or asks: ${heard.slice(0, 5)}`);
  await context.close();
}

/** A project is saved, and opened by the program and by another page, with the same bytes; sizes and all else are undone. */
async function keepsProjects() {
  const {context, page, heard, inspect, idle, exported, drop, shot} = await open(values.page);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  await page.click("#samples button");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().figures !== null && !globalThis.ridgecraft.inspect().busy, null, {timeout: 120000});
  const first = await exported("fold");
  const resize = async (size) => {
    await page.fill("#option-size", size);
    await page.waitForFunction((wanted) => (globalThis.ridgecraft.inspect().options.size ?? "") === wanted, size, {timeout: 120000});
    return idle();
  };
  await resize("150");
  const {folds, joins} = await inspect();
  if (values.browser === "chromium") {
    await page.click("#export");
    await Promise.all([page.waitForEvent("download"), page.click("#export-menu button")]);
  }
  const [x, y] = (await inspect({edge: folds[Math.floor(folds.length / 3)]})).places.sheet;
  await page.mouse.click(x, y);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().offer, null, {timeout: 20000});
  await page.click("#edit button");
  const cut = await idle();
  check(cut.error === "", `a cut is refused: ${cut.error}`);
  const numbers = new Set(cut.joins.map(({number}) => number));
  check(joins.every(({number}) => numbers.has(number)), "a cut changes the numbers of other seams");
  await page.focus('[data-piece="1"]');
  await page.keyboard.press("Shift+ArrowDown");
  await idle();
  const edited = await exported("fold");
  if (values.browser === "chromium") {
    // Of two sheets one has changed since they were printed.
    await page.click("#export");
    const changed = page.locator("#export-menu button", {hasText: "what changed"});
    if (await changed.count() > 0) {
      const [download] = await Promise.all([page.waitForEvent("download"), changed.click()]);
      const pages = Number(execFileSync("qpdf", ["--show-npages", await download.path()], {encoding: "utf8"}));
      const all = (await inspect()).figures.pages;
      check(pages >= 1 && pages < all && /-\d+\.pdf$/.test(download.suggestedFilename()), `${download.suggestedFilename()} has ${pages} of ${all} pages`);
    } else {
      await page.keyboard.press("Escape");
    }
  }

  // By a millimetre more and back: the same bytes.
  await resize("151");
  check(!(await exported("fold")).equals(edited), "151 mm are 150 mm");
  await resize("150");
  check((await exported("fold")).equals(edited), "150, 151, 150 mm: other bytes than before");

  // Saved as a file: the program and another page make the same of it.
  for (const format of ["ridgecraft", "html"]) {
    const bytes = await exported(format);
    writeFileSync(`${out}/mine.${format}`, bytes);
    execFileSync(values.program, [`${out}/mine.${format}`, "--overwrite", "--quiet", "-o", `${out}/mine.fold`, "-o", `${out}/again.${format}`], {stdio: ["ignore", "ignore", "inherit"]});
    check(readFileSync(`${out}/mine.fold`).equals(edited), `${format} opened by the program: other bytes`);
    check(readFileSync(`${out}/again.${format}`).equals(bytes), `${format} written by the program again: other bytes`);
    const other = await open(values.page);
    await other.page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
    await other.drop([[`mine.${format}`, bytes]]);
    await other.page.waitForFunction(() => globalThis.ridgecraft.inspect().figures !== null && !globalThis.ridgecraft.inspect().busy, null, {timeout: 120000});
    check((await other.exported("fold")).equals(edited), `${format} opened by another page: other bytes`);
    await other.context.close();
  }

  // Nets alone open, too.
  const alone = await open(values.page);
  await alone.page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  await alone.drop([["whale.fold", edited]]);
  await alone.page.waitForFunction(() => globalThis.ridgecraft.inspect().figures !== null || globalThis.ridgecraft.inspect().error !== "", null, {timeout: 120000});
  const nets = await alone.idle();
  check(nets.error === "" && nets.pieces === cut.pieces, `nets alone: ${nets.error}, ${nets.pieces} pieces of ${cut.pieces}`);
  await alone.shot("nets-alone");
  await alone.context.close();

  // All of it back to the beginning, at once: options and edits.
  const steps = (await inspect()).moment;
  await page.evaluate((count) => {
    document.activeElement?.blur();
    for (let i = 0; i < count; ++i) {
      document.body.dispatchEvent(new KeyboardEvent("keydown", {key: "z", ctrlKey: true, bubbles: true, cancelable: true}));
    }
  }, steps);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().moment === 0, null, {timeout: 60000});
  await idle();
  check((await exported("fold")).equals(first), "undone to the beginning: other bytes than at first");

  // What can't be is said in words of the page.
  for (const [option, value] of [["faces", "takes"], ["size", "12m"], ["size", "abc"], ["margin", "-3"]]) {
    await page.evaluate(() => document.querySelector("#options details").setAttribute("open", ""));
    await page.fill(`#option-${option}`, value);
    await page.waitForFunction(() => globalThis.ridgecraft.inspect().error !== "", null, {timeout: 120000}).catch(() => {});
    const {error} = await idle();
    check(error !== "" && !/--\w/.test(error), `${option} "${value}": "${error}"`);
    console.log(`    ${option} "${value}": ${error} [${await page.locator("#try-it").isVisible() ? await page.textContent("#try-it") : ""}]`);
    await page.fill(`#option-${option}`, "");
    await page.click("#dismiss");
    await idle();
  }
  await shot("projects");
  check(heard.length === 0, `the page says or asks: ${heard.slice(0, 5)}`);
  await context.close();
}

/** A page with a model in it, as `ridgecraft studio` writes it. */
async function beginsWithAModel() {
  const words = ["studio", `${values.samples}/fox_head.obj`, "--paper", "A3", "--no-browser"];
  const started = execFileSync(values.program, words, {encoding: "utf8", env: {...process.env, XDG_RUNTIME_DIR: out}}).trim();
  const {context, page, heard, idle, exported} = await open(started);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().figures, null, {timeout: 120000});
  const shown = await idle();
  check(shown.options.paper === "A3" && shown.project === "fox_head.obj", `${basename(started)} begins with ${shown.project} and ${JSON.stringify(shown.options)}`);
  check((await exported("fold")).equals(native("fox_head", ".fold", "--paper", "A3")), "FOLD of the studio's page: other bytes than the program's");
  check(heard.length === 0, `the page says or asks: ${heard.slice(0, 5)}`);
  await context.close();
}

/** The same on other screens; the pictures are for people. */
async function otherScreens() {
  for (const [name, options] of [["phone", {viewport: {width: 390, height: 800}, locale: "de-DE"}], ["dark", {colorScheme: "dark", locale: "de-DE"}]]) {
    const {context, page, heard, idle, shot} = await open(values.page, options);
    await shot(`${name}-welcome`);
    await page.click("#samples button:nth-child(2)");
    await page.waitForFunction(() => globalThis.ridgecraft?.inspect().figures, null, {timeout: 120000});
    await idle();
    check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name}: wider than the screen`);
    await shot(name);
    check(heard.length === 0, `${name}: the page says or asks: ${heard.slice(0, 5)}`);
    await context.close();
  }
}

for (const [name, run] of [["makes paper", makesPaper], ["edits by hand", editsByHand], ["keeps projects", keepsProjects], ["begins with a model", beginsWithAModel], ["other screens", otherScreens]]) {
  const before = faults.length;
  try {
    await run();
  } catch (error) {
    faults.push(error.stack ?? String(error));
  }
  console.log(`${faults.length === before ? "passed" : "FAILED"}  ${name}`);
}
for (const fault of faults) {
  console.log(`    ${fault}`);
}
writeFileSync(`${out}/faults.txt`, faults.join("\n"));
await browser.close();
process.exit(faults.length > 0 ? 1 : 0);
