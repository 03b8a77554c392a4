// SPDX-License-Identifier: GPL-3.0-or-later
// How far the model is folded or a step is built, how that plays, and the frames in which it is drawn.

import {foldShare, smooth} from "./folding.js";
import {byId} from "./panel.js";
import {say, sayNumber} from "./words.js";

/** Seconds from flat to built at speed 1, and those of a step. */
const foldSeconds = 8;
const stepSeconds = 6;
const speeds = [0.5, 1, 2, 4];

export class Motion {
  /**
   * @param {import("./scene.js").Scene} scene
   * @param {import("./guide.js").Guide} guide
   * @param {() => number[]} marked edges that are marked now
   * @param {AbortSignal} ended when the page shows something else
   */
  constructor(scene, guide, marked, ended) {
    this.scene = scene;
    this.guide = guide;
    this.marked = marked;
    this.ended = ended;
    /** The slider: 0 flat, 1 built. */
    this.folded = 1;
    /** 1 while it folds, -1 while it unfolds, 0 while it rests. */
    this.playing = 0;
    this.speed = 1;
    /** Whether the reader wants no motion. */
    this.reduced = matchMedia("(prefers-reduced-motion:reduce)");
    /** Whether the eye stays where the reader has put it, instead of bending down to the table. */
    this.freeView = false;
    /** Whether faces are where they belong. */
    this.posed = false;
    /** Whether the picture from before stays until the pages' pictures are there. */
    this.waiting = false;
    /** Whether what else has changed on the page is to be seen first. */
    this.late = false;
    this.frames = {first: 0, script: 0, last: 0};
    /** Goes on until it gives false. @type {((now: number) => boolean) | null} */
    this.turning = null;
  }

  /** Draws in the next frame. */
  request() {
    if (!this.requested) {
      this.requested = true;
      requestAnimationFrame((now) => this.frame(now));
    }
  }

  /** Draws once the page has been: without a graphics card the model takes several times as long as the sheets. */
  drawLate() {
    this.late = true;
    requestAnimationFrame(() => setTimeout(() => {
      this.late = false;
      this.request();
    }));
  }

  /** Something has moved. */
  repose() {
    this.posed = false;
    this.request();
  }

  /**
   * Turns the eye.
   * @param {number} azimuth
   * @param {number} elevation
   * @param {number} milliseconds
   * @param {number} [from] how far to the side it begins
   */
  turnTo(azimuth, elevation, milliseconds, from) {
    const {camera} = this.scene;
    const begin = [from === undefined ? camera.azimuth : azimuth + from, camera.elevation];
    const turn = from === undefined ? Math.atan2(Math.sin(azimuth - begin[0]), Math.cos(azimuth - begin[0])) : -from;
    const start = performance.now();
    this.turning = (now) => {
      const t = this.reduced.matches ? 1 : smooth((now - start) / milliseconds);
      camera.azimuth = begin[0] + t * turn;
      camera.elevation = begin[1] + t * (elevation - begin[1]);
      return t < 1;
    };
    this.request();
  }

  /** @param {number} now */
  frame(now) {
    this.requested = false;
    if (this.ended.aborted) {
      return;
    }
    const begin = performance.now();
    const seconds = Math.min(0.1, Math.max(0, (now - this.frames.last) / 1000));
    this.frames.last = now;
    if (this.turning && !this.turning(now)) {
      this.turning = null;
    }
    if (this.playing !== 0) {
      this.#advance(seconds * this.speed);
    }
    if (!this.posed) {
      this.#pose();
      this.posed = true;
    }
    if (!this.waiting && !this.late) {
      this.scene.draw();
    }
    this.guide.label();
    if (this.frames.first === 0) {
      this.frames.first = performance.now();
    }
    this.frames.script = performance.now() - begin;
    if (this.turning || this.playing !== 0) {
      this.request();
    }
  }

  /** @param {number} seconds */
  #advance(seconds) {
    const at = this.guide.open ? this.guide.at + (this.playing * seconds) / stepSeconds
      : this.folded + (this.playing * seconds) / foldSeconds;
    this.setMoment(Math.min(1, Math.max(0, at)));
    if (at >= 1 || at <= 0) {
      this.playing = 0;
      this.say();
    }
  }

  /** Sets the slider, of the whole or of a step. @param {number} t */
  setMoment(t) {
    if (this.guide.open) {
      this.guide.at = t;
    } else {
      this.folded = t;
      this.freeView &&= t > 0 && t < 1;
    }
    const slider = /** @type {HTMLInputElement} */ (byId("fold-slider"));
    slider.value = String(Math.round(1000 * t));
    slider.setAttribute("aria-valuetext", `${Math.round(100 * t)} %`);
    slider.style.setProperty("--share", String(t));
    this.repose();
  }

  #pose() {
    const {scene, guide} = this;
    if (guide.open) {
      guide.pose();
      scene.marked = new Set(this.marked());
      return;
    }
    scene.folding.putAll(this.folded);
    scene.place();
    const flown = smooth((this.folded - foldShare) / (1 - foldShare));
    const pieces = scene.roomOf(() => true);
    scene.table = 1 - flown;
    if (scene.table > 0) {
      const {grid} = scene.folding;
      const width = Math.max(grid.columns * grid.width - grid.gap, pieces.width + 2 * Math.abs(pieces.x));
      const depth = Math.max(grid.rows * grid.height - grid.gap, pieces.depth + 2 * Math.abs(pieces.z));
      const sheets = {x: 0, z: 0, low: Math.min(0, pieces.low), high: pieces.high, width, depth,
        radius: Math.max(0.5 * Math.hypot(width, depth), pieces.radius + Math.hypot(pieces.x, pieces.z))};
      scene.lookAt(sheets, pieces, flown);
    } else {
      scene.lookAt(pieces);
    }
    scene.camera.tilt = this.freeView ? 0 : scene.table;
  }

  /** Plays, or pauses. */
  play() {
    if (this.playing !== 0) {
      this.playing = 0;
    } else {
      const at = this.guide.open ? this.guide.at : this.folded;
      if (this.guide.open && at >= 1) {
        this.setMoment(0);
      }
      this.playing = !this.guide.open && at >= 1 ? -1 : 1;
      this.#skip();
    }
    this.say();
    this.request();
  }

  /** Begins the step that the guide has gone to. */
  playStep() {
    this.setMoment(this.guide.at);
    this.playing = this.guide.at === 0 ? 1 : 0;
    this.#skip();
    this.say();
  }

  /** Goes to the end at once for who wants no motion. */
  #skip() {
    if (this.reduced.matches && this.playing !== 0) {
      this.setMoment(this.playing > 0 ? 1 : 0);
      this.playing = 0;
    }
  }

  pause() {
    this.playing = 0;
    this.say();
  }

  /** Shows all of the model again. */
  home() {
    this.scene.camera.home();
    this.freeView = false;
    this.repose();
  }

  nextSpeed() {
    this.speed = speeds[(speeds.indexOf(this.speed) + 1) % speeds.length];
    this.say();
  }

  /** What the buttons say. */
  say() {
    const speed = byId("speed");
    speed.textContent = `${sayNumber(this.speed, this.speed < 1 ? 1 : 0)}×`;
    speed.title = say("speed", {speed: speed.textContent});
    speed.setAttribute("aria-label", speed.title);
    const play = byId("play");
    play.classList.toggle("playing", this.playing !== 0);
    play.title = say(this.playing !== 0 ? "pause" : "play");
    play.setAttribute("aria-label", play.title);
  }
}
