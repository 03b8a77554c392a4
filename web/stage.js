// SPDX-License-Identifier: GPL-3.0-or-later
// Pointers on the model: they turn, move and enlarge it, point at its pieces and choose them.

import {hasMoved, wheelSteps} from "./sheets.js";

/**
 * @param {import("./app.js").App} app
 * @param {AbortSignal} signal ends it: the canvas is there for the next result, too
 */
export function listenStage(app, signal) {
  const {scene, motion} = app;
  const {camera, canvas} = scene;
  /** @type {Map<number, {x: number, y: number}>} */
  const fingers = new Map();
  let moved = 0;
  const at = (/** @type {MouseEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };
  const spotAt = (/** @type {PointerEvent} */ event) => {
    const {x, y} = at(event);
    return scene.pick(x, y, event.pointerType === "touch" ? 16 : 7);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    moved = 0;
    motion.turning = null;
  }, {signal});
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) {
      if (hasMoved(event)) {
        app.hover(spotAt(event));
      }
      return;
    }
    const now = at(event);
    const [dx, dy] = [now.x - before.x, now.y - before.y];
    moved += Math.abs(dx) + Math.abs(dy);
    fingers.set(event.pointerId, now);
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const old = Math.hypot(before.x - other.x, before.y - other.y);
      camera.move(0.5 * dx, 0.5 * dy);
      if (old > 1) {
        camera.zoomAt(Math.hypot(now.x - other.x, now.y - other.y) / old, 0.5 * (now.x + other.x), 0.5 * (now.y + other.y));
      }
    } else if (event.buttons & 2 || event.buttons & 4) {
      camera.move(dx, dy);
    } else if (moved > 4) {
      if (camera.tilt > 0) {
        camera.release();
        motion.freeView = true;
      }
      camera.turn(dx, dy);
    }
    motion.request();
  }, {signal});
  const up = (/** @type {PointerEvent} */ event) => {
    if (event.type === "pointerup" && moved <= 4 && fingers.size === 1 && event.button === 0) {
      app.choose(spotAt(event), event.ctrlKey || event.metaKey);
    }
    fingers.delete(event.pointerId);
  };
  canvas.addEventListener("pointerup", up, {signal});
  canvas.addEventListener("pointercancel", up, {signal});
  canvas.addEventListener("pointerleave", () => app.hover(null), {signal});
  canvas.addEventListener("contextmenu", (event) => event.preventDefault(), {signal});
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const {x, y} = at(event);
    camera.zoomAt(Math.exp(-wheelSteps(event) * 0.14), x, y);
    motion.request();
  }, {passive: false, signal});
  canvas.addEventListener("dblclick", (event) => {
    const {x, y} = at(event);
    const spot = scene.pick(x, y, 7);
    spot ? app.visit(spot) : app.fit();
  }, {signal});
}
