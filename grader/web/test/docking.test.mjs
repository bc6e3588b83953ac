// The picture of a run stays in sight: in a pane of its own, or small in the corner, and nothing of it is on paper.

import assert from "node:assert/strict";
import { test } from "node:test";
import { page as html, replay } from "./fixture.mjs";
import { menu, one, open, write } from "./made.mjs";
import { frames } from "./waiting.mjs";

const long = write("long.html", html([replay()]).replace("</ul></section>", '</ul><p style="height:3000px"></p></section>'));
const box = (page, part) => page.locator(part).first().evaluate((element) => (({ left, top, right, bottom, width, height }) => ({ left, top, right, bottom, width, height }))(element.getBoundingClientRect()));
const figure = "figure[data-panels]";

test("in a wide window the replay stays beside the plots that pass", async () => {
  const { page, wrong, close } = await open(long, { width: 1440, height: 900 });
  const [stage, plot] = [await box(page, ".replay-stage"), await box(page, figure)];
  assert.ok(stage.right <= plot.left, `${stage.right} is not left of ${plot.left}`);
  await page.evaluate(() => scrollBy(0, 2000));
  await frames(page, 3);
  const after = await box(page, ".replay-stage");
  assert.ok(after.top >= 0 && after.bottom <= 900, `the picture lies from ${after.top} to ${after.bottom}`);
  assert.ok(after.width > 400 && !(await page.locator(".replay.small").count()));
  const controls = await box(page, ".replay-controls");
  assert.ok(controls.bottom <= 900, `the buttons end at ${controls.bottom}`);
  assert.deepEqual(wrong, []);
  await close();
});

test("in a narrow window a small picture stays in the corner, until it is hidden", async () => {
  const { page, wrong, close } = await open(long, { width: 390, height: 800 });
  assert.equal(await page.locator(".replay.small").count(), 0);
  // at once, as a link goes
  await page.evaluate(() => scrollTo(0, 2500));
  await page.waitForSelector(".replay.small");
  const small = await box(page, ".replay-stage");
  assert.ok(small.right <= 390 && small.bottom <= 800 && small.top > 400 && small.width < 200, JSON.stringify(small));
  // the page under it keeps its length
  const length = await page.evaluate(() => document.documentElement.scrollHeight);
  await page.getByRole("button", { name: "Back to the replay" }).click();
  await page.waitForSelector(".replay:not(.small)");
  assert.ok((await box(page, ".replay-frame")).bottom > 0);
  assert.equal(await page.evaluate(() => document.documentElement.scrollHeight), length);
  await page.evaluate(() => scrollTo(0, 2500));
  await page.getByRole("button", { name: "Hide the small picture" }).click();
  assert.equal(await page.locator(".replay.small").count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

for (const [width, least] of [[1440, 0.6], [390, 0.5]]) {
  test(`on the whole screen the picture takes most of ${width} pixels, and fills its frame`, async () => {
    const { page, wrong, close } = await open(one, { width, height: 900 });
    await page.getByRole("button", { name: "Full screen" }).click();
    await page.waitForFunction(() => document.fullscreenElement !== null);
    // as large as the screen is, whatever the browser makes of it
    const height = await page.evaluate(() => innerHeight);
    await page.waitForFunction(() => {
      const [frame, canvas] = [".replay-frame", ".replay-stage canvas"].map((part) => document.querySelector(part).getBoundingClientRect());
      return Math.abs(frame.height - canvas.height) < 2 && Math.abs(frame.width - canvas.width) < 2;
    });
    const frame = await box(page, ".replay-frame");
    assert.ok(frame.height > least * height, `${frame.height} of ${height}`);
    const beside = await box(page, ".replay-beside");
    assert.ok(width > 800 ? beside.left >= frame.right - 1 : beside.top >= frame.bottom, "the numbers lie over the picture");
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("a narrow window has two rows of buttons, and no plot is cut off", async () => {
  const { page, close } = await open(one, { width: 390, height: 800 });
  const rows = await page.locator(".replay-controls button:visible, .replay-controls select").evaluateAll((all) => new Set(all.map((button) => Math.round(button.getBoundingClientRect().bottom / 20))).size);
  assert.ok(rows <= 2, `${rows} rows`);
  const cut = await page.locator("figure.plot").evaluateAll((all) => all.filter((figure) => figure.scrollWidth > figure.clientWidth + 1).map((figure) => figure.ariaLabel));
  assert.deepEqual(cut, []);
  await close();
  const wider = await open(one, { width: 1024, height: 800 });
  const { width } = await box(wider.page, `${figure} svg`);
  assert.ok(width <= 1.2 * 640, `a plot is ${width} pixels wide`);
  await wider.close();
});

test("the menu of the picture is opened by keys, and Escape closes it and keeps the focus", async () => {
  const { page, close } = await open(one);
  const opener = page.getByRole("button", { name: "View", exact: true });
  await opener.focus();
  await page.keyboard.press("Enter");
  assert.equal(await opener.getAttribute("aria-expanded"), "true");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Fit");
  await page.keyboard.press("Escape");
  assert.ok(!(await page.getByRole("button", { name: "Fit", exact: true }).isVisible()));
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "View");
  await menu(page);
  await page.locator("h1").click();
  assert.equal(await opener.getAttribute("aria-expanded"), "false");
  await close();
});

test("a paper has one column and the picture in its place, from any window", async () => {
  for (const width of [1440, 390]) {
    const { page, close } = await open(long, { width, height: 800 });
    await page.evaluate(() => scrollTo(0, 2000));
    await frames(page, 3);
    await page.emulateMedia({ media: "print" });
    const [stage, plot, title] = [await box(page, ".replay-stage"), await box(page, figure), await box(page, "h2")];
    assert.ok(stage.top > title.bottom && stage.bottom < plot.top, `from ${width} px: ${stage.top} to ${stage.bottom}, the plot at ${plot.top}`);
    assert.equal(await page.locator(".replay-corner").isVisible(), false);
    await close();
  }
});
