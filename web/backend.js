// SPDX-License-Identifier: GPL-3.0-or-later
// Who answers the page's requests. All backends have one interface, so that the same page shows a finished result, and
// edits a model where a program stands behind it.

import {unpackedText} from "./packed.js";

/**
 * @typedef {object} State
 * @property {number} revision
 * @property {Record<string, string | boolean>} options
 * @property {string} fold the nets: text of a FOLD file
 * @property {string} sheets what else stands on the pages: text of the second document (docs/design/viewer.md)
 * @property {{text: string, code?: string, about?: {piece?: number, edge?: number, face?: number}}[]} notes
 * @property {Record<string, unknown>} figures
 * @property {boolean} canUndo
 * @property {boolean} canRedo
 * @property {boolean} busy
 * @property {number[]} pinned a face of the model of each piece that is pinned
 * @property {string[]} left steps by hand that aren't possible with these options, in the words of session/edit.hpp
 *
 * An edge by its two model vertices, in the order in which the face has them that a tab is to grow from; a piece by one of its
 * faces of the model. A place: where the face's first corner lies on the page (from 1), mm from its lower left corner, and in
 * which direction the second one lies from there.
 * @typedef {{kind: "cut"|"join"|"tab-from"|"no-tab"|"both-tabs", edge: number[]} | {kind: "tab-shape", edge: number[], height: number, degrees: number} | {kind: "place", face: number, page: number, at: number[],
 *   degrees: number} | {kind: "pin"|"unpin", face: number} | {kind: "retry", face: number, seed: number} | {kind: "pack",
 *   faces: number[]} | {kind: "number"}} Edit
 *
 * @typedef {object} Capabilities
 * @property {boolean} edit
 * @property {string[]} export formats
 * @property {string} version
 *
 * @typedef {object} Backend
 * @property {() => Capabilities} capabilities
 * @property {(name: string, bytes: Uint8Array, sidecars: Record<string, Uint8Array>) => Promise<State>} open
 * @property {(options: Record<string, string | boolean>) => Promise<State>} set
 * @property {(edits: Edit[]) => Promise<State>} apply all of them, or none
 * @property {() => Promise<State>} undo
 * @property {() => Promise<State>} redo
 * @property {(edits: Edit[], reach?: number) => Promise<{ok: boolean, code?: string, why?: string, faces?: number[], instead?: number[]}>} preview would they be refused, and which
 *   faces of the model are to be looked at
 * @property {(format: string) => Promise<Uint8Array>} export
 * @property {() => void} cancel
 * @property {(listener: (stage: string, share: number) => void) => void} onProgress
 * @property {(listener: (note: State["notes"][number]) => void) => void} onNote
 */

/** A request that needs a program behind the page. */
export class NotEditable extends Error {
  constructor() {
    super("not_editable");
    this.name = "NotEditable";
  }
}

/**
 * One finished result, that stands in the page itself.
 * @param {Document} page
 * @returns {Promise<Backend & {state: () => State}>}
 */
export async function staticBackend(page) {
  const [fold, sheets] = await Promise.all(["fold", "sheets"].map((id) => unpackedText(page.getElementById(id)?.textContent ?? "")));
  const refuse = () => Promise.reject(new NotEditable());
  return {
    state: () => ({revision: 0, options: {}, fold, sheets, notes: [], figures: {},
      canUndo: false, canRedo: false, busy: false, pinned: [], left: []}),
    capabilities: () => ({edit: false, export: ["fold"],
      version: page.querySelector("meta[name=generator]")?.getAttribute("content") ?? ""}),
    open: refuse,
    set: refuse,
    apply: refuse,
    undo: refuse,
    redo: refuse,
    preview: refuse,
    export: (format) =>
      format === "fold" ? Promise.resolve(new TextEncoder().encode(fold)) : refuse(),
    cancel: () => {},
    onProgress: () => {},
    onNote: () => {},
  };
}
