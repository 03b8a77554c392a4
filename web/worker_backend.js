// SPDX-License-Identifier: GPL-3.0-or-later
// The backend with the whole program in it, as WebAssembly in a worker. The project is a value here, in the page: model,
// files beside it, options. So whatever ends a worker, a request to cancel or a lack of memory, the next one goes on from it.

import {zipOf} from "./archive.js";
import {NotEditable} from "./backend.js";
import {proposalOf, saySentence} from "./studio_words.js";
import {wordsOf} from "./options.js";
import {say, sayCount, sayMessage} from "./words.js";

/** @typedef {import("./backend.js").State} State */

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
    return new Refusal(saySentence(message), faces, proposalOf(message));
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
 * @property {string[]} undone of these, the last one first to come back
 */

/** The model in the program's words: names that could be options or verbs are paths. @param {string} name */
const asModel = (name) => (/^[^-].*\./.test(name) ? name : `./${name}`);

/** In the words of session/edit.hpp. @param {import("./backend.js").Edit[]} edits */
const lineOf = (edits) => edits.map((edit) => {
  const values = edit.kind === "place" ? [edit.face, edit.page, ...edit.at, edit.degrees] : edit.kind === "retry" ? [edit.face, edit.seed]
    : edit.kind === "pack" ? edit.faces : "edge" in edit ? edit.edge : [edit.face];
  return [edit.kind, ...values].join(" ");
}).join("; ");

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
    /** Whether it has the project's paper. */
    this.made = false;
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
    return {edit: true, export: ["pdf", "guide", "svg", "html", "fold", "dxf", "png", "lbrn2", "eps", "plt"], version: this.version};
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
   * @returns {Promise<State>}
   */
  open(name, bytes, sidecars = {}, options = {}, rest = []) {
    /** @type {Record<string, Uint8Array>} */
    const files = {};
    for (const [sidecar, content] of Object.entries(sidecars)) {
      files[bareName(sidecar)] = content;
    }
    files[bareName(name)] = bytes;
    return this.#make({name: bareName(name), files, options, rest, steps: [], undone: []});
  }

  /** @param {Record<string, string | boolean>} options those that change @returns {Promise<State>} */
  set(options) {
    if (!this.project) {
      return Promise.reject(new NotEditable());
    }
    return this.#make({...this.project, options: {...this.project.options, ...options}});
  }

  /** @param {import("./backend.js").Edit[]} edits @returns {Promise<State>} */
  apply(edits) {
    const line = lineOf(edits);
    return this.#change({call: "apply", line}, ({steps}) => ({steps: [...steps, line], undone: []}));
  }

  /** @returns {Promise<State>} */
  undo() {
    return this.#change({call: "undo"}, ({steps, undone}) => ({steps: steps.slice(0, -1), undone: [...undone, ...steps.slice(-1)]}));
  }

  /** @returns {Promise<State>} */
  redo() {
    const line = this.project?.undone.at(-1);
    // Equal edits give equal bytes, so what was undone is done again.
    return this.#change({call: "apply", line}, ({steps, undone}) => ({steps: [...steps, ...undone.slice(-1)], undone: undone.slice(0, -1)}));
  }

  /** @param {import("./backend.js").Edit[]} edits @returns {Promise<{ok: boolean, why?: string, faces?: number[], instead?: number[]}>} */
  async preview(edits) {
    await this.#remade();
    const {refused, instead} = await this.#call({call: "preview", line: lineOf(edits)});
    return refused ? {ok: false, why: saySentence(refused.why), faces: refused.faces, instead} : {ok: true};
  }

  /** @param {string} format @returns {Promise<Uint8Array>} */
  async export(format) {
    return (await this.exportFile(format)).bytes;
  }

  /**
   * The bytes of a format under the name of a file: formats with a file per page come as an archive of them.
   * @param {string} format
   * @returns {Promise<{name: string, bytes: Uint8Array}>}
   */
  async exportFile(format) {
    const {name} = await this.#remade();
    const title = name.replace(/\.[^.]*$/, "");
    const {files} = await this.#call({call: "write", name: format === "guide" ? `${title}-guide.pdf` : `${title}.${format}`});
    return files.length === 1 ? files[0] : {name: `${title}-${format}.zip`, bytes: zipOf(files)};
  }

  /** Ends what is running; its promise is rejected, and the project stays the one before. */
  cancel() {
    if (this.calls.size > 0) {
      this.#end(new Cancelled());
    }
  }

  // ---- the worker

  /** The project, whose paper the worker has: it may have been ended. @returns {Promise<Project>} */
  async #remade() {
    if (!this.project) {
      throw new NotEditable();
    }
    if (!this.made) {
      await this.#make(this.project);
    }
    return this.project;
  }

  /** @param {Project} project @returns {Promise<State>} */
  async #make(project) {
    // A newer request ends the one before.
    this.cancel();
    this.notes = [];
    this.made = false;
    const result = await this.#call({call: "make", files: project.files, words: [asModel(project.name), ...project.rest, ...wordsOf(project.options)],
      steps: project.steps});
    this.made = true;
    /** @type {number[]} */
    const leftOut = result.left_out ?? [];
    if (leftOut.length > 0) {
      this.notes.push({text: sayCount("edits_left_out", leftOut.length)});
    }
    return this.#state({...project, steps: project.steps.filter((_, i) => !leftOut.includes(i))}, result);
  }

  /**
   * @param {Record<string, unknown>} message
   * @param {(project: Project) => {steps: string[], undone: string[]}} after the steps that it leaves
   * @returns {Promise<State>}
   */
  async #change(message, after) {
    await this.#remade();
    const result = await this.#call(message);
    if (result.refused) {
      throw Refusal.of(result.refused.why, result.refused.faces);
    }
    const project = /** @type {Project} */ (this.project);
    return this.#state({...project, ...after(project)}, result);
  }

  /** @param {Project} project @param {any} result @returns {State} */
  #state(project, result) {
    this.project = project;
    this.revision += 1;
    return {revision: this.revision, options: project.options, fold: result.fold, sheets: result.sheets, notes: this.notes, figures: result.summary,
      canUndo: project.steps.length > 0, canRedo: project.undone.length > 0, busy: false, pinned: result.pinned ?? []};
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
      const note = {text: sayMessage(data.note)};
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
    this.made = false;
    const calls = [...this.calls.values()];
    this.calls.clear();
    calls.forEach(({reject}) => reject(error));
    // The next one is ready before it is asked for; where none could be started, none is tried by itself.
    if (this.usable || error instanceof Cancelled) {
      this.#started().catch(() => {});
    }
  }
}
