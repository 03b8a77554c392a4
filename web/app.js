// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the state of the page: what is pointed at and chosen, how far it is folded, which step is built.

import {foldShare, Folding, smooth} from "./folding.js";
import {Guide} from "./guide.js";
import {hasLine, modelEnds, readNets} from "./nets.js";
import {byId, Menu, sayAll, sayCheck, sayFacts, showKeys} from "./panel.js";
import {Printer} from "./print.js";
import {Scene} from "./scene.js";
import {hasMoved, PageDrawer, Plan, wheelSteps} from "./sheets.js";
import {reader, say, sayAngle, sayCount, sayLength, sayList, sayNoTab, sayNumber} from "./words.js";

/** @typedef {import("./backend.js").Backend} Backend */
/** @typedef {import("./backend.js").State} State */
/** @typedef {import("./scene.js").Spot} Spot */

/** Seconds from flat to built at speed 1, and those of a step. */
const foldSeconds = 8;
const stepSeconds = 6;
const speeds = [0.5, 1, 2, 4];
/** Pixels of all pictures of pages together, on the graphics card. */
const mostPixels = 16e6;

const blank = byId("app").cloneNode(true);

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
   * @param {(spot: Spot | null) => void} [chosen] told what is chosen by hand
   */
  constructor(backend, state, view = null, chosen = () => {}) {
    /** Ends what listens outside of the page's own elements. */
    this.ending = new AbortController();
    const ended = {signal: this.ending.signal};
    this.backend = backend;
    this.heedChosen = chosen;
    this.nets = readNets(state.fold);
    this.folding = new Folding(this.nets);
    /** @type {Spot | null} */
    this.hovered = null;
    /** @type {Set<number>} */
    this.chosen = new Set();
    this.chosenEdge = -1;
    /** Seams that the guide points at. @type {number[]} */
    this.pointed = [];
    /** Edges that are in the way of what was to be done. @type {number[]} */
    this.inTheWay = [];
    /** The slider: 0 flat, 1 built. */
    this.folded = 1;
    this.playing = 0;
    this.speed = 1;
    this.calm = matchMedia("(prefers-reduced-motion:reduce)");
    this.frames = {first: 0, script: 0, last: 0};
    this.posed = false;
    this.freeView = false;
    /** @type {((now: number) => boolean)[]} */
    this.motions = [];
    byId("app").hidden = false;
    this.scene = new Scene(/** @type {HTMLCanvasElement} */ (byId("stage")), this.folding, () => this.#renew());
    this.stage = this.scene.canvas;
    const sheets = JSON.parse(state.sheets || '{"pages":[]}');
    this.drawer = new PageDrawer(this.nets, this.folding, sheets);
    this.plan = new Plan(/** @type {any} */ (byId("plan")), this.drawer, {
      hover: (spot) => this.hover(spot),
      choose: (spot, add) => this.choose(spot, add),
      chooseMany: (pieces) => this.chooseMany(pieces),
      visit: (spot) => this.visit(spot),
      pieceWords: (index) => this.pieceWords(index),
      edgeWords: (edge) => this.edgeWords(edge),
    });
    this.guide = new Guide(byId("guide"), byId("numbers"), this.scene, {
      changed: () => this.stepChanged(),
      point: (joins) => {
        this.pointed = joins;
        this.light();
      },
    });
    this.printer = new Printer(byId("print"), this.drawer, this.guide, ended.signal);
    this.menu = new Menu(byId("open-menu"), byId("menu"), () => this.menuItems(), ended.signal);
    this.notes = new Menu(byId("open-notes"), byId("notes"), () => this.noteItems(), ended.signal);
    this.#listenStage();
    this.#listenControls();
    this.#listenKeys();
    this.sayEverything();
    const dark = matchMedia("(prefers-color-scheme:dark)");
    const heedDark = () => {
      this.scene.dark = dark.matches;
      this.request();
    };
    dark.addEventListener("change", heedDark, ended);
    heedDark();
    const resized = new ResizeObserver(() => {
      this.scene.resize();
      this.plan.resize();
      this.request();
    });
    resized.observe(byId("model"));
    resized.observe(byId("paper"));
    ended.signal.addEventListener("abort", () => resized.disconnect());
    /** Whether the picture of the App before stays until the pages' pictures are there. */
    this.unpainted = false;
    if (view) {
      this.#goOn(view);
      this.unpainted = this.drawer.painted && view.painted && !this.scene.simple;
    }
    if (this.drawer.painted) {
      this.#paint();
    }
    if (!this.calm.matches && !view) {
      this.turnTo(this.scene.camera.azimuth, this.scene.camera.elevation, 1400, -0.9);
    }
    this.frame(performance.now());
  }

  /** @returns {View} */
  view() {
    const {azimuth, elevation, zoom, pan} = this.scene.camera;
    return {camera: {azimuth, elevation, zoom, pan}, plan: this.plan.fitted ? null : this.plan.view, sheets: this.#sheetSizes(),
      folded: this.folded, freeView: this.freeView, through: this.scene.through, painted: byId("colours").getAttribute("aria-pressed") === "true",
      speed: this.speed, split: /** @type {HTMLElement} */ (byId("divider").parentElement).style.getPropertyValue("--split"),
      side: byId("app").dataset.view ?? ""};
  }

  #sheetSizes() {
    return Array.from({length: this.drawer.count}, (_, p) => this.drawer.size(p).join(" ")).join();
  }

  /** Looks as the one before did. @param {View} view */
  #goOn(view) {
    Object.assign(this.scene.camera, view.camera);
    this.freeView = view.freeView;
    this.speed = view.speed;
    this.saySpeed();
    byId("colours").setAttribute("aria-pressed", String(view.painted));
    if (!view.through) {
      this.toggleThrough();
    }
    if (view.split) {
      this.splitAt(parseFloat(view.split));
    }
    if (view.side) {
      this.show(view.side);
    }
    if (view.plan && view.sheets === this.#sheetSizes()) {
      this.plan.look(view.plan);
    }
    this.setMoment(view.folded);
  }

  /**
   * Lets go of the page, so that another App can have it: its elements are made anew, but for the canvas, for a new one
   * would take a second where there is no graphics card, and browsers give a page sixteen at most.
   */
  stop() {
    this.ending.abort();
    this.playing = 0;
    this.motions = [];
    byId("app").replaceWith(blank.cloneNode(true));
    byId("stage").replaceWith(this.stage);
  }

  /** The graphics card has forgotten what it had. */
  #renew() {
    this.request();
    if (this.drawer.painted) {
      this.#paint();
    }
  }

  async #paint() {
    byId("colours").hidden = false;
    const [width, height] = this.drawer.size(0);
    const scale = Math.min(6, Math.sqrt(mostPixels / (this.nets.pages.length * width * height)));
    const pictures = await Promise.all(this.nets.pages.map((_, p) => this.drawer.picture(p, scale))).finally(() => {
      this.unpainted = false;
    });
    if (this.ending.signal.aborted) {
      return;
    }
    this.scene.setPaint(pictures);
    this.scene.painted = byId("colours").getAttribute("aria-pressed") === "true";
    this.request();
  }

  // ---- words

  sayEverything() {
    sayAll();
    sayFacts(this.nets);
    sayCheck(this.folding.refoldError);
    this.plan.say();
    this.guide.show();
    this.stage.setAttribute("aria-label", say("stage_label", {title: this.nets.title, pieces: sayCount("pieces", this.nets.pieces.length)}));
    this.saySpeed();
    const notes = this.noteItems().length;
    byId("open-notes").hidden = notes === 0;
    byId("open-notes").textContent = sayCount("notes", notes);
    this.sayBuild();
    this.sayPlaying();
    this.light();
  }

  /** @param {number} index */
  pieceWords(index) {
    const piece = this.nets.pieces[index];
    const partners = [...new Set(piece.joins.flatMap((j) => this.nets.joins[j].pieces))]
      .filter((p) => p !== index || piece.joins.some((j) => this.nets.joins[j].pieces.every((q) => q === index)))
      .map((p) => (p === index ? say("itself") : this.nets.pieces[p].name));
    return say("piece_line", {name: piece.name, page: say("page", {page: piece.page + 1}), faces: sayCount("faces", piece.faces.length),
      folds: sayCount("folds", piece.folds),
      glued: partners.length > 0 ? say("glued", {names: sayList(partners), joins: sayCount("joins", piece.joins.length)}) : ""});
  }

  /** @param {number} e */
  edgeWords(e) {
    const edge = this.nets.edges[e];
    const name = this.nets.pieces[edge.piece].name;
    const length = sayLength(edge.length);
    if (edge.join >= 0) {
      const join = this.nets.joins[edge.join];
      const [a, b] = join.pieces.map((p) => this.nets.pieces[p].name);
      return say("join_line", {number: join.number, a, b, length, tab: join.tab < 0 ? say("no_tab", {why: sayNoTab(join.why)})
        : say("tab_on", {name: this.nets.pieces[this.nets.tabs[join.tab].piece].name})});
    }
    return edge.kind === "B" ? say("border_line", {length, name})
      : say("fold_line", {kind: say(edge.kind === "M" ? "mountain" : "valley"), angle: sayAngle(edge.angle), length, name});
  }

  sayBuild() {
    const button = byId("build");
    button.textContent = say(this.guide.open ? "build_end" : "build");
    button.setAttribute("aria-pressed", String(this.guide.open));
  }

  saySpeed() {
    const text = `${sayNumber(this.speed, this.speed < 1 ? 1 : 0)}×`;
    byId("speed").textContent = text;
    byId("speed").setAttribute("aria-label", say("speed", {speed: text}));
    byId("speed").title = say("speed", {speed: text});
  }

  sayPlaying() {
    const button = byId("play");
    const text = say(this.playing !== 0 ? "pause" : "play");
    button.classList.toggle("playing", this.playing !== 0);
    button.setAttribute("aria-label", text);
    button.title = text;
  }

  // ---- what is lit

  /** @param {Spot | null} spot */
  hover(spot) {
    const same = spot?.piece === this.hovered?.piece && spot?.edge === this.hovered?.edge;
    this.hovered = spot;
    if (!same) {
      this.light();
    }
  }

  /** @param {Spot | null} spot @param {boolean} add */
  choose(spot, add) {
    if (!spot) {
      this.chosen.clear();
      this.chosenEdge = -1;
    } else if (add && spot.edge < 0) {
      this.chosen.has(spot.piece) ? this.chosen.delete(spot.piece) : this.chosen.add(spot.piece);
      this.chosenEdge = -1;
    } else {
      const again = spot.edge === this.chosenEdge && this.chosen.size === 1 && this.chosen.has(spot.piece);
      this.chosen = new Set(again ? [] : [spot.piece]);
      this.chosenEdge = again ? -1 : spot.edge;
    }
    this.hovered = null;
    this.inTheWay = [];
    this.light();
    if (spot && this.chosen.size > 0 && byId("app").dataset.view !== "sheets") {
      this.showOnSheets(spot);
    }
    this.heedChosen(this.chosen.size === 1 ? {piece: [...this.chosen][0], edge: this.chosenEdge} : null);
  }

  /** The edge between these vertices of the model lights up, wherever it lies now. @param {number[]} ends */
  markEdge(ends) {
    const e = this.nets.edges.findIndex((_, i) => modelEnds(this.nets, i).every((v) => ends.includes(v)));
    if (e >= 0) {
      this.chosen = new Set([this.nets.edges[e].piece]);
      this.chosenEdge = e;
      this.light();
    }
  }

  /** Chooses pieces as if somebody had, but offers nothing. @param {number[]} pieces */
  choosePieces(pieces) {
    this.chosen = new Set(pieces);
    this.chosenEdge = -1;
    this.light();
  }

  /** These faces of the model are in the way. @param {number[]} modelFaces */
  markFaces(modelFaces) {
    const faces = new Set(modelFaces);
    this.inTheWay = this.nets.edges.map((_, e) => e).filter((e) => this.nets.edges[e].faces.some((f) => faces.has(this.nets.modelFace[f])));
    this.light();
  }

  /** @param {number[]} pieces */
  chooseMany(pieces) {
    this.chosen = new Set(pieces);
    this.chosenEdge = -1;
    this.inTheWay = [];
    this.light();
    this.heedChosen(null);
  }

  /** Scrolls the sheets where what was clicked can't be seen. @param {Spot} spot */
  showOnSheets(spot) {
    if (!this.plan.sees(spot.piece) && !this.plan.fitted) {
      this.plan.goTo({piece: spot.piece, edge: -1});
    }
  }

  /** What is lit now: pieces, and edges that are marked. */
  lit() {
    const spot = this.hovered ?? (this.chosen.size > 0 ? {piece: [...this.chosen][0], edge: this.chosenEdge} : null);
    if (this.pointed.length > 0) {
      return {spot: null, pieces: new Set(this.pointed.flatMap((j) => this.nets.joins[j].pieces)),
        edges: this.pointed.flatMap((j) => this.nets.joins[j].edges)};
    }
    if (!spot) {
      return {spot, pieces: new Set(this.guide.open ? this.guide.current.pieces : []), edges: this.guide.open ? this.guide.edgesNow() : []};
    }
    const join = spot.edge >= 0 ? this.nets.edges[spot.edge].join : -1;
    const pieces = join >= 0 ? new Set(this.nets.joins[join].pieces) : this.hovered ? new Set([spot.piece]) : new Set(this.chosen);
    return {spot, pieces, edges: [...(join >= 0 ? this.nets.joins[join].edges : spot.edge >= 0 ? [spot.edge] : []), ...this.inTheWay]};
  }

  light() {
    const {spot, pieces, edges} = this.lit();
    this.plan.light(pieces, edges);
    if (!this.guide.open) {
      this.scene.looks = this.nets.pieces.map((piece) => (pieces.size === 0 || pieces.has(piece.index) ? "plain" : "faded"));
    }
    this.scene.marked = new Set(edges);
    const text = spot ? (spot.edge >= 0 ? this.edgeWords(spot.edge) : this.pieceWords(spot.piece))
      : this.scene.simple ? say("no_webgl") : say(matchMedia("(hover:none)").matches ? "tip_touch" : "tip");
    byId("foot").textContent = text;
    byId("foot").classList.toggle("quiet", !spot);
    this.request();
  }

  /** Turns the model so that what is meant is seen, and scrolls the sheets to it. @param {Spot} spot */
  visit(spot) {
    this.chosen = new Set([spot.piece]);
    this.chosenEdge = spot.edge;
    this.inTheWay = [];
    this.light();
    this.plan.goTo(spot);
    this.heedChosen(spot);
    const join = spot.edge >= 0 ? this.nets.edges[spot.edge].join : -1;
    const faces = join >= 0 ? this.nets.joins[join].edges.flatMap((e) => this.nets.edges[e].faces)
      : spot.edge >= 0 ? this.nets.edges[spot.edge].faces : this.nets.pieces[spot.piece].faces;
    const normal = [0, 1, 2].map((k) => faces.reduce((sum, f) => sum + this.folding.world[12 * f + 6 + k], 0));
    const length = Math.hypot(...normal);
    if (length > 1e-6) {
      this.turnTo(Math.atan2(normal[0], normal[2]), Math.max(-1.2, Math.min(1.2, Math.asin(normal[1] / length))), 450);
    }
  }

  // ---- motion

  request() {
    if (!this.requested) {
      this.requested = true;
      requestAnimationFrame((now) => this.frame(now));
    }
  }

  /** Something has moved. */
  repose() {
    this.posed = false;
    this.request();
  }

  /**
   * @param {number} azimuth
   * @param {number} elevation
   * @param {number} milliseconds
   * @param {number} [from] how far to the side it begins
   */
  turnTo(azimuth, elevation, milliseconds, from) {
    const {camera} = this.scene;
    const begin = [from === undefined ? camera.azimuth : azimuth + from, camera.elevation];
    const turn = from === undefined ? Math.atan2(Math.sin(azimuth - begin[0]), Math.cos(azimuth - begin[0])) : -from;
    const start = performance.now();
    this.motions = [(now) => {
      const t = this.calm.matches ? 1 : smooth((now - start) / milliseconds);
      camera.azimuth = begin[0] + t * turn;
      camera.elevation = begin[1] + t * (elevation - begin[1]);
      return t < 1;
    }];
    this.request();
  }

  /** @param {number} now */
  frame(now) {
    this.requested = false;
    if (this.ending.signal.aborted) {
      return;
    }
    const begin = performance.now();
    const seconds = Math.min(0.1, Math.max(0, (now - this.frames.last) / 1000));
    this.frames.last = now;
    this.motions = this.motions.filter((motion) => motion(now));
    if (this.playing !== 0) {
      this.#advance(seconds * this.speed);
    }
    if (!this.posed) {
      this.#pose();
      this.posed = true;
    }
    if (!this.unpainted) {
      this.scene.draw();
    }
    this.guide.label();
    if (this.frames.first === 0) {
      this.frames.first = performance.now();
    }
    this.frames.script = performance.now() - begin;
    if (this.motions.length > 0 || this.playing !== 0) {
      this.request();
    }
  }

  /** @param {number} seconds */
  #advance(seconds) {
    const at = this.guide.open ? this.guide.at + (this.playing * seconds) / stepSeconds
      : this.folded + (this.playing * seconds) / foldSeconds;
    this.setMoment(Math.min(1, Math.max(0, at)));
    if (at >= 1 || at <= 0) {
      this.playing = 0;
      this.sayPlaying();
    }
  }

  /** Sets the slider, of the whole or of a step. @param {number} t */
  setMoment(t) {
    if (this.guide.open) {
      this.guide.at = t;
    } else {
      this.folded = t;
      this.freeView &&= t > 0 && t < 1;
    }
    const slider = /** @type {HTMLInputElement} */ (byId("fold-slider"));
    slider.value = String(Math.round(1000 * t));
    slider.setAttribute("aria-valuetext", `${Math.round(100 * t)} %`);
    slider.style.setProperty("--share", String(t));
    this.repose();
  }

  #pose() {
    const {scene, folding, guide} = this;
    if (guide.open) {
      guide.pose();
      scene.marked = new Set(this.lit().edges);
      return;
    }
    folding.putAll(this.folded);
    scene.place();
    const flown = smooth((this.folded - foldShare) / (1 - foldShare));
    const pieces = scene.roomOf(() => true);
    scene.table = 1 - flown;
    if (scene.table > 0) {
      const grid = folding.grid;
      const width = Math.max(grid.columns * grid.width - grid.gap, pieces.width + 2 * Math.abs(pieces.x));
      const depth = Math.max(grid.rows * grid.height - grid.gap, pieces.depth + 2 * Math.abs(pieces.z));
      const sheets = {x: 0, z: 0, low: Math.min(0, pieces.low), high: pieces.high, width, depth,
        radius: Math.max(0.5 * Math.hypot(width, depth), pieces.radius + Math.hypot(pieces.x, pieces.z))};
      scene.lookAt(sheets, pieces, flown);
    } else {
      scene.lookAt(pieces);
    }
    scene.camera.tilt = this.freeView ? 0 : scene.table;
  }

  play() {
    if (this.playing !== 0) {
      this.playing = 0;
    } else {
      const at = this.guide.open ? this.guide.at : this.folded;
      if (this.guide.open && at >= 1) {
        this.setMoment(0);
      }
      this.playing = !this.guide.open && at >= 1 ? -1 : 1;
      if (this.calm.matches) {
        this.setMoment(this.playing > 0 ? 1 : 0);
        this.playing = 0;
      }
    }
    this.sayPlaying();
    this.request();
  }

  // ---- building

  /** @param {boolean} open */
  build(open) {
    this.guide.open = open;
    this.playing = 0;
    byId("app").classList.toggle("building", open);
    this.sayBuild();
    this.hovered = null;
    this.chosen.clear();
    this.chosenEdge = -1;
    this.inTheWay = [];
    this.heedChosen(null);
    this.guide.show();
    if (open) {
      this.scene.camera.home();
      this.guide.goTo(this.guide.step);
    } else {
      this.setMoment(this.folded);
      this.sayPlaying();
      this.light();
    }
    this.scene.resize();
  }

  stepChanged() {
    if (!this.guide.open) {
      return;
    }
    this.pointed = [];
    this.setMoment(this.guide.at);
    this.playing = this.guide.at === 0 ? 1 : 0;
    if (this.calm.matches && this.playing) {
      this.setMoment(1);
      this.playing = 0;
    }
    this.sayPlaying();
    this.light();
    const [piece] = this.guide.current.pieces;
    if (!this.plan.fitted && !this.plan.sees(piece)) {
      this.plan.goTo({piece, edge: -1});
    }
  }

  // ---- wishes

  menuItems() {
    return [
      {text: say("print_sheets"), key: "Ctrl+P", act: () => this.printer.printSheets()},
      {text: say("print_guide"), act: () => this.printer.printGuide()},
      {text: say("save_fold"), act: () => this.save("fold")},
      {text: say(reader.inches ? "millimetres" : "inches"), rule: true, act: () => {
        reader.inches = !reader.inches;
        this.sayEverything();
      }},
      {text: say("language"), act: () => {
        reader.language = reader.language === "de" ? "en" : "de";
        this.sayEverything();
      }},
      {text: say("all_keys"), key: "?", rule: true, act: () => showKeys(this.drawer.painted)},
    ];
  }

  /** Seams that nothing holds: a maker has to know them, the long ones first. */
  noteItems() {
    const length = (/** @type {import("./nets.js").Join} */ join) => this.nets.edges[join.edges[0]].length;
    return this.nets.joins.filter((join) => join.tab < 0).sort((a, b) => length(b) - length(a)).map((join) => ({text: this.edgeWords(join.edges[0]),
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

  fit() {
    this.scene.camera.home();
    this.freeView = false;
    this.plan.fit();
    this.repose();
  }

  toggleThrough() {
    this.scene.through = !this.scene.through;
    byId("through").setAttribute("aria-pressed", String(this.scene.through));
    this.request();
  }

  toggleColours() {
    if (this.drawer.painted) {
      this.scene.painted = !this.scene.painted;
      byId("colours").setAttribute("aria-pressed", String(this.scene.painted));
      this.request();
    }
  }

  // ---- hands

  #listenStage() {
    const {stage, scene} = this;
    const {camera} = scene;
    /** @type {Map<number, {x: number, y: number}>} */
    const fingers = new Map();
    // The canvas stays when this ends.
    const ended = {signal: this.ending.signal};
    let moved = 0;
    const at = (/** @type {MouseEvent} */ event) => {
      const box = stage.getBoundingClientRect();
      return {x: event.clientX - box.left, y: event.clientY - box.top};
    };
    const reachOf = (/** @type {PointerEvent} */ event) => (event.pointerType === "touch" ? 16 : 7);
    stage.addEventListener("pointerdown", (event) => {
      stage.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, at(event));
      moved = 0;
      this.motions = [];
    }, ended);
    stage.addEventListener("pointermove", (event) => {
      const now = at(event);
      const before = fingers.get(event.pointerId);
      if (!before) {
        if (hasMoved(event)) {
          this.hover(scene.pick(now.x, now.y, reachOf(event)));
        }
        return;
      }
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
          this.freeView = true;
        }
        camera.turn(dx, dy);
      }
      this.request();
    }, ended);
    const up = (/** @type {PointerEvent} */ event) => {
      if (event.type === "pointerup" && moved <= 4 && fingers.size === 1 && event.button === 0) {
        const now = at(event);
        this.choose(scene.pick(now.x, now.y, reachOf(event)), event.ctrlKey || event.metaKey);
      }
      fingers.delete(event.pointerId);
    };
    stage.addEventListener("pointerup", up, ended);
    stage.addEventListener("pointercancel", up, ended);
    stage.addEventListener("pointerleave", () => this.hover(null), ended);
    stage.addEventListener("contextmenu", (event) => event.preventDefault(), ended);
    stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      const now = at(event);
      camera.zoomAt(Math.exp(-wheelSteps(event) * 0.14), now.x, now.y);
      this.request();
    }, {passive: false, ...ended});
    stage.addEventListener("dblclick", (event) => {
      const now = at(event);
      const spot = scene.pick(now.x, now.y, 7);
      spot ? this.visit(spot) : this.fit();
    }, ended);
  }

  #listenControls() {
    const act = (/** @type {string} */ id, /** @type {() => void} */ what) => byId(id).addEventListener("click", what);
    act("play", () => this.play());
    act("build", () => this.build(!this.guide.open));
    act("through", () => this.toggleThrough());
    act("colours", () => this.toggleColours());
    act("fit-model", () => {
      this.scene.camera.home();
      this.freeView = false;
      this.repose();
    });
    act("fit-sheets", () => this.plan.fit());
    act("speed", () => {
      this.speed = speeds[(speeds.indexOf(this.speed) + 1) % speeds.length];
      this.saySpeed();
    });
    const slider = /** @type {HTMLInputElement} */ (byId("fold-slider"));
    slider.addEventListener("input", () => {
      this.playing = 0;
      this.sayPlaying();
      this.setMoment(Number(slider.value) / 1000);
    });
    slider.style.setProperty("--share", "1");
    for (const view of ["model", "sheets"]) {
      act(`show-${view}`, () => {
        this.show(view);
        const lit = this.lit();
        if (view === "sheets" && lit.pieces.size > 0) {
          this.plan.goTo(lit.spot ?? {piece: [...lit.pieces][0], edge: -1});
        }
      });
    }
    const divider = byId("divider");
    const split = (/** @type {number} */ percent) => this.splitAt(percent);
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
      if (divider.hasPointerCapture(event.pointerId)) {
        const box = /** @type {HTMLElement} */ (divider.parentElement).getBoundingClientRect();
        split(getComputedStyle(/** @type {HTMLElement} */ (divider.parentElement)).flexDirection === "column"
          ? (100 * (event.clientY - box.top)) / box.height : (100 * (event.clientX - box.left)) / box.width);
      }
    });
    divider.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: -4, ArrowUp: -4, ArrowRight: 4, ArrowDown: 4}[event.key];
      if (step) {
        split(Number(divider.getAttribute("aria-valuenow")) + step);
        event.preventDefault();
        event.stopPropagation();
      }
    });
    divider.addEventListener("dblclick", () => split(50));
  }

  /** One of the views, where there is room for one: "model" or "sheets". @param {string} side */
  show(side) {
    byId("app").dataset.view = side;
    ["model", "sheets"].forEach((other) => byId(`show-${other}`).setAttribute("aria-pressed", String(other === side)));
    this.scene.resize();
    this.plan.resize();
    this.request();
  }

  /** @param {number} percent of the width, for the model */
  splitAt(percent) {
    const kept = Math.round(Math.min(80, Math.max(20, percent)));
    const divider = byId("divider");
    divider.setAttribute("aria-valuenow", String(kept));
    /** @type {HTMLElement} */ (divider.parentElement).style.setProperty("--split", `${kept}%`);
  }

  #listenKeys() {
    document.addEventListener("keydown", (event) => {
      const target = /** @type {Element} */ (event.target);
      if (event.ctrlKey || event.metaKey || event.altKey || target.closest("dialog,form,.menu")) {
        return;
      }
      const isRange = target.matches("input[type=range]");
      const isButton = target.matches("button,input");
      const index = Number(target.closest("[data-piece]")?.getAttribute("data-piece") ?? -1);
      if (index >= 0 && this.#pieceKey(event, index, Number(target.getAttribute("data-edge") ?? -1))) {
        event.preventDefault();
        return;
      }
      const {camera} = this.scene;
      const turn = (/** @type {number} */ dx, /** @type {number} */ dy) => {
        camera.turn(dx, dy);
        this.request();
      };
      const onStage = target === this.stage;
      /** @type {Record<string, (() => void) | undefined>} */
      const keys = {
        " ": isButton && !isRange ? undefined : () => this.play(),
        ArrowLeft: isRange ? undefined : this.guide.open ? () => this.guide.goTo(this.guide.step - 1) : onStage ? () => turn(-16, 0) : undefined,
        ArrowRight: isRange ? undefined : this.guide.open ? () => this.guide.goTo(this.guide.step + 1) : onStage ? () => turn(16, 0) : undefined,
        ArrowUp: onStage ? () => turn(0, 16) : undefined,
        ArrowDown: onStage ? () => turn(0, -16) : undefined,
        "+": () => this.#zoom(1.25),
        "-": () => this.#zoom(0.8),
        b: () => this.build(!this.guide.open),
        d: this.guide.open ? () => this.guide.tick(!this.guide.ticks.done.has(this.guide.step)) : undefined,
        Home: isRange ? undefined : () => this.fit(),
        f: () => {
          const {spot} = this.lit();
          spot ? this.visit(spot) : this.fit();
        },
        x: () => this.toggleThrough(),
        t: () => this.toggleColours(),
        Escape: () => this.choose(null, false),
        "?": () => showKeys(this.drawer.painted),
      };
      const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (act) {
        act();
        event.preventDefault();
      }
    }, {signal: this.ending.signal});
  }

  /** @param {number} factor */
  #zoom(factor) {
    this.scene.camera.zoomAt(factor, 0.5 * this.scene.camera.width, 0.5 * this.scene.camera.height);
    this.request();
  }

  /** Keys on a piece of the sheets. @param {KeyboardEvent} event @param {number} index @param {number} edge */
  #pieceKey(event, index, edge) {
    if (event.key === "Enter") {
      this.visit({piece: index, edge});
      return true;
    }
    const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (step === 0) {
      return false;
    }
    const edges = this.nets.pieces[index].edges.filter((e) => hasLine(this.nets, e));
    const here = edges.indexOf(edge);
    this.plan.focusEdge(index, edges[here < 0 ? (step > 0 ? 0 : edges.length - 1) : (here + step + edges.length) % edges.length]);
    return true;
  }

  // ---- for tests

  /**
   * What the page shows, for whoever tests it.
   * @param {{x?: number, y?: number, edge?: number, red?: boolean}} [about] a place in the window; an edge; whether the
   *   pixels are counted that marks turn red on the model
   */
  inspect(about = {}) {
    const {nets, scene} = this;
    const {spot, pieces, edges} = this.lit();
    const box = this.stage.getBoundingClientRect();
    const onSheet = about.x !== undefined && about.y !== undefined ? this.plan.pick(about.x, about.y, 6) : null;
    const onModel = about.x !== undefined && about.y !== undefined ? scene.pick(about.x - box.left, about.y - box.top, 7) : null;
    let faces = true;
    for (let c = 0; c < scene.corners.length && faces; c += 6) {
      const [x, y] = scene.camera.project(scene.corners[c], scene.corners[c + 1], scene.corners[c + 2]);
      faces = x >= -0.5 && y >= -0.5 && x <= box.width + 0.5 && y <= box.height + 0.5;
    }
    return {
      title: nets.title, pieces: nets.pieces.length, joins: nets.joins.map((join) => ({number: join.number, edges: join.edges, pieces: join.pieces})),
      folds: nets.edges.map((_, e) => e).filter((e) => nets.edges[e].kind !== "B" && hasLine(nets, e)), camera: this.view().camera,
      steps: nets.steps, simple: scene.simple, painted: scene.painted, language: reader.language,
      folded: this.folded, playing: this.playing, building: this.guide.open, step: this.guide.step, at: this.guide.at,
      done: [...this.guide.ticks.done], spot, lit: [...pieces], marked: edges, chosen: [...this.chosen],
      looks: [...scene.looks], foot: byId("foot").textContent, refoldError: this.folding.refoldError, facesInView: faces,
      firstPicture: this.frames.first, script: this.frames.script, red: about.red ? this.#markedPixels() : -1, under: {sheet: onSheet, model: onModel},
      places: about.edge === undefined ? null : this.#placesOf(about.edge),
    };
  }

  /** Where the middle of an edge is in the window, on both sides. @param {number} e */
  #placesOf(e) {
    const box = this.stage.getBoundingClientRect();
    const [p, q] = this.scene.edgeEnds(e);
    const [x, y] = this.scene.camera.project(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2]));
    return {model: [box.left + x, box.top + y], sheet: this.plan.clientOf(e)};
  }

  /** Pixels of the model's view that marks change. */
  #markedPixels() {
    const {stage, scene} = this;
    const copy = document.createElement("canvas");
    copy.width = stage.width;
    copy.height = stage.height;
    const context = copy.getContext("2d", {willReadFrequently: true});
    if (!context || copy.width < 2 || copy.height < 2) {
      return 0;
    }
    const {marked} = scene;
    const [bare, whole] = [new Set(), marked].map((edges) => {
      scene.marked = edges;
      scene.draw();
      context.clearRect(0, 0, copy.width, copy.height);
      context.drawImage(stage, 0, 0);
      return context.getImageData(0, 0, copy.width, copy.height).data;
    });
    let count = 0;
    for (let i = 0; i < bare.length; i += 4) {
      count += whole[i] - whole[i + 1] - (bare[i] - bare[i + 1]) > 30 ? 1 : 0;
    }
    return count;
  }
}
