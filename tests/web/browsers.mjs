// SPDX-License-Identifier: GPL-3.0-or-later
// The browsers of Debian, driven by playwright-core from the folder of the tools.
import {existsSync} from "node:fs";
import {createRequire} from "node:module";

const programs = {chromium: "/usr/bin/chromium", firefox: "/usr/bin/firefox-esr"};

/** Ends the test as skipped. @param {string} why */
export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

/** @param {string} tools folder with node_modules */
export function toolsIn(tools) {
  const require = createRequire(`${tools}/`);
  if (!existsSync(`${tools}/complete`)) {
    skip("the tools of npm are missing (tests/web/tools.sh fetches them)");
  }
  return require;
}

/**
 * @param {NodeRequire} require of the tools
 * @param {"chromium"|"firefox"} name
 * @param {boolean} webgl
 */
export async function launch(require, name, webgl) {
  const playwright = require("playwright-core");
  if (!existsSync(programs[name])) {
    skip(`${programs[name]} is missing`);
  }
  if (name === "firefox") {
    return playwright.firefox.launch({channel: "moz-firefox", executablePath: programs.firefox});
  }
  return playwright.chromium.launch({executablePath: programs.chromium, args: [
    ...(process.getuid?.() === 0 ? ["--no-sandbox"] : []),
    ...(webgl ? ["--enable-unsafe-swiftshader"] : ["--disable-3d-apis"])]});
}

/**
 * Waits until the page has laid itself out: an element's new size reaches its ResizeObserver in the frame after a change.
 * @param {any} page
 */
export function settled(page) {
  return page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}
