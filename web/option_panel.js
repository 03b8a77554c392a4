// SPDX-License-Identifier: GPL-3.0-or-later
// The options as controls, and what is entered in them.

import {htmlElement} from "./guide.js";
import {optionTable} from "./options.js";
import {byId} from "./panel.js";
import {say} from "./words.js";

/** @typedef {import("./option_words.js").Option} Option */

/** Somebody who types is not finished. */
const typingMs = 700;
/** In place of a sheet's name. */
const ownPaper = "own";

/**
 * @typedef {object} OptionHost
 * @property {(changed: Record<string, string | boolean>) => void} set
 * @property {() => void} number gives all names and numbers again
 */

export class OptionPanel {
  /** @param {OptionHost} host */
  constructor(host) {
    this.host = host;
    this.timer = 0;
    /** Those that are shown. @type {Record<string, string | boolean>} */
    this.options = {};
    this.#build();
  }

  #build() {
    const opens = byId("open-options");
    opens.addEventListener("click", () => opens.setAttribute("aria-expanded", String(byId("panel").classList.toggle("open"))));
    const form = byId("options");
    const groups = [...new Set(optionTable.map(({group}) => group))];
    const fieldset = (/** @type {string} */ group, /** @type {Option[]} */ list) => htmlElement("fieldset", {},
      [htmlElement("legend", {"data-say": `group_${group}`}), ...list.map((option) => this.#control(option))]);
    const more = htmlElement("details", {}, [htmlElement("summary", {"data-say": "more"})]);
    for (const group of groups) {
      const first = optionTable.filter((option) => option.group === group && !option.more);
      const rest = optionTable.filter((option) => option.group === group && option.more);
      if (first.length > 0) {
        form.append(fieldset(group, first));
      }
      if (rest.length > 0) {
        more.append(fieldset(group, rest));
      }
    }
    const reset = htmlElement("button", {type: "button", id: "reset", "data-say": "reset"});
    reset.addEventListener("click", () => this.host.set(Object.fromEntries(optionTable.map(({key, usual}) => [key, usual]))));
    const find = htmlElement("input", {type: "search", id: "find-option", "data-label": "find_option"});
    find.addEventListener("input", () => this.#find(find, more));
    form.prepend(find);
    const number = htmlElement("button", {type: "button", id: "number-again", "data-say": "number_again"});
    number.addEventListener("click", () => this.host.number());
    form.append(more, number, reset);
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("change", () => this.#heard());
    form.addEventListener("input", (event) => {
      if (/** @type {Element} */ (event.target).matches("input[type=text]")) {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.#heard(), typingMs);
      }
    });
  }

  /** A size of the reader's own, in words of the program: 300x200mm. @param {Event} event */
  #askForPaper(event) {
    const select = /** @type {HTMLSelectElement} */ (event.target);
    if (select.value !== ownPaper) {
      return;
    }
    event.stopPropagation();
    const size = (prompt(say("own_paper_ask"), "300 x 200 mm") ?? "").replace(/\s/g, "").replace(/×/, "x").replace(/,/g, ".");
    select.value = String(this.options.paper ?? "A4");
    if (size !== "") {
      this.host.set({paper: /[a-z]$/i.test(size) ? size : `${size}mm`});
    }
  }

  /** Shows the options whose words have this in them. @param {HTMLElement} find @param {HTMLElement} more */
  #find(find, more) {
    const wanted = /** @type {HTMLInputElement} */ (find).value.trim().toLowerCase();
    for (const label of byId("options").querySelectorAll("label")) {
      label.hidden = wanted !== "" && !(label.textContent ?? "").toLowerCase().includes(wanted);
    }
    for (const fieldset of byId("options").querySelectorAll("fieldset")) {
      fieldset.hidden = !fieldset.querySelector("label:not([hidden])");
    }
    more.toggleAttribute("open", wanted !== "");
  }

  /** @param {Option} option */
  #control(option) {
    const id = `option-${option.key}`;
    const words = htmlElement("span", {"data-say": `option_${option.key}`});
    if (option.kind === "flag") {
      return htmlElement("label", {class: "flag"}, [htmlElement("input", {type: "checkbox", id}), words]);
    }
    if (option.kind === "choice") {
      const select = htmlElement("select", {id});
      for (const choice of [...option.choices ?? [], ...(option.key === "paper" ? [ownPaper] : [])]) {
        const key = `option_${option.key}_${choice}`;
        const item = htmlElement("option", {value: choice}, [choice]);
        if (say(key) !== key) {
          item.setAttribute("data-say", key);
        }
        select.append(item);
      }
      if (option.key === "paper") {
        select.addEventListener("change", (event) => this.#askForPaper(event));
      }
      return htmlElement("label", {}, [words, select]);
    }
    const usual = say(`option_${option.key}_usual`);
    const input = htmlElement("input", {type: "text", id, inputmode: option.kind === "text" || option.kind === "list" ? "text" : "decimal",
      placeholder: usual === `option_${option.key}_usual` ? String(option.usual) : usual});
    const unit = option.kind === "length" ? "mm" : option.unit ?? "";
    const box = unit ? htmlElement("span", {class: "length"}, [input, htmlElement("small", {}, [unit])]) : input;
    const help = say(`option_${option.key}_help`);
    return htmlElement("label", {}, [words, box, ...(help === `option_${option.key}_help` ? [] : [htmlElement("small", {"data-say": `option_${option.key}_help`})])]);
  }

  /** Shows these options. @param {Record<string, string | boolean>} options */
  fill(options) {
    this.options = options;
    for (const {key, kind, usual} of optionTable) {
      const control = /** @type {HTMLInputElement} */ (byId(`option-${key}`));
      const value = this.options[key] ?? usual;
      if (kind === "flag") {
        control.checked = value === true;
      } else if (key === "paper" && !control.querySelector(`option[value="${CSS.escape(String(value))}"]`)) {
        control.append(htmlElement("option", {value: String(value)}, [String(value)]));
        control.value = String(value);
      } else if (control !== document.activeElement || kind === "choice") {
        control.value = kind === "choice" || value !== usual ? String(value) : "";
      }
      control.classList.toggle("changed", value !== usual);
    }
    byId("reset").hidden = optionTable.every(({key, usual}) => (this.options[key] ?? usual) === usual);
  }

  /** What the panel says now. */
  #asked() {
    /** @type {Record<string, string | boolean>} */
    const asked = {};
    for (const {key, kind, usual} of optionTable) {
      const control = /** @type {HTMLInputElement} */ (byId(`option-${key}`));
      if (kind === "flag") {
        asked[key] = control.checked;
      } else {
        // As people write decimals elsewhere.
        const text = control.value.trim().replace(/^(\d+),(\d+)$/, "$1.$2");
        asked[key] = text === "" && kind !== "choice" ? usual : text;
      }
    }
    return asked;
  }

  #heard() {
    clearTimeout(this.timer);
    const asked = this.#asked();
    if (optionTable.some(({key, usual}) => asked[key] !== (this.options[key] ?? usual))) {
      this.host.set(asked);
    }
  }
}
