// What pointer and keys do in a plot: show other moments of the run, and stay there.

import assert from "node:assert/strict";
import { test } from "node:test";
import { page as html, replay, truth } from "./fixture.mjs";
import { near, one, open, seek, shown, write } from "./made.mjs";
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

/** The first number and the last below the first plot. */
const ends = (page) => page.locator("figure[data-panels]").first().evaluate((figure) => {
  const all = [...figure.querySelectorAll("svg[role=img] text")].filter((text) => text.checkVisibility() && /^[\d.]+$/.test(text.textContent.trim()) && text.getClientRects().length > 0);
  const numbers = all.map((text) => Number(text.textContent)).sort((a, b) => a - b);
  return [numbers[0], numbers.at(-1)];
});
const wheel = async (page, by, ctrl) => {
  if (ctrl) await page.keyboard.down("Control");
  await page.mouse.wheel(0, by);
  if (ctrl) await page.keyboard.up("Control");
  await frames(page, 3);
};

test("a drag over a plot shows that stretch, and what is under the pointer is what was drawn there", async () => {
  const { page, wrong, close } = await open(one);
  const line = page.locator("figure[data-panels] path[stroke='#006CAE']").first();
  await page.mouse.move(...(await at(page, 0.6)));
  const values = () => page.locator(".replay-values").first().textContent();
  const before = await values();
  const drawn = await line.getAttribute("d");
  await page.mouse.move(...(await at(page, 0.5)));
  await page.mouse.down();
  await page.mouse.move(...(await at(page, 0.75)), { steps: 4 });
  await page.mouse.up();
  const [first, last] = await ends(page);
  assert.ok(first >= 1.95 && last <= 3.05 && last > first, `${first} to ${last}`);
  assert.notEqual(await line.getAttribute("d"), drawn);
  // 2.4 s was at 0.6 of the axis and is at 0.4 of this stretch
  await page.mouse.move(...(await at(page, 0.4)));
  near((await shown(page)).t, 2.4, 0.02, "the moment under the pointer");
  const of = (text) => /shoulder(-?[\d.]+)/.exec(text)[1];
  near(Number(of(await values())), Number(of(before)), 0.02, "the value there");
  // a drag is no click
  await page.mouse.move(5, 5);
  assert.equal((await shown(page)).t, 0);
  await page.mouse.dblclick(...(await at(page, 0.4)));
  assert.deepEqual(await ends(page), [0, 4]);
  assert.equal(await line.getAttribute("d"), drawn);
  assert.deepEqual(wrong, []);
  await close();
});

test("the wheel zooms with Ctrl or after a click, and scrolls the page otherwise", async () => {
  const { page, close } = await open(one, { height: 600 });
  await time(page).scrollIntoViewIfNeeded();
  await page.mouse.move(...(await at(page, 0.5)));
  await wheel(page, -300, true);
  assert.ok((await ends(page))[0] > 0);
  await page.getByRole("button", { name: "Whole run" }).first().click();
  assert.deepEqual(await ends(page), [0, 4]);
  await page.evaluate(() => document.activeElement.blur());
  await page.mouse.move(...(await at(page, 0.5)));
  const before = await page.evaluate(() => scrollY);
  await wheel(page, 60, false);
  assert.deepEqual(await ends(page), [0, 4]);
  await page.waitForFunction((before) => scrollY > before, before);
  await page.mouse.click(...(await at(page, 0.5)));
  await wheel(page, -300, false);
  assert.ok((await ends(page))[0] > 0);
  await close();
});

test("keys zoom at the moment, and the stretch follows the arrows", async () => {
  const { page, close } = await open(one);
  await seek(page, 2);
  await page.locator("figure[data-panels]").first().focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("+");
  const [first, last] = await ends(page);
  assert.ok(first > 1.7 && last < 2.3, `${first} to ${last}`);
  for (let i = 0; i < 10; i++) await page.keyboard.press("Shift+ArrowRight");
  near((await shown(page)).t, 3, 1e-9, "a hundred frames on");
  const after = await ends(page);
  assert.ok(after[0] < 3 && after[1] > 2.9, `${after}`);
  await page.keyboard.press("0");
  assert.deepEqual(await ends(page), [0, 4]);
  await close();
});

test("what costs points is hatched, and the hatching is explained in words", async () => {
  const { page, close } = await open(one);
  await page.waitForSelector(".replay-costly");
  const found = await page.locator("figure[data-panels]").first().evaluate((figure) => ({
    areas: [...figure.querySelectorAll("svg[role=img] > .replay-costly")].map((one) => [Number(one.getAttribute("x")), Number(one.getAttribute("x")) + Number(one.getAttribute("width"))]),
    words: figure.querySelector(".replay-costs")?.textContent,
    fill: getComputedStyle(figure.querySelector(".replay-costly")).fill,
  }));
  assert.match(found.words, /hatched: beyond what earns all points/);
  assert.match(found.fill, /url/);
  // at every moment: hatched where the angle is above the 0.5 rad that earn all points
  for (let i = 1; i < 40; i++) {
    const t = i / 10;
    const q = truth(1000 * t).q[0];
    if (Math.abs(q - 0.5) < 0.05) continue;
    const x = 680 + (5520 * t) / 4;
    assert.equal(found.areas.some(([from, to]) => x >= from && x <= to), q > 0.5, `at ${t} s the angle is ${q}`);
  }
  await close();
});

test("where a signal chatters its band is light, with a line through its middle, and is read as before", async () => {
  // two seconds from -1 rad to 1 rad, as a report draws what goes up and down in every pixel
  const band = '<path opacity="0.7" fill="#006CAE" d="m3440 850 1380 0 1380 0 0 1000-1380 0-1380 0z"/>';
  const text = html([replay()]).replace("<text x=\"3400\" y=\"2400\"", `${band}$&`);
  const { page, close } = await open(write("chatter.html", text));
  await page.waitForSelector(".replay-middle", { state: "attached" });
  const { opacity, box } = await page.locator(".replay-band").first().evaluate((path) => ({ opacity: Number(getComputedStyle(path).opacity), box: (({ x, y, width, height }) => ({ x, y, width, height }))(path.nextElementSibling.getBBox()) }));
  assert.ok(opacity < 0.4, `the band covers ${opacity}`);
  near(box.y + box.height / 2, 1350, 2, "the middle");
  assert.ok(box.x >= 3438 && box.width > 2700, JSON.stringify(box));
  await page.mouse.move(...(await at(page, 0.75)));
  assert.match(await page.locator(".replay-values").first().textContent(), /shoulder-1(\.0*)? … 1(\.0*)?\u00a0rad/);
  await close();
});

test("where a check judged nothing, a plot says so", async () => {
  // the lines of the made-up plot end half way
  const half = html([replay()]).replace(/(stroke-width="20" d="m)([^"]*)"/g, (whole, head, steps) => (steps.split(" ").length < 40 ? whole : `${head}${steps.split(" ").slice(0, 202).join(" ")}"`));
  const { page, wrong, close } = await open(write("half.html", half));
  await time(page).waitFor();
  const box = page.locator("figure[data-panels] .replay-values").first();
  await page.mouse.move(...(await at(page, 0.25)));
  assert.match(await box.textContent(), /shoulder.*elbow/);
  await page.mouse.move(...(await at(page, 0.8)));
  assert.match(await box.textContent(), /not judged here/);
  assert.doesNotMatch(await box.textContent(), /shoulder/);
  assert.deepEqual(wrong, []);
  await close();
});
