// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the sheets that are dragged or turned, and laid where there is room. The program says where that is, while they
// are still dragged.

import {svgElement} from "./page_drawer.js";

/** @typedef {import("./backend.js").Edit} Edit */
/** @typedef {import("./nets.js").Nets} Nets */
/** @typedef {import("./sheets.js").Plan} Plan */
/** @typedef {import("./scene.js").Spot} Spot */

/** Steps of a turn by the handle while Shift is down, degrees. */
const turnStep = 10;
/** Of the handle above its piece, and its size, pixels. */
const handleAway = 22;
const handleSize = 8;

/** The name of a piece that outlives edits: its smallest face of the model. @param {Nets} nets @param {number} index */
export function faceOfPiece(nets, index) {
  return Math.min(...nets.pieces[index].faces.map((f) => nets.modelFace[f]));
}

/** The pieces that have these faces of the model. @param {Nets} nets @param {number[]} modelFaces @returns {number[]} */
export function piecesWith(nets, modelFaces) {
  const asked = new Set(modelFaces);
  return [...new Set([...nets.modelFace.keys()].filter((f) => asked.has(nets.modelFace[f])).map((f) => nets.facePiece[f]))];
}

/**
 * Lays a piece as it lies, but turned about its middle and moved.
 * @param {Nets} nets
 * @param {number} index
 * @param {number} dx mm to the right
 * @param {number} dy mm up
 * @param {number} degrees counterclockwise
 * @param {number} [page] its lower left corner is as far from the point as that of its own page was
 * @returns {Edit}
 */
export function placeOfPiece(nets, index, dx, dy, degrees, page = nets.pieces[index].page) {
  const piece = nets.pieces[index];
  const {x: left, y: foot} = nets.pages[piece.page];
  const face = faceOfPiece(nets, index);
  const f = /** @type {number} */ (piece.faces.find((candidate) => nets.modelFace[candidate] === face));
  const [a, b] = [0, 1].map((k) => {
    const v = nets.faces[3 * f + k];
    return [nets.points[2 * v] - left, nets.points[2 * v + 1] - foot];
  });
  const middle = [0.5 * (piece.box[0] + piece.box[2]) - left, 0.5 * (piece.box[1] + piece.box[3]) - foot];
  const angle = (degrees * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [x, y] = [a[0] - middle[0], a[1] - middle[1]];
  const rounded = (/** @type {number} */ value, /** @type {number} */ unit) => Math.round(value * unit) / unit;
  return {kind: "place", face, page: page + 1, at: [rounded(middle[0] + c * x - s * y + dx, 1e6), rounded(middle[1] + s * x + c * y + dy, 1e6)],
    degrees: rounded((Math.atan2(b[1] - a[1], b[0] - a[0]) * 180) / Math.PI + degrees, 1e9)};
}

/**
 * Whether a piece can be laid where it is dragged to; where not, `instead` may be where its place can be nearby, mm on the page.
 * @typedef {{ok: boolean, instead?: number[]}} Room
 *
 * @typedef {object} DragHost
 * @property {() => Set<number>} chosen pieces, be it by an edge of theirs
 * @property {() => boolean} turns whether the piece that is chosen has a handle
 * @property {Set<number>} pinned pieces
 * @property {(edits: Edit[]) => Promise<Room>} fits whether there is room
 * @property {(edits: Edit[]) => Promise<void>} lay
 */

/**
 * What is dragged now.
 * @typedef {object} Dragged
 * @property {number[]} pieces
 * @property {boolean} turns
 * @property {{x: number, y: number}} from where the pointer took it, in the window
 * @property {boolean} moved
 * @property {Edit[]} edits that lay it where it is
 * @property {{edits: Edit[], room: Room} | null} feedback to these, or to some before
 */

export class PieceDrag {
  /** @param {Plan} plan @param {DragHost} listener */
  constructor(plan, listener) {
    this.plan = plan;
    this.listener = listener;
    /** @type {Dragged | null} */
    this.dragged = null;
    this.asking = false;
    this.layer = svgElement("g", {class: "drag"}, plan.svg);
    this.draw();
  }

  /**
   * Takes what is under the pointer, if it may be moved. A finger moves what was chosen before, and the sheets otherwise.
   * @param {PointerEvent} event
   * @param {() => Spot | null} pick
   */
  take(event, pick) {
    if (event.button !== 0 || event.shiftKey && !this.#onHandle(event)) {
      return false;
    }
    const chosen = this.listener.chosen();
    const from = {x: event.clientX, y: event.clientY};
    if (this.#onHandle(event)) {
      this.dragged = {pieces: [...chosen], turns: true, from, moved: false, edits: [], feedback: null};
      return true;
    }
    const spot = pick();
    if (!spot || this.listener.pinned.has(spot.piece) || (event.pointerType === "touch" && !chosen.has(spot.piece))) {
      return false;
    }
    const pieces = chosen.has(spot.piece) ? [...chosen].filter((index) => !this.listener.pinned.has(index)) : [spot.piece];
    this.dragged = {pieces, turns: false, from, moved: false, edits: [], feedback: null};
    return true;
  }

  /** @param {PointerEvent} event */
  #onHandle(event) {
    return event.target instanceof Element && event.target.closest(".turn-handle") !== null;
  }

  /** @param {PointerEvent} event */
  move(event) {
    const {dragged, plan} = this;
    if (!dragged) {
      return;
    }
    if (!dragged.moved) {
      dragged.moved = true;
      plan.showNewPage(true);
      plan.svg.classList.add("dragging");
      this.layer.replaceChildren();
      dragged.pieces.forEach((index) => plan.raise(index));
    }
    const {nets} = plan;
    const dx = (event.clientX - dragged.from.x) / plan.view.scale;
    const dy = (event.clientY - dragged.from.y) / plan.view.scale;
    if (dragged.turns) {
      const index = dragged.pieces[0];
      const degrees = this.#turnAt(index, event);
      const [left, top, right, bottom] = plan.pieceBox(index);
      const corner = plan.corners[nets.pieces[index].page];
      plan.shift(index, `rotate(${-degrees} ${0.5 * (left + right) - corner.x} ${0.5 * (top + bottom) - corner.y})`);
      dragged.edits = [placeOfPiece(nets, index, 0, 0, degrees)];
    } else {
      const over = plan.pageAtClient(event.clientX, event.clientY);
      dragged.edits = dragged.pieces.map((index) => {
        plan.shift(index, `translate(${dx} ${dy})`);
        const own = nets.pieces[index].page;
        const page = over < 0 ? own : over;
        const [from, to] = [plan.corners[own], plan.cornerOf(page)];
        const height = plan.drawer.size(own)[1];
        const there = plan.drawer.size(Math.min(page, plan.drawer.count - 1))[1];
        return placeOfPiece(nets, index, from.x + dx - to.x, there - height - (from.y + dy - to.y), 0, page);
      });
    }
    this.#askForRoom();
  }

  /** @param {number} index @param {PointerEvent} event */
  #turnAt(index, event) {
    const [left, top, right, bottom] = this.plan.pieceBox(index);
    const [x, y] = this.plan.atClient(event.clientX, event.clientY);
    const degrees = (Math.atan2(0.5 * (left + right) - x, 0.5 * (top + bottom) - y) * 180) / Math.PI;
    return event.shiftKey ? turnStep * Math.round(degrees / turnStep) : degrees;
  }

  /** Marks what is dragged while there is no room for it, or shows where it will lie; one question at a time. */
  async #askForRoom() {
    if (this.asking) {
      return;
    }
    this.asking = true;
    for (let asked = null; this.dragged && this.dragged.edits !== asked;) {
      const {dragged} = this;
      asked = dragged.edits;
      const room = await this.listener.fits(asked);
      dragged.feedback = {edits: asked, room};
      if (dragged === this.dragged) {
        dragged.pieces.forEach((index) => this.plan.pieces[index].classList.toggle("no-room", !room.ok && !room.instead));
        this.#showLanding(dragged);
      }
    }
    this.asking = false;
  }

  /** The outline of what is dragged, where it will lie if that is elsewhere. @param {Dragged} dragged */
  #showLanding({pieces, feedback}) {
    this.layer.replaceChildren();
    const [edit] = feedback?.edits ?? [];
    const instead = feedback?.room.instead;
    if (!instead || edit.kind !== "place") {
      return;
    }
    const group = this.plan.pieces[pieces[0]];
    const corner = this.plan.corners[this.plan.nets.pieces[pieces[0]].page];
    const [x, y] = [corner.x + instead[0] - edit.at[0], corner.y - instead[1] + edit.at[1]];
    const outline = svgElement("g", {class: "landing", transform: `translate(${x} ${y}) ${group.getAttribute("transform") ?? ""}`}, this.layer);
    for (const part of ["faces", "cut"]) {
      svgElement("path", {class: `landing-${part}`, d: group.querySelector(`.${part}`)?.getAttribute("d") ?? ""}, outline);
    }
  }

  /** Lets go; what finds no room lies nearby, or goes back. */
  async drop() {
    const {dragged} = this;
    this.dragged = null;
    if (!dragged || dragged.edits.length === 0) {
      this.#release(dragged);
      return;
    }
    this.plan.showNewPage(false);
    const {instead} = dragged.feedback?.edits === dragged.edits ? dragged.feedback.room : await this.listener.fits(dragged.edits);
    await this.listener.lay(dragged.edits.map((edit) => (instead && edit.kind === "place" ? {...edit, at: instead} : edit)));
    this.#release(dragged);
  }

  cancel() {
    const {dragged} = this;
    this.dragged = null;
    this.#release(dragged);
  }

  /** @param {Dragged | null} dragged */
  #release(dragged) {
    dragged?.pieces.forEach((index) => {
      this.plan.shift(index);
      this.plan.pieces[index].classList.remove("no-room");
    });
    this.plan.svg.classList.remove("dragging");
    this.plan.showNewPage(false);
    this.draw();
  }

  /** The handle of the piece that is chosen, and a lock on what is pinned. */
  draw() {
    this.layer.replaceChildren();
    const {plan, listener} = this;
    const {scale} = plan.view;
    for (const index of listener.pinned) {
      const [left, top, right, bottom] = plan.pieceBox(index);
      const size = Math.min(9 / scale, 0.25 * Math.min(right - left, bottom - top));
      svgElement("path", {class: "lock", d: "M-.7-.1V-.5a.7.7 0 0 1 1.400 0v.4M-1-.1h2v1.300h-2z",
        transform: `translate(${left + 1.2 * size} ${top + 1.2 * size}) scale(${size})`}, this.layer);
    }
    const [index, ...others] = listener.chosen();
    if (index === undefined || others.length > 0 || listener.pinned.has(index) || !listener.turns()) {
      return;
    }
    const [left, top, right] = plan.pieceBox(index);
    const [x, y] = [0.5 * (left + right), top - handleAway / scale];
    svgElement("path", {class: "handle-line", d: `M${x} ${top}V${y}`}, this.layer);
    svgElement("circle", {class: "turn-handle", cx: x, cy: y, r: handleSize / scale}, this.layer);
  }
}
