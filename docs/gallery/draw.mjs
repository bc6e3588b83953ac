// Draws pages as pictures: node docs/gallery/draw.mjs PAGE.html NAME [WIDTH] writes docs/gallery/NAME-light.webp and NAME-dark.webp.
//
// Needs Node and Chromium (by its Debian name, or the one in CHROMIUM). `draw.sh` calls it for every lab.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const [page, name, width = "1000"] = process.argv.slice(2);
if (!name) {
  console.error("usage: node draw.mjs PAGE.html NAME [WIDTH]");
  process.exit(2);
}
const gallery = dirname(fileURLToPath(import.meta.url));
const profile = mkdtempSync(join(tmpdir(), "gallery-"));
// messages go over a pipe, each ended by a zero byte
const browser = spawn(process.env.CHROMIUM ?? "chromium", [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--hide-scrollbars",
  "--remote-debugging-pipe", `--user-data-dir=${profile}`, "about:blank",
], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const ended = new Promise((done) => browser.on("exit", done));

let asked = 0;
let session;
const waiting = new Map();
const happened = new Map();
let received = "";
browser.stdio[4].setEncoding("utf8").on("data", (text) => {
  const messages = (received + text).split("\0");
  received = messages.pop();
  for (const message of messages.map((one) => JSON.parse(one))) {
    waiting.get(message.id)?.(message.result ?? message);
    happened.get(message.method)?.();
  }
});
const ask = (method, params = {}) => new Promise((answer) => {
  waiting.set(++asked, answer);
  browser.stdio[3].write(JSON.stringify({ id: asked, method, params, sessionId: session }) + "\0");
});
const event = (method) => new Promise((done) => happened.set(method, done));

const { targetId } = await ask("Target.createTarget", { url: "about:blank" });
({ sessionId: session } = await ask("Target.attachToTarget", { targetId, flatten: true }));
await ask("Page.enable");
for (const scheme of ["light", "dark"]) {
  await ask("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
  await ask("Emulation.setDeviceMetricsOverride", { width: Number(width), height: 800, deviceScaleFactor: 1, mobile: false });
  const loaded = event("Page.loadEventFired");
  await ask("Page.navigate", { url: pathToFileURL(resolve(page)).href });
  await loaded;
  const { cssContentSize: { height } } = await ask("Page.getLayoutMetrics");
  // WebP knows no picture taller than 16383 pixels: a longer page is cut off
  const shown = Math.min(Math.ceil(height), 16383);
  const { data } = await ask("Page.captureScreenshot", {
    format: "webp", quality: 60, captureBeyondViewport: true, clip: { x: 0, y: 0, width: Number(width), height: shown, scale: 1 },
  });
  if (!data) throw new Error(`${page} could not be drawn`);
  writeFileSync(join(gallery, `${name}-${scheme}.webp`), Buffer.from(data, "base64"));
}
session = undefined;
browser.stdio[3].write(JSON.stringify({ id: ++asked, method: "Browser.close" }) + "\0");
await ended;
rmSync(profile, { recursive: true, force: true });
