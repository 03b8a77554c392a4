// SPDX-License-Identifier: GPL-3.0-or-later
// What a maker may choose: each option is a control of the panel and words of the program's command line.

import {aliases, optionTable} from "./option_words.js";

export {optionTable};

const bareNumber = /^[\d.]+$/;

/** Between the values of an option that may be given several times. */
const separator = ";";

/**
 * The words of a command line for these options.
 * @param {Record<string, string | boolean>} options
 * @returns {string[]}
 */
export function wordsOf(options) {
  return optionTable.flatMap(({key, kind, word, usual}) => {
    const value = options[key] ?? usual;
    if (value === usual || value === "" || value === false) {
      return [];
    }
    const text = String(value);
    if (kind === "list") {
      return text.split(separator).map((one) => one.trim()).filter((one) => one !== "").flatMap((one) => [word, one]);
    }
    // A bare number is millimetres here, and nobody wonders about it.
    return kind === "flag" ? [word] : [word, text + (kind === "length" && bareNumber.test(text) ? "mm" : "")];
  });
}

/**
 * The options that words of a command line stand for, and the words that stand for none of them.
 * @param {string[]} words
 */
export function optionsOf(words) {
  /** @type {Record<string, string | boolean>} */
  const options = {};
  /** @type {string[]} */
  const rest = [];
  for (let i = 0; i < words.length; ++i) {
    const [word, ...value] = (aliases[words[i]] ?? words[i]).split("=");
    const option = optionTable.find((one) => one.word === word);
    if (!option) {
      rest.push(words[i]);
    } else if (option.kind === "flag") {
      options[option.key] = true;
    } else {
      const text = value.length > 0 ? value.join("=") : words[++i] ?? "";
      const before = option.kind === "list" && option.key in options ? `${options[option.key]}${separator} ` : "";
      options[option.key] = before + (option.kind === "length" ? text.replace(/^([\d.]+)mm$/, "$1") : text);
    }
  }
  return {options, rest};
}

/** Options in the address of the page: #o=--size%3D20cm%0A--paper%3DA3 @param {string} hash */
export function optionsIn(hash) {
  const words = new URLSearchParams(hash.slice(1)).get("o");
  return words ? optionsOf(words.split("\n")).options : {};
}

/** The same, the other way. @param {Record<string, string | boolean>} options */
export function hashOf(options) {
  const words = wordsOf(options);
  const joined = words.reduce((/** @type {string[]} */ all, word, i) => (word.startsWith("--") || i === 0 ? [...all, word] : [...all.slice(0, -1), `${all.at(-1)}=${word}`]), []);
  return `#o=${encodeURIComponent(joined.join("\n"))}`;
}
