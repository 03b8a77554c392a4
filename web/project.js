// SPDX-License-Identifier: GPL-3.0-or-later
// Files that hold more than a model: projects, pages with a project, nets; archives and folders of files.

import {filesOfZip, isZip} from "./archive.js";
import {bytesOf} from "./packed.js";

/** @typedef {{name: string, bytes: Uint8Array}} NamedBytes */

/** @typedef {{name: string, files: Record<string, Uint8Array>, words: string[], steps: string[]}} OpenedProject */

/** That a project may hold; it is made by the program (session/project_file.hpp). */
const contentsName = "ridgecraft.json";

/** A file that can't be what its name says. */
export class Damaged extends Error {
  /** @param {string} name */
  constructor(name) {
    super(name);
    this.name = "Damaged";
  }
}

/** @param {string} name */
const bare = (name) => name.replace(/^.*[\\/]/, "");

/** @param {unknown} list @returns {string[]} */
function textsIn(list) {
  if (!Array.isArray(list) || !list.every((item) => typeof item === "string")) {
    throw new Error("no list of words");
  }
  return list;
}

/** What archives hold, as long as these are there: each is asked whether it is a project first. @type {WeakMap<Uint8Array, Promise<NamedBytes[]>>} */
const unpacked = new WeakMap();

/** @param {Uint8Array} bytes of an archive */
function entriesOf(bytes) {
  const entries = unpacked.get(bytes) ?? filesOfZip(bytes);
  unpacked.set(bytes, entries);
  return entries;
}

/** @param {NamedBytes[]} entries of an archive @returns {OpenedProject | null} none where they are no project */
function projectOf(entries) {
  const contents = entries.find(({name}) => name === contentsName);
  if (!contents) {
    return null;
  }
  const {model, words, files, edits} = JSON.parse(new TextDecoder().decode(contents.bytes));
  const beside = Object.fromEntries(textsIn(files).map((name) => {
    const entry = entries.find((one) => one.name === `model/${name}`);
    if (!entry || bare(name) !== name) {
      throw new Error("a file is missing");
    }
    return [name, entry.bytes];
  }));
  if (!beside[model]) {
    throw new Error("the model is missing");
  }
  return {name: model, files: beside, words: textsIn(words), steps: String(edits).split("\n").filter((line) => line !== "")};
}

/** The project in a page of a result. @param {Uint8Array} bytes */
async function projectInPage(bytes) {
  const text = new TextDecoder().decode(bytes);
  const packed = /<script type="text\/plain" id="project">([^<]*)<\/script>/.exec(text);
  return packed ? projectOf(await filesOfZip(bytesOf(packed[1]))) : null;
}

/** The project that a file is, or holds; none where it is something else. @param {NamedBytes} file @returns {Promise<OpenedProject | null>} */
export async function readProject({name, bytes}) {
  try {
    if (/\.html?$/i.test(name)) {
      return await projectInPage(bytes);
    }
    return /\.ridgecraft$/i.test(name) || (/\.zip$/i.test(name) && isZip(bytes)) ? projectOf(await entriesOf(bytes)) : null;
  } catch {
    throw new Damaged(name);
  }
}

/**
 * The model of a file of nets (FOLD), as the nets fold: mm, without colours.
 * @param {string} text
 * @returns {string} an OBJ file
 */
export function modelOfNets(text) {
  const fold = JSON.parse(text);
  const frame = fold.file_frames.find((/** @type {any} */ one) => one.frame_classes?.includes("foldedForm"));
  const points = frame.vertices_coords.map((/** @type {number[]} */ point) => `v ${point.join(" ")}`);
  const faces = frame.faces_vertices.map((/** @type {number[]} */ face) => `f ${face.map((v) => v + 1).join(" ")}`);
  return `${points.join("\n")}\n${faces.join("\n")}\n`;
}

/** Files in place of archives among them. @param {NamedBytes[]} files @returns {Promise<NamedBytes[]>} */
export async function withoutArchives(files) {
  const all = await Promise.all(files.map(async (file) => {
    if (!/\.zip$/i.test(file.name) || !isZip(file.bytes)) {
      return [file];
    }
    try {
      return (await entriesOf(file.bytes)).filter(({name}) => !/(^|\/)(__MACOSX\/|\.)/.test(name)).map(({name, bytes}) => ({name: bare(name), bytes}));
    } catch {
      throw new Damaged(file.name);
    }
  }));
  return all.flat();
}

/** The most files of a folder that are looked at. */
const mostFiles = 500;

/** @param {any} entry of a folder that was dropped @param {File[]} into @returns {Promise<void>} */
async function collect(entry, into) {
  if (into.length >= mostFiles) {
    return;
  }
  if (entry.isFile) {
    into.push(await new Promise((resolve, reject) => entry.file(resolve, reject)));
    return;
  }
  const reader = entry.createReader();
  for (let part = [null]; part.length > 0;) {
    part = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    for (const one of part) {
      await collect(one, into);
    }
  }
}

/** What was dropped, with what is in folders. @param {DataTransfer} data @returns {Promise<File[]>} */
export async function filesDropped(data) {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry?.() ?? null);
  if (!entries.some((entry) => entry?.isDirectory)) {
    return [...data.files];
  }
  /** @type {File[]} */
  const files = [];
  for (const entry of entries) {
    if (entry) {
      await collect(entry, files);
    }
  }
  return files;
}
