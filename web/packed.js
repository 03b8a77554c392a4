// SPDX-License-Identifier: GPL-3.0-or-later
// What is packed in the page: deflated in the frame of zlib (RFC 1950), as base64.

/** @param {string} base64 */
export function bytesOf(base64) {
  const letters = atob(base64.trim());
  const bytes = new Uint8Array(letters.length);
  // Uint8Array.from() would call a function for each byte, which takes half a second for some megabytes.
  for (let i = 0; i < letters.length; ++i) {
    bytes[i] = letters.charCodeAt(i);
  }
  return bytes;
}

/** @param {string} base64 */
export function unpacked(base64) {
  return new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
}

/** @param {string} base64 */
export function unpackedText(base64) {
  return new Response(unpacked(base64)).text();
}
