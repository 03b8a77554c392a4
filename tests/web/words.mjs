// SPDX-License-Identifier: GPL-3.0-or-later
// Each text of the page stands in both languages, with the same gaps; each one that is asked for is there, and none is
// there that isn't asked for. The program's messages are said in both, and no module reads a sentence.
//   node words.mjs SOURCE     the folder of the sources
import {readdirSync, readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";

const source = process.argv[2];
const load = (name) => import(pathToFileURL(`${source}/web/${name}`).href);
const {messages, texts, reader} = await load("words.js");
const {proposalOf, saySentence} = await load("studio_words.js");
const {optionTable} = await load("options.js");
const faults = [];
const check = (holds, words) => holds || faults.push(words);

const gapsOf = (text) => [...new Set([...text.matchAll(/\{(\w+)/g)].map(([, name]) => name))].sort().join();
function checkPair(about, pair) {
  const good = Array.isArray(pair) && pair.length === 2 && pair.every((text) => typeof text === "string" && text.trim() === text && text !== "" || /^, /.test(text));
  check(good, `${about}: ${JSON.stringify(pair)} isn't one text in English and one in German`);
  check(!good || gapsOf(pair[0]) === gapsOf(pair[1]), `${about}: other gaps in German: ${JSON.stringify(pair)}`);
}

// What is the same in both: names, numbers, and what only puts others together.
const alike = /^(format_(svg|eps)|facts|on_page|option_.*_usual|option_preset_.*|option_up_[xyz])$/;
for (const [key, pair] of Object.entries(texts)) {
  checkPair(key, pair);
  check(pair[0] !== pair[1] || alike.test(key), `${key}: "${pair[0]}" wasn't translated`);
}
for (const [code, pair] of Object.entries(messages)) {
  checkPair(code, pair);
  check(pair[0] !== pair[1] || pair[0].replace(/\{\w+\}/g, "").length < 5, `${code}: "${pair[0]}" wasn't translated`);
  check(!pair[0].endsWith(".") && !pair[1].endsWith("."), `${code} ends with a full stop`);
}

// Asked for: by say(), by attributes of the page, by the table of options, or as a word that a text goes by.
const files = readdirSync(`${source}/web`).filter((name) => /\.(js|html)$/.test(name) && !name.endsWith("words.js"));
const pages = files.map((name) => readFileSync(`${source}/web/${name}`, "utf8")).join("\n");
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
