// SPDX-License-Identifier: GPL-3.0-or-later
// After the first visit the site works without a network.
navigator.serviceWorker?.register("service_worker.js").catch(() => {});
