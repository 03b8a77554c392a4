// SPDX-License-Identifier: GPL-3.0-or-later
// The studio's page with a program that is played by a few lines, which note what they are asked: so tests run where no
// WebAssembly was built, and quickly.
import {execFileSync} from "node:child_process";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";
import {fileURLToPath} from "node:url";
import {deflateSync} from "node:zlib";

import {unpackedText} from "../../web/packed.js";

/** By their codes. @param {string} web folder of the modules */
export const languagesIn = (web) => Object.fromEntries(readdirSync(`${web}/languages`).map((file) => [file.replace(".json", ""),
  JSON.parse(readFileSync(`${web}/languages/${file}`, "utf8"))]));

/** Answers as worker.js does, with one result whatever is asked. Nothing finds room to the left of its page, or below it; what is dragged higher
 * than 250 mm finds room 20 mm above the page's foot, and what is dropped over its lower left corner 60 mm away from both sides. A line that begins with "cut" isn't possible at a size of 151 mm. */
function play(fold, sheets) {
  let pinned = [];
  let [words, files, steps] = [[], [], []];
  self.onmessage = ({data}) => {
    if (data.call === "write") {
      postMessage({id: data.id, files: [{name: data.name, bytes: new Uint8Array([80, 75])}]});
      return;
    }
    const result = {summary: {}, fold, sheets, pinned};
    const told = () => postMessage({note: {code: "plain", values: {text: `make: ${words.join(" ")} | ${steps.join(" | ")} | ${files}`}, text: ""}});
    if (data.call === "make") {
      words = data.words;
      files = Object.keys(data.files).sort();
      steps = [];
      told();
    } else if (data.call === "repeat") {
      steps = data.steps;
      result.left_out = words.includes("151mm") ? [...steps.keys()].filter((i) => steps[i].startsWith("cut")) : [];
      told();
    }
    if (data.line) {
      postMessage({note: {code: "plain", values: {text: `${data.call}: ${data.line}`}, text: ""}});
    }
    const refused = /(^|; )place \d+ \d+ (-|[\d.]+ -)/.test(data.line ?? "") ? {edit: 0, why: {code: "beyond_sheet", values: {a: "A"}, text: ""}, faces: [0]} : null;
    const [verb, , , x, y] = (data.line ?? "").split(" ");
    const far = refused && data.reach > 15 && Number(y) < 0;
    const above = verb === "place" && Number(y) > 250 && data.call === "preview";
    const nearby = {refused: {edit: 0, why: {code: "no_such_page", values: {}, text: ""}, faces: [0]}, instead: [Number(x), 20]};
    if (data.call === "apply" && /^(un)?pin /.test(data.line)) {
      pinned = data.line.startsWith("pin") ? [Number(data.line.split(" ")[1])] : [];
      result.pinned = pinned;
    }
    postMessage(data.call === "start" ? {id: data.id} : above ? {id: data.id, ...nearby} : far ? {id: data.id, refused, instead: [60, 60]} : refused ? {id: data.id, refused} : data.call === "preview" ? {id: data.id} : {id: data.id, ...result});
  };
}

/**
 * Its path, below `out`, where the whale's files are, too.
 * @param {{program: string, samples: string, web: string, out: string}} where
 */
export async function playedPage({program, samples, web, out}) {
  // Tests drag by distances, cut and lay what stands in whale.fold, whatever nets a search finds today.
  execFileSync(program, [`${samples}/whale.obj`, "--from", fileURLToPath(new URL("whale.fold", import.meta.url)), "--overwrite", "--quiet",
    ...["html", "fold", "ridgecraft"].flatMap((suffix) => ["-o", `${out}/whale.${suffix}`])], {stdio: ["ignore", "ignore", "inherit"]});
  const fold = readFileSync(`${out}/whale.fold`, "utf8");
  const sheets = await unpackedText(/id="sheets">(.*?)<\/script>/s.exec(readFileSync(`${out}/whale.html`, "utf8"))[1]);
  execFileSync("sh", [`${web}/bundle.sh`, "studio", `${out}/frame.html`]);
  const packed = (id, bytes) => `<script type="text/plain" id="packed-${id}">${deflateSync(bytes).toString("base64")}</script>\n`;
  const data = [packed("module", Buffer.from([0, 97, 115, 109, 1, 0, 0, 0])), packed("program", `(${play})(${JSON.stringify(fold)},${JSON.stringify(sheets)});`),
    packed("languages", JSON.stringify(languagesIn(web))), packed("samples", JSON.stringify({whale: {"whale.obj": "v 0 0 0\n"}})), '<script type="application/json" id="start">{}</script>'].join("");
  const file = `${out}/played.html`;
  writeFileSync(file, readFileSync(`${out}/frame.html`, "utf8").replace("@PRODUCER@", "Ridgecraft test").replace("@DATA@", () => data));
  return file;
}
