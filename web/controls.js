// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons, the slider, and the divider between the two views.

import {byId} from "./panel.js";

/** @param {import("./app.js").App} app */
export function listenControls(app) {
  const {motion, plan} = app;
  const act = (/** @type {string} */ id, /** @type {() => void} */ what) => byId(id).addEventListener("click", what);
  act("play", () => motion.play());
  act("speed", () => motion.nextSpeed());
  act("build", () => app.build(!app.guide.open));
  act("through", () => app.toggleThrough());
  act("colours", () => app.toggleColours());
  act("fit-model", () => motion.home());
  act("fit-sheets", () => plan.fit());
  const slider = /** @type {HTMLInputElement} */ (byId("fold-slider"));
  slider.addEventListener("input", () => {
    motion.pause();
    motion.setMoment(Number(slider.value) / 1000);
  });
  slider.style.setProperty("--share", "1");
  for (const side of ["model", "sheets"]) {
    act(`show-${side}`, () => {
      app.show(side);
      const {spot, pieces} = app.lit();
      if (side === "sheets" && pieces.size > 0) {
        plan.goTo(spot ?? {piece: [...pieces][0], edge: -1});
      }
    });
  }
  listenDivider(byId("divider"));
}

/** @param {HTMLElement} divider */
function listenDivider(divider) {
  const views = /** @type {HTMLElement} */ (divider.parentElement);
  divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
  divider.addEventListener("pointermove", (event) => {
    if (divider.hasPointerCapture(event.pointerId)) {
      const box = views.getBoundingClientRect();
      splitAt(getComputedStyle(views).flexDirection === "column" ? (100 * (event.clientY - box.top)) / box.height
        : (100 * (event.clientX - box.left)) / box.width);
    }
  });
  divider.addEventListener("keydown", (event) => {
    const step = {ArrowLeft: -4, ArrowUp: -4, ArrowRight: 4, ArrowDown: 4}[event.key];
    if (step) {
      splitAt(Number(divider.getAttribute("aria-valuenow")) + step);
      event.preventDefault();
      event.stopPropagation();
    }
  });
  divider.addEventListener("dblclick", () => splitAt(50));
}

/** @param {number} percent of the width, for the model */
export function splitAt(percent) {
  const kept = Math.round(Math.min(80, Math.max(20, percent)));
  const divider = byId("divider");
  divider.setAttribute("aria-valuenow", String(kept));
  /** @type {HTMLElement} */ (divider.parentElement).style.setProperty("--split", `${kept}%`);
}
