// SPDX-License-Identifier: GPL-3.0-or-later
// Which sheets differ from those that were printed last.

/** @typedef {import("./nets.js").Nets} Nets */

/** FNV-1a, 32 bits. @param {string} text */
function hashOf(text) {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) {
    hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193);
  }
  return (hash >>> 0).toString(16);
}

/** What a maker cuts and glues of each sheet, in short; not how many sheets there are.
 * @param {Nets} nets @param {string} sheets the second document @returns {string[]} */
export function sheetKeys(nets, sheets) {
  /** @type {{groups?: {id: string}[]}[]} */
  const drawn = JSON.parse(sheets || '{"pages":[]}').pages;
  const short = (/** @type {number} */ mm) => Math.round(1000 * mm);
  return nets.pages.map((page, p) => {
    const parts = page.pieces.map((index) => {
      const {faces, name} = nets.pieces[index];
      const corners = faces.flatMap((f) => [0, 1, 2].flatMap((k) => {
        const v = nets.faces[3 * f + k];
        return [short(nets.points[2 * v] - page.x), short(nets.points[2 * v + 1] - page.y)];
      }));
      const tabs = nets.tabs.filter(({piece}) => piece === index).flatMap(({polygon}) => polygon.flat().map((value, i) => short(value - (i % 2 === 0 ? page.x : page.y))));
      return [name, ...corners, "|", ...tabs].join(" ");
    }).sort();
    const words = (drawn[p]?.groups ?? []).filter(({id}) => id !== "page").map((group) => JSON.stringify(group)).sort();
    return hashOf(`${parts.join("\n")}\n${words.join("\n")}`);
  });
}

/** The sheets, from 1, that none of those that were printed is like. @param {string[]} now @param {string[]} printed */
export const changedSheets = (now, printed) => now.flatMap((key, p) => (printed.includes(key) ? [] : [p + 1]));
