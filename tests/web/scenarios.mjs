// SPDX-License-Identifier: GPL-3.0-or-later
// What people do with a page, and what has to come of it. Pictures of all screens are kept in the folder of results; what
// they show is asked of the page itself (window.ridgecraft.inspect), not compared pixel by pixel.
import {readFileSync, writeFileSync} from "node:fs";
import {pathToFileURL} from "node:url";

import {unpackedText} from "../../web/packed.js";
import {settled} from "./browsers.mjs";
import {darkRows, pageSizes} from "./pdf_pages.mjs";

const everywhere = ["chromium", "firefox", "painter"];
const wide = {width: 1200, height: 760};
/** Fold angles below 0.0001 degrees are written as flat: over a large model that is so much, mm. */
const flatFoldsMiss = 1e-4;

/** A page of its own, offline, that takes notes of what it says and asks for. `before` is run in it first. */
async function open({browser, browserName}, file, options = {}, before = () => {}) {
  const context = await browser.newContext({viewport: wide, reducedMotion: "reduce", locale: "en-GB", ...options});
  if (browserName === "chromium") {
    await context.setOffline(true);
  }
  const page = await context.newPage();
  const heard = {messages: [], requests: []};
  page.on("console", (message) => {
    // What the graphics driver says of its speed when pictures are read back.
    if (!message.text().includes("GL Driver Message")) {
      heard.messages.push(message.text());
    }
  });
  page.on("pageerror", (error) => heard.messages.push(error.message));
  page.on("request", (request) => heard.requests.push(request.url()));
  await page.addInitScript(before);
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().firstPicture > 0);
  const inspect = (about) => page.evaluate((a) => globalThis.ridgecraft.inspect(a), about);
  const frame = () => settled(page);
  return {context, page, heard, inspect, frame};
}

/** Where a pointer can be: Firefox knows whole pixels only. */
const pixel = (place) => place.map(Math.round);

async function setSlider(page, share) {
  await page.evaluate((t) => {
    const slider = document.getElementById("fold-slider");
    slider.value = String(Math.round(1000 * t));
    slider.dispatchEvent(new Event("input", {bubbles: true}));
  }, share);
}

/** Numbers that look random, and are the same each time. */
function* dice(seed) {
  for (let state = seed; ;) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield state / 2 ** 32;
  }
}

function shuffled(list, seed) {
  const random = dice(seed);
  return list.map((item) => [random.next().value, item]).sort((a, b) => a[0] - b[0]).map(([, item]) => item);
}

async function opens(given) {
  for (const name of Object.keys(given.files)) {
    const {context, page, heard, inspect} = await open(given, given.files[name]);
    const shown = await inspect();
    given.check(heard.requests.length === 1 || (given.here === "firefox" && heard.requests.length === 0), `${name}: more is asked for than the file: ${heard.requests}`);
    given.check(heard.messages.length === 0, `${name}: the console says ${heard.messages}`);
    given.check(shown.title === name, `${name}: the title is ${shown.title}`);
    given.check(shown.facesInView, `${name}: not all faces are in view`);
    given.check(shown.refoldError < (name === "whale" ? 1e-6 : flatFoldsMiss), `${name}: folding misses the model by ${shown.refoldError} mm`);
    given.check(shown.simple === (given.here === "painter") || given.here === "firefox", `${name}: drawn in the wrong way`);
    const fold = readFileSync(given.files[name].replace(".html", ".fold"), "utf8");
    given.check(await unpackedText(await page.textContent("#fold")) === fold, `${name}: the page has other nets than the file`);
    console.log(`    ${name}: first picture after ${shown.firstPicture.toFixed(0)} ms, script ${shown.script.toFixed(1)} ms a frame`);
    await page.screenshot({path: `${given.out}/${given.here}-${name}.png`});
    await context.close();
  }
}

/** Kinds of graphics cards that fail: the model is seen all the same. */
async function graphics(given) {
  /** Pixels of the model's view that aren't bare. */
  const seen = (page) => page.evaluate(() => {
    globalThis.ridgecraft.inspect({red: true});  // draws
    const stage = document.getElementById("stage");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [stage.width, stage.height];
    const context = copy.getContext("2d");
    context.drawImage(stage, 0, 0);
    return context.getImageData(0, 0, copy.width, copy.height).data.filter((value, i) => i % 4 === 3 && value > 200).length;
  });
  const painter = await open(given, given.files.whale, {}, () => {
    WebGL2RenderingContext.prototype.linkProgram = () => {};
  });
  given.check((await painter.inspect()).simple, "shaders that don't link are drawn with");
  given.check(await seen(painter.page) > 1000, "nothing is seen where shaders don't link");
  await painter.page.keyboard.press("Tab");
  given.check(await painter.page.evaluate(() => document.querySelectorAll("#stage").length) === 1, "the stage isn't there once");
  await painter.page.screenshot({path: `${given.out}/${given.here}-no-shaders.png`});
  await painter.context.close();

  const {context, page, heard, frame, inspect} = await open(given, given.files.lighthouse);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().painted || document.getElementById("colours").hidden);
  const before = await seen(page);
  given.check(before > 1000, "nothing is seen of the lighthouse");
  await page.evaluate(async () => {
    const stage = document.getElementById("stage");
    const heardOf = (name) => new Promise((done) => stage.addEventListener(name, done, {once: true}));
    const extension = stage.getContext("webgl2").getExtension("WEBGL_lose_context");
    const lost = heardOf("webglcontextlost");
    extension.loseContext();
    await lost;
    await new Promise((done) => setTimeout(done));
    const restored = heardOf("webglcontextrestored");
    extension.restoreContext();
    await restored;
  });
  await frame();
  const after = await seen(page);
  given.check(after > 0.9 * before && after < 1.1 * before, `${before} pixels of the model became ${after} when the graphics card came back`);
  given.check(!(await inspect()).simple, "the simple view is shown when the graphics card came back");
  given.check(heard.messages.every((text) => text.includes("WebGL")), `the console says ${heard.messages}`);
  await page.screenshot({path: `${given.out}/${given.here}-restored.png`});
  await context.close();
}

async function links(given) {
  const {context, page, inspect, frame} = await open(given, given.files.whale);
  const start = await inspect();
  let tried = 0;
  for (const join of shuffled(start.joins, 1)) {
    const [e, f] = join.edges;
    const at = pixel((await inspect({edge: e})).places.sheet);
    const under = (await inspect({x: at[0], y: at[1]})).under.sheet;
    if (under?.edge !== e) {
      continue;  // another edge is nearer to this pixel
    }
    await page.mouse.move(at[0], at[1]);
    await frame();
    const lit = await inspect({red: true});
    given.check(lit.foot.includes(` ${join.number}:`), `join ${join.number} is called ${lit.foot}`);
    given.check(lit.marked.length === 2 && lit.marked.includes(e) && lit.marked.includes(f), `join ${join.number} marks ${lit.marked}`);
    given.check(lit.red > 10, `join ${join.number} isn't seen on the model`);
    given.check(join.pieces.every((piece) => lit.looks[piece] === "plain") && lit.looks.filter((look) => look === "plain").length ===
      new Set(join.pieces).size, `join ${join.number} lights other pieces than its own`);
    if (++tried === 20) {
      // In Firefox the pointer's next move is lost after a picture.
      if (given.browserName === "chromium") {
        await page.screenshot({path: `${given.out}/${given.here}-hover-sheet.png`});
      }
      break;
    }
  }
  given.check(tried === 20, `only ${tried} joins could be pointed at on the sheets`);
  tried = 0;
  for (const join of shuffled(start.joins, 2)) {
    const e = join.edges[0];
    const at = pixel((await inspect({edge: e})).places.model);
    const under = (await inspect({x: at[0], y: at[1]})).under.model;
    const free = await page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.id === "stage", at);
    if (!free || under === null || !join.edges.includes(under.edge)) {
      continue;  // on the side that isn't seen
    }
    await page.mouse.move(at[0], at[1], {steps: 2});
    await frame();
    const lit = await inspect();
    given.check(lit.foot.includes(` ${join.number}:`), `join ${join.number} of the model is called ${lit.foot}`);
    given.check(await page.locator("#plan .mark").count() === 2, `join ${join.number} of the model isn't marked on the sheets`);
    if (++tried === 10) {
      await page.screenshot({path: `${given.out}/${given.here}-hover-model.png`});
      break;
    }
  }
  given.check(tried >= 5, `only ${tried} joins could be pointed at on the model`);
  // A click keeps what is lit; another on nothing lets go.
  const piece = start.joins[0].pieces[0];
  await page.locator(`#plan [data-piece="${piece}"]`).focus();
  await page.keyboard.press("Enter");
  await frame();
  given.check((await inspect()).chosen.includes(piece), "a piece isn't chosen by the return key");
  await page.keyboard.press("Escape");
  given.check((await inspect()).chosen.length === 0, "the escape key doesn't let go");
  await context.close();
}

async function folds(given) {
  for (const name of ["whale", "lighthouse"]) {
    const {context, page, inspect, frame} = await open(given, given.files[name]);
    for (let t = 0; t <= 1.0001; t += 0.1) {
      await setSlider(page, t);
      await frame();
      const shown = await inspect();
      given.check(Math.abs(shown.folded - t) < 0.001, `${name}: the slider stands at ${shown.folded} and not at ${t}`);
      given.check(shown.facesInView, `${name}: at ${t.toFixed(2)} faces leave the picture`);
      if ([0, 0.3, 0.6, 0.8].some((kept) => Math.abs(kept - t) < 0.001)) {
        await page.screenshot({path: `${given.out}/${given.here}-${name}-folded-${Math.round(100 * t)}.png`});
      }
    }
    given.check((await inspect()).refoldError < flatFoldsMiss, `${name}: folding misses the model`);
    await context.close();
  }
}

async function steps(given) {
  const {context, page, inspect, frame} = await open(given, given.files.whale);
  const start = await inspect();
  await page.click("#build");
  const pieces = [];
  const joins = [];
  for (let k = 0; k < start.steps.length; ++k) {
    const shown = await inspect();
    given.check(shown.building && shown.step === k, `step ${k} isn't shown`);
    pieces.push(...shown.steps[k].pieces);
    joins.push(...shown.steps[k].joins);
    await setSlider(page, 0.3);
    await frame();
    given.check((await inspect()).looks.filter((look) => look === "plain").length === shown.steps[k].pieces.length,
      `step ${k}: its pieces aren't alone while they are folded`);
    await setSlider(page, 1);
    await frame();
    const glued = await inspect();
    given.check(glued.looks.every((look, p) => (look === "plain") === (pieces.includes(p))), `step ${k}: what stands isn't what was built`);
    given.check(glued.facesInView, `step ${k}: faces leave the picture`);
    if (k === 2) {
      await page.screenshot({path: `${given.out}/${given.here}-step.png`});
    }
    if (k + 1 < start.steps.length) {
      await page.click("#step-next");
    } else {
      await page.check("#tick");
    }
  }
  given.check(pieces.length === start.pieces && new Set(pieces).size === start.pieces, `pieces are built in the steps: ${pieces}`);
  given.check(joins.length === start.joins.length && new Set(joins).size === joins.length, "joins aren't closed once each");
  given.check((await inspect()).done.length === start.steps.length, "not all steps are ticked off");
  await page.reload();
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().firstPicture > 0);
  given.check((await inspect()).done.length === start.steps.length, "ticks are forgotten");
  await context.close();
}

async function keyboard(given) {
  const {context, page, inspect, frame} = await open(given, given.files.whale);
  const {pieces} = await inspect();
  const heard = new Map();
  // Not past the end: whoever leaves the page no longer learns what has the focus.
  for (let k = 0; k < 60 && heard.size < pieces; ++k) {
    await page.keyboard.press("Tab");
    const focus = await page.evaluate(() => ({piece: document.activeElement.getAttribute("data-piece"),
      label: document.activeElement.getAttribute("aria-label")}));
    if (focus.piece !== null) {
      heard.set(Number(focus.piece), focus.label);
      await frame();
      const lit = await inspect();
      given.check(lit.lit.length === 1 && lit.lit[0] === Number(focus.piece), `the model doesn't follow the focus to piece ${focus.piece}`);
      if (heard.size === 2) {
        await page.keyboard.press("ArrowDown");
        const edge = await page.evaluate(() => document.activeElement.getAttribute("aria-label"));
        given.check(/\d mm/.test(edge ?? ""), `the first edge of a piece says ${edge}`);
        await page.keyboard.press("ArrowDown");
        const next = await page.evaluate(() => document.activeElement.getAttribute("aria-label"));
        given.check(next !== edge, "the next edge of a piece is the same one");
      }
    }
  }
  given.check(heard.size === pieces, `${heard.size} of ${pieces} pieces are reached`);
  for (const [piece, label] of heard) {
    given.check(/^Piece .+, page \d+: \d+ faces?, \d+ folds?/.test(label), `piece ${piece} says ${label}`);
  }
  await page.evaluate(() => {
    document.activeElement.blur();
    globalThis.print = () => {
      globalThis.printed = true;
    };
  });
  await page.keyboard.press("b");
  given.check((await inspect()).building, "B doesn't begin building");
  await page.keyboard.press("ArrowRight");
  given.check((await inspect()).step === 1, "the right key doesn't go to the next step");
  await page.keyboard.press("d");
  given.check((await inspect()).done.includes(1), "D doesn't tick a step off");
  await page.keyboard.press("ArrowLeft");
  given.check((await inspect()).step === 0, "the left key doesn't go back");
  await page.keyboard.press("b");
  for (const end of [0, 1]) {
    await page.keyboard.press("Space");
    await page.waitForFunction((t) => globalThis.ridgecraft.inspect().folded === t, end, {timeout: 60_000});
  }
  await page.keyboard.press("?");
  given.check(await page.locator("#keys[open]").count() === 1, "? doesn't show the keys");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !document.getElementById("keys").open);
  await page.locator("#open-menu").focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.activeElement.closest("#menu") !== null);
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => globalThis.printed === true);
  await context.close();
}

async function prints(given) {
  for (const [name, size] of [["whale", [210, 297]], ["house", [148, 210]]]) {
    const {context, page} = await open(given, given.files[name]);
    const file = `${given.out}/${name}-printed.pdf`;
    writeFileSync(file, await page.pdf({preferCSSPageSize: true, printBackground: true}));
    const {pages: {length: pages}} = JSON.parse(await unpackedText(await page.textContent("#sheets")));
    const sizes = pageSizes(file);
    given.check(sizes.length === pages, `${name}: ${sizes.length} pages are printed, and not ${pages}`);
    for (const [width, height] of sizes) {
      given.check(Math.abs(width - size[0]) < 0.3 && Math.abs(height - size[1]) < 0.3, `${name}: a page is ${width} x ${height} mm`);
    }
    darkRows(file).forEach((rows, p) => {
      const foot = rows.slice(Math.round(0.85 * rows.length));
      given.check(foot.some((length) => Math.abs(length - 50) < 0.25), `${name}: no bar of 50 mm on page ${p + 1}, but ${Math.max(...foot)}`);
    });
    await context.close();
  }
}

async function languages(given) {
  const {context, page, inspect} = await open(given, given.files.whale, {locale: "de-DE"});
  given.check((await inspect()).language === "de", "a German reader gets another language");
  given.check(await page.evaluate(() => document.documentElement.lang) === "de", "the page doesn't say its language");
  given.check((await page.textContent("#build")) === "Bauen", "the button isn't German");
  await page.screenshot({path: `${given.out}/${given.here}-german.png`});
  await context.close();
}

async function accessible(given) {
  const axe = readFileSync(given.require.resolve("axe-core/axe.min.js"), "utf8");
  const small = {width: 400, height: 800};
  const looks = [["light", {colorScheme: "light"}], ["dark", {colorScheme: "dark"}], ["zoomed", {viewport: {width: 720, height: 450}}],
    ["phone", {viewport: small, hasTouch: true, isMobile: true, deviceScaleFactor: 2}],
    ["phone-dark", {viewport: small, colorScheme: "dark", hasTouch: true, isMobile: true, deviceScaleFactor: 2}]];
  for (const [name, options] of looks) {
    const {context, page, frame} = await open(given, given.files.lighthouse, options);
    const look = async (screen) => {
      await frame();
      await page.screenshot({path: `${given.out}/${given.here}-${name}-${screen}.png`});
      await page.evaluate(axe);
      const {violations} = await page.evaluate(() => globalThis.axe.run(document, {runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]}));
      for (const violation of violations) {
        given.check(false, `${name}, ${screen}: ${violation.id}: ${violation.help} (${violation.nodes.map((node) => node.html.slice(0, 100)).join("; ")})`);
      }
      const wider = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      given.check(wider <= 0, `${name}, ${screen}: ${wider} pixels wider than the window`);
    };
    await look("start");
    if (await page.locator("#show-sheets").isVisible()) {
      await page.click("#show-sheets");
      await look("sheets");
      await page.click("#show-model");
    }
    await page.click("#build");
    await look("building");
    await page.click("#open-menu");
    await look("menu");
    await page.keyboard.press("Escape");
    await page.keyboard.press("?");
    await look("keys");
    await context.close();
  }
}

export const scenarios = [
  {name: "open", where: everywhere, run: opens},
  {name: "graphics", where: ["chromium"], run: graphics},
  {name: "links", where: everywhere, run: links},
  {name: "fold", where: everywhere, run: folds},
  {name: "steps", where: ["chromium"], run: steps},
  {name: "keyboard", where: ["chromium", "firefox"], run: keyboard},
  {name: "print", where: ["chromium"], run: prints},
  {name: "languages", where: ["chromium"], run: languages},
  {name: "accessible", where: ["chromium"], run: accessible},
];
