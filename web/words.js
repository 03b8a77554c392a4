// SPDX-License-Identifier: GPL-3.0-or-later
// All texts of the page by key, in two languages, and numbers as people there write them.

import {viewerMessages} from "./message_words.js";

/** The program's messages that this page can show. @type {Record<string, [string, string]>} English, German */
export const messages = {...viewerMessages};

/** @type {Record<string, [string, string]>} English, German */
export const texts = {
  model: ["Model", "Modell"],
  sheets: ["Sheets", "Bögen"],
  views: ["What is shown", "Was zu sehen ist"],
  build: ["Build it", "Bauen"],
  build_end: ["Finish", "Beenden"],
  menu: ["Menu", "Menü"],
  steps: ["Steps", "Schritte"],
  colours: ["The model's own colours (T)", "Eigene Farben des Modells (T)"],
  through: ["Seams seen through the model (X)", "Nähte durchs Modell hindurch zeigen (X)"],
  fit: ["Show all (Home)", "Alles zeigen (Pos1)"],
  play: ["Fold (space)", "Falten (Leertaste)"],
  pause: ["Pause (space)", "Anhalten (Leertaste)"],
  speed: ["Speed: {speed}", "Tempo: {speed}"],
  folded: ["How far it is folded", "Wie weit gefaltet ist"],
  flat: ["flat", "flach"],
  folded_word: ["folded", "gefaltet"],
  built: ["built", "gebaut"],
  divider: ["Width of the views", "Breite der Ansichten"],
  facts: ["{faces}, {pieces}, {pages}, {size}", "{faces}, {pieces}, {pages}, {size}"],
  faces_1: ["{n} face", "{n} Fläche"],
  faces_n: ["{n} faces", "{n} Flächen"],
  pieces_1: ["{n} piece", "{n} Teil"],
  pieces_n: ["{n} pieces", "{n} Teile"],
  pages_1: ["{n} page", "{n} Seite"],
  pages_n: ["{n} pages", "{n} Seiten"],
  folds_1: ["{n} fold", "{n} Falz"],
  folds_n: ["{n} folds", "{n} Falze"],
  joins_1: ["{n} join", "{n} Naht"],
  joins_n: ["{n} joins", "{n} Nähte"],
  named: ["“{name}”", "„{name}“"],
  page: ["page {page}", "Seite {page}"],
  piece: ["Piece {name}", "Teil {name}"],
  piece_line: ["Piece {name}, {page}: {faces}, {folds}{glued}", "Teil {name}, {page}: {faces}, {folds}{glued}"],
  glued: [", glued to {names} by {joins}", ", mit {names} verklebt an {joins}"],
  itself: ["itself", "sich selbst"],
  and: ["{list} and {last}", "{list} und {last}"],
  join_line: ["Join {number}: {a} + {b}, {length}, {tab}", "Naht {number}: {a} + {b}, {length}, {tab}"],
  tab_on: ["tab on {name}", "Lasche an {name}"],
  no_tab: ["no tab: {why}", "ohne Lasche: {why}"],
  mountain: ["Mountain fold", "Bergfalz"],
  valley: ["Valley fold", "Talfalz"],
  fold_line: ["{kind}, {angle}, {length}, piece {name}", "{kind}, {angle}, {length}, Teil {name}"],
  border_line: ["Border, {length}, piece {name}", "Rand, {length}, Teil {name}"],
  tip: ["Point at a piece or a seam to find it on the other side.", "Auf ein Teil oder eine Naht zeigen: auf der anderen Seite leuchtet es auf."],
  tip_touch: ["Tap a piece or a seam to find it on the sheets.", "Ein Teil oder eine Naht antippen: auf den Bögen leuchtet es auf."],
  checked: ["Checked: folds back to the model", "Geprüft: gefaltet ergibt es das Modell"],
  checked_title: ["Every piece was folded by its angles in this browser. Largest distance from the model: {error}.", "Jedes Teil wurde in diesem Browser nach seinen Winkeln gefaltet. Größter Abstand zum Modell: {error}."],
  unchecked: ["Doesn't fold back to the model ({error})", "Ergibt gefaltet nicht das Modell ({error})"],
  stage_label: ["{title}, built from {pieces}. Arrow keys turn it.", "{title}, gebaut aus {pieces}. Die Pfeiltasten drehen es."],
  print_sheets: ["Print the sheets", "Bögen drucken"],
  print_guide: ["Print the guide", "Anleitung drucken"],
  save_fold: ["Save the nets (.fold)", "Abwicklungen speichern (.fold)"],
  language: ["Deutsch", "English"],
  inches: ["Show inches", "Zoll anzeigen"],
  millimetres: ["Show millimetres", "Millimeter anzeigen"],
  all_keys: ["Keyboard", "Tastatur"],
  notes_label: ["What to look at", "Was zu beachten ist"],
  notes_1: ["{n} note", "{n} Hinweis"],
  notes_n: ["{n} notes", "{n} Hinweise"],
  guide_title: ["How to build it: {title}", "So wird gebaut: {title}"],
  on_page: ["{page}: {names}", "{page}: {names}"],
  close: ["Close", "Schließen"],
  step_of: ["Step {n} of {all}", "Schritt {n} von {all}"],
  step_cut: ["Cut out {names}", "{names} ausschneiden"],
  step_fold: ["Fold", "Falten"],
  step_fold_now: ["Fold {n} of {all}: {kind}, {angle}", "Falz {n} von {all}: {kind}, {angle}"],
  step_fold_many: ["Fold {n} of {all}: {count} together, up to {angle}", "Falz {n} von {all}: {count} zusammen, bis {angle}"],
  step_glue: ["Glue {joins} to {names}", "{joins} an {names} kleben"],
  step_glue_own: ["Close {joins} of its own", "{joins} an sich selbst schließen"],
  nothing_to_fold: ["Nothing to fold", "Nichts zu falten"],
  back: ["Back", "Zurück"],
  next: ["Next", "Weiter"],
  done: ["Done", "Erledigt"],
  done_of: ["{n} of {all} done", "{n} von {all} erledigt"],
  all_done: ["All done. Well built!", "Alles erledigt. Gut gebaut!"],
  key_space: ["Fold and unfold", "Falten und Aufklappen"],
  key_steps: ["Step by step: back and on", "Schritt für Schritt: zurück und weiter"],
  key_build: ["Begin and end building", "Bauen beginnen und beenden"],
  key_done: ["Tick a step off", "Schritt abhaken"],
  key_home: ["Show all", "Alles zeigen"],
  key_f: ["Show what is chosen", "Das Gewählte zeigen"],
  key_x: ["Seams through the model", "Nähte durchs Modell"],
  key_t: ["The model's colours, or those of the pieces", "Farben des Modells oder der Teile"],
  key_tab: ["Next piece; its edges: up and down", "Nächstes Teil; seine Kanten: auf und ab"],
  key_escape: ["Choose nothing", "Nichts auswählen"],
  key_print: ["Print the sheets", "Bögen drucken"],
  key_help: ["These keys", "Diese Tasten"],
  mouse: ["Drag turns, right drag moves, the wheel zooms. On the sheets drag moves, and a double click goes to a piece.", "Ziehen dreht, Ziehen mit rechts verschiebt, das Rad vergrößert. Auf den Bögen verschiebt Ziehen, und ein Doppelklick geht zu einem Teil."],
  no_webgl: ["Drawn in a simple way: this browser has no WebGL 2", "Einfach gezeichnet: Dieser Browser hat kein WebGL 2"],
  broken: ["This page can't show its model: {why}", "Diese Seite kann ihr Modell nicht zeigen: {why}"],
};

/** Of the reader. */
export const reader = {
  language: (globalThis.navigator?.language ?? "en").toLowerCase().startsWith("de") ? "de" : "en",
  inches: false,
};

/**
 * A text in the reader's language, with its gaps filled.
 * @param {string} key
 * @param {Record<string, string | number>} [values]
 */
export function say(key, values = {}) {
  const text = texts[key]?.[reader.language === "de" ? 1 : 0] ?? key;
  return text.replace(/\{(\w+)\}/g, (gap, name) => (name in values ? String(values[name]) : gap));
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
  return messages[code]?.[reader.language === "de" ? 1 : 0].replace(gaps, (_, name, one, many, word) => one === undefined
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
  if (!word.startsWith("--") || !(key in texts)) {
    return `${word} ${value}`.trim();
  }
  const choice = `${key}_${value}`;
  return say("named", {name: value === "" ? say(key) : `${say(key)}: ${choice in texts ? say(choice) : value}`});
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
