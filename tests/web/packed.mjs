// SPDX-License-Identifier: GPL-3.0-or-later
// What the page unpacks is what zlib packed: of random bytes, of words, and of bytes that repeat, in all the ways in which
// it packs; and a file that breaks off is told to be broken, and doesn't go on for ever.
//   node packed.mjs SOURCE     the folder of the sources
import {pathToFileURL} from "node:url";
import {constants, deflateSync} from "node:zlib";

const {bytesOfLetters, inflate} = await import(pathToFileURL(`${process.argv[2]}/web/packed.js`).href);
const faults = [];
const check = (holds, words) => holds || faults.push(words);

let state = 1;
const below = (most) => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return Math.floor(state / 2 ** 32 * most);
};
const kinds = {random: () => below(256), words: () => 97 + below(5), repeating: () => (below(12) === 0 ? below(256) : 32)};

let compared = 0;
for (const [kind, next] of Object.entries(kinds)) {
  for (const size of [0, 1, 2, 300, 5000, 70000, 300000]) {
    const bytes = Buffer.from(Array.from({length: size}, next));
    for (const level of [0, 1, 6, 9]) {
      for (const strategy of [constants.Z_DEFAULT_STRATEGY, constants.Z_FIXED, constants.Z_HUFFMAN_ONLY]) {
        check(bytes.equals(inflate(deflateSync(bytes, {level, strategy}))), `${size} ${kind} bytes, level ${level}, strategy ${strategy}`);
        ++compared;
      }
    }
  }
}

const whole = deflateSync(Buffer.from(Array.from({length: 20000}, kinds.words)));
for (let end = 2; end < whole.length - 8; end += 97) {
  let said = "";
  try {
    inflate(whole.subarray(0, end));
  } catch (error) {
    said = error.message;
  }
  check(said === "this file isn't whole", `of ${whole.length} bytes, ${end} are unpacked: ${said}`);
}

// Letters, here put together from the bits' text.
for (let size = 0; size < 200; ++size) {
  const bytes = Uint8Array.from({length: size}, kinds.random);
  const bits = [...bytes].map((byte) => byte.toString(2).padStart(8, "0")).join("");
  const sevens = (`${bits}${"0".repeat(13)}`.match(/.{7}/g) ?? []).map((seven) => parseInt(seven, 2));
  let letters = "";
  for (let i = 0; 7 * i < bits.length; ++i) {
    const taken = [0, 13, 60].indexOf(sevens[i]);
    letters += String.fromCharCode(taken < 0 ? sevens[i] : 256 + 128 * taken + sevens[++i]);
  }
  const back = bytesOfLetters(letters);
  check(back.length - size <= 1 && bytes.every((byte, i) => back[i] === byte) && back.subarray(size).every((byte) => byte === 0), `${size} bytes in letters`);
}

console.log(faults.length === 0 ? `passed: ${compared} texts` : `FAILED\n    ${faults.join("\n    ")}`);
process.exit(faults.length === 0 ? 0 : 1);
