// SPDX-License-Identifier: GPL-3.0-or-later
// The controls of the studio, whose texts web/languages/ has: made from base/option_table.cpp by tests/cli/generated_files_test.cpp.

/**
 * @typedef {object} Option
 * @property {string} key of the option, and of its texts: option_KEY, and option_KEY_help below it
 * @property {string} group of the panel: its text is group_GROUP
 * @property {"length" | "number" | "choice" | "flag" | "text" | "list"} kind
 * @property {string} word of the command line
 * @property {string | boolean} usual value, for which nothing is said to the program
 * @property {string[]} [choices] texts are option_KEY_CHOICE
 * @property {string} [unit] behind the number
 * @property {boolean} [more] lies behind "more"
 */

/** @type {Option[]} */
export const optionTable = [
  {key: "size", group: "size", kind: "length", word: "--size", usual: ""},
  {key: "height", group: "size", kind: "length", word: "--height", usual: "", more: true},
  {key: "width", group: "size", kind: "length", word: "--width", usual: "", more: true},
  {key: "depth", group: "size", kind: "length", word: "--depth", usual: "", more: true},
  {key: "up", group: "size", kind: "choice", word: "--up", usual: "", choices: ["", "x", "y", "z"], more: true},
  {key: "scale", group: "size", kind: "text", word: "--scale", usual: "", more: true},
  {key: "unit", group: "size", kind: "choice", word: "--unit", usual: "", choices: ["", "mm", "cm", "m", "in", "ft"], more: true},
  {key: "faces", group: "size", kind: "text", word: "--faces", usual: "auto"},
  {key: "hours", group: "size", kind: "number", word: "--hours", usual: "4"},
  {key: "paper", group: "paper", kind: "choice", word: "--paper", usual: "A4", choices: ["A4", "A3", "A2", "A5", "letter", "legal", "tabloid", "A4-landscape", "A3-landscape", "letter-landscape"]},
  {key: "margin", group: "paper", kind: "length", word: "--margin", usual: "10", more: true},
  {key: "calibrate", group: "paper", kind: "text", word: "--calibrate", usual: "", more: true},
  {key: "most_pages", group: "paper", kind: "text", word: "--most-pages", usual: "300", more: true},
  {key: "page_by", group: "paper", kind: "choice", word: "--page-by", usual: "any", choices: ["any", "material", "object"], more: true},
  {key: "pack", group: "paper", kind: "choice", word: "--pack", usual: "fast", choices: ["fast", "good"], more: true},
  {key: "grain", group: "paper", kind: "choice", word: "--grain", usual: "any", choices: ["any", "long", "short"], more: true},
  {key: "ink", group: "paper", kind: "choice", word: "--ink", usual: "colour", choices: ["colour", "pale", "lines"]},
  {key: "details", group: "paper", kind: "choice", word: "--details", usual: "auto", choices: ["auto", "lines", "shade", "none"], more: true},
  {key: "dpi", group: "paper", kind: "number", word: "--dpi", usual: "300", more: true},
  {key: "only", group: "pieces", kind: "list", word: "--only", usual: "", more: true},
  {key: "without", group: "pieces", kind: "list", word: "--without", usual: "", more: true},
  {key: "keep_bodies", group: "pieces", kind: "flag", word: "--keep-bodies", usual: false, more: true},
  {key: "skins", group: "pieces", kind: "choice", word: "--skins", usual: "outer", choices: ["outer", "middle", "both"], more: true},
  {key: "concavity", group: "pieces", kind: "number", word: "--concavity", usual: "0.1", more: true},
  {key: "pieces", group: "pieces", kind: "choice", word: "--pieces", usual: "parts", choices: ["few", "parts", "small"]},
  {key: "rolled", group: "pieces", kind: "choice", word: "--rolled", usual: "auto", choices: ["auto", "never", "always"], more: true},
  {key: "max_faces", group: "pieces", kind: "text", word: "--max-faces", usual: "", more: true},
  {key: "weigh", group: "pieces", kind: "list", word: "--weigh", usual: "", more: true},
  {key: "tabs", group: "tabs", kind: "choice", word: "--tabs", usual: "auto", choices: ["auto", "one-side", "alternate", "both", "slots", "none"]},
  {key: "tab_height", group: "tabs", kind: "length", word: "--tab-height", usual: "5"},
  {key: "tab_angle", group: "tabs", kind: "text", word: "--tab-angle", usual: "45", unit: "°", more: true},
  {key: "border_tabs", group: "tabs", kind: "flag", word: "--border-tabs", usual: false, more: true},
  {key: "tab_shadow", group: "tabs", kind: "flag", word: "--tab-shadow", usual: false, more: true},
  {key: "all_tabs", group: "tabs", kind: "flag", word: "--all-tabs", usual: false, more: true},
  {key: "hide_folds", group: "tabs", kind: "text", word: "--hide-folds", usual: "3", unit: "°", more: true},
  {key: "numbers", group: "tabs", kind: "choice", word: "--numbers", usual: "inside", choices: ["inside", "tabs", "outside", "back"]},
  {key: "duplex", group: "tabs", kind: "choice", word: "--duplex", usual: "long", choices: ["long", "short"], more: true},
  {key: "preset", group: "machine", kind: "choice", word: "--preset", usual: "print", choices: ["print", "lightburn", "laser", "glowforge", "cricut", "silhouette", "scanncut", "plotter", "packaging", "origami-simulator"], more: true},
  {key: "dxf", group: "machine", kind: "choice", word: "--dxf", usual: "", choices: ["", "r2000", "r12", "plain"], more: true},
  {key: "kerf", group: "machine", kind: "length", word: "--kerf", usual: "", more: true},
  {key: "kerf_test", group: "machine", kind: "flag", word: "--kerf-test", usual: false, more: true},
  {key: "score", group: "machine", kind: "choice", word: "--score", usual: "", choices: ["", "solid", "dashes", "perforate", "ends", "none"], more: true},
  {key: "bridges", group: "machine", kind: "text", word: "--bridges", usual: "0", more: true},
  {key: "thickness", group: "machine", kind: "length", word: "--thickness", usual: "0", more: true},
  {key: "hinge", group: "machine", kind: "choice", word: "--hinge", usual: "", choices: ["", "back", "middle", "front"], more: true},
  {key: "bed", group: "machine", kind: "text", word: "--bed", usual: "", more: true},
  {key: "engrave", group: "machine", kind: "choice", word: "--engrave", usual: "", choices: ["", "on", "off"], more: true},
  {key: "colour", group: "machine", kind: "list", word: "--colour", usual: "", more: true},
  {key: "spot", group: "machine", kind: "list", word: "--spot", usual: "", more: true},
  {key: "print_and_cut", group: "machine", kind: "flag", word: "--print-and-cut", usual: false, more: true},
  {key: "hairline", group: "machine", kind: "flag", word: "--hairline", usual: false, more: true},
  {key: "svg_px", group: "machine", kind: "choice", word: "--svg-px", usual: "", choices: ["", "96", "72"], more: true},
  {key: "fold_linear", group: "machine", kind: "flag", word: "--fold-linear", usual: false, more: true},
  {key: "seed", group: "machine", kind: "text", word: "--seed", usual: "1", more: true},
];

/** Options that stand for others. @type {Record<string, string>} */
export const aliases = {
  "--no-tabs": "--tabs=none",
};
