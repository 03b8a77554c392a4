// SPDX-License-Identifier: GPL-3.0-or-later
// Moves pieces in the studio's page by mouse, keyboard and finger. The program behind it is played (played.mjs).
import {pathToFileURL} from "node:url";

import {launch, settled} from "./browsers.mjs";
import {playedPage} from "./played.mjs";
import {end, runAll, subject} from "./subject.mjs";

const {values, require, out, faults, check} = subject();

const file = await playedPage(values);

const browser = await launch(require, values.browser, true);

async function open(options) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, reducedMotion: "reduce", locale: "de-DE", ...options});
  const page = await context.newPage();
  page.setDefaultTimeout(120000);
  const heard = [];
  page.on("pageerror", (error) => /style-src-elem/.test(error.message) || heard.push(error.message));
  await page.goto(pathToFileURL(file).href);
  const inspect = (about) => page.evaluate((a) => globalThis.ridgecraft.inspect(a), about);
  const idle = async () => {
    await page.waitForFunction(() => !globalThis.ridgecraft.inspect().busy, null, {timeout: 60000});
    return inspect();
  };
  // Distances are measured here; desk.mjs and unit/snap.test.mjs have what snaps.
  await page.evaluate(() => (document.body.dataset.snap = "off"));
  await page.click("#samples button");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0, null, {timeout: 60000});
  if (options?.viewport?.width < 700) {
    await page.click("#show-sheets");
  }
  /** The piece that takes the most room: which one that is depends on how the model is unfolded. */
  const largest = await page.evaluate(() => {
    const areaOf = (piece) => {
      const {width, height} = piece.querySelector(".faces").getBoundingClientRect();
      return width * height;
    };
    const pieces = [...document.querySelectorAll("[data-piece]")].sort((a, b) => areaOf(b) - areaOf(a));
    return Number(pieces[0].dataset.piece);
  });
  /** A point of a piece in the window, away from its edges. */
  const inside = async (piece) => {
    await settled(page);
    const point = await page.evaluate((index) => {
      const box = document.querySelector(`[data-piece="${index}"] .faces`).getBoundingClientRect();
      for (let i = 1; i < 40; ++i) {
        for (let j = 1; j < 40; ++j) {
          const [x, y] = [Math.round(box.left + (i * box.width) / 40), Math.round(box.top + (j * box.height) / 40)];  // as a mouse has them
          const spot = globalThis.ridgecraft.inspect({x, y}).under.sheet;
          if (spot && spot.piece === index && spot.edge < 0) {
            return [x, y];
          }
        }
      }
      return null;
    }, piece);
    if (!point) {
      throw new Error(`piece ${piece} has no point away from its edges`);
    }
    return point;
  };
  const lines = async (call) => (await inspect()).notes.map(({text}) => text).filter((text) => text.startsWith(`${call}: `)).map((text) => text.slice(call.length + 2));
  return {context, page, heard, inspect, idle, largest, inside, lines};
}

const numbers = (line) => line.split(" ").slice(1).map(Number);
const scaleOf = (page) => page.evaluate(() => {
  const svg = document.getElementById("plan");
  return svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
});

async function byMouse() {
  const {context, page, heard, inspect, idle, largest, inside, lines} = await open();
  const [x, y] = await inside(largest);
  const scale = await scaleOf(page);
  // Drags stay on the piece's page.
  const inwards = await page.evaluate(([index, at]) => {
    const {left, width} = document.querySelector(`[data-piece="${index}"]`).closest(".page").querySelector(".sheet").getBoundingClientRect();
    return at < left + width / 2 ? 1 : -1;
  }, [largest, x]);

  // A drag lays the piece so much further. One that is held at the border scrolls: each begins from the same view.
  const drag = async (dx, dy, meanwhile = async () => {}) => {
    await page.keyboard.press("Home");
    await settled(page);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx / 2, y + dy / 2);
    await page.mouse.move(x + dx, y + dy);
    await meanwhile();
    await page.mouse.up();
    return idle();
  };
  await drag(0, 1);
  check((await lines("apply")).length === 0, "a click lays a piece");
  await page.keyboard.press("Escape");
  await drag(60 * inwards, 40, async () => {
    check(await page.locator(".new-page").count() === 1, "there is no new page while a piece is dragged");
    const shifts = await page.evaluate(() => ["[data-piece]", ".ground > g"].map((kind) =>
      [...document.querySelectorAll(`${kind}[transform]`)].map((part) => part.getAttribute("transform")).join()));
    check(shifts[0] !== "" && shifts[0] === shifts[1], `a piece is dragged by ${shifts[0]}, the colour below it by ${shifts[1]}`);
    await page.screenshot({path: `${out}/${values.browser}-dragged.png`});
  });
  const first = (await lines("apply")).at(-1) ?? "";
  await drag(120 * inwards, 40);
  const second = (await lines("apply")).at(-1) ?? "";
  const [a, b] = [numbers(first), numbers(second)];
  check(first.startsWith("place ") && a[0] === b[0] && a[1] === b[1] && Math.abs(b[2] - a[2] - 60 * inwards / scale) < 0.05 && Math.abs(b[3] - a[3]) < 0.05 && a[4] === b[4],
    `60 pixels further of ${scale} a mm: "${first}", "${second}"`);
  check((await lines("preview")).some((line) => line.startsWith("place ")), "no room is asked for while a piece is dragged");

  // Without room it is red, stays there, and why is said in German.
  const beyond = await page.evaluate((index) => {
    const first = Math.min(...[...document.querySelectorAll(".page .sheet")].map((sheet) => sheet.getBoundingClientRect().left));
    return document.querySelector(`[data-piece="${index}"]`).getBoundingClientRect().right - first;
  }, largest);
  const refused = await drag(-beyond - 20, 80, async () => page.waitForSelector(".no-room", {timeout: 5000}).catch(() => faults.push("what has no room isn't marked")));
  check(/^Teil A läge außerhalb/.test(refused.error), `a refusal says "${refused.error}"`);
  // The sentence goes with the next press elsewhere, or by Escape, and not by a press on itself.
  const refusal = page.locator("#refused");
  await refusal.locator("p").click();
  check(await refusal.isVisible(), "a press on a refusal takes it away");
  await page.mouse.click(4, 4);
  check(await refusal.isHidden(), "a refusal lies on the sheets while somebody goes on there");
  check((await inspect()).loose.join() === String(largest) && await page.locator(".loose[transform]").count() === 1, "what has no room doesn't stay where it was let go");
  await page.keyboard.press("Control+z");
  check((await inspect()).loose.length === 0 && await page.locator("[data-piece][transform], .loose, .no-room").count() === 0, "undo leaves a piece where it has no room");
  check((await lines("apply")).at(-1) === second, "a piece without room was laid");
  await page.keyboard.press("Escape");
  await drag(-700, 0);
  await page.keyboard.press("Escape");
  check(await refusal.isHidden(), "Escape leaves a refusal");
  await page.keyboard.press("Control+z");

  // Where it would find room nearby, that is shown, and it is laid there.
  await page.keyboard.press("Escape");
  await drag(0, 4 - y, async () => page.waitForSelector(".landing", {timeout: 5000}).catch(() => faults.push("where a piece will lie isn't shown")));
  const landed = numbers((await lines("apply")).at(-1) ?? "");
  check(landed[3] === 20 && Math.abs(landed[2] - a[2] + 60 * inwards / scale) < 0.05, `a piece without room is laid at ${landed}, and not nearby`);
  check(await page.locator(".landing, [data-piece][transform], .no-room").count() === 0, "where a piece was to lie stays shown");

  // A click offers what can be done.
  await page.keyboard.press("Escape");
  await page.mouse.click(...(await inside(largest)));
  const {offer} = await inspect();
  check(offer?.edits.map(({kind}) => kind).join() === "place,place,pack,retry,pin", `a piece is offered ${JSON.stringify(offer)}`);
  const texts = await page.locator("#edit > div > button").allTextContents();
  check(texts.join() === "Um 90° nach links drehen,Um 90° nach rechts drehen,Anderen Platz suchen,Andere Abwicklung,Festhalten", `the buttons say ${texts}`);
  await page.screenshot({path: `${out}/${values.browser}-offer.png`});

  // From an edge a button leads to its piece.
  await page.keyboard.press("Escape");
  const [fold] = (await inspect()).folds;
  await page.mouse.click(...(await inspect({edge: fold})).places.sheet);
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().offer);
  check(/^Hier schneiden,Teil \w+ …$/.test((await page.locator("#edit button").allTextContents()).join()), "an edge doesn't lead to its piece");
  await page.click("#edit button:last-child");
  check((await inspect()).offer?.edits[0].kind === "place", "the piece of an edge is offered nothing");
  await page.keyboard.press("Escape");
  await page.mouse.click(...(await inside(largest)));

  // The handle turns it, one way or the other: where it would lie on another piece, it doesn't.
  const turns = [];
  for (const [right, down] of [[80, 40], [-80, 40], [25, 5], [-25, 5]]) {
    const handle = await page.locator(".turn-handle").boundingBox();
    check(handle !== null, "a piece that is chosen has no handle");
    if (!handle || turns.some((degrees) => Math.abs(degrees - a[4]) > 5)) {
      break;
    }
    await page.mouse.move(handle.x + handle.width / 2, handle.y + handle.height / 2);
    await page.mouse.down();
    await page.mouse.move(handle.x + right, handle.y + down, {steps: 3});
    await page.mouse.up();
    await idle();
    turns.push(numbers((await lines("apply")).at(-1))[4]);
  }
  check(turns.some((degrees) => Math.abs(degrees - a[4]) > 5), `the handle turns from ${a[4]} to ${turns} degrees`);

  // Keys act on what is chosen.
  const after = async (key) => {
    await page.keyboard.press(key);
    await idle();
    return (await lines("apply")).at(-1) ?? "";
  };
  const right = numbers(await after("Shift+ArrowRight"));
  const up = numbers(await after("Shift+ArrowUp"));
  check(Math.abs(right[2] - up[2] - 5) < 1e-5 && Math.abs(up[3] - right[3] - 5) < 1e-5, `arrows move to ${right} and ${up}`);
  check(Math.abs(numbers(await after("r"))[4] - up[4] - 15) < 1e-6, "R doesn't turn by 15 degrees");
  check(/^retry \d+ \d+$/.test(await after("n")), "N makes no other net");
  check(/^pack \d+$/.test(await after("p")), "P finds no other place");
  check(/^pin \d+$/.test(await after("l")), "L doesn't pin");
  check((await inspect()).pinned.join() === String(largest) && await page.locator(".lock").count() === 1, "what is pinned has no lock");
  const before = (await lines("apply")).length;
  await drag(60, 0);
  check((await lines("apply")).length === before, "a pinned piece is dragged");
  await page.screenshot({path: `${out}/${values.browser}-pinned.png`});
  check(/^unpin \d+$/.test(await after("l")), "L doesn't unpin");
  await page.keyboard.press("Escape");
  await page.evaluate(() => document.activeElement.blur());
  check((await after("p")) === "pack", "P without a piece doesn't pack all");

  // Undo and redo are at hand as after other edits.
  check((await inspect()).canUndo, "what was laid can't be undone");
  check(heard.length === 0, `the page says ${heard.slice(0, 3)}`);
  await context.close();
}

/** With a finger: the sheets move as long as no piece was chosen; then the finger moves the piece. */
async function byFinger() {
  const {context, page, heard, inspect, idle, largest, inside, lines} = await open({viewport: {width: 400, height: 800}, hasTouch: true});
  const stroke = await strokes(context, page);
  const applied = async () => (await lines("apply")).length;
  const cornerOf = () => page.evaluate(() => document.getElementById("plan").getAttribute("viewBox"));

  // The options stand in a drawer there.
  check(!await page.isVisible("#options"), "the options take the sheets' room on a phone");
  await page.click("#open-options");
  check(await page.isVisible("#option-paper") && await page.isVisible("#open-other"), "the options don't open on a phone");
  await page.click("#open-options");

  const before = await cornerOf();
  await stroke([await inside(largest)], [[30, 24]]);
  await idle();
  check(await applied() === 0, "a finger moves a piece that wasn't chosen");
  check(await cornerOf() !== before, "a finger doesn't move the sheets");
  await stroke([await inside(largest)], []);
  check((await inspect()).chosen.join() === String(largest), "a tap doesn't choose a piece");

  // The chosen piece follows the finger; the second place tells how far.
  const scale = await scaleOf(page);
  const moved = async (dx, dy) => {
    await stroke([await inside(largest)], [[dx / 2, dy / 2], [dx, dy]]);
    await idle();
    return (await lines("apply")).at(-1) ?? "";
  };
  const first = await moved(24, 0);
  const second = await moved(48, 0);
  const [one, two] = [numbers(first), numbers(second)];
  check(first.startsWith("place ") && await applied() === 2 && Math.abs(two[2] - one[2] - 24 / scale) < 0.05 && Math.abs(two[3] - one[3]) < 0.05 && one[4] === two[4],
    `a finger 24 pixels further of ${scale} a mm: "${first}", "${second}"`);
  check((await inspect()).chosen.join() === String(largest), "a piece that was moved by finger isn't chosen any more");

  // Two fingers zoom, also where the first one dragged the piece.
  const [x, y] = await inside(largest);
  const {width, height, y: top} = await page.locator("#plan").boundingBox();
  const [right, down] = [x < width / 2 ? 1 : -1, y < top + height / 2 ? 1 : -1];
  await stroke([[x, y], [x + 60 * right, y + 90 * down]], [[20 * right, 30 * down]]);
  await idle();
  check(await applied() === 2, "two fingers move a piece");
  check(await scaleOf(page) !== scale, "two fingers don't zoom");
  check(await page.locator("[data-piece][transform]").count() === 0, "a piece hangs where two fingers took it");
  await page.screenshot({path: `${out}/${values.browser}-phone.png`});
  check(heard.length === 0, `on a phone the page says ${heard.slice(0, 3)}`);
  await context.close();
}

/**
 * A function that puts fingers down, moves the last one by each of the distances, and lifts them. Chromium is touched as by
 * its screen; other browsers can't be, so there pointer events are sent to the page.
 */
async function strokes(context, page) {
  const add = ([x, y], [dx, dy]) => [x + dx, y + dy];
  if (values.browser === "chromium") {
    const screen = await context.newCDPSession(page);
    return async (fingers, moves) => {
      const tell = (type, at) => screen.send("Input.dispatchTouchEvent", {type, touchPoints: at.map(([x, y], id) => ({x, y, id}))});
      for (let i = 1; i <= fingers.length; ++i) {
        await tell("touchStart", fingers.slice(0, i));
      }
      for (const move of moves) {
        await tell("touchMove", [...fingers.slice(0, -1), add(fingers.at(-1), move)]);
      }
      await tell("touchEnd", []);
    };
  }
  return (fingers, moves) => page.evaluate(([from, to]) => {
    const svg = document.getElementById("plan");
    svg.setPointerCapture = () => {};
    const tell = (type, index, [clientX, clientY]) => svg.dispatchEvent(new PointerEvent(type, {pointerId: 5 + index, pointerType: "touch",
      isPrimary: index === 0, button: type === "pointermove" ? -1 : 0, buttons: 1, clientX, clientY, screenX: clientX, screenY: clientY,
      bubbles: true, cancelable: true}));
    from.forEach((at, index) => tell("pointerdown", index, at));
    to.forEach((at) => tell("pointermove", from.length - 1, at));
    from.forEach((at, index) => tell("pointerup", index, index === from.length - 1 ? to.at(-1) ?? at : at));
  }, [fingers, moves.map((move) => add(fingers.at(-1), move))]);
}

await runAll(browser, [byMouse, byFinger], faults);
await end(browser, faults);
