// SPDX-License-Identifier: GPL-3.0-or-later
// Messages of the program as sentences, and what they propose.

import {sayMessage, textOf} from "./words.js";

/** @typedef {import("./words.js").Message} Message */

/** A message as a sentence of its own. Names of files keep their letters. @param {Message} message */
export function saySentence(message) {
  const sentence = sayMessage(message);
  return textOf("messages", message.code, "en")?.startsWith("{") ?? true ? sentence : `${sentence.charAt(0).toUpperCase()}${sentence.slice(1)}.`;
}

/** The option that a message proposes; null where it proposes none. @param {Message} message
 * @returns {{option: string, value: string} | null} */
export function proposalOf({values}) {
  const proposed = values.try;
  if (typeof proposed === "object" && !Array.isArray(proposed)) {
    return proposed;
  }
  return Object.values(values).filter(Array.isArray).flat().map((item) => (typeof item === "string" ? null : proposalOf(item)))
    .find((one) => one !== null) ?? null;
}
