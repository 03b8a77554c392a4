// SPDX-License-Identifier: GPL-3.0-or-later
// What is pointed at and chosen, and which pieces and edges light up for it.

/** @typedef {import("./nets.js").Nets} Nets */
/** @typedef {import("./scene.js").Spot} Spot */

export class Selection {
  /** @param {Nets} nets */
  constructor(nets) {
    this.nets = nets;
    /** @type {Spot | null} */
    this.hovered = null;
    /** @type {Set<number>} */
    this.chosen = new Set();
    this.chosenEdge = -1;
    /** Seams that the guide points at. @type {number[]} */
    this.pointed = [];
    /** Edges that are in the way of what was to be done. @type {number[]} */
    this.inTheWay = [];
  }

  /** Chooses these pieces, or the edge of one. @param {Iterable<number>} pieces @param {number} [edge] */
  set(pieces, edge = -1) {
    this.chosen = new Set(pieces);
    this.chosenEdge = edge;
    this.inTheWay = [];
  }

  clear() {
    this.hovered = null;
    this.set([]);
  }

  /**
   * As a click does: what was chosen already is chosen no more.
   * @param {Spot | null} spot
   * @param {boolean} add to what is chosen
   */
  choose(spot, add) {
    this.hovered = null;
    if (!spot) {
      this.set([]);
    } else if (add && spot.edge < 0) {
      const pieces = new Set(this.chosen);
      pieces.delete(spot.piece) || pieces.add(spot.piece);
      this.set(pieces);
    } else {
      const again = spot.edge === this.chosenEdge && this.chosen.size === 1 && this.chosen.has(spot.piece);
      this.set(again ? [] : [spot.piece], again ? -1 : spot.edge);
    }
  }

  /** Where the one piece, or its edge, is that is chosen. @returns {Spot | null} */
  get single() {
    return this.chosen.size === 1 ? {piece: [...this.chosen][0], edge: this.chosenEdge} : null;
  }

  /** @param {{pieces: number[], edges: number[]}} otherwise what lights up where nothing is chosen */
  lit(otherwise) {
    const {nets} = this;
    if (this.pointed.length > 0) {
      const joins = this.pointed.map((j) => nets.joins[j]);
      return {spot: null, pieces: new Set(joins.flatMap(({pieces}) => pieces)), edges: joins.flatMap(({edges}) => edges)};
    }
    const spot = this.hovered ?? (this.chosen.size > 0 ? {piece: [...this.chosen][0], edge: this.chosenEdge} : null);
    if (!spot) {
      return {spot, pieces: new Set(otherwise.pieces), edges: otherwise.edges};
    }
    const join = spot.edge >= 0 ? nets.edges[spot.edge].join : -1;
    const pieces = join >= 0 ? new Set(nets.joins[join].pieces) : this.hovered ? new Set([spot.piece]) : new Set(this.chosen);
    return {spot, pieces, edges: [...(join >= 0 ? nets.joins[join].edges : spot.edge >= 0 ? [spot.edge] : []), ...this.inTheWay]};
  }
}
