// SPDX-License-Identifier: GPL-3.0-or-later
// Projects that this browser keeps (IndexedDB), so that a page that is closed or crashes loses nothing.

/** @typedef {import("./worker_backend.js").SavedProject} SavedProject */

/**
 * @typedef {object} Kept
 * @property {string} id
 * @property {string} name of the model's file
 * @property {number} time it was kept, ms
 * @property {string} picture an address of data, or nothing
 * @property {string[]} printed what was printed last (web/printed.js)
 * @property {Omit<SavedProject, "files">} project
 */

/** That are kept. */
export const mostKept = 5;

/** @template T @param {IDBRequest<T>} request @returns {Promise<T>} */
const answer = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

/** @param {IDBTransaction} transaction @returns {Promise<void>} when it is on the disk */
const done = (transaction) => new Promise((resolve, reject) => {
  transaction.oncomplete = () => resolve();
  transaction.onabort = () => reject(transaction.error);
  transaction.onerror = () => reject(transaction.error);
});

/** @param {IDBTransaction} transaction @param {string} id */
function removeIn(transaction, id) {
  transaction.objectStore("projects").delete(id);
  transaction.objectStore("files").delete(id);
}

export class Shelf {
  /** @param {IDBDatabase} base */
  constructor(base) {
    this.base = base;
    /** The project whose files are there already. */
    this.filesOf = "";
    /** @type {Record<string, Uint8Array> | null} */
    this.files = null;
  }

  /** Throws where this browser keeps nothing for this page. */
  static async open() {
    const request = indexedDB.open("ridgecraft", 1);
    request.onupgradeneeded = () => {
      request.result.createObjectStore("projects", {keyPath: "id"});
      request.result.createObjectStore("files");
    };
    return new Shelf(await answer(request));
  }

  /** @param {string[]} stores @param {IDBTransactionMode} mode */
  #begin(stores, mode) {
    return this.base.transaction(stores, mode, {durability: "strict"});
  }

  /** Files are written where they are others than before. @param {Kept} kept @param {Record<string, Uint8Array>} files */
  async put(kept, files) {
    const transaction = this.#begin(["projects", "files"], "readwrite");
    const projects = transaction.objectStore("projects");
    projects.put(kept);
    if (this.filesOf !== kept.id || this.files !== files) {
      transaction.objectStore("files").put(files, kept.id);
    }
    /** @type {Kept[]} */
    const all = await answer(projects.getAll());
    for (const {id} of all.sort((a, b) => b.time - a.time).slice(mostKept)) {
      removeIn(transaction, id);
    }
    await done(transaction);
    Object.assign(this, {filesOf: kept.id, files});
  }

  /** The last one first. @returns {Promise<Kept[]>} */
  async list() {
    /** @type {Kept[]} */
    const all = await answer(this.#begin(["projects"], "readonly").objectStore("projects").getAll());
    return all.sort((a, b) => b.time - a.time);
  }

  /** @param {Kept} kept @returns {Promise<SavedProject>} */
  async get({id, project}) {
    const files = await answer(this.#begin(["files"], "readonly").objectStore("files").get(id));
    Object.assign(this, {filesOf: id, files});
    return {...project, files};
  }

  async clear() {
    const transaction = this.#begin(["projects", "files"], "readwrite");
    transaction.objectStore("projects").clear();
    transaction.objectStore("files").clear();
    this.filesOf = "";
    await done(transaction);
  }
}
