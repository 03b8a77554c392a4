// SPDX-License-Identifier: GPL-3.0-or-later
// The backend with the whole program in it, as WebAssembly in a worker. The project is a value here, in the page: model,
// files beside it, options. So whatever ends a worker, a request to cancel or a lack of memory, the next one goes on from it.

import {zipOf} from "./archive.js";
import {NotEditable} from "./backend.js";
import {Carrier, isSameSurface, surfaceOf} from "./carry.js";
import {changedKeys, History} from "./history.js";
import {proposalOf, saySentence} from "./studio_words.js";
import {optionTable, wordsOf} from "./options.js";
import {say, sayMessage} from "./words.js";

/** @typedef {import("./backend.js").State} State */

/** Refusals where the edge is meant that was clicked, not all that lies around it. */
const ofTheEdge = new Set(["closes_loop", "cut_parts_nothing", "inside_flat_region", "cut_already", "fold_already", "nothing_to_cut", "nothing_to_join",
  "larger_than_paper", "wouldnt_fold_together", "pages_differ", "only_glued_edges", "made_without_tabs"]);

/** @param {import("./words.js").Message} message @param {number[]} faces */
const facesToSee = ({code}, faces) => (ofTheEdge.has(code) ? [] : faces);

/** Why the program doesn't do what was asked. */
export class Refusal extends Error {
  /** @param {string} sentence @param {number[]} [faces] of the model, that are to be looked at
   * @param {{option: string, value: string} | null} [proposal] an option that would help */
  constructor(sentence, faces = [], proposal = null) {
    super(sentence);
    this.name = "Refusal";
    this.faces = faces;
    this.proposal = proposal;
  }

  /** @param {import("./words.js").Message} message @param {number[]} [faces] */
  static of(message, faces = []) {
    return new Refusal(saySentence(message), facesToSee(message, faces), proposalOf(message));
  }
}

/** Somebody cancelled. */
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}

/**
 * @typedef {object} Project
 * @property {string} name of the model's file
 * @property {Record<string, Uint8Array>} files it, and those that belong to it
 * @property {Record<string, string | boolean>} options
 * @property {string[]} rest words of a command line that are no options of the panel
 * @property {string[]} steps what was done by hand, in the words of session/edit.hpp
 *
 * What outlives the page.
 * @typedef {{name: string, files: Record<string, Uint8Array>, rest: string[], history: import("./history.js").Saved}} SavedProject
 */

/** The model in the program's words: names that could be options or verbs are paths. @param {string} name */
const asModel = (name) => (/^[^-].*\./.test(name) ? name : `./${name}`);

/** In the words of session/edit.hpp. @param {import("./backend.js").Edit[]} edits */
const lineOf = (edits) => edits.map((edit) => {
  const values = edit.kind === "place" ? [edit.face, edit.page, ...edit.at, edit.degrees] : edit.kind === "retry" ? [edit.face, edit.seed]
    : edit.kind === "pack" ? edit.faces : edit.kind === "number" ? [] : edit.kind === "tab-shape" ? [...edit.edge, edit.height, edit.degrees] : "edge" in edit ? edit.edge : [edit.face];
  return [edit.kind, ...values].join(" ");
}).join("; ");

/** As far from where a piece is held as anybody would take for what they meant. */
const nearbyMm = 15;

/** Whether the worker has these files and options. @param {{files: Record<string, Uint8Array>, words: string}} held @param {Project} project */
const isSame = (held, {name, files, rest, options}) =>
  held.files === files && held.words === [asModel(name), ...rest, ...wordsOf(options)].join("\n");

/** The surface that edits name; none where a file has none. @param {string} fold */
function surfaceIn(fold) {
  try {
    return surfaceOf(fold);
  } catch {
    return null;
  }
}

/** No folders in the module's file system. @param {string} name */
const bareName = (name) => name.replace(/^.*[\\/]/, "") || "model";

/** @implements {Backend} @typedef {import("./backend.js").Backend} Backend */
export class WorkerBackend {
  /**
   * @param {string} source of the worker: the module's glue and web/worker.js
   * @param {Promise<WebAssembly.Module>} module
   * @param {string} version
   */
  constructor(source, module, version) {
    this.address = URL.createObjectURL(new Blob([source], {type: "text/javascript"}));
    this.module = module;
    this.version = version;
    /** @type {Project | null} */
    this.project = null;
    this.revision = 0;
    /** @type {Worker | null} */
    this.worker = null;
    /** Whether the worker has started. */
    this.usable = false;
    this.history = new History();
    /** What the worker has made paper of. @type {{files: Record<string, Uint8Array>, words: string, live: string[]} | null} */
    this.held = null;
    /** @type {Promise<unknown> | null} */
    this.catching = null;
    /** @type {Map<number, {resolve: (answer: any) => void, reject: (error: Error) => void}>} */
    this.calls = new Map();
    this.lastCall = 0;
    /** @type {((stage: string, share: number) => void)[]} */
    this.progressListeners = [];
    /** @type {((note: State["notes"][number]) => void)[]} */
    this.noteListeners = [];
    /** @type {State["notes"]} */
    this.notes = [];
  }

  capabilities() {
    return {edit: true, export: ["pdf", "guide", "svg", "html", "ridgecraft", "fold", "dxf", "png", "lbrn2", "eps", "plt"], version: this.version};
  }

  /** @param {(stage: string, share: number) => void} listener */
  onProgress(listener) {
    this.progressListeners.push(listener);
  }

  /** @param {(note: State["notes"][number]) => void} listener */
  onNote(listener) {
    this.noteListeners.push(listener);
  }

  /** Begins to load the module, so that the first model doesn't wait for it. */
  warm() {
    return this.#started();
  }

  /**
   * @param {string} name
   * @param {Uint8Array} bytes
   * @param {Record<string, Uint8Array>} sidecars
   * @param {Record<string, string | boolean>} [options]
   * @param {string[]} [rest]
   * @param {string[]} [steps] what was done by hand already
   * @returns {Promise<State>}
   */
  async open(name, bytes, sidecars = {}, options = {}, rest = [], steps = []) {
    /** @type {Record<string, Uint8Array>} */
    const files = {};
    for (const [sidecar, content] of Object.entries(sidecars)) {
      files[bareName(sidecar)] = content;
    }
    files[bareName(name)] = bytes;
    const project = {name: bareName(name), files, options, rest, steps};
    const history = new History();
    Object.assign(history, {lines: [...steps], bases: steps.map(() => -1)});
    const made = await this.#make(project, history);
    Object.assign(this, {project, history});
    history.bases.fill(made.surface);
    history.add({options, count: steps.length, what: {kind: "open"}, ...made});
    return this.#shown(made.state);
  }

  /** A project as it was saved, with its history. @param {SavedProject} saved @returns {Promise<State>} */
  async restore({name, files, rest, history: saved}) {
    const history = History.restored(saved);
    const moment = /** @type {import("./history.js").Moment} */ (history.now);
    const project = {name, files, rest, options: moment.options, steps: history.steps(moment)};
    Object.assign(moment, await this.#make(project, history));
    Object.assign(this, {history, project});
    return this.#shown(/** @type {State} */ (moment.state));
  }

  /** @returns {SavedProject | null} */
  saved() {
    const {project, history} = this;
    return project && {name: project.name, files: project.files, rest: project.rest, history: history.save()};
  }

  /** Files that belong to the model and come later: its pictures. @param {Record<string, Uint8Array>} more @returns {Promise<State>} */
  async addFiles(more) {
    const {project, history} = this;
    if (!project || !history.now) {
      throw new NotEditable();
    }
    const next = {...project, files: {...project.files, ...more}};
    const made = await this.#make(next, history);
    this.project = next;
    history.forgetAll();
    Object.assign(history.now, made);
    return this.#shown(made.state);
  }

  /** @param {Record<string, string | boolean>} options those that change @returns {Promise<State>} */
  async set(options) {
    const {project, history} = this;
    if (!project) {
      throw new NotEditable();
    }
    const next = {...project.options, ...options};
    const made = await this.#make({...project, options: next}, history);
    this.project = {...project, options: next};
    history.add({options: next, count: project.steps.length, ...made, what: {kind: "options", keys: changedKeys(project.options, next, optionTable)}});
    return this.#shown(made.state);
  }

  /** @param {import("./backend.js").Edit[]} edits @returns {Promise<State>} */
  async apply(edits) {
    const line = lineOf(edits);
    const {held, project} = await this.#inStep();
    const result = await this.#call({call: "apply", line});
    if (result.refused) {
      throw Refusal.of(result.refused.why, result.refused.faces);
    }
    held.live.push(line);
    const {history} = this;
    const steps = [...project.steps, line];
    const {left = [], surface} = /** @type {import("./history.js").Moment} */ (history.now);
    this.project = {...project, steps};
    const state = this.#state(this.project, result, left);
    history.add({options: project.options, count: steps.length, left, live: [...held.live], surface, state, what: {kind: "edits", edits: edits.map(({kind}) => kind)}}, line);
    return this.#shown(state);
  }

  /** @returns {Promise<State>} */
  undo() {
    return this.go(this.history.at - 1);
  }

  /** @returns {Promise<State>} */
  redo() {
    return this.go(this.history.at + 1);
  }

  /** To another place in the history; results that are kept are there at once, and the program comes after. @param {number} to
   * @returns {Promise<State>} */
  async go(to) {
    const {project, history} = this;
    const moment = history.moments[to];
    if (!project || !moment) {
      throw new NotEditable();
    }
    const target = {...project, options: moment.options, steps: history.steps(moment)};
    if (!moment.state) {
      Object.assign(moment, await this.#bring(target, moment));
    }
    history.at = to;
    this.project = target;
    return this.#shown(/** @type {State} */ (moment.state));
  }

  /** Lets the program come to where the history is, so that what is done next doesn't wait for it. */
  async catchUp() {
    await this.#inStep();
  }

  /** @param {import("./backend.js").Edit[]} edits @param {number} [reach] mm to another place of a piece @returns {Promise<{ok: boolean, code?: string, why?: string, faces?: number[], instead?: number[]}>} */
  async preview(edits, reach = nearbyMm) {
    await this.#inStep();
    const {refused, instead} = await this.#call({call: "preview", line: lineOf(edits), reach});
    return refused ? {ok: false, code: refused.why.code, why: saySentence(refused.why), faces: facesToSee(refused.why, refused.faces), instead} : {ok: true};
  }

  /** @param {string} format @returns {Promise<Uint8Array>} */
  async export(format) {
    return (await this.exportFile(format)).bytes;
  }

  /**
   * The bytes of a format under the name of a file: formats with a file per page come as an archive of them.
   * @param {string} format
   * @param {number[]} [pages] of a PDF, the only ones, from 1
   * @returns {Promise<{name: string, bytes: Uint8Array}>}
   */
  async exportFile(format, pages) {
    const {project: {name}} = await this.#inStep();
    const title = name.replace(/\.[^.]*$/, "");
    const {files} = await this.#call({call: "write", name: format === "guide" ? `${title}-guide.pdf` : `${title}.${format}`, pages});
    return files.length === 1 ? files[0] : {name: `${title}-${format}.zip`, bytes: zipOf(files)};
  }

  /** Ends what is running; its promise is rejected, and the project stays the one before. */
  cancel() {
    if (this.calls.size > 0) {
      this.#end(new Cancelled());
    }
  }

  // ---- the worker

  /** Whether the worker has what the history shows. */
  #isInStep() {
    const {held, project, history} = this;
    return held !== null && project !== null && isSame(held, project) && history.now?.live !== undefined
      && held.live.join("\n") === history.now.live.join("\n");
  }

  /** The project, whose paper the worker has then: it may have been ended, or be elsewhere in the history. */
  async #inStep() {
    if (!this.project) {
      throw new NotEditable();
    }
    while (!this.#isInStep()) {
      const {project, history: {now}} = this;
      this.catching ??= this.#bring(project, /** @type {import("./history.js").Moment} */ (now)).then((brought) => {
        Object.assign(/** @type {object} */ (now), brought);
      }).finally(() => {
        this.catching = null;
      });
      await this.catching;
    }
    return {project: this.project, held: /** @type {NonNullable<WorkerBackend["held"]>} */ (this.held)};
  }

  /** The worker goes there the shortest way. @param {Project} project @param {import("./history.js").Moment} moment
   * @returns {Promise<Made>} */
  async #bring(project, moment) {
    const {held, history} = this;
    const {left, live, surface} = moment;
    if (!held || !left || !live || surface === undefined || !isSame(held, project)) {
      return this.#make(project, history);
    }
    let common = 0;
    while (common < live.length && live[common] === held.live[common]) {
      ++common;
    }
    let result = common < held.live.length ? await this.#call({call: "undo", count: held.live.length - common}) : null;
    held.live.length = common;
    for (const line of live.slice(common)) {
      result = await this.#call({call: "apply", line});
      held.live.push(line);
    }
    return {state: this.#state(project, result ?? await this.#call({call: "show"}), left), left, live, surface};
  }

  /**
   * @param {Project} project
   * @param {History} history whose first steps the project has
   * @returns {Promise<Made>}
   *
   * What came of a project: steps that aren't possible, and the others by the names of its surface.
   * @typedef {{state: State, left: number[], live: string[], surface: number}} Made
   */
  async #make(project, history) {
    // A newer request ends the one before.
    this.cancel();
    this.notes = [];
    this.held = null;
    const words = [asModel(project.name), ...project.rest, ...wordsOf(project.options)];
    let result = await this.#call({call: "make", files: project.files, words});
    const surface = surfaceIn(result.fold);
    const carried = this.#carried(project.steps, history, surface);
    const there = [...carried.keys()].filter((i) => carried[i] !== null);
    /** @type {number[]} */
    let leftOut = [];
    if (there.length > 0) {
      result = await this.#call({call: "repeat", steps: there.map((i) => carried[i])});
      leftOut = (result.left_out ?? []).map((/** @type {number} */ k) => there[k]);
    }
    const left = [...carried.keys()].filter((i) => carried[i] === null || leftOut.includes(i));
    const live = there.filter((i) => !leftOut.includes(i)).map((i) => String(carried[i]));
    this.held = {files: project.files, words: words.join("\n"), live: [...live]};
    return {state: this.#state(project, result, left), left, live, surface: history.numberOf(surface)};
  }

  /** The steps by the names of a surface; none for what isn't there. @param {string[]} steps @param {History} history
   * @param {import("./carry.js").Surface | null} surface @returns {(string | null)[]} */
  #carried(steps, {bases, surfaces}, surface) {
    /** @type {Map<number, Carrier | null>} */
    const carriers = new Map();
    return steps.map((line, i) => {
      const base = surfaces[bases[i]];
      if (!base || !surface) {
        return line;
      }
      if (!carriers.has(bases[i])) {
        carriers.set(bases[i], isSameSurface(base, surface) ? null : new Carrier(base, surface));
      }
      const carrier = carriers.get(bases[i]);
      return carrier ? carrier.line(line) : line;
    });
  }

  /** @param {Project} project @param {any} result @param {number[]} left @returns {State} */
  #state(project, result, left) {
    return {revision: 0, options: project.options, fold: result.fold, sheets: result.sheets, notes: this.notes, figures: result.summary,
      canUndo: false, canRedo: false, busy: false, pinned: result.pinned ?? [], left: left.map((i) => project.steps[i])};
  }

  /** @param {State} state @returns {State} */
  #shown(state) {
    this.revision += 1;
    const {canUndo, canRedo} = this.history;
    return {...state, revision: this.revision, canUndo, canRedo};
  }

  /** @param {Record<string, unknown>} message @returns {Promise<any>} */
  async #call(message) {
    await this.#started();
    return this.#send(message);
  }

  /** @param {Record<string, unknown>} message @returns {Promise<any>} */
  #send(message) {
    return new Promise((resolve, reject) => {
      const id = ++this.lastCall;
      this.calls.set(id, {resolve, reject});
      this.worker?.postMessage({id, ...message});
    });
  }

  async #started() {
    if (!this.worker) {
      const worker = new Worker(this.address);
      this.worker = worker;
      worker.onmessage = ({data}) => this.#heard(worker, data);
      worker.onerror = (event) => {
        event.preventDefault();
        if (worker === this.worker) {
          this.#end(new Refusal(say("stopped", {why: event.message})));
        }
      };
      this.usable = false;
      this.ready = this.module.then((module) => this.#send({call: "start", module})).then(() => {
        this.usable = true;
      });
    }
    await this.ready;
  }

  /** @param {Worker} worker @param {any} data */
  #heard(worker, data) {
    if (worker !== this.worker) {
      return;
    }
    if (data.stage !== undefined) {
      this.progressListeners.forEach((listener) => listener(data.stage, data.share));
    } else if (data.note !== undefined) {
      const note = {text: sayMessage(data.note), code: data.note.code};
      this.notes.push(note);
      this.noteListeners.forEach((listener) => listener(note));
    } else if (data.broken !== undefined) {
      this.#end(new Refusal(/memory|stack|call size/i.test(data.broken) ? say("too_large") : say("stopped", {why: data.broken})));
    } else {
      const call = this.calls.get(data.id);
      this.calls.delete(data.id);
      data.error ? call?.reject(Refusal.of(data.error.message)) : call?.resolve(data);
    }
  }

  /** The worker goes, and with it the paper that it has made. @param {Error} error that its calls end with */
  #end(error) {
    this.worker?.terminate();
    this.worker = null;
    this.held = null;
    const calls = [...this.calls.values()];
    this.calls.clear();
    calls.forEach(({reject}) => reject(error));
    // The next one is ready before it is asked for; where none could be started, none is tried by itself.
    if (this.usable || error instanceof Cancelled) {
      this.#started().catch(() => {});
    }
  }
}
