// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a project beside its sheets: what has to be known, notes, and all that was done.

import {htmlElement} from "./guide.js";
import {optionTable} from "./options.js";
import {byId} from "./panel.js";
import {say, sayCount, sayLength, sayList, sayNumber} from "./words.js";

/** @typedef {import("./option_words.js").Option} Option */
/** @typedef {import("./backend.js").State} State */

/**
 * @typedef {object} ToldHost
 * @property {() => string} loose that pieces lie where they can't stay, or nothing
 * @property {() => void} takeBack the last of them
 * @property {() => void} undo
 * @property {(steps: number) => void} goBy
 * @property {(changed: Record<string, string | boolean>) => void} set
 */

export class Told {
  /** @param {ToldHost} host */
  constructor(host) {
    this.host = host;
  }

  /** @param {State} state @param {import("./history.js").History} history */
  show(state, history) {
    this.#tell(state);
    this.#showNotes(state);
    this.#showHistory(history);
  }

  /** What has to be known stands in the open, with what can be done about it. @param {State} state */
  #tell({notes, left, figures}) {
    const {simplified, buildable, smallest_size_mm: least, size_mm: size} = /** @type {any} */ (figures);
    /** @type {HTMLElement[]} */
    const rows = [];
    const row = (/** @type {string} */ text, /** @type {string} */ id = "", /** @type {string} */ button = "", /** @type {() => void} */ act = () => {}) => {
      const parts = button ? [htmlElement("button", {type: "button", id}, [button])] : [];
      parts[0]?.addEventListener("click", act);
      rows.push(htmlElement("li", {class: id === "" ? "" : "warning"}, [text, ...parts]));
    };
    if (this.host.loose() !== "") {
      row(this.host.loose(), "take-back", say("take_back"), () => this.host.takeBack());
    }
    if (left.length > 0) {
      const kinds = left.map((line) => say(`did_${line.split(" ")[0]}`));
      const what = sayList([...new Set(kinds)].map((kind) => this.#times(kind, kinds.filter((one) => one === kind).length)));
      row(sayCount("edits_left_out", left.length).replace("{what}", what), "go-back", say("go_back"), () => this.host.undo());
    }
    for (const {text} of notes.filter(({code}) => code === "repair_texture_missing")) {
      row(text, "choose-picture", say("choose_picture"), () => byId("files").click());
    }
    if (buildable === false) {
      const better = Math.ceil((least ?? 0) / 10) * 10;
      const largest = Math.max(...(size ?? [0]));
      row(say("hard_to_build"), "larger", better > largest ? say("make_larger", {size: sayLength(better, 0)}) : "", () => this.host.set({size: String(better)}));
    }
    if (simplified && simplified.faces_before > simplified.faces_after) {
      row(say("became", {before: sayNumber(simplified.faces_before), after: sayNumber(simplified.faces_after), away: sayLength(simplified.deviation_mm)}));
    }
    byId("told").hidden = rows.length === 0;
    byId("told").replaceChildren(...rows);
  }

  /** @param {State} state */
  #showNotes({notes}) {
    byId("studio-notes").querySelector("ul")?.replaceChildren(...notes.map(({text}) => htmlElement("li", {}, [text])));
    this.#countNotes();
  }

  #countNotes() {
    const notes = byId("studio-notes");
    const count = notes.querySelectorAll("li").length;
    notes.hidden = count === 0;
    /** @type {HTMLElement} */ (notes.querySelector("summary")).textContent = `${say("notes_list")} (${count})`;
  }

  /** @param {string} text @param {string} [button] @param {() => void} [act] */
  note(text, button, act) {
    const parts = button ? [htmlElement("button", {type: "button"}, [button])] : [];
    parts[0]?.addEventListener("click", () => act?.());
    byId("told").prepend(htmlElement("li", {class: "warning"}, [text, ...parts]));
    byId("told").hidden = false;
  }

  /** @param {string} what @param {number} n */
  #times(what, n) {
    return n > 1 ? `${what} (${n})` : what;
  }

  /** All that was done; a click goes there. @param {import("./history.js").History} history */
  #showHistory(history) {
    byId("history").hidden = history.moments.length < 2;
    byId("history").querySelector("ol")?.replaceChildren(...history.moments.map(({what, options}, i) => {
      const text = what.kind === "open" ? say("did_open") : what.kind === "edits" ? this.#times(say(`did_${what.edits[0]}`), what.edits.length)
        : what.keys.length === 1 ? `${say(`option_${what.keys[0]}`)}: ${this.#valueOf(what.keys[0], options)}` : say("did_reset");
      const button = htmlElement("button", {type: "button", ...(i === history.at ? {"aria-current": "step"} : {}), class: i > history.at ? "undone" : ""}, [text]);
      button.addEventListener("click", () => this.host.goBy(i - history.at));
      return htmlElement("li", {}, [button]);
    }));
  }

  /** @param {string} key of an option @param {Record<string, string | boolean>} options */
  #valueOf(key, options) {
    const {usual} = /** @type {Option} */ (optionTable.find((option) => option.key === key));
    const value = options[key] ?? usual;
    const text = say(`option_${key}_${value}`);
    return typeof value === "boolean" ? (value ? "✓" : "–") : text === `option_${key}_${value}` ? value || "–" : text;
  }
}
