// SPDX-License-Identifier: GPL-3.0-or-later
// What is packed in a page comes out as it was, and the page itself is the same each time it is made.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {createHash} from "node:crypto";
import {mkdtempSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {test} from "node:test";
import {fileURLToPath} from "node:url";
import {deflateSync} from "node:zlib";

import {bytesOf, unpackedText} from "../../../web/packed.js";

test("texts of all sizes are unpacked, and broken ones aren't", async () => {
  for (const size of [0, 1, 300, 70000]) {
    const text = "Bögen und Nähte, <script>\n".repeat(size);
    const packed = deflateSync(text).toString("base64");
    assert.equal(await unpackedText(packed), text);
    await assert.rejects(unpackedText(packed.slice(0, 4 * Math.floor(packed.length / 8))));
  }
  const bytes = Uint8Array.from({length: 256}, (_, i) => i);
  assert.deepEqual(bytesOf(Buffer.from(bytes).toString("base64")), bytes);
});

test("a page is the same each time, and its policy names its script and style sheet", () => {
  const folder = mkdtempSync(join(tmpdir(), "ridgecraft-page-"));
  const script = fileURLToPath(new URL("../../../web/bundle.sh", import.meta.url));
  const [first, second] = [1, 2].map((n) => {
    execFileSync("sh", [script, "studio", join(folder, `${n}.html`)]);
    return readFileSync(join(folder, `${n}.html`), "utf8");
  });
  rmSync(folder, {recursive: true});
  assert.equal(first, second);
  for (const tag of ["script", "style"]) {
    const [, content] = new RegExp(`<${tag}>(.*?)</${tag}>`, "s").exec(first);
    assert.ok(first.includes(`sha256-${createHash("sha256").update(content).digest("base64")}`), tag);
  }
});
