// SPDX-License-Identifier: GPL-3.0-or-later
// Printing from the browser: the sheets in true size, and the guide with a picture of each step.

import {htmlElement} from "./guide.js";
import {countSeams} from "./nets.js";
import {say, sayCount, sayList, sayNumber} from "./words.js";

/** @typedef {import("./guide.js").Guide} Guide */
/** @typedef {import("./page_drawer.js").PageDrawer} PageDrawer */

const a4 = [210, 297];
const stepsOnPage = 6;

/** Fills the part of the page that only printers see. */
export class Printer {
  /**
   * @param {HTMLElement} place
   * @param {PageDrawer} drawer
   * @param {Guide} guide
   * @param {AbortSignal} ended when the page shows something else
   */
  constructor(place, drawer, guide, ended) {
    this.place = place;
    this.drawer = drawer;
    this.guide = guide;
    this.filled = false;
    /** Why the sheets can't be printed as they are shown; nothing where they can. */
    this.whyNot = () => "";
    globalThis.addEventListener("beforeprint", () => this.filled || this.#fillSheets(), {signal: ended});
    globalThis.addEventListener("afterprint", () => {
      this.place.replaceChildren();
      this.filled = false;
    }, {signal: ended});
  }

  /** A policy that allows no styles but those of the page lets rules be added to its own sheet. @param {number[]} size mm */
  #setPage([width, height]) {
    const sheet = document.styleSheets[0];
    const last = sheet.cssRules.length - 1;
    if (sheet.cssRules[last] instanceof CSSPageRule) {
      sheet.deleteRule(last);
    }
    sheet.insertRule(`@page { size: ${width}mm ${height}mm; margin: 0 }`, sheet.cssRules.length);
  }

  #fillSheets() {
    const {drawer, place} = this;
    this.#setPage(drawer.size(0));
    place.replaceChildren(this.whyNot());
    if (this.whyNot() !== "") {
      return;
    }
    for (let p = 0; p < drawer.count; ++p) {
      const [width, height] = drawer.size(p);
      const page = htmlElement("div", {class: "printed"}, [drawer.printed(p)]);
      page.style.width = `${width}mm`;
      // Browsers round to dots: what is a hair too high would begin another page.
      page.style.height = `${height - 0.05}mm`;
      place.append(page);
    }
  }

  printSheets() {
    globalThis.print();
  }

  async printGuide() {
    const {guide, place} = this;
    const {nets} = guide;
    this.#setPage(a4);
    const picture = (/** @type {string} */ source) => htmlElement("img", {src: source, alt: ""});
    const names = (/** @type {number[]} */ pieces) => sayList(pieces.map((p) => nets.pieces[p].name));
    const cover = htmlElement("div", {class: "guide-page cover"}, [
      htmlElement("div", {}, [htmlElement("h1", {}, [say("guide_title", {title: nets.title})]),
        htmlElement("p", {class: "quiet"}, [sayList([sayCount("pieces", nets.pieces.length), sayCount("pages", nets.pages.length), sayCount("seams", countSeams(nets, nets.joins.map((_, j) => j)))])])]),
      picture(guide.picture(-1)),
      htmlElement("div", {}, nets.pages.map((page, p) => htmlElement("p", {}, [say("on_page", {page: say("page", {page: p + 1}), names: names(page.pieces)})]))),
    ]);
    const steps = nets.steps.map((step, k) => {
      const numbers = [...new Set(step.joins.map((j) => String(nets.joins[j].number)))];
      return htmlElement("figure", {}, [
        htmlElement("div", {}, [htmlElement("strong", {}, [`${sayNumber(k + 1)}. ${say("piece", {name: names(step.pieces)})}`]),
          htmlElement("span", {class: "quiet"}, [` ${sayList([...new Set(step.pieces.map((p) => say("page", {page: nets.pieces[p].page + 1})))])}`])]),
        picture(guide.picture(k)),
        htmlElement("p", {class: "quiet"}, [numbers.join(" · ")]),
      ]);
    });
    const pages = [cover];
    for (let k = 0; k < steps.length; k += stepsOnPage) {
      pages.push(htmlElement("div", {class: "guide-page"}, steps.slice(k, k + stepsOnPage)));
    }
    place.replaceChildren(...pages);
    this.filled = true;
    guide.restore();
    await Promise.all([...place.querySelectorAll("img")].map((image) => image.decode()));
    globalThis.print();
  }
}
