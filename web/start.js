// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the page with the result that stands in it.

import {App} from "./app.js";
import {staticBackend} from "./backend.js";
import {byId} from "./panel.js";
import {say} from "./words.js";

function startPage() {
  try {
    const backend = staticBackend(document);
    const app = new App(backend, backend.state());
    Object.assign(globalThis, {ridgecraft: {inspect: (/** @type {any} */ about) => app.inspect(about)}});
  } catch (error) {
    byId("app").hidden = true;
    const line = document.createElement("p");
    line.className = "broken";
    line.textContent = say("broken", {why: error instanceof Error ? error.message : String(error)});
    document.body.append(line);
    throw error;
  }
}

startPage();
