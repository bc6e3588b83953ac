// Pages with made-up runs, opened in one browser for each file of tests.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { executablePath, launch } from "./browser.mjs";
import { page as html, replay } from "./fixture.mjs";
import { open as opened } from "./opened.mjs";

assert.ok(executablePath, "no chromium is installed");
const folder = mkdtempSync(join(tmpdir(), "viewer-"));
export const browser = await launch();
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

/** Writes a page and returns where it is. */
export const write = (name, text) => {
  writeFileSync(join(folder, name), text);
  return join(folder, name);
};
export const one = write("one.html", html([replay()]));
export const three = write("three.html", html([replay(), '{"format":"kinemark-replay/2"}', replay({ task: "long", seconds: 60, joints: 25 })]));

/** Opens a page, `file#fragment`; `wrong` is what it asked for and complained of. */
export async function open(path, options = {}, from = browser) {
  const [file, fragment] = path.split("#");
  const page = await opened(from, file, { fragment: fragment === undefined ? "" : `#${fragment}`, width: 1440, height: 1000, reducedMotion: "reduce", ...options });
  return { page, wrong: page.said, close: () => page.close() };
}

export const shown = (page, i = 0) => page.evaluate((i) => window.kinemark.replays[i].shown(), i);
export const seek = (page, t, i = 0) => page.evaluate(([t, i]) => window.kinemark.replays[i].seek(t), [t, i]);
export const near = (a, b, by, what) => assert.ok(Math.abs(a - b) <= by, `${what}: ${a}, not ${b}`);

/** Opens the menu of a picture, where its views and what it shows are chosen. */
export const menu = (page, i = 0) => page.getByRole("button", { name: "View", exact: true }).nth(i).click();
