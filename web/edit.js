// SPDX-License-Identifier: GPL-3.0-or-later
// Edits by hand: next to an edge or a piece that is chosen stands what can be done there, or why it can't.

import {faceOfPiece, placeOfPiece} from "./drag.js";
import {htmlElement} from "./guide.js";
import {modelEnds} from "./nets.js";
import {byId} from "./panel.js";
import {svgElement} from "./page_drawer.js";
import {say} from "./words.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("./backend.js").Backend} Backend */
/** @typedef {import("./backend.js").Edit} Edit */
/** @typedef {import("./nets.js").Nets} Nets */
/** @typedef {import("./scene.js").Spot} Spot */

/** Pixels from the pointer. */
const offset = 14;

/** What may be done at an edge, the main thing first, with what its button says. @param {Nets} nets @param {number} e
 * @returns {{edit: Edit, text: string}[]} */
function editsAt(nets, e) {
  const edge = nets.edges[e];
  if (edge.kind !== "B") {
    return [{edit: {kind: "cut", edge: modelEnds(nets, e)}, text: say("cut_here")}];
  }
  if (edge.join < 0) {
    return [];
  }
  const join = nets.joins[edge.join];
  /** @type {{edit: Edit, text: string}[]} */
  const edits = [{edit: {kind: "join", edge: modelEnds(nets, e)}, text: say("join_here")}];
  const giver = join.tab < 0 ? -1 : join.edges.find((side) => nets.edges[side].tab === join.tab) ?? -1;
  for (const side of join.edges) {
    if (side !== giver) {
      const own = join.pieces[0] === join.pieces[1];
      const key = giver < 0 ? "tab_on_again" : own ? "tab_over_own" : "tab_over";
      edits.push({edit: {kind: "tab-from", edge: modelEnds(nets, side)}, text: say(key, {name: nets.pieces[nets.edges[side].piece].name})});
    }
  }
  if (giver >= 0) {
    edits.push({edit: {kind: "no-tab", edge: modelEnds(nets, giver)}, text: say("tab_off")});
  }
  return edits;
}

/** What may be done with a piece, with what its button says. @param {Nets} nets @param {number} index @param {boolean} pinned
 * @param {number} seed of another net @returns {{edit: Edit, text: string}[]} */
function editsOfPiece(nets, index, pinned, seed) {
  const face = faceOfPiece(nets, index);
  return pinned ? [{edit: {kind: "unpin", face}, text: say("unpin")}] : [
    {edit: placeOfPiece(nets, index, 0, 0, 90), text: say("turn_left")},
    {edit: placeOfPiece(nets, index, 0, 0, -90), text: say("turn_right")},
    {edit: {kind: "pack", faces: [face]}, text: say("pack_piece")},
    {edit: {kind: "retry", face, seed}, text: say("retry_piece")},
    {edit: {kind: "pin", face}, text: say("pin")},
  ];
}

/**
 * Shows on the sheets what becomes of an edge, before the program has answered. The answer's own sheets come instead.
 * @param {App} app
 * @param {Edit} edit
 * @returns {() => void} takes it back
 */
export function previewEdit({nets, plan}, edit) {
  const layer = svgElement("g", {class: `expected ${edit.kind}`}, plan.svg);
  const ends = "edge" in edit ? edit.edge : [];
  nets.edges.forEach((_, e) => modelEnds(nets, e).every((v) => ends.includes(v)) && svgElement("path", {d: plan.lineOf(e)}, layer));
  return () => layer.remove();
}

/** What is offered at an edge: to cut a fold, to join what is cut, where its tab is to be; and what with a piece. */
export class Offer {
  /**
   * @param {Backend} backend
   * @param {(edit: Edit) => void} act
   */
  constructor(backend, act) {
    this.backend = backend;
    this.box = byId("edit");
    this.words = /** @type {HTMLElement} */ (this.box.querySelector("p"));
    this.buttons = /** @type {HTMLElement} */ (this.box.querySelector("div"));
    this.act = act;
    /** What is offered. @type {Edit[]} */
    this.edits = [];
    this.pointer = {x: 0, y: 0, time: -1};
    document.addEventListener("pointerup", (event) => {
      this.pointer = {x: event.clientX, y: event.clientY, time: performance.now()};
    }, {capture: true});
  }

  hide() {
    this.edits = [];
    this.box.hidden = true;
  }

  /** @param {App} app @param {Spot | null} spot @param {boolean} pinned whether its piece is @param {number} seed of another net */
  async show(app, spot, pinned, seed) {
    this.hide();
    const offers = !spot ? [] : spot.edge >= 0 ? editsAt(app.nets, spot.edge) : editsOfPiece(app.nets, spot.piece, pinned, seed);
    if (!spot || offers.length === 0) {
      return;
    }
    const [main, ...others] = offers;
    const asked = offers.map(({edit}) => edit);
    this.edits = asked;
    const {ok, why, faces} = spot.edge < 0 ? {ok: true, why: "", faces: []}
      : await this.backend.preview([main.edit]).catch((error) => ({ok: false, why: String(error.message), faces: []}));
    if (this.edits !== asked) {
      return;
    }
    const possible = ok ? offers : others;
    this.edits = possible.map(({edit}) => edit);
    this.box.setAttribute("aria-label", say(spot.edge >= 0 ? "edit_edge" : "edit_piece", {name: app.nets.pieces[spot.piece].name}));
    this.words.textContent = ok ? "" : why ?? "";
    this.buttons.replaceChildren(...possible.map(({edit, text}) => {
      const button = htmlElement("button", {type: "button", class: spot.edge >= 0 && edit === main.edit ? "strong" : ""}, [text]);
      button.addEventListener("click", () => {
        this.hide();
        this.act(edit);
      });
      return button;
    }));
    if (spot.edge >= 0) {
      // Where lines are close together, a finger hits one of them rather than the piece.
      const whole = htmlElement("button", {type: "button"}, [say("whole_piece", {name: app.nets.pieces[spot.piece].name})]);
      whole.addEventListener("click", () => app.choose({piece: spot.piece, edge: -1}, false));
      this.buttons.append(whole);
    }
    this.box.hidden = false;
    if (!ok) {
      app.markFaces(faces ?? []);
    }
    this.#place(app, spot);
  }

  /** Next to the pointer, or, for who has none, next to the edge, with the focus on it. @param {App} app @param {Spot} spot */
  #place(app, spot) {
    const byPointer = performance.now() - this.pointer.time < 1000;
    const [x, y] = byPointer ? [this.pointer.x, this.pointer.y] : spot.edge >= 0 ? app.plan.clientOf(spot.edge) : app.plan.clientOfPiece(spot.piece);
    const {width, height} = this.box.getBoundingClientRect();
    const most = {x: innerWidth - width - 8, y: innerHeight - height - 8};
    this.box.style.left = `${Math.max(8, Math.min(most.x, x + offset))}px`;
    this.box.style.top = `${Math.max(8, y + offset > most.y ? y - offset - height : y + offset)}px`;
    if (!byPointer) {
      this.buttons.querySelector("button")?.focus();
    }
  }
}
