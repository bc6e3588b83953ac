// A sample of the reports in Firefox, by WebDriver BiDi: `node --experimental-websocket firefox.mjs REPORTS` (FIREFOX names the program).
//
// Each page starts paused, shows the moment that is sought or linked to, has a picture, and neither complains nor asks for anything.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, existsSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { PATIENCE_MS, soon } from "./waiting.mjs";

const folder = resolve(process.argv[2]);
const profile = mkdtempSync(join(tmpdir(), "kinemark-firefox-"));
const firefox = spawn(process.env.FIREFOX ?? "firefox-esr", ["--headless", "--no-remote", "--profile", profile, "--remote-debugging-port=0", "about:blank"], { stdio: ["ignore", "ignore", "pipe"] });

/** Where Firefox listens: it prints the address. */
const address = await new Promise((found, failed) => {
  let text = "";
  setTimeout(() => failed(new Error(`Firefox does not say where it listens: ${text}`)), PATIENCE_MS).unref();
  firefox.stderr.on("data", (data) => {
    text += data;
    const url = /WebDriver BiDi listening on (ws:\S+)/.exec(text)?.[1];
    if (url) found(url);
  });
});

const socket = new WebSocket(`${address}/session`);
await new Promise((opened) => socket.addEventListener("open", opened));
const answers = new Map();
const said = [];
socket.addEventListener("message", ({ data }) => {
  const message = JSON.parse(data);
  if (message.type === "event") {
    const { level, text } = message.params;
    if (level === "error" || level === "warn") said.push(text);
    const url = message.params.request?.url;
    if (url && !/^(file|data|blob|about):/.test(url)) said.push(`request: ${url}`);
    return;
  }
  const { done, failed } = answers.get(message.id);
  answers.delete(message.id);
  if (message.type === "success") done(message.result);
  else failed(new Error(`${message.error}: ${message.message}`));
});
let id = 0;
const send = (method, params) => new Promise((done, failed) => {
  answers.set(++id, { done, failed });
  socket.send(JSON.stringify({ id, method, params }));
});

try {
  await send("session.new", { capabilities: {} });
  await send("session.subscribe", { events: ["log.entryAdded", "network.beforeRequestSent"] });
  const { contexts: [{ context }] } = await send("browsingContext.getTree", {});
  const go = (url) => send("browsingContext.navigate", { context, url, wait: "complete" });
  /** What an expression gives in the page, as JSON. */
  const ask = async (expression) => {
    const { result, exceptionDetails } = await send("script.evaluate", { expression: `JSON.stringify(${expression})`, target: { context }, awaitPromise: true });
    assert.ok(!exceptionDetails, exceptionDetails?.text);
    return JSON.parse(result.value ?? "null");
  };
  const labs = readdirSync(folder).filter((lab) => existsSync(join(folder, lab, "report.html"))).sort();
  assert.ok(labs.length > 5, `${labs.length} reports`);
  for (const lab of labs) {
    const url = pathToFileURL(join(folder, lab, "report.html")).href;
    await go("about:blank");
    await go(url);
    await soon(async () => assert.equal(await ask("location.href"), url));
    const replays = await ask("window.kinemark.replays.map((replay) => ({ task: replay.task, t: replay.shown().t }))");
    assert.ok(replays.every(({ t }) => t === 0), `${lab} starts at ${JSON.stringify(replays)}`);
    for (const [i, { task }] of replays.entries()) {
      const end = await ask(`(window.kinemark.replays[${i}].seek(1e9), window.kinemark.replays[${i}].shown().t)`);
      const half = Math.round(500 * end) / 1000;
      await go("about:blank");
      await go(`${url}#task=${encodeURIComponent(task)}&t=${half}`);
      await soon(async () => assert.equal(await ask(`window.kinemark.replays[${i}].shown().t`), half, `${lab}, ${task}`));
      // in 3D, or from the side where this machine has no WebGL
      await soon(async () => assert.ok(await ask(`document.querySelectorAll(".replay.on")[${i}].querySelector("canvas, .replay-side") !== null`), `${lab}, ${task}: no picture`));
    }
    // the browser's own words about graphics are not the page's
    assert.deepEqual(said.filter((text) => !/WebGL/i.test(text)), [], lab);
    console.log(`${lab}: ${replays.length} replays`);
  }
} finally {
  firefox.kill();
  rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
}
