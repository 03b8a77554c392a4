// SPDX-License-Identifier: GPL-3.0-or-later
// From where the stage is looked at: an eye that goes around what is to be seen and keeps all of it in view.

/**
 * What has to be in view: an upright cylinder, which looks the same from all sides.
 * And a box along the axes, for a table that is looked at from the front.
 * @typedef {{x: number, z: number, low: number, high: number, radius: number, width: number, depth: number}} Room
 */

/** Half the angle of view, up and down, radians. */
const halfView = 0.24;
const highest = 1.5;
const circle = Array.from({length: 24}, (_, i) => [Math.cos((i * Math.PI) / 12), Math.sin((i * Math.PI) / 12)]);
/** The elevation from which sheets on the table are seen. */
const tableElevation = 1.05;

/** @param {Room} a @param {Room} b @param {number} t @returns {Room} */
export function roomBetween(a, b, t) {
  const mix = (/** @type {number} */ p, /** @type {number} */ q) => p + t * (q - p);
  return {x: mix(a.x, b.x), z: mix(a.z, b.z), low: mix(a.low, b.low), high: mix(a.high, b.high),
    radius: mix(a.radius, b.radius), width: mix(a.width, b.width), depth: mix(a.depth, b.depth)};
}

export class Camera {
  constructor() {
    this.azimuth = -0.5;
    this.elevation = 0.32;
    /** How much the view bends down to the table, 0 to 1. */
    this.tilt = 0;
    this.zoom = 1;
    /** Of the middle, in heights of the picture from the middle to its border. */
    this.pan = [0, 0];
    this.width = 1;
    this.height = 1;
    /** @type {Room} */
    this.room = {x: 0, z: 0, low: 0, high: 1, radius: 1, width: 1, depth: 1};
    this.right = [1, 0, 0];
    this.up = [0, 1, 0];
    this.toward = [0, 0, 1];
    this.eye = [0, 0, 1];
    this.distance = 1;
    this.size = 1;
    /** World to clip space, columns. */
    this.matrix = new Float32Array(16);
  }

  home() {
    this.zoom = 1;
    this.pan = [0, 0];
  }

  /** From where it looks now, with its bend down to the table. */
  get direction() {
    const {tilt} = this;
    return {azimuth: (1 - tilt) * Math.atan2(Math.sin(this.azimuth), Math.cos(this.azimuth)),
      elevation: this.elevation + tilt * (Math.max(this.elevation, tableElevation) - this.elevation)};
  }

  /** Makes that a direction of its own. */
  release() {
    const {azimuth, elevation} = this.direction;
    this.azimuth = azimuth;
    this.elevation = elevation;
    this.tilt = 0;
  }

  /** @param {number} dx pixels @param {number} dy */
  turn(dx, dy) {
    this.azimuth -= 0.008 * dx;
    this.elevation = Math.min(highest, Math.max(-highest, this.elevation + 0.008 * dy));
  }

  /** @param {number} dx pixels @param {number} dy */
  move(dx, dy) {
    this.pan[0] -= (2 * dx) / this.height / this.zoom;
    this.pan[1] += (2 * dy) / this.height / this.zoom;
  }

  /** Zooms so that what is at this pixel stays there. @param {number} factor @param {number} x @param {number} y */
  zoomAt(factor, x, y) {
    const zoom = Math.min(40, Math.max(0.4, this.zoom * factor));
    const shift = 1 / this.zoom - 1 / zoom;
    this.pan[0] += ((2 * x - this.width) / this.height) * shift;
    this.pan[1] += ((this.height - 2 * y) / this.height) * shift;
    this.zoom = zoom;
  }

  /** Places the eye. Call after every change. */
  update() {
    const {room} = this;
    const {azimuth, elevation} = this.direction;
    const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
    this.right = [ca, 0, -sa];
    this.toward = [sa * ce, se, ca * ce];
    this.up = [-sa * se, ce, -ca * se];
    const middle = 0.5 * (room.low + room.high);
    const ty = Math.tan(halfView);
    const tx = (ty * this.width) / this.height;
    const away = (/** @type {number[][]} */ ring) => {
      let most = 0;
      for (const [x, z] of ring) {
        for (const y of [room.low - middle, room.high - middle]) {
          const near = dot([x, y, z], this.toward);
          most = Math.max(most, Math.abs(dot([x, y, z], this.right)) / tx + near, Math.abs(dot([x, y, z], this.up)) / ty + near);
        }
      }
      return most;
    };
    const round = away(circle.map(([x, z]) => [room.radius * x, room.radius * z]));
    const square = away([[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([x, z]) => [0.5 * room.width * x, 0.5 * room.depth * z]));
    // Each of the two keeps all in view, so what lies between them does.
    const fit = round + this.tilt * (square - round);
    this.distance = (1.08 * fit) / this.zoom;
    const unit = 1.08 * fit * ty;
    const target = [room.x, middle, room.z].map(
      (value, k) => value + unit * (this.pan[0] * this.right[k] + this.pan[1] * this.up[k]));
    this.eye = target.map((value, k) => value + this.distance * this.toward[k]);
    this.size = Math.hypot(room.radius, 0.5 * (room.high - room.low));
    const reach = Math.hypot(...this.eye.map((value, k) => value - [room.x, middle, room.z][k]));
    const far = reach + 6 * this.size;
    const near = Math.max(0.02 * this.distance, reach - 2.5 * this.size);
    const {matrix: m, right: r, up: u, toward: t, eye: e} = this;
    const depth = (far + near) / (near - far);
    for (let k = 0; k < 3; ++k) {
      m[4 * k] = r[k] / tx;
      m[4 * k + 1] = u[k] / ty;
      m[4 * k + 2] = depth * t[k];
      m[4 * k + 3] = -t[k];
    }
    m[12] = -dot(r, e) / tx;
    m[13] = -dot(u, e) / ty;
    m[14] = -depth * dot(t, e) + (2 * far * near) / (near - far);
    m[15] = dot(t, e);
  }

  /**
   * Where a point is seen: pixels from the left and the top, and how far it is.
   * @param {number} x
   * @param {number} y
   * @param {number} z
   */
  project(x, y, z) {
    const {matrix: m} = this;
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    return [0.5 * this.width * (1 + (m[0] * x + m[4] * y + m[8] * z + m[12]) / w),
      0.5 * this.height * (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w), w];
  }
}

/** @param {number[]} a @param {number[]} b */
export function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
