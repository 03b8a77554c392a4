// SPDX-License-Identifier: GPL-3.0-or-later
// What is done by hand: somebody chooses an edge, and beside it stands what can be done there, or why it can't.

import {modelEnds} from "./nets.js";
import {byId} from "./panel.js";
import {refusals} from "./studio_words.js";
import {reader, say} from "./words.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("./backend.js").Backend} Backend */
/** @typedef {import("./backend.js").Edit} Edit */
/** @typedef {import("./scene.js").Spot} Spot */

/** Pixels from the pointer. */
const offset = 14;

/** A sentence of the program's about an edit, for the reader. @param {string} why */
export function sayRefusal(why) {
  let told = why;
  for (const [english, german] of reader.language === "de" ? refusals : []) {
    const gaps = [...english.matchAll(/\{(\w+)\}/g)].map(([, name]) => name);
    const found = new RegExp(`^${english.replace(/\{\w+\}/g, "(.+?)")}$`).exec(why);
    if (found) {
      told = german.replace(/\{(\w+)\}/g, (_, name) => found[gaps.indexOf(name) + 1]);
    }
  }
  return `${told.charAt(0).toUpperCase()}${told.slice(1)}.`;
}

/** What is offered at an edge: to cut a fold, to join what is cut. */
export class EdgeOffer {
  /**
   * @param {Backend} backend
   * @param {(edit: Edit) => void} act
   */
  constructor(backend, act) {
    this.backend = backend;
    this.box = byId("edit");
    this.words = /** @type {HTMLElement} */ (this.box.querySelector("p"));
    this.button = /** @type {HTMLButtonElement} */ (this.box.querySelector("button"));
    /** @type {Edit | null} what is offered */
    this.edit = null;
    this.pointer = {x: 0, y: 0, time: -1};
    document.addEventListener("pointerup", (event) => {
      this.pointer = {x: event.clientX, y: event.clientY, time: performance.now()};
    }, {capture: true});
    this.button.addEventListener("click", () => {
      const {edit} = this;
      this.hide();
      if (edit) {
        act(edit);
      }
    });
  }

  hide() {
    this.edit = null;
    this.box.hidden = true;
  }

  /** @param {App} app @param {Spot | null} spot */
  async show(app, spot) {
    this.hide();
    const edge = spot && app.nets.edges[spot.edge];
    if (!edge || (edge.kind === "B" && edge.join < 0)) {
      return;
    }
    /** @type {Edit} */
    const edit = {kind: edge.kind === "B" ? "join" : "cut", edge: modelEnds(app.nets, spot.edge)};
    this.edit = edit;
    const {ok, why, faces} = await this.backend.preview(edit).catch((error) => ({ok: false, why: error.message, faces: []}));
    if (this.edit !== edit) {
      return;
    }
    this.words.textContent = ok ? "" : sayRefusal(why ?? "");
    this.button.hidden = !ok;
    this.button.textContent = say(edit.kind === "cut" ? "cut_here" : "join_here");
    this.box.hidden = false;
    if (!ok) {
      app.markFaces(faces ?? []);
    }
    this.#place(app, spot.edge);
  }

  /** Beside the pointer, or, for who has none, beside the edge, with the focus on it. @param {App} app @param {number} e */
  #place(app, e) {
    const byPointer = performance.now() - this.pointer.time < 1000;
    const [x, y] = byPointer ? [this.pointer.x, this.pointer.y] : app.plan.clientOf(e);
    const {width, height} = this.box.getBoundingClientRect();
    const most = {x: innerWidth - width - 8, y: innerHeight - height - 8};
    this.box.style.left = `${Math.max(8, Math.min(most.x, x + offset))}px`;
    this.box.style.top = `${Math.max(8, y + offset > most.y ? y - offset - height : y + offset)}px`;
    if (!byPointer && !this.button.hidden) {
      this.button.focus();
    }
  }
}
