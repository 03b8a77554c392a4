// SPDX-License-Identifier: GPL-3.0-or-later
// What a FOLD file of this program says (docs/reference/formats.md), as arrays and records that the other modules draw from.
// Lengths are mm, angles radians, y runs up.

/**
 * @typedef {object} Edge of the nets
 * @property {number} a net vertex
 * @property {number} b net vertex
 * @property {"B"|"M"|"V"|"F"} kind cut, mountain, valley, flat
 * @property {number} angle of the fold, valley positive
 * @property {boolean} bent the paper is rolled there, without a line; of cuts: on either side
 * @property {number[]} faces one at a cut, two at a fold
 * @property {number} piece
 * @property {number} join at a cut: index into joins, or -1
 * @property {number} tab that grows from it, or -1
 * @property {number[]} tabs all that do: several where they go into slits
 * @property {number} length
 *
 * @typedef {object} Piece
 * @property {number} index
 * @property {string} name
 * @property {number} part
 * @property {number} page
 * @property {number[]} faces
 * @property {number[]} edges all but flat folds
 * @property {number[]} joins each once
 * @property {number[][]} steps edges that are folded together, in order
 * @property {number[][][]} slits in it that tabs go into
 * @property {number} folds mountain and valley folds
 * @property {number[]} box left, bottom, right, top in the plane of all nets, tabs included
 * @property {number[]} colour red, green, blue, 0 to 255
 * @property {number} step of the assembly
 *
 * @typedef {object} Join
 * @property {number} number as printed
 * @property {number[]} edges two
 * @property {number[]} pieces of these edges
 * @property {number} tab or -1
 * @property {string} why there is no tab: the end of a message's code
 * @property {number} step of the assembly in which it is closed
 * @property {number} chain
 *
 * @typedef {object} Tab
 * @property {number} edge
 * @property {number} piece
 * @property {number} face that it grows from
 * @property {number} join
 * @property {number[][]} polygon
 * @property {number[][] | null} slit that it goes into
 *
 * @typedef {{x: number, y: number, width: number, height: number, pieces: number[]}} Page
 * @typedef {{pieces: number[], joins: number[]}} Step joins are indices
 *
 * @typedef {object} Nets
 * @property {string} title
 * @property {string} digest
 * @property {string} creator
 * @property {"x"|"y"|"z"} up
 * @property {number} hiddenAngle folds of less have no line, radians
 * @property {Float64Array} points two a net vertex
 * @property {Uint32Array} faces three net vertices a face
 * @property {Int32Array} faceEdges of each side
 * @property {Int32Array} facePiece
 * @property {Edge[]} edges
 * @property {Piece[]} pieces
 * @property {Join[]} joins
 * @property {number[][]} chains joins that are glued edge by edge, in a row; they have one number
 * @property {Tab[]} tabs
 * @property {Page[]} pages with nets
 * @property {Step[]} steps
 * @property {Float64Array} modelPoints three a vertex
 * @property {Uint32Array} modelFaces three model vertices a net face, corner by corner
 * @property {Int32Array} modelFace of each face
 * @property {number[]} size of the model along x, y, z
 */

const degree = Math.PI / 180;

/** OKLCH to sRGB, 0 to 255 (Ottosson 2020). @param {number} l @param {number} c @param {number} h degrees */
export function colourOf(l, c, h) {
  const a = c * Math.cos(h * degree);
  const b = c * Math.sin(h * degree);
  const [x, y, z] = [l + 0.3963377774 * a + 0.2158037573 * b, l - 0.1055613458 * a - 0.0638541728 * b,
    l - 0.0894841775 * a - 1.291485548 * b].map((v) => v * v * v);
  return [4.0767416621 * x - 3.3077115913 * y + 0.2309699292 * z,
    -1.2684380046 * x + 2.6097574011 * y - 0.3413193965 * z,
    -0.0041960863 * x - 0.7034186147 * y + 1.707614701 * z].map((v) => {
    const shown = v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055;
    return Math.round(255 * Math.min(1, Math.max(0, shown)));
  });
}

/**
 * Per part a hue, per piece of a part a shade of it.
 * @param {number} part
 * @param {number} within
 */
function pieceColour(part, within) {
  const shift = within === 0 ? 0 : ((within * 0.618034) % 1) - 0.5;
  const hue = part * 137.508 + 235 + 64 * shift;
  return colourOf([0.8, 0.72, 0.86, 0.76][within % 4], 0.075, hue);
}

/** @param {any} fold @param {Piece[]} pieces @param {Edge[]} edges @param {Join[]} joins @returns {Step[]} */
function readSteps(fold, pieces, edges, joins) {
  /** @type {{pieces: number[], joins: number[]}[]} */
  const assembly = fold["ridgecraft:assembly"] ?? pieces.map((piece) => ({pieces: [piece.index], joins: []}));
  assembly.forEach((step, k) => {
    for (const piece of step.pieces) {
      pieces[piece].step = k;
    }
  });
  /** @type {Step[]} */
  const steps = assembly.map((step) => ({pieces: step.pieces, joins: []}));
  joins.forEach((join, j) => {
    join.step = Math.max(...join.pieces.map((piece) => pieces[piece].step));
    steps[join.step].joins.push(j);
  });
  for (const step of steps) {
    step.joins.sort((i, j) => joins[i].number - joins[j].number);
  }
  return steps;
}

/**
 * @param {string} text of a FOLD file
 * @returns {Nets}
 */
export function readNets(text) {
  const fold = JSON.parse(text);
  const frame = fold.file_frames[0];
  const count = fold.faces_vertices.length;
  const points = Float64Array.from(fold.vertices_coords.flat());
  const faces = Uint32Array.from(fold.faces_vertices.flat());
  const facePiece = Int32Array.from(fold["ridgecraft:faces_piece"]);
  const vertices = points.length / 2;
  /** @type {Map<number, number>} */
  const edgeAt = new Map();
  const key = (/** @type {number} */ a, /** @type {number} */ b) => Math.min(a, b) * vertices + Math.max(a, b);
  /** @type {Edge[]} */
  const edges = fold.edges_vertices.map((/** @type {number[]} */ [a, b], /** @type {number} */ i) => {
    edgeAt.set(key(a, b), i);
    const length = Math.hypot(points[2 * a] - points[2 * b], points[2 * a + 1] - points[2 * b + 1]);
    return {a, b, kind: fold.edges_assignment[i], angle: fold.edges_foldAngle[i] * degree,
      bent: fold["edges_ridgecraft:bent"]?.[i] ?? false, faces: [], piece: -1, join: -1, tab: -1, tabs: [], length};
  });
  const faceEdges = new Int32Array(3 * count);
  /** @type {number[]} */
  const withinPart = [];
  /** @type {Piece[]} */
  const pieces = fold["ridgecraft:pieces"].map((/** @type {any} */ record, /** @type {number} */ index) => {
    const part = record.parts[0] ?? index;
    const within = withinPart[part] ?? 0;
    withinPart[part] = within + 1;
    return {index, name: record.name, part, page: record.page, faces: [], edges: [], joins: [], slits: [],
      steps: fold["ridgecraft:fold_order"]?.[index] ?? [], folds: 0,
      box: [Infinity, Infinity, -Infinity, -Infinity], colour: pieceColour(part, within), step: 0};
  });
  const widen = (/** @type {number[]} */ box, /** @type {number} */ x, /** @type {number} */ y) => {
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  };
  for (let f = 0; f < count; ++f) {
    const piece = pieces[facePiece[f]];
    piece.faces.push(f);
    for (let k = 0; k < 3; ++k) {
      const a = faces[3 * f + k];
      const e = /** @type {number} */ (edgeAt.get(key(a, faces[3 * f + (k + 1) % 3])));
      faceEdges[3 * f + k] = e;
      widen(piece.box, points[2 * a], points[2 * a + 1]);
      if (edges[e].faces.push(f) === 1 && edges[e].kind !== "F") {
        piece.edges.push(e);
        piece.folds += edges[e].kind === "B" ? 0 : 1;
      }
      edges[e].piece = piece.index;
    }
  }
  /** @type {Join[]} */
  const joins = fold["ridgecraft:joins"].map((/** @type {any} */ record, /** @type {number} */ j) => {
    for (const e of record.edges) {
      edges[e].join = j;
    }
    const of = record.edges.map((/** @type {number} */ e) => edges[e].piece);
    for (const piece of new Set(of)) {
      pieces[/** @type {number} */ (piece)].joins.push(j);
    }
    return {number: record.number, edges: record.edges, pieces: of, tab: record.tab ?? -1, why: record.why ?? "", step: 0, chain: -1};
  });
  /** @type {number[][]} */
  const chains = (fold["ridgecraft:chains"] ?? joins.map((_, j) => ({joins: [j]}))).map((/** @type {any} */ record) => record.joins);
  chains.forEach((chain, i) => {
    for (const j of chain) {
      joins[j].chain = i;
    }
  });
  /** @type {Tab[]} */
  const tabs = [...fold["ridgecraft:tabs"], ...(fold["ridgecraft:more_tabs"] ?? [])].map((/** @type {any} */ record, /** @type {number} */ t) => {
    const edge = edges[record.edge];
    for (const e of record.edges ?? [record.edge]) {
      edges[e].tab = edges[e].tab < 0 ? t : edges[e].tab;
      edges[e].tabs.push(t);
    }
    if (record.slit) {
      const beyond = joins[edge.join].edges.find((/** @type {number} */ e) => e !== record.edge) ?? record.edge;
      pieces[edges[beyond].piece].slits.push(record.slit);
    }
    for (const [x, y] of record.polygon) {
      widen(pieces[edge.piece].box, x, y);
    }
    return {edge: record.edge, piece: edge.piece, face: edge.faces[0], join: edge.join, polygon: record.polygon,
      slit: record.slit ?? null};
  });
  /** @type {Page[]} */
  const pages = fold["ridgecraft:pages"].map((/** @type {any} */ record, /** @type {number} */ p) => ({
    x: record.origin[0], y: record.origin[1], width: record.size?.[0] ?? 0, height: record.size?.[1] ?? 0,
    pieces: pieces.filter((piece) => piece.page === p).map((piece) => piece.index)}));
  const modelFace = Int32Array.from(fold["ridgecraft:faces_model"]);
  const modelFaces = new Uint32Array(3 * count);
  modelFace.forEach((m, f) => modelFaces.set(frame.faces_vertices[m], 3 * f));
  const modelPoints = Float64Array.from(frame.vertices_coords.flat());
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  modelPoints.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  return {
    title: fold.file_title ?? "", digest: fold["ridgecraft:model_digest"] ?? "", creator: fold.file_creator ?? "",
    up: fold["ridgecraft:up"] ?? "y", hiddenAngle: (fold["ridgecraft:settings"]?.hide_folds_deg ?? 3) * degree, points,
    faces, faceEdges, facePiece, edges, pieces, joins, chains, tabs, pages, steps: readSteps(fold, pieces, edges, joins),
    modelPoints, modelFaces, modelFace, size: high.map((value, k) => value - low[k]),
  };
}

/** How many numbers these joins have. @param {Nets} nets @param {number[]} joins */
export const countSeams = (nets, joins) => new Set(joins.map((j) => nets.joins[j].number)).size;

/**
 * Whether a line is drawn there: cuts, and folds that are not too small; paper that is rolled has none.
 * @param {Nets} nets
 * @param {number} e
 */
export function hasLine(nets, e) {
  const edge = nets.edges[e];
  return edge.kind === "B" || (edge.kind !== "F" && !edge.bent && Math.abs(edge.angle) >= nets.hiddenAngle);
}

/**
 * The two model vertices of an edge: its name, which outlives all edits.
 * @param {Nets} nets
 * @param {number} e
 */
export function modelEnds(nets, e) {
  const [f] = nets.edges[e].faces;
  const k = [0, 1, 2].find((side) => nets.faceEdges[3 * f + side] === e) ?? 0;
  return [nets.modelFaces[3 * f + k], nets.modelFaces[3 * f + (k + 1) % 3]];
}

/**
 * The face of a piece where a point of the plane of all nets lies, or -1. O(faces of the piece).
 * @param {Nets} nets
 * @param {number} index
 * @param {number} x
 * @param {number} y
 */
export function faceOfPieceAt({points, faces, pieces}, index, x, y) {
  const {box, faces: own} = pieces[index];
  if (x < box[0] || x > box[2] || y < box[1] || y > box[3]) {
    return -1;
  }
  return own.find((f) => [0, 1, 2].every((k) => {
    const a = 2 * faces[3 * f + k];
    const b = 2 * faces[3 * f + (k + 1) % 3];
    return (points[b] - points[a]) * (y - points[a + 1]) - (points[b + 1] - points[a + 1]) * (x - points[a]) >= 0;
  })) ?? -1;
}
