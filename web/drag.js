// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the sheets that are dragged or turned, and laid where there is room. The program says where that is, while they
// are still dragged.

import {movedPlace} from "./desk.js";
import {svgElement} from "./page_drawer.js";

/** @typedef {import("./desk.js").Place} Place */
/** @typedef {import("./sheets.js").Plan} Plan */
/** @typedef {import("./scene.js").Spot} Spot */

/** Steps of a turn by the handle while Shift is down, degrees. */
const turnStep = 10;
/** Of the handle above what is chosen, and its size, pixels. */
const handleAway = 22;
const handleSize = 8;
/** So near the border of the view a piece that is dragged scrolls it, pixels; and how far each time, at most. */
const scrollZone = 40;
const scrollStep = 14;
const scrollMs = 30;

/**
 * Whether a piece can be laid where it is dragged to; where not, `instead` may be where its place can be nearby, mm on the page.
 * @typedef {{ok: boolean, instead?: number[], code?: string}} Room
 *
 * @typedef {object} DragHost
 * @property {() => Set<number>} chosen pieces, be it by an edge of theirs
 * @property {() => boolean} turns whether what is chosen has a handle
 * @property {Set<number>} pinned pieces
 * @property {(places: Place[], far?: boolean) => Promise<Room>} fits whether there is room; `far`: or anywhere on the page
 * @property {(places: Place[]) => Promise<void>} lay where there is room, and leaves them there where there is none
 */

/**
 * What is dragged now.
 * @typedef {object} Dragged
 * @property {number[]} pieces
 * @property {boolean} turns
 * @property {{x: number, y: number}} from where the pointer took it, in the window
 * @property {boolean} moved
 * @property {boolean} beside it lies over no sheet
 * @property {Place[]} edits that lay it where it is
 * @property {{edits: Place[], room: Room} | null} feedback to these, or to some before
 */

/** A box that is dragged snaps from so far, pixels; between pieces there stays this, mm. */
const snapPixels = 6;
const snapGap = 2.1;
/** Pieces so near to one that is dragged are snapped to, mm. */
const nearMm = 40;

/**
 * How far a box has to go to lie flush with others, or next to them: the nearest of both directions, none beyond `reach`.
 * @param {number[]} box left, top, right, bottom
 * @param {number[][]} others
 * @param {number} reach
 * @returns {{dx: number, dy: number, lines: number[][]}} lines: where it snaps, x1, y1, x2, y2
 */
export function snapOf(box, others, reach) {
  const along = (/** @type {0 | 1} */ axis) => {
    const [low, high] = [box[axis], box[axis + 2]];
    let best = {by: 0, at: NaN, other: /** @type {number[]} */ ([])};
    let least = reach;
    for (const other of others) {
      const [from, to] = [other[axis], other[axis + 2]];
      for (const [by, at] of [[from - low, from], [to - high, to], [to + snapGap - low, to], [from - snapGap - high, from]]) {
        if (Math.abs(by) < least) {
          least = Math.abs(by);
          best = {by, at, other};
        }
      }
    }
    return best;
  };
  const [x, y] = [along(0), along(1)];
  const lines = [];
  if (x.other.length > 0) {
    lines.push([x.at, Math.min(box[1], x.other[1]), x.at, Math.max(box[3], x.other[3])]);
  }
  if (y.other.length > 0) {
    lines.push([Math.min(box[0], y.other[0]), y.at, Math.max(box[2], y.other[2]), y.at]);
  }
  return {dx: x.by, dy: y.by, lines};
}

export class PieceDrag {
  /** @param {Plan} plan @param {DragHost} listener */
  constructor(plan, listener) {
    this.plan = plan;
    this.listener = listener;
    /** @type {Dragged | null} */
    this.dragged = null;
    this.asking = false;
    /** Whether what was let go is still being laid. */
    this.dropping = false;
    /** @type {SVGElement | null} */
    this.guides = null;
    /** Scrolls while a piece is held at the border of the view. */
    this.scrolling = 0;
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
      this.dragged = {pieces: [...chosen].filter((index) => !this.listener.pinned.has(index)), turns: true, from, moved: false, beside: false, edits: [], feedback: null};
      return true;
    }
    const spot = pick();
    if (!spot || this.listener.pinned.has(spot.piece) || (event.pointerType === "touch" && !chosen.has(spot.piece))) {
      return false;
    }
    const pieces = chosen.has(spot.piece) ? [...chosen].filter((index) => !this.listener.pinned.has(index)) : [spot.piece];
    this.dragged = {pieces, turns: false, from, moved: false, beside: false, edits: [], feedback: null};
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
    this.#scrollFrom(event);
    if (!dragged.moved) {
      dragged.moved = true;
      plan.showNewPage(true);
      plan.svg.classList.add("dragging");
      this.layer.replaceChildren();
      dragged.pieces.forEach((index) => plan.raise(index));
    }
    this.#follow(dragged, event);
  }

  /** @param {Dragged} dragged @param {PointerEvent} event */
  #follow(dragged, event) {
    const {plan} = this;
    const {nets} = plan;
    let dx = (event.clientX - dragged.from.x) / plan.view.scale;
    let dy = (event.clientY - dragged.from.y) / plan.view.scale;
    if (!dragged.turns && !event.altKey && event.pointerType !== "touch" && document.body.dataset.snap !== "off") {
      const snap = this.#snap(dragged, dx, dy);
      [dx, dy] = [dx + snap.dx, dy + snap.dy];
      this.#showGuides(snap.lines);
    }
    if (dragged.turns) {
      const [middle, degrees] = this.#turnAt(dragged.pieces, event);
      dragged.edits = dragged.pieces.map((index) => {
        const own = plan.corners[nets.pieces[index].page];
        plan.shift(index, `rotate(${-degrees} ${middle[0] - own.x} ${middle[1] - own.y})`);
        const place = plan.placeOf(index);
        return movedPlace(place, plan.onPage(place.page - 1, middle), 0, 0, degrees);
      });
    } else {
      const below = plan.pageBelow(this.#frameOf(dragged.pieces).map((value, k) => value + (k % 2 === 0 ? dx : dy)));
      const pointed = plan.pageAtClient(event.clientX, event.clientY);
      const over = pointed < 0 ? below : pointed;
      dragged.beside = over < 0;
      dragged.edits = dragged.pieces.map((index) => {
        plan.shift(index, `translate(${dx} ${dy})`);
        const place = plan.placeOf(index);
        const page = over < 0 ? place.page - 1 : over;
        const [from, to] = [plan.onPage(place.page - 1, [0, 0]), plan.onPage(page, [0, 0])];
        return {...movedPlace(place, [0, 0], dx + to[0] - from[0], to[1] - from[1] - dy, 0), page: page + 1};
      });
    }
    this.#askForRoom();
  }

  /** At the border of the view the sheets move on, as long as the pointer stays there. @param {PointerEvent} event */
  #scrollFrom(event) {
    clearInterval(this.scrolling);
    const {left, top, right, bottom} = this.plan.svg.getBoundingClientRect();
    const towards = (/** @type {number} */ at, /** @type {number} */ low, /** @type {number} */ high) =>
      Math.max(-1, Math.min(1, (Math.max(0, low + scrollZone - at) - Math.max(0, at - high + scrollZone)) / scrollZone));
    const [dx, dy] = [towards(event.clientX, left, right), towards(event.clientY, top, bottom)].map((share) => share * scrollStep);
    if ((dx === 0 && dy === 0) || this.dragged?.turns) {
      return;
    }
    this.scrolling = window.setInterval(() => {
      const {dragged} = this;
      if (!dragged) {
        clearInterval(this.scrolling);
        return;
      }
      this.plan.pan(dx, dy);
      dragged.from = {x: dragged.from.x + dx, y: dragged.from.y + dy};
      this.#follow(dragged, event);
    }, scrollMs);
  }

  /** Flush with pieces that lie still, or next to them. @param {Dragged} dragged @param {number} dx @param {number} dy */
  #snap({pieces}, dx, dy) {
    const {plan} = this;
    const box = this.#frameOf(pieces).map((value, k) => value + (k % 2 === 0 ? dx : dy));
    const near = plan.nets.pieces.map(({index}) => index).filter((index) => !pieces.includes(index)).map((index) => plan.pieceBox(index))
      .filter((other) => other[0] < box[2] + nearMm && other[2] > box[0] - nearMm && other[1] < box[3] + nearMm && other[3] > box[1] - nearMm);
    return snapOf(box, near, snapPixels / plan.view.scale);
  }

  /** @param {number[][]} lines */
  #showGuides(lines) {
    this.guides?.remove();
    this.guides = lines.length > 0 ? svgElement("g", {class: "guides"}, this.plan.svg) : null;
    for (const [x1, y1, x2, y2] of lines) {
      svgElement("line", {x1, y1, x2, y2}, /** @type {SVGElement} */ (this.guides));
    }
  }

  /** The middle of what is turned, and how far it is. @param {number[]} pieces @param {PointerEvent} event @returns {[number[], number]} */
  #turnAt(pieces, event) {
    const [left, top, right, bottom] = this.#frameOf(pieces);
    const middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    const [x, y] = this.plan.atClient(event.clientX, event.clientY);
    const degrees = (Math.atan2(middle[0] - x, middle[1] - y) * 180) / Math.PI;
    return [middle, event.shiftKey ? turnStep * Math.round(degrees / turnStep) : degrees];
  }

  /** Around pieces, on the grid of pages: left, top, right, bottom. @param {number[]} pieces */
  #frameOf(pieces) {
    const boxes = pieces.map((index) => this.plan.pieceBox(index));
    return [0, 1, 2, 3].map((k) => Math[k < 2 ? "min" : "max"](...boxes.map((box) => box[k])));
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
    if (!instead) {
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
    this.dropping = true;
    this.plan.showNewPage(false);
    const room = dragged.feedback?.edits === dragged.edits ? dragged.feedback.room : await this.listener.fits(dragged.edits);
    // What is dropped over the margin lies as near as there is room on the page.
    const inside = room.code === "beyond_sheet" && !room.instead && !dragged.beside && dragged.edits.length === 1;
    const {instead} = inside ? await this.listener.fits(dragged.edits, true) : room;
    await this.listener.lay(dragged.edits.map((edit) => (instead ? {...edit, at: instead} : edit)));
    this.dropping = false;
    this.#release(dragged);
  }

  cancel() {
    const {dragged} = this;
    this.dragged = null;
    this.#release(dragged);
  }

  /** @param {Dragged | null} dragged */
  #release(dragged) {
    clearInterval(this.scrolling);
    this.#showGuides([]);
    if (this.plan.ended.aborted) {
      return;
    }
    dragged?.pieces.forEach((index) => {
      this.plan.shift(index);
      this.plan.pieces[index].classList.remove("no-room");
    });
    this.plan.svg.classList.remove("dragging");
    this.plan.showNewPage(false);
    this.draw();
  }

  /** The handle of what is chosen, a frame around several pieces, and a lock on what is pinned. */
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
    const chosen = [...listener.chosen()].filter((index) => !listener.pinned.has(index));
    if (chosen.length === 0 || !listener.turns()) {
      return;
    }
    const [left, top, right, bottom] = this.#frameOf(chosen);
    const [x, y] = [0.5 * (left + right), top - handleAway / scale];
    if (chosen.length > 1) {
      svgElement("rect", {class: "frame-line", x: left, y: top, width: right - left, height: bottom - top}, this.layer);
    }
    svgElement("path", {class: "handle-line", d: `M${x} ${top}V${y}`}, this.layer);
    svgElement("circle", {class: "turn-handle", cx: x, cy: y, r: handleSize / scale}, this.layer);
  }
}
