// SPDX-License-Identifier: GPL-3.0-or-later
// What runs in the worker, behind the glue of the module (wasm/): it keeps one project and answers one call at a time.
//
//   {id, call: "start", module}            the compiled WebAssembly
//   {id, call: "make", files, words}       files by name, the words of a command line: the summary, nets and sheets
//   {id, call: "repeat", steps}            what was done by hand: the same, and which steps were left out
//   {id, call: "apply" | "preview", line}  edits of one step: the same; or why they are refused. preview: `reach` mm a piece may
//                                          lie elsewhere
//   {id, call: "undo", count}              takes that many steps back: the same
//   {id, call: "show"}                     the same, as it is
//   {id, call: "write", name, pages}       the files that this name after -o stands for: [{name, bytes}]; only these pages
//
// Answers are {id, ...} with `error: {code, message}` where a call fails; between them {stage, share} and {note}. Messages and notes are
// codes with values (words.js).

/** @type {any} */
const worker = self;
/** @type {any} the module's instance */
let core = null;

/** @param {WebAssembly.Module} module */
async function startCore(module) {
  core = await worker.ridgecraft({
    // The page has compiled it already, once for all workers.
    instantiateWasm: (/** @type {WebAssembly.Imports} */ imports, /** @type {(instance: WebAssembly.Instance) => void} */ done) => {
      WebAssembly.instantiate(module, imports).then(done);
      return {};
    },
    report: (/** @type {string} */ kind, /** @type {string} */ text, /** @type {number} */ share) =>
      worker.postMessage(kind === "progress" ? {stage: text, share} : {note: JSON.parse(text)}),
    print: () => {},
    printErr: () => {},
  });
  core.FS.mkdir("/project");
  core.FS.chdir("/project");
  return {};
}

/** The program's message on why it didn't. */
class Refused extends Error {
  /** @param {any} why a message @param {number} code of the program's exit */
  constructor(why, code) {
    super(why.text);
    this.why = why;
    this.code = code;
  }
}

/** What a function of the module answers. @param {string} name @param {(string | number)[]} values */
function answerOf(name, ...values) {
  const code = core.ccall(name, "number", values.map((value) => typeof value), values);
  const begin = core.ccall("ridgecraft_answer", "number", [], []);
  const bytes = core.HEAPU8.slice(begin, begin + core.ccall("ridgecraft_answer_size", "number", [], []));
  if (code !== 0) {
    throw new Refused(JSON.parse(new TextDecoder().decode(bytes)), code);
  }
  return bytes;
}

/** @param {string} name @param {(string | number)[]} values */
const textOf = (name, ...values) => new TextDecoder().decode(answerOf(name, ...values));

/** @param {string} name @param {number[]} [pages] the only ones */
function writtenAs(name, pages) {
  const names = JSON.parse(textOf("ridgecraft_plan", name));
  if (pages) {
    answerOf("ridgecraft_only", JSON.stringify(pages));
  }
  return names.map((/** @type {string} */ file, /** @type {number} */ i) =>
    ({name: file, bytes: answerOf("ridgecraft_write", i)}));
}

/** @param {Record<string, Uint8Array>} files @param {string[]} words */
function makePaper(files, words) {
  for (const name of core.FS.readdir(".").filter((/** @type {string} */ n) => n !== "." && n !== "..")) {
    core.FS.unlink(name);
  }
  for (const [name, bytes] of Object.entries(files)) {
    core.FS.writeFile(name, bytes);
  }
  return shown({summary: JSON.parse(textOf("ridgecraft_make", JSON.stringify(words)))});
}

/** With what the page shows. @param {Record<string, any>} result */
function shown(result) {
  return {...result, fold: new TextDecoder().decode(writtenAs("result.fold")[0].bytes), sheets: textOf("ridgecraft_sheets")};
}

/** @param {string} answer to an edit */
function changedPaper(answer) {
  const result = JSON.parse(answer);
  return result.refused ? result : shown(result);
}

worker.onmessage = async (/** @type {MessageEvent} */ {data}) => {
  try {
    if (data.call === "start") {
      worker.postMessage({id: data.id, ...await startCore(data.module)});
    } else if (data.call === "make") {
      worker.postMessage({id: data.id, ...makePaper(data.files, data.words)});
    } else if (data.call === "repeat") {
      worker.postMessage({id: data.id, ...changedPaper(textOf("ridgecraft_repeat", data.steps.join("\n")))});
    } else if (data.call === "apply") {
      worker.postMessage({id: data.id, ...changedPaper(textOf("ridgecraft_apply", data.line))});
    } else if (data.call === "preview") {
      worker.postMessage({id: data.id, ...JSON.parse(textOf("ridgecraft_preview", data.line, data.reach))});
    } else if (data.call === "undo") {
      worker.postMessage({id: data.id, ...changedPaper(textOf("ridgecraft_undo", data.count))});
    } else if (data.call === "show") {
      worker.postMessage({id: data.id, ...changedPaper(textOf("ridgecraft_undo", 0))});
    } else {
      const files = writtenAs(data.name, data.pages);
      worker.postMessage({id: data.id, files}, files.map((/** @type {{bytes: Uint8Array}} */ file) => file.bytes.buffer));
    }
  } catch (error) {
    if (error instanceof Refused) {
      worker.postMessage({id: data.id, error: {code: error.code, message: error.why}});
    } else {
      // A trap: nothing in here can be trusted any more, and the page starts another one.
      worker.postMessage({id: data.id, broken: error instanceof Error ? error.message : String(error)});
    }
  }
};
