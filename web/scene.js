// SPDX-License-Identifier: GPL-3.0-or-later
// The model's view: what stands where, in which colours, and what is under the pointer.

import {Camera, roomBetween} from "./camera.js";
import {hasLine} from "./nets.js";
import {PainterView} from "./painter.js";
import {webglView} from "./webgl.js";

/** @typedef {import("./camera.js").Room} Room */
/** @typedef {import("./folding.js").Folding} Folding */
/** @typedef {import("./nets.js").Nets} Nets */
/** @typedef {import("./webgl.js").Picture} Picture */

/** What is pointed at or chosen: a piece alone, or an edge of it. @typedef {{piece: number, edge: number}} Spot */

/** @typedef {"plain"|"faded"|"ghost"|"gone"} Look */

/** A triangle of what is drawn, by its corners in the plane of all nets. @typedef {{body: number, piece: number, flat: number[][], tab: boolean}} Triangle */

const mark = [214, 40, 40];

/** Faces page by page, then tabs. @param {Folding} folding */
function trianglesOf(folding) {
  const {nets} = folding;
  /** @type {Triangle[]} */
  const triangles = [];
  for (const page of nets.pages) {
    for (const piece of page.pieces) {
      for (const body of nets.pieces[piece].faces) {
        triangles.push({body, piece, flat: folding.flatCorners(body), tab: false});
      }
    }
  }
  nets.tabs.forEach(({piece, polygon, slit}, t) => {
    // What goes into a slit has a neck and a head, each of them convex.
    for (const part of slit ? [[0, 1, 2, 7], [3, 4, 5, 6]].map((corners) => corners.map((k) => polygon[k])) : [polygon]) {
      for (let k = 2; k < part.length; ++k) {
        triangles.push({body: folding.faceCount + t, piece, flat: [part[0], part[k - 1], part[k]], tab: true});
      }
    }
  });
  return triangles;
}

/** Triangles that follow each other on one page; tabs have none. @param {Nets} nets @param {Triangle[]} triangles */
function runsOf(nets, triangles) {
  /** @type {{from: number, to: number, page: number}[]} */
  const runs = [];
  triangles.forEach(({piece, tab}, i) => {
    const page = tab ? -1 : nets.pieces[piece].page;
    const last = runs[runs.length - 1];
    if (last?.page === page) {
      last.to = i + 1;
    } else {
      runs.push({from: i, to: i + 1, page});
    }
  });
  return runs;
}

/** Where corners lie on the picture of their page, 0 to 1. @param {Nets} nets @param {Triangle[]} triangles */
function spotsOf(nets, triangles) {
  return Float32Array.from(triangles.flatMap(({piece, flat}) => {
    const page = nets.pages[nets.pieces[piece].page];
    return flat.flatMap(([x, y]) => [(x - page.x) / page.width, 1 - (y - page.y) / page.height]);
  }));
}

/**
 * Corners on paper that is rolled, which is shaded as round: `at` in Scene.corners, and the faces around each that the
 * paper goes on to without a fold, by their angles there.
 * @param {Nets} nets @param {Triangle[]} triangles
 */
function roundCorners(nets, triangles) {
  const {faces, faceEdges, edges, points} = nets;
  /** @param {number} f @param {number} v */
  const angleAt = (f, v) => {
    const k = [0, 1, 2].find((i) => faces[3 * f + i] === v) ?? 0;
    const [a, b, c] = [0, 1, 2].map((i) => 2 * faces[3 * f + ((k + i) % 3)]);
    return Math.abs(Math.atan2(points[c + 1] - points[a + 1], points[c] - points[a]) -
      Math.atan2(points[b + 1] - points[a + 1], points[b] - points[a]));
  };
  /** @type {{at: number, around: {body: number, weight: number}[]}[]} */
  const corners = [];
  triangles.forEach(({body, tab}, i) => {
    for (let k = 0; !tab && k < 3; ++k) {
      const v = faces[3 * body + k];
      const around = [body];
      let bends = false;
      for (const f of around) {
        for (let side = 0; side < 3; ++side) {
          const edge = edges[faceEdges[3 * f + side]];
          if ((edge.a === v || edge.b === v) && (edge.kind === "F" || (edge.bent && edge.kind !== "B"))) {
            bends ||= edge.bent;
            around.push(...edge.faces.filter((g) => !around.includes(g)));
          }
        }
      }
      if (bends) {
        corners.push({at: 18 * i + 6 * k + 3, around: around.map((f) => {
          const angle = angleAt(f, v);
          return {body: 12 * f + 6, weight: Math.min(angle, 2 * Math.PI - angle)};
        })});
      }
    }
  });
  return corners;
}

export class Scene {
  /**
   * @param {HTMLCanvasElement} canvas which another one stands in for where WebGL 2 fails on it: use the scene's
   * @param {Folding} folding
   * @param {() => void} renewed the graphics card had lost everything: draw again, and set the paint
   */
  constructor(canvas, folding, renewed) {
    this.canvas = canvas;
    this.folding = folding;
    this.nets = folding.nets;
    this.camera = new Camera();
    this.simple = false;
    try {
      this.view = webglView(canvas, (view) => {
        this.view = view;
        view.setSpots(spotsOf(this.nets, this.triangles));
        renewed();
      });
    } catch {
      // A canvas that WebGL was begun on gives nothing else.
      if (!canvas.getContext("2d")) {
        this.canvas = /** @type {HTMLCanvasElement} */ (canvas.cloneNode());
        canvas.replaceWith(this.canvas);
      }
      this.view = new PainterView(this.canvas);
      this.simple = true;
    }
    this.painted = false;
    this.dark = false;
    this.through = true;
    /** Of each piece. @type {Look[]} */
    this.looks = this.nets.pieces.map(() => "plain");
    /** Joins and folds that are marked. @type {Set<number>} edges */
    this.marked = new Set();
    /** How much of the sheets is seen on the table, 0 to 1. */
    this.table = 0;
    this.triangles = trianglesOf(folding);
    this.faceTriangles = this.triangles.filter(({tab}) => !tab).length;
    this.flat = Float64Array.from(this.triangles.flatMap(({flat}) => flat.flatMap(([x, y]) => [x, y])));
    this.triangleBody = Int32Array.from(this.triangles.map(({body}) => body));
    this.round = roundCorners(this.nets, this.triangles);
    this.runs = runsOf(this.nets, this.triangles);
    this.corners = new Float32Array(18 * this.triangles.length);
    this.tints = new Uint8Array(12 * this.triangles.length);
    this.lineEdges = Int32Array.from(this.nets.edges.map((_, e) => e).filter((e) => hasLine(this.nets, e)));
    // Every edge may be marked besides.
    const most = this.lineEdges.length + this.nets.edges.length;
    this.lines = new Float32Array(6 * most);
    this.lineTints = new Uint8Array(4 * most);
    this.lineWidths = new Float32Array(most);
    this.view.setSpots(spotsOf(this.nets, this.triangles));
    this.resize();
  }

  /** The pictures of the pages, or none. @param {HTMLCanvasElement[]} pictures */
  setPaint(pictures) {
    this.view.setPaint(pictures);
    this.painted = pictures.length > 0;
  }

  resize() {
    const box = this.canvas.getBoundingClientRect();
    const ratio = Math.min(2, globalThis.devicePixelRatio || 1);
    this.camera.width = Math.max(1, box.width);
    this.camera.height = Math.max(1, box.height);
    const [width, height] = [Math.max(1, Math.round(box.width * ratio)), Math.max(1, Math.round(box.height * ratio))];
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
  }

  /** Takes places from the folding. */
  place() {
    const {flat, corners, triangleBody} = this;
    const {world} = this.folding;
    for (let i = 0; i < triangleBody.length; ++i) {
      const b = 12 * triangleBody[i];
      for (let k = 0; k < 3; ++k) {
        const x = flat[6 * i + 2 * k];
        const y = flat[6 * i + 2 * k + 1];
        const c = 18 * i + 6 * k;
        for (let row = 0; row < 3; ++row) {
          corners[c + row] = world[b + row] * x + world[b + 3 + row] * y + world[b + 9 + row];
          corners[c + 3 + row] = world[b + 6 + row];
        }
      }
    }
    for (const {at, around} of this.round) {
      const normal = [0, 1, 2].map((row) => around.reduce((sum, {body, weight}) => sum + weight * world[body + row], 0));
      const length = Math.hypot(...normal);
      normal.forEach((value, row) => {
        corners[at + row] = value / length;
      });
    }
  }

  /** What these pieces take up now. @param {(piece: number) => boolean} wanted @returns {Room} */
  roomOf(wanted) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    const each = (/** @type {(x: number, y: number, z: number) => void} */ visit) => {
      for (let i = 0; i < this.faceTriangles; ++i) {
        if (wanted(this.triangles[i].piece)) {
          for (let c = 18 * i; c < 18 * i + 18; c += 6) {
            visit(this.corners[c], this.corners[c + 1], this.corners[c + 2]);
          }
        }
      }
    };
    each((x, y, z) => {
      low[0] = Math.min(low[0], x);
      low[1] = Math.min(low[1], y);
      low[2] = Math.min(low[2], z);
      high[0] = Math.max(high[0], x);
      high[1] = Math.max(high[1], y);
      high[2] = Math.max(high[2], z);
    });
    if (low[0] > high[0]) {
      return {x: 0, z: 0, low: 0, high: 1, radius: 1, width: 2, depth: 2};
    }
    const x = 0.5 * (low[0] + high[0]);
    const z = 0.5 * (low[2] + high[2]);
    let radius = 0;
    each((px, _, pz) => {
      radius = Math.max(radius, Math.hypot(px - x, pz - z));
    });
    return {x, z, low: low[1], high: high[1], radius: Math.max(radius, 0.01), width: high[0] - low[0],
      depth: high[2] - low[2]};
  }

  /** @param {Room} a @param {Room} b @param {number} t */
  lookAt(a, b = a, t = 0) {
    this.camera.room = t === 0 ? a : roomBetween(a, b, t);
  }

  #tint() {
    const {nets, tints, triangles} = this;
    const ground = this.dark ? [38, 40, 44] : [238, 239, 241];
    let ghosts = false;
    /** @type {number[][]} */
    const colours = nets.pieces.map((piece, p) => {
      const look = this.looks[p];
      const own = this.painted ? [250, 249, 246] : piece.colour;
      const shown = look === "faded" ? own.map((value, k) => 0.3 * value + 0.7 * ground[k]) : own;
      return [...shown, look === "gone" ? 0 : look === "ghost" ? 36 : 255];
    });
    for (let i = 0; i < triangles.length; ++i) {
      const {piece, tab} = triangles[i];
      const colour = colours[piece];
      let opacity = colour[3];
      if (tab) {
        opacity = Math.round(0.55 * opacity);
      }
      ghosts ||= opacity > 0 && opacity < 253;
      for (let c = 12 * i; c < 12 * i + 12; c += 4) {
        tints[c] = tab ? 0.5 * (colour[0] + 235) : colour[0];
        tints[c + 1] = tab ? 0.5 * (colour[1] + 235) : colour[1];
        tints[c + 2] = tab ? 0.5 * (colour[2] + 235) : colour[2];
        tints[c + 3] = opacity;
      }
    }
    return ghosts;
  }

  /** @param {number} e @returns {number[][]} its ends on the stage */
  edgeEnds(e) {
    const {points, edges} = this.nets;
    const edge = edges[e];
    const m = this.folding.world;
    const b = 12 * edge.faces[0];
    return [edge.a, edge.b].map((v) => {
      const x = points[2 * v];
      const y = points[2 * v + 1];
      return [0, 1, 2].map((row) => m[b + row] * x + m[b + 3 + row] * y + m[b + 9 + row]);
    });
  }

  /** @param {number} i @param {number} e @param {number[]} colour @param {number} opacity @param {number} width */
  #line(i, e, colour, opacity, width) {
    const {points, edges} = this.nets;
    const edge = edges[e];
    const m = this.folding.world;
    const b = 12 * edge.faces[0];
    for (let end = 0; end < 2; ++end) {
      const v = 2 * (end === 0 ? edge.a : edge.b);
      for (let row = 0; row < 3; ++row) {
        this.lines[6 * i + 3 * end + row] = m[b + row] * points[v] + m[b + 3 + row] * points[v + 1] + m[b + 9 + row];
      }
    }
    this.lineTints[4 * i] = colour[0];
    this.lineTints[4 * i + 1] = colour[1];
    this.lineTints[4 * i + 2] = colour[2];
    this.lineTints[4 * i + 3] = opacity;
    this.lineWidths[i] = width;
  }

  draw() {
    const {nets, camera, folding} = this;
    camera.update();
    const ghosts = this.#tint();
    let count = 0;
    for (const e of this.lineEdges) {
      const edge = nets.edges[e];
      const look = this.looks[edge.piece];
      if (look === "gone" || (look === "ghost" && edge.kind !== "B")) {
        continue;
      }
      const opacity = look === "ghost" ? 40 : (edge.kind === "B" ? 150 : 80) * (look === "faded" ? 0.35 : 1);
      this.#line(count++, e, [30, 34, 44], opacity, edge.kind === "B" ? 1.3 : 0.9);
    }
    const plain = count;
    if (this.marked.size > 0) {
      for (const e of this.marked) {
        if (this.looks[nets.edges[e].piece] !== "gone") {
          this.#line(count++, e, mark, 255, 3.6);
        }
      }
    }
    /** @type {Picture["sheets"]} */
    const sheets = [];
    if (this.table > 0) {
      nets.pages.forEach((page, p) => {
        const [x, z] = folding.sheetCorner(p);
        const y = -0.001 * camera.size;
        sheets.push({opacity: (this.dark ? 0.1 : 0.9) * this.table, corners: [[x, y, z], [x + page.width, y, z],
          [x, y, z + page.height], [x + page.width, y, z + page.height]]});
      });
    }
    this.view.draw({
      camera, corners: this.corners, tints: this.tints, runs: this.runs, painted: this.painted, ghosts,
      placed: (i) => folding.placed[this.triangles[i].piece] === 1, lines: this.lines,
      lineTints: this.lineTints, lineWidths: this.lineWidths, lineCount: count,
      markCount: this.through || this.simple ? count - plain : 0, sheets,
      paper: this.dark ? [0.7, 0.7, 0.69] : [0.88, 0.87, 0.85], shade: this.dark ? 0.5 : 0.22,
    });
  }

  /**
   * What is seen at a pixel.
   * @param {number} x
   * @param {number} y
   * @param {number} reach pixels from an edge within which it is meant
   * @returns {Spot | null}
   */
  pick(x, y, reach) {
    const {corners, camera, nets} = this;
    let found = -1;
    let nearest = Infinity;
    for (let i = 0; i < this.faceTriangles; ++i) {
      const look = this.looks[this.triangles[i].piece];
      if (look === "gone" || look === "ghost") {
        continue;
      }
      const c = 18 * i;
      const p = camera.project(corners[c], corners[c + 1], corners[c + 2]);
      const q = camera.project(corners[c + 6], corners[c + 7], corners[c + 8]);
      const r = camera.project(corners[c + 12], corners[c + 13], corners[c + 14]);
      const area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
      const a = ((q[0] - x) * (r[1] - y) - (q[1] - y) * (r[0] - x)) / area;
      const b = ((r[0] - x) * (p[1] - y) - (r[1] - y) * (p[0] - x)) / area;
      if (a >= 0 && b >= 0 && a + b <= 1) {
        const far = 1 / (a / p[2] + b / q[2] + (1 - a - b) / r[2]);
        if (far < nearest) {
          nearest = far;
          found = i;
        }
      }
    }
    if (found < 0) {
      return null;
    }
    const face = this.triangles[found].body;
    let edge = -1;
    let best = reach;
    for (let k = 0; k < 3; ++k) {
      const e = nets.faceEdges[3 * face + k];
      if (hasLine(nets, e)) {
        const [p, q] = this.edgeEnds(e).map(([px, py, pz]) => camera.project(px, py, pz));
        const away = segmentDistance(x, y, p, q);
        if (away < best) {
          best = away;
          edge = e;
        }
      }
    }
    return {piece: nets.facePiece[face], edge};
  }
}

/** Of a point from a segment. @param {number} x @param {number} y @param {ArrayLike<number>} p @param {ArrayLike<number>} q */
export function segmentDistance(x, y, p, q) {
  const dx = q[0] - p[0];
  const dy = q[1] - p[1];
  const length = dx * dx + dy * dy;
  const t = length > 0 ? Math.min(1, Math.max(0, ((x - p[0]) * dx + (y - p[1]) * dy) / length)) : 0;
  return Math.hypot(x - p[0] - t * dx, y - p[1] - t * dy);
}

