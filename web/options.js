// SPDX-License-Identifier: GPL-3.0-or-later
// What a maker may choose, as one table: each option is a control of the panel and words of the program's command line.

/**
 * @typedef {object} Option
 * @property {string} key of the option, and of its texts: option_KEY, and option_KEY_help below it
 * @property {string} group of the panel: its text is group_GROUP
 * @property {"length" | "number" | "choice" | "flag" | "text"} kind
 * @property {string} word of the command line
 * @property {string | boolean} usual value, for which nothing is said to the program
 * @property {string[]} [choices] texts are option_KEY_CHOICE
 * @property {string} [unit] behind the number
 * @property {boolean} [more] lies behind "more"
 */

/** @type {Option[]} */
export const optionTable = [
  {key: "size", group: "size", kind: "length", word: "--size", usual: ""},
  {key: "faces", group: "size", kind: "text", word: "--faces", usual: "auto"},
  {key: "height", group: "size", kind: "length", word: "--height", usual: "", more: true},
  {key: "up", group: "size", kind: "choice", word: "--up", usual: "", choices: ["", "x", "y", "z"], more: true},
  {key: "scale", group: "size", kind: "text", word: "--scale", usual: "", more: true},
  {key: "unit", group: "size", kind: "choice", word: "--unit", usual: "", choices: ["", "mm", "cm", "m", "in", "ft"], more: true},
  {key: "paper", group: "paper", kind: "choice", word: "--paper", usual: "A4",
    choices: ["A4", "A3", "A2", "A5", "letter", "legal", "tabloid", "A4-landscape", "A3-landscape", "letter-landscape"]},
  {key: "ink", group: "paper", kind: "choice", word: "--ink", usual: "colour", choices: ["colour", "pale", "lines"]},
  {key: "margin", group: "paper", kind: "length", word: "--margin", usual: "", more: true},
  {key: "page_by", group: "paper", kind: "choice", word: "--page-by", usual: "", choices: ["", "material", "object"], more: true},
  {key: "calibrate", group: "paper", kind: "text", word: "--calibrate", usual: "", more: true},
  {key: "pieces", group: "pieces", kind: "choice", word: "--pieces", usual: "parts", choices: ["few", "parts", "small"]},
  {key: "max_faces", group: "pieces", kind: "text", word: "--max-faces", usual: "", more: true},
  {key: "concavity", group: "pieces", kind: "number", word: "--concavity", usual: "", more: true},
  {key: "keep_bodies", group: "pieces", kind: "flag", word: "--keep-bodies", usual: false, more: true},
  {key: "skins", group: "pieces", kind: "choice", word: "--skins", usual: "outer", choices: ["outer", "middle", "both"], more: true},
  {key: "only", group: "pieces", kind: "text", word: "--only", usual: "", more: true},
  {key: "without", group: "pieces", kind: "text", word: "--without", usual: "", more: true},
  {key: "tabs", group: "tabs", kind: "choice", word: "--tabs", usual: "auto", choices: ["auto", "one-side", "alternate", "both", "slots", "none"]},
  {key: "numbers", group: "tabs", kind: "choice", word: "--numbers", usual: "inside", choices: ["inside", "tabs", "outside", "back"]},
  {key: "tab_height", group: "tabs", kind: "length", word: "--tab-height", usual: ""},
  {key: "tab_angle", group: "tabs", kind: "text", word: "--tab-angle", usual: "", unit: "°", more: true},
  {key: "all_tabs", group: "tabs", kind: "flag", word: "--all-tabs", usual: false, more: true},
  {key: "border_tabs", group: "tabs", kind: "flag", word: "--border-tabs", usual: false, more: true},
  {key: "tab_shadow", group: "tabs", kind: "flag", word: "--tab-shadow", usual: false, more: true},
  {key: "hide_folds", group: "tabs", kind: "number", word: "--hide-folds", usual: "", unit: "°", more: true},
  {key: "preset", group: "machine", kind: "choice", word: "--preset", usual: "print", more: true,
    choices: ["print", "lightburn", "laser", "glowforge", "cricut", "silhouette", "scanncut", "plotter", "packaging", "origami-simulator"]},
  {key: "kerf", group: "machine", kind: "length", word: "--kerf", usual: "", more: true},
  {key: "dxf", group: "machine", kind: "choice", word: "--dxf", usual: "", choices: ["", "r2000", "r12", "plain"], more: true},
  {key: "fold_linear", group: "machine", kind: "flag", word: "--fold-linear", usual: false, more: true},
  {key: "seed", group: "machine", kind: "number", word: "--seed", usual: "", more: true},
];

const bareNumber = /^[\d.]+$/;

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
    // A bare number is millimetres here, and nobody wonders about it.
    return kind === "flag" ? [word] : [word, String(value) + (kind === "length" && bareNumber.test(String(value)) ? "mm" : "")];
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
    const [word, ...value] = words[i].split("=");
    const option = optionTable.find((w) => w.word === word);
    if (!option) {
      rest.push(words[i]);
    } else if (option.kind === "flag") {
      options[option.key] = true;
    } else {
      const text = value.length > 0 ? value.join("=") : words[++i] ?? "";
      if (option.key in options) {
        // Such as a second --only.
        rest.push(word, text);
        continue;
      }
      options[option.key] = option.kind === "length" ? text.replace(/^([\d.]+)mm$/, "$1") : text;
    }
  }
  return {options, rest};
}
