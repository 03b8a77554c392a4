// SPDX-License-Identifier: GPL-3.0-or-later
// What pieces and edges are called in the line at the foot, and for readers who can't see them.

import {countSeams} from "./nets.js";
import {say, sayAngle, sayCount, sayLength, sayList, sayMessage} from "./words.js";

/** @typedef {import("./nets.js").Nets} Nets */

/** @param {Nets} nets @param {number} index */
export function pieceLabel(nets, index) {
  const piece = nets.pieces[index];
  const partners = [...new Set(piece.joins.flatMap((j) => nets.joins[j].pieces))]
    .filter((p) => p !== index || piece.joins.some((j) => nets.joins[j].pieces.every((q) => q === index)))
    .map((p) => (p === index ? say("itself") : nets.pieces[p].name));
  return say("piece_line", {name: piece.name, page: say("page", {page: piece.page + 1}), faces: sayCount("faces", piece.faces.length),
    folds: sayCount("folds", piece.folds),
    glued: partners.length > 0 ? say("glued", {names: sayList(partners), seams: sayCount("seams", countSeams(nets, piece.joins))}) : ""});
}

/** @param {Nets} nets @param {number} e */
export function edgeLabel(nets, e) {
  const edge = nets.edges[e];
  const name = nets.pieces[edge.piece].name;
  const length = sayLength(edge.length);
  if (edge.join >= 0) {
    const join = nets.joins[edge.join];
    const [a, b] = join.pieces.map((p) => nets.pieces[p].name);
    const whole = nets.chains[join.chain].reduce((sum, j) => sum + nets.edges[nets.joins[j].edges[0]].length, 0);
    const long = nets.chains[join.chain].length > 1 ? say("length_of", {length, whole: sayLength(whole)}) : length;
    return say("join_line", {number: join.number, a, b, length: long, tab: join.tab < 0 ? say("no_tab", {why: sayMessage({code: `no_tab_${join.why}`, values: {}, text: join.why})})
      : say("tab_on", {name: nets.pieces[nets.tabs[join.tab].piece].name})});
  }
  return edge.kind === "B" ? say("border_line", {length, name})
    : say("fold_line", {kind: say(edge.kind === "M" ? "mountain" : "valley"), angle: sayAngle(edge.angle), length, name});
}
