// SPDX-License-Identifier: GPL-3.0-or-later
// What the page says in the reader's language, and numbers as people there write them. The texts are web/languages/CODE.json.

/**
 * A language as its file has it. What it lacks is said in English.
 * @typedef {Record<string, string>} Texts
 * @typedef {object} Language
 * @property {string} name as its readers call it
 * @property {Texts} page of all pages
 * @property {Texts} seams messages that a page with one result can show: why a seam has no tab
 * @property {Texts} [studio] of the studio; before those of the page
 * @property {Texts} [options] of its controls
 * @property {Texts} [messages] that the program may give there
 */

/** By code, as browsers name languages. @type {Map<string, {name: string, texts: Texts, messages: Texts}>} */
export const languages = new Map();

/** Of the reader. */
export const reader = {language: "en", inches: false};

/** The page begins in the language that its reader prefers of those that there are. @param {string} code @param {Language} language */
export function addLanguage(code, {name, page, seams, studio = {}, options = {}, messages = {}}) {
  languages.set(code, {name, texts: {...page, ...options, ...studio}, messages: {...seams, ...messages}});
  const wanted = (globalThis.navigator?.languages ?? []).map((tag) => tag.toLowerCase().split("-")[0]);
  reader.language = wanted.find((one) => languages.has(one)) ?? "en";
}

/** @param {"texts" | "messages"} kind @param {string} key @param {string} [code] of a language @returns {string | undefined} */
export const textOf = (kind, key, code = reader.language) => languages.get(code)?.[kind][key] ?? languages.get("en")?.[kind][key];

/** A long name without its middle: beginnings and endings tell files apart. @param {string} name @param {number} [most] characters */
export function shortName(name, most = 36) {
  const letters = [...name];
  const tail = Math.floor((most - 1) / 2);
  return letters.length <= most ? name : `${letters.slice(0, most - 1 - tail).join("")}…${letters.slice(-tail).join("")}`;
}

/**
 * A text in the reader's language, with its gaps filled.
 * @param {string} key
 * @param {Record<string, string | number>} [values]
 */
export function say(key, values = {}) {
  return (textOf("texts", key) ?? key).replace(/\{(\w+)\}/g, (gap, name) => (name in values ? String(values[name]) : gap));
}

/**
 * A message of the program's: the code of a text, and what fills its gaps. An option may fill one, or further messages.
 * @typedef {string | {option: string, value: string} | (Message | string)[]} Filling
 * @typedef {{code: string, values: Record<string, Filling>, text: string}} Message
 */

/** {name}, {name|one|many} and {name, and}, as base/message.hpp has them. */
const gaps = /\{(\w+)(?:\|([^|}]*)\|([^}]*)|, (\w+))?\}/g;

/** For the reader, whom its English text has to do where its code is unknown. @param {Message} message @returns {string} */
export function sayMessage({code, values, text}) {
  return textOf("messages", code)?.replace(gaps, (_, name, one, many, word) => one === undefined
    ? sayFilling(values[name], word) : (values[name] === "1" ? one : many).replace("#", values[name])) ?? text;
}

/** @param {Filling} filling @param {string} [word] before the last one of several */
function sayFilling(filling, word) {
  if (typeof filling === "string") {
    return sayOption(filling, "");
  }
  if (!Array.isArray(filling)) {
    return sayOption(`--${filling.option}`, filling.value);
  }
  const items = filling.map((item) => (typeof item === "string" ? item : sayMessage(item)));
  return word && items.length > 1 ? `${items.slice(0, -1).join(", ")} ${word} ${items.at(-1)}` : items.join("; ");
}

/** An option as the page's own control is called; other words as they are. @param {string} word of the command line @param {string} value */
function sayOption(word, value) {
  const key = `option_${word.slice(2).replaceAll("-", "_")}`;
  if (!word.startsWith("--") || textOf("texts", key) === undefined) {
    return `${word} ${value}`.trim();
  }
  const choice = `${key}_${value}`;
  return say("named", {name: value === "" ? say(key) : `${say(key)}: ${textOf("texts", choice) ?? value}`});
}

/** @param {number} value @param {number} digits */
export function sayNumber(value, digits = 0) {
  return new Intl.NumberFormat(reader.language, {minimumFractionDigits: digits, maximumFractionDigits: digits})
    .format(value);
}

/** "6 pieces" @param {string} key @param {number} n */
export function sayCount(key, n) {
  return say(`${key}_${n === 1 ? 1 : "n"}`, {n: sayNumber(n)});
}

/** @param {number} mm @param {number} [digits] of millimetres */
export function sayLength(mm, digits = 1) {
  return reader.inches ? `${sayNumber(mm / 25.4, digits + 1)} in` : `${sayNumber(mm, digits)} mm`;
}

/** @param {number} radians */
export function sayAngle(radians) {
  return `${sayNumber((Math.abs(radians) * 180) / Math.PI)}°`;
}

/** "A, B and C" @param {string[]} words */
export function sayList(words) {
  return words.length < 2 ? words.join("")
    : say("and", {list: words.slice(0, -1).join(", "), last: words[words.length - 1]});
}
