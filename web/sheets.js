// SPDX-License-Identifier: GPL-3.0-or-later
// The sheets: pages in a grid that can be moved and zoomed, and what is under the pointer.

import {movedPlace, placeNow, placeOfPiece} from "./desk.js";
import {faceOfPieceAt, hasLine} from "./nets.js";
import {svgElement} from "./page_drawer.js";
import {segmentDistance} from "./scene.js";

/** @typedef {import("./page_drawer.js").PageDrawer} PageDrawer */
/** @typedef {import("./scene.js").Spot} Spot */

/**
 * @typedef {object} PlanListener
 * @property {(spot: Spot | null) => void} hover
 * @property {(spot: Spot | null, add: boolean) => void} choose
 * @property {(pieces: number[]) => void} chooseMany
 * @property {(spot: Spot) => void} visit
 * @property {(index: number) => string} pieceWords
 * @property {(edge: number) => string} edgeWords
 */

/**
 * From where a piece lies to where it is shown, and back: points on the grid of pages.
 * @typedef {{transform: string, there: (point: number[]) => number[], back: (point: number[]) => number[]}} Motion
 *
 * What is drawn, and how it looks. Browsers lay out what is new alone, so what looks as before stays where it is.
 * @typedef {{group: SVGGElement, sheet: SVGRectElement, ground: SVGGElement, furniture: SVGGElement, said: string, pieces: Map<string, SVGGElement>}} DrawnPage
 */

/** The pages that there are in an element. @type {WeakMap<SVGSVGElement, {group: SVGGElement, pages: DrawnPage[]}>} */
const drawn = new WeakMap();

/** All pages side by side, that can be moved, zoomed and pointed at. */
export class Plan {
  /**
   * @param {SVGSVGElement} svg
   * @param {PageDrawer} drawer
   * @param {PlanListener} listener
   * @param {AbortSignal} ended when the element shows other sheets
   */
  constructor(svg, drawer, listener, ended) {
    this.svg = svg;
    this.ended = ended;
    this.drawer = drawer;
    this.nets = drawer.nets;
    this.listener = listener;
    this.view = {x: 0, y: 0, scale: 1};
    this.fitted = true;
    /** @type {{x: number, y: number}[]} */
    this.corners = [];
    /** @type {SVGGElement[]} */
    this.pieces = [];
    /** What of a piece lies below the others. @type {SVGElement[]} */
    this.grounds = [];
    /** Pieces that are shown elsewhere than the program has them. @type {Map<number, Motion>} */
    this.loose = new Map();
    /** Where they are shown. @type {Map<number, import("./desk.js").Place>} */
    this.places = new Map();
    /** @type {number[]} */
    this.edges = [];
    /** Where pieces may be moved. @type {import("./drag.js").PieceDrag | null} */
    this.drag = null;
    /** The cell of the grid behind the last page, while pieces are dragged. @type {SVGRectElement | null} */
    this.newPage = null;
    const before = drawn.get(svg);
    this.pagesGroup = before?.group ?? svgElement("g", {}, svg);
    [...svg.children].forEach((child) => child !== this.pagesGroup && child.remove());
    svg.classList.remove("dimmed", "dragging");
    this.marks = svgElement("g", {class: "marks"}, svg);
    this.#draw(before?.pages ?? []);
    this.#listen(ended);
    this.resize();
  }

  /** @param {DrawnPage[]} before */
  #draw(before) {
    const {drawer, nets} = this;
    before.splice(drawer.count).forEach(({group}) => group.remove());
    const pages = Array.from({length: drawer.count}, (_, p) => before[p] ?? this.#newPage());
    drawn.set(this.svg, {group: this.pagesGroup, pages});
    this.pageGroups = pages.map(({group}) => group);
    inOrder(this.pageGroups, this.pagesGroup, this.pagesGroup.firstChild);
    pages.forEach((page, p) => {
      const [width, height] = drawer.size(p);
      page.sheet.setAttribute("width", String(width));
      page.sheet.setAttribute("height", String(height));
      page.ground.replaceChildren();
      Object.assign(this.grounds, drawer.ground(page.ground, p));
      const known = page.pieces;
      page.pieces = new Map();
      for (const index of nets.pages[p]?.pieces ?? []) {
        const look = drawer.look(index, true);
        const key = JSON.stringify(look);
        const group = known.get(key) ?? svgElement("g", {class: "piece", tabindex: 0, role: "img"});
        if (!known.delete(key)) {
          drawer.piece(group, look);
        }
        group.setAttribute("data-piece", String(index));
        group.removeAttribute("transform");
        group.classList.remove("loose", "no-room");
        page.pieces.set(key, group);
        this.pieces[index] = group;
      }
      known.forEach((group) => group.remove());
      inOrder([...page.pieces.values()], page.group, page.ground.nextSibling);
      const furniture = drawer.furniture(p);
      const said = JSON.stringify([height, furniture]);
      if (said !== page.said) {
        page.said = said;
        page.furniture.replaceChildren();
        furniture.forEach((group) => drawer.marks(page.furniture, p, group));
      }
    });
    this.say();
  }

  /** @returns {DrawnPage} */
  #newPage() {
    const group = svgElement("g", {class: "page"}, this.pagesGroup);
    return {group, sheet: svgElement("rect", {class: "sheet"}, group), ground: svgElement("g", {class: "ground"}, group),
      furniture: svgElement("g", {class: "furniture"}, group), said: "", pieces: new Map()};
  }

  /** Shows a piece elsewhere than it lies, or there. @param {number} index @param {string} [transform] */
  shift(index, transform = "") {
    const all = `${transform} ${this.loose.get(index)?.transform ?? ""}`.trim();
    for (const part of [this.pieces[index], this.grounds[index]]) {
      all ? part?.setAttribute("transform", all) : part?.removeAttribute("transform");
    }
  }

  /** Shows pieces where they were left, which isn't where the program has them. @param {Map<number, import("./desk.js").Place>} places */
  loosen(places) {
    const before = [...this.loose.keys()];
    this.places = places;
    this.loose = new Map([...places].map(([index, place]) => [index, this.#motionTo(index, place)]));
    this.pieces.forEach((group, index) => group.classList.toggle("loose", this.loose.has(index)));
    [...before, ...this.loose.keys()].forEach((index) => this.shift(index));
    this.#drawMarks();
  }

  /** Where a piece is shown. @param {number} index */
  placeOf(index) {
    return this.places.get(index) ?? placeNow(this.nets, index);
  }

  /** The same turned about its middle, and moved. @param {number} index @param {number} dx mm to the right @param {number} dy mm up
   * @param {number} degrees counterclockwise */
  moved(index, dx, dy, degrees) {
    const place = this.places.get(index);
    if (!place) {
      return placeOfPiece(this.nets, index, dx, dy, degrees);
    }
    const [left, top, right, bottom] = this.pieceBox(index);
    return movedPlace(place, this.onPage(place.page - 1, [0.5 * (left + right), 0.5 * (top + bottom)]), dx, dy, degrees);
  }

  /** From where the program has a piece to a place. @param {number} index @param {import("./desk.js").Place} place @returns {Motion} */
  #motionTo(index, place) {
    const own = placeNow(this.nets, index, place.face);
    const begin = this.#onGrid(own.page - 1, own.at);
    const end = this.#onGrid(place.page - 1, place.at);
    const {x, y} = this.corners[own.page - 1];
    const degrees = own.degrees - place.degrees;
    const angle = (degrees * Math.PI) / 180;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const turned = (/** @type {number[]} */ [px, py], /** @type {number[]} */ from, /** @type {number[]} */ to, /** @type {number} */ sine) =>
      [to[0] + c * (px - from[0]) - sine * (py - from[1]), to[1] + sine * (px - from[0]) + c * (py - from[1])];
    return {transform: `translate(${end[0] - begin[0]} ${end[1] - begin[1]}) rotate(${degrees} ${begin[0] - x} ${begin[1] - y})`,
      there: (point) => turned(point, begin, end, s), back: (point) => turned(point, end, begin, -s)};
  }

  /** A point of a page, mm from its lower left corner, on the grid of pages. @param {number} p @param {number[]} at */
  #onGrid(p, [x, y]) {
    const corner = this.cornerOf(p);
    return [corner.x + x, corner.y + this.#height(p) - y];
  }

  /** The same the other way round. @param {number} p @param {number[]} point */
  onPage(p, [x, y]) {
    const corner = this.cornerOf(p);
    return [x - corner.x, this.#height(p) - (y - corner.y)];
  }

  /** Of a page of nets; one more than there are is a new one. @param {number} p */
  #height(p) {
    return this.drawer.size(Math.min(p, this.nets.pages.length - 1))[1];
  }

  /** Names pieces for those who can't see them. */
  say() {
    this.pieces.forEach((group, index) => group.setAttribute("aria-label", this.listener.pieceWords(index)));
  }

  /** Pages in the grid that fills the view best. */
  #arrange() {
    const {drawer} = this;
    const [width, height] = drawer.size(0);
    const gap = 0.06 * width;
    const box = this.svg.getBoundingClientRect();
    let columns = 1;
    let best = 0;
    for (let n = 1; n <= drawer.count; ++n) {
      const rows = Math.ceil(drawer.count / n);
      const scale = Math.min(box.width / (n * (width + gap)), box.height / (rows * (height + gap)));
      if (scale > best * 1.001) {
        best = scale;
        columns = n;
      }
    }
    this.columns = columns;
    this.corners = Array.from({length: drawer.count}, (_, p) => this.#cell(p));
    this.corners.forEach((corner, p) => this.pageGroups?.[p].setAttribute("transform", `translate(${corner.x} ${corner.y})`));
    this.extent = {x: -0.5 * gap, y: -0.5 * gap, width: columns * (width + gap),
      height: Math.ceil(drawer.count / columns) * (height + gap)};
  }

  /** Where the p-th page of the grid begins. @param {number} p */
  #cell(p) {
    const [width, height] = this.drawer.size(0);
    const columns = this.columns ?? 1;
    return {x: (p % columns) * 1.06 * width, y: Math.floor(p / columns) * (height + 0.06 * width)};
  }

  /** The same of a page of nets; one more than there are is a new one. @param {number} p */
  cornerOf(p) {
    return p < this.nets.pages.length ? this.corners[p] : this.#cell(this.drawer.count);
  }

  /** Shows a sheet behind the last one, for pieces to be laid there. @param {boolean} shown */
  showNewPage(shown) {
    this.newPage?.remove();
    this.newPage = null;
    if (shown) {
      const [width, height] = this.drawer.size(0);
      this.newPage = svgElement("rect", {class: "new-page", ...this.#cell(this.drawer.count), width, height});
      this.svg.prepend(this.newPage);
    }
  }

  /** Draws a piece above all others. @param {number} index */
  raise(index) {
    const group = this.pieces[index];
    group.parentElement?.append(group);
    if (group.parentElement) {
      this.pagesGroup.append(group.parentElement);
    }
  }

  /** The page of nets below a point of the window, the number of pages for a new one, or -1. @param {number} clientX @param {number} clientY */
  pageAtClient(clientX, clientY) {
    const [x, y] = this.atClient(clientX, clientY);
    const pages = this.nets.pages.length;
    for (let p = 0; p <= pages; ++p) {
      const corner = this.cornerOf(p);
      const [width, height] = this.drawer.size(p < pages ? p : 0);
      if (x >= corner.x && x <= corner.x + width && y >= corner.y && y <= corner.y + height) {
        return p;
      }
    }
    return -1;
  }

  /** The page of nets that a box on the grid of pages lies over the most, the number of pages for a new one, or -1.
   * @param {number[]} box left, top, right, bottom */
  pageBelow([left, top, right, bottom]) {
    const shared = Array.from({length: this.nets.pages.length + 1}, (_, p) => {
      const {x, y} = this.cornerOf(p);
      const [width, height] = this.drawer.size(Math.min(p, this.nets.pages.length - 1));
      return Math.max(0, Math.min(right, x + width) - Math.max(left, x)) * Math.max(0, Math.min(bottom, y + height) - Math.max(top, y));
    });
    const most = Math.max(...shared);
    return most > 0 ? shared.indexOf(most) : -1;
  }

  resize() {
    const box = this.svg.getBoundingClientRect();
    if (box.width < 2 || box.height < 2) {
      return;
    }
    const old = this.box;
    this.box = box;
    this.#arrange();
    if (this.places.size > 0) {
      this.loosen(this.places);
    }
    if (this.fitted || !old) {
      this.fit();
    } else {
      this.#apply();
    }
    this.#drawMarks();
  }

  /** Shows all sheets, and what lies beside them. */
  fit() {
    if (this.extent) {
      const {x, y, width, height} = this.extent;
      const boxes = [[x, y, x + width, y + height], ...[...this.loose.keys()].map((index) => this.pieceBox(index))];
      const [left, top, right, bottom] = [0, 1, 2, 3].map((k) => Math[k < 2 ? "min" : "max"](...boxes.map((box) => box[k])));
      this.#show({x: left, y: top, width: right - left, height: bottom - top}, 0.99);
      this.fitted = true;
    }
  }

  /** @param {{x: number, y: number, width: number, height: number}} room @param {number} share of the view that it fills */
  #show(room, share) {
    if (!this.box) {
      return;
    }
    const scale = Math.min(share * this.box.width / room.width, share * this.box.height / room.height);
    this.view = {scale, x: room.x + 0.5 * room.width - (0.5 * this.box.width) / scale,
      y: room.y + 0.5 * room.height - (0.5 * this.box.height) / scale};
    this.fitted = false;
    this.#apply();
  }

  #apply() {
    const {view, box, svg} = this;
    if (!box) {
      return;
    }
    svg.setAttribute("viewBox", `${view.x} ${view.y} ${box.width / view.scale} ${box.height / view.scale}`);
    svg.style.setProperty("--thin", String(Math.max(0.15, 0.7 / view.scale)));
    svg.style.setProperty("--thick", String(Math.max(0.2, 1 / view.scale)));
    svg.style.setProperty("--mark", String(Math.max(0.5, 3.2 / view.scale)));
    svg.classList.toggle("far", view.scale < 2);
    svg.classList.toggle("very-far", view.scale < 0.9);
    this.drag?.draw();
  }

  /** @param {{x: number, y: number, scale: number}} view */
  look(view) {
    this.view = {...view};
    this.fitted = false;
    this.#apply();
  }

  /** Shows a piece, or the seam of an edge. @param {Spot} spot */
  goTo(spot) {
    const join = spot.edge >= 0 ? this.nets.edges[spot.edge].join : -1;
    const boxes = join >= 0 ? this.nets.joins[join].edges.map((e) => this.#edgeBox(e)) : [this.pieceBox(spot.piece)];
    const low = [0, 1].map((k) => Math.min(...boxes.map((box) => box[k])));
    const high = [2, 3].map((k) => Math.max(...boxes.map((box) => box[k])));
    const least = 40;
    const [width, height] = [high[0] - low[0], high[1] - low[1]];
    const [w, h] = [Math.max(least, width), Math.max(least, height)];
    this.#show({x: low[0] - 0.5 * (w - width), y: low[1] - 0.5 * (h - height), width: w, height: h}, 0.8);
  }

  /** @param {number} p page @param {number} x @param {number} y of all nets */
  #atPlan(p, x, y) {
    const [sx, sy] = this.drawer.onSheet(p, x, y);
    return [this.corners[p].x + sx, this.corners[p].y + sy];
  }

  /** On the grid of pages: left, top, right, bottom. @param {number} index */
  pieceBox(index) {
    const {box, page} = this.nets.pieces[index];
    const [x, y] = this.#atPlan(page, box[0], box[3]);
    const [right, bottom] = [x + box[2] - box[0], y + box[3] - box[1]];
    const motion = this.loose.get(index);
    if (!motion) {
      return [x, y, right, bottom];
    }
    const corners = [[x, y], [right, y], [x, bottom], [right, bottom]].map(motion.there);
    return [0, 1, 2, 3].map((k) => Math[k < 2 ? "min" : "max"](...corners.map((corner) => corner[k % 2])));
  }

  /** @param {number} e */
  #endsOnPlan(e) {
    const {index, page} = this.nets.pieces[this.nets.edges[e].piece];
    const there = this.loose.get(index)?.there ?? ((/** @type {number[]} */ point) => point);
    return this.drawer.ends(e).map(([x, y]) => there(this.#atPlan(page, x, y)));
  }

  /** An edge as a path on the grid of pages. @param {number} e */
  lineOf(e) {
    return `M${this.#endsOnPlan(e).map((end) => end.join(" ")).join("L")}`;
  }

  /** @param {number} e */
  #edgeBox(e) {
    const [[ax, ay], [bx, by]] = this.#endsOnPlan(e);
    return [Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by)];
  }

  /** Where an edge, or a piece, is in the window: left, top, right, bottom. @param {Spot} spot */
  clientBox({piece, edge}) {
    const [left, top, right, bottom] = edge >= 0 ? this.#edgeBox(edge) : this.pieceBox(piece);
    const {left: x, top: y} = this.svg.getBoundingClientRect();
    const {view} = this;
    return [x + (left - view.x) * view.scale, y + (top - view.y) * view.scale, x + (right - view.x) * view.scale, y + (bottom - view.y) * view.scale];
  }

  /** Whether a piece can be seen whole. @param {number} index */
  sees(index) {
    if (!this.box) {
      return false;
    }
    const box = this.pieceBox(index);
    const {view} = this;
    return box[0] >= view.x && box[1] >= view.y && box[2] <= view.x + this.box.width / view.scale &&
      box[3] <= view.y + this.box.height / view.scale;
  }

  /**
   * Lights pieces up, and marks edges; with none all are as they are.
   * @param {Set<number>} pieces
   * @param {number[]} edges
   */
  light(pieces, edges) {
    this.svg.classList.toggle("dimmed", pieces.size > 0);
    this.pieces.forEach((group, index) => group.classList.toggle("lit", pieces.has(index)));
    this.edges = edges;
    this.#drawMarks();
  }

  #drawMarks() {
    this.marks.replaceChildren();
    const {edges} = this;
    /** @type {number[][]} */
    const middles = [];
    for (const e of edges) {
      const [[ax, ay], [bx, by]] = this.#endsOnPlan(e);
      svgElement("path", {class: "mark", d: this.lineOf(e)}, this.marks);
      middles.push([0.5 * (ax + bx), 0.5 * (ay + by)]);
    }
    this.drag?.draw();
    if (middles.length === 2) {
      svgElement("path", {class: "link", d: `M${middles[0].join(" ")}L${middles[1].join(" ")}`}, this.marks);
    }
  }

  /**
   * @param {number} clientX
   * @param {number} clientY
   * @param {number} reach pixels
   * @returns {Spot | null}
   */
  pick(clientX, clientY, reach) {
    if (!this.box) {
      return null;
    }
    const {view, nets, drawer} = this;
    const box = this.svg.getBoundingClientRect();
    const x = view.x + (clientX - box.left) / view.scale;
    const y = view.y + (clientY - box.top) / view.scale;
    for (const [index, {back}] of this.loose) {
      if (this.#faceAt(index, back([x, y])) >= 0) {
        return {piece: index, edge: -1};
      }
    }
    const p = nets.pages.findIndex((page, k) => x >= this.corners[k].x && x <= this.corners[k].x + page.width &&
      y >= this.corners[k].y && y <= this.corners[k].y + page.height);
    if (p < 0) {
      return null;
    }
    const page = nets.pages[p];
    const lying = page.pieces.filter((index) => !this.loose.has(index));
    const nx = x - this.corners[p].x + page.x;
    const ny = page.y + page.height - (y - this.corners[p].y);
    let best = reach / view.scale;
    /** @type {Spot | null} */
    let found = null;
    for (const index of lying) {
      const piece = nets.pieces[index];
      if (nx < piece.box[0] - best || nx > piece.box[2] + best || ny < piece.box[1] - best || ny > piece.box[3] + best) {
        continue;
      }
      for (const e of piece.edges) {
        if (hasLine(nets, e)) {
          const [a, b] = drawer.ends(e);
          const away = segmentDistance(nx, ny, a, b);
          if (away < best) {
            best = away;
            found = {piece: index, edge: e};
          }
        }
      }
    }
    if (found) {
      return found;
    }
    const tab = nets.tabs.find(({piece, polygon}) => lying.includes(piece) && holdsPoint(polygon, nx, ny));
    if (tab) {
      return {piece: tab.piece, edge: tab.edge};
    }
    const number = this.#numberAt(p, x - this.corners[p].x, page.height - (y - this.corners[p].y), nx, ny);
    if (number) {
      return number;
    }
    const index = lying.find((one) => faceOfPieceAt(nets, one, nx, ny) >= 0);
    return index === undefined ? null : {piece: index, edge: -1};
  }

  /** The face of a piece at a point of the grid of pages, as it lies; or -1. @param {number} index @param {number[]} point */
  #faceAt(index, point) {
    const {page} = this.nets.pieces[index];
    const [x, y] = this.onPage(page, point);
    return faceOfPieceAt(this.nets, index, x + this.nets.pages[page].x, y + this.nets.pages[page].y);
  }

  /** The edge whose number stands there. @param {number} p @param {number} x on the page, y up @param {number} y
   * @param {number} nx in the plane of all nets @param {number} ny @returns {Spot | null} */
  #numberAt(p, x, y, nx, ny) {
    const {nets, drawer} = this;
    for (const group of drawer.sheets.pages[p]?.groups ?? []) {
      const index = drawer.pieceByGroup.get(group.id);
      if (index === undefined || this.loose.has(index)) {
        continue;
      }
      const text = group.texts?.find(([layer, number, tx, ty, height]) => layer === 0 &&
        Math.hypot(x - tx, y - ty) < 0.5 * height * Math.max(1, 0.6 * number.length) + 0.4);
      if (text) {
        const edges = nets.pieces[index].joins.flatMap((j) => (nets.joins[j].number === parseInt(text[1].split(":").pop() ?? "", 10) ? nets.joins[j].edges : []))
          .filter((e) => nets.edges[e].piece === index);
        const away = (/** @type {number} */ e) => segmentDistance(nx, ny, drawer.ends(e)[0], drawer.ends(e)[1]);
        edges.sort((a, b) => away(a) - away(b));
        return edges.length > 0 ? {piece: index, edge: edges[0]} : null;
      }
    }
    return null;
  }

  /** Marks an edge of a piece for those who use the keyboard, and puts the focus on it. @param {number} index @param {number} e */
  focusEdge(index, e) {
    const group = this.pieces[index];
    const path = svgElement("path", {class: "focus-edge", tabindex: -1, role: "img", "aria-label": this.listener.edgeWords(e),
      d: this.drawer.edgePath(this.nets.pieces[index].page, e), "data-edge": e}, group);
    path.addEventListener("blur", () => setTimeout(() => path.remove()), {once: true});
    path.focus();
  }

  /** @param {AbortSignal} signal */
  #listen(signal) {
    const {svg} = this;
    /** @type {Map<number, {x: number, y: number}>} */
    const fingers = new Map();
    let moved = 0;
    /** @type {SVGRectElement | null} */
    let frame = null;
    let start = {x: 0, y: 0};
    const reachOf = (/** @type {PointerEvent | MouseEvent} */ event) =>
      "pointerType" in event && event.pointerType === "touch" ? 16 : 6;
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      moved = 0;
      start = {x: event.clientX, y: event.clientY};
      if (fingers.size > 1) {
        this.drag?.cancel();
      } else if (this.drag?.take(event, () => this.pick(event.clientX, event.clientY, reachOf(event)))) {
        return;
      }
      if (event.shiftKey) {
        frame = svgElement("rect", {class: "frame"}, svg);
      }
    }, {signal});
    svg.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) {
        if (!hasMoved(event)) {
          return;
        }
        this.listener.hover(this.pick(event.clientX, event.clientY, reachOf(event)));
        return;
      }
      const others = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const dx = event.clientX - before.x;
      const dy = event.clientY - before.y;
      moved += Math.abs(dx) + Math.abs(dy);
      if (this.drag?.dragged) {
        if (moved > 4) {
          this.drag.move(event);
        }
      } else if (frame) {
        const [a, b] = [start, {x: event.clientX, y: event.clientY}].map((at) => this.atClient(at.x, at.y));
        for (const [key, value] of Object.entries({x: Math.min(a[0], b[0]), y: Math.min(a[1], b[1]),
          width: Math.abs(a[0] - b[0]), height: Math.abs(a[1] - b[1])})) {
          frame.setAttribute(key, String(value));
        }
      } else if (others.length > 0) {
        const o = others[0];
        const old = Math.hypot(before.x - o.x, before.y - o.y);
        const now = Math.hypot(event.clientX - o.x, event.clientY - o.y);
        this.pan(0.5 * dx, 0.5 * dy);
        if (old > 1) {
          this.zoomAt(now / old, 0.5 * (event.clientX + o.x), 0.5 * (event.clientY + o.y));
        }
      } else if (moved > 4) {
        this.pan(dx, dy);
      }
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    }, {signal});
    const up = (/** @type {PointerEvent} */ event) => {
      const {drag} = this;
      if (drag?.dragged?.moved) {
        event.type === "pointerup" ? drag.drop() : drag.cancel();
        fingers.delete(event.pointerId);
        return;
      }
      drag?.dragged && drag.cancel();
      if (frame) {
        const [a, b] = [start, {x: event.clientX, y: event.clientY}].map((at) => this.atClient(at.x, at.y));
        frame.remove();
        frame = null;
        const [left, right] = [Math.min(a[0], b[0]), Math.max(a[0], b[0])];
        const [top, bottom] = [Math.min(a[1], b[1]), Math.max(a[1], b[1])];
        this.listener.chooseMany(this.nets.pieces.map((piece) => piece.index).filter((index) => {
          const box = this.pieceBox(index);
          return box[0] <= right && box[2] >= left && box[1] <= bottom && box[3] >= top;
        }));
      } else if (event.type === "pointerup" && moved <= 4 && fingers.size === 1) {
        this.listener.choose(this.pick(event.clientX, event.clientY, reachOf(event)), event.ctrlKey || event.metaKey);
      }
      fingers.delete(event.pointerId);
    };
    svg.addEventListener("pointerup", up, {signal});
    svg.addEventListener("pointercancel", up, {signal});
    svg.addEventListener("pointerleave", () => this.listener.hover(null), {signal});
    svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomAt(Math.exp(-wheelSteps(event) * 0.16), event.clientX, event.clientY);
    }, {passive: false, signal});
    svg.addEventListener("dblclick", (event) => {
      const spot = this.pick(event.clientX, event.clientY, 6);
      if (spot) {
        this.listener.visit(spot);
        return;
      }
      const [x, y] = this.atClient(event.clientX, event.clientY);
      const p = this.corners.findIndex((corner, k) => x >= corner.x && x <= corner.x + this.drawer.size(k)[0] && y >= corner.y &&
        y <= corner.y + this.drawer.size(k)[1]);
      if (p < 0) {
        this.fit();
      } else {
        const [width, height] = this.drawer.size(p);
        this.#show({...this.corners[p], width, height}, 0.96);
      }
    }, {signal});
    svg.addEventListener("focusin", (event) => {
      const target = /** @type {Element} */ (event.target);
      const index = Number(target.closest("[data-piece]")?.getAttribute("data-piece") ?? -1);
      // By a key: a finger's tap gives the focus, too, after it has chosen something.
      if (index >= 0 && fingers.size === 0 && target.matches(":focus-visible")) {
        const edge = Number(target.getAttribute("data-edge") ?? -1);
        this.listener.hover({piece: index, edge});
        if (!this.sees(index)) {
          this.goTo({piece: index, edge: -1});
        }
      }
    }, {signal});
    svg.addEventListener("focusout", () => this.listener.hover(null), {signal});
  }

  /** On the grid of pages, mm. @param {number} clientX @param {number} clientY */
  atClient(clientX, clientY) {
    const box = this.svg.getBoundingClientRect();
    return [this.view.x + (clientX - box.left) / this.view.scale, this.view.y + (clientY - box.top) / this.view.scale];
  }

  /** Where the middle of an edge is in the window. @param {number} e */
  clientOf(e) {
    const [left, top, right, bottom] = this.#edgeBox(e);
    const box = this.svg.getBoundingClientRect();
    return [box.left + (0.5 * (left + right) - this.view.x) * this.view.scale, box.top + (0.5 * (top + bottom) - this.view.y) * this.view.scale];
  }

  /** Where the middle of a piece is in the window. @param {number} index */
  clientOfPiece(index) {
    const [left, top, right, bottom] = this.pieceBox(index);
    const box = this.svg.getBoundingClientRect();
    return [box.left + (0.5 * (left + right) - this.view.x) * this.view.scale, box.top + (0.5 * (top + bottom) - this.view.y) * this.view.scale];
  }

  /** @param {number} dx pixels @param {number} dy */
  pan(dx, dy) {
    this.view.x -= dx / this.view.scale;
    this.view.y -= dy / this.view.scale;
    this.fitted = false;
    this.#apply();
  }

  /** @param {number} factor @param {number} clientX @param {number} clientY */
  zoomAt(factor, clientX, clientY) {
    const scale = Math.min(60, Math.max(0.15, this.view.scale * factor));
    const box = this.svg.getBoundingClientRect();
    const shift = 1 / this.view.scale - 1 / scale;
    this.view.x += (clientX - box.left) * shift;
    this.view.y += (clientY - box.top) * shift;
    this.view.scale = scale;
    this.fitted = false;
    this.#apply();
  }
}

/** Children in their order, for whoever goes from one to the next by keys; those that are in it aren't moved.
 * @param {Element[]} children @param {Element} parent @param {ChildNode | null} next where the first one is to be */
function inOrder(children, parent, next) {
  for (const child of children) {
    next === child ? (next = child.nextSibling) : parent.insertBefore(child, next);
  }
}

let lastPlace = "";

/**
 * Whether a pointer is elsewhere than at its last move: browsers also tell of a move where the page has changed under
 * a pointer that rests, and what the keyboard points at must not be lost by that.
 * @param {PointerEvent} event
 */
export function hasMoved(event) {
  const place = `${event.screenX} ${event.screenY}`;
  const moved = place !== lastPlace;
  lastPlace = place;
  return moved;
}

/** Notches of a mouse wheel; a touch pad gives parts of one. @param {WheelEvent} event */
export function wheelSteps(event) {
  const step = event.deltaMode === 0 ? event.deltaY / 100 : event.deltaY / 3;
  return Math.max(-3, Math.min(3, event.ctrlKey ? 6 * step : step));
}

/** @param {number[][]} polygon convex, counterclockwise @param {number} x @param {number} y */
function holdsPoint(polygon, x, y) {
  return polygon.every(([ax, ay], k) => {
    const [bx, by] = polygon[(k + 1) % polygon.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
  });
}
