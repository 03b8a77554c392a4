// SPDX-License-Identifier: GPL-3.0-or-later
// The keyboard: keys for all of the page, and those on a piece of the sheets.

import {hasLine} from "./nets.js";
import {showKeys} from "./panel.js";

/** @typedef {import("./app.js").App} App */

/** @param {App} app @param {AbortSignal} signal ends it */
export function listenKeys(app, signal) {
  document.addEventListener("keydown", (event) => {
    const target = /** @type {Element} */ (event.target);
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest("dialog,form,.menu")) {
      return;
    }
    const index = Number(target.closest("[data-piece]")?.getAttribute("data-piece") ?? -1);
    if (index >= 0 && pieceKey(app, event, index, Number(target.getAttribute("data-edge") ?? -1))) {
      event.preventDefault();
      return;
    }
    const act = keysAt(app, target)[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (act) {
      act();
      event.preventDefault();
    }
  }, {signal});
}

/**
 * What keys do while this element has the focus.
 * @param {App} app
 * @param {Element} target
 * @returns {Record<string, (() => void) | undefined>}
 */
function keysAt(app, target) {
  const {guide, motion, scene} = app;
  const {camera} = scene;
  const isRange = target.matches("input[type=range]");
  const isButton = target.matches("button,input");
  const onStage = target === scene.canvas;
  const turn = (/** @type {number} */ dx, /** @type {number} */ dy) => {
    camera.turn(dx, dy);
    motion.request();
  };
  const zoom = (/** @type {number} */ factor) => {
    camera.zoomAt(factor, 0.5 * camera.width, 0.5 * camera.height);
    motion.request();
  };
  const aside = (/** @type {number} */ step) => (isRange ? undefined : guide.open ? () => guide.goTo(guide.step + step)
    : onStage ? () => turn(16 * step, 0) : undefined);
  return {
    " ": isButton && !isRange ? undefined : () => motion.play(),
    ArrowLeft: aside(-1),
    ArrowRight: aside(1),
    ArrowUp: onStage ? () => turn(0, 16) : undefined,
    ArrowDown: onStage ? () => turn(0, -16) : undefined,
    "+": () => zoom(1.25),
    "-": () => zoom(0.8),
    b: () => app.build(!guide.open),
    d: guide.open ? () => guide.tick(!guide.ticks.done.has(guide.step)) : undefined,
    Home: isRange ? undefined : () => app.fit(),
    f: () => {
      const {spot} = app.lit();
      spot ? app.visit(spot) : app.fit();
    },
    x: () => app.toggleThrough(),
    t: () => app.toggleColours(),
    Escape: () => app.choose(null, false),
    "?": () => showKeys(app.drawer.painted),
  };
}

/** Whether a key does something on a piece, or an edge of it. @param {App} app @param {KeyboardEvent} event @param {number} index
 * @param {number} edge */
function pieceKey(app, event, index, edge) {
  if (event.key === "Enter") {
    app.visit({piece: index, edge});
    return true;
  }
  const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
  if (step === 0) {
    return false;
  }
  const edges = app.nets.pieces[index].edges.filter((e) => hasLine(app.nets, e));
  const here = edges.indexOf(edge);
  app.plan.focusEdge(index, edges[here < 0 ? (step > 0 ? 0 : edges.length - 1) : (here + step + edges.length) % edges.length]);
  return true;
}
