// SPDX-License-Identifier: GPL-3.0-or-later
// The page of one result: the model and its sheets side by side, and what is lit on both.

import {listenControls, splitAt} from "./controls.js";
import {Folding} from "./folding.js";
import {Guide} from "./guide.js";
import {listenKeys} from "./keys.js";
import {edgeLabel, pieceLabel} from "./labels.js";
import {Motion} from "./motion.js";
import {modelEnds, readNets} from "./nets.js";
import {PageDrawer} from "./page_drawer.js";
import {byId, Menu, sayAll, sayCheck, sayFacts, showKeys} from "./panel.js";
import {Printer} from "./print.js";
import {inspectApp} from "./probe.js";
import {Scene} from "./scene.js";
import {Selection} from "./selection.js";
import {Plan} from "./sheets.js";
import {listenStage} from "./stage.js";
import {languages, reader, say, sayCount} from "./words.js";

/** @typedef {import("./backend.js").Backend} Backend */
/** @typedef {import("./backend.js").State} State */
/** @typedef {import("./scene.js").Spot} Spot */

/** Pixels of all pictures of pages together, on the graphics card. */
const mostPixels = 16e6;

const blank = byId("app").cloneNode(true);

/**
 * Makes an element as a fresh one is, apart from what is to be kept in it, which isn't moved.
 * @param {Element} element
 * @param {Element} fresh
 * @param {Element[]} kept
 */
function renew(element, fresh, kept) {
  if (kept.includes(element)) {
    return;
  }
  if (!kept.some((one) => element.contains(one))) {
    element.replaceWith(fresh);
    return;
  }
  for (const {name} of [...element.attributes]) {
    element.removeAttribute(name);
  }
  for (const {name, value} of fresh.attributes) {
    element.setAttribute(name, value);
  }
  const others = [...fresh.children];
  [...element.children].forEach((child, k) => (others[k] ? renew(child, others[k], kept) : child.remove()));
}

/**
 * How a result is looked at.
 * @typedef {object} View
 * @property {{azimuth: number, elevation: number, zoom: number, pan: number[]}} camera
 * @property {{x: number, y: number, scale: number} | null} plan of the sheets; null where all are shown
 * @property {string} sheets the sizes of the sheets
 * @property {number} folded
 * @property {boolean} freeView
 * @property {boolean} through
 * @property {boolean} painted
 * @property {number} speed
 * @property {string} split width of the views
 * @property {string} side that is shown where there is room for one
 */

export class App {
  /**
   * @param {Backend} backend
   * @param {State} state
   * @param {View | null} [view] of the result before, to go on with
   * @param {(spot: Spot | null) => void} [onChoose] called with what is chosen by hand
   * @param {(edge: number) => string} [legend] of keys for the edge under the pointer
   */
  constructor(backend, state, view = null, onChoose = () => {}, legend = () => "") {
    /** Ends what listens outside of the page's own elements. */
    this.ending = new AbortController();
    const {signal} = this.ending;
    this.backend = backend;
    this.onChoose = onChoose;
    this.legend = legend;
    this.nets = readNets(state.fold);
    this.folding = new Folding(this.nets);
    this.selection = new Selection(this.nets);
    byId("app").hidden = false;
    this.scene = new Scene(/** @type {HTMLCanvasElement} */ (byId("stage")), this.folding, () => this.#renew());
    this.drawer = new PageDrawer(this.nets, this.folding, JSON.parse(state.sheets || '{"pages":[]}'));
    this.plan = new Plan(/** @type {any} */ (byId("plan")), this.drawer, {
      hover: (spot) => this.hover(spot),
      choose: (spot, add) => this.choose(spot, add),
      chooseMany: (pieces) => this.chooseMany(pieces),
      visit: (spot) => this.visit(spot),
      pieceWords: (index) => pieceLabel(this.nets, index),
      edgeWords: (edge) => edgeLabel(this.nets, edge),
    }, signal);
    this.guide = new Guide(byId("guide"), byId("numbers"), this.scene, {
      changed: () => this.stepChanged(),
      point: (joins) => {
        this.selection.pointed = joins;
        this.light();
      },
    });
    this.motion = new Motion(this.scene, this.guide, () => this.lit().edges, signal);
    this.printer = new Printer(byId("print"), this.drawer, this.guide, signal);
    new Menu(byId("open-menu"), byId("menu"), () => this.menuItems(), signal);
    new Menu(byId("open-notes"), byId("notes"), () => this.noteItems(), signal);
    listenStage(this, signal);
    listenControls(this);
    listenKeys(this, signal);
    this.sayEverything();
    this.#listenWindow(signal);
    if (view) {
      this.#goOn(view);
      this.motion.waiting = this.drawer.painted && view.painted && !this.scene.simple;
      this.motion.drawLate();
    }
    if (this.drawer.painted) {
      this.#paint();
    }
    if (!this.motion.reduced.matches && !view) {
      this.motion.turnTo(this.scene.camera.azimuth, this.scene.camera.elevation, 1400, -0.9);
    }
    this.motion.frame(performance.now());
  }

  /** @param {AbortSignal} signal */
  #listenWindow(signal) {
    const dark = matchMedia("(prefers-color-scheme:dark)");
    const adoptDark = () => {
      this.scene.dark = dark.matches;
      this.motion.request();
    };
    dark.addEventListener("change", adoptDark, {signal});
    adoptDark();
    const resized = new ResizeObserver(() => this.#resize());
    resized.observe(byId("model"));
    resized.observe(byId("paper"));
    signal.addEventListener("abort", () => resized.disconnect());
  }

  #resize() {
    this.scene.resize();
    this.plan.resize();
    this.motion.request();
  }

  /** @returns {View} */
  view() {
    const {camera: {azimuth, elevation, zoom, pan}, through} = this.scene;
    const {folded, freeView, speed} = this.motion;
    return {camera: {azimuth, elevation, zoom, pan}, plan: this.plan.fitted ? null : this.plan.view, sheets: this.#sheetSizes(),
      folded, freeView, through, painted: byId("colours").getAttribute("aria-pressed") === "true", speed,
      split: /** @type {HTMLElement} */ (byId("divider").parentElement).style.getPropertyValue("--split"), side: byId("app").dataset.view ?? ""};
  }

  #sheetSizes() {
    return Array.from({length: this.drawer.count}, (_, p) => this.drawer.size(p).join(" ")).join();
  }

  /** Looks as the one before did. @param {View} view */
  #goOn(view) {
    Object.assign(this.scene.camera, view.camera);
    this.motion.freeView = view.freeView;
    this.motion.speed = view.speed;
    this.motion.say();
    byId("colours").setAttribute("aria-pressed", String(view.painted));
    if (!view.through) {
      this.toggleThrough();
    }
    if (view.split) {
      splitAt(parseFloat(view.split));
    }
    if (view.side) {
      this.show(view.side);
    }
    if (view.plan && view.sheets === this.#sheetSizes()) {
      this.plan.look(view.plan);
    }
    this.motion.setMoment(view.folded);
  }

  /**
   * Lets go of the page, so that another App can have it: its elements are new ones then, except two. A new canvas would take
   * a second where there is no graphics card, and browsers give a page sixteen at most; of the sheets most stay as they are.
   */
  stop() {
    this.ending.abort();
    this.motion.playing = 0;
    this.motion.turning = null;
    document.body.classList.remove("builds");
    renew(byId("app"), /** @type {HTMLElement} */ (blank.cloneNode(true)), [this.scene.canvas, this.plan.svg]);
  }

  /** The graphics card has forgotten what it had. */
  #renew() {
    this.motion.request();
    if (this.drawer.painted) {
      this.#paint();
    }
  }

  async #paint() {
    byId("colours").hidden = false;
    const [width, height] = this.drawer.size(0);
    const scale = Math.min(6, Math.sqrt(mostPixels / (this.nets.pages.length * width * height)));
    const pictures = await Promise.all(this.nets.pages.map((_, p) => this.drawer.picture(p, scale))).finally(() => {
      this.motion.waiting = false;
    });
    if (this.ending.signal.aborted) {
      return;
    }
    this.scene.setPaint(pictures);
    this.scene.painted = byId("colours").getAttribute("aria-pressed") === "true";
    this.motion.request();
  }

  sayEverything() {
    sayAll();
    sayFacts(this.nets, this.drawer.count);
    sayCheck(this.folding.refoldError);
    this.plan.say();
    this.guide.show();
    this.scene.canvas.setAttribute("aria-label", say("stage_label", {title: this.nets.title, pieces: sayCount("pieces", this.nets.pieces.length)}));
    this.motion.say();
    const notes = this.noteItems().length;
    byId("open-notes").hidden = notes === 0;
    byId("open-notes").textContent = sayCount("notes", notes);
    this.#sayBuild();
    this.light();
  }

  #sayBuild() {
    const button = byId("build");
    button.textContent = say(this.guide.open ? "build_end" : "build");
    button.setAttribute("aria-pressed", String(this.guide.open));
  }

  // ---- what is lit

  /** @param {Spot | null} spot */
  hover(spot) {
    const {hovered} = this.selection;
    const same = spot?.piece === hovered?.piece && spot?.edge === hovered?.edge;
    this.selection.hovered = spot;
    if (!same) {
      this.light();
    }
  }

  /** @param {Spot | null} spot @param {boolean} add */
  choose(spot, add) {
    const {selection} = this;
    selection.choose(spot, add);
    this.light();
    if (spot && selection.chosen.size > 0 && byId("app").dataset.view !== "sheets") {
      this.showOnSheets(spot.piece);
    }
    this.onChoose(selection.single);
  }

  /** @param {number[]} pieces */
  chooseMany(pieces) {
    this.choosePieces(pieces);
    this.onChoose(null);
  }

  /** Chooses pieces as if somebody had, but offers nothing. @param {number[]} pieces @param {number} [edge] of the only one */
  choosePieces(pieces, edge) {
    this.selection.set(pieces, edge);
    this.light();
  }

  /** The edge between these vertices of the model lights up, wherever it lies now. @param {number[]} ends */
  markEdge(ends) {
    const e = this.nets.edges.findIndex((_, i) => modelEnds(this.nets, i).every((v) => ends.includes(v)));
    if (e >= 0) {
      this.choosePieces([this.nets.edges[e].piece], e);
    }
  }

  /** These faces of the model are in the way. @param {number[]} modelFaces */
  markFaces(modelFaces) {
    const {edges, modelFace} = this.nets;
    const faces = new Set(modelFaces);
    this.selection.inTheWay = edges.map((_, e) => e).filter((e) => edges[e].faces.some((f) => faces.has(modelFace[f])));
    this.light();
  }

  /** Scrolls the sheets where a piece can't be seen. @param {number} piece */
  showOnSheets(piece) {
    if (!this.plan.sees(piece) && !this.plan.fitted) {
      this.plan.goTo({piece, edge: -1});
    }
  }

  /** What is lit now: pieces, and edges that are marked. */
  lit() {
    const {guide} = this;
    return this.selection.lit(guide.open ? {pieces: guide.current.pieces, edges: guide.edgesNow()} : {pieces: [], edges: []});
  }

  light() {
    const {nets, scene} = this;
    const {spot, pieces, edges} = this.lit();
    this.plan.light(pieces, edges);
    if (!this.guide.open) {
      scene.looks = nets.pieces.map((piece) => (pieces.size === 0 || pieces.has(piece.index) ? "plain" : "faded"));
    }
    scene.marked = new Set(edges);
    byId("foot").dataset.keys = spot && spot.edge >= 0 ? this.legend(spot.edge) : "";
    const text = spot ? (spot.edge >= 0 ? edgeLabel(nets, spot.edge) : pieceLabel(nets, spot.piece))
      : scene.simple ? say("no_webgl") : say(matchMedia("(hover:none)").matches ? "tip_touch" : "tip");
    byId("foot").textContent = text;
    byId("foot").classList.toggle("quiet", !spot);
    this.motion.request();
  }

  /** Turns the model so that what is meant is seen, and scrolls the sheets to it. @param {Spot} spot */
  visit(spot) {
    const {nets, folding} = this;
    this.choosePieces([spot.piece], spot.edge);
    this.plan.goTo(spot);
    this.onChoose(spot);
    const join = spot.edge >= 0 ? nets.edges[spot.edge].join : -1;
    const faces = join >= 0 ? nets.joins[join].edges.flatMap((e) => nets.edges[e].faces)
      : spot.edge >= 0 ? nets.edges[spot.edge].faces : nets.pieces[spot.piece].faces;
    const normal = [0, 1, 2].map((k) => faces.reduce((sum, f) => sum + folding.world[12 * f + 6 + k], 0));
    const length = Math.hypot(...normal);
    if (length > 1e-6) {
      this.motion.turnTo(Math.atan2(normal[0], normal[2]), Math.max(-1.2, Math.min(1.2, Math.asin(normal[1] / length))), 450);
    }
  }

  // ---- building step by step

  /** @param {boolean} open */
  build(open) {
    const {guide, motion, scene, selection} = this;
    guide.open = open;
    motion.playing = 0;
    byId("app").classList.toggle("building", open);
    document.body.classList.toggle("builds", open);
    this.#sayBuild();
    selection.clear();
    this.onChoose(null);
    guide.show();
    if (open) {
      scene.camera.home();
      guide.goTo(guide.step);
    } else {
      motion.setMoment(motion.folded);
      motion.say();
      this.light();
    }
    scene.resize();
  }

  stepChanged() {
    if (this.guide.open) {
      this.selection.pointed = [];
      this.motion.playStep();
      this.light();
      this.showOnSheets(this.guide.current.pieces[0]);
    }
  }

  // ---- menus

  menuItems() {
    return [
      {text: say("print_sheets"), key: "Ctrl+P", act: () => this.printer.printSheets()},
      {text: say("print_guide"), act: () => this.printer.printGuide()},
      {text: say("save_fold"), act: () => this.save("fold")},
      {text: say(reader.inches ? "millimetres" : "inches"), rule: true, act: () => {
        reader.inches = !reader.inches;
        this.sayEverything();
      }},
      ...[...languages].filter(([code]) => code !== reader.language).map(([code, {name}]) => ({text: name, act: () => {
        reader.language = code;
        this.sayEverything();
      }})),
      {text: say("all_keys"), key: "?", rule: true, act: () => showKeys(this.drawer.painted)},
    ];
  }

  /** Seams that nothing holds: a maker has to know them, the long ones first. */
  noteItems() {
    const {nets} = this;
    const length = (/** @type {import("./nets.js").Join} */ join) => nets.edges[join.edges[0]].length;
    return nets.joins.filter((join) => join.tab < 0).sort((a, b) => length(b) - length(a)).map((join) => ({text: edgeLabel(nets, join.edges[0]),
      act: () => this.visit({piece: join.pieces[0], edge: join.edges[0]})}));
  }

  /** @param {string} format */
  async save(format) {
    const bytes = await this.backend.export(format);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (bytes)], {type: "application/octet-stream"}));
    link.download = `${this.nets.title || "model"}.${format}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  // ---- how it is looked at

  fit() {
    this.plan.fit();
    this.motion.home();
  }

  toggleThrough() {
    this.scene.through = !this.scene.through;
    byId("through").setAttribute("aria-pressed", String(this.scene.through));
    this.motion.request();
  }

  toggleColours() {
    if (this.drawer.painted) {
      this.scene.painted = !this.scene.painted;
      byId("colours").setAttribute("aria-pressed", String(this.scene.painted));
      this.motion.request();
    }
  }

  /** One of the views, where there is room for one: "model" or "sheets". @param {string} side */
  show(side) {
    byId("app").dataset.view = side;
    ["model", "sheets"].forEach((other) => byId(`show-${other}`).setAttribute("aria-pressed", String(other === side)));
    this.#resize();
  }

  /** @param {Parameters<typeof inspectApp>[1]} about */
  inspect(about) {
    return inspectApp(this, about);
  }
}
