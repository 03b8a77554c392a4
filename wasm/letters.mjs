// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as letters that a script element may hold, seven bits in each, as docs/design/viewer.md tells; web/packed.js reads them.

/** NUL, CR and "<", which a page can't hold: they stand in one letter with the seven bits behind them. */
const taken = [0, 13, 60];

/** @param {Uint8Array} bytes */
export function lettersOf(bytes) {
  const letters = [];
  let at = 0;
  let held = 0;
  let bits = 0;
  const seven = () => {
    if (bits < 7) {
      held = (held << 8 | (bytes[at++] ?? 0)) & 0x7fff;
      bits += 8;
    }
    bits -= 7;
    return held >> bits & 0x7f;
  };
  while (at < bytes.length || (at === bytes.length && bits > 0)) {
    const code = seven();
    const which = taken.indexOf(code);
    letters.push(String.fromCharCode(which < 0 ? code : 0x100 + 0x80 * which + seven()));
  }
  return letters.join("");
}
