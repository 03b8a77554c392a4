// SPDX-License-Identifier: GPL-3.0-or-later
// What runs in the worker, behind the glue of the module (wasm/): it keeps one project and answers one call at a time.
//
//   {id, call: "start", module}            the compiled WebAssembly
//   {id, call: "make", files, words}       files by name, and the words of a command line: the summary, nets and sheets
//   {id, call: "write", name}              the files that this name after -o stands for: [{name, bytes}]
//
// Answers are {id, ...} with `error: {code, sentence}` where a call fails; between them {stage, share} and {note}.

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
    told: (/** @type {string} */ kind, /** @type {string} */ text, /** @type {number} */ share) =>
      worker.postMessage(kind === "progress" ? {stage: text, share} : {note: text}),
    print: () => {},
    printErr: () => {},
  });
  core.FS.mkdir("/project");
  core.FS.chdir("/project");
  return {};
}

/** A sentence of the program's that says why it didn't. */
class Refused extends Error {
  /** @param {string} sentence @param {number} code */
  constructor(sentence, code) {
    super(sentence);
    this.code = code;
  }
}

/** What a function of the module answers. @param {string} name @param {string | number} [value] */
function answerOf(name, value) {
  const code = core.ccall(name, "number", value === undefined ? [] : [typeof value], value === undefined ? [] : [value]);
  const begin = core.ccall("ridgecraft_answer", "number", [], []);
  const bytes = core.HEAPU8.slice(begin, begin + core.ccall("ridgecraft_answer_size", "number", [], []));
  if (code !== 0) {
    throw new Refused(new TextDecoder().decode(bytes), code);
  }
  return bytes;
}

/** @param {string} name @param {string | number} [value] */
const textOf = (name, value) => new TextDecoder().decode(answerOf(name, value));

/** @param {string} name */
function writtenAs(name) {
  return JSON.parse(textOf("ridgecraft_plan", name)).map((/** @type {string} */ file, /** @type {number} */ i) =>
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
  const summary = textOf("ridgecraft_make", JSON.stringify(words));
  return {summary, fold: new TextDecoder().decode(writtenAs("result.fold")[0].bytes), sheets: textOf("ridgecraft_sheets")};
}

worker.onmessage = async (/** @type {MessageEvent} */ {data}) => {
  try {
    if (data.call === "start") {
      worker.postMessage({id: data.id, ...await startCore(data.module)});
    } else if (data.call === "make") {
      worker.postMessage({id: data.id, ...makePaper(data.files, data.words)});
    } else {
      const files = writtenAs(data.name);
      worker.postMessage({id: data.id, files}, files.map((/** @type {{bytes: Uint8Array}} */ file) => file.bytes.buffer));
    }
  } catch (error) {
    if (error instanceof Refused) {
      worker.postMessage({id: data.id, error: {code: error.code, sentence: error.message}});
    } else {
      // A trap: nothing in here can be trusted any more, and the page starts another one.
      worker.postMessage({id: data.id, broken: error instanceof Error ? error.message : String(error)});
    }
  }
};
