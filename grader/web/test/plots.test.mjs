// What pointer and keys do in a plot: show other moments of the run, and stay there.

import assert from "node:assert/strict";
import { test } from "node:test";
import { near, one, open, seek, shown } from "./made.mjs";
import { frames } from "./waiting.mjs";

const time = (page) => page.locator("figure[data-panels] svg").first();
/** Where a share of the time axis of the made-up plot is, in pixels of the page. */
async function at(page, share, which = 0) {
  const { x, y, width, height } = await page.locator("figure[data-panels] svg.plot[role=img]").nth(which).boundingBox();
  return [x + (width * (680 + 5520 * share)) / 6400, y + 0.5 * height];
}

test("the pointer over a plot moves the arm, leaving puts it back, and a click stays", async () => {
  const { page, wrong, close } = await open(one);
  await time(page).waitFor();
  await seek(page, 1);
  const before = (await shown(page)).nodes.forearm;
  await page.mouse.move(...(await at(page, 0.75)));
  near((await shown(page)).t, 3, 0.03, "under the pointer");
  assert.notDeepEqual((await shown(page)).nodes.forearm, before);
  near(Number.parseFloat(await page.locator("[data-readout=t]").textContent()), 3, 0.03, "the read-out");
  await page.mouse.move(5, 5);
  assert.equal((await shown(page)).t, 1);
  assert.deepEqual((await shown(page)).nodes.forearm, before);
  assert.equal(await page.evaluate(() => window.kinemark.state().knock.t), 1);
  await page.mouse.click(...(await at(page, 0.5)));
  await page.mouse.move(5, 5);
  near((await shown(page)).t, 2, 0.03, "where it was clicked");
  // the address is that of the moment where it rests
  await page.mouse.move(...(await at(page, 0.9)));
  await page.waitForURL(/t=(1\.9|2)/);
  assert.deepEqual(wrong, []);
  await close();
});

test("keys in a plot do what the pointer does: look, go back, and stay with Enter", async () => {
  const { page, close } = await open(one);
  await seek(page, 1);
  const figure = page.locator("figure[data-panels]").first();
  await figure.focus();
  await page.keyboard.press("Shift+ArrowRight");
  near((await shown(page)).t, 1.1, 1e-9, "ten frames on");
  await page.keyboard.press("Escape");
  assert.equal((await shown(page)).t, 1);
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Enter");
  await figure.evaluate((element) => element.blur());
  near((await shown(page)).t, 1.1, 1e-9, "Enter stays");
  await close();
});

test("a run that plays plays on under the pointer", async () => {
  const { page, close } = await open(one);
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.mouse.move(...(await at(page, 0.9)));
  await frames(page, 2);
  assert.ok((await shown(page)).t < 3);
  assert.equal(await page.getByRole("button", { name: "Pause", exact: true }).count(), 1);
  await close();
});
