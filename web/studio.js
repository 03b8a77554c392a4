// SPDX-License-Identifier: GPL-3.0-or-later
// The studio: files come in, options are chosen, results are shown by the app, files go out. It holds the project's options and
// reports on the work; the result itself is the app's.

import {App} from "./app.js";
import {faceOfPiece, PieceDrag, piecesWith, placeOfPiece} from "./drag.js";
import {previewEdit, Offer} from "./edit.js";
import {htmlElement} from "./guide.js";
import {byId, Menu, sayAll} from "./panel.js";
import {optionTable} from "./options.js";
import {say} from "./words.js";
import {Cancelled, Refusal} from "./worker_backend.js";

/** @typedef {import("./option_words.js").Option} Option */
/** @typedef {import("./backend.js").State} State */
/** @typedef {import("./worker_backend.js").WorkerBackend} WorkerBackend */

const modelSuffix = /\.(obj|stl|ply|off|glb|gltf|3mf|pdo)$/i;
/** Work that is done sooner shows no bar. */
const patienceMs = 300;
/** Somebody who types is not finished. */
const typingMs = 700;
/** What a key turns and moves a piece by: degrees, mm. */
const keyTurn = 15;
const keyStep = 5;

export class Studio {
  /** @param {WorkerBackend} backend @param {Record<string, Record<string, string>>} samples files by name, of each sample */
  constructor(backend, samples) {
    this.backend = backend;
    this.samples = samples;
    /** @type {App | null} */
    this.app = null;
    /** @type {Record<string, string | boolean>} */
    this.options = {};
    /** @type {State | null} */
    this.state = null;
    this.running = 0;
    this.timer = 0;
    this.error = "";
    this.editing = false;
    this.offer = new Offer(backend, (edit) => this.edit(() => backend.apply([edit]), edit));
    this.#listenFiles();
    this.#listenEdits();
    this.#buildPanel();
    for (const name of Object.keys(samples)) {
      const button = htmlElement("button", {type: "button", "data-say": `sample_${name}`});
      button.addEventListener("click", () => this.openSample(name));
      byId("samples").append(button);
    }
    this.menu = new Menu(byId("export"), byId("export-menu"), () => this.#formats().map((format) => ({text: say(`format_${format}`), act: () => this.save(format)})), new AbortController().signal);
    byId("cancel").addEventListener("click", () => this.backend.cancel());
    this.#listenRefusal();
    backend.onProgress((stage, share) => this.progress(stage, share));
    byId("panel").hidden = true;
    sayAll();
    /** Milliseconds from opening the page until the program is there. */
    this.ready = 0;
    backend.warm().then(() => {
      this.ready = performance.now();
    }).catch((error) => {
      // Whoever opens a model before the program has started ends that start, and gets another one.
      if (!(error instanceof Cancelled)) {
        this.refuse(say("no_program", {why: error.message}));
      }
    });
  }

  // ---- files

  #listenFiles() {
    const input = /** @type {HTMLInputElement} */ (byId("files"));
    const choose = () => input.click();
    byId("choose-file").addEventListener("click", choose);
    byId("open-other").addEventListener("click", choose);
    input.addEventListener("change", () => {
      this.openFiles([...(input.files ?? [])]);
      input.value = "";
    });
    const over = (/** @type {DragEvent} */ event) => {
      event.preventDefault();
      document.body.classList.add("dropping");
    };
    document.addEventListener("dragenter", over);
    document.addEventListener("dragover", over);
    document.addEventListener("dragleave", (event) => event.relatedTarget ?? document.body.classList.remove("dropping"));
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      document.body.classList.remove("dropping");
      this.openFiles([...(event.dataTransfer?.files ?? [])]);
    });
  }

  /** @param {File[]} files a model and what belongs to it */
  async openFiles(files) {
    if (files.length === 0) {
      return;
    }
    const models = files.filter(({name}) => modelSuffix.test(name));
    // Whatever is dropped alone is tried: its content decides, and the program says what is wrong with it.
    const model = models[0] ?? (files.length === 1 ? files[0] : null);
    if (!model) {
      this.refuse(say("no_model"));
      return;
    }
    /** @type {Record<string, Uint8Array>} */
    const beside = {};
    for (const file of files) {
      if (file !== model) {
        beside[file.name] = new Uint8Array(await file.arrayBuffer());
      }
    }
    await this.open(model.name, new Uint8Array(await model.arrayBuffer()), beside, {});
    if (models.length > 1) {
      this.note(say("several_models", {name: model.name}));
    }
  }

  /** @param {string} name of a sample */
  openSample(name) {
    const encoder = new TextEncoder();
    const files = Object.entries(this.samples[name]).map(([file, text]) => /** @type {const} */ ([file, encoder.encode(text)]));
    return this.open(files[0][0], files[0][1], Object.fromEntries(files.slice(1)), {});
  }

  /**
   * @param {string} name
   * @param {Uint8Array} bytes
   * @param {Record<string, Uint8Array>} beside
   * @param {Record<string, string | boolean>} options
   * @param {string[]} [rest] words of a command line that are no options of the panel
   */
  open(name, bytes, beside, options, rest = []) {
    return this.run(() => this.backend.open(name, bytes, beside, options, rest), options, null);
  }

  // ---- edits by hand

  /** Whoever goes on elsewhere has read what can't be, which would lie on the sheets that are worked on. */
  #listenRefusal() {
    byId("dismiss").addEventListener("click", () => this.refuse(""));
    document.addEventListener("keydown", ({key}) => key === "Escape" && this.refuse(""));
    document.addEventListener("pointerdown", ({target}) => {
      if (target instanceof Node && !byId("refused").contains(target)) {
        this.refuse("");
      }
    }, {capture: true});
  }

  #listenEdits() {
    byId("undo").addEventListener("click", () => this.undo());
    byId("redo").addEventListener("click", () => this.redo());
    document.addEventListener("keydown", (event) => {
      // Where text is written these keys take back what was written.
      if (!(event.ctrlKey || event.metaKey) || event.altKey || /** @type {Element} */ (event.target).matches("input[type=text]")) {
        return;
      }
      const key = event.key.toLowerCase();
      const act = key === "z" ? () => (event.shiftKey ? this.redo() : this.undo()) : key === "y" ? () => this.redo() : null;
      if (act) {
        act();
        event.preventDefault();
      }
    });
    document.addEventListener("keydown", (event) => {
      const target = /** @type {Element} */ (event.target);
      if (!event.ctrlKey && !event.metaKey && !event.altKey && !target.closest("dialog,form,.menu") && this.#pieceKey(event)) {
        event.preventDefault();
        // On a piece the arrows alone go from edge to edge.
        event.stopImmediatePropagation();
      }
    });
  }

  /** The pieces that keys act on: those that are chosen, or that with the focus. @returns {number[]} */
  #pieces() {
    const focused = document.activeElement?.closest("[data-piece]")?.getAttribute("data-piece");
    return this.app && this.app.selection.chosen.size > 0 ? [...this.app.selection.chosen] : focused ? [Number(focused)] : [];
  }

  /** @param {KeyboardEvent} event */
  #pieceKey(event) {
    const nets = this.app?.nets;
    if (!nets) {
      return false;
    }
    const pieces = this.#pieces();
    const faces = pieces.map((index) => faceOfPiece(nets, index));
    const pinned = this.#pinned();
    const lay = (/** @type {number} */ dx, /** @type {number} */ dy, /** @type {number} */ degrees) => pieces.map((index) => placeOfPiece(nets, index, dx, dy, degrees));
    const turn = event.shiftKey ? -keyTurn : keyTurn;
    /** @type {Record<string, () => import("./backend.js").Edit[]>} */
    const keys = {
      r: () => lay(0, 0, turn),
      l: () => faces.map((face, i) => ({kind: pinned.has(pieces[i]) ? "unpin" : "pin", face})),
      n: () => faces.map((face) => ({kind: "retry", face, seed: this.#seed()})),
      p: () => [{kind: "pack", faces}],
      ...(event.shiftKey ? {ArrowLeft: () => lay(-keyStep, 0, 0), ArrowRight: () => lay(keyStep, 0, 0), ArrowUp: () => lay(0, keyStep, 0),
        ArrowDown: () => lay(0, -keyStep, 0)} : {}),
    };
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (!keys[key] || (pieces.length === 0 && key !== "p")) {
      return false;
    }
    this.layAndChoose(keys[key](), faces);
    return true;
  }

  /** Of another net: one that wasn't tried here. */
  #seed() {
    return (this.backend.project?.steps.length ?? 0) + 1;
  }

  /** The pieces that are pinned. */
  #pinned() {
    return new Set(this.app ? piecesWith(this.app.nets, this.state?.pinned ?? []) : []);
  }

  /** Does what is to be done with pieces, and goes on with them. @param {import("./backend.js").Edit[]} edits @param {number[]} faces of them */
  async layAndChoose(edits, faces) {
    const focused = document.activeElement?.closest("[data-piece]") !== null;
    await this.edit(() => this.backend.apply(edits));
    if (this.app && this.error === "") {
      const pieces = piecesWith(this.app.nets, faces);
      this.app.choosePieces(pieces);
      if (focused && pieces.length > 0) {
        this.app.plan.pieces[pieces[0]].focus();
      }
    }
  }

  undo() {
    if (this.state?.canUndo) {
      this.edit(() => this.backend.undo());
    }
  }

  redo() {
    if (this.state?.canRedo) {
      this.edit(() => this.backend.redo());
    }
  }

  /**
   * One at a time: whoever is faster than the program waits for what it shows.
   * @param {() => Promise<State>} work
   * @param {import("./backend.js").Edit} [edit] whose edge or piece is lit after it
   */
  async edit(work, edit) {
    if (this.editing) {
      return;
    }
    this.editing = true;
    this.offer.hide();
    const takeBack = edit && this.app ? previewEdit(this.app, edit) : () => {};
    await this.run(work, this.options, this.app?.view() ?? null);
    takeBack();
    this.editing = false;
    if (edit && this.app && this.error === "") {
      if ("edge" in edit) {
        this.app.markEdge(edit.edge);
      } else {
        this.app.choosePieces(piecesWith(this.app.nets, edit.kind === "pack" ? edit.faces : [edit.face]));
      }
    }
  }

  // ---- work

  /**
   * @param {() => Promise<State>} work
   * @param {Record<string, string | boolean>} options that it is done with
   * @param {import("./app.js").View | null} view to go on with
   */
  async run(work, options, view) {
    const run = ++this.running;
    this.refuse("");
    const bar = byId("busy");
    this.progress("starting", NaN);
    const patience = setTimeout(() => {
      bar.hidden = false;
    }, patienceMs);
    try {
      const state = await work();
      if (run === this.running) {
        this.options = options;
        this.show(state, view);
      }
    } catch (error) {
      if (run === this.running) {
        this.fillPanel();
        if (error instanceof Refusal && error.faces.length > 0) {
          this.app?.markFaces(error.faces);
        }
        this.refuse(error instanceof Cancelled ? (this.state ? say("cancelled") : "") : error instanceof Error ? error.message : String(error),
          error instanceof Refusal ? error.proposal : null);
      }
    } finally {
      clearTimeout(patience);
      if (run === this.running) {
        bar.hidden = true;
      }
    }
  }

  /** @param {string} stage @param {number} share */
  progress(stage, share) {
    const key = stage === "starting" ? stage : `stage_${stage.replace(/ /g, "_")}`;
    const text = say(key);
    byId("stage-name").textContent = text === key ? stage : text;
    const bar = /** @type {HTMLProgressElement} */ (byId("share"));
    if (share > 0) {
      bar.value = share;
    } else {
      bar.removeAttribute("value");
    }
  }

  /** @param {State} state @param {import("./app.js").View | null} view to go on with */
  show(state, view) {
    this.state = state;
    this.offer.hide();
    this.app?.stop();
    byId("welcome").hidden = true;
    byId("panel").hidden = false;
    const app = new App(this.backend, state, view, (spot) =>
      this.offer.show(app, spot, spot !== null && this.#pinned().has(spot.piece), this.#seed()));
    this.app = app;
    app.plan.drag = new PieceDrag(app.plan, {
      chosen: () => app.selection.chosen,
      turns: () => app.selection.chosenEdge < 0,
      pinned: this.#pinned(),
      fits: (edits) => this.backend.preview(edits).catch(() => ({ok: false})),
      lay: (edits) => this.layAndChoose(edits, edits.flatMap((edit) => ("face" in edit ? [edit.face] : []))),
    });
    app.plan.say();
    for (const [id, can] of /** @type {const} */ ([["undo", state.canUndo], ["redo", state.canRedo]])) {
      /** @type {HTMLButtonElement} */ (byId(id)).disabled = !can;
    }
    byId("panel-name").textContent = this.backend.project?.name ?? "";
    this.fillPanel();
    this.#showNotes(state.notes.map(({text}) => text));
  }

  /** @param {string[]} texts */
  #showNotes(texts) {
    const notes = byId("studio-notes");
    notes.hidden = texts.length === 0;
    /** @type {HTMLElement} */ (notes.querySelector("summary")).textContent = `${say("notes_list")} (${texts.length})`;
    /** @type {HTMLElement} */ (notes.querySelector("ul")).replaceChildren(...texts.map((text) => htmlElement("li", {}, [text])));
  }

  /** @param {string} text */
  note(text) {
    this.#showNotes([...byId("studio-notes").querySelectorAll("li")].map((item) => item.textContent ?? "").concat(text));
  }

  /** What can't be, with a button for the option that would help. @param {string} sentence
   * @param {{option: string, value: string} | null} [proposal] */
  refuse(sentence, proposal = null) {
    this.error = sentence;
    const box = byId("refused");
    box.hidden = sentence === "";
    /** @type {HTMLElement} */ (box.querySelector("p")).textContent = sentence;
    const option = optionTable.find(({word}) => word === `--${proposal?.option}`);
    const button = byId("try-it");
    button.hidden = !option || !this.backend.project;
    if (option && proposal) {
      button.textContent = `${say(`option_${option.key}`)}: ${proposal.value}`;
      button.onclick = () => this.setOptions({[option.key]: proposal.value});
    }
  }

  /** @param {Record<string, string | boolean>} changed */
  setOptions(changed) {
    const options = {...this.options, ...changed};
    return this.run(() => this.backend.set(options), options, this.app?.view() ?? null);
  }

  /** Formats that make sense for a printer, or for the machine that was chosen. */
  #formats() {
    const machine = (this.options.preset ?? "print") !== "print";
    return this.backend.capabilities().export.filter((format) =>
      machine ? !["guide", "html", "png"].includes(format) : !["lbrn2", "eps", "plt"].includes(format));
  }

  /** @param {string} format */
  async save(format) {
    try {
      const {name, bytes} = await this.backend.exportFile(format);
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (bytes)], {type: "application/octet-stream"}));
      link.download = name;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    } catch (error) {
      this.refuse(error instanceof Error ? error.message : String(error));
    }
  }

  // ---- the panel

  #buildPanel() {
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
    reset.addEventListener("click", () => this.run(() => this.backend.set(Object.fromEntries(optionTable.map(({key, usual}) => [key, usual]))), {}, this.app?.view() ?? null));
    form.append(more, reset);
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("change", () => this.#heard());
    form.addEventListener("input", (event) => {
      if (/** @type {Element} */ (event.target).matches("input[type=text]")) {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.#heard(), typingMs);
      }
    });
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
      for (const choice of option.choices ?? []) {
        const key = `option_${option.key}_${choice}`;
        const item = htmlElement("option", {value: choice}, [choice]);
        if (say(key) !== key) {
          item.setAttribute("data-say", key);
        }
        select.append(item);
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

  /** Shows the options of the result that is shown. */
  fillPanel() {
    for (const {key, kind, usual} of optionTable) {
      const control = /** @type {HTMLInputElement} */ (byId(`option-${key}`));
      const value = this.options[key] ?? usual;
      if (kind === "flag") {
        control.checked = value === true;
      } else if (control !== document.activeElement) {
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
    if (this.state && optionTable.some(({key, usual}) => asked[key] !== (this.options[key] ?? usual))) {
      this.setOptions(asked);
    }
  }

  /** For whoever tests the page. @param {any} about */
  inspect(about) {
    return {...(this.app ? this.app.inspect(about) : {}), ready: this.ready, project: this.backend.project?.name ?? null, options: this.options,
      figures: this.state?.figures ?? null, busy: this.backend.calls.size > 0 || this.editing, canUndo: this.state?.canUndo ?? false,
      canRedo: this.state?.canRedo ?? false, pinned: [...this.#pinned()], offer: this.offer.box.hidden ? null : {edits: this.offer.edits, words: this.offer.words.textContent}, error: this.error, notes: this.state?.notes ?? []};
  }
}
