// SPDX-License-Identifier: GPL-3.0-or-later
// Each text of the page stands in both languages, with the same gaps; each one that is asked for is there, and none is
// there that isn't asked for; and each reason of the program's for which an edit is refused has its German sentence.
//   node words.mjs SOURCE     the folder of the sources
import {readdirSync, readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";

const source = process.argv[2];
const load = (name) => import(pathToFileURL(`${source}/web/${name}`).href);
const {texts, reader, noTabReasons, sayNoTab} = await load("words.js");
const {refusals, sayRefusal} = await load("studio_words.js");
const {optionTable} = await load("options.js");
const faults = [];
const check = (holds, words) => holds || faults.push(words);

const gapsOf = (text) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name).sort().join();
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
for (const pair of [...refusals, ...noTabReasons]) {
  checkPair("a sentence of the program", pair);
  check(pair[0] !== pair[1], `"${pair[0]}" wasn't translated`);
}

// Asked for: by say(), by attributes of the page, by the table of options, or as a word that a text goes by.
const files = readdirSync(`${source}/web`).filter((name) => /\.(js|html)$/.test(name) && !name.endsWith("words.js"));
const pages = files.map((name) => readFileSync(`${source}/web/${name}`, "utf8")).join("\n");
const own = ["words.js", "studio_words.js", "option_words.js"].map((name) => readFileSync(`${source}/web/${name}`, "utf8")).join("\n");
const asked = new Set();
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

// Why an edit is refused, as the sources say it: each part between two gaps stands in a sentence that is translated.
const english = refusals.map(([sentence]) => sentence.replace(/\{\w+\}/g, "{}"));
const elsewhere = /^(the file was saved from|the saved project|the job|no step of edits)/;
for (const name of ["session/draft.cpp", "unfold/edits.cpp", "unfold/edits.cpp"]) {
  const code = readFileSync(`${source}/${name}`, "utf8").split("\n").filter((line) => !/^\s*(\/\/|#include)/.test(line)).join("\n");
  for (const [, literal] of code.matchAll(/"((?:[^"\\\n]|\\.)*)"/g)) {
    const part = literal.replace(/\{[^}]*\}/g, "{}");
    const spoken = part.trim().split(/\s+/).length > 1 && !elsewhere.test(part);
    check(!spoken || english.some((sentence) => sentence.includes(part)), `${name}: "${literal}" has no German sentence in studio_words.js`);
  }
}
const reasons = /sentence\(NoTab reason\) \{(.*?)\n\}/s.exec(readFileSync(`${source}/unfold/net/nets.cpp`, "utf8"))?.[1] ?? "";
const said = [...reasons.matchAll(/return "([^"]+)"/g)].map(([, sentence]) => sentence);
check(said.join("|") === noTabReasons.map(([sentence]) => sentence).join("|"), `why a join has no tab reads ${JSON.stringify(said)} by the program`);

reader.language = "de";
for (const [sentence, german] of refusals) {
  const fill = (text) => text.replace(/\{(\w+)\}/g, (_, name) => ({a: "AB", b: "C", n: "2"})[name]);
  const spoken = sayRefusal(fill(sentence));
  const wanted = fill(german);
  check(spoken === `${wanted.charAt(0).toUpperCase()}${wanted.slice(1)}.`, `"${fill(sentence)}" reads "${spoken}"`);
}
for (const [sentence, german] of noTabReasons) {
  check(sayNoTab(sentence) === german, `"${sentence}" reads "${sayNoTab(sentence)}"`);
}

console.log(faults.length === 0 ? `passed: ${Object.keys(texts).length} texts, ${refusals.length + noTabReasons.length} sentences` : `FAILED\n    ${faults.join("\n    ")}`);
process.exit(faults.length === 0 ? 0 : 1);
