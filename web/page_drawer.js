// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn on a page, as SVG.

import {hasLine} from "./nets.js";

/** @typedef {import("./folding.js").Folding} Folding */
/** @typedef {import("./nets.js").Nets} Nets */

/**
 * What the second document of the page says of a group (docs/design/viewer.md).
 * @typedef {object} Group
 * @property {string} id
 * @property {[number, string, number, number, number, number, number?, number?][]} [texts] layer, text, x, y, height, degrees,
 *   flags, width
 * @property {[string, number, number[], number[]][]} [lines] colour, width, dashes, points
 * @property {[string, number[]][]} [areas] colour, outline
 * @property {[string, number[][]][]} [ground]
 * @property {[number[], string, number[][]][]} [images] place, JPEG, clip
 * @property {[string, number[][]][]} [fills]
 *
 * @typedef {{pages: {size: number[], groups: Group[]}[]}} Sheets
 */

const svgSpace = "http://www.w3.org/2000/svg";
/** Classes of texts: numbers, names of pieces, words of the page. */
const layerNames = ["number", "name", "word"];
/** Of capital letters, as a share of the font's size. */
const capitals = 0.72;

/**
 * @template {keyof SVGElementTagNameMap} Name
 * @param {Name} name
 * @param {Record<string, string | number>} [attributes]
 * @param {Element} [parent]
 * @returns {SVGElementTagNameMap[Name]}
 */
export function svgElement(name, attributes = {}, parent) {
  const element = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, String(value));
  }
  parent?.append(element);
  return element;
}

/** @param {number} value */
function short(value) {
  return Math.round(value * 1000) / 1000;
}

/** Of what cuts pictures out, on all pages that there have been. */
let clips = 0;

/** Draws pages: all that is on paper, in mm from the left upper corner of the sheet. */
export class PageDrawer {
  /**
   * @param {Nets} nets
   * @param {Folding} folding
   * @param {Sheets} sheets
   */
  constructor(nets, folding, sheets) {
    this.nets = nets;
    this.folding = folding;
    this.sheets = sheets;
    this.pieceByGroup = new Map(nets.pieces.map((piece) => [`piece-${piece.name}`, piece.index]));
    /** What the second document says of each piece. @type {Map<number, Group | undefined>} */
    this.groupOf = new Map(nets.pieces.map(({index, name, page}) => [index, sheets.pages[page]?.groups.find(({id}) => id === `piece-${name}`)]));
    this.painted = sheets.pages.some((page) => page.groups.some((group) => group.images || group.fills || group.ground));
  }

  /** How many pages there are, those with lists of numbers included. */
  get count() {
    return Math.max(this.sheets.pages.length, this.nets.pages.length);
  }

  /** @param {number} p */
  size(p) {
    const page = this.nets.pages[p];
    return this.sheets.pages[p]?.size ?? [page.width, page.height];
  }

  /** From the plane of all nets to the sheet. @param {number} p @param {number} x @param {number} y */
  onSheet(p, x, y) {
    const page = this.nets.pages[p];
    return [short(x - page.x), short(page.height - (y - page.y))];
  }

  /** @param {number} p @param {number[][]} points @param {boolean} closed */
  #path(p, points, closed) {
    return `M${points.map(([x, y]) => this.onSheet(p, x, y).join(" ")).join("L")}${closed ? "Z" : ""}`;
  }

  /** Of numbers in the second document: y up, from the lower corner. @param {number} p @param {number[]} numbers @param {boolean} closed */
  #writtenPath(p, numbers, closed) {
    const height = this.size(p)[1];
    let d = "";
    for (let i = 0; i < numbers.length; i += 2) {
      d += `${i === 0 ? "M" : "L"}${short(numbers[i])} ${short(height - numbers[i + 1])}`;
    }
    return closed ? `${d}Z` : d;
  }

  /** @param {number} e @returns {number[][]} */
  ends(e) {
    const {points, edges} = this.nets;
    return [edges[e].a, edges[e].b].map((v) => [points[2 * v], points[2 * v + 1]]);
  }

  /** @param {number} p page @param {number} e */
  edgePath(p, e) {
    return this.#path(p, this.ends(e), false);
  }

  /** @param {number} index of a piece */
  outlines(index) {
    const {nets, folding} = this;
    const piece = nets.pieces[index];
    const p = piece.page;
    const lines = {faces: "", tabs: "", cut: "", mountain: "", valley: "", base: ""};
    for (const f of piece.faces) {
      lines.faces += this.#path(p, folding.flatCorners(f), true);
    }
    for (const e of piece.edges) {
      const edge = nets.edges[e];
      const [a, b] = this.ends(e);
      if (edge.kind !== "B") {
        if (hasLine(nets, e)) {
          lines[edge.kind === "M" ? "mountain" : "valley"] += this.#path(p, [a, b], false);
        }
      } else if (edge.tab < 0) {
        lines.cut += this.#path(p, [a, b], false);
      } else {
        const share = (/** @type {number[]} */ q) => ((q[0] - a[0]) * (b[0] - a[0]) + (q[1] - a[1]) * (b[1] - a[1])) / (edge.length * edge.length);
        const at = (/** @type {number} */ t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        const bases = [];
        for (const t of edge.tabs) {
          const polygon = nets.tabs[t].polygon;
          lines.tabs += nets.tabs[t].slit ? "" : this.#path(p, polygon, true);
          lines.cut += this.#path(p, [...polygon.slice(1), polygon[0]], false);
          const angle = folding.tabAngles[t];
          lines[edge.bent || Math.abs(angle) < nets.hiddenAngle ? "base" : angle < 0 ? "mountain" : "valley"] +=
            this.#path(p, [polygon[0], polygon[1]], false);
          bases.push([share(polygon[0]), share(polygon[1])].sort((s, t) => s - t));
        }
        let bare = 0;
        for (const [from, to] of [...bases.sort((s, t) => s[0] - t[0]), [1, 1]]) {
          if ((from - bare) * edge.length > 0.02) {
            lines.cut += this.#path(p, [at(bare), at(from)], false);
          }
          bare = to;
        }
      }
    }
    for (const slit of piece.slits) {
      lines.cut += this.#path(p, slit, false);
    }
    return lines;
  }

  /** @param {Element} parent @param {number} p @param {[string, number[][]][]} fills */
  #fills(parent, p, fills) {
    for (const [colour, polygons] of fills) {
      svgElement("path", {class: "fill", fill: colour, stroke: colour,
        d: polygons.map((polygon) => this.#writtenPath(p, polygon, true)).join("")}, parent);
    }
  }

  /** @param {Element} parent @param {number} p @param {Group} group */
  #paint(parent, p, group) {
    const height = this.size(p)[1];
    for (const [place, jpeg, clip] of group.images ?? []) {
      const id = `clip-${++clips}`;
      svgElement("path", {d: clip.map((polygon) => this.#writtenPath(p, polygon, true)).join("")},
        svgElement("clipPath", {id}, parent));
      svgElement("image", {x: place[0], y: short(height - place[3]), width: short(place[2] - place[0]),
        height: short(place[3] - place[1]), preserveAspectRatio: "none", "clip-path": `url(#${id})`,
        href: `data:image/jpeg;base64,${jpeg}`}, parent);
    }
    this.#fills(parent, p, group.fills ?? []);
  }

  /** Colours that reach below other pieces. @param {Element} parent @param {number} p @returns {SVGElement[]} by piece */
  ground(parent, p) {
    /** @type {SVGElement[]} */
    const grounds = [];
    for (const group of this.sheets.pages[p]?.groups ?? []) {
      if (group.ground) {
        const own = svgElement("g", {}, parent);
        this.#fills(own, p, group.ground);
        grounds[this.pieceByGroup.get(group.id) ?? -1] = own;
      }
    }
    return grounds;
  }

  /** Lines, areas and texts that the program has placed. @param {Element} parent @param {number} p @param {Group} group */
  marks(parent, p, group) {
    const height = this.size(p)[1];
    for (const [colour, area] of group.areas ?? []) {
      svgElement("path", {fill: colour, d: this.#writtenPath(p, area, true)}, parent);
    }
    for (const [colour, width, dashes, points] of group.lines ?? []) {
      svgElement("path", {class: "written", stroke: colour, "stroke-width": width, "stroke-dasharray": dashes.join(" "),
        d: this.#writtenPath(p, points, false)}, parent);
    }
    for (const [layer, text, x, y, size, angle, flags = 0, width = 0] of group.texts ?? []) {
      const kind = layerNames[layer];
      const place = `translate(${x} ${short(height - y)})${angle ? ` rotate(${-angle})` : ""}`;
      const element = svgElement("text", {class: `${kind}${flags & 2 ? " light" : ""}`, transform: place, y: short(size / 2),
        "font-size": short(size / capitals)}, parent);
      element.textContent = text;
      if (text.length > 4 && width > 0) {
        element.setAttribute("textLength", String(short(width)));
        element.setAttribute("lengthAdjust", "spacingAndGlyphs");
      }
      if (flags & 1) {
        svgElement("path", {class: `written ${kind}-line`, transform: place, stroke: flags & 2 ? "#ececec" : "#000",
          "stroke-width": short(size / 9), d: `M${short(-width / 2)} ${short(0.76 * size)}H${short(width / 2)}`}, parent);
      }
    }
  }

  /**
   * What is to be drawn of a piece. Two that look alike are alike as JSON.
   * @param {number} index
   * @param {boolean} tinted in the piece's own colour, as on the screen
   */
  look(index, tinted) {
    const piece = this.nets.pieces[index];
    const tint = piece.colour.map((value) => Math.round(0.55 * value + 0.45 * 255));
    return {page: piece.page, size: this.size(piece.page), painted: this.painted, fill: tinted && !this.painted ? `rgb(${tint})` : "#fff",
      lines: this.outlines(index), group: this.groupOf.get(index)};
  }

  /**
   * A piece as it lies on its page.
   * @param {Element} parent
   * @param {ReturnType<PageDrawer["look"]>} look
   */
  piece(parent, {page, fill, lines, group}) {
    svgElement("path", {class: "faces", fill, d: lines.faces}, parent);
    if (group) {
      this.#paint(parent, page, group);
    }
    svgElement("path", {class: "tabs", d: lines.tabs}, parent);
    if (this.painted) {
      svgElement("path", {class: "rim", d: lines.mountain + lines.valley + lines.base}, parent);
    }
    for (const kind of /** @type {const} */ (["mountain", "valley", "base", "cut"])) {
      if (lines[kind]) {
        svgElement("path", {class: kind, d: lines[kind]}, parent);
      }
    }
    if (group) {
      this.marks(parent, page, group);
    }
  }

  /** What belongs to no piece of a page. @param {number} p */
  furniture(p) {
    return (this.sheets.pages[p]?.groups ?? []).filter(({id}) => !this.pieceByGroup.has(id));
  }

  /** A page for the printer, in true size. @param {number} p */
  printed(p) {
    const [width, height] = this.size(p);
    const svg = svgElement("svg", {class: "plan", width: `${width}mm`, height: `${height}mm`, viewBox: `0 0 ${width} ${height}`});
    this.ground(svg, p);
    for (const index of this.nets.pages[p]?.pieces ?? []) {
      this.piece(svgElement("g", {}, svg), this.look(index, false));
    }
    this.furniture(p).forEach((group) => this.marks(svg, p, group));
    return svg;
  }

  /**
   * The colours of a page as a picture, for the model's view.
   * @param {number} p
   * @param {number} scale pixels a mm
   * @returns {Promise<HTMLCanvasElement>}
   */
  async picture(p, scale) {
    const [width, height] = this.size(p);
    const canvas = document.createElement("canvas");
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    context.fillStyle = "#fff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.setTransform(scale, 0, 0, -scale, 0, canvas.height);
    const pathOf = (/** @type {number[][]} */ polygons) => {
      const path = new Path2D();
      for (const polygon of polygons) {
        for (let i = 0; i < polygon.length; i += 2) {
          i === 0 ? path.moveTo(polygon[0], polygon[1]) : path.lineTo(polygon[i], polygon[i + 1]);
        }
        path.closePath();
      }
      return path;
    };
    const fill = (/** @type {[string, number[][]][]} */ fills) => {
      for (const [colour, polygons] of fills) {
        context.fillStyle = context.strokeStyle = colour;
        context.lineWidth = 0.12;
        const path = pathOf(polygons);
        context.fill(path);
        context.stroke(path);
      }
    };
    const groups = this.sheets.pages[p]?.groups ?? [];
    groups.forEach((group) => fill(group.ground ?? []));
    for (const group of groups) {
      for (const [place, jpeg, clip] of group.images ?? []) {
        const image = new Image();
        image.src = `data:image/jpeg;base64,${jpeg}`;
        await image.decode();
        context.save();
        context.clip(pathOf(clip));
        context.translate(place[0], place[3]);
        context.scale(1, -1);
        context.drawImage(image, 0, 0, place[2] - place[0], place[3] - place[1]);
        context.restore();
      }
      fill(group.fills ?? []);
    }
    return canvas;
  }
}
