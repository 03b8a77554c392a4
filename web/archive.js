// SPDX-License-Identifier: GPL-3.0-or-later
// Several files as one: a ZIP archive without compression (PKWARE's APPNOTE.TXT, 4.3), dated 1 January 1980.

/** @type {Uint32Array | null} */
let crcs = null;

/** @param {Uint8Array} bytes the checksum of ZIP: polynomial 0xEDB88320 */
function checksumOf(bytes) {
  crcs ??= new Uint32Array(256).map((_, i) => {
    for (let k = 0; k < 8; ++k) {
      i = i & 1 ? (i >>> 1) ^ 0xedb88320 : i >>> 1;
    }
    return i;
  });
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc = crcs[(crc ^ byte) & 255] ^ (crc >>> 8);
  }
  return (crc ^ 0xffffffff) >>> 0;
}

/**
 * @param {{name: string, bytes: Uint8Array}[]} files
 * @returns {Uint8Array}
 */
export function zipOf(files) {
  /** @type {Uint8Array[]} */
  const pieces = [];
  /** @type {Uint8Array[]} */
  const directory = [];
  let offset = 0;
  const fields = (/** @type {[number, number][]} */ list) => {
    const bytes = new Uint8Array(list.reduce((sum, [size]) => sum + size, 0));
    let at = 0;
    for (const [size, value] of list) {
      for (let k = 0; k < size; ++k) {
        bytes[at++] = Math.floor(value / 256 ** k) & 255;
      }
    }
    return bytes;
  };
  for (const {name, bytes} of files) {
    const title = new TextEncoder().encode(name);
    // Version 2.0, names in UTF-8, stored, the first day of its calendar, sum and sizes, length of the name.
    /** @type {[number, number][]} */
    const common = [[2, 20], [2, 0x800], [2, 0], [2, 0], [2, 0x21], [4, checksumOf(bytes)], [4, bytes.length], [4, bytes.length],
      [2, title.length], [2, 0]];
    const head = fields([[4, 0x04034b50], ...common]);
    pieces.push(head, title, bytes);
    directory.push(fields([[4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]), title);
    offset += head.length + title.length + bytes.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  pieces.push(...directory, fields([[4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, size], [4, offset], [2, 0]]));
  const whole = new Uint8Array(pieces.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of pieces) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}
