// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in the studio's page: packed more tightly than browsers unpack by themselves, so a small module of WebAssembly
// does it (wasm/unpack.c), a portion at a time, and the page can be used meanwhile.

import {bytesOfLetters} from "./packed.js";

/** @typedef {{memory: WebAssembly.Memory, begin: (packed: number, unpacked: number) => number, unpack: (wanted: number) => number}} Core */

/** What is unpacked without a pause: some 20 ms. */
const portion = 1 << 20;

export class Unpacker {
  /** @param {Core} core @param {Uint8Array} packed @param {number} total bytes of all that is packed */
  constructor(core, packed, total) {
    this.core = core;
    this.total = total;
    this.given = 0;
    const place = core.begin(packed.length, total);
    new Uint8Array(core.memory.buffer).set(packed, place);
  }

  /**
   * @param {BufferSource} code of the module that unpacks
   * @param {string} letters
   * @param {number} total
   */
  static async started(code, letters, total) {
    const core = new WebAssembly.Instance(await WebAssembly.compile(code)).exports;
    return new Unpacker(/** @type {any} */ (core), bytesOfLetters(letters), total);
  }

  /** The next so many bytes. @param {number} count */
  next(count) {
    const end = Math.min(this.given + count, this.total);
    const place = this.core.unpack(end);
    const bytes = new Uint8Array(this.core.memory.buffer).slice(place + this.given, place + end);
    this.given = end;
    return bytes;
  }

  /** The next so many bytes as text. @param {number} count */
  text(count) {
    return new TextDecoder().decode(this.next(count));
  }

  /** All that is left. */
  rest() {
    return new ReadableStream({
      pull: async (controller) => {
        // Whatever else the page has to do comes in between.
        await new Promise((go) => setTimeout(go));
        if (this.given < this.total) {
          controller.enqueue(this.next(portion));
        } else {
          controller.close();
        }
      },
    });
  }
}
