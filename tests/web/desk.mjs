// SPDX-License-Identifier: GPL-3.0-or-later
// Several pieces at once, other sheets, keys at edges and one tab by itself. The program is played (played.mjs).
import {pathToFileURL} from "node:url";

import {launch, settled} from "./browsers.mjs";
import {playedPage} from "./played.mjs";
import {end, runAll, subject} from "./subject.mjs";

const {values, require, out, faults, check} = subject();
const file = await playedPage(values);
const browser = await launch(require, values.browser, true);

async function open(options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, reducedMotion: "reduce", locale: "en-GB", ...options});
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  const inspect = (about) => page.evaluate((a) => globalThis.ridgecraft.inspect(a), about);
  const idle = async () => {
    await page.waitForFunction(() => !globalThis.ridgecraft.inspect().busy);
    return inspect();
  };
  await page.click("#samples button");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
  await idle();
  const applied = async () => (await inspect()).notes.map(({text}) => text).filter((text) => text.startsWith("apply: ")).map((text) => text.slice(7));
  const shot = (name) => page.screenshot({path: `${out}/${values.browser}-${name}.png`});
  return {context, page, inspect, idle, applied, shot};
}

async function severalPieces() {
  const {context, page, inspect, idle, applied, shot} = await open();
  const {pieces} = await inspect();
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press("Control+a");
  check((await inspect()).chosen.length === pieces, "Ctrl+A doesn't choose all pieces");
  await page.waitForSelector("#edit:not([hidden])");
  await shot("several");
  await page.click("#edit button:has-text('Align left')");
  await idle();
  const line = (await applied()).at(-1) ?? "";
  check(line.split("; ").length === pieces && line.split("; ").every((edit) => edit.startsWith("place ")), `aligned by "${line}"`);

  // A piece of the first sheet goes to the second.
  await page.keyboard.press("Escape");
  await page.focus('[data-piece="0"]');
  await page.keyboard.press("Escape");
  const [x, y] = await page.evaluate(() => {
    const {left, top, width, height} = document.querySelector('[data-piece="0"] .faces').getBoundingClientRect();
    for (let k = 0; k < 900; ++k) {
      const at = [left + ((1 + k % 30) * width) / 31, top + ((1 + Math.floor(k / 30)) * height) / 31].map(Math.round);
      const {sheet} = globalThis.ridgecraft.inspect({x: at[0], y: at[1]}).under;
      if (sheet?.piece === 0 && sheet.edge < 0) {
        return at;
      }
    }
    return [0, 0];
  });
  await page.mouse.click(x, y);
  await page.click("#edit details summary");
  await page.click("#edit details button:has-text('To sheet 2')");
  await idle();
  check(/^place \d+ 2 /.test((await applied()).at(-1) ?? ""), `to sheet 2 by "${(await applied()).at(-1)}"`);

  // Held at the lower border of the view it scrolls the sheets; over the corner of a sheet it is laid just inside.
  await page.keyboard.press("Escape");
  const view = () => page.evaluate(() => document.getElementById("plan").getAttribute("viewBox").split(" ").map(Number));
  const before = await view();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 40);
  await page.mouse.move(x + 5, 755);
  await page.waitForTimeout(400);
  const after = await view();
  check(after[1] > before[1] + 5, `at the border of the view the sheets stay at ${after[1]}`);
  await page.mouse.up();
  await idle();
  await page.click("#fit-sheets");
  await settled(page);
  await page.keyboard.press("Escape");
  const corner = await page.evaluate(() => {
    const {left, bottom} = document.querySelector(".page .sheet").getBoundingClientRect();
    return [left, bottom];
  });
  const box = await page.locator('[data-piece="0"] .faces').boundingBox();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 20);
  await page.mouse.move(x + corner[0] - box.x - 0.8 * box.width, y + corner[1] - box.y - box.height + 30, {steps: 4});
  await page.mouse.up();
  await idle();
  check(/^place \d+ \d+ 60 60 /.test((await applied()).at(-1) ?? ""), `dropped over the corner it is laid by "${(await applied()).at(-1)}": ${(await inspect()).error}`);
  await context.close();
}

async function keysAtEdges() {
  const {context, page, inspect, idle, applied, shot} = await open();
  const {folds, joins} = await inspect();
  const over = async (edge) => {
    const [x, y] = (await inspect({edge})).places.sheet;
    await page.mouse.move(x - 3, y - 3);
    await page.mouse.move(x, y);
    return page.evaluate(() => document.getElementById("foot").dataset.keys);
  };
  const fold = folds[Math.floor(folds.length / 2)];
  check(await over(fold) === "C: cut", `at a fold the keys are ${await over(fold)}`);
  await shot("legend");
  await page.keyboard.press("c");
  await idle();
  check(/^cut \d+ \d+$/.test((await applied()).at(-1) ?? ""), `C does "${(await applied()).at(-1)}"`);
  const seam = joins.find(({pieces, number}) => pieces[0] !== pieces[1] && number > 20).edges[0];
  check(/^J: join   T: tab over   X: no tab$/.test(await over(seam)), `at a seam the keys are ${await over(seam)}`);
  for (const [key, verb] of [["j", "join"], ["t", "tab-from"], ["x", "no-tab"]]) {
    await over(seam);
    await page.keyboard.press(key);
    await idle();
    check((await applied()).at(-1)?.startsWith(`${verb} `), `${key} does "${(await applied()).at(-1)}"`);
  }

  // One tab by itself.
  await page.keyboard.press("Escape");
  const [x, y] = (await inspect({edge: seam})).places.sheet;
  await page.mouse.click(x, y);
  await page.click("#edit summary");
  await page.fill("#edit .shape label:nth-child(1) input", "7,5");
  await page.fill("#edit .shape label:nth-child(2) input", "60");
  await shot("tab-shape");
  await page.click("#edit .shape button");
  await idle();
  check(/^tab-shape \d+ \d+ 7\.5 60$/.test((await applied()).at(-1) ?? ""), `a tab is shaped by "${(await applied()).at(-1)}"`);

  // An option is found by its words.
  await page.fill("#find-option", "margin");
  const labels = await page.locator("#options label:visible").allTextContents();
  check(labels.length > 0 && labels.every((text) => /margin/i.test(text)), `"margin" finds ${labels}`);
  await shot("found");
  await context.close();
}

/** What an edit leaves as it was isn't drawn anew: its elements stay, with the focus. */
async function whatStays() {
  const {context, page, inspect, idle} = await open();
  const {folds, pieces} = await inspect();
  await page.evaluate(() => {
    globalThis.before = [...document.querySelectorAll("#plan [data-piece]")];
    globalThis.canvas = document.getElementById("stage");
    globalThis.before[1].focus();
  });
  const [x, y] = (await inspect({edge: folds[0]})).places.sheet;
  await page.mouse.move(x - 3, y - 3);
  await page.mouse.move(x, y);
  await page.keyboard.press("c");
  await idle();
  await settled(page);
  const now = await page.evaluate(() => ({
    same: [...document.querySelectorAll("#plan [data-piece]")].filter((piece, k) => piece === globalThis.before[k]).length,
    pages: document.querySelectorAll("#plan .page").length, marks: document.querySelectorAll("#plan .marks").length,
    texts: document.querySelectorAll("#plan .furniture").length, focus: globalThis.before.indexOf(document.activeElement),
    canvas: document.getElementById("stage") === globalThis.canvas,
    lit: [...document.querySelectorAll("#plan .piece")].every((piece) => !piece.hasAttribute("transform"))}));
  check(now.same === pieces && now.canvas, `of ${pieces} pieces that look as before ${now.same} stayed`);
  check(now.focus >= 0, "the focus is lost by an edit");
  check(now.pages === 2 && now.marks === 1 && now.texts === 2 && now.lit, `after an edit there are ${JSON.stringify(now)}`);
  const order = await page.evaluate(() => [...document.querySelectorAll("#plan [data-piece]")].map((piece) => Number(piece.dataset.piece)));
  check(order.every((index, k) => index === k), `keys go through pieces in the order ${order}`);
  await context.close();
}

/** Beside the sheets a piece stays as long as somebody wants; nothing is printed meanwhile. */
async function besideTheSheets() {
  const {context, page, inspect, idle, applied, shot} = await open();
  const {folds} = await inspect();
  await page.evaluate(() => (document.body.dataset.snap = "off"));
  const insideOf = (index) => page.evaluate((k) => {
    const view = document.getElementById("plan").getBoundingClientRect();
    const {left, top, width, height} = document.querySelector(`[data-piece="${k}"] .faces`).getBoundingClientRect();
    for (let i = 0; i < 900; ++i) {
      const at = [left + ((1 + i % 30) * width) / 31, top + ((1 + Math.floor(i / 30)) * height) / 31].map(Math.round);
      const {sheet} = globalThis.ridgecraft.inspect({x: at[0], y: at[1]}).under;
      if (sheet?.piece === k && sheet.edge < 0 && at[0] > view.left + 4) {
        return at;
      }
    }
    return null;
  }, index);
  const boxOf = (index) => page.locator(`[data-piece="${index}"] .faces`).boundingBox();
  const drag = async (index, to) => {
    await page.keyboard.press("Escape");
    const [x, y] = await insideOf(index);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 10, y + 5);
    await page.mouse.move(x + to[0], y + to[1], {steps: 3});
    await page.mouse.up();
    await idle();
  };
  const sheet = await page.locator(".page .sheet").first().boundingBox();
  const before = await boxOf(0);
  // Wholly to the left of its sheet, as far from the border of the view as doesn't scroll.
  await drag(0, [sheet.x - 12 - before.x - before.width, 0]);
  const after = await boxOf(0);
  check((await inspect()).loose.join() === "0" && (await applied()).length === 0, `beside its sheet a piece is laid by "${await applied()}"`);
  check(Math.abs(after.x + after.width - sheet.x + 12) < 1.5 && Math.abs(after.y - before.y) < 1.5, `let go ${12} pixels beside the sheet it is at ${JSON.stringify(after)}`);
  await shot("beside");

  // It is found there, and not where it was.
  check((await insideOf(0)) !== null, "a piece beside the sheets isn't found there");
  const old = await page.evaluate(([x, y]) => globalThis.ridgecraft.inspect({x, y}).under.sheet, [before.x + before.width / 2, before.y + before.height / 2]);
  check(old?.piece !== 0, "a piece beside the sheets is found where it was");

  // Nothing with sheets is saved or printed, and one sentence says which piece it is.
  await page.evaluate(() => {
    globalThis.downloads = [];
    HTMLAnchorElement.prototype.click = function () {
      globalThis.downloads.push(this.download);
    };
  });
  const downloads = () => page.evaluate(() => globalThis.downloads);
  const {menus} = await page.evaluate(() => {
    document.getElementById("export").click();
    return {menus: [...document.querySelectorAll("#export-menu button")].map((button) => button.textContent)};
  });
  await page.click(`#export-menu button:has-text("${menus[0]}")`);
  await idle();
  const {error} = await inspect();
  check(/^Piece A lies beside its sheet/.test(error) && (await downloads()).length === 0, `with a piece beside the sheets ${await downloads()} is saved, and said "${error}"`);
  const printed = await page.evaluate(() => {
    dispatchEvent(new Event("beforeprint"));
    const {textContent} = document.getElementById("print");
    dispatchEvent(new Event("afterprint"));
    return textContent;
  });
  check(printed === error, `printed is "${printed.slice(0, 80)}"`);
  await page.keyboard.press("Control+s");
  await idle();
  check((await downloads()).join() === "whale.ridgecraft", `the project isn't saved, but ${await downloads()}`);

  await page.click("#fit-sheets");
  await settled(page);
  const whole = await boxOf(0);
  check(whole.x > (await page.locator("#plan").boundingBox()).x, "what lies beside the sheets isn't shown with all");

  // Another edit leaves it there; a piece that is laid takes it along where it has room then.
  const [fx, fy] = (await inspect({edge: folds[0]})).places.sheet;
  await page.mouse.move(fx - 3, fy - 3);
  await page.mouse.move(fx, fy);
  await page.keyboard.press("Escape");
  let other = 1;
  while (!(await insideOf(other))) {
    ++other;
  }
  await drag(other, [8, 0]);
  const kept = await boxOf(0);
  check((await applied()).at(-1)?.split("; ").length === 1 && (await inspect()).loose.join() === "0" && kept.width > 20,
    `with one piece beside the sheets another is laid by "${(await applied()).at(-1)}"`);

  // Turned there, and dragged back.
  await page.keyboard.press("Escape");
  await page.mouse.click(...await insideOf(0));
  await page.keyboard.press("r");
  await idle();
  const turned = await boxOf(0);
  check((await inspect()).loose.join() === "0" && Math.abs(turned.x + turned.width / 2 - kept.x - kept.width / 2) < 12, "a piece beside the sheets doesn't turn there");
  const own = await page.locator(".page .sheet").first().boundingBox();
  await drag(0, [own.x + own.width / 2 - turned.x - turned.width / 2, 0]);
  const last = (await applied()).at(-1) ?? "";
  check((await inspect()).loose.length === 0 && /^place \d+ 1 /.test(last), `back on its sheet it is laid by "${last}"`);
  check(await page.locator("#take-back").count() === 0, "a piece that is laid is said to lie beside the sheets");
  await context.close();
}

/** Several pieces have a frame, and turn about its middle. */
async function frames() {
  const {context, page, inspect, idle, applied, shot} = await open();
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press("Control+a");
  await page.waitForSelector(".frame-line");
  await shot("frame");
  const [menu, sheets] = [await page.locator("#edit").boundingBox(), await page.locator(".frame-line").boundingBox()];
  check(menu.x + menu.width <= sheets.x || menu.x >= sheets.x + sheets.width, `the menu at ${JSON.stringify(menu)} covers the pieces at ${JSON.stringify(sheets)}`);
  const {pieces} = await inspect();
  const handle = await page.locator(".turn-handle").boundingBox();
  const frame = await page.locator(".frame-line").boundingBox();
  const [hx, hy] = [handle.x + handle.width / 2, handle.y + handle.height / 2];
  const before = await page.evaluate(() => [...document.querySelectorAll("[data-piece]")].map((piece) => piece.getBoundingClientRect().x));
  await page.mouse.move(hx, hy);
  await page.mouse.down();
  // A quarter to the right: the handle goes to the right of the frame's middle.
  await page.mouse.move(frame.x + frame.width / 2 + 60, hy + 20);
  await page.mouse.move(frame.x + frame.width / 2 + 100, frame.y + frame.height / 2, {steps: 3});
  const shifted = await page.evaluate(() => [...document.querySelectorAll("[data-piece][transform]")].map((piece) => piece.getAttribute("transform")));
  check(!(await page.isVisible("#edit")), "the menu stays while pieces are turned");
  await shot("turning");
  await page.mouse.up();
  await idle();
  check(shifted.length === pieces && shifted.every((text) => /^rotate\(90/.test(text)), `while it turns, pieces are shown by ${shifted}`);
  const left = new Set((await inspect()).loose);
  const laid = ((await applied()).at(-1) ?? "").split("; ").filter((line) => line.startsWith("place"));
  check(left.size === pieces || laid.length === pieces, `of ${pieces} pieces that were turned ${laid.length} were laid and ${left.size} are left`);
  await page.keyboard.press("Control+z");
  check((await page.evaluate(() => [...document.querySelectorAll("[data-piece]")].map((piece) => piece.getBoundingClientRect().x))).length === before.length, "pieces are lost by a turn");
  await context.close();
}

/** Words of what is pointed at come and go, and what is pointed at stays below the pointer: a click would miss it otherwise. */
async function pointingMovesNothing() {
  for (const width of [1280, 1024]) {
    const {context, page, inspect, shot} = await open({viewport: {width, height: 800}, locale: "de-DE"});
    const views = () => page.evaluate(() => ["stage", "plan"].map((id) => {
      const {left, top, right, bottom} = document.getElementById(id).getBoundingClientRect();
      return [left, top, right, bottom].join(" ");
    }).join(", "));
    await settled(page);
    const before = await views();
    const lines = new Set();
    const {joins, folds} = await inspect();
    for (const edge of [...joins.filter((_, k) => k % 6 === 0).map(({edges}) => edges[0]), folds[0]]) {
      await page.mouse.move(...(await inspect({edge})).places.sheet.map(Math.round));
      await settled(page);
      lines.add(await page.evaluate(() => document.querySelector("footer").offsetHeight));
      const now = await views();
      if (now !== before) {
        check(false, `at edge ${edge} the views lie at ${now}, and before at ${before}`);
        break;
      }
    }
    check(lines.size > 1, `at a width of ${width} no words take more lines than others`);
    await shot(`foot-${width}`);
    await context.close();
  }
}

await runAll(browser, [severalPieces, keysAtEdges, pointingMovesNothing, whatStays, besideTheSheets, frames], faults);
await end(browser, faults);
