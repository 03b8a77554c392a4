// SPDX-License-Identifier: GPL-3.0-or-later
// Steps by hand name edges and faces of the surface that they were done on. After a change of the size or the faces the
// surface is another: here the names are carried over to what lies at the same place of the model.

/**
 * @typedef {object} Surface
 * @property {Float64Array} points three numbers each, mm
 * @property {Uint32Array} faces three points each
 */

/** A point may lie this share of its edge away from where it was. */
const nearEdge = 0.25;
/** A face's middle may lie this share of the model away from where it was. */
const nearFace = 0.03;

/** The model of a FOLD file, as its steps name it. @param {string} fold @returns {Surface} */
export function surfaceOf(fold) {
  const {file_frames: [{vertices_coords: points, faces_vertices: faces}]} = JSON.parse(fold);
  return {points: Float64Array.from(points.flat()), faces: Uint32Array.from(faces.flat())};
}

/** Whether all names mean the same on both. @param {Surface} a @param {Surface} b */
export function isSameSurface(a, b) {
  return a.points.length === b.points.length && a.faces.length === b.faces.length && a.faces.every((v, i) => v === b.faces[i]) &&
    new Carrier(a, b).staysInPlace();
}

/** @param {number[]} a @param {number[]} b */
const minus = (a, b) => a.map((value, k) => value - b[k]);
/** @param {number[]} a @param {number[]} b */
const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
/** @param {number[]} a @param {number[]} b */
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
/** @param {number[]} a */
const unit = (a) => a.map((value) => value / (Math.hypot(...a) || 1));

/** A surface in a box of size 1, whatever its size. */
class Scaled {
  /** @param {Surface} surface */
  constructor({points, faces}) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    points.forEach((value, i) => {
      low[i % 3] = Math.min(low[i % 3], value);
      high[i % 3] = Math.max(high[i % 3], value);
    });
    this.size = Math.max(...minus(high, low)) || 1;
    this.low = low;
    this.points = points;
    this.faces = faces;
  }

  /** @param {number} v */
  point(v) {
    return [0, 1, 2].map((k) => (this.points[3 * v + k] - this.low[k]) / this.size);
  }

  /** @param {number} f */
  corners(f) {
    return [0, 1, 2].map((k) => this.point(this.faces[3 * f + k]));
  }

  /** @param {number} f */
  middle(f) {
    const corners = this.corners(f);
    return [0, 1, 2].map((k) => (corners[0][k] + corners[1][k] + corners[2][k]) / 3);
  }

  /** @param {number} f */
  normal(f) {
    const [a, b, c] = this.corners(f);
    return unit(cross(minus(b, a), minus(c, a)));
  }

  /** The nearest of so many things to a place. @param {number} count @param {(i: number) => number[]} at @param {number[]} wanted
   * @param {(i: number) => boolean} [fits] */
  static nearest(count, at, wanted, fits = () => true) {
    let best = {index: -1, distance: Infinity};
    for (let i = 0; i < count; ++i) {
      const distance = Math.hypot(...minus(at(i), wanted));
      if (distance < best.distance && fits(i)) {
        best = {index: i, distance};
      }
    }
    return best;
  }
}

export class Carrier {
  /** @param {Surface} from @param {Surface} to */
  constructor(from, to) {
    this.from = new Scaled(from);
    this.to = new Scaled(to);
    /** @type {Set<string> | null} */
    this.sides = null;
  }

  /** Whether each point is where it was. */
  staysInPlace() {
    for (let v = 0; 3 * v < this.from.points.length; ++v) {
      if (Math.hypot(...minus(this.from.point(v), this.to.point(v))) > 1e-6) {
        return false;
      }
    }
    return true;
  }

  /** The step on the other surface; none where what it names isn't there. @param {string} line @returns {string | null} */
  line(line) {
    const edits = line.split("; ").map((edit) => this.#edit(edit.split(" ")));
    return edits.some((edit) => edit === null) ? null : edits.join("; ");
  }

  /** @param {string[]} words @returns {string | null} */
  #edit([verb, ...values]) {
    const numbers = values.map(Number);
    if (["cut", "join", "tab-from", "no-tab", "tab-shape", "both-tabs"].includes(verb)) {
      const edge = this.#edge(numbers.slice(0, 2), verb.startsWith("tab-"));
      return edge && [verb, ...edge, ...values.slice(2)].join(" ");
    }
    const faces = verb === "pack" ? numbers : numbers.slice(0, 1);
    const there = faces.map((f) => this.#face(f));
    if (there.includes(-1)) {
      return null;
    }
    return verb === "place" ? this.#place(numbers, there[0]) : [verb, ...there, ...(verb === "retry" ? values.slice(1) : [])].join(" ");
  }

  /** @param {number[]} ends @param {boolean} directed @returns {number[] | null} */
  #edge([a, b], directed) {
    const ends = [a, b].map((v) => this.from.point(v));
    const reach = nearEdge * Math.hypot(...minus(ends[0], ends[1]));
    const [p, q] = ends.map((end) => Scaled.nearest(this.to.points.length / 3, (v) => this.to.point(v), end)).map(({index, distance}) =>
      (distance <= reach ? index : -1));
    this.sides ??= new Set([...this.to.faces.keys()].map((i) => `${this.to.faces[i]} ${this.to.faces[i % 3 === 2 ? i - 2 : i + 1]}`));
    return this.sides.has(`${p} ${q}`) || (!directed && this.sides.has(`${q} ${p}`)) ? [p, q] : null;
  }

  /** @param {number} f @returns {number} */
  #face(f) {
    const normal = this.from.normal(f);
    const {index, distance} = Scaled.nearest(this.to.faces.length / 3, (i) => this.to.middle(i), this.from.middle(f),
      (i) => dot(this.to.normal(i), normal) > 0.8);
    return distance <= nearFace ? index : -1;
  }

  /** The piece lies as it lay, though another face tells where. @param {number[]} values @param {number} there */
  #place([f, page, x, y, degrees], there) {
    const [a, b] = this.from.corners(f);
    const along = unit(minus(b, a));
    const up = cross(this.from.normal(f), along);
    const flat = (/** @type {number[]} */ v) => [dot(v, along), dot(v, up)];
    const [c, d] = this.to.corners(there);
    const [dx, dy] = flat(minus(c, a)).map((value) => value * this.to.size);
    const [sx, sy] = flat(minus(d, c));
    const angle = (degrees * Math.PI) / 180;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    return ["place", there, page, x + cos * dx - sin * dy, y + sin * dx + cos * dy, degrees + (Math.atan2(sy, sx) * 180) / Math.PI].join(" ");
  }
}
