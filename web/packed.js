// SPDX-License-Identifier: GPL-3.0-or-later
// Text that stands packed in the page (export/formats/packed_text.hpp): letters of seven bits, and what deflate made of it.
// Browsers have a DecompressionStream of their own, but tablets that are a few years old don't, and they do for building.

/** Letters that stand for seven bits and those behind them: NUL, CR and "<", which a page can't hold. */
const takenCodes = [0, 13, 60];

/** The bytes that letters stand for; there may be a zero byte more. @param {string} letters */
export function bytesOfLetters(letters) {
  const bytes = new Uint8Array(Math.ceil(letters.length * 7 / 4));
  let size = 0;
  let held = 0;
  let bits = 0;
  for (let i = 0; i < letters.length; ++i) {
    const code = letters.charCodeAt(i);
    if (code < 128) {
      held = held << 7 | code;
      bits += 7;
    } else {
      held = held << 14 | takenCodes[(code >> 7) - 2] << 7 | code & 127;
      bits += 14;
    }
    while (bits > 7) {
      bits -= 8;
      bytes[size++] = held >> bits;
    }
  }
  return bytes.subarray(0, size);
}

/** Of each pattern of as many bits as the longest code has, read backwards: the symbol, and the length of its code. @param {number[]} lengths */
function tableOf(lengths) {
  const most = Math.max(1, ...lengths);
  const table = new Uint16Array(1 << most);
  let code = 0;
  for (let length = 1; length <= most; ++length) {
    lengths.forEach((own, symbol) => {
      if (own === length) {
        let pattern = 0;
        for (let bit = 0; bit < length; ++bit) {
          pattern |= (code >> bit & 1) << (length - 1 - bit);
        }
        for (; pattern < table.length; pattern += 1 << length) {
          table[pattern] = symbol << 4 | length;
        }
        ++code;
      }
    });
    code <<= 1;
  }
  return {table, most};
}

/** Of lengths and distances: the least of each symbol, and how many bits tell what is added. @param {number} count @param {number} same how many have as many bits @param {number} least */
function rangesOf(count, same, least) {
  const ranges = [];
  for (let symbol = 0; symbol < count; ++symbol) {
    const more = Math.max(0, Math.floor(symbol / same) - 1);
    ranges.push([least, more]);
    least += 1 << more;
  }
  return ranges;
}
const copyLengths = rangesOf(28, 4, 3).concat([[258, 0]]);
const copyDistances = rangesOf(30, 2, 1);
const lengthOrder = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

/** What zlib has packed (RFC 1950, 1951). @param {Uint8Array} packed */
export function inflate(packed) {
  let out = new Uint8Array(8 * packed.length);
  let size = 0;
  // Behind two bytes that say how it was packed.
  let at = 2;
  let held = 0;
  let bits = 0;
  /** @param {number} count */
  const need = (count) => {
    for (; bits < count; bits += 8) {
      held |= packed[at++] << bits;
    }
    // The last code may look at some bits behind the end.
    if (at > packed.length + 2) {
      throw new Error("this file isn't whole");
    }
  };
  /** @param {number} count */
  const take = (count) => {
    need(count);
    const value = held & (1 << count) - 1;
    held >>>= count;
    bits -= count;
    return value;
  };
  /** @param {{table: Uint16Array, most: number}} code */
  const symbolOf = ({table, most}) => {
    need(most);
    const found = table[held & (1 << most) - 1];
    if (found === 0) {
      throw new Error("this file isn't whole");
    }
    held >>>= found & 15;
    bits -= found & 15;
    return found >> 4;
  };
  /** @param {number} count */
  const room = (count) => {
    if (size + count > out.length) {
      const larger = new Uint8Array(2 * out.length + count);
      larger.set(out);
      out = larger;
    }
  };
  for (let last = 0; last === 0;) {
    last = take(1);
    const kind = take(2);
    if (kind === 0) {
      // As it was, from the next whole byte on.
      take(bits & 7);
      const count = take(16);
      take(16);
      room(count);
      at -= bits >> 3;
      held = bits = 0;
      out.set(packed.subarray(at, at + count), size);
      at += count;
      size += count;
      continue;
    }
    /** @type {number[]} */
    let lengths = Array.from({length: 288}, (_, i) => (i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8));
    let distances = Array(30).fill(5);
    if (kind === 2) {
      const literals = take(5) + 257;
      const ways = take(5) + 1;
      const known = Array(19).fill(0);
      for (let i = 0, count = take(4) + 4; i < count; ++i) {
        known[lengthOrder[i]] = take(3);
      }
      const code = tableOf(known);
      /** @type {number[]} */
      const all = [];
      while (all.length < literals + ways) {
        const symbol = symbolOf(code);
        const [value, times] = symbol < 16 ? [symbol, 1] : symbol === 16 ? [all[all.length - 1], take(2) + 3]
          : symbol === 17 ? [0, take(3) + 3] : [0, take(7) + 11];
        all.push(...Array(times).fill(value));
      }
      lengths = all.slice(0, literals);
      distances = all.slice(literals);
    }
    const [literal, distance] = [tableOf(lengths), tableOf(distances)];
    for (let symbol = symbolOf(literal); symbol !== 256; symbol = symbolOf(literal)) {
      room(258);
      if (symbol < 256) {
        out[size++] = symbol;
        continue;
      }
      const [length, more] = copyLengths[symbol - 257];
      const end = size + length + take(more);
      const [back, further] = copyDistances[symbolOf(distance)];
      const behind = back + take(further);
      for (; size < end; ++size) {
        out[size] = out[size - behind];
      }
    }
  }
  return out.subarray(0, size);
}

/** @param {string} letters */
export const unpackedText = (letters) => new TextDecoder().decode(inflate(bytesOfLetters(letters)));
