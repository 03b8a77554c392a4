// SPDX-License-Identifier: GPL-3.0-or-later
// What was done to a project, options and edits alike, in one list: going back is going to an earlier place in it.

/** Characters of results that are kept, so that going back shows them at once. */
const mostKept = 64e6;

/**
 * Options, and how many of the steps by hand there were.
 * @typedef {object} Moment
 * @property {Record<string, string | boolean>} options
 * @property {number} count of steps
 * @property {What} what led here
 * @property {number[]} [left] steps that aren't possible with these options; unknown before it was made
 * @property {string[]} [live] the others, by the names of the surface that these options give
 * @property {number} [surface] that surface, among the history's
 * @property {import("./backend.js").State | null} [state] what came of it, where that is kept
 *
 * @typedef {{kind: "open"} | {kind: "options", keys: string[]} | {kind: "edits", edits: string[]}} What
 *
 * What outlives the page: a history without results.
 * @typedef {{lines: string[], bases: number[], surfaces: Surface[], moments: Moment[], at: number}} Saved
 *
 * @typedef {import("./carry.js").Surface} Surface
 */

export class History {
  constructor() {
    /** All steps by hand, in the words of session/edit.hpp; a moment has the first of them. @type {string[]} */
    this.lines = [];
    /** The surface whose edges and faces each of them names. @type {number[]} */
    this.bases = [];
    /** @type {Surface[]} */
    this.surfaces = [];
    /** @type {Moment[]} */
    this.moments = [];
    this.at = -1;
  }

  /** @returns {Moment | undefined} */
  get now() {
    return this.moments[this.at];
  }

  get canUndo() {
    return this.at > 0;
  }

  get canRedo() {
    return this.at + 1 < this.moments.length;
  }

  /** @param {Moment} moment */
  steps(moment) {
    return this.lines.slice(0, moment.count);
  }

  /** The number of a surface, which may be there already. @param {Surface | null} surface */
  numberOf(surface) {
    if (!surface) {
      return -1;
    }
    const same = (/** @type {ArrayLike<number>} */ a, /** @type {ArrayLike<number>} */ b) => a.length === b.length && Array.prototype.every.call(a, (value, i) => value === b[i]);
    const known = this.surfaces.findIndex(({points, faces}) => same(points, surface.points) && same(faces, surface.faces));
    return known >= 0 ? known : this.surfaces.push(surface) - 1;
  }

  /** What was undone is gone with it. @param {Moment} moment @param {string} [line] a step by hand that led here */
  add(moment, line) {
    this.moments.length = this.at + 1;
    if (line !== undefined) {
      this.lines.length = this.bases.length = moment.count - 1;
      this.lines.push(line);
      this.bases.push(moment.surface ?? -1);
    }
    this.moments.push(moment);
    this.at += 1;
    this.#forget();
  }

  /** Results that are far away are made again where they are wanted. */
  #forget() {
    let kept = 0;
    for (const moment of this.moments.slice(1).reverse()) {
      kept += (moment.state?.fold.length ?? 0) + (moment.state?.sheets.length ?? 0);
      if (kept > mostKept) {
        moment.state = null;
      }
    }
  }

  /** All results are of other files than those that there are now. */
  forgetAll() {
    this.moments.forEach((moment) => Object.assign(moment, {state: null, left: undefined, live: undefined}));
  }

  /** @returns {Saved} */
  save() {
    return {lines: [...this.lines], bases: [...this.bases], surfaces: this.surfaces, at: this.at, moments: this.moments.map(({options, count, what, left, live, surface}) =>
      ({options, count, what, left, live, surface}))};
  }

  /** @param {Saved} saved */
  static restored({lines, bases, surfaces, moments, at}) {
    return Object.assign(new History(), {lines: [...lines], bases: [...bases], surfaces: [...surfaces], moments: moments.map((moment) => ({...moment})), at});
  }
}

/** Options that differ. @param {Record<string, string | boolean>} a @param {Record<string, string | boolean>} b @param {{key: string, usual: string | boolean}[]} table */
export function changedKeys(a, b, table) {
  return table.filter(({key, usual}) => (a[key] ?? usual) !== (b[key] ?? usual)).map(({key}) => key);
}
