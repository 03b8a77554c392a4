// SPDX-License-Identifier: GPL-3.0-or-later
// Starts the page with the result that stands in it.

import {App} from "./app.js";
import {staticBackend} from "./backend.js";
import {byId, tellBroken} from "./panel.js";

async function startPage() {
  const backend = await staticBackend(document);
  const app = new App(backend, backend.state());
  Object.assign(globalThis, {ridgecraft: {inspect: (/** @type {any} */ about) => app.inspect(about)}});
}

startPage().catch((error) => {
  byId("app").hidden = true;
  tellBroken(error);
  throw error;
});
