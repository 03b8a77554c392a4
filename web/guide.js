// SPDX-License-Identifier: GPL-3.0-or-later
// Building step by step: what to cut out, fold and glue, what is done already, and where pieces are meanwhile.

import {smooth} from "./folding.js";
import {countSeams} from "./nets.js";
import {say, sayAngle, sayCount, sayList, sayNumber} from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./nets.js").Nets} Nets */

/** What is remembered of a model between visits. Pages from files may have no such memory; then it lasts a visit. */
class Ticks {
  /** @param {Nets} nets */
  constructor(nets) {
    this.key = `ridgecraft:${nets.digest}:${nets.pieces.length}:${nets.joins.length}`;
    /** @type {Set<number>} */
    this.done = new Set();
    try {
      const kept = JSON.parse(localStorage.getItem(this.key) ?? "[]");
      this.done = new Set(kept.filter((/** @type {unknown} */ k) => typeof k === "number" && k < nets.steps.length));
    } catch {
      // Nothing is remembered here.
    }
  }

  /** @param {number} step @param {boolean} done */
  set(step, done) {
    done ? this.done.add(step) : this.done.delete(step);
    try {
      localStorage.setItem(this.key, JSON.stringify([...this.done].sort((a, b) => a - b)));
    } catch {
      // It lasts as long as the page.
    }
  }
}

/**
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name
 * @param {Record<string, string>} [attributes]
 * @param {(Node | string)[]} [children]
 * @returns {HTMLElementTagNameMap[Name]}
 */
export function htmlElement(name, attributes = {}, children = []) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

/** The share of a step's time in which its pieces are folded; then they are glued. */
export const stepFoldShare = 0.5;

/**
 * @typedef {object} GuideHost
 * @property {() => void} changed another step, or another moment of it
 * @property {(joins: number[]) => void} point at seams; none: at nothing
 */

export class Guide {
  /**
   * @param {HTMLElement} panel
   * @param {HTMLElement} numbers that are written over the model
   * @param {Scene} scene
   * @param {GuideHost} host
   */
  constructor(panel, numbers, scene, host) {
    this.panel = panel;
    this.numbers = numbers;
    this.scene = scene;
    this.folding = scene.folding;
    this.nets = scene.nets;
    this.host = host;
    this.ticks = new Ticks(this.nets);
    this.open = false;
    /** @type {number} */
    this.step = Math.max(0, this.nets.steps.findIndex((_, k) => !this.ticks.done.has(k)));
    /** Where in the step, 0 to 1. */
    this.at = 0;
  }

  get current() {
    return this.nets.steps[this.step];
  }

  /** @param {number} step */
  goTo(step) {
    if (step >= 0 && step < this.nets.steps.length) {
      this.step = step;
      this.at = 0;
      this.show();
      this.host.changed();
    }
  }

  /** @param {boolean} done */
  tick(done) {
    this.ticks.set(this.step, done);
    this.show();
    this.host.changed();
  }

  /** @param {number} piece */
  #chip(piece) {
    const chip = htmlElement("span", {class: "chip"}, [this.nets.pieces[piece].name]);
    chip.style.background = `rgb(${this.nets.pieces[piece].colour})`;
    return chip;
  }

  /** Joins by number, each once: those of a chain share one. @param {number[]} joins */
  #numberList(joins) {
    const list = htmlElement("span", {class: "number-list"});
    /** @type {Map<number, number[]>} */
    const byNumber = new Map();
    for (const j of joins) {
      const number = this.nets.joins[j].number;
      byNumber.set(number, [...(byNumber.get(number) ?? []), j]);
    }
    for (const [number, group] of byNumber) {
      const button = htmlElement("button", {type: "button", class: "number"}, [String(number)]);
      for (const event of ["pointerenter", "focus"]) {
        button.addEventListener(event, () => this.host.point(group));
      }
      for (const event of ["pointerleave", "blur"]) {
        button.addEventListener(event, () => this.host.point([]));
      }
      list.append(button);
    }
    return list;
  }

  /** Writes the panel. */
  show() {
    const {nets, panel, ticks, step} = this;
    const {pieces, joins} = this.current;
    const all = nets.steps.length;
    panel.hidden = !this.open;
    const names = sayList(pieces.map((p) => nets.pieces[p].name));
    const pages = [...new Set(pieces.map((p) => nets.pieces[p].page + 1))].map((page) => say("page", {page}));
    const own = joins.filter((j) => nets.joins[j].pieces[0] === nets.joins[j].pieces[1]);
    const others = joins.filter((j) => !own.includes(j));
    const partners = [...new Set(others.flatMap((j) => nets.joins[j].pieces))].filter((p) => !pieces.includes(p));
    this.foldLine = htmlElement("p", {class: "now"});
    const folds = pieces.reduce((sum, p) => sum + nets.pieces[p].steps.flat().length, 0);
    const todo = htmlElement("ol", {}, [
      htmlElement("li", {"data-part": "cut"}, [htmlElement("strong", {}, [say("step_cut", {names})]),
        htmlElement("span", {class: "quiet"}, [` ${sayList(pages)}`])]),
      htmlElement("li", {"data-part": "fold"}, [htmlElement("strong", {}, [folds > 0 ? say("step_fold") : say("nothing_to_fold")]),
        htmlElement("span", {class: "quiet"}, [folds > 0 ? ` ${sayCount("folds", folds)}` : ""]), this.foldLine]),
    ]);
    if (own.length > 0) {
      todo.append(htmlElement("li", {"data-part": "glue"}, [htmlElement("strong", {}, [say("step_glue_own", {seams: sayCount("seams", countSeams(nets, own))})]), this.#numberList(own)]));
    }
    if (others.length > 0) {
      const to = partners.length > 0 ? partners : pieces;
      todo.append(htmlElement("li", {"data-part": "glue"}, [htmlElement("strong", {}, [say("step_glue", {seams: sayCount("seams", countSeams(nets, others)),
        names: sayList(to.map((p) => nets.pieces[p].name))})]), this.#numberList(others)]));
    }
    const box = htmlElement("input", {type: "checkbox", id: "tick"});
    box.checked = ticks.done.has(step);
    box.addEventListener("change", () => this.tick(box.checked));
    const back = htmlElement("button", {type: "button", id: "step-back"}, [say("back")]);
    const next = htmlElement("button", {type: "button", id: "step-next", class: "strong"}, [say("next")]);
    back.disabled = step === 0;
    next.disabled = step === all - 1;
    back.addEventListener("click", () => this.goTo(step - 1));
    next.addEventListener("click", () => {
      ticks.set(step, true);
      this.goTo(step + 1);
    });
    const dots = htmlElement("div", {class: "progress", "aria-hidden": "true"}, nets.steps.map((_, k) => {
      const dot = htmlElement("i", {class: `${ticks.done.has(k) ? "done" : ""}${k === step ? " here" : ""}`});
      dot.addEventListener("click", () => this.goTo(k));
      return dot;
    }));
    const focused = document.activeElement?.id;
    panel.replaceChildren(
      htmlElement("div", {class: "step-head"}, [htmlElement("span", {class: "quiet"}, [say("step_of", {n: sayNumber(step + 1), all: sayNumber(all)})]),
        htmlElement("span", {class: "quiet"}, [ticks.done.size === all ? say("all_done") : ticks.done.size > 0 ? say("done_of", {n: sayNumber(ticks.done.size), all: sayNumber(all)}) : ""])]),
      dots,
      htmlElement("h2", {}, [...pieces.map((p) => this.#chip(p)), say("piece", {name: names})]),
      todo,
      htmlElement("div", {class: "step-foot"}, [htmlElement("label", {}, [box, say("done")]), back, next]),
    );
    if (focused && ["step-back", "step-next", "tick"].includes(focused)) {
      document.getElementById(focused)?.focus();
    }
    this.#tellMoment();
  }

  /** Which part of the step is shown now. */
  #tellMoment() {
    const part = this.at < 0.04 ? "cut" : this.at < stepFoldShare ? "fold" : "glue";
    for (const item of this.panel.querySelectorAll("li")) {
      item.classList.toggle("here", item.dataset.part === part);
    }
    if (!this.foldLine) {
      return;
    }
    const {nets} = this;
    const steps = nets.pieces[this.current.pieces[0]].steps;
    const slot = this.#slot();
    this.foldLine.textContent = "";
    if (part === "fold" && slot >= 0) {
      const edges = steps[slot].map((e) => nets.edges[e]);
      const angle = sayAngle(Math.max(...edges.map((edge) => Math.abs(edge.angle))));
      this.foldLine.textContent = edges.length === 1
        ? say("step_fold_now", {n: sayNumber(slot + 1), all: sayNumber(steps.length), kind: say(edges[0].kind === "M" ? "mountain" : "valley"), angle})
        : say("step_fold_many", {n: sayNumber(slot + 1), all: sayNumber(steps.length), count: sayNumber(edges.length), angle});
    }
  }

  /** Which of the folds of the first piece is made at this moment; the tabs come with the last. */
  #slot() {
    const count = this.nets.pieces[this.current.pieces[0]].steps.length;
    return Math.min(count - 1, Math.floor((this.at / stepFoldShare) * (count + 1)));
  }

  /** The edges that are folded at this moment, or where the pieces are glued to what stands. */
  edgesNow() {
    const {nets, at} = this;
    const {pieces, joins} = this.current;
    if (at < stepFoldShare) {
      return at > 0.04 && this.#slot() >= 0 ? nets.pieces[pieces[0]].steps[this.#slot()] : [];
    }
    return at > 0.97 ? [] : joins.map((j) => nets.joins[j]).filter((join) => join.pieces[0] !== join.pieces[1])
      .flatMap((join) => join.edges);
  }

  /** Where the pieces of a step are folded: next to the model, on the side on which they are put on. */
  #benches() {
    const {folding, nets} = this;
    const [width, height, depth] = folding.modelSize;
    const radius = 0.5 * Math.hypot(width, depth);
    const {pieces} = this.current;
    const middles = pieces.map((p) => {
      const corners = nets.pieces[p].faces.flatMap((f) => folding.builtCorners(f));
      return [0, 1, 2].map((k) => corners.reduce((sum, corner) => sum + corner[k], 0) / corners.length);
    });
    let x = middles.reduce((sum, m) => sum + m[0], 0);
    let z = middles.reduce((sum, m) => sum + m[2], 0) + 0.001;
    const length = Math.hypot(x, z);
    [x, z] = [x / length, z / length];
    const sizes = pieces.map((p) => Math.max(nets.pieces[p].box[2] - nets.pieces[p].box[0], nets.pieces[p].box[3] - nets.pieces[p].box[1]));
    const total = sizes.reduce((sum, size) => sum + 1.1 * size, 0);
    const away = radius + 0.8 * Math.max(...sizes);
    let along = -0.5 * total;
    return sizes.map((size) => {
      const at = along + 0.55 * size;
      along += 1.1 * size;
      return [away * x - at * z, 0.45 * height, away * z + at * x];
    });
  }

  /** Puts all on the stage as it is now. */
  pose() {
    const {folding, nets, scene, step, at} = this;
    const {pieces} = this.current;
    const fold = Math.min(1, at / stepFoldShare);
    const fly = Math.max(0, (at - stepFoldShare) / (1 - stepFoldShare));
    const alone = at < stepFoldShare;
    nets.pieces.forEach((piece) => {
      const now = pieces.includes(piece.index);
      scene.looks[piece.index] = now ? "plain" : alone ? "gone" : piece.step < step ? "plain" : "ghost";
    });
    const benches = this.#benches();
    const put = (/** @type {import("./folding.js").Progress} */ progress) =>
      pieces.forEach((p, i) => folding.put(p, progress, benches[i]));
    scene.table = 0;
    const isNow = (/** @type {number} */ p) => pieces.includes(p);
    if (alone) {
      put({fold, fly: 0});
      scene.place();
      scene.lookAt(scene.roomOf(isNow));
      scene.camera.tilt = 0.6;
    } else {
      folding.putAll(1);
      put({fold: 1, fly: 0});
      scene.place();
      const close = scene.roomOf(isNow);
      put({fold: 1, fly});
      scene.place();
      const t = smooth(fly / 0.4);
      scene.lookAt(close, scene.roomOf(() => true), t);
      scene.camera.tilt = 0.6 * (1 - t);
    }
    this.#tellMoment();
  }

  /**
   * A picture of a step for the printer: what is put on in its colour, what stands pale. With -1 all that is built.
   * Call restore() after the last one.
   * @param {number} step
   */
  picture(step) {
    const {scene, folding, nets} = this;
    const {camera} = scene;
    scene.looks = nets.pieces.map((piece) => (step < 0 || piece.step === step ? "plain" : piece.step < step ? "faded" : "gone"));
    scene.marked.clear();
    scene.table = 0;
    folding.putAll(1);
    scene.place();
    scene.lookAt(scene.roomOf((p) => scene.looks[p] !== "gone"));
    camera.home();
    camera.tilt = 0;
    [camera.width, camera.height] = step < 0 ? [640, 640] : [420, 300];
    scene.canvas.width = 2 * camera.width;
    scene.canvas.height = 2 * camera.height;
    scene.draw();
    return scene.canvas.toDataURL("image/png");
  }

  /** Shows again what was seen before pictures were taken. */
  restore() {
    this.scene.resize();
    this.host.changed();
  }

  /** Writes the numbers of the seams that are closed now next to them. Call after the camera is set. */
  label() {
    const {nets, scene} = this;
    const labels = [];
    /** Where labels are already: those that would cover them are left out. @type {number[][]} */
    const places = [];
    if (this.open && this.at >= 0.75 * stepFoldShare) {
      // Each number once on either side: in the middle of its chain.
      const middles = this.current.joins.filter((j) => {
        const chain = nets.chains[nets.joins[j].chain];
        return chain[chain.length >> 1] === j;
      });
      for (const j of middles.slice(0, 80)) {
        for (const e of nets.joins[j].edges) {
          const [p, q] = scene.edgeEnds(e);
          const middle = p.map((value, k) => 0.5 * (value + q[k]));
          const m = 12 * nets.edges[e].faces[0];
          const normal = [0, 1, 2].map((k) => this.folding.world[m + 6 + k]);
          const facing = normal.reduce((sum, value, k) => sum + value * (scene.camera.eye[k] - middle[k]), 0);
          const [x, y] = scene.camera.project(middle[0], middle[1], middle[2]);
          const shown = this.at >= stepFoldShare || this.current.pieces.includes(nets.edges[e].piece);
          if (facing > 0 && shown && places.every(([ox, oy]) => Math.abs(x - ox) > 24 || Math.abs(y - oy) > 17)) {
            places.push([x, y]);
            const label = htmlElement("span", {}, [String(nets.joins[j].number)]);
            label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
            labels.push(label);
          }
        }
      }
    }
    this.numbers.replaceChildren(...labels);
  }
}
