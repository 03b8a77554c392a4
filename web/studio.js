// SPDX-License-Identifier: GPL-3.0-or-later
// The studio: files come in, options are chosen, results are shown by the app, files go out. It holds the project's options and
// reports on the work; the result itself is the app's.

import {App} from "./app.js";
import {Desk, faceOfPiece, piecesWith, placeOfPiece} from "./desk.js";
import {PieceDrag} from "./drag.js";
import {editByKey, legendAt, Offer, previewEdit} from "./edit.js";
import {htmlElement} from "./guide.js";
import {Keeper} from "./keeper.js";
import {OptionPanel} from "./option_panel.js";
import {byId, Menu, sayAll} from "./panel.js";
import {hashOf, optionsOf, optionTable} from "./options.js";
import {Told} from "./told.js";
import {changedSheets, sheetKeys} from "./printed.js";
import {Damaged, filesDropped, modelOfNets, readProject, withoutArchives} from "./project.js";
import {say, sayCount, sayList, shortName} from "./words.js";
import {Cancelled, Refusal} from "./worker_backend.js";

/** @typedef {import("./option_words.js").Option} Option */
/** @typedef {import("./backend.js").Edit} Edit */
/** @typedef {import("./backend.js").State} State */
/** @typedef {import("./desk.js").Place} Place */
/** @typedef {import("./worker_backend.js").WorkerBackend} WorkerBackend */

const modelSuffix = /\.(obj|stl|ply|off|glb|gltf|3mf|pdo)$/i;
/** What belongs to a model and may come later than it. */
const besideSuffix = /\.(mtl|png|jpe?g|bin)$/i;
/** That are offered for a piece to go to. */
const mostSheets = 6;
/** Of the picture of a project. */
const pictureSize = {width: 240, height: 180};
/** Work that is done sooner shows no bar. */
const patienceMs = 300;
/** What a key turns and moves a piece by: degrees, mm. */
const keyTurn = 15;
const keyStep = 5;
/** Refusals of a place where a piece may lie for the moment. */
const forTheMoment = ["beyond_sheet", "too_near", "different_pages", "no_room_when_pinned"];
/** Files that have no sheets. */
const withoutSheets = ["ridgecraft", "fold"];
/** As far as a piece may have to go to find room on its page, mm. */
const wholePageMm = 150;

/** Where people print on letter paper. */
const letterRegions = /^(US|CA|MX|CL|CO|CR|GT|NI|PA|PH|PR|SV|VE)$/;

/** What a model begins with. @returns {Record<string, string | boolean>} */
function usualOptions() {
  const region = new Intl.Locale(navigator.language).region ?? "";
  return letterRegions.test(region) ? {paper: "letter"} : {};
}

export class Studio {
  /** @param {WorkerBackend} backend @param {Record<string, Record<string, string>>} samples files by name, of each sample */
  constructor(backend, samples) {
    this.backend = backend;
    this.samples = samples;
    /** @type {App | null} */
    this.app = null;
    /** @type {Record<string, string | boolean>} */
    this.options = {};
    /** Of the address that the page was opened with: what a model begins with. @type {Record<string, string | boolean>} */
    this.linked = {};
    /** @type {State | null} */
    this.state = null;
    this.running = 0;
    this.error = "";
    this.editing = false;
    /** Steps back or forth that were asked for while something else was done. */
    this.wantedSteps = 0;
    this.keeper = new Keeper(backend, {
      picture: () => this.#picture(),
      goOn: (project, kept) => this.#opening(kept.name, async () => {
        const state = await backend.restore(project);
        this.keeper.begin(kept.id, kept.printed);
        return state;
      }),
      save: () => this.save("ridgecraft"),
    });
    this.desk = new Desk();
    this.offer = new Offer(backend, (edit) => (edit.kind === "place" ? this.layDown([edit]) : this.edit(() => this.#apply([edit]), edit)));
    this.#listenFiles();
    this.#listenEdits();
    this.told = new Told({loose: () => this.#sayLoose(), takeBack: () => this.#takeBack(), undo: () => this.undo(), goBy: (steps) => this.goBy(steps), set: (changed) => this.setOptions(changed)});
    this.panel = new OptionPanel({
      set: (changed) => this.state && this.setOptions(changed),
      number: () => this.edit(() => this.backend.apply([{kind: "number"}])),
    });
    for (const name of Object.keys(samples)) {
      const button = htmlElement("button", {type: "button", "data-say": `sample_${name}`});
      button.addEventListener("click", () => this.openSample(name));
      byId("samples").append(button);
    }
    this.menu = new Menu(byId("export"), byId("export-menu"), () => [
      ...this.#formats().map((format) => ({text: say(`format_${format}`), act: () => {
        this.save(format);
      }})),
      ...(this.#changedSheets().length > 0 ? [{text: say("print_changed", {list: this.#changedSheets().join(", ")}), rule: true, act: () => {
        this.save("pdf", this.#changedSheets());
      }}] : []),
      {text: say("copy_link"), rule: true, act: () => navigator.clipboard?.writeText(location.href.replace(/#.*/, "") + hashOf(this.options))}], new AbortController().signal);
    byId("save-project").addEventListener("click", () => this.save("ridgecraft"));
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
      if (event.dataTransfer) {
        filesDropped(event.dataTransfer).then((files) => this.openFiles(files));
      }
    });
  }

  /** What a model begins with. */
  #usual() {
    return {...usualOptions(), ...this.linked};
  }

  /** @param {File[]} files a model and what belongs to it, or a project */
  async openFiles(files) {
    try {
      const read = await Promise.all(files.map(async (file) => ({name: file.name, bytes: new Uint8Array(await file.arrayBuffer())})));
      for (const file of read) {
        const project = await readProject(file);
        if (project) {
          await this.openProject(project);
          return;
        }
      }
      await this.#openModel(await withoutArchives(read));
    } catch (error) {
      this.refuse(error instanceof Damaged ? say("damaged", {name: shortName(error.message)}) : String(error));
    }
  }

  /** @param {import("./project.js").OpenedProject} project */
  openProject({name, files, words, steps}) {
    const {options, rest} = optionsOf(words);
    const {[name]: model, ...beside} = files;
    return this.open(name, model, beside, options, rest, steps);
  }

  /** @param {import("./project.js").NamedBytes[]} files */
  async #openModel(files) {
    const models = files.filter(({name}) => modelSuffix.test(name));
    const nets = files.find(({name}) => /\.fold$/i.test(name));
    // Whatever is dropped alone is tried: its content decides, and the program says what is wrong with it.
    const model = models[0] ?? (files.length === 1 && !nets ? files[0] : null);
    const late = Object.fromEntries(files.filter(({name}) => besideSuffix.test(name)).map(({name, bytes}) => [name, bytes]));
    if (models.length === 0 && this.state && files.length > 0 && Object.keys(late).length === files.length) {
      await this.run(() => this.backend.addFiles(late), this.app?.view() ?? null);
    } else if (nets && !model) {
      await this.#openNets(nets);
    } else if (!model) {
      this.refuse(files.length > 0 ? say("no_model") : "");
    } else if (/\.html?$/i.test(model.name)) {
      this.refuse(say("page_alone", {name: shortName(model.name)}));
    } else {
      await this.#openWithNets(model, Object.fromEntries(files.filter((file) => file !== model).map(({name, bytes}) => [name, bytes])), nets);
      if (models.length > 1) {
        this.told.note(say("several_models", {name: model.name}));
      }
    }
  }

  /** Nets that come with a model are taken over, and so are those in a file of Pepakura: as its author made it.
   * @param {import("./project.js").NamedBytes} model @param {Record<string, Uint8Array>} beside @param {import("./project.js").NamedBytes} [nets] */
  async #openWithNets({name, bytes}, beside, nets) {
    const from = nets?.name ?? (/\.pdo$/i.test(name) ? name : "");
    await this.open(name, bytes, beside, this.#usual(), from ? ["--from", from] : []);
    if (from === name && this.error !== "" && this.backend.project?.name !== name) {
      // A file without nets.
      await this.open(name, bytes, beside, this.#usual());
    } else if (from === name && this.error === "") {
      this.told.note(say("as_author"), say("made_anew"), () => this.open(name, bytes, beside, this.#usual()));
    }
  }

  /** Nets without their model: that which they fold to. @param {import("./project.js").NamedBytes} nets */
  async #openNets({name, bytes}) {
    let model;
    try {
      model = new TextEncoder().encode(modelOfNets(new TextDecoder().decode(bytes)));
    } catch {
      throw new Damaged(name);
    }
    await this.open(name.replace(/\.fold$/i, ".obj"), model, {[name]: bytes}, {faces: "keep", scale: "1:1", unit: "mm"}, ["--from", name]);
    if (this.error === "") {
      this.told.note(say("nets_alone", {name: shortName(name)}));
    }
  }

  /** @param {string} name of a sample */
  openSample(name) {
    const encoder = new TextEncoder();
    const files = Object.entries(this.samples[name]).map(([file, text]) => /** @type {const} */ ([file, encoder.encode(text)]));
    return this.open(files[0][0], files[0][1], Object.fromEntries(files.slice(1)), this.#usual());
  }

  /**
   * @param {string} name
   * @param {Uint8Array} bytes
   * @param {Record<string, Uint8Array>} beside
   * @param {Record<string, string | boolean>} options
   * @param {string[]} [rest] words of a command line that are no options of the panel
   * @param {string[]} [steps] what was done by hand already
   */
  open(name, bytes, beside, options, rest = [], steps = []) {
    return this.#opening(name, async () => {
      const state = await this.backend.open(name, bytes, beside, options, rest, steps);
      this.keeper.begin();
      return state;
    });
  }

  /** @param {string} name @param {() => Promise<State>} work */
  async #opening(name, work) {
    if (await this.keeper.mayLeave(name)) {
      await this.keeper.flush();
      await this.run(work, null);
    }
  }

  /** What is shown of the model, small. */
  #picture() {
    const copy = document.createElement("canvas");
    Object.assign(copy, pictureSize);
    const scene = this.app?.scene;
    const context = copy.getContext("2d");
    if (!scene || !context || scene.canvas.width < 2) {
      return "";
    }
    scene.draw();
    const scale = Math.min(copy.width / scene.canvas.width, copy.height / scene.canvas.height);
    const [width, height] = [scale * scene.canvas.width, scale * scene.canvas.height];
    context.fillStyle = "#fff";
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(scene.canvas, 0.5 * (copy.width - width), 0.5 * (copy.height - height), width, height);
    return copy.toDataURL("image/jpeg", 0.8);
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
      const key = event.key.toLowerCase();
      // Where text is written these keys take back what was written.
      const writes = /** @type {Element} */ (event.target).matches("input[type=text]");
      if (!(event.ctrlKey || event.metaKey) || event.altKey || !this.state || (writes && key !== "s")) {
        return;
      }
      if (key === "s") {
        event.preventDefault();
        this.save("ridgecraft");
        return;
      }
      const act = key === "z" ? () => (event.shiftKey ? this.redo() : this.undo()) : key === "y" ? () => this.redo() : null;
      if (act) {
        act();
        event.preventDefault();
      }
    });
    document.addEventListener("keydown", (event) => {
      const target = /** @type {Element} */ (event.target);
      if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "a" && this.app && !target.closest("input,select,dialog")) {
        event.preventDefault();
        this.app.chooseMany(this.app.nets.pieces.map(({index}) => index));
      }
      if (!event.ctrlKey && !event.metaKey && !event.altKey && !target.closest("dialog,form,.menu") && this.#pieceKey(event)) {
        event.preventDefault();
        // On a piece the arrows alone go from edge to edge.
        event.stopImmediatePropagation();
      }
    });
  }

  /** @param {App} app @param {import("./scene.js").Spot | null} spot */
  #offer(app, spot) {
    const chosen = [...app.selection.chosen];
    if (chosen.length > 1) {
      this.offer.showMany(app, chosen, (edits) => this.layAndChoose(edits, chosen.map((index) => faceOfPiece(app.nets, index))), this.#sheetsFor(chosen));
    } else {
      this.offer.show(app, spot, spot !== null && this.#pinned().has(spot.piece), this.#seed(), this.#sheetsFor(chosen));
    }
  }

  /** To which sheets pieces may go. @param {number[]} pieces @returns {{text: string, act: () => void}[]} */
  #sheetsFor(pieces) {
    const {nets} = /** @type {App} */ (this.app);
    const pages = nets.pages.map((_, p) => p).filter((p) => pieces.some((index) => nets.pieces[index].page !== p)).slice(0, mostSheets);
    return [...pages.map((p) => ({text: say("to_sheet", {n: p + 1}), act: () => this.toSheet(pieces, p)})),
      {text: say("to_new_sheet"), act: () => this.toSheet(pieces, nets.pages.length)}];
  }

  /** Pieces go to a sheet, each where there is room for it. @param {number[]} pieces @param {number} page */
  async toSheet(pieces, page) {
    const faces = pieces.map((index) => faceOfPiece(/** @type {App} */ (this.app).nets, index));
    for (const face of faces) {
      const {nets} = /** @type {App} */ (this.app);
      const [index] = piecesWith(nets, [face]);
      const wanted = placeOfPiece(nets, index, 0, 0, 0, Math.min(page, nets.pages.length));
      const {ok, instead} = await this.backend.preview([wanted], wholePageMm);
      if (!ok && !instead) {
        this.refuse(say("no_room_on_sheet", {name: nets.pieces[index].name, n: page + 1}));
        return;
      }
      await this.layAndChoose([instead && wanted.kind === "place" ? {...wanted, at: instead} : wanted], [face]);
    }
    this.app?.choosePieces(piecesWith(this.app.nets, faces));
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
    const edge = this.app?.selection.hovered?.edge ?? this.app?.selection.single?.edge ?? -1;
    const edit = edge >= 0 ? editByKey(nets, edge, event.key.toLowerCase()) : undefined;
    if (edit) {
      this.edit(() => this.#apply([edit]), edit);
      return true;
    }
    const pieces = this.#pieces();
    const faces = pieces.map((index) => faceOfPiece(nets, index));
    const pinned = this.#pinned();
    const lay = (/** @type {number} */ dx, /** @type {number} */ dy, /** @type {number} */ degrees) =>
      pieces.map((index) => /** @type {App} */ (this.app).plan.moved(index, dx, dy, degrees));
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
    const edits = keys[key]();
    const places = edits.flatMap((one) => (one.kind === "place" ? [one] : []));
    places.length > 0 && pieces.some((index) => this.app?.plan.places.has(index)) ? this.layDown(places) : this.layAndChoose(edits, faces);
    return true;
  }

  /** Of another net: one that wasn't tried here. */
  #seed() {
    return this.backend.history.moments.length;
  }

  /** The pieces that are pinned. */
  #pinned() {
    return new Set(this.app ? piecesWith(this.app.nets, this.state?.pinned ?? []) : []);
  }

  /** Does what is to be done with pieces, and goes on with them. @param {import("./backend.js").Edit[]} edits @param {number[]} faces of them */
  async layAndChoose(edits, faces) {
    const focused = document.activeElement?.closest("[data-piece]") !== null;
    await this.edit(() => this.#apply(edits));
    if (this.app && this.error === "") {
      const pieces = piecesWith(this.app.nets, faces);
      this.app.choosePieces(pieces);
      if (focused && pieces.length > 0) {
        this.app.plan.pieces[pieces[0]].focus();
      }
    }
  }

  // ---- pieces that lie for the moment where they can't stay

  /** Edits that lay pieces somewhere take them from the desk. @param {Edit[]} edits */
  async #apply(edits) {
    const {desk, app} = this;
    const before = new Map(desk.places);
    const faces = edits.flatMap((edit) => (edit.kind === "place" ? [edit.face] : edit.kind === "pack" ? edit.faces : []));
    app && desk.forget(app.nets, edits.some((edit) => edit.kind === "pack" && edit.faces.length === 0) ? [...before.keys()] : faces);
    try {
      return await this.backend.apply(edits);
    } catch (error) {
      desk.places = before;
      throw error;
    }
  }

  /** Lays pieces where they were let go, and with them what finds room then; without room for them they stay there. @param {Place[]} places */
  async layDown(places) {
    const faces = places.map(({face}) => face);
    const all = await this.desk.laid(places, async (asked) => (await this.backend.preview(asked)).ok);
    if (all) {
      await this.layAndChoose(all, faces);
      return;
    }
    const {code, why, faces: seen} = await this.backend.preview(places);
    if (forTheMoment.includes(code ?? "")) {
      this.desk.leave(places, this.backend.history.now?.surface ?? -1);
      this.#showDesk();
      this.app?.choosePieces(piecesWith(this.app.nets, faces));
    } else if (seen) {
      this.app?.markFaces(seen);
    }
    this.refuse(why ?? "");
  }

  /** What lies on the desk is shown there. */
  #showDesk() {
    const {app, state, desk} = this;
    if (app && state) {
      app.plan.loosen(desk.onSheets(app.nets));
      this.told.show(state, this.backend.history);
      /** @type {HTMLButtonElement} */ (byId("undo")).disabled = !state.canUndo && desk.places.size === 0;
    }
  }

  /** The last piece that was left goes back. Whether there was one. */
  #takeBack() {
    const was = this.desk.takeBack();
    if (was) {
      this.refuse("");
      this.#showDesk();
    }
    return was;
  }

  /** That pieces lie where they can't be printed; nothing where none does. */
  #sayLoose() {
    const {app} = this;
    const names = app ? [...this.desk.onSheets(app.nets).keys()].map((index) => app.nets.pieces[index].name) : [];
    return names.length > 0 ? sayCount("loose", names.length).replace("{names}", sayList(names)) : "";
  }

  undo() {
    if (this.editing || !this.#takeBack()) {
      this.goBy(-1);
    }
  }

  redo() {
    this.goBy(1);
  }

  /** Each key counts, however fast they come: the way is gone at once. @param {number} steps back or forth */
  async goBy(steps) {
    this.wantedSteps += steps;
    while (!this.editing && this.wantedSteps !== 0) {
      const {history} = this.backend;
      const to = Math.max(0, Math.min(history.moments.length - 1, history.at + this.wantedSteps));
      this.wantedSteps = 0;
      if (to !== history.at) {
        await this.edit(() => this.backend.go(to));
      }
    }
    this.backend.catchUp().catch(() => {});
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
    await this.run(work, this.app?.view() ?? null);
    takeBack();
    this.editing = false;
    if (edit && this.app && this.error === "") {
      if ("edge" in edit) {
        this.app.markEdge(edit.edge);
      } else if (edit.kind !== "number") {
        this.app.choosePieces(piecesWith(this.app.nets, edit.kind === "pack" ? edit.faces : [edit.face]));
      }
    }
    // What had the focus is gone with the sheets of before.
    const [chosen] = this.app?.selection.chosen ?? [];
    if (document.activeElement === document.body && chosen !== undefined) {
      this.app?.plan.pieces[chosen]?.focus({preventScroll: true});
    }
    if (this.wantedSteps !== 0) {
      await this.goBy(0);
    }
  }

  // ---- work

  /**
   * @param {() => Promise<State>} work
   * @param {import("./app.js").View | null} view to go on with
   */
  async run(work, view) {
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
        this.options = state.options;
        this.show(state, view);
        this.keeper.changed();
      }
    } catch (error) {
      if (run === this.running) {
        this.panel.fill(this.options);
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
    /** @type {App} */
    const app = new App(this.backend, state, view, (spot) => this.#offer(app, spot), (edge) => legendAt(app.nets, edge));
    this.app = app;
    app.plan.drag = new PieceDrag(app.plan, {
      chosen: () => app.selection.chosen,
      turns: () => app.selection.chosenEdge < 0,
      pinned: this.#pinned(),
      fits: (edits, far) => this.backend.preview(edits, far ? wholePageMm : undefined).catch(() => ({ok: false})),
      lay: (places) => this.layDown(places),
    });
    app.printer.whyNot = () => this.#sayLoose();
    app.plan.say();
    /** @type {HTMLButtonElement} */ (byId("redo")).disabled = !state.canRedo;
    const name = this.backend.project?.name ?? "";
    byId("panel-name").textContent = shortName(name, 24);
    byId("panel-name").title = name;
    this.panel.fill(this.options);
    if (!view || this.desk.surface !== this.backend.history.now?.surface) {
      this.desk.places.clear();
    }
    this.#showDesk();
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
    return this.run(() => this.backend.set(options), this.app?.view() ?? null);
  }

  /** Formats that make sense for a printer, or for the machine that was chosen. */
  #formats() {
    const machine = (this.options.preset ?? "print") !== "print";
    return this.backend.capabilities().export.filter((format) =>
      machine ? !["guide", "html", "png"].includes(format) : !["lbrn2", "eps", "plt"].includes(format));
  }

  /** Sheets that differ from those of the PDF that was saved last; all are the same as none. @returns {number[]} */
  #changedSheets() {
    const {printed} = this.keeper;
    const keys = this.app && printed.length > 0 ? sheetKeys(this.app.nets, this.state?.sheets ?? "") : [];
    const changed = changedSheets(keys, printed);
    return changed.length < keys.length ? changed : [];
  }

  /** @param {string} format @param {number[]} [pages] of a PDF, the only ones */
  async save(format, pages) {
    const loose = this.#sayLoose();
    if (loose !== "" && !withoutSheets.includes(format)) {
      this.refuse(loose);
      return false;
    }
    try {
      const {name, bytes} = await this.backend.exportFile(format, pages);
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (bytes)], {type: "application/octet-stream"}));
      link.download = pages ? name.replace(/\.pdf$/, `-${pages.join("-")}.pdf`) : name;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
      if (format === "ridgecraft") {
        this.keeper.wasSaved();
      } else if (format === "pdf" && this.app) {
        this.keeper.wasPrinted(sheetKeys(this.app.nets, this.state?.sheets ?? ""));
      }
      return true;
    } catch (error) {
      this.refuse(error instanceof Error ? error.message : String(error));
      return false;
    }
  }

  /** For whoever tests the page. @param {any} about */
  inspect(about) {
    return {...(this.app ? this.app.inspect(about) : {}), ready: this.ready, project: this.backend.project?.name ?? null, options: this.options,
      figures: this.state?.figures ?? null, busy: this.backend.calls.size > 0 || this.editing || this.app?.plan.drag?.dropping === true, canUndo: this.state?.canUndo ?? false,
      canRedo: this.state?.canRedo ?? false, left: this.state?.left ?? [], loose: this.app ? [...this.desk.onSheets(this.app.nets).keys()] : [], history: this.backend.history.moments.map(({what}) => what.kind), moment: this.backend.history.at,
      kept: this.keeper.kept !== null && this.keeper.kept === this.backend.history.now, unsaved: this.keeper.unsaved,  pinned: [...this.#pinned()], offer: this.offer.box.hidden ? null : {edits: this.offer.edits, words: this.offer.words.textContent}, error: this.error, notes: this.state?.notes ?? []};
  }
}
