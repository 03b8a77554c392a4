// SPDX-License-Identifier: GPL-3.0-or-later
// Each text of the page stands in English, and in German with the same gaps; other languages have some of them. Each one that is
// asked for is there, and none is there that isn't asked for. The program's messages are said in both, and no module
// reads a sentence.
//   node words.mjs SOURCE     the folder of the sources
import {readdirSync, readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";

import {languagesIn} from "./played.mjs";

const source = process.argv[2];
const load = (name) => import(pathToFileURL(`${source}/web/${name}`).href);
const {addLanguage, languages, reader} = await load("words.js");
const {proposalOf, saySentence} = await load("studio_words.js");
const {optionTable} = await load("options.js");
const faults = [];
const check = (holds, words) => holds || faults.push(words);

const files = languagesIn(`${source}/web`);
const {en, de} = files;
const sections = ["page", "studio", "options", "seams", "messages"];
const gapsOf = (text) => [...new Set([...text.matchAll(/\{(\w+)/g)].map(([, name]) => name))].sort().join();
for (const [code, language] of Object.entries(files)) {
  const text = readFileSync(`${source}/web/languages/${code}.json`, "utf8");
  check(text === `${JSON.stringify(language, null, 1)}\n`, `${code}.json isn't written as JSON.stringify(…, null, 1) does`);
  check(Object.keys(language).every((key) => key === "name" || sections.includes(key)), `${code}.json has ${Object.keys(language)}`);
  for (const section of sections) {
    for (const [key, said] of Object.entries(language[section] ?? {})) {
      const english = en[section][key];
      check(typeof said === "string" && said !== "" && (said.trim() === said || /^, /.test(said)), `${code}, ${key}: ${JSON.stringify(said)} is no text`);
      check(english !== undefined, `${code} has a text "${key}" that English hasn't`);
      check(english === undefined || gapsOf(english) === gapsOf(said), `${code}, ${key}: other gaps than in English: ${JSON.stringify(said)}`);
      check(!/^(seams|messages)$/.test(section) || !said.endsWith("."), `${code}, ${key} ends with a full stop`);
    }
  }
  addLanguage(code, language);
}

// What is the same in both: names, numbers, and what only puts others together.
const alike = /^(format_(svg|eps)|facts|on_page|option_.*_usual|option_preset_.*|option_up_[xyz]|key_name_(tab|escape))$/;
for (const section of sections) {
  for (const [key, english] of Object.entries(en[section])) {
    const german = de[section][key];
    check(german !== undefined && (german !== english || alike.test(key) || english.replace(/\{\w+\}/g, "").length < 5), `${key}: "${english}" wasn't translated`);
  }
}
const {texts, messages} = languages.get("en");

// What a language lacks is said in English.
addLanguage("xx", {name: "X", page: {sheets: "SHEETS"}, seams: {}});
const {say} = await load("words.js");
reader.language = "xx";
check(say("sheets") === "SHEETS" && say("model") === en.page.model && say("nothing") === "nothing", "a language that is half there isn't filled by English");

// Asked for: by say(), by attributes of the page, by the table of options, or as a word that a text goes by.
const modules = readdirSync(`${source}/web`).filter((name) => /\.(js|html)$/.test(name) && !name.endsWith("words.js"));
const pages = modules.map((name) => readFileSync(`${source}/web/${name}`, "utf8")).join("\n");
const own = ["words.js", "studio_words.js", "option_words.js"].map((name) => readFileSync(`${source}/web/${name}`, "utf8")).join("\n");
const asked = new Set();
check(!/matchAll|new RegExp/.test(pages), "a module reads sentences");
for (const [, key] of pages.matchAll(/\b(?:say\(|data-(?:say|label)=)"([^"]+)"/g)) {
  asked.add(key);
}
for (const [, key] of pages.matchAll(/\bsayCount\("([^"]+)"/g)) {
  asked.add(`${key}_1`).add(`${key}_n`);
}
for (const {key, group} of optionTable) {
  asked.add(`option_${key}`).add(`group_${group}`);
}
for (const key of asked) {
  check(key in texts, `there is no text "${key}", which the page asks for`);
}
const beginnings = [...pages.matchAll(/`(\w+_)\$\{/g)].map(([, beginning]) => beginning);
for (const key of Object.keys(texts)) {
  const said = asked.has(key) || pages.includes(`"${key}"`) || own.includes(`say("${key}"`) || beginnings.some((beginning) => key.startsWith(beginning));
  check(said, `the text "${key}" isn't asked for`);
}
const names = /^(|[a-z]{1,2}|A\d|letter|legal|tabloid|r\d+|plain|\d+)$/;
for (const {key, choices} of optionTable) {
  for (const choice of choices ?? []) {
    check(names.test(choice) || `option_${key}_${choice}` in texts, `there is no text for the choice "${choice}" of "${key}"`);
  }
}

// Messages of the program: what fills their gaps, in both languages, and options by the names of their controls.
const spoken = (language, message) => {
  reader.language = language;
  return saySentence(message);
};
const few = {code: "split_for_tabs", values: {n: "1"}, text: ""};
check(spoken("en", few) === "1 piece was split off for tabs", spoken("en", few));
check(spoken("de", few) === "1 Teil wurde für Laschen abgetrennt", spoken("de", few));
const word = {code: "option_word", values: {option: "--grain", text: "up", words: ["any", "long", "short"]}, text: ""};
check(spoken("de", word) === "„Laufrichtung des Papiers“: any, long oder short, nicht „up“", spoken("de", word));
const many = {code: "of_model", values: {model: "a.obj", what: [{code: "many_pages", values: {pages: "80", fewer: "10", try: {option: "size", value: "30mm"}}, text: ""}]}, text: ""};
check(spoken("en", many) === "a.obj: this takes about 80 pages; “Largest side: 30mm” would take about 10", spoken("en", many));
check(proposalOf(many)?.value === "30mm" && proposalOf(few) === null, "what a message proposes isn't found");
check(spoken("de", {code: "no_such_page", values: {}, text: ""}) === "Diese Seite gibt es nicht.", "a refusal is no sentence");
check(spoken("de", {code: "unknown", values: {}, text: "in English"}) === "in English", "a message without a text isn't said in English");

console.log(faults.length === 0 ? `passed: ${Object.keys(texts).length} texts, ${Object.keys(messages).length} messages` : `FAILED\n    ${faults.join("\n    ")}`);
process.exit(faults.length === 0 ? 0 : 1);
