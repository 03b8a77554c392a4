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

/** Of what an archive holds, unpacked. */
const mostUnpacked = 2 ** 31;

/** @param {Uint8Array} bytes */
export const isZip = (bytes) => bytes[0] === 0x50 && bytes[1] === 0x4b && bytes[2] < 7;

/** The end of the directory is at most so far from the end of the archive. */
const longestEnd = 22 + 65535;

/**
 * The files of a ZIP archive, stored or deflated. Throws an Error where it is damaged.
 * @param {Uint8Array} bytes
 * @returns {Promise<{name: string, bytes: Uint8Array}[]>}
 */
export async function filesOfZip(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  let end = bytes.length - 22;
  while (end >= 0 && end > bytes.length - longestEnd && view.getUint32(end, true) !== 0x06054b50) {
    --end;
  }
  if (end < 0 || view.getUint32(end, true) !== 0x06054b50) {
    throw new Error("no directory");
  }
  const files = [];
  let unpacked = 0;
  let at = view.getUint32(end + 16, true);
  for (let count = view.getUint16(end + 10, true); count > 0; --count) {
    if (view.getUint32(at, true) !== 0x02014b50) {
      throw new Error("damaged directory");
    }
    const [method, packed, size] = [view.getUint16(at + 10, true), view.getUint32(at + 20, true), view.getUint32(at + 24, true)];
    const [nameLength, extra, comment] = [28, 30, 32].map((offset) => view.getUint16(at + offset, true));
    const name = new TextDecoder().decode(bytes.subarray(at + 46, at + 46 + nameLength));
    const head = view.getUint32(at + 42, true);
    const begin = head + 30 + view.getUint16(head + 26, true) + view.getUint16(head + 28, true);
    unpacked += size;
    if (unpacked > mostUnpacked) {
      throw new Error("too large");
    }
    if (!name.endsWith("/")) {
      files.push({name, bytes: await unpackedFile(bytes.subarray(begin, begin + packed), method, size)});
    }
    at += 46 + nameLength + extra + comment;
  }
  return files;
}

/** Never more than the directory says. @param {Uint8Array} packed @param {number} method @param {number} size */
async function unpackedFile(packed, method, size) {
  if (method === 0) {
    return packed.slice();
  }
  const whole = new Uint8Array(size);
  let filled = 0;
  const reader = new Blob([/** @type {BlobPart} */ (packed)]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    if (filled + part.value.length > size) {
      throw new Error("other size");
    }
    whole.set(part.value, filled);
    filled += part.value.length;
  }
  if (filled !== size) {
    throw new Error("cut off");
  }
  return whole;
}
