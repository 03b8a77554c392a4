// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the start page and the studio for when there is no network. Another version takes the place of the one before.
// Other pages of one host have caches, too.
const ours = "ridgecraft-";
const version = `${ours}@VERSION@`;
const kept = ["./", "index.html", "studio.html", "site.css", "icon.svg", "manifest.webmanifest", "register.js"];

self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(version).then((cache) => cache.addAll(kept)).then(() => self.skipWaiting()));
});

self.addEventListener("activate", (event) => {
  event.waitUntil(caches.keys().then((names) => Promise.all(names.filter((name) => name.startsWith(ours) && name !== version).map((name) => caches.delete(name))))
    .then(() => self.clients.claim()));
});

self.addEventListener("fetch", (event) => {
  if (event.request.method === "GET") {
    event.respondWith(caches.open(version).then((cache) => cache.match(event.request, {ignoreSearch: true})).then((found) => found ?? fetch(event.request)));
  }
});
