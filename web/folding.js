// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of folds, and where every face and tab is at a moment: flat on its sheet, folded in the order of the file,
// flown to its place. Rigid motions are twelve numbers: where x, y and z point, and where the origin goes.

/** @typedef {import("./nets.js").Nets} Nets */

/**
 * @typedef {object} Hinge
 * @property {number} body that turns: a face, or the number of faces plus a tab
 * @property {number} parent body
 * @property {number} x of the axis' beginning, in the plane of all nets
 * @property {number} y
 * @property {number} dx direction of the axis; the parent lies to its left
 * @property {number} dy
 * @property {number} angle when folded, valley positive
 * @property {number} slot when it is folded: the number of its group, or -1 for all the time
 */

/** The share of the slider in which pieces are folded; then they fly. */
export const foldShare = 0.6;

/** Slow at both ends. @param {number} t */
export function smooth(t) {
  const s = Math.min(1, Math.max(0, t));
  return s * s * (3 - 2 * s);
}

/** c = a b. @param {ArrayLike<number>} a @param {number} i @param {ArrayLike<number>} b @param {number} j
 * @param {Float64Array} c @param {number} k */
function compose(a, i, b, j, c, k) {
  for (let column = 0; column < 4; ++column) {
    const x = b[j + 3 * column];
    const y = b[j + 3 * column + 1];
    const z = b[j + 3 * column + 2];
    for (let row = 0; row < 3; ++row) {
      c[k + 3 * column + row] =
        a[i + row] * x + a[i + 3 + row] * y + a[i + 6 + row] * z + (column === 3 ? a[i + 9 + row] : 0);
    }
  }
}

/** @param {ArrayLike<number>} m @param {number} i @param {number} x @param {number} y @param {number} z */
export function moved(m, i, x, y, z) {
  return [m[i] * x + m[i + 3] * y + m[i + 6] * z + m[i + 9], m[i + 1] * x + m[i + 4] * y + m[i + 7] * z + m[i + 10],
    m[i + 2] * x + m[i + 5] * y + m[i + 8] * z + m[i + 11]];
}

/** Orthonormal axes of a triangle: along its first side, in its plane, its normal. @param {number[][]} t */
function axesOf([p, q, r]) {
  const unit = (/** @type {number[]} */ v) => v.map((value) => value / Math.hypot(...v));
  const cross = (/** @type {number[]} */ a, /** @type {number[]} */ b) =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const x = unit([q[0] - p[0], q[1] - p[1], q[2] - p[2]]);
  const z = unit(cross(x, [r[0] - p[0], r[1] - p[1], r[2] - p[2]]));
  return [x, cross(z, x), z];
}

/** The unit quaternion (x, y, z, w) of a rotation (Shepperd 1978). @param {ArrayLike<number>} m columns */
function quaternionOf(m) {
  const trace = m[0] + m[4] + m[8];
  const q = [m[5] - m[7], m[6] - m[2], m[1] - m[3], 1 + trace];
  let best = trace;
  let k = 3;
  for (let i = 0; i < 3; ++i) {
    if (m[4 * i] > best) {
      best = m[4 * i];
      k = i;
    }
  }
  if (k < 3) {
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    q[3] = [m[5] - m[7], m[6] - m[2], m[1] - m[3]][k];
    q[k] = 1 + m[4 * k] - m[4 * i] - m[4 * j];
    q[i] = m[3 * k + i] + m[3 * i + k];
    q[j] = m[3 * k + j] + m[3 * j + k];
  }
  const length = Math.hypot(...q);
  return q.map((value) => value / length);
}

/** The shorter way from one rotation to another. @param {number[]} p @param {number[]} q @param {number} t */
function between(p, q, t) {
  let cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
  const sign = cosine < 0 ? -1 : 1;
  cosine = Math.min(1, cosine * sign);
  const angle = Math.acos(cosine);
  const [a, b] = angle < 1e-6 ? [1 - t, t] : [Math.sin((1 - t) * angle) / Math.sin(angle), Math.sin(t * angle) / Math.sin(angle)];
  return p.map((value, i) => a * value + b * sign * q[i]);
}

/** @param {number[]} q */
function rotationOf([x, y, z, w]) {
  return [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 2 * (x * y - z * w), 1 - 2 * (x * x + z * z),
    2 * (y * z + x * w), 2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)];
}

/** The way on which each piece of a build lies at one moment. @typedef {{fold: number, fly: number}} Progress */

export class Folding {
  /** @param {Nets} nets */
  constructor(nets) {
    this.nets = nets;
    this.faceCount = nets.facePiece.length;
    this.bodyCount = this.faceCount + nets.tabs.length;
    /** Where each body is in the frame of its piece's root face. */
    this.local = new Float64Array(12 * this.bodyCount);
    /** Where each body is on the stage: x to the right, y up, z towards whoever stands before it. */
    this.world = new Float64Array(12 * this.bodyCount);
    /** The model on the stage: its middle above the origin, its lowest point on the ground. */
    this.stagePoints = new Float64Array(nets.modelPoints.length);
    this.modelSize = this.#stand();
    /** 1 for each piece that lies in its place in the model. */
    this.placed = new Uint8Array(nets.pieces.length);
    /** By which each tab is folded. */
    this.tabAngles = nets.tabs.map((_, t) => this.#tabAngle(t));
    /** @type {Hinge[][]} */
    this.hinges = nets.pieces.map(() => []);
    this.roots = nets.pieces.map((piece) => this.#plant(piece.index));
    /** @type {number[][]} */
    this.bodies = nets.pieces.map((piece) => [...piece.faces]);
    nets.tabs.forEach((tab, t) => this.bodies[tab.piece].push(this.faceCount + t));
    this.slots = nets.pieces.map((piece) => Math.max(1, piece.steps.length));
    /** Columns of sheets on the table. */
    this.columns = Math.min(nets.pages.length, Math.ceil(Math.sqrt(1.4 * nets.pages.length)));
    this.places = nets.pieces.map((piece) => this.#placeOf(piece.index));
    this.onTable = nets.pieces.map((piece) => this.#tablePlace(piece.page));
    this.turns = nets.pieces.map((piece) => [quaternionOf(this.onTable[piece.index]), quaternionOf(this.places[piece.index])]);
    /** Between corners and the model's, when all is folded, mm. */
    this.refoldError = this.#error();
  }

  /** The grid of sheets: how much room one takes, and how many rows there are. */
  get grid() {
    const page = this.nets.pages[0];
    const gap = 0.12 * page.width;
    return {width: page.width + gap, height: page.height + gap, columns: this.columns,
      rows: Math.ceil(this.nets.pages.length / this.columns), gap};
  }

  /** Left upper corner of a sheet on the table. @param {number} page */
  sheetCorner(page) {
    const grid = this.grid;
    return [((page % grid.columns) - 0.5 * grid.columns) * grid.width + 0.5 * grid.gap,
      (Math.floor(page / grid.columns) - 0.5 * grid.rows) * grid.height + 0.5 * grid.gap];
  }

  /** Puts the model upright. Returns its size. */
  #stand() {
    const {modelPoints, up} = this.nets;
    const axes = {
      y: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], z: [[1, 0, 0], [0, 0, 1], [0, -1, 0]], x: [[0, -1, 0], [1, 0, 0], [0, 0, 1]],
    }[up];
    const points = this.stagePoints;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < points.length; ++i) {
      const axis = axes[i % 3];
      const v = i - (i % 3);
      points[i] = axis[0] * modelPoints[v] + axis[1] * modelPoints[v + 1] + axis[2] * modelPoints[v + 2];
      low[i % 3] = Math.min(low[i % 3], points[i]);
      high[i % 3] = Math.max(high[i % 3], points[i]);
    }
    const shift = [0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2])];
    points.forEach((value, i) => {
      points[i] = value - shift[i % 3];
    });
    return high.map((value, k) => value - low[k]);
  }

  /** @param {number} f @returns {number[][]} corners in the plane of all nets */
  flatCorners(f) {
    const {points, faces} = this.nets;
    return [0, 1, 2].map((k) => [points[2 * faces[3 * f + k]], points[2 * faces[3 * f + k] + 1], 0]);
  }

  /** @param {number} f @returns {number[][]} corners on the stage when all is built */
  builtCorners(f) {
    return [0, 1, 2].map((k) => {
      const v = 3 * this.nets.modelFaces[3 * f + k];
      return [this.stagePoints[v], this.stagePoints[v + 1], this.stagePoints[v + 2]];
    });
  }

  /** Finds the tree of folds of a piece, from its largest face. Returns that face. @param {number} p */
  #plant(p) {
    const {nets} = this;
    const piece = nets.pieces[p];
    const area = (/** @type {number} */ f) => {
      const [a, b, c] = this.flatCorners(f);
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    const root = piece.faces.reduce((best, f) => (area(f) > area(best) ? f : best), piece.faces[0]);
    /** @type {Map<number, number>} */
    const slotOf = new Map();
    piece.steps.forEach((step, k) => step.forEach((e) => slotOf.set(e, k)));
    const seen = new Set([root]);
    const queue = [root];
    for (let i = 0; i < queue.length; ++i) {
      const f = queue[i];
      for (let k = 0; k < 3; ++k) {
        const e = nets.faceEdges[3 * f + k];
        const edge = nets.edges[e];
        const g = edge.faces[0] === f ? edge.faces[1] : edge.faces[0];
        if (edge.kind !== "B" && g !== undefined && !seen.has(g)) {
          seen.add(g);
          queue.push(g);
          // All bends of a piece are one movement of the hand.
          this.hinges[p].push(this.#hinge(g, f, k, edge.angle, edge.bent ? -1 : slotOf.get(e) ?? -1));
        }
      }
    }
    nets.tabs.forEach((tab, t) => {
      if (tab.piece === p) {
        const k = [0, 1, 2].find((side) => nets.faceEdges[3 * tab.face + side] === tab.edge) ?? 0;
        this.hinges[p].push(this.#hinge(this.faceCount + t, tab.face, k, this.tabAngles[t], piece.steps.length));
      }
    });
    return root;
  }

  /** @param {number} body @param {number} parent @param {number} side of the parent @param {number} angle
   * @param {number} slot @returns {Hinge} */
  #hinge(body, parent, side, angle, slot) {
    const {points, faces} = this.nets;
    const a = 2 * faces[3 * parent + side];
    const b = 2 * faces[3 * parent + (side + 1) % 3];
    const length = Math.hypot(points[b] - points[a], points[b + 1] - points[a + 1]);
    return {body, parent, x: points[a], y: points[a + 1], dx: (points[b] - points[a]) / length,
      dy: (points[b + 1] - points[a + 1]) / length, angle, slot};
  }

  /** A tab lies behind the face that it is glued to. @param {number} t */
  #tabAngle(t) {
    const tab = this.nets.tabs[t];
    const join = this.nets.joins[tab.join];
    if (!join) {
      return 0;
    }
    const other = join.edges[0] === tab.edge ? join.edges[1] : join.edges[0];
    const own = this.builtCorners(tab.face);
    const n = axesOf(own)[2];
    const m = axesOf(this.builtCorners(this.nets.edges[other].faces[0]))[2];
    const k = [0, 1, 2].find((side) => this.nets.faceEdges[3 * tab.face + side] === tab.edge) ?? 0;
    const along = own[(k + 1) % 3].map((value, i) => value - own[k][i]);
    const length = Math.hypot(...along);
    const turn = [n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2], n[0] * m[1] - n[1] * m[0]];
    // It lies under the other face, and not in it.
    return -0.05 - Math.atan2((turn[0] * along[0] + turn[1] * along[1] + turn[2] * along[2]) / length,
      n[0] * m[0] + n[1] * m[1] + n[2] * m[2]);
  }

  /** The motion from the frame of a piece to its place in the model. @param {number} p */
  #placeOf(p) {
    const root = this.roots[p];
    const flat = this.flatCorners(root);
    const built = this.builtCorners(root);
    const from = axesOf(flat);
    const to = axesOf(built);
    const m = new Float64Array(12);
    for (let column = 0; column < 3; ++column) {
      for (let row = 0; row < 3; ++row) {
        m[3 * column + row] = to[0][row] * from[0][column] + to[1][row] * from[1][column] + to[2][row] * from[2][column];
      }
    }
    const at = moved(m, 0, flat[0][0], flat[0][1], 0);
    m.set([built[0][0] - at[0], built[0][1] - at[1], built[0][2] - at[2]], 9);
    return m;
  }

  /** The motion from the plane of all nets to where a page lies on the table. @param {number} page */
  #tablePlace(page) {
    const {x, y, height} = this.nets.pages[page];
    const [left, far] = this.sheetCorner(page);
    return Float64Array.from([1, 0, 0, 0, 0, -1, 0, 1, 0, left - x, 0, far + height + y]);
  }

  /**
   * Folds a piece in its own frame: all hinges up to a share of the way, each in its time.
   * @param {number} p
   * @param {number} share 0 to 1
   */
  fold(p, share) {
    const {local} = this;
    const root = 12 * this.roots[p];
    local.fill(0, root, root + 12);
    local[root] = local[root + 4] = local[root + 8] = 1;
    // The tabs have the last slot for themselves.
    const slots = this.slots[p] + 1;
    const now = share * slots;
    const h = new Float64Array(12);
    for (const hinge of this.hinges[p]) {
      const done = hinge.slot < 0 ? smooth(share) : smooth(now - hinge.slot);
      const angle = -hinge.angle * done;
      const i = 12 * hinge.parent;
      const j = 12 * hinge.body;
      if (angle === 0) {
        local.copyWithin(j, i, i + 12);
        continue;
      }
      const {x, y, dx, dy} = hinge;
      const c = Math.cos(angle);
      const s = Math.sin(angle);
      const k = 1 - c;
      h[0] = c + dx * dx * k;
      h[1] = dx * dy * k;
      h[2] = -dy * s;
      h[3] = dx * dy * k;
      h[4] = c + dy * dy * k;
      h[5] = dx * s;
      h[6] = dy * s;
      h[7] = -dx * s;
      h[8] = c;
      h[9] = x - h[0] * x - h[3] * y;
      h[10] = y - h[1] * x - h[4] * y;
      h[11] = -h[2] * x - h[5] * y;
      compose(local, i, h, 0, local, j);
    }
  }

  /** The middle of a piece as it is folded now, in its own frame. @param {number} p */
  #middle(p) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const f of this.nets.pieces[p].faces) {
      for (const [x, y] of this.flatCorners(f)) {
        moved(this.local, 12 * f, x, y, 0).forEach((value, k) => {
          low[k] = Math.min(low[k], value);
          high[k] = Math.max(high[k], value);
        });
      }
    }
    return {middle: low.map((value, k) => 0.5 * (value + high[k])), low: low[2]};
  }

  /**
   * Puts a piece on the stage: folded by a share, and on a share of its way from the table to its place.
   * @param {number} p
   * @param {Progress} progress
   * @param {number[]} [from] where its middle begins to fly, instead of its place on its sheet
   */
  put(p, progress, from) {
    this.fold(p, progress.fold);
    this.placed[p] = progress.fly < 1 ? 0 : 1;
    const {world, local} = this;
    let motion = this.places[p];
    if (progress.fly < 1) {
      const {middle, low} = this.#middle(p);
      const begin = moved(this.onTable[p], 0, middle[0], middle[1], middle[2]);
      // A piece stands on the table whichever way it is folded.
      begin[1] -= low;
      const end = moved(this.places[p], 0, middle[0], middle[1], middle[2]);
      const w = smooth(progress.fly);
      const start = from ?? begin;
      const arc = from ? 0 : 0.35 * Math.hypot(end[0] - start[0], end[2] - start[2]) * w * (1 - w);
      const at = start.map((value, k) => value + w * (end[k] - value) + (k === 1 ? arc : 0));
      const rotation = w === 0 ? Array.from(this.onTable[p].subarray(0, 9))
        : rotationOf(between(this.turns[p][0], this.turns[p][1], w));
      motion = Float64Array.from([...rotation, 0, 0, 0]);
      const turned = moved(motion, 0, middle[0], middle[1], middle[2]);
      motion.set([at[0] - turned[0], at[1] - turned[1], at[2] - turned[2]], 9);
    }
    for (const body of this.bodies[p]) {
      compose(motion, 0, local, 12 * body, world, 12 * body);
    }
  }

  /** How far a piece is when the slider is at t. @param {number} p @param {number} t @returns {Progress} */
  progressAt(p, t) {
    const steps = this.nets.steps.length;
    const begin = foldShare + (1 - foldShare) * 0.55 * (steps > 1 ? this.nets.pieces[p].step / (steps - 1) : 0);
    return {fold: Math.min(1, t / foldShare), fly: Math.min(1, Math.max(0, (t - begin) / ((1 - foldShare) * 0.45)))};
  }

  /** Puts all pieces where they are when the slider is at t. @param {number} t */
  putAll(t) {
    for (const piece of this.nets.pieces) {
      this.put(piece.index, this.progressAt(piece.index, t));
    }
  }

  #error() {
    this.putAll(1);
    let worst = 0;
    for (let f = 0; f < this.faceCount; ++f) {
      const flat = this.flatCorners(f);
      this.builtCorners(f).forEach((corner, k) => {
        const at = moved(this.world, 12 * f, flat[k][0], flat[k][1], 0);
        worst = Math.max(worst, Math.hypot(at[0] - corner[0], at[1] - corner[1], at[2] - corner[2]));
      });
    }
    return worst;
  }
}
