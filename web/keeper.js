// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing is lost: each step is kept in the browser, the last projects stand on the start page, and whoever is about to
// lose something is asked.

import {htmlElement} from "./guide.js";
import {byId} from "./panel.js";
import {Shelf} from "./shelf.js";
import {reader, say, shortName} from "./words.js";

/** @typedef {import("./shelf.js").Kept} Kept */
/** @typedef {import("./worker_backend.js").WorkerBackend} WorkerBackend */
/** @typedef {import("./worker_backend.js").SavedProject} SavedProject */

/** Steps that follow at once are kept together, ms. */
const pauseMs = 250;
/** A picture of the model is taken so often, ms. */
const pictureMs = 20000;

/**
 * @typedef {object} Host
 * @property {() => string} picture of what is shown, small, as an address of data
 * @property {(project: SavedProject, kept: Kept) => void} goOn with a project that was kept
 * @property {() => Promise<boolean>} save as a file
 */

export class Keeper {
  /** @param {WorkerBackend} backend @param {Host} host */
  constructor(backend, host) {
    this.backend = backend;
    this.host = host;
    /** @type {Shelf | null} */
    this.shelf = null;
    /** Of the project that is shown. */
    this.id = "";
    /** What was printed of it last (web/printed.js). @type {string[]} */
    this.printed = [];
    this.timer = 0;
    this.picture = "";
    this.pictureTime = -Infinity;
    /** Where the history was when it was kept last, and when it was saved as a file. @type {unknown} */
    this.kept = null;
    /** @type {unknown} */
    this.saved = null;
    /** @type {Promise<void>} */
    this.writing = Promise.resolve();
    this.ready = Shelf.open().then(async (shelf) => {
      this.shelf = shelf;
      await this.showRecent();
    }).catch(() => {
      this.shelf = null;
    });
    addEventListener("beforeunload", (event) => {
      if (this.#changed && this.kept !== backend.history.now) {
        event.preventDefault();
        // As older browsers want it.
        event.returnValue = true;
      }
    });
    document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && this.timer && this.#keep());
    byId("forget").addEventListener("click", () => this.clear());
    byId("ask").addEventListener("cancel", () => this.#answer("stay"));
  }

  /** Whether something was done that opening the model doesn't give again. */
  get #changed() {
    return this.backend.history.moments.length > 1;
  }

  /** Whether something would be missed without a file. */
  get unsaved() {
    return this.#changed && this.saved !== this.backend.history.now;
  }

  /** Another project is shown. @param {string} [id] it has been kept under @param {string[]} [printed] sheets of it */
  begin(id = "", printed = []) {
    this.id = id;
    this.printed = printed;
    this.saved = null;
    this.pictureTime = -Infinity;
  }

  /** Something was done. */
  changed() {
    this.#sayKept("keeping");
    this.timer ||= window.setTimeout(() => this.#keep(), pauseMs);
  }

  /** What waits to be kept is kept before another project comes. */
  async flush() {
    if (this.timer) {
      await this.#keep();
    }
  }

  async #keep() {
    clearTimeout(this.timer);
    this.timer = 0;
    await this.ready;
    const {shelf, backend} = this;
    const project = backend.saved();
    const now = backend.history.now;
    if (!project) {
      return;
    }
    if (performance.now() - this.pictureTime > pictureMs) {
      this.picture = this.host.picture();
      this.pictureTime = performance.now();
    }
    this.id ||= crypto.randomUUID();
    const {files, ...rest} = project;
    const kept = {id: this.id, name: project.name, time: Date.now(), picture: this.picture, printed: this.printed, project: rest};
    this.writing = this.writing.then(async () => {
      try {
        if (!shelf) {
          throw new Error("no shelf");
        }
        await shelf.put(kept, files);
        this.kept = now;
        this.#sayKept("kept");
      } catch {
        this.#sayKept("not_kept");
      }
    });
    await this.writing;
  }

  /** @param {"keeping" | "kept" | "not_kept"} how */
  #sayKept(how) {
    const line = byId("kept");
    line.textContent = how === "keeping" ? "" : say(how, {time: new Date().toLocaleTimeString(reader.language, {hour: "2-digit", minute: "2-digit"})});
    line.classList.toggle("warning", how === "not_kept");
  }

  /** The last projects, on the start page. */
  async showRecent() {
    const list = await this.shelf?.list() ?? [];
    byId("recent").hidden = list.length === 0;
    byId("recent-list").replaceChildren(...list.map((kept) => {
      const steps = kept.project.history.moments.length - 1;
      const time = new Intl.DateTimeFormat(reader.language, {dateStyle: "medium", timeStyle: "short"}).format(kept.time);
      const button = htmlElement("button", {type: "button", title: kept.name}, [
        ...(kept.picture ? [htmlElement("img", {src: kept.picture, alt: "", width: "120", height: "90"})] : []),
        htmlElement("span", {}, [htmlElement("strong", {}, [shortName(kept.name, 22)]), htmlElement("small", {}, [time]),
          htmlElement("small", {}, [say(steps === 1 ? "steps_1" : "steps_n", {n: steps})])])]);
      button.addEventListener("click", async () => {
        const project = await this.shelf?.get(kept);
        if (project) {
          this.host.goOn(project, kept);
        }
      });
      return button;
    }));
  }

  async clear() {
    await this.shelf?.clear();
    this.id = "";
    this.kept = null;
    await this.showRecent();
  }

  /** @param {string[]} keys of the sheets */
  wasPrinted(keys) {
    this.printed = keys;
    this.changed();
  }

  /** The project was written as a file. */
  wasSaved() {
    this.saved = this.backend.history.now;
  }

  /** Asks whoever would leave something that no file has. @param {string} next what comes instead */
  async mayLeave(next) {
    const {project} = this.backend;
    if (!this.unsaved || !project) {
      return true;
    }
    const dialog = /** @type {HTMLDialogElement} */ (byId("ask"));
    const text = say(this.shelf ? "ask_kept" : "ask_lost", {name: shortName(project.name), next: shortName(next)});
    const buttons = /** @type {const} */ (["save", "leave", "stay"]).map((choice) => {
      const button = htmlElement("button", {type: "button", class: choice === "save" ? "strong" : "", "data-choice": choice}, [say(`ask_${choice}`)]);
      button.addEventListener("click", () => this.#answer(choice));
      return button;
    });
    dialog.replaceChildren(htmlElement("p", {}, [text]), htmlElement("div", {class: "buttons"}, buttons));
    dialog.showModal();
    /** @type {string} */
    const choice = await new Promise((resolve) => {
      this.resolve = resolve;
    });
    return choice === "leave" || (choice === "save" && await this.host.save());
  }

  /** @param {string} choice */
  #answer(choice) {
    /** @type {HTMLDialogElement} */ (byId("ask")).close();
    this.resolve?.(choice);
  }
}
