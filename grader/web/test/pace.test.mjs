// A slow machine: the run keeps its time, and does without shadows.

import assert from "node:assert/strict";
import { test } from "node:test";
import { one, open, shown } from "./made.mjs";

/** Frames that come this far apart. */
const slow = (ms) => `window.requestAnimationFrame = (act) => setTimeout(() => act(performance.now()), ${ms}); window.cancelAnimationFrame = clearTimeout;`;

test("a second of the run takes a second, however few frames there are", async () => {
  const { page, close } = await open(one, { first: slow(300) });
  await page.waitForSelector(".replay canvas");
  const passed = await page.evaluate(async () => {
    const replay = window.kinemark.replays[0];
    document.querySelector(".replay-play").click();
    const moved = async (than) => {
      while (replay.shown().t <= than) await new Promise((next) => setTimeout(next, 5));
      return [performance.now() / 1000, replay.shown().t];
    };
    const [began, first] = await moved(0);
    const [ended, last] = await moved(first + 1);
    return [ended - began, last - first];
  });
  assert.ok(Math.abs(passed[1] / passed[0] - 1) < 0.25, `${passed[1]} s of the run in ${passed[0]} s`);
  await close();
});

test("below twenty frames a second there are no shadows, unless they are asked for again", async () => {
  const { page, close } = await open(one, { first: slow(80) });
  await page.waitForSelector(".replay canvas");
  const shadows = page.locator(".replay-menu button", { hasText: "Shadows" });
  assert.equal(await shadows.getAttribute("aria-pressed"), "true");
  await page.getByRole("button", { name: "Loop" }).click();
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForFunction(() => [...document.querySelectorAll(".replay-menu button")].find((one) => one.textContent === "Shadows").ariaPressed === "false");
  await shadows.evaluate((one) => one.click());
  const { t } = await shown(page);
  await page.waitForFunction((t) => Math.abs(window.kinemark.replays[0].shown().t - t) > 1.5, t);
  assert.equal(await shadows.getAttribute("aria-pressed"), "true");
  await close();
});
