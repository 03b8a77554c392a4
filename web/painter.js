// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the stage where there is no WebGL 2: triangles in a canvas, the far ones first.

/** @typedef {import("./webgl.js").Picture} Picture */

export class PainterView {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    /** @type {Float32Array} */
    this.spots = new Float32Array(0);
    /** @type {(ImageData | null)[]} */
    this.pages = [];
  }

  /** @param {Float32Array} spots */
  setSpots(spots) {
    this.spots = spots;
  }

  /** @param {HTMLCanvasElement[]} pictures */
  setPaint(pictures) {
    this.pages = pictures.map((picture) => {
      const context = picture.getContext("2d");
      return context && picture.width > 0 ? context.getImageData(0, 0, picture.width, picture.height) : null;
    });
  }

  /** What the picture of its page has in the middle of a triangle. @param {number} i @param {number} page */
  #paintAt(i, page) {
    const data = this.pages[page];
    if (!data) {
      return [255, 255, 255];
    }
    const at = (/** @type {number} */ k, /** @type {number} */ size) => Math.min(size - 1, Math.max(0, Math.floor(
      (size * (this.spots[6 * i + k] + this.spots[6 * i + 2 + k] + this.spots[6 * i + 4 + k])) / 3)));
    const pixel = 4 * (at(1, data.height) * data.width + at(0, data.width));
    return [data.data[pixel], data.data[pixel + 1], data.data[pixel + 2]];
  }

  /** @param {Picture} picture */
  draw(picture) {
    const {context, canvas} = this;
    const {camera, corners, tints} = picture;
    const ratio = canvas.width / camera.width;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, camera.width, camera.height);
    context.lineJoin = "round";
    for (const {corners: sheet, opacity} of picture.sheets) {
      this.#fill([sheet[0], sheet[1], sheet[3], sheet[2]].map(([x, y, z]) => camera.project(x, y, z)), `rgba(255,255,255,${opacity})`);
    }
    /** @type {number[]} */
    const pageOf = [];
    for (const run of picture.runs) {
      for (let i = run.from; i < run.to; ++i) {
        pageOf[i] = run.page;
      }
    }
    /** @type {{far: number, draw: () => void}[]} */
    const items = [];
    const sun = [camera.right[0] * -0.5 + camera.toward[0] * 0.5, 0.75, camera.right[2] * -0.5 + camera.toward[2] * 0.5];
    const opacityOf = (/** @type {number} */ i) => tints[12 * i + 3] / 255;
    const isSeen = (/** @type {number} */ i) => opacityOf(i) >= 0.02;
    let allPlaced = true;
    for (let i = 0; i < corners.length / 18; ++i) {
      allPlaced = allPlaced && (!isSeen(i) || picture.placed(i));
    }
    for (let i = 0; i < corners.length / 18; ++i) {
      if (!isSeen(i)) {
        continue;
      }
      const opacity = opacityOf(i);
      const seen = [0, 1, 2].map((k) => {
        const c = 18 * i + 6 * k;
        return camera.project(corners[c], corners[c + 1], corners[c + 2]);
      });
      const turn = (seen[1][0] - seen[0][0]) * (seen[2][1] - seen[0][1]) - (seen[1][1] - seen[0][1]) * (seen[2][0] - seen[0][0]);
      const front = turn < 0;
      const sign = front ? 1 : -1;
      const n = [sign * corners[18 * i + 3], sign * corners[18 * i + 4], sign * corners[18 * i + 5]];
      const light = 0.62 + 0.4 * Math.max(0, n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2]);
      const paint = picture.painted && front ? this.#paintAt(i, pageOf[i] ?? -1) : [255, 255, 255];
      const base = [0, 1, 2].map((k) => Math.min(255, Math.round(
        light * (front ? (tints[12 * i + k] * paint[k]) / 255 : 255 * picture.paper[k]))));
      const colour = `rgba(${base},${opacity})`;
      // Tabs lie under the faces that they are glued to. Where all that is seen is in its place, back sides are behind front
      // sides, and tabs between the two; the middle of a long triangle doesn't tell. A piece that still flies may be behind
      // the back of another.
      const tab = pageOf[i] === -1;
      const layer = !allPlaced ? (tab ? 0.05 : 0) : tab ? 1e3 : front ? 0 : 2e3;
      items.push({far: (seen[0][2] + seen[1][2] + seen[2][2]) / 3 + layer * camera.size, draw: () => this.#fill(seen, colour, opacity > 0.99)});
    }
    const line = (/** @type {number} */ i) => {
      const [p, q] = [0, 3].map((k) => camera.project(picture.lines[6 * i + k], picture.lines[6 * i + k + 1], picture.lines[6 * i + k + 2]));
      const [r, g, b, a] = picture.lineTints.subarray(4 * i, 4 * i + 4);
      return {far: 0.5 * (p[2] + q[2]) - 0.02 * camera.size, draw: () => {
        context.strokeStyle = `rgba(${r},${g},${b},${a / 255})`;
        context.lineWidth = picture.lineWidths[i];
        context.beginPath();
        context.moveTo(p[0], p[1]);
        context.lineTo(q[0], q[1]);
        context.stroke();
      }};
    };
    const plain = picture.lineCount - picture.markCount;
    for (let i = 0; i < plain; ++i) {
      items.push(line(i));
    }
    items.sort((a, b) => b.far - a.far);
    items.forEach((item) => item.draw());
    for (let i = plain; i < picture.lineCount; ++i) {
      line(i).draw();
    }
  }

  /** @param {number[][]} points @param {string} colour @param {boolean} [seamless] */
  #fill(points, colour, seamless = false) {
    const {context} = this;
    context.beginPath();
    points.forEach(([x, y], k) => (k === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    context.closePath();
    context.fillStyle = colour;
    context.fill();
    if (seamless) {
      context.strokeStyle = colour;
      context.lineWidth = 0.7;
      context.stroke();
    }
  }
}
