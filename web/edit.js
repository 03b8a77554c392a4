// SPDX-License-Identifier: GPL-3.0-or-later
// Edits by hand: next to an edge or a piece that is chosen stands what can be done there, or why it can't.

import {faceOfPiece, placeOfPiece} from "./desk.js";
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
export function editsAt(nets, e) {
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
    edits.push({edit: {kind: "both-tabs", edge: modelEnds(nets, giver)}, text: say("tab_both")});
  }
  return edits;
}

/** Keys for the edge under the pointer. @type {Record<string, Edit["kind"]>} */
export const edgeKeys = {c: "cut", j: "join", t: "tab-from", x: "no-tab"};

/** What a key does at an edge. @param {Nets} nets @param {number} e @param {string} key @returns {Edit | undefined} */
export function editByKey(nets, e, key) {
  return edgeKeys[key] && editsAt(nets, e).find(({edit}) => edit.kind === edgeKeys[key])?.edit;
}

/** The keys that do something at an edge, in words. @param {Nets} nets @param {number} e */
export function legendAt(nets, e) {
  return Object.keys(edgeKeys).filter((key) => editByKey(nets, e, key)).map((key) => `${key.toUpperCase()}: ${say(`key_of_${edgeKeys[key]}`)}`).join("   ");
}

/** What may be done with several pieces. @param {Nets} nets @param {number[]} pieces @returns {{edits: Edit[], text: string}[]} */
function editsOfMany(nets, pieces) {
  const box = (/** @type {number} */ index) => {
    const {page, box: [left, foot, right, top]} = nets.pieces[index];
    const {x, y} = nets.pages[page];
    return [left - x, foot - y, right - x, top - y];
  };
  const boxes = pieces.map(box);
  const sorted = (/** @type {number} */ axis) => pieces.map((index, i) => ({index, low: boxes[i][axis], high: boxes[i][axis + 2]})).sort((a, b) => a.low + a.high - b.low - b.high);
  const align = (/** @type {(box: number[]) => number[]} */ by) => pieces.map((index, i) => placeOfPiece(nets, index, by(boxes[i])[0], by(boxes[i])[1], 0));
  const [left, foot, right, top] = [0, 1, 2, 3].map((k) => Math[k < 2 ? "min" : "max"](...boxes.map((one) => one[k])));
  const spread = (/** @type {number} */ axis) => {
    const order = sorted(axis);
    const room = order[order.length - 1].high - order[0].low - order.reduce((sum, {low, high}) => sum + high - low, 0);
    let at = order[0].low;
    return order.map(({index, low, high}) => {
      const away = at - low;
      at += high - low + room / (order.length - 1);
      return placeOfPiece(nets, index, axis === 0 ? away : 0, axis === 1 ? away : 0, 0);
    });
  };
  return [
    {edits: align((one) => [left - one[0], 0]), text: say("align_left")},
    {edits: align((one) => [right - one[2], 0]), text: say("align_right")},
    {edits: align((one) => [0, top - one[3]]), text: say("align_top")},
    {edits: align((one) => [0, foot - one[1]]), text: say("align_foot")},
    ...(pieces.length > 2 ? [{edits: spread(0), text: say("spread_across")}, {edits: spread(1), text: say("spread_up")}] : []),
    {edits: [{kind: "pack", faces: pieces.map((index) => faceOfPiece(nets, index))}], text: say("pack_pieces")},
  ];
}

/** What may be done with a piece, with what its button says. @param {App} app @param {number} index @param {boolean} pinned
 * @param {number} seed of another net @returns {{edit: Edit, text: string}[]} */
function editsOfPiece({nets, plan}, index, pinned, seed) {
  const face = faceOfPiece(nets, index);
  return pinned ? [{edit: {kind: "unpin", face}, text: say("unpin")}] : [
    {edit: plan.moved(index, 0, 0, 90), text: say("turn_left")},
    {edit: plan.moved(index, 0, 0, -90), text: say("turn_right")},
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
    this.box.classList.remove("many");
    this.edits = [];
    this.box.hidden = true;
  }

  /** @param {App} app @param {Spot | null} spot @param {boolean} pinned whether its piece is @param {number} seed of another net
   * @param {{text: string, act: () => void}[]} [more] for a piece */
  async show(app, spot, pinned, seed, more = []) {
    this.hide();
    const offers = !spot ? [] : spot.edge >= 0 ? editsAt(app.nets, spot.edge) : editsOfPiece(app, spot.piece, pinned, seed);
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
    if (spot.edge < 0 && !pinned) {
      this.buttons.append(htmlElement("details", {}, [htmlElement("summary", {}, [say("sheets")]), ...more.map(({text, act}) => {
        const button = htmlElement("button", {type: "button"}, [text]);
        button.addEventListener("click", () => {
          this.hide();
          act();
        });
        return button;
      })]));
    }
    if (spot.edge >= 0 && possible.some(({edit}) => edit.kind === "no-tab")) {
      this.buttons.append(this.#shapeForm(possible));
    }
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
    this.#place(app, [spot]);
  }

  /** Height and angle of one tab. @param {{edit: Edit}[]} offers */
  #shapeForm(offers) {
    const giver = offers.find(({edit}) => edit.kind === "no-tab")?.edit;
    const [height, angle] = [["tab_height", "5"], ["tab_angle", "45"]].map(([key, value]) =>
      [htmlElement("span", {}, [say(key)]), htmlElement("input", {type: "text", inputmode: "decimal", value})]);
    const set = htmlElement("button", {type: "submit"}, [say("tab_set")]);
    const form = htmlElement("form", {class: "shape"}, [htmlElement("label", {}, height), htmlElement("label", {}, angle), set]);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const [mm, degrees] = [height, angle].map(([, input]) => Number(/** @type {HTMLInputElement} */ (input).value.replace(",", ".")));
      if (mm > 0 && degrees > 0 && giver && "edge" in giver) {
        this.hide();
        this.act({kind: "tab-shape", edge: giver.edge, height: mm, degrees});
      }
    });
    return htmlElement("details", {}, [htmlElement("summary", {}, [say("tab_shape")]), form]);
  }

  /** For several pieces. @param {App} app @param {number[]} pieces @param {(edits: Edit[]) => void} act @param {{text: string, act: () => void}[]} more */
  showMany(app, pieces, act, more) {
    this.hide();
    const offers = [...editsOfMany(app.nets, pieces).map(({edits, text}) => ({text, act: () => act(edits)})), ...more];
    this.box.classList.add("many");
    this.words.textContent = say("pieces_n", {n: pieces.length});
    this.box.setAttribute("aria-label", this.words.textContent);
    this.buttons.replaceChildren(...offers.map(({text, act: go}) => {
      const button = htmlElement("button", {type: "button"}, [text]);
      button.addEventListener("click", () => {
        this.hide();
        go();
      });
      return button;
    }));
    this.box.hidden = false;
    this.#place(app, pieces.map((piece) => ({piece, edge: -1})));
  }

  /** Next to what was clicked, which stays in sight on both sides; for who has no pointer with the focus on it.
   * @param {App} app @param {Spot[]} spots */
  #place(app, spots) {
    const [spot] = spots;
    const byPointer = performance.now() - this.pointer.time < 1000;
    const [x, y] = byPointer ? [this.pointer.x, this.pointer.y] : spot.edge >= 0 ? app.plan.clientOf(spot.edge) : app.plan.clientOfPiece(spot.piece);
    const {width, height} = this.box.getBoundingClientRect();
    const [left, top] = placeBeside([x, y], [width, height], [innerWidth, innerHeight], [...spots.map((one) => app.plan.clientBox(one)), ...(spots.length > 1 ? [] : [boxOnModel(app, spot)]),
      ...(spot.edge < 0 ? [] : [app.plan.clientBox({piece: spot.piece, edge: -1})])]);
    this.box.style.left = `${left}px`;
    this.box.style.top = `${top}px`;
    if (!byPointer) {
      this.buttons.querySelector("button")?.focus();
    }
  }
}

/** Where an edge or a piece is in the view of the model: left, top, right, bottom in the window. @param {App} app @param {Spot} spot */
function boxOnModel({scene}, {piece, edge}) {
  const box = scene.canvas.getBoundingClientRect();
  const points = edge >= 0 ? scene.edgeEnds(edge) : scene.triangles.flatMap((triangle, i) => (triangle.piece === piece ? [0, 1, 2].map((k) => {
    const c = 18 * i + 6 * k;
    return [scene.corners[c], scene.corners[c + 1], scene.corners[c + 2]];
  }) : []));
  const shown = points.map(([x, y, z]) => scene.camera.project(x, y, z));
  const [xs, ys] = [0, 1].map((k) => shown.map((point) => point[k]));
  return [box.left + Math.min(...xs), box.top + Math.min(...ys), box.left + Math.max(...xs), box.top + Math.max(...ys)];
}

/**
 * The corner of a box that lies over as little as it can of what is to be seen, and as near to a point as it can.
 * @param {number[]} at
 * @param {number[]} size of the box
 * @param {number[]} window
 * @param {number[][]} shown left, top, right, bottom of each
 */
export function placeBeside([x, y], [width, height], [right, bottom], shown) {
  const margin = 8;
  const most = [right - width - margin, bottom - height - margin];
  const candidates = [[x + offset, y + offset], ...shown.flatMap((box) => [
    [box[2] + offset, y - 0.5 * height], [box[0] - offset - width, y - 0.5 * height], [x - 0.5 * width, box[3] + offset], [x - 0.5 * width, box[1] - offset - height]]),
    [margin, margin], [margin, most[1]], [most[0], margin], most];
  const costs = candidates.map((wanted) => {
    const [left, top] = wanted.map((value, k) => Math.max(margin, Math.min(most[k], value)));
    const covered = shown.reduce((sum, box) => sum + Math.max(0, Math.min(left + width, box[2] + 4) - Math.max(left, box[0] - 4)) *
      Math.max(0, Math.min(top + height, box[3] + 4) - Math.max(top, box[1] - 4)), 0);
    return {left, top, cost: 10 * covered + Math.hypot(left + 0.5 * width - x, top + 0.5 * height - y)};
  });
  const {left, top} = costs.reduce((best, one) => (one.cost < best.cost ? one : best));
  return [left, top];
}
