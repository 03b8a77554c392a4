// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that were let go where they can't stay: beside the sheets, or on other pieces. They are shown there until there is
// room for them; the program keeps the place that each of them had last. And where pieces go that are moved and turned.

/** @typedef {import("./nets.js").Nets} Nets */
/** @typedef {import("./sheets.js").Plan} Plan */
/** @typedef {Extract<import("./backend.js").Edit, {kind: "place"}>} Place */

/** The name of a piece that outlives edits: its smallest face of the model. @param {Nets} nets @param {number} index */
export function faceOfPiece(nets, index) {
  return Math.min(...nets.pieces[index].faces.map((f) => nets.modelFace[f]));
}

/** The pieces that have these faces of the model. @param {Nets} nets @param {number[]} modelFaces @returns {number[]} */
export function piecesWith(nets, modelFaces) {
  const asked = new Set(modelFaces);
  return [...new Set([...nets.modelFace.keys()].filter((f) => asked.has(nets.modelFace[f])).map((f) => nets.facePiece[f]))];
}

/** @param {number} value @param {number} unit */
const rounded = (value, unit) => Math.round(value * unit) / unit;

/** The edit that lays a piece as it lies. @param {Nets} nets @param {number} index @param {number} [face] of the model that it is named by
 * @returns {Place} */
export function placeNow(nets, index, face = faceOfPiece(nets, index)) {
  const piece = nets.pieces[index];
  const {x: left, y: foot} = nets.pages[piece.page];
  const f = /** @type {number} */ (piece.faces.find((candidate) => nets.modelFace[candidate] === face));
  const [a, b] = [0, 1].map((k) => {
    const v = nets.faces[3 * f + k];
    return [nets.points[2 * v] - left, nets.points[2 * v + 1] - foot];
  });
  return {kind: "place", face, page: piece.page + 1, at: a, degrees: (Math.atan2(b[1] - a[1], b[0] - a[0]) * 180) / Math.PI};
}

/**
 * A place turned about a point of its page, and moved then.
 * @param {Place} place
 * @param {number[]} middle mm from the lower left corner
 * @param {number} dx mm to the right
 * @param {number} dy mm up
 * @param {number} degrees counterclockwise
 * @returns {Place}
 */
export function movedPlace(place, middle, dx, dy, degrees) {
  const angle = (degrees * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [x, y] = [place.at[0] - middle[0], place.at[1] - middle[1]];
  return {...place, at: [rounded(middle[0] + c * x - s * y + dx, 1e6), rounded(middle[1] + s * x + c * y + dy, 1e6)],
    degrees: rounded(place.degrees + degrees, 1e9)};
}

/**
 * Lays a piece as the program has it, but turned about its middle and moved.
 * @param {Nets} nets
 * @param {number} index
 * @param {number} dx mm to the right
 * @param {number} dy mm up
 * @param {number} degrees counterclockwise
 * @param {number} [page] its lower left corner is as far from the point as that of its own page was
 * @returns {Place}
 */
export function placeOfPiece(nets, index, dx, dy, degrees, page = nets.pieces[index].page) {
  const {box, page: own} = nets.pieces[index];
  const {x, y} = nets.pages[own];
  const middle = [0.5 * (box[0] + box[2]) - x, 0.5 * (box[1] + box[3]) - y];
  return {...movedPlace(placeNow(nets, index), middle, dx, dy, degrees), page: page + 1};
}

/** So many pieces that lie on the desk are tried together with one that is laid. */
const mostTried = 8;

export class Desk {
  constructor() {
    /** By the faces that they name, in the order in which they were left. @type {Map<number, Place>} */
    this.places = new Map();
    /** What their faces are of: a number of the history's. */
    this.surface = -1;
  }

  /** @param {Place[]} places @param {number} surface */
  leave(places, surface) {
    this.surface = surface;
    for (const place of places) {
      this.places.delete(place.face);
      this.places.set(place.face, place);
    }
  }

  /** The pieces with these faces lie where the program has them. @param {Nets} nets @param {number[]} faces */
  forget(nets, faces) {
    const asked = piecesWith(nets, faces);
    for (const face of [...this.places.keys()]) {
      if (piecesWith(nets, [face]).some((index) => asked.includes(index))) {
        this.places.delete(face);
      }
    }
  }

  /** The last one goes back to the place that it had. Whether there was one. */
  takeBack() {
    return this.places.delete([...this.places.keys()].at(-1) ?? -1);
  }

  /** Where they lie, by piece; of two that became one piece, the last. @param {Nets} nets @returns {Map<number, Place>} */
  onSheets(nets) {
    return new Map([...this.places.values()].flatMap((place) => piecesWith(nets, [place.face]).map((index) => /** @type {const} */ ([index, place]))));
  }

  /**
   * What can be laid at once: these, with as many of those on the desk as find room then. Two pieces that change places find it
   * together alone. None where there is no room for these.
   * @param {Place[]} places
   * @param {(places: Place[]) => Promise<boolean>} fits
   * @returns {Promise<Place[] | null>}
   */
  async laid(places, fits) {
    const others = [...this.places.values()].filter(({face}) => places.every((place) => place.face !== face)).slice(-mostTried);
    for (const first of [...(others.length > 1 ? [[...places, ...others]] : []), places, ...others.map((other) => [...places, other])]) {
      if (await fits(first)) {
        const all = [...first];
        for (const other of others.filter((one) => !first.includes(one))) {
          if (await fits([...all, other])) {
            all.push(other);
          }
        }
        return all;
      }
    }
    return null;
  }
}
