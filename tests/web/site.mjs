// SPDX-License-Identifier: GPL-3.0-or-later
// The static site: what it names is there, and after the first visit the studio opens without a network.
import {execFileSync} from "node:child_process";
import {existsSync, readdirSync, readFileSync, statSync} from "node:fs";
import {createServer} from "node:http";
import {dirname, extname, join, normalize} from "node:path";

import {launch, skip} from "./browsers.mjs";
import {playedPage} from "./played.mjs";
import {end, subject} from "./subject.mjs";

const {values, require, out, faults, check} = subject();
const site = join(out, "site");
try {
  execFileSync("sh", ["-c", "command -v cmark-gfm"], {stdio: "ignore"});
} catch {
  skip("cmark-gfm is missing");
}
execFileSync("sh", [`${values.web}/site/build.sh`, await playedPage(values), site], {stdio: ["ignore", "ignore", "inherit"]});

/** Each file that a page names is there; documents may name files of the sources. */
function linksHold(folder) {
  for (const name of readdirSync(folder)) {
    const file = join(folder, name);
    if (statSync(file).isDirectory()) {
      linksHold(file);
    } else if (file.endsWith(".html") && name !== "studio.html") {
      for (const [, address] of readFileSync(file, "utf8").matchAll(/(?:href|src)="([^":#]+)[#"]/g)) {
        const named = normalize(join(dirname(file), decodeURIComponent(address)));
        check(existsSync(named) || !named.startsWith(join(site, "docs")) || !/\.(html|png|css|svg)$/.test(named), `${file} names ${address}, which isn't there`);
      }
    }
  }
}
linksHold(site);

const types = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml", ".png": "image/png", ".webmanifest": "application/manifest+json"};
const server = createServer((request, answer) => {
  const path = new URL(request.url, "http://localhost").pathname;
  const file = join(site, path.endsWith("/") ? `${path}index.html` : path);
  if (!existsSync(file)) {
    answer.writeHead(404).end();
    return;
  }
  answer.writeHead(200, {"content-type": types[extname(file)] ?? "application/octet-stream"}).end(readFileSync(file));
});
await new Promise((begun) => server.listen(0, "localhost", begun));
const home = `http://localhost:${server.address().port}/`;

const browser = await launch(require, values.browser, true);
const context = await browser.newContext({viewport: {width: 1280, height: 900}});
const page = await context.newPage();
const heard = [];
page.on("console", (message) => message.text().includes("GL Driver") || heard.push(message.text()));
page.on("requestfailed", (request) => heard.push(`failed: ${request.url()}`));
try {
  await page.goto(home);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.evaluate(() => document.querySelectorAll("img").forEach((image) => (image.loading = "eager")));
  await page.waitForFunction(() => [...document.images].every((image) => image.complete));
  check(await page.evaluate(() => document.images.length === 6 && [...document.images].every((image) => image.naturalWidth > 0)), "a picture of the start page is missing");
  await page.screenshot({path: `${out}/${values.browser}-site.png`, fullPage: true});
  check(heard.length === 0, `the start page says ${heard}`);
  heard.length = 0;
  await page.goto(`${home}docs/guide/studio.html`);
  check(await page.locator("table").count() > 0, "tables of the guide aren't tables");
  await page.screenshot({path: `${out}/${values.browser}-guide.png`});

  // Without a network, and with options in the address.
  await page.goto(`${home}studio.html#o=--paper%3DA3`);
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  server.closeAllConnections();
  await new Promise((closed) => server.close(closed));
  await page.reload();
  await page.waitForFunction(() => globalThis.ridgecraft?.inspect().ready > 0);
  await page.click("#samples button");
  await page.waitForFunction(() => globalThis.ridgecraft.inspect().pieces > 0);
  check((await page.evaluate(() => globalThis.ridgecraft.inspect().options.paper)) === "A3", "options in the address are ignored");
  check(heard.length === 0, `the studio of the site says ${heard}`);
} catch (error) {
  faults.push(error.stack ?? String(error));
}
server.close();
await end(browser, faults);
