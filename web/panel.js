// SPDX-License-Identifier: GPL-3.0-or-later
// What stands around the two views: title, menu, the line at the foot, the list of keys.

import {htmlElement} from "./guide.js";
import {reader, say, sayCount, sayLength, shortName} from "./words.js";

/** @typedef {import("./nets.js").Nets} Nets */

/** @param {string} id */
export function byId(id) {
  const element = document.getElementById(id);
  if (!element) {
    throw new Error(`the page has no ${id}`);
  }
  return element;
}

/** Instead of a page that can't start. @param {unknown} error */
export function tellBroken(error) {
  const line = document.createElement("p");
  line.className = "broken";
  line.textContent = say("broken", {why: error instanceof Error ? error.message : String(error)});
  document.body.append(line);
}

/** Puts the texts of the page in the reader's language. */
export function sayAll() {
  document.documentElement.lang = reader.language;
  for (const element of document.querySelectorAll("[data-say]")) {
    element.textContent = say(element.getAttribute("data-say") ?? "");
  }
  for (const element of document.querySelectorAll("[data-label]")) {
    const text = say(element.getAttribute("data-label") ?? "");
    element.setAttribute("aria-label", text);
    if (element.matches("button")) {
      element.setAttribute("title", text);
    } else if (element.matches("input[type=search]")) {
      element.setAttribute("placeholder", text);
    }
  }
}

/** @param {Nets} nets @param {number} pages with those of lists */
export function sayFacts(nets, pages) {
  byId("title").textContent = shortName(nets.title);
  byId("title").title = nets.title;
  byId("facts").textContent = say("facts", {faces: sayCount("faces", nets.facePiece.length), pieces: sayCount("pieces", nets.pieces.length),
    pages: sayCount("pages", pages), size: sayLength(Math.max(...nets.size), 0)});
}

/** Whether the nets, folded here, are the model: a thousandth of a millimetre is. @param {number} error mm */
export function sayCheck(error) {
  const line = byId("check");
  const shown = error < 1e-6 ? `< ${sayLength(1e-6, 6)}` : sayLength(error, 6);
  line.textContent = say(error < 1e-3 ? "checked" : "unchecked", {error: shown});
  line.title = say("checked_title", {error: shown});
  line.classList.toggle("wrong", error >= 1e-3);
}

/**
 * @typedef {object} MenuItem
 * @property {string} text
 * @property {string} [key] on the keyboard
 * @property {() => void} act
 * @property {boolean} [rule] a line before it
 */

/** A menu that is written when it is opened. */
export class Menu {
  /**
   * @param {HTMLElement} button
   * @param {HTMLElement} menu
   * @param {() => MenuItem[]} items
   * @param {AbortSignal} ended when the page shows something else
   */
  constructor(button, menu, items, ended) {
    this.button = button;
    this.menu = menu;
    this.items = items;
    button.addEventListener("click", () => (menu.hidden ? this.open() : this.close()));
    document.addEventListener("pointerdown", (event) => {
      const target = /** @type {Node} */ (event.target);
      if (!menu.hidden && !menu.contains(target) && !button.contains(target)) {
        this.close();
      }
    }, {signal: ended});
    menu.addEventListener("keydown", (event) => {
      const buttons = [...menu.querySelectorAll("button")];
      const here = buttons.indexOf(/** @type {HTMLButtonElement} */ (document.activeElement));
      const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
      if (step !== 0) {
        buttons[(here + step + buttons.length) % buttons.length].focus();
        event.preventDefault();
      } else if (event.key === "Escape" || event.key === "Tab") {
        this.close();
        button.focus();
      } else if (event.key === "Home" || event.key === "End") {
        buttons[event.key === "Home" ? 0 : buttons.length - 1].focus();
        event.preventDefault();
      }
      event.stopPropagation();
    });
  }

  open() {
    this.menu.replaceChildren(...this.items().flatMap(({text, key, act, rule}) => {
      const button = htmlElement("button", {type: "button", role: "menuitem", tabindex: "-1"}, [text]);
      if (key) {
        button.append(htmlElement("kbd", {}, [key]));
      }
      button.addEventListener("click", () => {
        this.close();
        act();
      });
      return rule ? [htmlElement("hr", {role: "separator"}), button] : [button];
    }));
    this.menu.hidden = false;
    this.button.setAttribute("aria-expanded", "true");
    this.menu.querySelector("button")?.focus();
  }

  close() {
    this.menu.hidden = true;
    this.button.setAttribute("aria-expanded", "false");
  }
}

/** Shows all keys. @param {boolean} painted whether the model has colours of its own */
export function showKeys(painted) {
  const dialog = /** @type {HTMLDialogElement} */ (byId("keys"));
  const spoken = {space: say("key_name_space"), home: say("key_name_home"), tab: say("key_name_tab"), escape: say("key_name_escape"), arrows: `${say("key_name_shift")} ← → ↑ ↓`};
  const rows = [[spoken.space, "key_space"], ["B", "key_build"], ["← →", "key_steps"], ["D", "key_done"], [spoken.home, "key_home"],
    ["F", "key_f"], ["X", "key_x"], ...(painted ? [["T", "key_t"]] : []), [spoken.tab, "key_tab"], [spoken.escape, "key_escape"],
    ["Ctrl+P", "key_print"], ...(document.getElementById("undo") ? [["Ctrl+Z", "key_undo"], [spoken.arrows, "key_move"], ["R", "key_turn"], ["L", "key_pin"],
      ["N", "key_retry"], ["P", "key_pack"], ["C J T X", "key_edge"], ["Ctrl+A", "key_all"], ["Ctrl+S", "save_project_title"]] : []), ["?", "key_help"]];
  const close = htmlElement("button", {type: "button", class: "strong"}, [say("close")]);
  close.addEventListener("click", () => dialog.close());
  dialog.setAttribute("aria-label", say("all_keys"));
  dialog.replaceChildren(htmlElement("h2", {}, [say("all_keys")]),
    htmlElement("dl", {}, rows.flatMap(([key, text]) => [htmlElement("dt", {}, [htmlElement("kbd", {}, [key])]), htmlElement("dd", {}, [say(text)])])),
    htmlElement("p", {class: "quiet"}, [say("mouse")]), close);
  dialog.showModal();
}
