// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows, for whoever tests it.

import {hasLine} from "./nets.js";
import {byId} from "./panel.js";
import {reader} from "./words.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("./scene.js").Scene} Scene */

/**
 * @param {App} app
 * @param {{x?: number, y?: number, edge?: number, red?: boolean}} [about] a place in the window; an edge; whether the
 *   pixels are counted that marks turn red on the model
 */
export function inspectApp(app, about = {}) {
  const {nets, scene, plan, guide, motion, folding} = app;
  const {spot, pieces, edges} = app.lit();
  const box = scene.canvas.getBoundingClientRect();
  const {x, y} = about;
  return {
    title: nets.title, pieces: nets.pieces.length, joins: nets.joins.map((join) => ({number: join.number, edges: join.edges, pieces: join.pieces})),
    folds: nets.edges.map((_, e) => e).filter((e) => nets.edges[e].kind !== "B" && hasLine(nets, e)), camera: app.view().camera,
    steps: nets.steps, simple: scene.simple, painted: scene.painted, language: reader.language,
    folded: motion.folded, playing: motion.playing, building: guide.open, step: guide.step, at: guide.at,
    done: [...guide.ticks.done], spot, lit: [...pieces], marked: edges, chosen: [...app.selection.chosen],
    looks: [...scene.looks], foot: byId("foot").textContent, refoldError: folding.refoldError, facesInView: seesAllFaces(scene, box),
    firstPicture: motion.frames.first, script: motion.frames.script, red: about.red ? markedPixels(scene) : -1,
    under: x === undefined || y === undefined ? {sheet: null, model: null}
      : {sheet: plan.pick(x, y, 6), model: scene.pick(x - box.left, y - box.top, 7)},
    places: about.edge === undefined ? null : placesOf(app, about.edge),
  };
}

/** @param {Scene} scene @param {DOMRect} box of its canvas */
function seesAllFaces({corners, camera}, box) {
  for (let c = 0; c < corners.length; c += 6) {
    const [x, y] = camera.project(corners[c], corners[c + 1], corners[c + 2]);
    if (x < -0.5 || y < -0.5 || x > box.width + 0.5 || y > box.height + 0.5) {
      return false;
    }
  }
  return true;
}

/** Where the middle of an edge is in the window, on both sides. @param {App} app @param {number} e */
function placesOf({scene, plan}, e) {
  const box = scene.canvas.getBoundingClientRect();
  const [p, q] = scene.edgeEnds(e);
  const [x, y] = scene.camera.project(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2]));
  return {model: [box.left + x, box.top + y], sheet: plan.clientOf(e)};
}

/** How many pixels of the model's view marks change. @param {Scene} scene */
function markedPixels(scene) {
  const {canvas, marked} = scene;
  const copy = document.createElement("canvas");
  copy.width = canvas.width;
  copy.height = canvas.height;
  const context = copy.getContext("2d", {willReadFrequently: true});
  if (!context || copy.width < 2 || copy.height < 2) {
    return 0;
  }
  const [bare, whole] = [new Set(), marked].map((edges) => {
    scene.marked = edges;
    scene.draw();
    context.clearRect(0, 0, copy.width, copy.height);
    context.drawImage(canvas, 0, 0);
    return context.getImageData(0, 0, copy.width, copy.height).data;
  });
  let count = 0;
  for (let i = 0; i < bare.length; i += 4) {
    count += whole[i] - whole[i + 1] - (bare[i] - bare[i + 1]) > 30 ? 1 : 0;
  }
  return count;
}
